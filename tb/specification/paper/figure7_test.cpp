// SPDX-License-Identifier: Apache-2.0
// Figure 7 of the quadratic paper: every register in the golden model and, clock by clock, in GHDL; every
// fragment in Verilator.
#include "sim/figures/figure7.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "frame/fragment.hpp"
#include "sim/engines/verilator/verilator_simulator.hpp"

namespace halfway {
namespace {

using Shader = figures::Figure7Shader;
using Words = figures::TraceWords;
using Figure = figures::Figure7;
using Trace = figures::Figure7Trace;

constexpr std::uint32_t c_triangle = figures::c_figure7_triangle, c_x = figures::c_figure7_x,
                        c_y = figures::c_figure7_y, c_lines = figures::c_figure7_lines;
constexpr std::size_t c_pixels = figures::c_figure7_pixels;

Figure read_figure() {
  return figures::read_figure7(HALFWAY_SOURCE_DIR "/tb/specification/paper/figure7.txt");
}

// The one word that is printed differently from its differences.
constexpr struct {
  const char* name;
  std::size_t at;
  std::uint32_t printed, right;
} c_misprint{"dI(X,Y)", 7, 0x0014DFED, 0x0014DF5D};

// The words that the registers must hold.
Words right_words(const std::string& name, Words words) {
  if (name == c_misprint.name && words.size() > c_misprint.at) {
    EXPECT_EQ(words[c_misprint.at], c_misprint.printed);
    words[c_misprint.at] = c_misprint.right;
  }
  return words;
}

// The published words, as many as are printed, must be equal to the registers' values, except for the
// misprint.
void expect_figure(const Figure& figure, const Trace& trace) {
  EXPECT_TRUE(trace.known);
  for (const auto& [kind, published, seen, count] :
       {std::tuple{"line", &figure.line, &trace.line, std::size_t{c_lines}},
        std::tuple{"pixel", &figure.pixel, &trace.pixel, c_pixels}})
    for (const auto& [name, words] : *published) {
      ASSERT_TRUE(seen->contains(name)) << kind << ' ' << name << " never changed";
      Words held = seen->at(name);
      EXPECT_EQ(held.size(), count) << kind << ' ' << name;
      held.resize(words.size());
      EXPECT_EQ(figures::hexadecimal(held), figures::hexadecimal(right_words(name, words)))
          << kind << ' ' << name;
    }
  // Line k has k pixels.
  Words x, y;
  for (std::uint32_t k = 0; k < c_lines; ++k)
    for (std::uint32_t i = 0; i <= k; ++i) {
      x.push_back(c_x + i);
      y.push_back(c_y + k);
    }
  EXPECT_EQ(trace.pixel_x, x);
  EXPECT_EQ(trace.pixel_y, y);
}

// One pixel per clock. A line is handed over in the clock of the previous line's last pixel. The first pixel
// is in the span stage 4 clocks after the vector is accepted: buffer, edge stage, line stage, span stage.
void expect_clocks(const Trace& trace) {
  std::vector<std::uint64_t> lines, pixels;
  std::uint64_t clock = 4;
  for (std::uint64_t k = 1; k <= c_lines; ++k) {
    lines.push_back(clock - 1);
    for (std::uint64_t i = 0; i < k; ++i) pixels.push_back(clock++);
  }
  EXPECT_EQ(trace.line_clock, lines);
  EXPECT_EQ(trace.pixel_clock, pixels);
}

std::vector<Fragment> golden_fragments(const Figure& figure) {
  std::vector<Fragment> fragments;
  Shader shader;
  shader.draw(figures::figure7_init(figure), [&](const Fragment& f) { fragments.push_back(f); });
  return fragments;
}

SimulatorFolders folders() {
  return {HALFWAY_SOURCE_DIR, HALFWAY_CACHE_DIR};
}

// Checks the figure itself: each register is the sum of its start and of the differences printed next to it.
TEST(figure7, published_numbers_agree_with_their_differences) {
  const Figure figure = read_figure();
  ASSERT_EQ(figure.step.size(), 3U);
  ASSERT_EQ(figure.line.size(), 3U);
  ASSERT_EQ(figure.pixel.size(), 2U);
  const Words &de = figure.line.at("dI_start"), &start = figure.line.at("I_start"),
              &dx = figure.line.at("dI(X_start)");
  const Words pixel_dx = right_words("dI(X,Y)", figure.pixel.at("dI(X,Y)")),
              &pixel = figure.pixel.at("I(X,Y)");
  ASSERT_EQ(de.size(), c_lines);
  ASSERT_EQ(start.size(), c_lines);
  ASSERT_EQ(dx.size(), c_lines);
  ASSERT_EQ(pixel_dx.size(), 8U);
  ASSERT_EQ(pixel.size(), 8U);
  for (std::size_t k = 1; k < c_lines; ++k) {
    EXPECT_EQ(de[k], de[k - 1] + figure.step.at("dI_start")) << k;
    EXPECT_EQ(start[k], start[k - 1] + de[k - 1]) << k;
    EXPECT_EQ(dx[k], dx[k - 1] + figure.step.at("dI(X_start)")) << k;
  }
  std::size_t n = 0;
  for (std::size_t k = 0; k < c_lines; ++k)
    for (std::size_t i = 0; i <= k; ++i, ++n) {
      if (n < pixel_dx.size()) {
        EXPECT_EQ(pixel_dx[n], i == 0 ? dx[k] : pixel_dx[n - 1] + figure.step.at("dI(X,Y)")) << n;
      }
      if (n < pixel.size()) {
        EXPECT_EQ(pixel[n], i == 0 ? start[k] : pixel[n - 1] + pixel_dx[n - 1]) << n;
      }
    }
}

TEST(figure7, golden_model) {
  const Figure figure = read_figure();
  expect_figure(figure, figures::golden_figure7(figure));
  const std::vector<Fragment> fragments = golden_fragments(figure);
  ASSERT_EQ(fragments.size(), c_pixels);
  // The words are 06AF.. to 06D3... Without their 20 fraction bits they are 106 to 109.
  const Words& pixel = figure.pixel.at("I(X,Y)");
  for (std::size_t i = 0; i < pixel.size(); ++i) {
    EXPECT_EQ(fragments[i].red, pixel[i] >> 20);
    EXPECT_EQ(fragments[i].green, pixel[i] >> 20);
    EXPECT_EQ(fragments[i].blue, pixel[i] >> 20);
    EXPECT_EQ(fragments[i].triangle, c_triangle);
  }
}

TEST(figure7, ghdl) {
  const Figure figure = read_figure();
  const Trace trace = figures::rtl_figure7(figure, folders());
  expect_figure(figure, trace);
  expect_clocks(trace);
}

TEST(figure7, verilator) {
  const Figure figure = read_figure();
  auto simulator = VerilatorSimulator::open(figures::figure7_key(), folders());
  ASSERT_TRUE(simulator) << simulator.error().message;
  std::vector<Fragment> fragments;
  const auto init = figures::figure7_init(figure);
  const auto ran = simulator->run(init, fragments, 1000);
  ASSERT_TRUE(ran) << ran.error().message;
  const auto finished = simulator->finish(fragments, 1000);
  ASSERT_TRUE(finished) << finished.error().message;
  EXPECT_EQ(fragments, golden_fragments(figure));
}

}  // namespace
}  // namespace halfway
