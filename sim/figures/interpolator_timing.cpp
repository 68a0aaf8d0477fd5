// SPDX-License-Identifier: Apache-2.0
#include "sim/figures/interpolator_timing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <optional>
#include <set>

#include "sim/engines/ghdl/vcd.hpp"
#include "sim/figures/figure_plot.hpp"
#include "sim/files/timing_diagram.hpp"
#include "sim/os/file.hpp"

namespace halfway::figures {
namespace {

constexpr const char* c_top = "interpolator_timing_tb";

/// A signal's lane in the picture, from top to bottom, and its inputs in the hardware.
struct Lane {
  std::string_view signal;
  std::string_view title;
  std::array<std::string_view, 2> inputs{};
};
constexpr std::array<Lane, 8> c_lanes = {{{"step", "step"},
                                          {"init", "init"},
                                          {"sum", "adder, + ", {"angle"}},
                                          {"next_angle", "multiplexer", {"sum", "init"}},
                                          {"angle", "register", {"step"}},
                                          {"ra", "ra, its bits 11 to 6"},
                                          {"sample", "ROM", {"ra"}},
                                          {"product", "multiplier, × ", {"sample"}}}};

const Lane& lane_of(std::string_view signal) {
  return *std::ranges::find(c_lanes, signal, &Lane::signal);
}

std::string hexadecimal_bits(std::string_view bits) {
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
  // End the signal's current value. Its transition began when its input changed: the value was stable until
  // then.
  void close(const std::string& signal, double began) {
    if (!value_.contains(signal)) return;
    const double since = since_[signal];
    if (wires_.contains(signal))
      trace_.wires.push_back({signal, since, now_, value_[signal] == "1" ? 1 : 0});
    else if (began > since)
      trace_.values.push_back({signal, since, began, pixel_[signal], value_[signal]});
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

TimingTrace timing_trace(const std::filesystem::path& vcd) {
  constexpr double c_femtoseconds = 1e6;  // per nanosecond
  VcdReader reader(vcd);
  TraceBuilder builder;
  const std::string scope = std::string(c_top) + '/';
  for (const auto& [path, signal] : reader.signals())
    if (path.starts_with(scope) && path.find('/', scope.size()) == std::string::npos)
      builder.name(signal.code, path.substr(scope.size()), signal.is_scalar);
  for (;;) {
    const auto change = reader.next();
    builder.at(static_cast<double>(reader.time()) / c_femtoseconds);
    if (!change) break;
    if (change->value.size() > 1)
      builder.change(change->code, hexadecimal_bits(change->value));
    else if (change->value == "0" || change->value == "1")
      builder.change(change->code, change->value);
  }
  TimingTrace trace = builder.finish();
  if (trace.steps.empty() || trace.values.empty())
    throw Failure{tool_failed("the timing model's trace has no steps")};
  return trace;
}

namespace {

TimingTrace simulated(const Context& context) {
  std::vector<VhdlSource> sources = must(read_rtl_sources(context.folders.source));
  std::erase_if(sources, [](const VhdlSource& source) {
    const bool of_tables =
        source.name.find("tables/") != std::string::npos && source.name.ends_with("_pkg.vhd");
    return !of_tables && !source.name.ends_with("raster/line_pkg.vhd");
  });
  const TemporaryFolder scratch = must(TemporaryFolder::make(context.folders.cache));
  const std::filesystem::path vcd = std::filesystem::absolute(scratch.path()) / "trace.vcd";
  for (const char* name : {"tb/rtl/tb_pkg.vhd", "tb/evidence/interpolator_timing/interpolator_timing.vhd",
                           "tb/evidence/interpolator_timing/interpolator_timing_tb.vhd"})
    sources.push_back(must(read_vhdl_source(context.folders.source, name)));
  must(run_testbench(c_top, sources, {"-gg_lines=1", "--vcd=" + vcd.string()}, context.folders.cache));
  return timing_trace(vcd);
}

// Each pixel has the same colour in all lanes: pale when stable, strong while changing. Values of no pixel
// are grey.
unsigned colour_of(int pixel, bool changing) {
  constexpr std::array c_colours = {0x0072b2U, 0x009e73U, 0xd55e00U, 0x8a63d2U};
  const bool known = pixel >= 0 && pixel < static_cast<int>(c_colours.size());
  return (changing ? 0x80000000U : 0xd0000000U) |
         (known ? c_colours[static_cast<std::size_t>(pixel)] : 0x8a8a8aU);
}

std::string script_of(const TimingTrace& trace) {
  TimingDiagram diagram{.end = trace.end, .width = 930, .axis = "time in ns"};
  for (double ns = 0; ns <= trace.end; ns += 30) diagram.ticks.emplace_back(ns, fmt::format("{}", ns));
  diagram.lanes = {{"pixel"}, {"cycle"}, {"both stages at work"}};
  for (std::size_t i = 0; i < trace.pixels.size(); ++i) {
    const auto [from, until] = trace.pixels[i];
    diagram.lanes[0].boxes.push_back(
        {from, until, fmt::format("pixel {}", i), colour_of(static_cast<int>(i), false)});
    diagram.lines.push_back(from);
  }
  for (const auto& [from, until] : trace.steps)
    diagram.lanes[1].boxes.push_back({from, until, fmt::format("{:g} ns", until - from), c_grey_box});
  for (const auto& [from, until] : trace.both) diagram.lanes[2].boxes.push_back({from, until, "", c_red_box});
  for (const Lane& lane : c_lanes) {
    TimingLane shown{std::string(lane.title) + (lane.signal == "sum"       ? trace.slope
                                                : lane.signal == "product" ? trace.factor
                                                                           : "")};
    for (const TimingTrace::Wire& w : trace.wires)
      if (w.signal == lane.signal) shown.levels.push_back({w.from, w.until, w.level != 0});
    for (const TimingTrace::Value& v : trace.values)
      if (v.signal == lane.signal)
        shown.boxes.push_back({v.from, v.until, v.text, colour_of(v.pixel, false)});
    for (const TimingTrace::Work& w : trace.work)
      if (w.signal == lane.signal)
        shown.boxes.push_back(
            {w.from, w.until, fmt::format("{:g}", w.until - w.from), colour_of(w.pixel, true)});
    diagram.lanes.push_back(std::move(shown));
  }
  return timing_script(diagram);
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
            {.title = "Timing of the line interpolator, ROM and multiplier: two stages that overlap",
             .words = trace.words,
             .script = script_of(trace)},
            out);
}

}  // namespace halfway::figures
