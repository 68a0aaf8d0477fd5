// SPDX-License-Identifier: Apache-2.0
// From Verilator's XML of a flattened netlist to C++ that clocks many copies of it at once, one per lane. The
// text calls the operations of sim/extras/lanes/lane_operations.hpp.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "common/result.hpp"
#include "sim/extras/lanes/register_names.hpp"

namespace halfway {

/// Bits of a signal of the RTL, by its path.
struct ObservedPart {
  std::string path;
  unsigned low, bits;
};

/// Ports of the generated hardware. The clock is the input `clk`. `reset` is 1 in reset_step() and 0 in
/// step().
struct LanePorts {
  std::map<std::string, bool> fixed;  ///< inputs of one bit that never change
  std::vector<std::string> outputs;  ///< outputs that are read; logic that only other outputs need is omitted
  std::string top{};                 ///< name of the top module; needed for observed signals
  std::vector<ObservedPart> observed{};  ///< what observe() reads
};

/// The structs State, Inputs and Outputs, the list c_registers, and the functions
///     set_PORT(Inputs&, unsigned lane, const std::uint32_t* words)   for each input wider than a bit
///     step(State&, const Inputs&, Outputs&), reset_step(...)
/// which give the outputs before the clock's rising edge, then the registers after it. Inputs of one bit are
/// masks by their names. Also c_observed_words and the function
///     observe(const State&, const Inputs&, std::uint32_t* words)
/// which writes the words of each part in the first lane before the edge, the least significant first. What
/// the lanes cannot do (an unknown node, arithmetic on more than 64 bits) is an error that names it (exit
/// code tool_failed).
Result<std::string> generate_lanes(std::string_view xml, const LanePorts& ports,
                                   const RegisterNames& names = {});

}  // namespace halfway
