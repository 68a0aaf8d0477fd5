// SPDX-License-Identifier: Apache-2.0
#include "setup/walk.hpp"

#include <algorithm>
#include <utility>

namespace halfway {
namespace {

// Position of an edge's pixel on the lines of an interval. Outside the frame it is clamped to the frame's
// side.
enum class Clamped { left, no, right };

struct Interval {
  std::int64_t begin, end;  // lines
  Clamped clamped;
  const Edge* edge;
};

// First line of [begin, end) for which `holds` is true. `holds` changes at most once, from false to true.
template <class Holds>
std::int64_t first_where(std::int64_t begin, std::int64_t end, Holds&& holds) {
  while (begin < end) {
    const std::int64_t middle = begin + (end - begin) / 2;
    if (holds(middle))
      end = middle;
    else
      begin = middle + 1;
  }
  return begin;
}

// Up to three intervals of each of two edges.
using Intervals = FixedVector<Interval, 6>;

// Splits the lines [begin, end) of an edge by its position. The pixel moves in one direction only, so there
// are at most three parts.
void split(const Edge& edge, std::int64_t begin, std::int64_t end, std::int64_t width, Intervals& out) {
  const bool to_right = edge.dx() >= 0;
  const auto left = [&](std::int64_t y) { return edge.pixel(y) < 0; };
  const auto right = [&](std::int64_t y) { return edge.pixel(y) > width; };
  const auto first = [&](std::int64_t y) { return to_right ? !left(y) : !right(y); };
  const auto last = [&](std::int64_t y) { return to_right ? right(y) : left(y); };
  const std::int64_t a = first_where(begin, end, first);
  const std::int64_t b = first_where(a, end, last);
  if (begin < a) out.push_back({begin, a, to_right ? Clamped::left : Clamped::right, &edge});
  if (a < b) out.push_back({a, b, Clamped::no, &edge});
  if (b < end) out.push_back({b, end, to_right ? Clamped::right : Clamped::left, &edge});
}

EdgeSection section(const Interval& interval, std::int64_t begin, std::int64_t end, std::int64_t width) {
  EdgeSection s;
  if (interval.clamped != Clamped::no) {
    s.pixel = interval.clamped == Clamped::left ? 0 : width;
    return s;
  }
  const Edge::State at = interval.edge->at(begin);
  s.pixel = at.pixel;
  if (end - begin < 2)
    return s;  // never stepped; only an edge that is stepped is tall enough for its quotient to fit
  const auto [quotient, remainder] = floor_divide(interval.edge->dx(), interval.edge->dy());
  s.quotient = quotient;
  s.remainder = remainder;
  s.divisor = interval.edge->dy();
  s.carry = at.error < remainder;
  s.error = at.error - remainder + (s.carry ? s.divisor : 0);
  return s;
}

// Number of steps with an extra pixel among the section's first `steps` steps.
std::int64_t carries_of(const EdgeSection& s, std::int64_t steps) {
  const std::int64_t error = s.error + s.remainder - (s.carry ? s.divisor : 0);  // before the first step
  return ceil_divide(steps * s.remainder - error, s.divisor);
}

std::int64_t pixel_of(const EdgeSection& s, std::int64_t steps) {
  return s.pixel + steps * s.quotient + carries_of(s, steps);
}

// A run of lines on which each edge stays in one interval.
struct Run {
  std::int64_t begin, end;
  const Interval *start, *stop;
};

}  // namespace

Walks plan_walks(std::array<ScreenPoint, 3> p, int unit_bits, FrameSize frame) {
  if (p[1].y < p[0].y) std::swap(p[0], p[1]);
  if (p[2].y < p[0].y) std::swap(p[0], p[2]);
  if (p[2].y < p[1].y) std::swap(p[1], p[2]);
  const std::int64_t height = frame.height, width = frame.width;
  std::int64_t begin = std::clamp(first_line(p[0].y, unit_bits), std::int64_t{0}, height);
  std::int64_t end = std::clamp(first_line(p[2].y, unit_bits), std::int64_t{0}, height);
  const std::int64_t middle = std::clamp(first_line(p[1].y, unit_bits), begin, end);
  Walks walks;
  if (begin >= end) return walks;

  // If the middle vertex is to the right of the long edge, spans run forward.
  const std::int64_t side = (std::int64_t{p[1].x} - p[0].x) * (std::int64_t{p[2].y} - p[0].y) -
                            (std::int64_t{p[2].x} - p[0].x) * (std::int64_t{p[1].y} - p[0].y);
  if (side == 0) return walks;
  const bool backward = side < 0;
  const Edge edge_long(p[0], p[2], unit_bits);
  const Edge edge_upper = p[0].y < p[1].y ? Edge(p[0], p[1], unit_bits) : edge_long;
  const Edge edge_lower = p[1].y < p[2].y ? Edge(p[1], p[2], unit_bits) : edge_long;

  const auto covers = [&](std::int64_t y) {
    const std::int64_t a = std::clamp(edge_long.pixel(y), std::int64_t{0}, width);
    const std::int64_t b =
        std::clamp((y < middle ? edge_upper : edge_lower).pixel(y), std::int64_t{0}, width);
    return a != b;
  };
  while (begin < end && !covers(begin)) ++begin;
  while (begin < end && !covers(end - 1)) --end;

  // No edge of a triangle between the frame's sides is split.
  const auto [left, right] = std::minmax({p[0].x, p[1].x, p[2].x});
  const bool inside = left >= 0 && right <= width << unit_bits;
  Intervals starts, stops;
  const auto add = [&](const Edge& edge, std::int64_t first, std::int64_t last, Intervals& out) {
    if (first >= last) return;
    if (inside)
      out.push_back({first, last, Clamped::no, &edge});
    else
      split(edge, first, last, width, out);
  };
  add(edge_long, begin, end, starts);
  add(edge_upper, begin, std::min(middle, end), stops);
  add(edge_lower, std::max(middle, begin), end, stops);

  FixedVector<Run, 8> runs;  // each ends with an interval: at most 3 + 6, and the last ends with two
  for (std::size_t i = 0, j = 0; i < starts.size() && j < stops.size();) {
    const std::int64_t run_begin = std::max(starts[i].begin, stops[j].begin);
    const std::int64_t run_end = std::min(starts[i].end, stops[j].end);
    const bool outside = starts[i].clamped != Clamped::no && starts[i].clamped == stops[j].clamped;
    if (!outside) runs.push_back({run_begin, run_end, &starts[i], &stops[j]});
    if (starts[i].end == run_end) ++i;
    if (stops[j].end == run_end) ++j;
  }

  // One walk contains consecutive runs with one interval of the start edge and at most two of the stop edge.
  for (std::size_t i = 0; i < runs.size();) {
    const bool pair =
        i + 1 < runs.size() && runs[i + 1].begin == runs[i].end && runs[i + 1].start == runs[i].start;
    const std::int64_t last = pair ? runs[i + 1].end : runs[i].end;
    Walk walk;
    walk.y = runs[i].begin;
    walk.upper_lines = runs[i].end - runs[i].begin;
    walk.backward = backward;
    walk.start = section(*runs[i].start, runs[i].begin, last, width);
    walk.upper = section(*runs[i].stop, runs[i].begin, runs[i].end, width);
    if (pair) {
      walk.lower_lines = runs[i + 1].end - runs[i + 1].begin;
      walk.lower = section(*runs[i + 1].stop, runs[i + 1].begin, runs[i + 1].end, width);
    }
    if (backward) {
      // A backward span covers [stop, start) from the right: its first pixel is start - 1, its end stop - 1.
      --walk.start.pixel;
      --walk.upper.pixel;
      --walk.lower.pixel;
    }
    walks.push_back(walk);
    i += pair ? 2 : 1;
  }
  return walks;
}

WalkLine line_of(const Walk& walk, std::int64_t y) {
  WalkLine line;
  line.steps = y - walk.y;
  line.carries = carries_of(walk.start, line.steps);
  const bool upper = line.steps < walk.upper_lines;
  line.walk.y = y;
  line.walk.upper_lines = 1;
  line.walk.backward = walk.backward;
  line.walk.start.pixel = pixel_of(walk.start, line.steps);
  line.walk.upper.pixel =
      upper ? pixel_of(walk.upper, line.steps) : pixel_of(walk.lower, line.steps - walk.upper_lines);
  return line;
}

Walks plan_walks(std::array<ScreenPoint, 3> points, int unit_bits, Columns columns, std::uint32_t height) {
  for (ScreenPoint& p : points) p.x -= static_cast<std::int32_t>(columns.begin << unit_bits);
  Walks walks = plan_walks(points, unit_bits, FrameSize{static_cast<std::uint32_t>(columns.width()), height});
  for (Walk& walk : walks)
    for (EdgeSection* section : {&walk.start, &walk.upper, &walk.lower}) section->pixel += columns.begin;
  return walks;
}

}  // namespace halfway
