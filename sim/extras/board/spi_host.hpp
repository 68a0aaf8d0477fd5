// SPDX-License-Identifier: Apache-2.0
// An SPI host at the board's pins, one system clock at a time: packets, and the bits of the status byte, of
// docs/board.md.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace halfway::board {

inline constexpr std::uint8_t c_read_status = 0, c_draw = 1, c_end_frame = 2;

/// Bits of the status byte.
inline constexpr unsigned c_room = 0x80, c_ending = 0x40, c_fault = 0x20, c_error = 0x10, c_frames = 0x0f;

/// CRC-16/CCITT-FALSE.
std::uint16_t crc16(std::span<const std::uint8_t> bytes);

/// The packet that draws a triangle: an init vector of this many bits, least significant word first.
std::vector<std::uint8_t> draw_packet(std::span<const std::uint32_t> words, unsigned init_bits);

/// The packet that ends a frame. `background`, RGB565, is that of the next frame.
std::vector<std::uint8_t> end_packet(std::uint16_t background);

struct SpiPins {
  bool select_n = true, clock = false, data = false;
};

/// Packets as levels at the pins, with the shortest times of docs/board.md.
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

struct HostAction {
  enum class Kind {
    /// Read the status until the device can take the packet, then send its first `bits` bits. Wait for
    /// `clocks` clocks before select becomes high.
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
};

/// Sends a script of packets.
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
