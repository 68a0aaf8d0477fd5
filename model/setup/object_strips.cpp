// SPDX-License-Identifier: Apache-2.0
#include "setup/object_strips.hpp"

#include <algorithm>
#include <bit>
#include <numeric>
#include <utility>

#include "words/formats.hpp"

namespace halfway {
namespace {

using Items = std::vector<std::uint32_t>;

class Cutter {
 public:
  Cutter(std::span<const StripItem> items, int unit_bits, FrameSize frame, const ObjectChain& chain)
      : items_(items), unit_bits_(unit_bits), frame_(frame), chain_(chain) {}

  ObjectStrips cut() {
    Items all(items_.size());
    std::iota(all.begin(), all.end(), 0U);
    halve(all, {0, frame_.width});
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

  // The pixels in which an item may cover something.
  Columns columns_of(std::uint32_t item) const {
    const auto& p = items_[item];
    const auto [left, right] = std::minmax({p[0].x, p[1].x, p[2].x});
    return {std::int64_t{left} >> unit_bits_, (std::int64_t{right} >> unit_bits_) + 1};
  }

  // Draws the columns [begin, end) of the frame.
  void halve(const Items& from, Columns columns) {
    Items items;
    Columns bounds{columns.end, columns.begin};
    for (const std::uint32_t item : from) {
      const Columns own = columns_of(item);
      const Columns drawn{own.begin, own.end + (chain_.filtered() ? 1 : 0)};
      if (drawn.begin >= columns.end || drawn.end <= columns.begin) continue;
      items.push_back(item);
      bounds.begin = std::min(bounds.begin, drawn.begin);
      bounds.end = std::max(bounds.end, drawn.end);
    }
    if (items.empty()) return;
    columns = {std::max(columns.begin, bounds.begin), std::min(columns.end, bounds.end)};
    const std::uint32_t left = scanned_from(columns.begin);
    const Tile area{left, 0, {static_cast<std::uint32_t>(columns.end) - left, frame_.height}};
    const Lines lines = count(items, area);
    const std::uint32_t most = *std::max_element(lines.begin(), lines.end());
    const bool fits = most <= chain_.processors && area.size.width <= chain_.most_columns;
    if (!fits && columns.width() > 1) {
      const std::int64_t middle = columns.begin + columns.width() / 2;
      halve(items, {columns.begin, middle});
      halve(items, {middle, columns.end});
      return;
    }
    result_.processors = std::max(result_.processors, most);
    add_runs(items, area, lines);
  }

  Lines count(const Items& items, const Tile& area) const {
    Lines change(area.size.height + 1, 0);
    for (const std::uint32_t item : items)
      for (const Walk& walk : strip_walks(items_[item], unit_bits_, area, chain_.side)) {
        const PixelLines lines = pixel_lines(walk, chain_.side);
        ++change[static_cast<std::size_t>(lines.begin)];
        --change[static_cast<std::size_t>(lines.end)];
      }
    std::partial_sum(change.begin(), change.end(), change.begin());
    return change;
  }

  // One strip for each run of lines with an item, or more if it is too high.
  void add_runs(const Items& items, const Tile& area, const Lines& lines) {
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
        add(items, {area.x, top, {area.size.width, std::min(end, y + most) - top}});
      }
    }
  }

  void add(const Items& items, const Tile& area) {
    ObjectStrip strip{area, {}};
    for (const std::uint32_t item : items)
      if (!strip_walks(items_[item], unit_bits_, area, chain_.side).empty()) strip.items.push_back(item);
    result_.strips.push_back(std::move(strip));
  }

  std::span<const StripItem> items_;
  int unit_bits_;
  FrameSize frame_;
  ObjectChain chain_;
  ObjectStrips result_;
};

}  // namespace

ObjectStrips cut_strips(std::span<const StripItem> items, int unit_bits, FrameSize frame,
                        const ObjectChain& chain) {
  return Cutter(items, unit_bits, frame, chain).cut();
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
