// SPDX-License-Identifier: Apache-2.0
// OpenImageIO, in a library of its own that is loaded where the first image is: with some 250 libraries
// behind it, it would cost every start of a program a quarter of a second of processor time.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/result.hpp"
#include "frame/frame.hpp"

namespace halfway {

// What that library has; the same compiler makes both sides.
extern "C" {
/// Of OpenImageIO, such as `OpenImageIO 2.4.7`.
void halfway_image_versions(std::string& text);
/// A whole PNG. `path` is for messages.
void halfway_encode_png(const std::string& path, const Frame& frame, bool quick,
                        Result<std::vector<unsigned char>>& bytes);
/// See read_png in image.hpp.
void halfway_decode_png(const std::string& path, Result<Frame>& frame);
/// Pixels of two images of brightness, 0 to 1, whose difference is seen on a display of so many cd/m2 that
/// fills so many degrees of the view; -1 where OpenImageIO cannot tell.
long halfway_seen_by_yee(const std::vector<float>& a, const std::vector<float>& b, FrameSize size,
                         float luminance, float field);
}

struct ImageLibrary {
  decltype(&halfway_image_versions) versions = nullptr;
  decltype(&halfway_encode_png) encode_png = nullptr;
  decltype(&halfway_decode_png) decode_png = nullptr;
  decltype(&halfway_seen_by_yee) seen_by_yee = nullptr;
};

/// Loaded by the first who asks, and never unloaded: it has threads.
Result<ImageLibrary> image_library();

/// Where it lies: what is measured hangs on it as on the program.
std::filesystem::path image_library_file();

}  // namespace halfway
