// SPDX-License-Identifier: Apache-2.0
#include "setup/object_strips.hpp"

#include <algorithm>
#include <bit>
#include <functional>
#include <numeric>
#include <utility>

#include "words/formats.hpp"

namespace halfway {
namespace {

using Items = std::vector<std::uint32_t>;

class Cutter {
 public:
  Cutter(std::span<const StripItem> objects, std::span<const StripItem> shadows, int unit_bits,
         FrameSize frame, const ObjectChain& chain)
      : objects_(objects), shadows_(shadows), unit_bits_(unit_bits), frame_(frame), chain_(chain) {}

  ObjectStrips cut() {
    Items objects(objects_.size()), shadows(shadows_.size());
    std::iota(objects.begin(), objects.end(), 0U);
    std::iota(shadows.begin(), shadows.end(), 0U);
    halve(objects, shadows, {0, frame_.width});
    return std::move(result_);
  }

 private:
  // The walks on each line of the frame.
  using Lines = std::vector<std::uint32_t>;

  // The column or line before the first one is scanned for the filter.
  std::uint32_t scanned_from(std::int64_t first) const {
    return static_cast<std::uint32_t>(chain_.filtered() && first > 0 ? first - 1 : first);
  }
  // The pixel after the last one is drawn by the filter.
  std::uint32_t drawn_to(std::int64_t end, std::uint32_t limit) const {
    return std::min(static_cast<std::uint32_t>(end) + (chain_.filtered() ? 1U : 0U), limit);
  }

  // The items that may draw something in the columns, and the columns in which an item may.
  Items in_columns(std::span<const StripItem> items, const Items& from, const Columns& columns) const {
    Items inside;
    for (const std::uint32_t item : from)
      if (const Columns drawn = drawn_by(items[item]); drawn.begin < columns.end && drawn.end > columns.begin)
        inside.push_back(item);
    return inside;
  }
  Columns drawn_by(const StripItem& p) const {
    const auto [left, right] = std::minmax({p[0].x, p[1].x, p[2].x});
    return {std::int64_t{left} >> unit_bits_,
            (std::int64_t{right} >> unit_bits_) + (chain_.filtered() ? 2 : 1)};
  }

  // Draws the columns [begin, end) of the frame.
  void halve(const Items& all_objects, const Items& all_shadows, Columns columns) {
    const Items objects = in_columns(objects_, all_objects, columns);
    if (objects.empty()) return;
    Columns bounds{columns.end, columns.begin};
    for (const std::uint32_t object : objects) {
      const Columns drawn = drawn_by(objects_[object]);
      bounds.begin = std::min(bounds.begin, drawn.begin);
      bounds.end = std::max(bounds.end, drawn.end);
    }
    columns = {std::max(columns.begin, bounds.begin), std::min(columns.end, bounds.end)};
    const Items shadows = in_columns(shadows_, all_shadows, columns);
    const std::uint32_t left = scanned_from(columns.begin);
    const Tile area{left, 0, {static_cast<std::uint32_t>(columns.end) - left, frame_.height}};
    const Lines objects_on_line = count(objects_, objects, area);
    const std::vector<Tile> runs = runs_of(objects_on_line, area);
    const Lines on_line = sum(objects_on_line, count(shadows_, shadows, area));
    std::uint32_t most = 0;
    for (const Tile& run : runs)
      most = std::max(most,
                      *std::max_element(on_line.begin() + run.y, on_line.begin() + run.y + run.size.height));
    const bool fits = most <= chain_.processors && area.size.width <= chain_.most_columns;
    if (!fits && columns.width() > 1) {
      const std::int64_t middle = columns.begin + columns.width() / 2;
      halve(objects, shadows, {columns.begin, middle});
      halve(objects, shadows, {middle, columns.end});
      return;
    }
    result_.processors = std::max(result_.processors, most);
    for (const Tile& run : runs)
      result_.strips.push_back(
          {run, with_a_walk(objects_, objects, run), with_a_walk(shadows_, shadows, run)});
  }

