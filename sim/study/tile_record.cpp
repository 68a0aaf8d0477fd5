// SPDX-License-Identifier: Apache-2.0
#include "sim/study/tile_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <span>
#include <vector>

#include "sim/files/image.hpp"
#include "sim/os/file.hpp"
#include "sim/os/must.hpp"
#include "sim/study/figures.hpp"

namespace halfway::study {
namespace {

using Json = nlohmann::ordered_json;

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

std::filesystem::path TileRecords::file(const DesignPoint& point, PieceKind kind, std::size_t tile,
                                        const char* ending) const {
  const std::string name = kind == PieceKind::reference_tile ? "reference, " + point.picture() : point.name();
  return folder_ / fmt::format("{}-tile-{}{}", record_name(provenance_, name), tile, ending);
}

bool TileRecords::has(const DesignPoint& point, PieceKind kind, std::size_t tile) const {
  return std::ranges::all_of(c_endings, [&](const char* ending) {
    return std::filesystem::exists(file(point, kind, tile, ending));
  });
}

void TileRecords::remove_drawing(const DesignPoint& point) const {
  std::error_code ignored;
  for (std::size_t tile = 0; tile < point.tiles().size(); ++tile)
    for (const char* ending : c_endings)
      std::filesystem::remove(file(point, PieceKind::tile, tile, ending), ignored);
}

bool TileRecords::complete(const DesignPoint& point) const {
  for (std::size_t tile = 0; tile < point.tiles().size(); ++tile)
    if (!has(point, PieceKind::reference_tile, tile) ||
        (is_drawn(point.method) && !has(point, PieceKind::tile, tile)))
      return false;
  return true;
}

void TileRecords::add_reference(const DesignPoint& point, std::size_t tile,
                                const Reference& reference) const {
  const auto& [frame, mask] = reference.image;
  add_files(file(point, PieceKind::reference_tile, tile, ""), frame,
            to_picture(frame.size, mask, reference.highlight), Json::object());
}

void TileRecords::add_drawing(const DesignPoint& point, std::size_t tile, const Drawing& drawing) const {
  Json json = {{"hardware", drawing.hardware}};
  for_each_count(drawing, [&](const char* name, std::uint64_t count) { json[name] = count; });
  add_files(file(point, PieceKind::tile, tile, ""), drawing.frame,
            to_picture(drawing.frame.size, drawing.mask, {}), json);
}

std::pair<Frame, Frame> TileRecords::put_together(const DesignPoint& point, PieceKind kind) const {
  Frame colours(point.size), masks(point.size);
  const std::vector<Tile> tiles = point.tiles();
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    put_tile(colours, read_tile(file(point, kind, i, c_colours), tiles[i].size), tiles[i]);
    put_tile(masks, read_tile(file(point, kind, i, c_masks), tiles[i].size), tiles[i]);
  }
  return {std::move(colours), std::move(masks)};
}

Reference TileRecords::reference(const DesignPoint& point) const {
  auto [colours, masks] = put_together(point, PieceKind::reference_tile);
  return {{std::move(colours), mask_of(masks, 0)}, mask_of(masks, 1)};
}

Drawing TileRecords::drawing(const DesignPoint& point) const {
  auto [colours, masks] = put_together(point, PieceKind::tile);
  Drawing drawing;
  drawing.frame = std::move(colours);
  if (point.method != Method::gouraud) drawing.mask = mask_of(masks, 0);
  for (std::size_t tile = 0; tile < point.tiles().size(); ++tile)
    add_figures(file(point, PieceKind::tile, tile, c_figures), drawing);
  return drawing;
}

}  // namespace halfway::study
