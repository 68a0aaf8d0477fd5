// SPDX-License-Identifier: Apache-2.0
// Figure 17 of the spherical paper: its line interpolator, ROM and multiplier in time, from a trace of their
// timing model in GHDL (tb/timing).
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/result.hpp"
#include "sim/figures/figure.hpp"

namespace halfway::figures {

/// What of the trace is drawn. Times are in ns; a pixel of -1 is none.
struct TimingTrace {
  struct Wire {
    std::string signal;
    double from, until;
    int level;
  };
  struct Value {
    std::string signal;
    double from, until;
    int pixel;
    double middle;  ///< of the time before the next value is on its way
    std::string text;
  };
  /// From a signal's input's last move to its own.
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
  std::vector<Span> both;    ///< stage 1 at work while stage 2 is
  std::vector<Span> pixels;  ///< each from its step on
  std::vector<Span> steps;   ///< between two steps
  std::string slope, factor;
  double end = 0.0;
  std::string words;  ///< the trace told, pixel by pixel
};

/// From a VCD file of interpolator_timing_tb's first line, as GHDL writes it: times in fs.
Result<TimingTrace> timing_trace(std::string_view vcd);

void draw_figure_17(const Context& context, Drawing& out);

}  // namespace halfway::figures
