// SPDX-License-Identifier: Apache-2.0
// OpenImageIO in a library of its own, loaded at the first image. OpenImageIO depends on some 250 libraries;
// loading them at every start of the program would take a quarter of a second of processor time.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/result.hpp"
#include "frame/frame.hpp"

namespace halfway {

// Functions of that library. The same compiler builds both sides.
extern "C" {
/// Version of OpenImageIO, such as `OpenImageIO 2.4.7`.
void halfway_image_versions(std::string& text);
/// Encode a whole PNG. `path` is for messages.
void halfway_encode_png(const std::string& path, const Frame& frame, bool quick,
                        Result<std::vector<unsigned char>>& bytes);
/// See read_png in image.hpp.
void halfway_decode_png(const std::string& path, Result<Frame>& frame);
}

struct ImageLibrary {
  decltype(&halfway_image_versions) versions = nullptr;
  decltype(&halfway_encode_png) encode_png = nullptr;
  decltype(&halfway_decode_png) decode_png = nullptr;
};

/// Loaded by the first call and never unloaded, because it has threads.
Result<ImageLibrary> image_library();

/// The library's path. Cached results depend on this file as well as on the program.
std::filesystem::path image_library_file();

}  // namespace halfway
