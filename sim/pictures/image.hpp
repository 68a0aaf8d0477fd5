// SPDX-License-Identifier: Apache-2.0
// Frames as image files.
#pragma once

#include <filesystem>

#include "common/result.hpp"
#include "frame/frame.hpp"

namespace halfway {

/// How long a PNG may take for how few bytes.
enum class Compression { usual, quick };

/// Writes the whole file or leaves what was there: under a name beside it first, then renamed. What is no
/// regular file (a pipe, a device) is written as it stands. A path that cannot be opened is bad_input; a disk
/// that is full or breaks is tool_failed.
Status write_png(const std::filesystem::path& path, const Frame& frame,
                 Compression compression = Compression::usual);

/// The same as a binary PPM, of 3 bytes a pixel.
Status write_ppm(const std::filesystem::path& path, const Frame& frame);

/// Reads a PNG of 8 bits, three channels and at most 4096x4096 pixels, such as write_png makes; others are
/// refused.
Result<Frame> read_png(const std::filesystem::path& path);

}  // namespace halfway
