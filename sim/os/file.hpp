// SPDX-License-Identifier: Apache-2.0
// File access: read whole files, write atomically, hash contents, lock folders, read and write long files
// line by line.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "common/result.hpp"
#include "sim/os/descriptor.hpp"
#include "sim/os/must.hpp"

namespace halfway {

/// Return the whole file, byte for byte.
Result<std::string> read_file(const std::filesystem::path& path);
/// The same for a file of the project or of a tool: that it cannot be read is no fault of the input. Throws
/// Failure.
std::string read_own_file(const std::filesystem::path& path);

/// Return every file below the folder, sorted by name, relative to the folder. `extension`, if given,
/// includes the dot.
Result<std::vector<std::filesystem::path>> files_below(const std::filesystem::path& folder,
                                                       std::string_view extension = {});

/// Write a temporary file next to `path` and rename it. A reader sees the old file or the new file, never a
/// part.
Status write_file(const std::filesystem::path& path, std::string_view content);

/// Create the folder and its parents.
Status make_folders(const std::filesystem::path& folder);

/// 128-bit FNV-1a hash; it names cached builds. The length of every field is hashed too, so that ("ab", "c")
/// and ("a", "bc") differ.
class ContentHash {
 public:
  ContentHash& add(std::string_view field);
  std::string hex() const;  ///< 32 hexadecimal digits

 private:
  void add_bytes(const void* bytes, std::size_t count);
  unsigned __int128 state_ = (static_cast<unsigned __int128>(0x6c62272e07bb0142) << 64) | 0x62b821756295c58d;
};

/// If one of the folders' disks is nearly full: "FOLDER: No space left on device; make room and try again".
/// Otherwise empty. Appended to the message of a tool that failed and may not have given the reason.
std::string room_note(const std::vector<std::filesystem::path>& folders);

/// A new folder under `parent`, removed with its contents unless `move_to` succeeds. The constructor first
/// removes the folders that killed runs left in `parent`.
class TemporaryFolder {
 public:
  static Result<TemporaryFolder> make(const std::filesystem::path& parent);
  TemporaryFolder(TemporaryFolder&& other) noexcept
      : path_(std::exchange(other.path_, {})), in_use_(std::move(other.in_use_)) {}
  ~TemporaryFolder();

  const std::filesystem::path& path() const { return path_; }
  /// Rename the folder to `target` in one step. If another run created `target` first, that folder stays and
  /// this one is removed.
  Status move_to(const std::filesystem::path& target);

 private:
  TemporaryFolder(std::filesystem::path path, Descriptor in_use)
      : path_(std::move(path)), in_use_(std::move(in_use)) {}
  std::filesystem::path path_;  ///< empty: nothing to remove
  Descriptor in_use_;           ///< of the folder; see mark_in_use
};

/// Let `fill(path)` fill a new folder and rename it to `folder`, unless `folder` exists. If `fill` throws,
/// no folder remains. Throws Failure.
template <class Fill>
void make_once(const std::filesystem::path& folder, const Fill& fill) {
  if (std::filesystem::exists(folder)) return;
  TemporaryFolder fresh = must(TemporaryFolder::make(folder.parent_path()));
  fill(fresh.path());
  must(fresh.move_to(folder));
}

/// Lock the folder: another run that locks it waits until the descriptor is closed, or the process ends in
/// any way. `on_wait` is called once if another run has the lock.
Result<Descriptor> lock_folder(const std::filesystem::path& folder, const std::function<void()>& on_wait);

/// A file of many lines, written through a large buffer under a temporary name. `commit` renames it to its
/// final name. Without `commit` the temporary file is removed. The first error is kept and returned by
/// `commit`.
class LineWriter {
 public:
  static Result<LineWriter> open(const std::filesystem::path& path);
  LineWriter(LineWriter&&) = default;
  LineWriter& operator=(LineWriter&&) = delete;
  ~LineWriter();

  void append(std::string_view text);
  Status commit();

 private:
  LineWriter() = default;
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::filesystem::path path_;
  std::string temporary_;
  std::vector<char> buffer_;                ///< the file's; it is destroyed after the file
  std::unique_ptr<std::FILE, Close> file_;  ///< null after commit
  int error_ = 0;                           ///< errno of the first write that failed
};

/// A text file read line by line, with line numbers. The longest line allowed bounds the memory.
class LineReader {
 public:
  static Result<LineReader> open(const std::filesystem::path& path, std::size_t longest_line = 1U << 16);

  /// Read the next line without its line end (a last line without a line end counts), valid until the next
  /// call; false at the end of the file.
  Result<bool> next(std::string_view& line);
  /// An error at the current line: `file:line: what`.
  Error at(std::string_view what) const;

 private:
  LineReader() = default;

  std::filesystem::path path_;
  std::ifstream file_;
  std::vector<char> buffer_;
  std::size_t line_number_ = 0;
};

}  // namespace halfway
