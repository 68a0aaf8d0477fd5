// SPDX-License-Identifier: Apache-2.0
// A memory at the AXI4 port of the core, one clock at a time.
#pragma once

#include <cstdint>
#include <deque>
#include <span>

#include "sim/extras/core/core_api.h"

namespace halfway::core {

struct MemoryTiming {
  /// Clocks from an address to its first word, and from a write's last word to its response; at least 1.
  unsigned latency = 30;
  std::uint32_t pause_seed = 0;  ///< 0: full speed; otherwise each ready and valid pauses at random
};

/// Takes what AXI4 allows, as tb/rtl/memory/axi_memory.vhd: a read sees the memory in the clock in which its
/// address is taken, and a write changes it in the clock of its response. The channels are independent. Each
/// channel answers in order.
class AxiMemory {
 public:
  AxiMemory(unsigned bus_bytes, MemoryTiming timing)
      : bus_bytes_(bus_bytes), timing_(timing), random_(timing.pause_seed) {}

  /// The memory: `bytes` has the addresses from `origin` on, both multiples of 8. All other addresses get
  /// error responses.
  void connect(std::span<std::uint8_t> bytes, std::uint32_t origin) {
    bytes_ = bytes;
    origin_ = origin;
  }

  /// Addresses that get error responses, too: `count` bytes. A write does not change them.
  void refuse(std::uint32_t first, std::uint32_t count) {
    refused_first_ = first;
    refused_count_ = count;
  }

  /// The rising edge at the end of a clock with these signals. Sets the memory's signals in the next clock.
  /// Throws Failure, of the code `differs`, for a burst that AXI4 does not allow, and for a transfer that
  /// changes while it waits.
  void clock(CoreInputs& answers, const CoreOutputs& core);

  std::uint64_t words_read() const { return words_read_; }
  std::uint64_t words_written() const { return words_written_; }

 private:
  struct Word {
    std::uint64_t data;
    std::uint8_t strobes, response;
    bool last;
    std::uint64_t due;  ///< the clock from which on it can be given
  };
  struct Burst {
    std::uint32_t address, words;
  };

  bool is_refused(std::uint32_t address) const;
  bool pauses();
  void check_waiting(const CoreOutputs& core) const;
  Burst checked(std::uint32_t address, std::uint8_t length) const;
  void take_read(const CoreOutputs& core);
  void take_word(const CoreOutputs& core);
  /// Carries out the oldest write and returns its response.
  std::uint8_t write();

  std::span<std::uint8_t> bytes_;
  std::uint32_t origin_ = 0;
  unsigned bus_bytes_;
  MemoryTiming timing_;
  std::uint32_t random_;
  std::uint32_t refused_first_ = 0, refused_count_ = 0;
  CoreInputs answers_before_{};  ///< signals of the clock before
  CoreOutputs core_before_{};
  std::uint64_t clock_ = 0, words_read_ = 0, words_written_ = 0;
  std::deque<Word> reads_;               ///< words to give
  std::deque<Burst> writes_;             ///< addresses that were taken
  std::deque<Word> words_;               ///< of writes
  std::deque<std::uint64_t> write_due_;  ///< of writes whose last word was taken
};

}  // namespace halfway::core
