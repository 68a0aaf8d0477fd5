// SPDX-License-Identifier: Apache-2.0
#include "sim/extras/board/spi_packet.hpp"

namespace halfway::board {
namespace {

std::vector<std::uint8_t> with_crc(std::vector<std::uint8_t> bytes) {
  const std::uint16_t crc = crc16(bytes);
  bytes.push_back(static_cast<std::uint8_t>(crc >> 8));
  bytes.push_back(static_cast<std::uint8_t>(crc));
  return bytes;
}

}  // namespace

std::uint16_t crc16(std::span<const std::uint8_t> bytes) {
  constexpr std::uint32_t c_polynomial = 0x1021;
  std::uint32_t crc = 0xffff;
  for (const std::uint8_t byte : bytes) {
    crc ^= std::uint32_t{byte} << 8;
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 0x8000) != 0 ? (crc << 1) ^ c_polynomial : crc << 1;
    crc &= 0xffff;
  }
  return static_cast<std::uint16_t>(crc);
}

std::vector<std::uint8_t> draw_packet(std::span<const std::uint32_t> words, unsigned init_bits) {
  std::vector<std::uint8_t> bytes = {c_draw};
  for (std::size_t byte = (init_bits + 7) / 8; byte-- > 0;)
    bytes.push_back(static_cast<std::uint8_t>(words[byte / 4] >> (8 * (byte % 4))));
  return with_crc(std::move(bytes));
}

std::vector<std::uint8_t> end_packet(std::uint16_t background) {
  return with_crc(
      {c_end_frame, static_cast<std::uint8_t>(background >> 8), static_cast<std::uint8_t>(background)});
}

}  // namespace halfway::board
