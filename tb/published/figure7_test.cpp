// SPDX-License-Identifier: Apache-2.0
// The quadratic paper's figure 7, register by register and clock by clock, in the golden model, in GHDL and
// in Verilator.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "common/file.hpp"
#include "frame/fragment.hpp"
#include "frame/init_file.hpp"
#include "golden/quadratic_shader.hpp"
#include "sim/ghdl/ghdl_runner.hpp"
#include "sim/verilator/verilator_simulator.hpp"

namespace halfway {
namespace {

using golden::Published;
using Shader = golden::QuadraticShader<Published, 1>;
using Words = std::vector<std::uint32_t>;

constexpr std::uint32_t c_triangle = 7, c_x = 20, c_y = 10, c_lines = 4;
constexpr std::size_t c_pixels = c_lines * (c_lines + 1) / 2;
const HardwareKey c_key{.preset = Preset::published, .channels = 1, .probe = true};

struct Figure {
  std::map<std::string, std::uint32_t> step;
  std::map<std::string, Words> line, pixel;
};

Figure read_figure() {
  const std::string path = HALFWAY_SOURCE_DIR "/tb/published/figure7.txt";
  std::ifstream in(path);
  EXPECT_TRUE(in.is_open()) << path << ": cannot open";
  Figure figure;
  for (std::string text; std::getline(in, text);) {
    if (text.empty() || text[0] == '#') continue;
    std::istringstream fields(text);
    std::string kind, name;
    fields >> kind >> name >> std::hex;
    Words words;
    for (std::uint32_t word = 0; fields >> word;) words.push_back(word);
    EXPECT_TRUE(fields.eof()) << path << ": " << text;
    if (kind == "step") {
      EXPECT_EQ(words.size(), 1U) << path << ": " << text;
      figure.step[name] = words.at(0);
    } else {
      EXPECT_TRUE(kind == "line" || kind == "pixel") << path << ": " << text;
      (kind == "line" ? figure.line : figure.pixel)[name] = words;
    }
  }
  return figure;
}

// Edges of slope 0 and 1 pixel a line, so that line k has k pixels.
std::array<std::uint32_t, Shader::c_init_words> init_vector(const Figure& figure) {
  using At = Published::init_header_at;
  using ChannelAt = Published::init_channel_at;
  constexpr std::uint64_t c_one = std::uint64_t{1} << Published::c_edge_x_fraction_bits;
  std::array<std::uint32_t, Shader::c_init_words> init{};
  set_bits(init, At::triangle, c_triangle);
  set_bits(init, At::y, c_y);
  set_bits(init, At::upper_lines, c_lines);
  set_bits(init, At::start_x, c_x * c_one);
  set_bits(init, At::start_slope, 0);
  set_bits(init, At::upper_x, c_x * c_one);
  set_bits(init, At::upper_slope, c_one);
  const auto put = [&](const golden::Field& field, std::uint32_t word) {
    set_bits(init, field, word, Published::c_init_header_bits);
  };
  put(ChannelAt::value, figure.line.at("I_start").at(0));
  put(ChannelAt::dx, figure.line.at("dI(X_start)").at(0));
  put(ChannelAt::de0, figure.line.at("dI_start").at(0));
  put(ChannelAt::dxx, figure.step.at("dI(X,Y)"));
  put(ChannelAt::dxe0, figure.step.at("dI(X_start)"));
  put(ChannelAt::de0e0, figure.step.at("dI_start"));
  return init;
}

constexpr std::array<std::uint32_t, Shader::c_probe_words> c_known{};

// Registers of the probe, event by event, as the figure names them; clocks where there are any.
struct Trace {
  std::map<std::string, Words> line, pixel;
  Words pixel_x, pixel_y;
  std::vector<std::uint64_t> line_clock, pixel_clock;

