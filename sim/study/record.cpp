// SPDX-License-Identifier: Apache-2.0
#include "sim/study/record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <limits>
#include <nlohmann/json.hpp>
#include <vector>

#include "scene/lights.hpp"
#include "sim/ghdl/ghdl_library.hpp"
#include "sim/mesa/mesa_picture.hpp"
#include "sim/pictures/image.hpp"
#include "sim/pictures/image_library.hpp"
#include "sim/study/figures.hpp"
#include "sim/study/host_setup.hpp"
#include "sim/study/sealed.hpp"
#include "sim/system/file.hpp"
#include "sim/system/shared_library.hpp"
#include "sim/system/subprocess.hpp"

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

std::string first_line(const std::string& text) {
  return text.substr(0, text.find('\n'));
}

Result<std::string> version_of(const char* program, const char* install) {
  const auto said = ask({program, "--version"}, install);
  if (!said) return said.error();
  return first_line(*said);
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
Result<std::string> hash_of(const std::filesystem::path& folder) {
  const auto files = files_below(folder);
  if (!files) return files.error();
  ContentHash hash;
  for (const std::filesystem::path& file : *files) {
    const auto text = read_file(folder / file);
    if (!text) return text.error();
    hash.add(file.string()).add(*text);
  }
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
  add_numbers(hash, scene.positions_world);
  add_numbers(hash, scene.normals_world);
  add_numbers(hash, scene.triangles);
  return hash.hex();
}

Result<Provenance> provenance_of(const Scene& scene, const SimulatorFolders& folders) {
  const auto program = read_file("/proc/self/exe");
  if (!program) return program.error();
  const auto images = read_file(image_library_file());
  if (!images) return images.error();
  const auto rtl = hash_of(folders.source / "rtl");
  if (!rtl) return rtl.error();
  const auto ghdl = version_of("ghdl", c_install_ghdl);
  if (!ghdl) return ghdl.error();
  const auto verilator = version_of("verilator", c_install_verilator);
  if (!verilator) return verilator.error();
  const auto image_functions = image_library();
  if (!image_functions) return image_functions.error();
  std::string image_versions;
  image_functions->versions(image_versions);
  std::string tools = *ghdl + ", " + *verilator + ", " + image_versions;
  if (!find_program("valgrind").empty()) {
    const auto valgrind = version_of("valgrind", c_install_valgrind);
    if (!valgrind) return valgrind.error();
    tools += ", " + *valgrind;
  }
  ContentHash programs;
  programs.add(*program).add(*images);
  if (mesa_lacks(folders.source).empty()) {
    const auto mesa = read_file(mesa_program(folders.source));
    if (!mesa) return mesa.error();
    programs.add(*mesa);
  }
  return Provenance{scene.name, scene_hash(scene), programs.hex(), *rtl, tools};
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

Result<std::optional<Record>> Records::find(const DesignPoint& point) const {
  const auto text = read_file(file(point));
  if (!text || !std::filesystem::exists(picture(point))) return std::optional<Record>();
  const auto damaged = [](const std::filesystem::path& path) {
    return bad_input(path.string() + ": damaged; the point is measured again");
  };
  const std::optional<Json> json = unsealed(*text);
  if (!json) return damaged(file(point));
  Record record{point, {}};
  try {
    for_each_figure(record.measured,
                    [&](const char* name, auto& value) { take(json->at("figures").at(name), value); });
    json->at("picture").get_to(record.picture);
    if (const Json& time = json->at("host_time"); !time.is_null())
      record.measured.host_time = {time.at("ns").get<double>(), time.at("words").get<std::uint64_t>()};
  } catch (const Json::exception&) {
    return damaged(file(point));
  }
  const auto is = checksum_of(picture(point));
  if (!is || *is != record.picture) return damaged(picture(point));
  return std::optional(std::move(record));
}

Result<std::string> Records::add_frame(const DesignPoint& point, const Frame& frame) const {
  if (Status written = write_png(picture(point), frame); !written) return written.error();
  return checksum_of(picture(point));
}

Status Records::add(const Record& record) const {
  Json figures;
  for_each_figure(record.measured,
                  [&](const char* name, const auto& value) { figures[name] = json_of(value); });
  Json time;
  if (record.measured.host_time)
    time = {{"ns", record.measured.host_time->ns}, {"words", record.measured.host_time->words}};
  return write_file(file(record.point), sealed({{"point", record.point.name()},
                                                {"provenance", json_of(provenance_)},
                                                {"figures", figures},
                                                {"host_time", time},
                                                {"picture", record.picture}}));
}

}  // namespace halfway::study
