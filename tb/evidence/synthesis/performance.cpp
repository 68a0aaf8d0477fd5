// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "measure.hpp"
#include "sim/files/template.hpp"
#include "sim/os/must.hpp"

namespace halfway::synth {
namespace {

const StoredClock& placed(const ClockStore& clocks, const Family& family, std::string_view name) {
  const auto found = clocks.find(std::string(name));
  if (found == clocks.end() || found->second.mhz == 0)
    throw Failure{bad_input(
        fmt::format("{}: {}: has no clock, which docs/performance.md shows", clocks_file(family), name))};
  return found->second;
}

}  // namespace

std::optional<int> published_ns(std::string_view design) {
  if (design.starts_with("quadratic_shader_")) return 50;
  if (design.starts_with("spherical_shader_")) return 60;
  if (design.starts_with("shading_processor_")) return 50;
  return {};
}

std::string performance_table(const ClockStore& hx8k, const ClockStore& ecp5) {
  const std::vector<std::string> columns = {"design",     "LUTs",         "flip-flops",       "RAMs",
                                            "clock, MHz", "ns per pixel", "ECP5: clock, MHz", "paper, ns"};
  std::vector<std::vector<std::string>> rows;
  unsigned fewest = ~0U, most = 0;
  for (const char* shader :
       {"quadratic_shader_grey_published", "quadratic_shader_grey_exact", "quadratic_shader_published",
        "spherical_shader_grey_published", "spherical_shader_published", "spherical_shader_grey_exact",
        "spherical_shader_exact"}) {
    const StoredClock& clock = placed(hx8k, c_ice40, shader);
    fewest = std::min(fewest, clock.seeds);
    most = std::max(most, clock.seeds);
    rows.push_back({fmt::format("`{}`", shader), std::to_string(clock.cells.luts),
                    std::to_string(clock.cells.flip_flops), std::to_string(clock.cells.rams),
                    fmt::format("{:.0f}", clock.mhz), fmt::format("{:.1f}", 1000 / clock.mhz),
                    fmt::format("{:.0f}", placed(ecp5, c_ecp5, shader).mhz),
                    std::to_string(published_ns(shader).value())});
  }
  const double diffuse = placed(hx8k, c_ice40, "shading_processor_diffuse_published").mhz,
               specular = placed(hx8k, c_ice40, "shading_processor_specular_published").mhz;
  return markdown_table(columns, rows) +
         fmt::format(
             "\nA clock is the median of {} to {} seeds. A single 24-bit adder reaches {:.0f} MHz, a 40-bit "
             "adder {:.0f} MHz. One folded shading processor of\npreset `published` reaches {:.1f} MHz "
             "(diffuse) and {:.1f} MHz (specular): {:.1f} ns per clock. The paper has {} ns.\n",
             fewest, most, placed(hx8k, c_ice40, "accumulator_24").mhz,
             placed(hx8k, c_ice40, "accumulator_40").mhz, diffuse, specular,
             1000 / std::min(diffuse, specular), published_ns("shading_processor_diffuse_published").value());
}

}  // namespace halfway::synth
