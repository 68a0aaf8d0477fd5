// SPDX-License-Identifier: Apache-2.0
// Turns GHDL's Verilog of an entity and its PSL unit into what Yosys reads: assert and assume statements, and
// constants that are numbers.
#pragma once

#include <string>
#include <string_view>

#include "common/result.hpp"

namespace halfway::proofs {

struct PropertyCounts {
  int asserts = 0;
  int assumes = 0;
  bool operator==(const PropertyCounts&) const = default;
};

struct FormalVerilog {
  std::string text;
  PropertyCounts counts;
};

/// A module `top` with a reset starts with it, and its properties are checked from the second clock on. Fails
/// if GHDL has changed the meaning: a negative wide constant, or an assertion of an unknown form.
Result<FormalVerilog> formal_verilog(std::string_view netlist, std::string_view top);

/// The labelled statements `: assert ` and `: assume ` of a unit, outside comments.
PropertyCounts count_properties(std::string_view unit);

}  // namespace halfway::proofs
