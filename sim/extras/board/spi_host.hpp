// SPDX-License-Identifier: Apache-2.0
// An SPI host at the board's pins, one system clock at a time: sends a script of packets.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim/extras/board/spi_wire.hpp"

namespace halfway::board {

struct HostAction {
  enum class Kind {
    /// Read the status until the device can take the packet, then send its first `bits` bits. Wait for
    /// `clocks` clocks
    /// before select becomes high.
    packet,
    pause,  ///< do nothing for `clocks` clocks
    wait,   ///< read the status until no frame is being ended
  };
  Kind kind;
  std::vector<std::uint8_t> bytes{};
  std::uint32_t bits = 0, clocks = 0;
};

inline HostAction whole_packet(std::vector<std::uint8_t> bytes) {
  const auto bits = static_cast<std::uint32_t>(8 * bytes.size());
  return {HostAction::Kind::packet, std::move(bytes), bits};
}

/// The script as text for tb/rtl/board/board_host.vhd: a line "KIND BYTES BITS CLOCKS" per action, with a
/// kind of six characters, and a line with the bytes of a packet in hexadecimal.
std::string script_text(const std::vector<HostAction>& script);

/// What the device has reported in all status bytes.
struct HostReport {
  std::uint64_t packets = 0, status_bytes = 0;
  std::uint64_t errors = 0, faults = 0;  ///< status bytes with the bit
  unsigned frames = 0;                   ///< the counter of the last status byte
  bool operator==(const HostReport&) const = default;
};

class SpiHost {
 public:
  /// The seed of SpiWire's pauses.
  SpiHost(std::vector<HostAction> script, std::uint32_t seed) : script_(std::move(script)), wire_(seed) {}

  /// The levels of the next clock, if the device's data has this level in the present one.
  SpiPins clock(bool device_data);

  bool done() const { return next_ == script_.size() && !wire_.busy(); }
  const HostReport& report() const { return report_; }

 private:
  void plan_next();
  void take_status();
  bool can_take(const HostAction& action) const;

  std::vector<HostAction> script_;
  std::size_t next_ = 0;
  SpiWire wire_;
  enum class Sent { nothing, packet, poll } sent_ = Sent::nothing;
  std::optional<std::uint8_t> status_;  ///< empty: not known since the last packet
  HostReport report_;
};

}  // namespace halfway::board
