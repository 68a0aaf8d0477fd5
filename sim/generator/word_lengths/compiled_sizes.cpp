// SPDX-License-Identifier: Apache-2.0
#include "sim/generator/word_lengths/compiled_sizes.hpp"

#include <algorithm>

#include "words/cosine_tables.hpp"

namespace halfway::tables {

CosineSizes compiled_sizes() {
  CosineSizes sizes{{}, {}};
  for (const words::CosineTable& table : words::c_cosine_tables) {
    auto& list = table.exact ? sizes.exact : sizes.published;
    if (const CosineSize size{table.address_bits, table.data_bits};
        std::ranges::find(list, size) == list.end())
      list.push_back(size);
  }
  return sizes;
}

}  // namespace halfway::tables
