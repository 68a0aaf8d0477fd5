// SPDX-License-Identifier: Apache-2.0
// Synthesize an entity with GHDL, Yosys and nextpnr: cells on two FPGA families, clock on an iCE40 HX8K.
// Errors are thrown as Failure.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/cost/yosys.hpp"
#include "sim/engines/ghdl/ghdl_library.hpp"

namespace halfway::synth {

/// Number of logic cells of an HX8K, and the largest number that nextpnr 0.4's placers can place; they do not
/// finish at 95 %.
inline constexpr std::uint64_t c_device_cells = 7680, c_most_placed = c_device_cells * 9 / 10;
inline constexpr std::uint64_t c_device_rams = 32;

/// Default number of placements. The clock is their median.
inline constexpr unsigned c_seeds = 3;

/// Limit of nextpnr's processor time over all its threads, independent of the machine's load. A successful
/// placement takes a tenth of it. A placement that exceeds it counts as not ended.
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

/// The placements of a design that ended, slowest first. The clock is that of the median.
struct Clock {
  std::vector<Placement> placements{};
  unsigned endless = 0;  ///< number of placements that did not end
  std::string none{};    ///< the reason why there is no clock
  const Placement* median() const;
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
Packing read_packing(std::string_view said);

/// The wrapper around `top` for nextpnr: a flip-flop before every input except the clock, and one after every
/// output bit. Input flip-flops are a shift register of at most `most_inputs` bits; wider inputs share them.
/// Output bits are combined by exclusive or into a chain of flip-flops. Each exclusive or uses the lookup
/// table that is before a flip-flop on this family.
std::string wrapper(std::string_view netlist, std::string_view top, unsigned most_inputs);

/// Read nextpnr's --report of the design's clock. `netlist` is nextpnr's input; it has the names of the
/// registers at both ends of the path.
Placement read_placement(std::string_view report, std::string_view netlist, unsigned seed);

class Synthesizer {
 public:
  /// If a tool is missing, the error (exit code tool_failed) names the command that installs it. Without
  /// `place`, nextpnr is not needed. `more`: VHDL sources in addition to those of rtl/, relative to the
  /// project's root.
  static Synthesizer open(const SimulatorFolders& folders, bool place,
                          const std::vector<std::string>& more = {});

  /// Versions of GHDL, Yosys and nextpnr.
  const std::string& versions() const { return versions_; }

  /// Results are taken from the cache if present. Thread-safe.
  std::string netlist(const Design& design) const;  ///< by GHDL, mended
  Ice40Cells ice40(const Design& design) const;
  Ecp5Cells ecp5(const Design& design) const;
  /// One placement: minutes.
  Placement place(const Design& design, unsigned seed) const;
  /// Takes seconds.
  Packing pack(const Design& design) const;
  /// Reason why an HX8K or nextpnr's placers have too little room for the design; empty if it can be placed.
  std::string no_room(const Design& design) const;
  /// Placements with the seeds 1 to `seeds`, if there is room.
  Clock clock(const Design& design, unsigned seeds) const;
  /// The design after synthesis for iCE40, as flat Verilog in which each cell is Yosys's simulation model.
  std::string simulated(const Design& design) const;

 private:
  using Folder = std::filesystem::path;
  Synthesizer(GhdlLibrary library, Yosys yosys, Folder cache)
      : library_(std::move(library)), yosys_(std::move(yosys)), cache_(std::move(cache)) {}
  /// Folder with the result of Yosys's `script` on the netlist, netlist.v.
  Folder synthesized(const Design& design, const std::string& family, const std::string& script) const;
  /// Folder with the netlist for iCE40, mapped.il.
  Folder mapped(const Design& design) const;
  /// What Yosys's `script` writes into `file` from mapped.il and wrapper.v, which contains `around`.
  std::string from_mapped(const Design& design, const std::string& script, const std::string& file,
                          const std::string& around) const;
  /// The netlist for nextpnr, with wrapper and global buffers.
  std::string wrapped(const Design& design) const;
  /// Folder with what `run` keeps of nextpnr's output for the netlist.
  Folder placed(const Design& design, const std::string& kind, const std::vector<std::string>& arguments,
                const std::string& netlist, const std::function<void(const Folder&)>& run) const;
  GhdlLibrary library_;
  Yosys yosys_;
  Folder cache_;
  std::string nextpnr_, versions_;
};

}  // namespace halfway::synth
