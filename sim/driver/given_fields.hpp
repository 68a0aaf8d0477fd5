// SPDX-License-Identifier: Apache-2.0
// The fields of the vectors that golden model and RTL get, by name.
#pragma once

#include <string>
#include <vector>

#include "plan/hardware_key.hpp"
#include "words/formats.hpp"

namespace halfway {

/// A field of a flat vector, with the position of its block.
struct PlacedField {
  std::string name;
  words::Field field;
  int block_low;
};

struct GivenFields {
  std::vector<PlacedField> init;    ///< of a triangle's first vector
  std::vector<PlacedField> record;  ///< of a line's record; empty without line records
};

GivenFields given_fields(const HardwareKey& key);

}  // namespace halfway
