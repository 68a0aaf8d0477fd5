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
inline constexpr const char* c_placed = "placed";

struct Cost {
  std::string device{};        ///< Device::title
  std::optional<Cells> cells;  ///< generic_cells; std::nullopt without Yosys
  /// On the family's device with registered ports: the median of c_seeds placements.
  std::optional<double> mhz;
  /// Origin of the clock: `stored` or `placed`; otherwise the reason why there is none.
  std::string clock = c_not_placed;
  /// Cells of hardware that was placed, in this run or for the store, without the port registers.
  std::optional<Cells> device_cells;
  /// False: the hardware is larger than the device, so it has no clock.
  bool fits = true;
  /// Tool versions for all values, such as `placed with nextpnr-ecp5 0.7, cells by Yosys 0.52`.
  std::string tools{};
};

/// LUTs and flip-flops, including tables and multipliers built of LUTs. Writable memory counts as one LUT per
/// 16 bits.
double cell_count(const Cells& cells);

/// Costs on the device of one family.
class Costing {
 public:
  /// The source folder has the stored clocks; the cache keeps results of tools.
  Costing(const SimulatorFolders& folders, const Family& family)
      : family_(family),
        cache_(folders.cache),
        clocks_(must(read_clocks(folders.source, family))),
        ghdl_(ghdl_name()) {}

  const ClockStore& clocks() const { return clocks_; }
  /// The stored clock and cells, if there are any. Needs only GHDL.
  Cost stored(const Design& design) const;
  /// Also the generic cells, without Yosys none. `place`: synthesize and place hardware without a stored
  /// clock (minutes). Thread-safe.
  Cost of(const Design& design, bool place) const;

 private:
  void take_size(Cost& cost) const;
  void add_placement(const Synthesizer& synthesizer, const Design& design, Cost& cost) const;
  const Family& family_;
  std::filesystem::path cache_;
  ClockStore clocks_;
  std::string ghdl_;
};

}  // namespace halfway::synth
