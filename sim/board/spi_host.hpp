// SPDX-License-Identifier: Apache-2.0
// An SPI host at the board's pins, one system clock at a time: sends a script of packets.
#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <vector>

namespace halfway::board {

struct HostAction {
  enum class Kind {
    packet,  ///< read the status until the device can take the packet, then send it
    part,    ///< the same, but stop after `bits` bits for `clocks` clocks, and end the packet there
    pause,   ///< do nothing for `clocks` clocks
    wait,    ///< read the status until no frame is being ended
  };
  Kind kind;
  std::vector<std::uint8_t> bytes{};
  std::uint32_t bits = 0, clocks = 0;
};

/// The script as text for tb/board/board_host.vhd: a line "KIND BYTES BITS CLOCKS" per action, with a kind of
/// six characters, and a line with the bytes of a packet in hexadecimal.
std::string script_text(const std::vector<HostAction>& script);

/// What the device has reported in all status bytes.
struct HostReport {
  std::uint64_t packets = 0, status_bytes = 0;
  std::uint64_t errors = 0, faults = 0;  ///< status bytes with the bit
  unsigned frames = 0;                   ///< the counter of the last status byte
  bool operator==(const HostReport&) const = default;
};

struct SpiPins {
  bool select_n = true, clock = false, data = false;
};

class SpiHost {
 public:
  /// Seed 0: as quick as the device allows. Otherwise random pauses between bits, bytes and packets.
  SpiHost(std::vector<HostAction> script, std::uint32_t seed);

  /// The levels of the next clock, if the device's data has this level in the present one.
  SpiPins clock(bool device_data);

  bool done() const { return next_ == script_.size() && steps_.empty(); }
  const HostReport& report() const { return report_; }

 private:
  /// Levels for a number of clocks.
  struct Step {
    SpiPins pins;
    std::uint32_t clocks;
    bool sample = false;       ///< take the device's bit at the start
    bool ends_status = false;  ///< it is the last bit of the status byte
  };

  void plan_next();
  void plan_packet(const std::vector<std::uint8_t>& bytes, std::uint32_t bits, std::uint32_t hold);
  void sample(const Step& step, bool device_data);
  bool can_take(const HostAction& action) const;
  std::uint32_t pause(std::uint32_t one_in, std::uint32_t most);

  std::vector<HostAction> script_;
  std::size_t next_ = 0;
  std::deque<Step> steps_;
  std::uint32_t random_;
  std::uint8_t received_ = 0;
  bool polls_ = false;         ///< the packet in transfer only reads the status
  bool knows_status_ = false;  ///< received_ is the status after the last packet
  HostReport report_;
};

}  // namespace halfway::board
