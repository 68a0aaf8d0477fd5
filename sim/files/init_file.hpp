// SPDX-License-Identifier: Apache-2.0
// Init vectors (setup's output for each triangle, the hardware's input), in memory and as a text file.
//   halfway-init 1 <key name> <bits>
//   <one vector per line: ceil(bits / 4) hexadecimal digits, most significant first>
//   end <count>
// The count is in the last line, so that the file can be written as a stream. A file without it is
// incomplete.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/result.hpp"
#include "sim/files/stream_reader.hpp"
#include "sim/os/file.hpp"

namespace halfway {

/// Vectors of `bits` bits each in sequence. Each vector has `words_per_vector()` words, least significant
/// first. Unused bits of the last word are zero.
struct InitStream {
  unsigned bits = 0;
  std::vector<std::uint32_t> words;

  std::size_t words_per_vector() const { return (bits + 31) / 32; }
  std::size_t size() const { return bits == 0 ? 0 : words.size() / words_per_vector(); }
};

inline constexpr unsigned c_most_init_bits = 1U << 16;

class InitFileWriter {
 public:
  static Result<InitFileWriter> open(const std::filesystem::path& path, std::string_view key_name,
                                     unsigned bits);
  /// Write whole vectors. `words` has `words_per_vector()` words per vector.
  void write(std::span<const std::uint32_t> words);
  /// Write the last line and rename the file to its final name. Returns the first error of any write.
  Status commit();

 private:
  InitFileWriter(LineWriter writer, unsigned bits) : writer_(std::move(writer)), bits_(bits) {}
  LineWriter writer_;
  unsigned bits_;
  std::uint64_t count_ = 0;
};

class InitFileReader {
 public:
  /// Read the header. A file for another hardware key is an error. An empty `key_name` accepts any key.
  static Result<InitFileReader> open(const std::filesystem::path& path, std::string_view key_name);
  unsigned bits() const { return bits_; }
  const std::string& key_name() const { return reader_.key_name(); }
  /// Append up to `limit` vectors to `words` and return their number. 0: end of a complete file.
  Result<std::size_t> read(std::vector<std::uint32_t>& words, std::size_t limit);

 private:
  InitFileReader(StreamReader reader, unsigned bits) : reader_(std::move(reader)), bits_(bits) {}
  StreamReader reader_;
  unsigned bits_;
  std::uint64_t count_ = 0;
};

Status write_init_file(const std::filesystem::path& path, std::string_view key_name,
                       const InitStream& stream);
Result<InitStream> read_init_file(const std::filesystem::path& path, std::string_view key_name);

}  // namespace halfway
