// SPDX-License-Identifier: Apache-2.0
// Numbers in the bytes of a binary file.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <string_view>

namespace halfway {

enum class ByteOrder { little, big };

/// The number at this byte. The bytes must be in the file.
template <class T>
T number_in(std::string_view bytes, std::size_t at, ByteOrder order) {
  constexpr bool c_is_little = std::endian::native == std::endian::little;
  std::array<char, sizeof(T)> value;
  for (std::size_t i = 0; i < sizeof(T); ++i) {
    value[i] = bytes[at + ((order == ByteOrder::little) == c_is_little ? i : sizeof(T) - 1 - i)];
  }
  return std::bit_cast<T>(value);
}

}  // namespace halfway
