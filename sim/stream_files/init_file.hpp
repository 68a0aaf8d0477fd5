// SPDX-License-Identifier: Apache-2.0
// Init vectors, what setup hands to the hardware for each triangle, in memory and as a text file.
//
//   halfway-init 1 <key name> <bits>
//   <one vector a line: ceil(bits / 4) hexadecimal digits, most significant first>
//   end <count>
//
// The count stands at the end so that the file can be written as a stream; a file without it is not whole.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/result.hpp"
#include "sim/system/file.hpp"

namespace halfway {

/// Vectors of `bits` bits each, one after the other, each in `words_per_vector()` words, least significant
/// first. The bits of the last word above the vector are zero.
struct InitStream {
  unsigned bits = 0;
  std::vector<std::uint32_t> words;

  std::size_t words_per_vector() const { return (bits + 31) / 32; }
  std::size_t size() const { return bits == 0 ? 0 : words.size() / words_per_vector(); }
  std::span<const std::uint32_t> vector(std::size_t index) const {
    return std::span(words).subspan(index * words_per_vector(), words_per_vector());
  }
};

inline constexpr unsigned kMostInitBits = 1U << 16;

class InitFileWriter {
 public:
  static Result<InitFileWriter> open(const std::filesystem::path& path, std::string_view key_name,
                                     unsigned bits);
  /// Writes whole vectors; `words` holds as many words as the vectors take.
  void write(std::span<const std::uint32_t> words);
  /// Ends the file and gives it its name. The first error of any write comes out here.
  Status commit();

 private:
  InitFileWriter(LineWriter writer, unsigned bits) : writer_(std::move(writer)), bits_(bits) {}
  LineWriter writer_;
  unsigned bits_;
  std::uint64_t count_ = 0;
};

class InitFileReader {
 public:
  /// Reads the header; a file for another hardware key is an error. An empty `key_name` takes any.
  static Result<InitFileReader> open(const std::filesystem::path& path, std::string_view key_name);
  unsigned bits() const { return bits_; }
  const std::string& key_name() const { return key_name_; }
  /// Appends up to `limit` vectors to `words`; gives how many. 0: the file's end, and the file was whole.
  Result<std::size_t> read(std::vector<std::uint32_t>& words, std::size_t limit);

 private:
  InitFileReader(LineReader reader, std::string key_name, unsigned bits)
      : reader_(std::move(reader)), key_name_(std::move(key_name)), bits_(bits) {}
  LineReader reader_;
  std::string key_name_;
  unsigned bits_;
  std::uint64_t count_ = 0;
  bool ended_ = false;
};

Status write_init_file(const std::filesystem::path& path, std::string_view key_name,
                       const InitStream& stream);
Result<InitStream> read_init_file(const std::filesystem::path& path, std::string_view key_name);

}  // namespace halfway