  static Lines sum(Lines a, const Lines& b) {
    std::transform(a.begin(), a.end(), b.begin(), a.begin(), std::plus<>());
    return a;
  }

  Lines count(std::span<const StripItem> items, const Items& which, const Tile& area) const {
    Lines change(area.size.height + 1, 0);
    for (const std::uint32_t item : which)
      for (const Walk& walk : strip_walks(items[item], unit_bits_, area, chain_.side)) {
        const PixelLines lines = pixel_lines(walk, chain_.side);
        ++change[static_cast<std::size_t>(lines.begin)];
        --change[static_cast<std::size_t>(lines.end)];
      }
    std::partial_sum(change.begin(), change.end(), change.begin());
    return change;
  }

  // One strip for each run of lines with an object, or more if it is too high.
  std::vector<Tile> runs_of(const Lines& lines, const Tile& area) const {
    std::vector<Tile> runs;
    const std::uint32_t most = chain_.most_lines - (chain_.filtered() ? 1 : 0);
    for (std::uint32_t y = 0; y < area.size.height;) {
      if (lines[y] == 0) {
        ++y;
        continue;
      }
      std::uint32_t end = y;
      while (lines[end] != 0) ++end;  // the last one, below the frame, is 0
      end = drawn_to(end, area.size.height);
      for (; y < end; y = std::min(end, y + most)) {
        const std::uint32_t top = scanned_from(y);
        runs.push_back({area.x, top, {area.size.width, std::min(end, y + most) - top}});
      }
    }
    return runs;
  }

  Items with_a_walk(std::span<const StripItem> items, const Items& which, const Tile& area) const {
    Items inside;
    for (const std::uint32_t item : which)
      if (!strip_walks(items[item], unit_bits_, area, chain_.side).empty()) inside.push_back(item);
    return inside;
  }

  std::span<const StripItem> objects_, shadows_;
  int unit_bits_;
  FrameSize frame_;
  ObjectChain chain_;
  ObjectStrips result_;
};

}  // namespace

ObjectStrips cut_strips(std::span<const StripItem> objects, std::span<const StripItem> shadows, int unit_bits,
                        FrameSize frame, const ObjectChain& chain) {
  return Cutter(objects, shadows, unit_bits, frame, chain).cut();
}

// A walk is limited to the lines on which its item covers the strip, but not to the strip's columns: cut
// there, an item would become two elements of a pixel. Ends of spans have 13 bits and a sign, and a step of
// an edge has, too, so the width is limited to what 13 bits hold.
Walks strip_walks(const StripItem& item, int unit_bits, const Tile& area, std::uint32_t side) {
  constexpr std::int64_t c_widest = (std::int64_t{1} << (words::Exact::c_span_x_bits - 1)) - 1;
  const int bits = unit_bits - std::countr_zero(side);
  const auto plan = [&](std::int64_t top, const Columns& columns, std::int64_t lines) {
    StripItem moved = item;
    for (ScreenPoint& p : moved) {
      p.x -= static_cast<std::int32_t>(area.x << unit_bits);
      p.y -= static_cast<std::int32_t>((area.y + top) << unit_bits);
    }
    return plan_walks(moved, bits, columns, static_cast<std::uint32_t>(lines * side));
  };
  const std::int64_t width = std::int64_t{area.size.width} * side;
  const Walks inside = plan(0, {0, width}, area.size.height);
  if (inside.empty()) return inside;
  const std::int64_t top = pixel_lines(inside.front(), side).begin,
                     end = pixel_lines(inside.back(), side).end;
  const std::int64_t margin = std::max<std::int64_t>(0, c_widest - width) / 2;
  Walks walks = plan(top, {-margin, width + margin}, end - top);
  for (Walk& walk : walks) walk.y += top * side;
  return walks;
}

}  // namespace halfway
