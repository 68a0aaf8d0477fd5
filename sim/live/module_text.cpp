// SPDX-License-Identifier: Apache-2.0
#include "sim/live/module_text.hpp"

namespace halfway::live {
namespace {

constexpr unsigned c_character_bits = 7;

void append(std::string& text, unsigned bits) {
  if (bits != 0 && bits != '\r' && bits != '<') {
    text += static_cast<char>(bits);
    return;
  }
  // The character bits + 128 in UTF-8.
  text += static_cast<char>(0xc2);
  text += static_cast<char>(0x80 | bits);
}

}  // namespace

std::string text_of_bytes(std::span<const unsigned char> bytes) {
  std::string text;
  text.reserve(bytes.size() * 6 / 5);
  unsigned waiting = 0, count = 0;  // bits that no character has yet, and their number
  for (const unsigned char byte : bytes) {
    waiting = (waiting << 8) | byte;
    for (count += 8; count >= c_character_bits; count -= c_character_bits) {
      append(text, (waiting >> (count - c_character_bits)) & 0x7f);
    }
    waiting &= 0x7f;
  }
  if (count > 0) append(text, (waiting << (c_character_bits - count)) & 0x7f);
  return text;
}

}  // namespace halfway::live
