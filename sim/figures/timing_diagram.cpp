// SPDX-License-Identifier: Apache-2.0
#include "sim/figures/timing_diagram.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <optional>
#include <set>

#include "sim/figures/plot.hpp"
#include "sim/figures/testbench.hpp"
#include "sim/ghdl/vcd.hpp"
#include "sim/system/file.hpp"

namespace halfway::figures {
namespace {

constexpr const char* c_top = "interpolator_timing_tb";

/// A signal's lane in the picture, and its inputs in the hardware.
struct Lane {
  std::string_view signal;
  double y;
  std::string_view title;
  std::array<std::string_view, 2> inputs{};
};
constexpr std::array<Lane, 8> c_lanes = {{{"step", 9.7, "step"},
                                          {"init", 8.8, "init"},
                                          {"sum", 7.0, "adder, + ", {"angle"}},
                                          {"next_angle", 6.0, "multiplexer", {"sum", "init"}},
                                          {"angle", 5.0, "register", {"step"}},
                                          {"ra", 3.2, "ra, its bits 11 to 6"},
                                          {"sample", 2.2, "ROM", {"ra"}},
                                          {"product", 1.2, "multiplier, × ", {"sample"}}}};

const Lane& lane_of(std::string_view signal) {
  return *std::ranges::find(c_lanes, signal, &Lane::signal);
}

std::string hexadecimal(std::string_view bits) {
  if (bits.empty() || bits.find_first_not_of("01") != std::string_view::npos) return "X";
  std::string padded((4 - bits.size() % 4) % 4, '0');
  padded += bits;
  std::string text;
  for (std::size_t at = 0; at < padded.size(); at += 4)
    text += "0123456789ABCDEF"[std::stoi(padded.substr(at, 4), nullptr, 2)];
  return text;
}

class TraceBuilder {
 public:
  void name(const std::string& code, const std::string& signal, bool is_wire) {
    const bool shown = std::ranges::find(c_lanes, signal, &Lane::signal) != c_lanes.end();
    if (shown || signal == "slope" || signal == "factor") name_[code] = signal;
    if (is_wire) wires_.insert(signal);
  }
  void at(double ns) { now_ = ns; }
  void change(const std::string& code, const std::string& value) {
    if (const auto found = name_.find(code); found != name_.end()) move(found->second, value);
  }

  TimingTrace finish() {
    trace_.pixels.push_back({step_at_, now_});
    trace_.end = now_;
    for (const Lane& lane : c_lanes) close(std::string(lane.signal), now_);
    for (int i = 0; i < pixels_; ++i)
      trace_.words += fmt::format(
          "{}Pixel {}: angle {}, ra {}, sample {}, product {}; next to it the sum for pixel {}, {}.",
          i == 0 ? "" : " ", i, told_[{i, "angle"}], told_[{i, "ra"}], told_[{i, "sample"}],
          told_[{i, "product"}], i + 1, told_[{i + 1, "sum"}]);
    return std::move(trace_);
  }

 private:
  // End the signal's current value. Its transition began when its input changed.
  void close(const std::string& signal, double began) {
    if (!value_.contains(signal)) return;
    const double since = since_[signal];
    if (wires_.contains(signal))
      trace_.wires.push_back({signal, since, now_, value_[signal] == "1" ? 1 : 0});
    else if (now_ > since)
      trace_.values.push_back({signal, since, now_, pixel_[signal], (since + began) / 2, value_[signal]});
  }

  int pixel_of(const std::string& signal) {
    if (signal == "sum") return pixel_["angle"] + 1;
    if (signal == "next_angle") return value_["init"] == "1" ? 0 : pixel_["sum"];
    if (signal == "sample" || signal == "product") return pixel_[std::string(lane_of(signal).inputs[0])];
    return pixels_ - 1;
  }

