// SPDX-License-Identifier: Apache-2.0
#include "frame/perception.hpp"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>

#include <vector>

namespace halfway {
namespace {

constexpr float c_luminance = 100.0F;  // cd/m2 of white
constexpr float c_field = 45.0F;       // degrees

OIIO::ImageBuf brightness(const Frame& frame) {
  OIIO::ImageBuf image(OIIO::ImageSpec(static_cast<int>(frame.size.width),
                                       static_cast<int>(frame.size.height), 1, OIIO::TypeDesc::FLOAT));
  std::vector<float> values(frame.pixels());
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] =
        static_cast<float>(frame.rgb[3 * i] + frame.rgb[3 * i + 1] + frame.rgb[3 * i + 2]) / (3.0F * 255.0F);
  image.set_pixels(OIIO::ROI::All(), OIIO::TypeDesc::FLOAT, values.data());
  return image;
}

}  // namespace

Result<std::uint64_t> perceived_pixels(const Frame& a, const Frame& b) {
  if (a.size.width != b.size.width || a.size.height != b.size.height)
    return bad_input("the frames have different sizes");
  if (a.rgb.empty()) return std::uint64_t{0};
  OIIO::ImageBufAlgo::CompareResults results;
  const int seen =
      OIIO::ImageBufAlgo::compare_Yee(brightness(a), brightness(b), results, c_luminance, c_field, {}, 1);
  if (seen < 0) return tool_failed("OpenImageIO: compare_Yee failed");
  return static_cast<std::uint64_t>(seen);
}

}  // namespace halfway
