// SPDX-License-Identifier: Apache-2.0
// Files: whole, written under a temporary name, hashed; and long ones line by line.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "common/result.hpp"

namespace halfway {

/// The whole file, byte for byte.
Result<std::string> read_file(const std::filesystem::path& path);

/// Every file below the folder, by name, as it is called from there; `extension`, if any, with its dot.
Result<std::vector<std::filesystem::path>> files_below(const std::filesystem::path& folder,
                                                       std::string_view extension = {});

/// Writes beside `path` and renames, so that a reader sees the old file or the new one, never a part.
Status write_file(const std::filesystem::path& path, std::string_view content);

/// Makes the folder and its parents.
Status make_folders(const std::filesystem::path& folder);

/// FNV-1a over 128 bits, to name cached builds: every field is hashed with its length, so that
/// ("ab", "c") and ("a", "bc") differ.
class ContentHash {
 public:
  ContentHash& add(std::string_view field);
  std::string hex() const;  ///< 32 digits

 private:
  void add_bytes(const void* bytes, std::size_t count);
  unsigned __int128 state_ = (static_cast<unsigned __int128>(0x6c62272e07bb0142) << 64) | 0x62b821756295c58d;
};

/// Where one of the folders' disks has next to no room left: "FOLDER: No space left on device; make room and
/// try again", for the message of a tool that failed there and may not have said why. Else empty.
std::string room_note(const std::vector<std::filesystem::path>& folders);

/// Locks a temporary file or folder for as long as the descriptor is open, so that others can tell it from
/// what a killed run left.
void mark_in_use(int descriptor);
/// Removes what killed runs left of unfinished files for `path`: `path`.part-*, and nobody's.
void remove_stale_parts(const std::filesystem::path& path);

/// A new folder under `parent`, removed with all that is in it unless `move_to` succeeds. Those that killed
/// runs left in `parent` are removed first.
class TemporaryFolder {
 public:
  static Result<TemporaryFolder> make(const std::filesystem::path& parent);
  TemporaryFolder(TemporaryFolder&& other) noexcept;
  TemporaryFolder& operator=(TemporaryFolder&& other) noexcept;
  ~TemporaryFolder();

  const std::filesystem::path& path() const { return path_; }
  /// Renames the folder to `target` in one step. Where another run was first, its folder stays and this one
  /// goes.
  Status move_to(const std::filesystem::path& target);

 private:
  TemporaryFolder(std::filesystem::path path, int descriptor)
      : path_(std::move(path)), descriptor_(descriptor) {}
  std::filesystem::path path_;  ///< empty: nothing to remove
  int descriptor_ = -1;         ///< of the folder: mark_in_use
};

/// A file of many lines, written through a large buffer under a temporary name; `commit` makes it the
/// file asked for. Without `commit` the temporary file is removed. An error sticks and comes out of `commit`.
class LineWriter {
 public:
  static Result<LineWriter> open(const std::filesystem::path& path);
  LineWriter(LineWriter&& other) noexcept;
  LineWriter& operator=(LineWriter&&) = delete;
  ~LineWriter();

  /// Room for `count` bytes at the end of the buffer; call `advance` with what was used of it.
  char* reserve(std::size_t count);
  void advance(const char* end) { used_ = static_cast<std::size_t>(end - buffer_.data()); }
  void append(std::string_view text);
  Status commit();

 private:
  LineWriter(std::filesystem::path path, std::filesystem::path temporary, int descriptor);
  void flush();

  std::filesystem::path path_, temporary_;
  int descriptor_ = -1;
  int error_ = 0;  ///< errno of the first write that failed
  std::vector<char> buffer_;
  std::size_t used_ = 0;
};

/// A text file line by line, with the line's number. Memory is bounded by the longest line allowed.
class LineReader {
 public:
  static Result<LineReader> open(const std::filesystem::path& path, std::size_t longest_line = 1U << 16);
  LineReader(LineReader&& other) noexcept;
  LineReader& operator=(LineReader&&) = delete;
  ~LineReader();

  enum class Next { line, end_of_file, failed };
  /// The next line without its end (a last line without one counts). It stays valid until the next call.
  Next next(std::string_view& line);
  std::size_t line_number() const { return line_number_; }
  /// An error at the current line, `file:line: what`.
  Error at(std::string_view what) const;
  /// Why `next` returned `failed`.
  const Error& error() const { return error_; }

 private:
  LineReader(std::filesystem::path path, int descriptor, std::size_t longest_line);

  std::filesystem::path path_;
  int descriptor_ = -1;
  std::size_t longest_line_;
  std::vector<char> buffer_;
  std::size_t begin_ = 0, end_ = 0;
  bool at_end_ = false;
  std::size_t line_number_ = 0;
  Error error_;
};

}  // namespace halfway
