// SPDX-License-Identifier: Apache-2.0
#include "sim/figures/rings.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "common/to_integer.hpp"

namespace halfway::figures {
namespace {

int blue(const Frame& frame, int x, int y) {
  return frame.rgb[frame.offset(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)) + 2];
}

}  // namespace

Rings measure_rings(const Frame& frame, const Frame& without_tables) {
  constexpr int c_spheres = 3, c_radius = 40, c_third = static_cast<int>(c_rings_frame.width) / c_spheres;
  Rings rings;
  double squares = 0.0;
  int count = 0;
  for (int sphere = 0; sphere < c_spheres; ++sphere) {
    int peak_x = 0, peak_y = 0;
    for (int y = c_radius; y < static_cast<int>(c_rings_frame.height) - c_radius; ++y)
      for (int x = sphere * c_third + c_radius; x < (sphere + 1) * c_third - c_radius; ++x)
        if (blue(without_tables, x, y) > blue(without_tables, peak_x, peak_y) || peak_x == 0)
          peak_x = x, peak_y = y;
    for (int dy = -c_radius; dy <= c_radius; ++dy) {
      const int y = peak_y + dy, half = to_integer<int>(std::sqrt(c_radius * c_radius - dy * dy));
      for (int x = peak_x - half; x <= peak_x + half; ++x) {
        rings.largest_step =
            std::max(rings.largest_step, std::abs(blue(frame, x + 1, y) - blue(frame, x, y)));
        const int error = std::abs(blue(frame, x, y) - blue(without_tables, x, y));
        squares += error * error;
        ++count;
      }
    }
  }
  rings.rms_error = std::sqrt(squares / count);
  return rings;
}

}  // namespace halfway::figures