  void move(const std::string& signal, const std::string& to) {
    if (const auto held = value_.find(signal); held != value_.end() && held->second == to) return;
    if (signal == "slope" || signal == "factor") {
      value_[signal] = to;
      (signal == "slope" ? trace_.slope : trace_.factor) = to;
      return;
    }
    double began = now_;
    if (to != "X" && !lane_of(signal).inputs[0].empty()) {
      began = 0.0;
      for (const std::string_view input : lane_of(signal).inputs)
        if (!input.empty()) began = std::max(began, since_[std::string(input)]);
    }
    close(signal, began);
    value_[signal] = to;
    since_[signal] = now_;
    pixel_[signal] = to == "X" ? -1 : pixel_of(signal);
    if (signal == "step" && to == "1") {
      if (pixels_ > 0) {
        trace_.pixels.push_back({step_at_, now_});
        trace_.steps.push_back({step_at_, now_});
      }
      ++pixels_;
      step_at_ = now_;
      stage_1_.clear();
    }
    if (to == "X") return;
    told_[{pixel_[signal], signal}] = fmt::format("{} at {:g} ns", to, now_);
    if (began < now_) trace_.work.push_back({signal, began, now_, pixel_[signal]});
    if (signal == "sum" || signal == "next_angle") stage_1_.push_back({began, now_});
    if (signal != "product") return;
    for (const TimingTrace::Span& s : stage_1_)
      if (s.from < now_ && s.until > since_["ra"])
        trace_.both.push_back({std::max(s.from, since_["ra"]), std::min(s.until, now_)});
  }

