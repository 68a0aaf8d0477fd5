// SPDX-License-Identifier: Apache-2.0
// Read and write frames as image files.
#pragma once

#include <filesystem>

#include "common/result.hpp"
#include "frame/frame.hpp"

namespace halfway {

/// Trade-off between time and size of a PNG.
enum class Compression { usual, quick };

/// Write the file atomically: to a temporary name next to it, then rename. A path that is not a regular file
/// (a pipe, a device) is written directly. A path that cannot be opened is bad_input; a full or failing disk
/// is tool_failed.
Status write_png(const std::filesystem::path& path, const Frame& frame,
                 Compression compression = Compression::usual);

/// Same as write_png, but as a binary PPM with 3 bytes per pixel.
Status write_ppm(const std::filesystem::path& path, const Frame& frame);

/// Read a PNG with 8 bits per channel, three channels and at most 4096x4096 pixels, such as write_png writes.
/// Other files are refused.
Result<Frame> read_png(const std::filesystem::path& path);

}  // namespace halfway
