// SPDX-License-Identifier: Apache-2.0
// An entity through GHDL, Yosys and nextpnr: its cells on two FPGA families, its clock on an iCE40 HX8K.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/result.hpp"
#include "sim/ghdl/ghdl_library.hpp"

namespace halfway::synth {

inline constexpr const char* kInstallTools = "apt-get install yosys nextpnr-ice40";

/// Logic cells of an HX8K, and of how many nextpnr 0.4's placers come to an end: not of 95 in 100.
inline constexpr std::uint64_t kDeviceCells = 7680, kMostPlaced = kDeviceCells * 9 / 10;
inline constexpr std::uint64_t kDeviceRams = 32;

/// Of how many placements a clock is the median, unless told.
inline constexpr unsigned kSeeds = 3;

/// nextpnr's own, of all its threads: another load of the machine is no other answer. A placement that ends
/// takes a tenth of it.
inline constexpr std::chrono::seconds kPlaceTime{20 * 60};

/// What is synthesized: an entity of rtl/, or of what `open` is given beside it.
struct Design {
  std::string name;  ///< without spaces: messages and the cache's folders begin with it
  std::string entity;
  std::vector<std::pair<std::string, std::string>> generics;
};

/// Of an entity by itself, without what stands around it for its clock.
struct Ice40Cells {
  std::uint64_t luts = 0, carries = 0, flip_flops = 0, rams = 0;  ///< SB_LUT4, SB_CARRY, SB_DFF*, SB_RAM40_*
  friend bool operator==(Ice40Cells, Ice40Cells) = default;
};
struct Ecp5Cells {
  std::uint64_t luts = 0;  ///< LUT4, with the two of a CCU2C and the four of a TRELLIS_DPR16X4
  std::uint64_t flip_flops = 0, rams = 0, multipliers = 0;  ///< TRELLIS_FF, DP16KD, MULT18X18D
};

/// From register to register, the routed one that limits the clock.
struct CriticalPath {
  std::string from, to;            ///< registers, or what is left of their names
  unsigned luts = 0, carries = 0;  ///< on the way
  double logic = 0, routing = 0;   ///< ns; logic with clock-to-output and set-up
};

/// One placement and routing.
struct Placement {
  unsigned seed = 0;
  std::uint64_t cells_used = 0, cells_there = 0;  ///< logic cells with those of the wrapper
  double mhz = 0;                                 ///< 0 where it does not fit
  CriticalPath path{};
  bool ended = true;  ///< false: nextpnr found no end within its time
  bool fits() const { return mhz > 0; }
};

/// What nextpnr packs a design with its wrapper into; it does not say into what where it has no room.
struct Packing {
  std::uint64_t cells_used = 0, cells_there = 0;
};

/// Why the device has no room for so many of what it has `most` of; empty where it has.
std::string does_not_fit(std::string_view what, std::uint64_t count, std::uint64_t most);
/// The same of a design's cells, the first of which there are too many.
std::string does_not_fit(const Ice40Cells& cells);

/// From what nextpnr says of a device's utilisation.
Result<Packing> read_packing(std::string_view said);

/// The hash of a design's netlist by GHDL and mend_netlist, as nameless leaves it. Designs of
/// one hash are the same hardware, whatever their name; with one flow_hash they have the same clock.
Result<std::string> netlist_hash(const GhdlLibrary& library, const Design& design);

/// Of what a clock hangs on beside the netlist and the tools' versions: the scripts for Yosys, the wrapper,
/// the global buffers, nextpnr's options. From what they are, so that no change of them goes without another
/// hash.
std::string flow_hash();

/// The wrapper around `top` for nextpnr: a flip-flop in front of every input but the clock, and one behind
/// every output bit. Input flip-flops are a shift register of at most `most_inputs`; wider inputs share them.
/// Outputs are folded, bit by bit, into a chain of flip-flops: its
/// exclusive or goes into the lookup table that every flip-flop's input passes on this family.
Result<std::string> wrapper(std::string_view netlist, std::string_view top, unsigned most_inputs);

/// What nextpnr reports with --report of the design's clock; `netlist`, what it was given, names the
/// registers at both ends of the path.
Result<Placement> read_placement(std::string_view report, std::string_view netlist, unsigned seed);

class Synthesizer {
 public:
  /// An error (exit code tool_failed) names what installs a missing tool. Without `place` nextpnr need not be
  /// there. `more`: VHDL sources beside those of rtl/, under the project's root. A placement that takes more
  /// than `place_time` has no end.
  static Result<Synthesizer> open(const SimulatorFolders& folders, bool place,
                                  const std::vector<std::string>& more = {},
                                  std::chrono::seconds place_time = kPlaceTime);

  /// Of GHDL, Yosys and nextpnr, for the page.
  const std::string& versions() const { return versions_; }
  const std::string& yosys_version() const { return yosys_; }

  /// Each from the cache where it is there. Threads may call them at once.
  Result<Ice40Cells> ice40(const Design& design) const;
  Result<Ecp5Cells> ecp5(const Design& design) const;
  Result<Placement> place(const Design& design, unsigned seed) const;
  /// A matter of seconds, where a placement may be one of an hour.
  Result<Packing> pack(const Design& design) const;
  /// Why an HX8K has no room for it, or too little for nextpnr's placers; empty where it can be placed.
  Result<std::string> no_room(const Design& design) const;
  Result<std::string> netlist_hash(const Design& design) const;
  /// The design after synthesis for iCE40, in Verilog without modules: every cell as the model that Yosys has
  /// of it.
  Result<std::string> simulated(const Design& design) const;

 private:
  Synthesizer(GhdlLibrary library, std::filesystem::path cache)
      : library_(std::move(library)), cache_(std::move(cache)) {}
  /// Where Yosys has left what `script` makes of the netlist, netlist.v.
  Result<std::filesystem::path> synthesized(const Design& design, const std::string& family,
                                            const std::string& script) const;
  Result<std::filesystem::path> ice40_folder(const Design& design) const;
  Result<std::filesystem::path> wrapped_folder(const Design& design) const;
  /// Where Yosys has left what `script` makes of mapped.il and, where it is not empty, wrapper.v: of
  /// that a netlist for nextpnr, to which the global buffers are added.
  Result<std::filesystem::path> from_mapped(const Design& design, const std::string& kind,
                                            const std::string& script, const std::string& around) const;
  GhdlLibrary library_;
  std::filesystem::path cache_;
  std::string yosys_, nextpnr_, versions_;
  std::chrono::seconds place_time_ = kPlaceTime;
};

}  // namespace halfway::synth
