// SPDX-License-Identifier: Apache-2.0
// SPI packets as levels at the pins of a host, one system clock at a time, with the shortest times of
// docs/board.md.
#pragma once

#include <cstdint>
#include <deque>
#include <span>
#include <vector>

namespace halfway::board {

struct SpiPins {
  bool select_n = true, clock = false, data = false;
};

class SpiWire {
 public:
  /// Seed 0: no pauses. Otherwise random pauses between bits, bytes and packets.
  explicit SpiWire(std::uint32_t seed) : random_(seed) {}

  /// Sends the first `bits` bits of a packet, then holds select for `hold` clocks more.
  void send(std::span<const std::uint8_t> bytes, std::uint32_t bits, std::uint32_t hold);
  void send(std::span<const std::uint8_t> bytes) {
    send(bytes, static_cast<std::uint32_t>(8 * bytes.size()), 0);
  }
  /// Does nothing for some clocks.
  void idle(std::uint32_t clocks);

  /// The levels of the next clock, if the device's data has this level in the present one.
  SpiPins clock(bool device_data);

  bool busy() const { return !steps_.empty(); }
  /// The device's bytes during the last packet; bits of an incomplete byte are left out.
  const std::vector<std::uint8_t>& received() const { return received_; }

 private:
  /// Levels for a number of clocks.
  struct Step {
    SpiPins pins;
    std::uint32_t clocks;
    bool samples = false;  ///< take the device's bit at the start
  };

  void sample(bool device_data);
  std::uint32_t pause(std::uint32_t one_in, std::uint32_t most);

  std::deque<Step> steps_;
  std::uint32_t random_;
  std::uint32_t bits_ = 0;
  std::uint8_t byte_ = 0;
  std::vector<std::uint8_t> received_;
};

}  // namespace halfway::board
