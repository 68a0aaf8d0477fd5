// SPDX-License-Identifier: Apache-2.0
#include "sim/study/record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>
#include <nlohmann/json.hpp>
#include <vector>

#include "scene/lights.hpp"
#include "sim/cost/yosys.hpp"
#include "sim/engines/ghdl/ghdl_library.hpp"
#include "sim/engines/mesa/mesa_picture.hpp"
#include "sim/files/image.hpp"
#include "sim/files/image_library.hpp"
#include "sim/os/file.hpp"
#include "sim/os/must.hpp"
#include "sim/os/shared_library.hpp"
#include "sim/os/subprocess.hpp"
#include "sim/study/figures.hpp"
#include "sim/study/host_setup.hpp"

namespace halfway::study {
namespace {

using Json = nlohmann::ordered_json;

// JSON has no infinity: the PSNR of equal pictures is null, and so are values that were not counted.
template <class Value>
Json json_of(const Value& value) {
  if constexpr (std::floating_point<Value>)
    if (!std::isfinite(value)) return nullptr;
  return value;
}
Json json_of(const std::optional<std::uint64_t>& value) {
  return value ? Json(*value) : Json(nullptr);
}
template <class Value>
void take(const Json& json, Value& value) {
  if constexpr (std::floating_point<Value>)
    if (json.is_null()) {
      value = std::numeric_limits<Value>::infinity();
      return;
    }
  json.get_to(value);
}
void take(const Json& json, std::optional<std::uint64_t>& value) {
  if (!json.is_null()) value = json.get<std::uint64_t>();
}

Json json_of(const Provenance& p) {
  return {{"scene", p.scene},
          {"scene_hash", p.scene_hash},
          {"program", p.program},
          {"rtl", p.rtl},
          {"tools", p.tools}};
}

template <class Numbers>
void add_numbers(ContentHash& hash, const Numbers& numbers) {
  hash.add(
      {reinterpret_cast<const char*>(std::data(numbers)), std::size(numbers) * sizeof(*std::data(numbers))});
}
void add_numbers(ContentHash& hash, std::initializer_list<double> numbers) {
  hash.add({reinterpret_cast<const char*>(numbers.begin()), numbers.size() * sizeof(double)});
}
void add_vector(ContentHash& hash, const glm::dvec3& v) {
  add_numbers(hash, {v.x, v.y, v.z});
}

// Hash every file of the folder, by name.
std::string hash_of(const std::filesystem::path& folder) {
  ContentHash hash;
  for (const std::filesystem::path& file : must(files_below(folder)))
    hash.add(file.string()).add(must(read_file(folder / file)));
  return hash.hex();
}

}  // namespace

std::string scene_hash(const Scene& scene) {
  ContentHash hash;
  const Camera& c = scene.camera;
  for (const glm::dvec3& v : {c.eye_world, c.target_world, c.up_world, scene.ambient, scene.background})
    add_vector(hash, v);
  add_numbers(hash, {c.vertical_fov_degrees, c.near, c.far, scene.shadows ? 1.0 : 0.0});
  for_each_light(scene, [&](const Light& light) {
    hash.add(to_string(light.ref.kind));
    add_vector(hash, light.point.xyz_world);
    add_vector(hash, light.intensity);
    if (!light.cone) return;
    add_vector(hash, light.cone->axis_world);
    add_numbers(hash, {light.cone->cos_inner, light.cone->cos_outer});
  });
  hash.add("materials");
  for (const Material& m : scene.materials) {
    add_vector(hash, m.colour);
    add_vector(hash, m.specular_colour);
    add_numbers(hash, {static_cast<double>(m.brdf), m.ambient, m.diffuse, m.specular, m.exponent, m.roughness,
                       m.reflectance});
  }
  // A scene without emission has the hash that it had before there was any.
  for (std::size_t i = 0; i < scene.materials.size(); ++i)
    if (const glm::dvec3& emission = scene.materials[i].emission; emission != glm::dvec3(0.0)) {
      hash.add(fmt::format("emission of {}", i));
      add_vector(hash, emission);
    }
  add_numbers(hash, scene.positions_world);
  add_numbers(hash, scene.normals_world);
  std::vector<std::uint32_t> triangles, cullings;
  for (const SceneTriangle& t : scene.triangles) {
    for (const auto* corners : {&t.position, &t.normal})
      triangles.insert(triangles.end(), corners->begin(), corners->end());
    triangles.push_back(t.material);
    cullings.push_back(static_cast<std::uint32_t>(t.culling));
  }
  add_numbers(hash, triangles);
  // Closed surfaces have the hash that they had before there were others.
  if (std::ranges::any_of(scene.triangles,
                          [](const SceneTriangle& t) { return t.culling != Culling::closed; }))
    add_numbers(hash, cullings);
  return hash.hex();
}

Provenance provenance_of(const Scene& scene, const SimulatorFolders& folders) {
  std::string image_versions;
  must(image_library()).versions(image_versions);
  const auto version = [](const char* program, const char* install) {
    return synth::version_of(program, "--version", install);
  };
  std::string tools = fmt::format("{}, {}, {}", version("ghdl", c_install_ghdl),
                                  version("verilator", c_install_verilator), image_versions);
  if (!find_program("valgrind").empty()) tools += ", " + version("valgrind", c_install_valgrind);
  ContentHash programs;
  programs.add(must(read_file("/proc/self/exe"))).add(must(read_file(image_library_file())));
  if (mesa_lacks(folders.source).empty()) programs.add(must(read_file(mesa_program(folders.source))));
  return {scene.name, scene_hash(scene), programs.hex(), hash_of(folders.source / "rtl"), tools};
}

std::string record_name(const Provenance& provenance, const std::string& name) {
  ContentHash hash;
  for (const std::string* part :
       {&provenance.scene, &provenance.scene_hash, &provenance.program, &provenance.rtl, &provenance.tools})
    hash.add(*part);
  return hash.add(name).hex();
}
std::string record_name(const Provenance& provenance, const DesignPoint& point) {
  return record_name(provenance, point.name());
}

std::filesystem::path Records::file(const DesignPoint& point) const {
  return folder_ / (record_name(provenance_, point) + ".json");
}
std::filesystem::path Records::picture(const DesignPoint& point) const {
  return folder_ / (record_name(provenance_, point) + ".png");
}

std::optional<Record> Records::find(const DesignPoint& point) const {
  const auto text = read_file(file(point));
  if (!text || !std::filesystem::exists(picture(point))) return std::nullopt;
  Record record{point, {}};
  try {
    const Json json = Json::parse(*text);
    for_each_figure(record.measured,
                    [&](const char* name, auto& value) { take(json.at("figures").at(name), value); });
    if (const Json& time = json.at("host_time"); !time.is_null())
      record.measured.host_time = {time.at("ns").get<double>(), time.at("words").get<std::uint64_t>()};
  } catch (const Json::exception&) {
    return std::nullopt;
  }
  return record;
}

void Records::add_frame(const DesignPoint& point, const Frame& frame) const {
  must(write_png(picture(point), frame));
}

void Records::add(const Record& record) const {
  Json figures;
  for_each_figure(record.measured,
                  [&](const char* name, const auto& value) { figures[name] = json_of(value); });
  Json time;
  if (record.measured.host_time)
    time = {{"ns", record.measured.host_time->ns}, {"words", record.measured.host_time->words}};
  const Json json = {{"point", record.point.name()},
                     {"provenance", json_of(provenance_)},
                     {"figures", figures},
                     {"host_time", time}};
  must(write_file(file(record.point), json.dump(2) + "\n"));
}

}  // namespace halfway::study
