// SPDX-License-Identifier: Apache-2.0
// The pages of halfway_synth: what is measured, and how its rows are printed, judged and written.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "evidence/measured.hpp"
#include "sim/cost/clock_store.hpp"
#include "sim/engines/ghdl/ghdl_library.hpp"

namespace halfway::synth {

inline constexpr const char* c_page = "docs/results/synthesis.md";
inline constexpr const char* c_none = "–";  ///< in a column without a value

struct Options {
  SimulatorFolders folders{".", {}};
  std::string part{}, device{c_hx8k.option};
  bool quick = false, page = false, again = false;
  unsigned jobs = 2, seeds = 0;
};

/// Cells of the listed designs that the options select, on all families.
ExitCode cells(const Options& options);
/// Their clocks on the device. With --page on both: on the ECP5 only of the complete shaders, and on each
/// also of the hardware of studies; writes the stored clocks and docs/performance.md.
ExitCode clocks(const Options& options);
/// Makes the board's bitstream. With --page, writes its figures into docs/board.md.
ExitCode board(const Options& options);

struct Item {
  std::string name;
  std::function<page::Row()> measure;
};
struct Evidence {
  const char* name;
  std::vector<std::string_view> tools;
  std::function<std::vector<page::Value>(std::span<const page::Row>)> values;
};
/// Measures with several jobs at a time. With --page: write the page; a killed run continues. Else print the
/// rows as tables, and each threshold that one breaks.
ExitCode measure(const Options& options, const Evidence& evidence, std::vector<Item> items);

/// The papers' time in ns for a design on an XCV300: per pixel of the quadratic and the spherical shader, per
/// clock of a shading processor.
std::optional<int> published_ns(std::string_view design);
/// The clocks of docs/performance.md: cells and clocks of the shaders on the HX8K, and their clocks on the
/// ECP5. Throws Failure if one of its designs has no clock.
std::string performance_table(const ClockStore& hx8k, const ClockStore& ecp5);

}  // namespace halfway::synth
