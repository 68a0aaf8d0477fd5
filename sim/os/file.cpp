// SPDX-License-Identifier: Apache-2.0
#include "sim/os/file.hpp"

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
    const Descriptor file(::open(entry->path().c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
    if (file.get() < 0) continue;
    struct stat status{};
    std::error_code ignored;
    if (::fstat(file.get(), &status) == 0 && ::time(nullptr) - status.st_mtime >= c_young_seconds &&
        ::flock(file.get(), LOCK_EX | LOCK_NB) == 0)
      std::filesystem::remove_all(entry->path(), ignored);
  }
}

// Lock a temporary file or folder while the descriptor is open. Other processes can then distinguish it from
// leftovers of a killed run.
void mark_in_use(int descriptor) {
  ::flock(descriptor, LOCK_EX | LOCK_NB);
}

}  // namespace

std::string room_note(const std::vector<std::filesystem::path>& folders) {
  std::string note;
  for (const auto& folder : folders) {
    struct statvfs disk{};
    if (::statvfs(folder.c_str(), &disk) != 0) continue;
    if (disk.f_bavail * disk.f_frsize < c_little_room || (disk.f_files != 0 && disk.f_favail == 0))
      note += fmt::format("\n{}: {}; make room and try again", folder.string(), std::strerror(ENOSPC));
  }
  return note;
}

Result<std::string> read_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file.is_open()) return cannot(ExitCode::bad_input, path, "open", errno);
  std::string content;
  std::vector<char> block(1U << 17);
  while (file.read(block.data(), std::ssize(block)), file.gcount() > 0)
    content.append(block.data(), static_cast<std::size_t>(file.gcount()));
  if (file.bad()) return cannot(ExitCode::bad_input, path, "read", errno);
  return content;
}

std::string read_own_file(const std::filesystem::path& path) {
  auto content = read_file(path);
  if (!content) throw_tool_failed("{}", content.error().message);
  return std::move(*content);
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
  Descriptor in_use(::open(name.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  mark_in_use(in_use.get());
  return TemporaryFolder(std::filesystem::path(name), std::move(in_use));
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
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

Result<Descriptor> lock_folder(const std::filesystem::path& folder, const std::function<void()>& on_wait) {
  const std::filesystem::path path = folder / ".lock";
  Descriptor lock(::open(path.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0644));
  bool locked = lock.get() >= 0 && ::flock(lock.get(), LOCK_EX | LOCK_NB) == 0;
  if (!locked && lock.get() >= 0) {
    on_wait();
    do locked = ::flock(lock.get(), LOCK_EX) == 0;
    while (!locked && errno == EINTR);
  }
  if (locked) return lock;
  return tool_failed(fmt::format("{}: cannot lock the folder: {}", path.string(), std::strerror(errno)));
}

Result<LineWriter> LineWriter::open(const std::filesystem::path& path) {
  if (path.has_parent_path()) {
    if (auto made = make_folders(path.parent_path()); !made) return made.error();
  }
  remove_stale(path.has_parent_path() ? path.parent_path() : ".", path.filename().string() + ".part-");
  LineWriter writer;
  writer.path_ = path;
  writer.temporary_ = path.string() + ".part-XXXXXX";
  const int descriptor = ::mkostemp(writer.temporary_.data(), O_CLOEXEC);
  if (descriptor < 0) return cannot(code_of(errno), path, "write", errno);
  mark_in_use(descriptor);
  ::fchmod(descriptor, 0644);
  writer.file_.reset(::fdopen(descriptor, "w"));
  writer.buffer_.resize(c_buffer_bytes);
  std::setvbuf(writer.file_.get(), writer.buffer_.data(), _IOFBF, writer.buffer_.size());
  return writer;
}

LineWriter::~LineWriter() {
  if (file_) ::unlink(temporary_.c_str());
}

void LineWriter::append(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), file_.get()) != text.size() && error_ == 0) error_ = errno;
}

Status LineWriter::commit() {
  // fclose reports errors too: delayed allocation, quotas, network file systems.
  if (std::fclose(file_.release()) != 0 && error_ == 0) error_ = errno;
  if (error_ == 0 && ::rename(temporary_.c_str(), path_.c_str()) != 0) error_ = errno;
  if (error_ == 0) return Ok{};
  ::unlink(temporary_.c_str());
  return cannot(ExitCode::tool_failed, path_, "write", error_);
}

Result<LineReader> LineReader::open(const std::filesystem::path& path, std::size_t longest_line) {
  LineReader reader;
  reader.path_ = path;
  reader.buffer_.resize(longest_line + 1);
  reader.file_.open(path, std::ios::binary);
  if (!reader.file_.is_open()) return cannot(ExitCode::bad_input, path, "open", errno);
  return reader;
}

Error LineReader::at(std::string_view what) const {
  return bad_input(fmt::format("{}:{}: {}", path_.string(), line_number_, what));
}

Result<bool> LineReader::next(std::string_view& line) {
  file_.getline(buffer_.data(), std::ssize(buffer_));
  if (file_.bad()) return cannot(ExitCode::bad_input, path_, "read", errno);
  const auto count = static_cast<std::size_t>(file_.gcount());  // with the line end
  if (file_.eof() && count == 0) return false;
  ++line_number_;
  if (file_.fail())
    return at(fmt::format("a line of more than {} characters; this is not a file of this project",
                          buffer_.size() - 1));
  line = {buffer_.data(), file_.eof() ? count : count - 1};
  return true;
}

}  // namespace halfway
