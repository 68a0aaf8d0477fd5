// SPDX-License-Identifier: Apache-2.0
// Golden model of rtl/raster/object_stage.vhd: selects the nearest object at each pixel of a line.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "golden/words.hpp"
#include "words/processors_layout.hpp"

namespace halfway::golden {

class ObjectStage {
 public:
  ObjectStage() : entries_(std::size_t{1} << Exact::c_pixel_x_bits) {}

  void clear() { std::fill(entries_.begin(), entries_.end(), Entry{}); }
  /// True if the stage outputs the token. `command` is one of the host's: depth, shadow or draw.
  bool passes(Command command, std::uint32_t x, std::uint32_t z, std::uint32_t triangle) {
    Entry& kept = entries_[x];
    if (command == Command::depth) {
      if (!kept.present || z < kept.z) kept = {true, z, triangle};
      return false;
    }
    if (command == Command::shadow) return kept.present && z < kept.z;
    if (!kept.present || z != kept.z || triangle != kept.triangle) return false;
    kept = {};
    return true;
  }

 private:
  struct Entry {
    bool present = false;
    std::uint32_t z = 0, triangle = 0;
  };
  std::vector<Entry> entries_;
};

}  // namespace halfway::golden
