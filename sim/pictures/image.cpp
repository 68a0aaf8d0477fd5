// SPDX-License-Identifier: Apache-2.0
#include "sim/pictures/image.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "sim/pictures/image_library.hpp"
#include "sim/system/file.hpp"

namespace halfway {
namespace {

Error cannot_open(const std::string& path, int error) {
  const std::string message =
      fmt::format("{}: cannot be opened for writing ({}); name a folder that exists and may be written", path,
                  std::strerror(error));
  return error == ENOSPC || error == EIO || error == EDQUOT ? tool_failed(message) : bad_input(message);
}

Error cannot_write(const std::string& path, int error) {
  return tool_failed(
      fmt::format("{}: writing failed ({}), the file is left as it was; make room and try again", path,
                  std::strerror(error)));
}

/// Write all bytes and close the file (a full disk may be reported only then). Return 0 or errno.
int write_and_close(int file, std::span<const unsigned char> bytes) {
  int error = 0;
  while (!bytes.empty() && error == 0) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written > 0)
      bytes = bytes.subspan(static_cast<std::size_t>(written));
    else if (written == 0 || errno != EINTR)
      error = written == 0 ? EIO : errno;
  }
  struct stat status {};
  if (error == 0 && ::fstat(file, &status) == 0 && S_ISREG(status.st_mode) && ::fsync(file) != 0)
    error = errno;
  if (::close(file) != 0 && error == 0) error = errno;
  return error;
}

Status write_whole(const std::string& path, std::span<const unsigned char> bytes) {
  struct stat status {};
  if (::stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode)) {
    const int file = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
    if (file < 0) return cannot_open(path, errno);
    if (const int error = write_and_close(file, bytes); error != 0) return cannot_write(path, error);
    return Ok{};
  }
  remove_stale_parts(path);
  std::string temporary;
  int file = -1;
  for (int attempt = 0; file < 0; ++attempt) {
    temporary = fmt::format("{}.part-{}-{}", path, ::getpid(), attempt);
    file = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file < 0 && (errno != EEXIST || attempt == 1000)) return cannot_open(path, errno);
  }
  mark_in_use(file);
  int error = write_and_close(file, bytes);
  if (error == 0 && ::rename(temporary.c_str(), path.c_str()) != 0) error = errno;
  if (error == 0) return Ok{};
  ::unlink(temporary.c_str());
  return cannot_write(path, error);
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
  return write_whole(path.string(), *bytes);
}

Status write_ppm(const std::filesystem::path& path, const Frame& frame) {
  if (Status status = check_picture(path.string(), frame); !status) return status;
  const std::string header = fmt::format("P6\n{} {}\n255\n", frame.size.width, frame.size.height);
  std::vector<unsigned char> bytes(header.begin(), header.end());
  bytes.insert(bytes.end(), frame.rgb.begin(), frame.rgb.end());
  return write_whole(path.string(), bytes);
}

Result<Frame> read_png(const std::filesystem::path& path) {
  const auto library = image_library();
  if (!library) return library.error();
  Result<Frame> frame = Frame{};
  library->decode_png(path.string(), frame);
  return frame;
}

}  // namespace halfway
