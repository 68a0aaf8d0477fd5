// SPDX-License-Identifier: Apache-2.0
#include "sim/pictures/perception.hpp"

#include <vector>

#include "sim/pictures/image_library.hpp"

namespace halfway {
namespace {

constexpr float c_luminance = 100.0F;  // cd/m2, of white
constexpr float c_field = 45.0F;       // field of view in degrees

std::vector<float> brightness(const Frame& frame) {
  std::vector<float> values(frame.pixels());
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] =
        static_cast<float>(frame.rgb[3 * i] + frame.rgb[3 * i + 1] + frame.rgb[3 * i + 2]) / (3.0F * 255.0F);
  return values;
}

}  // namespace

Result<std::uint64_t> perceived_pixels(const Frame& a, const Frame& b) {
  if (a.size.width != b.size.width || a.size.height != b.size.height)
    return bad_input("the frames have different sizes");
  if (a.rgb.empty()) return std::uint64_t{0};
  const auto library = image_library();
  if (!library) return library.error();
  const long seen = library->seen_by_yee(brightness(a), brightness(b), a.size, c_luminance, c_field);
  if (seen < 0) return tool_failed("OpenImageIO: compare_Yee failed");
  return static_cast<std::uint64_t>(seen);
}

}  // namespace halfway
