// SPDX-License-Identifier: Apache-2.0
// Synthesize an entity with GHDL, Yosys and nextpnr: cells on two FPGA families, clock on an iCE40 HX8K.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/result.hpp"
#include "sim/ghdl/ghdl_library.hpp"

namespace halfway::synth {

inline constexpr const char* c_install_tools = "apt-get install yosys nextpnr-ice40";

/// Number of logic cells of an HX8K, and the largest number that nextpnr 0.4's placers can place; they do not
/// finish at 95 %.
inline constexpr std::uint64_t c_device_cells = 7680, c_most_placed = c_device_cells * 9 / 10;
inline constexpr std::uint64_t c_device_rams = 32;

/// Default number of placements. The clock is their median.
inline constexpr unsigned c_seeds = 3;

/// Limit of nextpnr's processor time over all its threads, independent of the machine's load. A successful
/// placement takes a tenth of it.
inline constexpr std::chrono::seconds c_place_time{20 * 60};

/// An entity to synthesize: of rtl/ or of the additional sources given to `open`.
struct Design {
  std::string name;  ///< without spaces; prefix of messages and cache folders
  std::string entity;
  std::vector<std::pair<std::string, std::string>> generics;
};

/// Cells of an entity without the wrapper that is used to determine its clock.
struct Ice40Cells {
  std::uint64_t luts = 0, carries = 0, flip_flops = 0, rams = 0;  ///< SB_LUT4, SB_CARRY, SB_DFF*, SB_RAM40_*
  friend bool operator==(Ice40Cells, Ice40Cells) = default;
};
struct Ecp5Cells {
  std::uint64_t luts = 0;  ///< LUT4, plus two for each CCU2C and four for each TRELLIS_DPR16X4
  std::uint64_t flip_flops = 0, rams = 0, multipliers = 0;  ///< TRELLIS_FF, DP16KD, MULT18X18D
};

/// The routed register-to-register path that limits the clock.
struct CriticalPath {
  std::string from, to;            ///< names of registers, as far as known
  unsigned luts = 0, carries = 0;  ///< on the path
  double logic = 0, routing = 0;   ///< in ns; logic includes clock-to-output and setup times
};

/// One placement and routing.
struct Placement {
  unsigned seed = 0;
  std::uint64_t cells_used = 0, cells_there = 0;  ///< logic cells, including the wrapper's
  double mhz = 0;                                 ///< 0 if it does not fit
  CriticalPath path{};
  bool ended = true;  ///< false: nextpnr did not finish within its time
  bool fits() const { return mhz > 0; }
};

/// Logic cells of a packed design with its wrapper. nextpnr reports no number if the device is too small.
struct Packing {
  std::uint64_t cells_used = 0, cells_there = 0;
};

/// Reason why `count` exceeds the `most` available on the device; empty if it fits.
std::string does_not_fit(std::string_view what, std::uint64_t count, std::uint64_t most);
/// The same for a design's cells: the first type that exceeds the device.
std::string does_not_fit(const Ice40Cells& cells);

/// Read the device's utilisation from nextpnr's output.
Result<Packing> read_packing(std::string_view said);

/// Hash of a design's netlist after GHDL, mend_netlist and nameless. Designs with equal hashes are the same
/// hardware, even if their names differ. With equal flow_hash they have the same clock.
Result<std::string> netlist_hash(const GhdlLibrary& library, const Design& design);
/// The hashes of the netlists inside the design, each with all that it contains: the netlist_hash that the
/// part has if it is synthesized by itself. `entities` are those of the RTL (entities_of).
Result<std::set<std::string>> part_hashes(const GhdlLibrary& library, const Design& design,
                                          const std::set<std::string>& entities);

/// Hash of everything else that a clock depends on, except the tools' versions: Yosys's scripts, the wrapper,
/// the global buffers, nextpnr's options. It is computed from their contents, so that every change changes
/// the hash.
std::string flow_hash();

/// The wrapper around `top` for nextpnr: a flip-flop before every input except the clock, and one after every
/// output bit. Input flip-flops are a shift register of at most `most_inputs` bits; wider inputs share them.
/// Output bits are combined by exclusive or into a chain of flip-flops. Each exclusive or uses the lookup
/// table that is before a flip-flop on this family.
Result<std::string> wrapper(std::string_view netlist, std::string_view top, unsigned most_inputs);

/// Read nextpnr's --report of the design's clock. `netlist` is nextpnr's input; it has the names of the
/// registers at both ends of the path.
Result<Placement> read_placement(std::string_view report, std::string_view netlist, unsigned seed);

class Synthesizer {
 public:
  /// If a tool is missing, the error (exit code tool_failed) names the command that installs it. Without
  /// `place`, nextpnr is not needed. `more`: VHDL sources in addition to those of rtl/, relative to the
  /// project's root. A placement that exceeds `place_time` counts as not ended.
  static Result<Synthesizer> open(const SimulatorFolders& folders, bool place,
                                  const std::vector<std::string>& more = {},
                                  std::chrono::seconds place_time = c_place_time);

  /// Versions of GHDL, Yosys and nextpnr, for the page.
  const std::string& versions() const { return versions_; }
  const std::string& yosys_version() const { return yosys_; }

  /// Results are taken from the cache if present. Thread-safe.
  Result<Ice40Cells> ice40(const Design& design) const;
  Result<Ecp5Cells> ecp5(const Design& design) const;
  Result<Placement> place(const Design& design, unsigned seed) const;
  /// Takes seconds; a placement can take an hour.
  Result<Packing> pack(const Design& design) const;
  /// Reason why an HX8K or nextpnr's placers have too little room for the design; empty if it can be placed.
  Result<std::string> no_room(const Design& design) const;
  Result<std::string> netlist_hash(const Design& design) const;
  /// The design after synthesis for iCE40, as flat Verilog in which each cell is Yosys's simulation model.
  Result<std::string> simulated(const Design& design) const;

 private:
  Synthesizer(GhdlLibrary library, std::filesystem::path cache)
      : library_(std::move(library)), cache_(std::move(cache)) {}
  /// Folder with the result of Yosys's `script` on the netlist, netlist.v.
  Result<std::filesystem::path> synthesized(const Design& design, const std::string& family,
                                            const std::string& script) const;
  Result<std::filesystem::path> ice40_folder(const Design& design) const;
  Result<std::filesystem::path> wrapped_folder(const Design& design) const;
  /// Folder with the result of Yosys's `script` on mapped.il and, unless empty, wrapper.v. For a wrapper, the
  /// global buffers are added to the netlist for nextpnr.
  Result<std::filesystem::path> from_mapped(const Design& design, const std::string& kind,
                                            const std::string& script, const std::string& around) const;
  GhdlLibrary library_;
  std::filesystem::path cache_;
  std::string yosys_, nextpnr_, versions_;
  std::chrono::seconds place_time_ = c_place_time;
};

}  // namespace halfway::synth
