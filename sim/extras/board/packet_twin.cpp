// SPDX-License-Identifier: Apache-2.0
#include "sim/extras/board/packet_twin.hpp"

#include <vector>

#include "sim/extras/board/board_sources.hpp"
#include "sim/extras/board/spi_packet.hpp"

namespace halfway::board {
namespace {

constexpr std::size_t c_around_payload = 3;  ///< bytes of command and CRC

}  // namespace

PacketTwin::PacketTwin() : golden_(make_golden_model(board_key())), back_(0), shown_(back_.dots()) {}

void PacketTwin::take(std::span<const std::uint8_t> packet, std::uint8_t status) {
  if (packet.size() < c_around_payload || crc16(packet) != 0) return;
  const std::span<const std::uint8_t> payload = packet.subspan(1, packet.size() - c_around_payload);
  if (packet[0] == c_draw && (status & c_room) != 0 && payload.size() == (golden_->init_bits() + 7) / 8) {
    std::vector<std::uint32_t> words((golden_->init_bits() + 31) / 32);
    for (std::size_t byte = 0; byte < payload.size(); ++byte)
      words[byte / 4] |= std::uint32_t{payload[payload.size() - 1 - byte]} << (8 * (byte % 4));
    back_.add(golden_->draw(words));
  } else if (packet[0] == c_end_frame && (status & c_ending) == 0 && payload.size() == 2) {
    ended_.push_back(back_.dots());
    back_ = BoardPicture(static_cast<std::uint16_t>(payload[0] << 8 | payload[1]));
  }
}

bool PacketTwin::shows(const DotPicture& dots) {
  if (dots == shown_) return true;
  if (ended_.empty() || dots != ended_.front()) return false;
  shown_ = dots;
  ended_.pop_front();
  return true;
}

}  // namespace halfway::board
