// SPDX-License-Identifier: Apache-2.0
#include "plan/hardware_units.hpp"

namespace halfway {

std::map<std::string, int> hardware_units(const HardwareKey& key) {
  const int channels = static_cast<int>(key.channels);
  const bool exact = key.preset == Preset::exact;
  std::map<std::string, int> units;
  units["stream_register"] = 2;
  units["triangle_walker"] = 1;
  units["z_interpolator"] = 1;
  units["quadratic_interpolator"] = channels;
  units["saturate"] = channels;
  if (exact) units["edge_walker"] = 2;
  // Edges of preset published; then depth: edge and line; then a channel: three or four along the edge, two
  // along the line.
  units["line_interpolator"] = (exact ? 0 : 2) + 2 + channels * (exact ? 6 : 5);
  // Payloads of the two stream registers and three beside the second; the lower section or the two slopes;
  // depth's constants; a channel's.
  units["parameter_register"] = 5 + (exact ? 1 : 2) + (exact ? 4 : 3) + channels * (exact ? 7 : 4);
  return units;
}

}  // namespace halfway
