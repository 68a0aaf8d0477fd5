// SPDX-License-Identifier: Apache-2.0
// Puts faults into a design's netlist with Yosys, all in one Verilog text: the input `mutsel` selects one.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "common/result.hpp"
#include "mutants/design.hpp"
#include "mutants/replay.hpp"
#include "sim/ghdl/ghdl_library.hpp"

namespace halfway::mutants {

struct Fault {
  std::string kind;   ///< Yosys's mode: inv, const0, const1, cnot0, cnot1
  std::string port;   ///< of a cell
  std::string wire;   ///< at that port, with its bit
  std::string place;  ///< VHDL file and line; empty where the netlist does not say
};

struct FaultyNetlist {
  std::filesystem::path folder;  ///< which holds mutated.v
  std::string top;
  struct Port {
    std::string name;
    std::uint32_t bits = 1;
    bool is_input = false;
  };
  std::vector<Port> ports;
  std::vector<Fault> faults;  ///< `mutsel` is the index and 1
};

/// For each line of the mended netlist the VHDL file and line that GHDL's comments give; empty where there is
/// none. `printed` is the netlist as GHDL prints it.
std::vector<std::string> vhdl_places(const std::string& printed);

/// `scratch` keeps the result; `seed` selects other faults.
Result<FaultyNetlist> make_faulty_netlist(const Design& design, const GhdlLibrary& library,
                                          const std::filesystem::path& scratch, unsigned seed);

/// Compiles the netlist with Verilator.
Result<CompiledNetlist> compile(const Design& design, const FaultyNetlist& netlist,
                                const std::filesystem::path& source, const std::filesystem::path& scratch);

/// For each of the fault numbers: true where a proof says that no output ever differs, from registers that
/// are all zero on and for all inputs. `time` limits each proof.
Result<std::vector<bool>> prove_equivalent(const FaultyNetlist& netlist,
                                           const std::vector<std::uint32_t>& numbers,
                                           std::chrono::seconds time);

}  // namespace halfway::mutants
