// SPDX-License-Identifier: Apache-2.0
#include "sim/extras/board/sram_model.hpp"

#include <fmt/format.h>

namespace halfway::board {

constexpr std::size_t c_words = std::size_t{1} << 18;

SramModel::SramModel(std::uint32_t words_in_use) : words_(c_words), words_in_use_(words_in_use) {
  for (std::uint16_t& word : words_) word = noise();
}

std::uint16_t SramModel::noise() {  // xorshift32 (Marsaglia 2003)
  random_ ^= random_ << 13;
  random_ ^= random_ >> 17;
  random_ ^= random_ << 5;
  return static_cast<std::uint16_t>(random_);
}

void SramModel::fail(std::string what) {
  if (fault_.empty()) fault_ = fmt::format("SRAM: {} in clock {}", what, clock_);
}

std::uint16_t SramModel::clock(const BoardOutputs& pins) {
  ++clock_;
  const bool read = pins.sram_read != 0, write = pins.sram_write != 0;
  if (read && write) fail("read and write");
  if (write != (pins.sram_data_enable != 0))
    fail("the FPGA drives the data, but does not write, or the reverse");
  if (write && was_read_) fail("write in the clock after a read: the bus is not released");
  if ((read || write) && pins.sram_address >= words_in_use_)
    fail(fmt::format("address {} of {} words", pins.sram_address, words_in_use_));
  was_read_ = read;
  std::uint16_t& word = words_[pins.sram_address % c_words];
  if (write) {
    word = pins.sram_data_out;
    ++writes_;
  }
  if (!read) return noise();
  ++reads_;
  return word;
}

}  // namespace halfway::board
