// SPDX-License-Identifier: Apache-2.0
// Figure 17 of the spherical paper: timing of its line interpolator, ROM and multiplier, from a trace of
// their timing model in GHDL (tb/evidence/interpolator_timing).
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "sim/figures/figure.hpp"

namespace halfway::figures {

/// The drawn parts of the trace. Times are in ns. A pixel of -1 means no pixel.
struct TimingTrace {
  struct Wire {
    std::string signal;
    double from, until;
    int level;
  };
  /// Until the transition to the next value begins.
  struct Value {
    std::string signal;
    double from, until;
    int pixel;
    std::string text;
  };
  /// Interval from the last change of a signal's input to the signal's own change.
  struct Work {
    std::string signal;
    double from, until;
    int pixel;
  };
  struct Span {
    double from, until;
  };
  std::vector<Wire> wires;
  std::vector<Value> values;
  std::vector<Work> work;
  std::vector<Span> both;    ///< intervals in which both stages are active
  std::vector<Span> pixels;  ///< each starts at its step
  std::vector<Span> steps;   ///< from one step to the next
  std::string slope, factor;
  double end = 0.0;
  std::string words;  ///< description of the trace, pixel by pixel
};

/// Read a VCD file of the first line of interpolator_timing_tb, as written by GHDL; its times are in fs.
/// Throws Failure.
TimingTrace timing_trace(const std::filesystem::path& vcd);

void draw_figure_17(const Context& context, Drawing& out);

}  // namespace halfway::figures
