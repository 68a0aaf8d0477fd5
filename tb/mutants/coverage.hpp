// SPDX-License-Identifier: Apache-2.0
// What of the RTL the tests reach: counters put into the VHDL's text, one at each statement, condition and
// signal, and all testbenches and frames run on it.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "judge.hpp"

namespace halfway::mutants {

/// Of a condition: one that was never false, or never true.
struct Missed {
  std::size_t line;
  std::string text;  ///< of the line, or the condition with what it never was
};

struct FileCoverage {
  std::string file;  ///< in rtl/
  /// Lines on which a statement begins, those of which every statement ran.
  std::size_t lines = 0, lines_run = 0;
  /// Outcomes of conditions: two each.
  std::size_t outcomes = 0, outcomes_seen = 0;
  /// Bits of signals and ports; those that went from 0 to 1 and from 1 to 0 in one of the entity's instances.
  std::size_t bits = 0, bits_toggled = 0;
  std::vector<Missed> missed_lines, missed_outcomes, missed_signals;
};

/// The judge must have frames.
Result<std::vector<FileCoverage>> measure_coverage(const Judge& judge, unsigned workers,
                                                   const std::function<void(const std::string&)>& told);

}  // namespace halfway::mutants
