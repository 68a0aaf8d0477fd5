// SPDX-License-Identifier: Apache-2.0
#include "sim/generator/word_lengths/compiled_sizes.hpp"

#include <algorithm>

#include "words/cosine_tables.hpp"

namespace halfway::tables {

CosineSizes compiled_sizes() {
  CosineSizes sizes{{}, {}};
  for (const words::CosineTable& table : words::c_cosine_tables) {
    auto& list = table.exact ? sizes.exact : sizes.published;
    if (std::ranges::find(list, table.size) == list.end()) list.push_back(table.size);
  }
  return sizes;
}

}  // namespace halfway::tables
