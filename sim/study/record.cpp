// SPDX-License-Identifier: Apache-2.0
#include "sim/study/record.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "sim/cost/yosys.hpp"
#include "sim/files/image.hpp"
#include "sim/files/image_library.hpp"
#include "sim/os/file.hpp"
#include "sim/os/must.hpp"
#include "sim/os/shared_library.hpp"
#include "sim/os/subprocess.hpp"
#include "sim/study/host_setup.hpp"

namespace halfway::study {
namespace {

using Json = nlohmann::ordered_json;

// JSON has no infinity: the PSNR of equal pictures is null, and so are values that were not counted.
Json json_of(const auto& value) {
  return value;
}
Json json_of(const std::optional<std::uint64_t>& value) {
  return value ? Json(*value) : Json(nullptr);
}
void take(const Json& json, auto& value) {
  json.get_to(value);
}
void take(const Json& json, double& value) {
  value = json.is_null() ? std::numeric_limits<double>::infinity() : json.get<double>();
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

constexpr const char* c_colours = ".png";
constexpr const char* c_masks = "-mask.png";  // red: covered, green: in a highlight
constexpr const char* c_figures = ".json";    // written last
constexpr std::array c_endings = {c_colours, c_masks, c_figures};

// Figures with their names. The sum over all tiles is the frame's figure.
template <class Counts, class Visit>
void for_each_count(Counts& d, const Visit& visit) {
  visit("fragments", d.fragments);
  visit("cycles", d.cycles);
  for_each_setup_figure(d.counts, visit);
}

Frame to_picture(FrameSize size, std::span<const std::uint8_t> red, std::span<const std::uint8_t> green) {
  Frame picture(size);
  for (std::size_t i = 0; i < red.size(); ++i) picture.rgb[3 * i] = red[i] != 0 ? 255 : 0;
  for (std::size_t i = 0; i < green.size(); ++i) picture.rgb[3 * i + 1] = green[i] != 0 ? 255 : 0;
  return picture;
}

std::vector<std::uint8_t> mask_of(const Frame& picture, std::size_t channel) {
  std::vector<std::uint8_t> mask(picture.pixels());
  for (std::size_t i = 0; i < mask.size(); ++i) mask[i] = picture.rgb[3 * i + channel] != 0;
  return mask;
}

void add_files(const std::filesystem::path& stem, const Frame& colours, const Frame& masks,
               const Json& figures) {
  must(write_png(stem.string() + c_colours, colours));
  must(write_png(stem.string() + c_masks, masks));
  must(write_file(stem.string() + c_figures, figures.dump(2) + "\n"));
}

// A study draws removed tiles again.
Failure damaged(const std::filesystem::path& file, const std::string& what) {
  return Failure{bad_input(fmt::format("{}: {}; remove it", file.string(), what))};
}

Frame read_tile(const std::filesystem::path& file, FrameSize size) {
  Frame picture = must(read_png(file));
  if (!(picture.size == size))
    throw damaged(file, fmt::format("{}, but the tile has {}", to_string(picture.size), to_string(size)));
  return picture;
}

void add_figures(const std::filesystem::path& file, Drawing& drawing) {
  const std::string text = must(read_file(file));
  try {
    const Json figures = Json::parse(text);
    figures.at("hardware").get_to(drawing.hardware);
    for_each_count(
        drawing, [&](const char* name, std::uint64_t& sum) { sum += figures.at(name).get<std::uint64_t>(); });
  } catch (const Json::exception& bad) {
    throw damaged(file, bad.what());
  }
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

std::filesystem::path Records::tile_file(const DesignPoint& point, PieceKind kind, std::size_t tile,
                                         const char* ending) const {
  const std::string name = kind == PieceKind::reference_tile ? "reference, " + point.picture() : point.name();
  return folder_ / fmt::format("{}-tile-{}{}", record_name(provenance_, name), tile, ending);
}

bool Records::has_tile(const DesignPoint& point, PieceKind kind, std::size_t tile) const {
  return std::ranges::all_of(c_endings, [&](const char* ending) {
    return std::filesystem::exists(tile_file(point, kind, tile, ending));
  });
}

void Records::remove_drawing(const DesignPoint& point) const {
  std::error_code ignored;
  for (std::size_t tile = 0; tile < point.tiles().size(); ++tile)
    for (const char* ending : c_endings)
      std::filesystem::remove(tile_file(point, PieceKind::tile, tile, ending), ignored);
}

bool Records::has_tiles(const DesignPoint& point) const {
  for (std::size_t tile = 0; tile < point.tiles().size(); ++tile)
    if (!has_tile(point, PieceKind::reference_tile, tile) ||
        (is_drawn(point.method) && !has_tile(point, PieceKind::tile, tile)))
      return false;
  return true;
}

void Records::add_reference(const DesignPoint& point, std::size_t tile, const Reference& reference) const {
  const auto& [frame, mask] = reference.image;
  add_files(tile_file(point, PieceKind::reference_tile, tile, ""), frame,
            to_picture(frame.size, mask, reference.highlight), Json::object());
}

void Records::add_drawing(const DesignPoint& point, std::size_t tile, const Drawing& drawing) const {
  Json json = {{"hardware", drawing.hardware}};
  for_each_count(drawing, [&](const char* name, std::uint64_t count) { json[name] = count; });
  add_files(tile_file(point, PieceKind::tile, tile, ""), drawing.frame,
            to_picture(drawing.frame.size, drawing.mask, {}), json);
}

std::pair<Frame, Frame> Records::put_together(const DesignPoint& point, PieceKind kind) const {
  Frame colours(point.size), masks(point.size);
  const std::vector<Tile> tiles = point.tiles();
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    put_tile(colours, read_tile(tile_file(point, kind, i, c_colours), tiles[i].size), tiles[i]);
    put_tile(masks, read_tile(tile_file(point, kind, i, c_masks), tiles[i].size), tiles[i]);
  }
  return {std::move(colours), std::move(masks)};
}

Reference Records::reference(const DesignPoint& point) const {
  auto [colours, masks] = put_together(point, PieceKind::reference_tile);
  return {{std::move(colours), mask_of(masks, 0)}, mask_of(masks, 1)};
}

Drawing Records::drawing(const DesignPoint& point) const {
  auto [colours, masks] = put_together(point, PieceKind::tile);
  Drawing drawing;
  drawing.frame = std::move(colours);
  if (point.method != Method::gouraud) drawing.mask = mask_of(masks, 0);
  for (std::size_t tile = 0; tile < point.tiles().size(); ++tile)
    add_figures(tile_file(point, PieceKind::tile, tile, c_figures), drawing);
  return drawing;
}

}  // namespace halfway::study
