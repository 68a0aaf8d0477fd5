// SPDX-License-Identifier: Apache-2.0
#include "study/tile_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <span>
#include <vector>

#include "common/file.hpp"
#include "frame/image.hpp"
#include "study/figures.hpp"

namespace halfway::study {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* c_colours = ".png";
constexpr const char* c_masks = "-mask.png";  // red: covered, green: in a highlight
constexpr const char* c_figures = ".json";    // written last
constexpr std::array c_endings = {c_colours, c_masks, c_figures};

// With their names. Those of all tiles add up to the frame's.
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

Status add_files(const std::filesystem::path& stem, const Frame& colours, const Frame& masks,
                 const Json& figures) {
  if (Status added = write_png(stem.string() + c_colours, colours); !added) return added;
  if (Status added = write_png(stem.string() + c_masks, masks); !added) return added;
  return write_file(stem.string() + c_figures, figures.dump(2) + "\n");
}

// A tile's picture, of the tile's size.
Result<Frame> read_tile(const std::filesystem::path& path, const Tile& tile) {
  auto frame = read_png(path);
  if (frame && !(frame->size == tile.size))
    return bad_input(fmt::format("{}: it is {} and not {}; remove it, and it is drawn anew", path.string(),
                                 to_string(frame->size), to_string(tile.size)));
  return frame;
}

Result<Json> read_figures(const std::filesystem::path& path) {
  const auto text = read_file(path);
  if (!text) return text.error();
  Json json = Json::parse(*text, nullptr, false);
  try {
    Drawing counts;
    static_cast<void>(json.at("hardware").get<std::string>());
    for_each_count(counts, [&](const char* name, std::uint64_t& count) { json.at(name).get_to(count); });
  } catch (const Json::exception&) {
    return bad_input(path.string() + ": it is no tile's; remove it, and the tile is drawn anew");
  }
  return json;
}

// What `read` makes of a tile's file, which is drawn anew where it is damaged.
template <class Read>
auto read_whole(const std::filesystem::path& path, std::size_t tile, const TileRecords::Redraw& redraw,
                const Read& read) -> decltype(read(path)) {
  auto found = read(path);
  if (found || found.error().code != ExitCode::bad_input) return found;
  if (Status drawn = redraw(tile, path); !drawn) return drawn.error();
  return read(path);
}

}  // namespace

std::string TileRecords::reference_name(const DesignPoint& point) const {
  return record_name(provenance_, "reference, " + point.picture());
}
std::string TileRecords::drawing_name(const DesignPoint& point) const {
  return record_name(provenance_, point);
}

std::filesystem::path TileRecords::file(const std::string& name, std::size_t tile, const char* ending) const {
  return folder_ / fmt::format("{}-tile-{}{}", name, tile, ending);
}

bool TileRecords::has(const std::string& name, std::size_t tile) const {
  return std::ranges::all_of(
      c_endings, [&](const char* ending) { return std::filesystem::exists(file(name, tile, ending)); });
}

bool TileRecords::has_reference(const DesignPoint& point, std::size_t tile) const {
  return has(reference_name(point), tile);
}
bool TileRecords::has_drawing(const DesignPoint& point, std::size_t tile) const {
  return has(drawing_name(point), tile);
}

void TileRecords::remove_drawing(const DesignPoint& point) const {
  std::error_code ignored;
  for (std::size_t tile = 0; tile < point.tiles().size(); ++tile)
    for (const char* ending : c_endings)
      std::filesystem::remove(file(drawing_name(point), tile, ending), ignored);
}

bool TileRecords::complete(const DesignPoint& point) const {
  for (std::size_t tile = 0; tile < point.tiles().size(); ++tile)
    if (!has_reference(point, tile) || (is_drawn(point.method) && !has_drawing(point, tile))) return false;
  return true;
}

Status TileRecords::add_reference(const DesignPoint& point, std::size_t tile,
                                  const Reference& reference) const {
  const auto& [frame, mask] = reference.image;
  return add_files(file(reference_name(point), tile, ""), frame,
                   to_picture(frame.size, mask, reference.highlight),
                   {{"picture", point.picture()}, {"tile", tile}});
}

Status TileRecords::add_drawing(const DesignPoint& point, std::size_t tile, const Drawing& drawing) const {
  Json json = {{"point", point.name()}, {"tile", tile}, {"hardware", drawing.hardware}};
  for_each_count(drawing, [&](const char* name, std::uint64_t count) { json[name] = count; });
  return add_files(file(drawing_name(point), tile, ""), drawing.frame,
                   to_picture(drawing.frame.size, drawing.mask, {}), json);
}

Result<Frame> TileRecords::put_together(const DesignPoint& point, const std::string& name, const char* ending,
                                        const Redraw& redraw) const {
  Frame whole(point.size);
  const std::vector<Tile> tiles = point.tiles();
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    const auto picture = read_whole(file(name, i, ending), i, redraw,
                                    [&](const auto& path) { return read_tile(path, tiles[i]); });
    if (!picture) return picture.error();
    put_tile(whole, *picture, tiles[i]);
  }
  return whole;
}

Result<Reference> TileRecords::reference(const DesignPoint& point, const Redraw& redraw) const {
  Reference whole;
  auto colours = put_together(point, reference_name(point), c_colours, redraw);
  if (!colours) return colours.error();
  const auto masks = put_together(point, reference_name(point), c_masks, redraw);
  if (!masks) return masks.error();
  whole.image.frame = std::move(*colours);
  whole.image.mask = mask_of(*masks, 0);
  whole.highlight = mask_of(*masks, 1);
  return whole;
}

Result<Drawing> TileRecords::drawing(const DesignPoint& point, const Redraw& redraw) const {
  Drawing whole;
  auto colours = put_together(point, drawing_name(point), c_colours, redraw);
  if (!colours) return colours.error();
  const auto masks = put_together(point, drawing_name(point), c_masks, redraw);
  if (!masks) return masks.error();
  whole.frame = std::move(*colours);
  if (in_hardware(point.method)) whole.mask = mask_of(*masks, 0);
  for (std::size_t i = 0; i < point.tiles().size(); ++i) {
    const auto figures = read_whole(file(drawing_name(point), i, c_figures), i, redraw, read_figures);
    if (!figures) return figures.error();
    figures->at("hardware").get_to(whole.hardware);
    for_each_count(
        whole, [&](const char* name, std::uint64_t& sum) { sum += figures->at(name).get<std::uint64_t>(); });
  }
  return whole;
}

}  // namespace halfway::study
