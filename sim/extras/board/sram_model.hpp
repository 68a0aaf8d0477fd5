// SPDX-License-Identifier: Apache-2.0
// An asynchronous SRAM of 256K words of 16 bits at the board's pins, one system clock at a time.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sim/extras/board/board_api.h"

namespace halfway::board {

/// Reads and writes within a clock. It checks the rules of the bus:
/// - it is read or written, not both, and the FPGA drives the data exactly while it writes
/// - at least one clock with neither lies between a read and a write: the SRAM releases the bus in it
/// - only the words of buffers and depths are used
class SramModel {
 public:
  /// The first `words_in_use` words may be addressed.
  explicit SramModel(std::uint32_t words_in_use);

  /// One clock with these levels at the pins. Returns the data on the bus at its end; without a read, noise.
  std::uint16_t clock(const BoardOutputs& pins);

  /// The first broken rule; empty if there is none.
  const std::string& fault() const { return fault_; }
  std::uint64_t reads() const { return reads_; }
  std::uint64_t writes() const { return writes_; }

 private:
  void fail(std::string what);
  std::uint16_t noise();

  std::vector<std::uint16_t> words_;
  std::uint32_t words_in_use_;
  std::uint64_t clock_ = 0, reads_ = 0, writes_ = 0;
  std::uint32_t random_ = 1;
  bool was_read_ = false;
  std::string fault_;
};

}  // namespace halfway::board
