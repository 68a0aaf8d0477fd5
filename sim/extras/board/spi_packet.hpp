// SPDX-License-Identifier: Apache-2.0
// Packets of the board's SPI port, and the bits of its status byte: docs/board.md.
#pragma once

#include <cstdint>
#include <span>
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

}  // namespace halfway::board
