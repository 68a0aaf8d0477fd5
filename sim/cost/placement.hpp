// SPDX-License-Identifier: Apache-2.0
// How nextpnr is called, and what it reports of a placed design. Errors are thrown as Failure.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "sim/cost/families.hpp"

namespace halfway::synth {

/// The placer's command for this target clock.
std::vector<std::string> placer_command(const Device& device, int mhz, const std::vector<std::string>& more);

/// The routed register-to-register path that limits the clock.
struct CriticalPath {
  std::string from, to;                             ///< names of registers, as far as known
  unsigned luts = 0, carries = 0, multipliers = 0;  ///< on the path
  double logic = 0, routing = 0;                    ///< in ns; logic includes clock-to-output and setup times
};

/// One placement and routing.
struct Placement {
  unsigned seed = 0;
  double mhz = 0;  ///< 0 if it does not fit
  CriticalPath path{};
  bool ended = true;  ///< false: nextpnr did not finish within its time
  bool fits() const { return mhz > 0; }
};

/// Read nextpnr's --report of the design's clock. `netlist` is nextpnr's input; it has the names of the
/// registers at both ends of the path.
Placement read_placement(std::string_view report, std::string_view netlist, unsigned seed,
                         const PlacedNames& names);

/// Logic cells of a packed design with its wrapper, from the device's utilisation in nextpnr's output.
/// nextpnr reports no number if the device is too small.
std::uint64_t read_packing(std::string_view said, const PlacedNames& names);

}  // namespace halfway::synth
