// SPDX-License-Identifier: Apache-2.0
// Implementation of image_library.hpp. Only this file includes OpenImageIO.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <cstdint>
#include <exception>
#include <memory>

#include "sim/files/image_library.hpp"

namespace halfway {
namespace {

Result<std::vector<unsigned char>> encoded(const std::string& path, const Frame& frame, bool quick) {
  std::vector<unsigned char> bytes;
  const auto failed = [&](const std::string& why) {
    return tool_failed(
        fmt::format("{}: OpenImageIO cannot encode the PNG ({}); check its installation", path, why));
  };
  try {
    OIIO::Filesystem::IOVecOutput memory(bytes);
    const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create("png", &memory);
    if (!output) return failed(OIIO::geterror());
    if (!output->set_ioproxy(&memory)) return failed("it does not encode to memory");
    OIIO::ImageSpec spec(static_cast<int>(frame.size.width), static_cast<int>(frame.size.height), 3,
                         OIIO::TypeDesc::UINT8);
    if (quick) {
      constexpr int c_filter_up = 0x20;  // PNG_FILTER_UP
      spec.attribute("png:compressionLevel", 1);
      spec.attribute("png:filter", c_filter_up);
    }
    if (!output->open(path, spec) || !output->write_image(OIIO::TypeDesc::UINT8, frame.rgb.data()) ||
        !output->close())
      return failed(output->geterror());
  } catch (const std::exception& e) {
    return failed(e.what());
  }
  return bytes;
}

Result<Frame> decoded(const std::string& path) {
  const auto unreadable = [&](const std::string& why) {
    return bad_input(fmt::format("{}: cannot be read as a PNG ({}); render it again", path, why));
  };
  try {
    const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::create("png");
    if (!input)
      return tool_failed(fmt::format("{}: OpenImageIO has no PNG reader ({}); check its installation", path,
                                     OIIO::geterror()));
    OIIO::ImageSpec spec;
    if (!input->open(path, spec)) return unreadable(input->geterror());
    if (spec.nchannels != 3 || spec.format != OIIO::TypeDesc::UINT8)
      return unreadable(
          fmt::format("{} channels of {}, not 3 of 8 bits", spec.nchannels, spec.format.c_str()));
    const auto fits = [](int side) {
      return side > 0 && static_cast<std::uint32_t>(side) <= c_max_frame_side;
    };
    if (!fits(spec.width) || !fits(spec.height))
      return unreadable(fmt::format("{}x{} pixels, not up to {}", spec.width, spec.height, c_max_frame_side));
    Frame frame({static_cast<std::uint32_t>(spec.width), static_cast<std::uint32_t>(spec.height)});
    if (!input->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT8, frame.rgb.data()))
      return unreadable(input->geterror());
    return frame;
  } catch (const std::exception& e) {
    return unreadable(e.what());
  }
}

}  // namespace

void halfway_encode_png(const std::string& path, const Frame& frame, bool quick,
                        Result<std::vector<unsigned char>>& bytes) {
  bytes = encoded(path, frame, quick);
}

void halfway_decode_png(const std::string& path, Result<Frame>& frame) {
  frame = decoded(path);
}

void halfway_image_versions(std::string& text) {
  const int version = OIIO::openimageio_version();
  text = fmt::format("OpenImageIO {}.{}.{}", version / 10000, version / 100 % 100, version % 100);
}

}  // namespace halfway
