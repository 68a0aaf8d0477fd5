// SPDX-License-Identifier: Apache-2.0
// What a design costs: GHDL, Yosys and nextpnr, on the families of families.hpp. Errors are thrown as
// Failure.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/cost/design.hpp"
#include "sim/cost/placement.hpp"
#include "sim/cost/yosys.hpp"

namespace halfway::synth {

/// Default number of placements. The clock is their median.
inline constexpr unsigned c_seeds = 3;

/// Limit of nextpnr's processor time over all its threads, independent of the machine's load. A successful
/// placement takes a tenth of it. A placement that exceeds it is repeated with nextpnr's older router within
/// c_most_place_time; if it exceeds that too, it counts as not ended.
inline constexpr std::chrono::seconds c_place_time{20 * 60}, c_most_place_time{40 * 60};

/// The placements of a design that ended, slowest first. The clock is that of the median.
struct Clock {
  std::vector<Placement> placements{};
  unsigned endless = 0;  ///< number of placements that did not end
  std::string none{};    ///< the reason why there is no clock
  const Placement* median() const;
};

/// Reason why `count` exceeds the `most` available on the device; empty if it fits.
std::string does_not_fit(const Device& device, std::string_view what, std::uint64_t count,
                         std::uint64_t most);
/// The same for a design's cells: the first type that exceeds the device.
std::string does_not_fit(const Device& device, const Cells& cells);

/// The wrapper around `top` for nextpnr: a flip-flop before every input except the clock, and one after every
/// output bit. Input flip-flops are a shift register of at most `most_inputs` bits; wider inputs share them.
/// Output bits are combined by exclusive or into a chain of flip-flops. Each exclusive or uses the lookup
/// table that is before a flip-flop on an iCE40.
std::string wrapper(std::string_view netlist, std::string_view top, unsigned most_inputs);

/// The installed GHDL, such as "GHDL 5.0.1". Throws Failure.
std::string ghdl_name();

class Synthesizer {
 public:
  using Folder = std::filesystem::path;
  /// If a tool is missing, the error (exit code tool_failed) names the command that installs it. Without
  /// `place`, the family's placer is not needed.
  static Synthesizer open(const Folder& cache, bool place, const Family& family = c_ice40);

  /// Versions of GHDL, Yosys and the placer.
  const std::string& versions() const { return versions_; }
  const std::string& yosys_version() const { return yosys_.version(); }

  /// Results are taken from the cache if present. Thread-safe.
  /// Cells of a design by itself, without the wrapper that is used to determine its clock.
  Cells cells(const Design& design, const Family& family) const;
  Cells generic_cells(const Design& design) const;
  /// One placement: minutes.
  Placement place(const Design& design, unsigned seed) const;
  /// Number of logic cells with the wrapper. Takes seconds.
  std::uint64_t pack(const Design& design) const;
  /// Reason why the device or the placer has too little room for the design; empty if it can be placed.
  std::string no_room(const Design& design) const;
  /// Placements with the seeds 1 to `seeds`, if there is room.
  Clock clock(const Design& design, unsigned seeds) const;
  /// The synthesized design, as flat Verilog in which each cell is Yosys's simulation model.
  std::string simulated(const Design& design) const;

 private:
  Synthesizer(const Family& family, const Folder& cache)
      : family_(&family), ghdl_cache_(cache), cache_(cache / "synth"), yosys_(Yosys::find(cache_)) {}
  /// Folder with the result of Yosys for the family; mapped.il if it is placed.
  Folder mapped(const Design& design, const Family& family) const;
  /// What Yosys's `script` writes into `file` from mapped.il and wrapper.v, which contains `around`.
  std::string from_mapped(const Design& design, const std::string& script, const std::string& file,
                          const std::string& around) const;
  /// The netlist for nextpnr, with wrapper and global buffers.
  std::string wrapped(const Design& design) const;
  /// Folder with what `run` keeps of nextpnr's output for the netlist.
  Folder placed(const Design& design, const std::string& kind, const std::vector<std::string>& arguments,
                const std::string& netlist, const std::function<void(const Folder&)>& run) const;
  std::vector<std::string> command(const std::vector<std::string>& more) const;  ///< of the placer
  /// One placement with more options of the placer, within a limit of processor time.
  Placement place(const Design& design, unsigned seed, std::chrono::seconds limit,
                  const std::vector<std::string>& options) const;
  const Device& device() const { return *family_->device; }

  const Family* family_;
  Folder ghdl_cache_, cache_;
  Yosys yosys_;
  std::string placer_, versions_;
};

}  // namespace halfway::synth
