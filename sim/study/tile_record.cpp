// SPDX-License-Identifier: Apache-2.0
#include "sim/study/tile_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "sim/pictures/image.hpp"
#include "sim/study/figures.hpp"
#include "sim/study/sealed.hpp"
#include "sim/system/file.hpp"

namespace halfway::study {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* c_colours = ".png";
constexpr const char* c_masks = "-mask.png";  // red: covered, green: in a highlight
constexpr const char* c_figures = ".json";    // written last
constexpr std::array c_endings = {c_colours, c_masks, c_figures};

// Identifies the tile that figures belong to.
Json label(const DesignPoint& point, PieceKind kind, std::size_t tile) {
  if (kind == PieceKind::reference_tile) return {{"picture", point.picture()}, {"tile", tile}};
  return {{"point", point.name()}, {"tile", tile}};
}

// Figures with their names. The sum over all tiles is the frame's figure.
template <class Counts, class Visit>
void for_each_count(Counts& d, const Visit& visit) {
  visit("fragments", d.fragments);
  visit("cycles", d.cycles);
  for_each_setup_figure(d.setup, visit);
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

Status add_files(const std::filesystem::path& stem, const Frame& colours, const Frame& masks, Json figures) {
  for (const auto& [ending, picture] : {std::pair{c_colours, &colours}, {c_masks, &masks}}) {
    const std::filesystem::path path = stem.string() + ending;
    if (Status added = write_png(path, *picture); !added) return added;
    const auto checksum = checksum_of(path);
    if (!checksum) return checksum.error();
    figures[ending] = *checksum;
  }
  return write_file(stem.string() + c_figures, sealed(std::move(figures)));
}

struct TileFiles {
  Json figures{};
  Frame colours{}, masks{};
  std::filesystem::path damaged{};  // the first damaged file; empty: none
};

// Read a tile. `label` is the expected identity in the figures.
Result<TileFiles> read_files(const std::filesystem::path& stem, FrameSize size, const Json& label) {
  TileFiles files;
  const std::filesystem::path figures = stem.string() + c_figures;
  const auto text = read_file(figures);
  auto json = text ? unsealed(*text) : std::nullopt;
  if (!json) return TileFiles{.damaged = figures};
  for (const auto& [key, value] : label.items())
    if (json->value(key, Json()) != value) return TileFiles{.damaged = figures};
  files.figures = std::move(*json);
  for (const auto& [ending, picture] : {std::pair{c_colours, &files.colours}, {c_masks, &files.masks}}) {
    const std::filesystem::path path = stem.string() + ending;
    const auto checksum = checksum_of(path);
    if (!checksum || files.figures.value(ending, "") != *checksum) return TileFiles{.damaged = path};
    auto frame = read_png(path);
    if (!frame) return frame.error();
    if (!(frame->size == size)) return TileFiles{.damaged = path};
    *picture = std::move(*frame);
  }
  return files;
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

Status TileRecords::add_reference(const DesignPoint& point, std::size_t tile,
                                  const Reference& reference) const {
  const auto& [frame, mask] = reference.image;
  return add_files(file(point, PieceKind::reference_tile, tile, ""), frame,
                   to_picture(frame.size, mask, reference.highlight),
                   label(point, PieceKind::reference_tile, tile));
}

Status TileRecords::add_drawing(const DesignPoint& point, std::size_t tile, const Drawing& drawing) const {
  Json json = label(point, PieceKind::tile, tile);
  json["hardware"] = drawing.hardware;
  for_each_count(drawing, [&](const char* name, std::uint64_t count) { json[name] = count; });
  return add_files(file(point, PieceKind::tile, tile, ""), drawing.frame,
                   to_picture(drawing.frame.size, drawing.mask, {}), std::move(json));
}

struct TileRecords::Whole {
  Frame colours, masks;
  std::vector<Json> figures{};  // one per tile
};

Result<TileRecords::Whole> TileRecords::put_together(const DesignPoint& point, PieceKind kind,
                                                     const Redraw& redraw) const {
  Whole whole{Frame(point.size), Frame(point.size)};
  const std::vector<Tile> tiles = point.tiles();
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    const auto read = [&] {
      return read_files(file(point, kind, i, ""), tiles[i].size, label(point, kind, i));
    };
    auto files = read();
    if (files && !files->damaged.empty()) {
      if (Status drawn = redraw(i, files->damaged); !drawn) return drawn.error();
      files = read();
      if (files && !files->damaged.empty())
        return tool_failed(files->damaged.string() + ": damaged as soon as it is written; try another disk");
    }
    if (!files) return files.error();
    put_tile(whole.colours, files->colours, tiles[i]);
    put_tile(whole.masks, files->masks, tiles[i]);
    whole.figures.push_back(std::move(files->figures));
  }
  return whole;
}

Result<Reference> TileRecords::reference(const DesignPoint& point, const Redraw& redraw) const {
  auto whole = put_together(point, PieceKind::reference_tile, redraw);
  if (!whole) return whole.error();
  return Reference{{std::move(whole->colours), mask_of(whole->masks, 0)}, mask_of(whole->masks, 1)};
}

Result<Drawing> TileRecords::drawing(const DesignPoint& point, const Redraw& redraw) const {
  auto whole = put_together(point, PieceKind::tile, redraw);
  if (!whole) return whole.error();
  Drawing drawing{.frame = std::move(whole->colours)};
  if (point.method != Method::gouraud) drawing.mask = mask_of(whole->masks, 0);
  for (const Json& figures : whole->figures) {
    figures.at("hardware").get_to(drawing.hardware);
    for_each_count(
        drawing, [&](const char* name, std::uint64_t& sum) { sum += figures.at(name).get<std::uint64_t>(); });
  }
  return drawing;
}

}  // namespace halfway::study