  TimingTrace trace_;
  std::map<std::string, std::string> name_;  // by the VCD's identifier code
  std::set<std::string> wires_;
  std::map<std::string, std::string> value_;
  std::map<std::string, double> since_;
  std::map<std::string, int> pixel_;
  std::map<std::pair<int, std::string>, std::string> told_;
  std::vector<TimingTrace::Span> stage_1_;  // activity since the last step
  double now_ = 0.0, step_at_ = 0.0;
  int pixels_ = 0;
};

}  // namespace

Result<TimingTrace> timing_trace(const std::filesystem::path& vcd) {
  constexpr double c_femtoseconds = 1e6;  // per nanosecond
  auto reader = VcdReader::open(vcd);
  if (!reader) return reader.error();
  TraceBuilder builder;
  const std::string scope = std::string(c_top) + '/';
  for (const auto& [path, signal] : reader->signals())
    if (path.starts_with(scope) && path.find('/', scope.size()) == std::string::npos)
      builder.name(signal.code, path.substr(scope.size()), signal.is_scalar);
  for (;;) {
    const auto change = reader->next();
    if (!change) return change.error();
    builder.at(static_cast<double>(reader->time()) / c_femtoseconds);
    if (!*change) break;
    const auto& [code, value] = **change;
    if (value.size() > 1)
      builder.change(code, hexadecimal(value));
    else if (value == "0" || value == "1")
      builder.change(code, value);
  }
  TimingTrace trace = builder.finish();
  if (trace.steps.empty() || trace.values.empty())
    return tool_failed("the timing model's trace has no steps");
  return trace;
}

namespace {

TimingTrace simulated(const Context& context) {
  std::vector<VhdlSource> packages = must(read_rtl_sources(context.folders.source));
  std::erase_if(packages, [](const VhdlSource& source) {
    const bool of_tables =
        source.name.find("tables/") != std::string::npos && source.name.ends_with("_pkg.vhd");
    return !of_tables && !source.name.ends_with("raster/line_pkg.vhd");
  });
  const TemporaryFolder scratch = must(TemporaryFolder::make(context.folders.cache));
  const std::filesystem::path vcd = std::filesystem::absolute(scratch.path()) / "trace.vcd";
  run_testbench(
      context, c_top, std::move(packages),
      {"tb/tb_pkg.vhd", "tb/timing/interpolator_timing.vhd", "tb/timing/interpolator_timing_tb.vhd"},
      {"-gg_lines=1", "--vcd=" + vcd.string()});
  return must(timing_trace(vcd));
}

template <class Rows, class Line>
std::string block(const char* name, const Rows& rows, const Line& line) {
  std::string text = fmt::format("${} << EOD\n", name);
  for (std::size_t i = 0; i < rows.size(); ++i) text += line(rows[i], i) + '\n';
  return text + "EOD\n";
}

// Each pixel has the same colour in all lanes: pale when stable, saturated while changing. Values of no pixel
// are grey.
constexpr std::string_view c_drawing = R"(half = 0.31
pales = "0xcfe4f7 0xd2eecb 0xfde1c2 0xe6d9f5 0xededed"
fulls = "0x7ab4e6 0x86cf76 0xf6ae5f 0xb897e0 0xc4c4c4"
number(pixel) = pixel < 0 || pixel > 3 ? 5 : int(pixel) + 1
pale(pixel) = int(word(pales, number(pixel)))
full(pixel) = int(word(fulls, number(pixel)))
ink = "#1f2328"
faint = "#8b949e"
bright = 0xfff1a3
set lmargin at screen 0.15
set rmargin at screen 0.985
set tmargin at screen 0.985
set bmargin at screen 0.165
set yrange [0.6:11.7]
unset key
unset ytics
set border 1 linecolor rgb ink
set xtics 0, 30 out nomirror scale 0.7, 0.35 textcolor rgb ink offset 0, 0.3
set mxtics 6
set xlabel "time in ns" textcolor rgb ink offset 0, 0.7
set label 9 "{/:Bold Stage 1}: line interpolator" at graph -0.138, first 7.85 left textcolor rgb ink
set label 10 "{/:Bold Stage 2}: ROM and multiplier" at graph -0.138, first 4.05 left textcolor rgb ink
array swatches[4] = [pale(0), pale(-1), full(0), bright]
array meanings[4] = ["hexadecimal value, in its pixel's colour", "no pixel's", "new value forms, for 10 ns", \
  "both stages at work"]
array places[4] = [0.15, 0.472, 0.597, 0.829]
set for [i = 1:4] object i rectangle from screen places[i], 0.03 to screen places[i] + 0.026, 0.06 \
  fillcolor rgb swatches[i] fillstyle solid border linecolor rgb ink
set for [i = 1:4] label 10 + i meanings[i] at screen places[i] + 0.031, 0.045 left textcolor rgb ink
set label 15 "10" at screen places[3] + 0.013, 0.045 center font ",10" textcolor rgb ink front
set style fill solid noborder
plot \
  $both using 1:(4):1:2:(0.75):(7.5) with boxxyerror linecolor rgb bright, \
  $pixels using 2:(0.6):(0):(10.1) with vectors nohead linecolor rgb faint dashtype (3, 3), \
  $pixels using 2:(11.2):2:3:(10.95):(11.55):(pale($1)) with boxxyerror linecolor rgb variable, \
  $pixels using (($2 + $3) / 2):(11.25):(sprintf("pixel %d", $1)) with labels textcolor rgb ink, \
  $steps using 1:(10.5):($2 - $1):(0) with vectors heads filled size 3, 15 linecolor rgb ink, \
  $steps using (($1 + $2) / 2):(10.68):(sprintf("%g ns", $2 - $1)) with labels textcolor rgb ink, \
  $values using 2:1:2:3:($1 - half):($1 + half):(pale($4)) with boxxyerror linecolor rgb variable, \
  $work using 2:1:2:3:($1 - half):($1 + half):(full($4)) with boxxyerror linecolor rgb variable, \
  $values using 2:1:2:3:($1 - half):($1 + half) with boxxyerror fillstyle empty linecolor rgb ink, \
  $wires using 2:($1 + half * (2 * $4 - 1)):($3 - $2):(0) with vectors nohead linecolor rgb ink linewidth 1.5, \
  $wires using ($2 > 0 ? $2 : NaN):($1 - half):(0):(2 * half) with vectors nohead linecolor rgb ink linewidth 1.5, \
  $values using ($3 - $2 > 10 ? $5 : NaN):1:6 with labels textcolor rgb ink, \
  $work using (($2 + $3) / 2):1:(sprintf("%g", $3 - $2)) with labels font ",10" textcolor rgb ink
)";

std::string script_of(const TimingTrace& trace) {
  const auto span = [](const TimingTrace::Span& s, std::size_t) {
    return fmt::format("{} {}", s.from, s.until);
  };
  std::string text;
  text += block("both", trace.both, span);
  text += block("steps", trace.steps, span);
  text += block("pixels", trace.pixels, [](const TimingTrace::Span& s, std::size_t i) {
    return fmt::format("{} {} {}", i, s.from, s.until);
  });
  text += block("wires", trace.wires, [](const TimingTrace::Wire& w, std::size_t) {
    return fmt::format("{} {} {} {}", lane_of(w.signal).y, w.from, w.until, w.level);
  });
  text += block("values", trace.values, [](const TimingTrace::Value& v, std::size_t) {
    return fmt::format("{} {} {} {} {} {}", lane_of(v.signal).y, v.from, v.until, v.pixel, v.middle, v.text);
  });
  text += block("work", trace.work, [](const TimingTrace::Work& w, std::size_t) {
    return fmt::format("{} {} {} {}", lane_of(w.signal).y, w.from, w.until, w.pixel);
  });
  text += fmt::format("set xrange [0:{}]\n", trace.end);
  for (std::size_t i = 0; i < c_lanes.size(); ++i)
    text += fmt::format("set label {} \"{}{}\" at graph -0.012, first {} right textcolor rgb '#1f2328'\n",
                        i + 1, c_lanes[i].title,
                        c_lanes[i].signal == "sum"       ? trace.slope
                        : c_lanes[i].signal == "product" ? trace.factor
                                                         : "",
                        c_lanes[i].y);
  return text + std::string(c_drawing);
}

// Print a single value, such as "5 ns", if all are equal. The model's delays are the published ones.
Measured always(const std::vector<double>& times) {
  const auto [least, most] = std::ranges::minmax(times);
  if (least != most) return {fmt::format("{} to {} ns", least, most)};
  return constructed(least, "{} ns");
}

}  // namespace

