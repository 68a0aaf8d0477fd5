// SPDX-License-Identifier: Apache-2.0
// Cells of no FPGA family: LUTs with up to four inputs, flip-flops, and bits of writable memory. Tables are
// LUTs. Multipliers are LUTs too, except those of designs with `has_products`, which are counted separately.
#pragma once

#include <compare>
#include <string>
#include <vector>

#include "sim/cost/design.hpp"
#include "sim/cost/yosys.hpp"

namespace halfway::synth {

/// Shape of a multiplier. `square`: both operands are the same word.
struct MultiplierShape {
  bool is_signed = false, square = false;
  unsigned a_bits = 0, b_bits = 0, product_bits = 0;
  friend auto operator<=>(const MultiplierShape&, const MultiplierShape&) = default;
};

/// Shapes of all cells of this type in a netlist in Yosys's JSON format, in file order. Throws Failure.
std::vector<MultiplierShape> read_multiplier_shapes(const std::string& netlist, const std::string& type);

/// Cells::multiplier_luts are those on an iCE40 without DSP blocks: each multiplier is synthesized by itself,
/// with its operands reduced by redundant sign bits.
Cells generic_cells(const Yosys& yosys, const Design& design, const std::string& netlist);

}  // namespace halfway::synth
