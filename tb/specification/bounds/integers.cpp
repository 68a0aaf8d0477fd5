// SPDX-License-Identifier: Apache-2.0
// Formats of whole numbers: the largest number that the program can store, compared with the stated bound.
#include <fmt/format.h>

#include <bit>

#include "frame/frame.hpp"
#include "plan/plan.hpp"
#include "projection/project.hpp"
#include "registry.hpp"
#include "setup/walk.hpp"
#include "words/processors_layout.hpp"
#include "words/word.hpp"

namespace halfway::bounds {
namespace {

// The largest number is a limit that other code defines by name.
Check limit(std::string_view preset, std::string_view name, double largest, const std::string& where,
            std::string_view roomy = {}) {
  return {preset,
          name,
          "",
          "the program's own limits",
          [=](const Context&, const Stated&) {
            return Finding{.worst = largest, .where = where, .proved = largest};
          },
          roomy};
}

constexpr std::int32_t c_unit = 16, c_side = static_cast<std::int32_t>(c_max_frame_side);

// The largest pixel coordinate of a walk, for triangles that fill the largest frame or extend beyond it.
Finding largest_pixel(const Context&, const Stated& stated) {
  Finding finding;
  const auto see = [&](std::int64_t pixel, const char* what, std::array<ScreenPoint, 3> p) {
    if (pixel < -(std::int64_t{1} << stated.format.integer_bits) ||
        pixel >= std::int64_t{1} << stated.format.integer_bits)
      finding.failure = fmt::format("{} is not clamped", pixel);
    if (std::abs(static_cast<double>(pixel)) <= finding.worst) return;
    finding.worst = std::abs(static_cast<double>(pixel));
    finding.where = fmt::format("{}, triangle ({}, {}) ({}, {}) ({}, {}) / 16", what, p[0].x, p[0].y, p[1].x,
                                p[1].y, p[2].x, p[2].y);
  };
  constexpr std::int32_t c_ends[] = {c_guard_begin * c_unit, 0, 8, c_side * c_unit, c_guard_end * c_unit};
  for (const std::int32_t ax : c_ends)
    for (const std::int32_t bx : c_ends)
      for (const std::int32_t cx : c_ends)
        for (const std::int32_t by : c_ends) {
          const std::array<ScreenPoint, 3> p = {{{ax, c_ends[0]}, {bx, by}, {cx, c_ends[4]}}};
          for (const Walk& walk : plan_walks(p, 4, FrameSize{c_max_frame_side, c_max_frame_side})) {
            see(walk.start.pixel, "a start", p);
            see(walk.upper.pixel, "a stop", p);
            if (walk.lower_lines > 0) see(walk.lower.pixel, "a stop", p);
          }
        }
  finding.proved = finding.worst;  // setup clamps a pixel to the frame's sides
  return finding;
}

// The divisor is the edge's height.
Finding largest_divisor(const Context&, const Stated& stated) {
  const std::int32_t top = c_guard_begin * c_unit, bottom = c_guard_end * c_unit;
  const std::array<ScreenPoint, 3> p = {{{top, top}, {top + 16, bottom}, {bottom, bottom}}};
  Finding finding;
  for (const Walk& walk : plan_walks(p, 4, FrameSize{c_max_frame_side, c_max_frame_side}))
    for (const EdgeSection& s : {walk.start, walk.upper, walk.lower})
      finding.worst = std::max({finding.worst, static_cast<double>(s.divisor), static_cast<double>(s.error)});
  finding.where = "an edge from line -2048 to 6143";
  finding.proved = (c_guard_end - c_guard_begin) * double{c_unit};
  if (finding.proved >= std::ldexp(1.0, stated.format.integer_bits)) finding.failure = "it is not clamped";
  return finding;
}

}  // namespace

std::vector<Check> integer_checks() {
  std::vector<Check> checks = {
      limit("both", "flag", 1, "one bit"),
      limit("both", "triangle", std::ldexp(1.0, 8 * sizeof(std::uint32_t)) - 1, "a tag of 32 bits"),
      limit("both", "pixel_x", c_side - 1, "c_max_frame_side"),
      limit("both", "pixel_y", c_side - 1, "c_max_frame_side"),
      limit("both", "lines", c_side, "c_max_frame_side"),
      {"both", "span_x", "", "triangles about the guard band, walked", largest_pixel},
      limit("both", "command", static_cast<double>(words::Command::shadow), "Command::shadow"),
      limit("both", "light", c_most_lights, "c_most_lights"),
      limit("both", "shadow_count",
            static_cast<double>(words::low_bits(~0ULL, words::Exact::c_shadow_count_bits - 1)),
            "setup limits the volumes around the eye"),
      {"exact", "edge_error", "", "an edge with the height of the guard band", largest_divisor,
       "17 bits suffice"},
      {"exact", "edge_x", "", "triangles about the guard band, walked", largest_pixel},
      limit("exact", "power", std::countr_zero(16U), "cos^16 is word 4"),
      limit("exact", "light_shift",
            static_cast<double>(words::low_bits(~0ULL, words::Exact::c_light_shift_bits)),
            "setup draws lights farther away as directional"),
      limit("published", "offset", 4 - std::ldexp(1.0, -words::Published::c_offset_fraction_bits),
            "the eye's vector at its largest, a light's place at 1, a point at -1"),
      limit("published", "edge_error", 0, "no bits"),
      limit("published", "power", 0, "no bits"),
      limit("published", "light_shift", 0, "no bits"),
  };
  return checks;
}

}  // namespace halfway::bounds