  /// `unknown` has the bits set that the simulator does not know; none of those may be in a field read here.
  void add(std::span<const std::uint32_t> probe, std::span<const std::uint32_t> unknown,
           std::uint64_t clock) {
    using At = Published::probe_header_at;
    using ChannelAt = Published::probe_channel_at;
    const auto read = [&](const golden::Field& field, int low) {
      EXPECT_EQ(get_bits(unknown, field, low), 0U) << field.name << " in clock " << clock;
      return static_cast<std::uint32_t>(get_bits(probe, field, low));
    };
    const auto channel = [&](const golden::Field& field) {
      return read(field, Published::c_probe_header_bits);
    };
    const auto header = [&](const golden::Field& field) { return read(field, 0); };
    if (header(At::line_event) != 0) {
      line["dI_start"].push_back(channel(ChannelAt::line_de0));
      line["I_start"].push_back(channel(ChannelAt::line_value));
      line["dI(X_start)"].push_back(channel(ChannelAt::line_dx));
      line_clock.push_back(clock);
    }
    if (header(At::span_event) != 0) {
      pixel["dI(X,Y)"].push_back(channel(ChannelAt::span_dx));
      pixel["I(X,Y)"].push_back(channel(ChannelAt::span_value));
      pixel_x.push_back(header(At::span_x));
      pixel_y.push_back(header(At::span_y));
      pixel_clock.push_back(clock);
    }
  }
};

std::string hex(const Words& words) {
  std::string text;
  for (const std::uint32_t word : words) text += fmt::format("{:08X} ", word);
  return text;
}

// The published words, as far as they go, are what the registers held.
void expect_figure(const Figure& figure, const Trace& trace) {
  for (const auto& [kind, published, seen, count] :
       {std::tuple{"line", &figure.line, &trace.line, std::size_t{c_lines}},
        std::tuple{"pixel", &figure.pixel, &trace.pixel, c_pixels}})
    for (const auto& [name, words] : *published) {
      ASSERT_TRUE(seen->contains(name)) << kind << ' ' << name << " never changed";
      Words held = seen->at(name);
      EXPECT_EQ(held.size(), count) << kind << ' ' << name;
      held.resize(words.size());
      EXPECT_EQ(hex(held), hex(words)) << kind << ' ' << name;
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

// One pixel a clock, each line handed over in the clock of the last line's last pixel. The first pixel's
// words are whole 6 clocks after the vector is taken: buffer, edge stage, line stage, span stage, both
// halves.
void expect_clocks(const Trace& trace) {
  std::vector<std::uint64_t> lines, pixels;
  std::uint64_t clock = 6;
  for (std::uint64_t k = 1; k <= c_lines; ++k) {
    lines.push_back(clock - 1);
    for (std::uint64_t i = 0; i < k; ++i) pixels.push_back(clock++);
  }
  EXPECT_EQ(trace.line_clock, lines);
  EXPECT_EQ(trace.pixel_clock, pixels);
}

std::vector<Fragment> golden_fragments(const Figure& figure, Trace* trace = nullptr) {
  struct Watch {
    Trace* trace;
    void line(const Shader& shader) const {
      if (trace != nullptr) trace->add(shader.line_probe(), c_known, 0);
    }
    void span(const Shader& shader, golden::SpanXWord x) const {
      if (trace != nullptr) trace->add(shader.span_probe(x), c_known, 0);
    }
  };
  std::vector<Fragment> fragments;
  Shader shader;
  shader.draw(
      init_vector(figure), [&](const Fragment& f) { fragments.push_back(f); }, Watch{trace});
  return fragments;
}

SimulatorFolders folders() {
  return {HALFWAY_SOURCE_DIR, HALFWAY_CACHE_DIR};
}

// The figure against itself: each register is the sum of its own start and of the differences printed beside
// it.
TEST(figure7, published_numbers_agree_with_their_differences) {
  const Figure figure = read_figure();
  ASSERT_EQ(figure.step.size(), 3U);
  ASSERT_EQ(figure.line.size(), 3U);
  ASSERT_EQ(figure.pixel.size(), 2U);
  const Words &de = figure.line.at("dI_start"), &start = figure.line.at("I_start"),
              &dx = figure.line.at("dI(X_start)");
  const Words &pixel_dx = figure.pixel.at("dI(X,Y)"), &pixel = figure.pixel.at("I(X,Y)");
  ASSERT_EQ(de.size(), c_lines);
  ASSERT_EQ(start.size(), c_lines);
  ASSERT_EQ(dx.size(), c_lines);
  ASSERT_EQ(pixel_dx.size(), 7U);
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
  Trace trace;
  const std::vector<Fragment> fragments = golden_fragments(figure, &trace);
  expect_figure(figure, trace);
  ASSERT_EQ(fragments.size(), c_pixels);
  // 06AF.. to 06D3..: 20 bits of fraction leave 106 to 109.
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
  auto scratch = TemporaryFolder::make(std::filesystem::path(testing::TempDir()) / "figure7");
  ASSERT_TRUE(scratch) << scratch.error().message;
  const auto init = init_vector(figure);
  InitStream stream{Shader::c_init_bits, Words(init.begin(), init.end())};
  const std::filesystem::path init_file = scratch->path() / "init.txt",
                              probe_file = scratch->path() / "probe.txt";
  const auto written = write_init_file(init_file, c_key.name(), stream);
  ASSERT_TRUE(written) << written.error().message;
  const auto runner = GhdlRunner::open(c_key, folders());
  ASSERT_TRUE(runner) << runner.error().message;
  const auto run = runner->run(init_file, scratch->path() / "trace.txt", {.probe_file = probe_file});
  ASSERT_TRUE(run) << run.error().message;
  EXPECT_EQ(run->fragments, c_pixels);

  Trace trace;
  std::ifstream in(probe_file);
  std::uint64_t clock = 6;
  for (std::string bits; in >> clock >> bits;) {
    Words words(Shader::c_probe_words), unknown(Shader::c_probe_words);
    ASSERT_EQ(bits.size(), Shader::c_probe_bits);
    for (std::size_t i = 0; i < bits.size(); ++i) {
      const char bit = bits[bits.size() - 1 - i];
      // Neither 0 nor 1 before the first span: the span's registers.
      if (bit != '0') (bit == '1' ? words : unknown)[i / 32] |= std::uint32_t{1} << (i % 32);
    }
    trace.add(words, unknown, clock);
  }
  EXPECT_TRUE(in.eof());
  expect_figure(figure, trace);
  expect_clocks(trace);
}

TEST(figure7, verilator) {
  const Figure figure = read_figure();
  auto simulator = VerilatorSimulator::open(c_key, folders(), {.record_probes = true});
  ASSERT_TRUE(simulator) << simulator.error().message;
  std::vector<Fragment> fragments;
  const auto init = init_vector(figure);
  const auto ran = simulator->run(init, 1, fragments, 1000);
  ASSERT_TRUE(ran) << ran.error().message;
  const auto finished = simulator->finish(fragments, 1000);
  ASSERT_TRUE(finished) << finished.error().message;
  EXPECT_EQ(fragments, golden_fragments(figure));

  Trace trace;
  for (const ProbeRecord& record : simulator->probes()) trace.add(record.words, c_known, record.cycle);
  expect_figure(figure, trace);
  expect_clocks(trace);
}

}  // namespace
}  // namespace halfway
