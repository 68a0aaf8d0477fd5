// SPDX-License-Identifier: Apache-2.0
// The size of a cosine table.
#pragma once

namespace halfway::words {

/// 2^address_bits entries of data_bits each.
struct CosineSize {
  int address_bits = 0, data_bits = 0;
  constexpr int entries() const { return 1 << address_bits; }
  constexpr int largest_entry() const { return (1 << data_bits) - 1; }
  friend constexpr bool operator==(const CosineSize&, const CosineSize&) = default;
};

}  // namespace halfway::words
