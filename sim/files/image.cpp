// SPDX-License-Identifier: Apache-2.0
#include "sim/files/image.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/files/image_library.hpp"
#include "sim/os/file.hpp"

namespace halfway {
namespace {

Error cannot_open(const std::string& path, int error) {
  return bad_input(
      fmt::format("{}: cannot be opened for writing ({}); name a folder that exists and may be written", path,
                  std::strerror(error)));
}

/// Write to a pipe or a device. A full device may be reported only when it is closed.
Status write_directly(const std::string& path, std::string_view bytes) {
  const int file = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
  if (file < 0) return cannot_open(path, errno);
  int error = 0;
  while (!bytes.empty() && error == 0) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written > 0)
      bytes.remove_prefix(static_cast<std::size_t>(written));
    else if (written == 0 || errno != EINTR)
      error = written == 0 ? EIO : errno;
  }
  if (::close(file) != 0 && error == 0) error = errno;
  if (error == 0) return Ok{};
  return tool_failed(fmt::format("{}: writing failed ({}); try again", path, std::strerror(error)));
}

Status write_whole(const std::filesystem::path& path, std::span<const unsigned char> bytes) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  std::error_code error;
  const auto type = std::filesystem::status(path, error).type();
  if (type == std::filesystem::file_type::not_found) {
    if (path.has_parent_path() && !std::filesystem::is_directory(path.parent_path()))
      return cannot_open(path, ENOENT);
  } else if (type != std::filesystem::file_type::regular) {
    return write_directly(path, text);
  }
  return write_file(path, text);
}

Status check_picture(const std::string& path, const Frame& frame) {
  if (frame.size.width == 0 || frame.size.height == 0 || frame.size.width > c_max_frame_side ||
      frame.size.height > c_max_frame_side || frame.rgb.size() != 3 * frame.pixels())
    return bad_input(fmt::format(
        "{}: a frame of {}x{} with {} bytes is not a valid picture; render 1x1 to {}x{} pixels", path,
        frame.size.width, frame.size.height, frame.rgb.size(), c_max_frame_side, c_max_frame_side));
  return Ok{};
}

}  // namespace

Status write_png(const std::filesystem::path& path, const Frame& frame, Compression compression) {
  if (Status status = check_picture(path.string(), frame); !status) return status;
  const auto library = image_library();
  if (!library) return library.error();
  Result<std::vector<unsigned char>> bytes = std::vector<unsigned char>{};
  library->encode_png(path.string(), frame, compression == Compression::quick, bytes);
  if (!bytes) return bytes.error();
  return write_whole(path, *bytes);
}

Status write_ppm(const std::filesystem::path& path, const Frame& frame) {
  if (Status status = check_picture(path.string(), frame); !status) return status;
  const std::string header = fmt::format("P6\n{} {}\n255\n", frame.size.width, frame.size.height);
  std::vector<unsigned char> bytes(header.begin(), header.end());
  bytes.insert(bytes.end(), frame.rgb.begin(), frame.rgb.end());
  return write_whole(path, bytes);
}

Result<Frame> read_png(const std::filesystem::path& path) {
  const auto library = image_library();
  if (!library) return library.error();
  Result<Frame> frame = Frame{};
  library->decode_png(path.string(), frame);
  return frame;
}

}  // namespace halfway
