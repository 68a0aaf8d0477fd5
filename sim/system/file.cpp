// SPDX-License-Identifier: Apache-2.0
#include "sim/system/file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <stdlib.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <system_error>

namespace halfway {
namespace {

constexpr std::size_t c_buffer_bytes = 1U << 20;

Error cannot(ExitCode code, const std::filesystem::path& path, std::string_view what, int error) {
  return {code, fmt::format("{}: cannot {}: {}", path.string(), what, std::strerror(error))};
}

// A full or failing disk is not an error of the input.
ExitCode code_of(int error) {
  return error == ENOSPC || error == EDQUOT || error == EIO ? ExitCode::tool_failed : ExitCode::bad_input;
}

int write_all(int descriptor, const char* bytes, std::size_t count) {
  while (count > 0) {
    const ssize_t written = ::write(descriptor, bytes, count);
    if (written < 0) {
      if (errno == EINTR) continue;
      return errno;
    }
    bytes += written;
    count -= static_cast<std::size_t>(written);
  }
  return 0;
}

constexpr const char* c_folder_prefix = ".halfway-";
// Upper bound of the time between creating and locking a temporary file.
constexpr time_t c_young_seconds = 60;
// A tool that ran out of disk space may have released some of it when it ended.
constexpr unsigned long c_little_room = 4UL << 20;

// Remove the entries of `folder` that start with `prefix` and that no process has locked.
void remove_stale(const std::filesystem::path& folder, const std::string& prefix) {
  std::error_code error;
  for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    if (!entry->path().filename().string().starts_with(prefix)) continue;
    const int descriptor = ::open(entry->path().c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (descriptor < 0) continue;
    struct stat status {};
    std::error_code ignored;
    if (::fstat(descriptor, &status) == 0 && ::time(nullptr) - status.st_mtime >= c_young_seconds &&
        ::flock(descriptor, LOCK_EX | LOCK_NB) == 0)
      std::filesystem::remove_all(entry->path(), ignored);
    ::close(descriptor);
  }
}

}  // namespace

void mark_in_use(int descriptor) {
  ::flock(descriptor, LOCK_EX | LOCK_NB);
}

void remove_stale_parts(const std::filesystem::path& path) {
  const auto folder = path.parent_path();
  remove_stale(folder.empty() ? "." : folder, path.filename().string() + ".part-");
}

std::string room_note(const std::vector<std::filesystem::path>& folders) {
  std::string note;
  for (const auto& folder : folders) {
    struct statvfs disk {};
    if (::statvfs(folder.c_str(), &disk) != 0) continue;
    if (disk.f_bavail * disk.f_frsize < c_little_room || (disk.f_files != 0 && disk.f_favail == 0))
      note += fmt::format("\n{}: {}; make room and try again", folder.string(), std::strerror(ENOSPC));
  }
  return note;
}

Result<std::string> read_file(const std::filesystem::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return cannot(ExitCode::bad_input, path, "open", errno);
  std::string content;
  std::size_t used = 0;
  while (true) {
    if (content.size() - used < 1U << 16) content.resize(std::max<std::size_t>(1U << 17, content.size() * 2));
    const ssize_t got = ::read(descriptor, content.data() + used, content.size() - used);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) {
      const int error = errno;
      ::close(descriptor);
      return cannot(ExitCode::bad_input, path, "read", error);
    }
    if (got == 0) break;
    used += static_cast<std::size_t>(got);
  }
  ::close(descriptor);
  content.resize(used);
  return content;
}

Result<std::vector<std::filesystem::path>> files_below(const std::filesystem::path& folder,
                                                       std::string_view extension) {
  std::vector<std::filesystem::path> files;
  std::error_code error;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder, error))
    if (entry.is_regular_file() && (extension.empty() || entry.path().extension() == extension))
      files.push_back(entry.path().lexically_relative(folder));
  if (error) return tool_failed(fmt::format("{}: {}", folder.string(), error.message()));
  std::ranges::sort(files);
  return files;
}

Status write_file(const std::filesystem::path& path, std::string_view content) {
  auto writer = LineWriter::open(path);
  if (!writer) return writer.error();
  writer->append(content);
  return writer->commit();
}

Status make_folders(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!error) return Ok{};
  return Error{code_of(error.value()),
               fmt::format("{}: cannot make the folder: {}", folder.string(), error.message())};
}

void ContentHash::add_bytes(const void* bytes, std::size_t count) {
  constexpr unsigned __int128 c_prime = (static_cast<unsigned __int128>(0x0000000001000000) << 64) | 0x13b;
  const auto* byte = static_cast<const unsigned char*>(bytes);
  for (std::size_t i = 0; i < count; ++i) state_ = (state_ ^ byte[i]) * c_prime;
}

ContentHash& ContentHash::add(std::string_view field) {
  const std::uint64_t length = field.size();
  add_bytes(&length, sizeof length);
  add_bytes(field.data(), field.size());
  return *this;
}

std::string ContentHash::hex() const {
  return fmt::format("{:016x}{:016x}", static_cast<std::uint64_t>(state_ >> 64),
                     static_cast<std::uint64_t>(state_));
}

Result<TemporaryFolder> TemporaryFolder::make(const std::filesystem::path& parent) {
  if (auto made = make_folders(parent); !made) return made.error();
  remove_stale(parent, c_folder_prefix);
  std::string name = (parent / c_folder_prefix).string() + "XXXXXX";
  if (::mkdtemp(name.data()) == nullptr) return cannot(code_of(errno), parent, "make a folder in it", errno);
  ::chmod(name.c_str(), 0755);
  const int descriptor = ::open(name.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor >= 0) mark_in_use(descriptor);
  return TemporaryFolder(std::filesystem::path(name), descriptor);
}

