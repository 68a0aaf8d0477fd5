// SPDX-License-Identifier: Apache-2.0
#include "sim/files/timing_diagram.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "sim/files/gnuplot.hpp"

namespace halfway {

std::string timing_script(const TimingDiagram& diagram) {
  constexpr double c_names = 150, c_lane = 26, c_foot = 60;  // pixels
  constexpr double c_character = 7.5;                        // pixels, of a value
  const double width = c_names + diagram.width,
               height = c_foot + c_lane * static_cast<double>(diagram.lanes.size());
  std::string wires, boxes, texts, names;
  double y = static_cast<double>(diagram.lanes.size());
  for (const TimingLane& lane : diagram.lanes) {
    names += fmt::format("set label {} at graph -0.01, first {} right\n", gnuplot_text(lane.name), y);
    for (const auto& [from, until, text, colour] : lane.boxes) {
      boxes += fmt::format("{0} {1} {2} {3} {4} {5} 0x{6:x}\n", (from + until) / 2, y, from, until, y - 0.33,
                           y + 0.33, colour);
      if (c_character * static_cast<double>(text.size()) <= (until - from) / diagram.end * diagram.width)
        texts += fmt::format("{} {} {}\n", (from + until) / 2, y, gnuplot_text(text));
    }
    for (const auto& [from, until, high] : lane.levels)
      wires += fmt::format("{0} {2}\n{1} {2}\n", from, until, y + (high ? 0.3 : -0.3));
    if (!lane.levels.empty()) wires += "\n";
    y -= 1.0;
  }
  std::string script = plot_style(width, height);
  script += fmt::format(
      "set lmargin at screen {}\nset rmargin at screen 0.985\nset tmargin at screen 0.99\n"
      "set bmargin at screen {}\nset xrange [0:{}]\nset yrange [0.4:{}]\nunset ytics\nset border 1\n"
      "set xlabel {} offset 0, 0.5\nset xtics (",
      c_names / width, 50.0 / height, diagram.end, static_cast<double>(diagram.lanes.size()) + 0.6,
      gnuplot_text(diagram.axis));
  for (std::size_t i = 0; i < diagram.ticks.size(); ++i)
    script += fmt::format("{}{} {}", i == 0 ? "" : ", ", gnuplot_text(diagram.ticks[i].second),
                          diagram.ticks[i].first);
  script += ")\n";
  for (const double at : diagram.lines)
    script += fmt::format(
        "set arrow from {0}, graph 0 to {0}, graph 1 nohead linecolor rgb \"#8a8a8a\" linewidth 0.3 back\n",
        at);
  // gnuplot refuses plots of empty blocks.
  std::vector<std::string> plots;
  const auto plot = [&](const char* name, const std::string& block, const char* how) {
    if (block.empty()) return;
    script += fmt::format("${} << EOD\n{}EOD\n", name, block);
    plots.push_back(fmt::format("${} using {}", name, how));
  };
  plot("boxes", boxes,
       "1:2:3:4:5:6:7 with boxxyerror linecolor rgb variable fillstyle solid border linecolor rgb "
       "\"#8a8a8a\"");
  plot("wires", wires, "1:2 with lines linewidth 1.6 linecolor rgb \"#2a9d5c\"");
  plot("texts", texts, "1:2:3 with labels font \",11\"");
  return script + names + fmt::format("plot {}\n", fmt::join(plots, ", "));
}

}  // namespace halfway