void draw_figure_17(const Context& context, Drawing& out) {
  const TimingTrace trace = simulated(context);
  std::vector<double> steps;
  for (const TimingTrace::Span& s : trace.steps) steps.push_back(s.until - s.from);
  out.measured["cycle of `step`"] = always(steps);
  const double rate = 1e9 / (steps.front() * 1e6);
  out.measured["frames a second at 1000×1000"] = constructed(std::floor(rate), "{} ({:.2f})", rate);
  for (const auto& [what, signal] :
       {std::pair{"multiplexer", "next_angle"}, {"adder", "sum"}, {"register", "angle"}}) {
    std::vector<double> times;
    for (const TimingTrace::Work& w : trace.work)
      if (w.signal == signal) times.push_back(w.until - w.from);
    if (times.empty())
      throw Failure{tool_failed(fmt::format("the timing model's trace has no work of {}", signal))};
    out.measured[what] = always(times);
  }
  double together = 0.0;
  for (const TimingTrace::Span& s : trace.both) together += s.until - s.from;
  out.measured["both stages at work at once"] =
      constructed(together, "{} ns in {} pixels", trace.pixels.size());
  draw_plot(context, "spherical-17",
            {.size = {1080, 590},
             .title = "Timing of the line interpolator, ROM and multiplier: two stages that overlap",
             .words = trace.words,
             .script = script_of(trace)},
            out);
}

}  // namespace halfway::figures