TemporaryFolder::TemporaryFolder(TemporaryFolder&& other) noexcept
    : path_(std::move(other.path_)), descriptor_(std::exchange(other.descriptor_, -1)) {
  other.path_.clear();
}

TemporaryFolder& TemporaryFolder::operator=(TemporaryFolder&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
  if (descriptor_ >= 0) ::close(descriptor_);
}

Status TemporaryFolder::move_to(const std::filesystem::path& target) {
  std::error_code error;
  std::filesystem::rename(path_, target, error);
  if (!error) {
    path_.clear();
    return Ok{};
  }
  if (std::filesystem::is_directory(target)) return Ok{};  // another run built the same folder first
  return tool_failed(fmt::format("{}: cannot move the build here: {}", target.string(), error.message()));
}

Result<LineWriter> LineWriter::open(const std::filesystem::path& path) {
  if (path.has_parent_path()) {
    if (auto made = make_folders(path.parent_path()); !made) return made.error();
  }
  remove_stale_parts(path);
  std::string temporary = path.string() + ".part-XXXXXX";
  const int descriptor = ::mkostemp(temporary.data(), O_CLOEXEC);
  if (descriptor < 0) return cannot(code_of(errno), path, "write", errno);
  mark_in_use(descriptor);
  ::fchmod(descriptor, 0644);
  return LineWriter(path, temporary, descriptor);
}

LineWriter::LineWriter(std::filesystem::path path, std::filesystem::path temporary, int descriptor)
    : path_(std::move(path)),
      temporary_(std::move(temporary)),
      descriptor_(descriptor),
      buffer_(c_buffer_bytes) {}

LineWriter::LineWriter(LineWriter&& other) noexcept
    : path_(std::move(other.path_)),
      temporary_(std::move(other.temporary_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      error_(other.error_),
      buffer_(std::move(other.buffer_)),
      used_(other.used_) {}

LineWriter::~LineWriter() {
  if (descriptor_ < 0) return;
  ::close(descriptor_);
  ::unlink(temporary_.c_str());
}

void LineWriter::flush() {
  if (error_ == 0) error_ = write_all(descriptor_, buffer_.data(), used_);
  used_ = 0;
}

char* LineWriter::reserve(std::size_t count) {
  if (buffer_.size() - used_ < count) {
    flush();
    if (buffer_.size() < count) buffer_.resize(count);
  }
  return buffer_.data() + used_;
}

void LineWriter::append(std::string_view text) {
  while (!text.empty()) {
    if (used_ == buffer_.size()) flush();
    const std::size_t count = std::min(text.size(), buffer_.size() - used_);
    std::memcpy(buffer_.data() + used_, text.data(), count);
    used_ += count;
    text.remove_prefix(count);
  }
}

Status LineWriter::commit() {
  flush();
  // close reports errors too: delayed allocation, quotas, network file systems.
  if (::close(std::exchange(descriptor_, -1)) != 0 && error_ == 0) error_ = errno;
  if (error_ == 0 && ::rename(temporary_.c_str(), path_.c_str()) != 0) error_ = errno;
  if (error_ == 0) return Ok{};
  ::unlink(temporary_.c_str());
  return cannot(ExitCode::tool_failed, path_, "write", error_);
}

Result<LineReader> LineReader::open(const std::filesystem::path& path, std::size_t longest_line) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return cannot(ExitCode::bad_input, path, "open", errno);
  return LineReader(path, descriptor, longest_line);
}

LineReader::LineReader(std::filesystem::path path, int descriptor, std::size_t longest_line)
    : path_(std::move(path)),
      descriptor_(descriptor),
      longest_line_(longest_line),
      buffer_(std::max(c_buffer_bytes, longest_line + 2)) {}

LineReader::LineReader(LineReader&& other) noexcept
    : path_(std::move(other.path_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      longest_line_(other.longest_line_),
      buffer_(std::move(other.buffer_)),
      begin_(other.begin_),
      end_(other.end_),
      at_end_(other.at_end_),
      line_number_(other.line_number_),
      error_(std::move(other.error_)) {}

LineReader::~LineReader() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

Error LineReader::at(std::string_view what) const {
  return bad_input(fmt::format("{}:{}: {}", path_.string(), line_number_, what));
}

LineReader::Next LineReader::next(std::string_view& line) {
  std::size_t searched = begin_;
  while (true) {
    const void* found = std::memchr(buffer_.data() + searched, '\n', end_ - searched);
    const bool last = found == nullptr && at_end_;
    if (last && begin_ == end_) return Next::end_of_file;
    if (found != nullptr || last) {
      const std::size_t line_end = last ? end_ : static_cast<const char*>(found) - buffer_.data();
      line = {buffer_.data() + begin_, line_end - begin_};
      begin_ = last ? end_ : line_end + 1;
      ++line_number_;
      if (line.size() <= longest_line_) return Next::line;
      error_ = at(fmt::format("a line of more than {} characters; this is not a file of this project",
                              longest_line_));
      return Next::failed;
    }
    if (end_ - begin_ > longest_line_) {
      ++line_number_;
      error_ = at(fmt::format("a line of more than {} characters; this is not a file of this project",
                              longest_line_));
      return Next::failed;
    }
    std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
    end_ -= begin_;
    begin_ = 0;
    searched = end_;
    const ssize_t got = ::read(descriptor_, buffer_.data() + end_, buffer_.size() - end_);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) {
      error_ = cannot(ExitCode::bad_input, path_, "read", errno);
      return Next::failed;
    }
    if (got == 0) at_end_ = true;
    end_ += static_cast<std::size_t>(got);
  }
}

}  // namespace halfway
