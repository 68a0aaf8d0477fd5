// SPDX-License-Identifier: Apache-2.0
// Figure 17 of the spherical paper.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "sim/figures/figure_pictures.hpp"
#include "sim/files/timing_diagram.hpp"
#include "words/generator/cosine.hpp"

namespace halfway::figures {
namespace {

// In ns. Published for an XCV300-6, except those of ROM and multiplier: our assumption, the rest of a step.
constexpr double c_step = 60, c_multiplexer = 5, c_adder = 10, c_register = 5, c_rom = 15, c_multiplier = 35;
static_assert(c_register + c_adder + c_multiplexer < c_step && c_register + c_rom + c_multiplier < c_step);

constexpr int c_line_pixels = 4;
constexpr double c_line_end = (c_line_pixels + 1.5) * c_step;

// A signal's change to a pixel's value. It begins when the signal's input changes.
struct Change {
  double began, at;
  int pixel;
  std::string value;
};

// Each pixel has the same colour in all lanes: pale when stable, strong while changing. Values of no pixel
// are grey.
unsigned colour_of(int pixel, bool changing) {
  constexpr std::array c_colours = {0x0072b2U, 0x009e73U, 0xd55e00U, 0x8a63d2U};
  const bool known = pixel >= 0 && pixel < static_cast<int>(c_colours.size());
  return (changing ? 0x80000000U : 0xd0000000U) |
         (known ? c_colours[static_cast<std::size_t>(pixel)] : 0x8a8a8aU);
}

TimingLane lane_of(std::string name, std::span<const Change> changes) {
  TimingLane lane{std::move(name)};
  Change held{0.0, 0.0, -1, "X"};
  const auto hold = [&](double until) {
    if (until > held.at) lane.boxes.push_back({held.at, until, held.value, colour_of(held.pixel, false)});
  };
  for (const Change& c : changes) {
    hold(c.began);
    held = c;
  }
  hold(c_line_end);
  for (const auto& [began, at, pixel, value] : changes)
    if (began < at)
      lane.boxes.push_back({began, at, fmt::format("{:g}", at - began), colour_of(pixel, true)});
  return lane;
}

}  // namespace

// The first pixels of a line through the slice of figure 12: adder, multiplexer and register, then ROM and
// multiplier. Both stages start with the register.
void draw_figure_17(const Context& context, Drawing& out) {
  constexpr unsigned c_start = 0xB9A, c_slope = 0x2CD, c_factor = 0xC8;
  const tables::CosineTable bell = tables::cosine_table(false, 2, {6, 6});
  TimingDiagram diagram{.end = c_line_end, .width = 930, .axis = "time in ns"};
  for (double ns = 0; ns <= c_line_end; ns += 30) diagram.ticks.emplace_back(ns, fmt::format("{}", ns));
  TimingLane pixels{"pixel"}, cycle{"cycle"}, both{"both stages at work"}, step{"step"}, init{"init"};
  step.levels = {{0, c_step, false}};
  init.levels = {{0, 1.5 * c_step, true}, {1.5 * c_step, c_line_end, false}};
  std::vector<Change> sums, chosen{{0.0, c_multiplexer, 0, fmt::format("{:03X}", c_start)}}, angles,
      addresses, samples, products;
  std::string words;
  double together = 0.0;
  unsigned angle = c_start;
  for (int i = 0; i < c_line_pixels; ++i) {
    const bool last = i + 1 == c_line_pixels;
    const double at = (i + 1) * c_step, next = at + c_step, angle_at = at + c_register,
                 sum_at = angle_at + c_adder, sample_at = angle_at + c_rom,
                 product_at = sample_at + c_multiplier;
    // The multiplexer waits for init after the first step.
    const double choice = i == 0 ? at + c_step / 2 : sum_at;
    const unsigned address = angle >> 6, sample = bell.entries[address], sum = (angle + c_slope) & 0xFFF;
    angles.push_back({at, angle_at, i, fmt::format("{:03X}", angle)});
    addresses.push_back({angle_at, angle_at, i, fmt::format("{:02X}", address)});
    samples.push_back({angle_at, sample_at, i, fmt::format("{:02X}", sample)});
    products.push_back({sample_at, product_at, i, fmt::format("{:04X}", c_factor * sample)});
    sums.push_back({angle_at, sum_at, i + 1, fmt::format("{:03X}", sum)});
    chosen.push_back({choice, choice + c_multiplexer, i + 1, sums.back().value});
    words += fmt::format(
        "{}Pixel {}: angle {} at {:g} ns, ra {} at {:g} ns, sample {} at {:g} ns, product {} at "
        "{:g} ns; next to it the sum for pixel {}, {} at {:g} ns.",
        i == 0 ? "" : " ", i, angles.back().value, angle_at, addresses.back().value, angle_at,
        samples.back().value, sample_at, products.back().value, product_at, i + 1, sums.back().value, sum_at);
    for (const Change& c : {sums.back(), chosen.back()}) {
      const double until = std::min(c.at, product_at);
      if (c.began >= until) continue;
      both.boxes.push_back({c.began, until, "", c_red_box});
      together += until - c.began;
    }
    diagram.lines.push_back(at);
    pixels.boxes.push_back({at, last ? c_line_end : next, fmt::format("pixel {}", i), colour_of(i, false)});
    if (!last) cycle.boxes.push_back({at, next, fmt::format("{:g} ns", c_step), c_grey_box});
    step.levels.push_back({at, at + c_step / 2, true});
    step.levels.push_back({at + c_step / 2, last ? c_line_end : next, false});
    angle = sum;
  }
  diagram.lanes = {pixels,
                   cycle,
                   both,
                   step,
                   init,
                   lane_of(fmt::format("adder, + {:X}", c_slope), sums),
                   lane_of("multiplexer", chosen),
                   lane_of("register", angles),
                   lane_of("ra, its bits 11 to 6", addresses),
                   lane_of("ROM", samples),
                   lane_of(fmt::format("multiplier, × {:X}", c_factor), products)};
  out.measured["cycle of `step`"] = constructed(c_step, "{} ns");
  out.measured["multiplexer"] = constructed(c_multiplexer, "{} ns");
  out.measured["adder"] = constructed(c_adder, "{} ns");
  out.measured["register"] = constructed(c_register, "{} ns");
  out.measured["both stages at work at once"] = constructed(together, "{} ns in {} pixels", c_line_pixels);
  const double rate = 1e9 / (c_step * 1e6);
  out.measured["frames a second at 1000×1000"] = constructed(std::floor(rate), "{} ({:.2f})", rate);
  draw_plot(context, "spherical-17",
            {.title = "Timing of the line interpolator, ROM and multiplier: two stages that overlap",
             .words = words,
             .script = timing_script(diagram)},
            out);
}

}  // namespace halfway::figures
