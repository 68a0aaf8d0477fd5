// SPDX-License-Identifier: Apache-2.0
// A testbench's vectors as text, for tb/rtl/tb_pkg.vhd: one vector per line, hexadecimal words separated by
// one space, and `end <count>` as the last line, so that a truncated file is detected.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "sim/os/file.hpp"
#include "sim/os/must.hpp"
#include "words/word.hpp"

namespace halfway::vectors {

class VectorFile {
 public:
  /// Append a word of `bits` bits. Higher bits of `value` are dropped.
  VectorFile& word(std::uint64_t value, int bits) {
    const std::uint32_t words[] = {static_cast<std::uint32_t>(value),
                                   static_cast<std::uint32_t>(value >> 32)};
    return words_of(words, bits);
  }
  VectorFile& flag(bool value) { return word(value, 1); }
  template <int W>
  VectorFile& word(words::Word<W> value) {
    return word(value.bits(), W);
  }
  /// Append `bits` bits of a flat vector. Bit 0 of words[0] is the lowest.
  VectorFile& words_of(std::span<const std::uint32_t> words, int bits) {
    for (int low = (bits - 1) / 4 * 4; low >= 0; low -= 4) {
      const auto nibble = words[static_cast<std::size_t>(low) / 32] >> (low % 32) & 0xF;
      text_ += "0123456789ABCDEF"[words::low_bits(nibble, bits - low < 4 ? bits - low : 4)];
    }
    text_ += ' ';
    return *this;
  }
  void end_vector() {
    text_.back() = '\n';
    ++count_;
  }
  std::size_t size() const { return count_; }
  void write(const std::filesystem::path& path) const {
    must(make_folders(path.parent_path()));
    must(write_file(path, text_ + "end " + std::to_string(count_) + '\n'));
  }

 private:
  std::string text_;
  std::size_t count_ = 0;
};

}  // namespace halfway::vectors
