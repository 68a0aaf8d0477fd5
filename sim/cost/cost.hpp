// SPDX-License-Identifier: Apache-2.0
// The cost of hardware, from the stored clocks, the cache and the tools. A stored clock belongs to hardware
// with the same netlist, whatever its name is; with another GHDL, to the same hardware_text. Errors are
// thrown as Failure.
#pragma once

#include <optional>
#include <string>

#include "sim/cost/clock_store.hpp"
#include "sim/cost/synthesis.hpp"
#include "sim/engines/ghdl/ghdl_library.hpp"
#include "sim/os/must.hpp"

namespace halfway::synth {

inline constexpr const char* c_not_placed = "not placed";
inline constexpr const char* c_stored = "stored";

struct Cost {
  std::optional<Cells> cells;  ///< generic_cells; std::nullopt without Yosys
  /// On an iCE40 HX8K with registered ports: the median of c_seeds placements.
  std::optional<double> mhz;
  /// Origin of the clock: `stored` or `placed`; otherwise the reason why there is none.
  std::string clock = c_not_placed;
  /// Cells of hardware that was placed, in this run or for the store, without the port registers.
  std::optional<Cells> ice40;
  /// False: the hardware is larger than the device, so it has no clock.
  bool fits = true;
  /// Of hardware that does not fit: the slowest of its parts whose clock is stored, and that clock. The clock
  /// of the whole is not higher. Empty: no part's clock is stored.
  std::string slowest_part{};
  std::optional<double> part_mhz{};
  /// Tool versions for all values, such as `placed with nextpnr-ice40 0.4, cells by Yosys 0.23`.
  std::string tools{};
};

/// LUTs and flip-flops, including tables and multipliers built of LUTs. Writable memory counts as one LUT per
/// 16 bits.
double cell_count(const Cells& cells);

class Costing {
 public:
  /// The source folder has the stored clocks; the cache keeps results of tools.
  explicit Costing(const SimulatorFolders& folders)
      : cache_(folders.cache), clocks_(must(read_clocks(folders.source))), ghdl_(ghdl_name()) {}

  const ClockStore& clocks() const { return clocks_; }
  /// The stored clock and cells, if there are any. Needs only GHDL.
  Cost stored(const Design& design) const;
  /// Also the generic cells, without Yosys none, and the slowest part of hardware that does not fit. `place`:
  /// synthesize and place hardware without a stored clock (minutes). Thread-safe.
  Cost of(const Design& design, bool place) const;

 private:
  void add_slowest_part(const Design& design, Cost& cost) const;
  std::filesystem::path cache_;
  ClockStore clocks_;
  std::string ghdl_;
};

}  // namespace halfway::synth
