// SPDX-License-Identifier: Apache-2.0
// The size of a cosine table.
#pragma once

#include <string>

namespace halfway::words {

/// 2^address_bits entries of data_bits each. Options, keys and generics name it whole: `cosine`.
struct CosineSize {
  int address_bits = 0, data_bits = 0;
  constexpr int entries() const { return 1 << address_bits; }
  constexpr int largest_entry() const { return (1 << data_bits) - 1; }
  friend constexpr bool operator==(const CosineSize&, const CosineSize&) = default;
};
/// Such as `9x8`.
inline std::string to_string(const CosineSize& size) {
  return std::to_string(size.address_bits) + 'x' + std::to_string(size.data_bits);
}
/// Its value of cosine_t in VHDL, such as `rom9x8`. Also in names of hardware keys.
inline std::string vhdl_name(const CosineSize& size) {
  return "rom" + to_string(size);
}

}  // namespace halfway::words
