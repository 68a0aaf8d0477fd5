// SPDX-License-Identifier: Apache-2.0
// Puts faults into a design's netlist by Yosys. One Verilog text contains all faults; the input `mutsel`
// selects one.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "mutants/design.hpp"
#include "mutants/replay.hpp"
#include "sim/engines/ghdl/ghdl_library.hpp"

namespace halfway::mutants {

struct Fault {
  std::string kind;   ///< Yosys's mode: inv, const0, const1, cnot0, cnot1
  std::string port;   ///< of a cell
  std::string wire;   ///< connected to the port, with its bit
  std::string place;  ///< VHDL file and line; empty if the netlist does not give them
  /// false: it sets a bit of a constant to the value that the bit has, or nothing reads the bit
  bool changes = true;
};

struct FaultyNetlist {
  std::filesystem::path folder;  ///< contains mutated.v
  std::string top;
  struct Port {
    std::string name;
    std::uint32_t bits = 1;
    bool is_input = false;
  };
  std::vector<Port> ports;
  std::vector<Fault> faults;  ///< `mutsel` is the index plus 1
};

/// For each line of the mended netlist, the VHDL file and line from GHDL's comments; empty without a comment.
/// `printed` is GHDL's netlist.
std::vector<std::string> vhdl_places(const std::string& printed);

/// The modules of these entities in GHDL's netlist, and those that only such modules contain.
std::set<std::string> modules_of(const std::string& netlist, const std::vector<std::string>& entities);

/// The numbers of the faults that the netlist with faults can select. Yosys removes a fault at an output bit
/// of a cell that nothing reads.
std::set<std::size_t> selectable_faults(const std::string& mutated);

// These functions throw Failure.

/// `scratch` keeps the result. Each `seed` selects other faults.
FaultyNetlist make_faulty_netlist(const Design& design, const GhdlLibrary& library,
                                  const std::filesystem::path& scratch, unsigned seed);

/// Compiles the netlist with Verilator.
CompiledNetlist compile(const Design& design, const FaultyNetlist& netlist,
                        const std::filesystem::path& source, const std::filesystem::path& scratch);

/// For each of the fault numbers: true if a proof shows that no output ever differs, for all inputs, with all
/// registers zero at the start. `time` limits each proof. Nothing is proved of a netlist whose gates take
/// more than a minute to make.
std::vector<bool> prove_equivalent(const FaultyNetlist& netlist, const std::vector<std::uint32_t>& numbers,
                                   std::chrono::seconds time);

}  // namespace halfway::mutants
