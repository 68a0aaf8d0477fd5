// SPDX-License-Identifier: Apache-2.0
// A measured figure on a page is written by a command, or quoted from what a program prints, or listed here
// with its source.
#include "structure/figures.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "evidence/evidence.hpp"
#include "golden/formats.hpp"
#include "plan/processor_clocks.hpp"
#include "setup/setup.hpp"
#include "sim/synth/bitstream.hpp"
#include "sim/synth/pinned.hpp"
#include "sim/synth/synthesis.hpp"
#include "sim/system/file.hpp"
#include "sim/system/test/source_folder.hpp"

namespace halfway {
namespace {

namespace fs = std::filesystem;

std::string text_of(const std::string& file) {
  const auto text = read_file(c_source_folder / file);
  EXPECT_TRUE(text) << text.error().message;
  return text ? *text : std::string();
}

// Words separated by one space.
std::string words_of(std::string_view text) {
  std::string words;
  for (const char c : text)
    if (c != ' ' && c != '\n')
      words += c;
    else if (!words.empty() && words.back() != ' ')
      words += ' ';
  return words;
}

// A measured value of a row of evidence.
std::string measured(const std::string& file, const std::string& name, const std::string& column) {
  const auto rows = evidence::read_rows(c_source_folder / file);
  EXPECT_TRUE(rows) << rows.error().message;
  for (const evidence::Row& row : rows ? *rows : std::vector<evidence::Row>())
    for (const auto& [key, value] : row.fields)
      if (row.name == name && key == column) return value;
  ADD_FAILURE() << file << ": no row " << name << " with a column " << column;
  return {};
}

std::string accuracy(const std::string& row) {
  return measured("tb/accuracy/evidence.txt", row, "largest error");
}

std::string intensity(const std::string& preset, const std::string& column) {
  return measured("tb/bounds/evidence.txt", "Formats_of_preset_" + preset + "/intensity", column);
}

double number_of(const std::string& text) {
  return std::strtod(text.c_str(), nullptr);
}

double pinned_mhz(const std::string& design) {
  const auto pins = synth::read_pins(c_source_folder / synth::c_pins);
  EXPECT_TRUE(pins) << pins.error().message;
  return pins ? pins->at(design).mhz : 0;
}

// A sentence of a page with figures. Where possible it is formed from rows of evidence, pins and constants of
// the program. Otherwise a file has the source of its figures, in this text.
struct Sourced {
  std::string page, sentence;
  std::string file{}, source{};
};

// The bound of spans to smaller x on the largest frame, rounded up to three decimals.
double backward_bound() {
  constexpr double c_lines = 4095, c_steps = 4095;
  constexpr double c_units =
      1 + c_lines + c_steps + c_lines * (c_lines - 1) / 2 + c_lines * c_steps + c_steps * (c_steps + 1) / 2;
  return std::ceil(1000 * std::ldexp(c_units / 2, -golden::Exact::c_intensity_fraction_bits)) / 1000;
}

// The number with a space between groups of three digits.
std::string spaced(std::int64_t number) {
  std::string digits = std::to_string(number);
  for (int at = static_cast<int>(digits.size()) - 3; at > 0; at -= 3)
    digits.insert(static_cast<std::size_t>(at), 1, ' ');
  return digits;
}

// The example of docs/results/bounds.md: the bound of `intensity` in preset exact, computed again.
std::vector<Sourced> bounds_example() {
  constexpr std::int64_t c_lines = 4095, c_carries = 4095, c_pixels = 4095;
  constexpr std::int64_t c_k = c_lines + c_carries + c_pixels, c_seconds = c_k * (c_k - 1) / 2;
  const std::string page = "docs/results/bounds.md", sum = spaced(1 + c_k + c_seconds);
  constexpr int c_fraction = golden::Exact::c_intensity_fraction_bits;
  return {{page, fmt::format("| k | lines + steps = lines + carries + pixels: all additions from the first "
                             "pixel of the triangle to this pixel | at most {} |",
                             spaced(c_k))},
          {page, fmt::format("with k = L + K | at most {} |", spaced(c_seconds))},
          {page, fmt::format("{} fraction bits, so u = 2^-{}, and k = {} + {} = {}.", c_fraction, c_fraction,
                             c_lines, c_carries + c_pixels, spaced(c_k))},
          {page,
           fmt::format("1 + k + k (k - 1) / 2 = 1 + {} + {} = {} {} · 2^-{} / 2 = {} colour steps",
                       spaced(c_k), spaced(c_seconds), sum, sum, c_fraction, intensity("exact", "derived"))},
          {page, fmt::format("The stated bound is {}. The largest error found is {},",
                             number_of(intensity("exact", "bound")), intensity("exact", "found"))}};
}

// Figures that the test forms from measured rows, pins and constants.
std::vector<Sourced> formed() {
  const double bound = number_of(intensity("exact", "bound"));
  std::vector<Sourced> list = {
      {"README.md",
       fmt::format(
           "| 2 additions per channel | {:.0f} MHz | {}/255 (`adaptive`: triangles split where needed) |",
           pinned_mhz("quadratic_shader_grey_exact"), accuracy("quadratic_shader/conservative_test"))},
      {"README.md",
       fmt::format("1 to 3 products per light and term | {:.0f} MHz | {}/255 |",
                   pinned_mhz("spherical_shader_grey_exact"), accuracy("spherical_shader/ends_on_surface"))},
      {"README.md",
       fmt::format("does not fit the FPGA (iCE40 HX8K) | {}/255 |", accuracy("shading_processors/exact"))},
      {"docs/accuracy.md", fmt::format("`--threshold` (default {} colour steps) sets the limit. A triangle "
                                       "is split up to {} times (`--max-level`).",
                                       QuadraticSetupOptions{}.threshold, QuadraticSetupOptions{}.max_level)},
      {"docs/accuracy.md",
       fmt::format("at most `--threshold` (default {} colour steps)", SphericalSetupOptions{}.threshold)},
      {"docs/accuracy.md",
       fmt::format("at most {:.4f}, stated as {} | at most {:.2f}, stated as {},",
                   number_of(intensity("exact", "derived")), bound,
                   number_of(intensity("published", "derived")), number_of(intensity("published", "bound")))},
      {"docs/accuracy.md",
       fmt::format("| 0.5 colour steps: the 8-bit colour of `exact` is within {} of the quadratic,",
                   bound + 0.5)},
      {"docs/accuracy.md",
       fmt::format("|n| (|n| + 1) / 2) · u / 2: at most {:.3f} colour steps.", backward_bound())},
      {"docs/accuracy.md",
       fmt::format("the largest error found (`exact`: {:.4f})", number_of(intensity("exact", "found")))},
      {"docs/results/synthesis.md",
       fmt::format("LUTs and carries within {} % or {}, the median clock within {} %.",
                   100 * synth::c_lut_share, synth::c_lut_slack, 100 * synth::c_clock_share)},
      {"sim/studies/README.md",
       fmt::format("than {} logic cells, more than {} RAMs,", synth::c_device_cells, synth::c_device_rams)},
  };
  // The board: its largest SPI clock, and batches of 16 pixels in 52 clocks while scan-out takes a tenth of
  // them.
  list.push_back({"docs/board.md",
                  fmt::format("at most {} MHz (a quarter of the system clock)", synth::c_board_mhz / 4.0)});
  list.push_back(
      {"docs/board.md", fmt::format("so at {0} MHz large triangles that have been received are drawn at "
                                    "{0} · 0.9 · 16 / 52 = {1:.1f} million fragments per second:",
                                    synth::c_board_mhz, synth::c_board_mhz * 0.9 * 16 / 52)});
  std::ranges::copy(bounds_example(), std::back_inserter(list));
  // The table of the folded processor's clocks.
  for (const ProcessorClocks& row : c_processor_clocks) {
    const auto cell = [](std::optional<unsigned> clocks) { return clocks ? std::to_string(*clocks) : "–"; };
    const std::string what = row.light || row.term ? fmt::format("| {} ", row.what) : "";
    list.push_back({"docs/rtl/processors.md", fmt::format("{}| {} | {} | {} |", what, cell(row.paper),
                                                          cell(row.published), cell(row.exact))});
  }
  return list;
}

// Figures whose source is another text. If that text changes, so must the page.
std::vector<Sourced> quoted() {
  return {
      // Measured by hand. The job runs both commands on a bare machine.
      {"README.md",
       "On a new installation with two cores `make sim` takes 5 to 13 minutes, most of it installation "
       "and build, and `make test` 24 to 88 minutes.",
       ".github/workflows/ci.yml", "- run: make sim - run: make test"},
      // Bounds and limits that other tests check.
      {"docs/accuracy.md", "rounding of the samples | 3.2·10⁻⁹ colour steps (`exact`)",
       "tb/bounds/evidence.txt", "bound = 3.2e-09 colour steps"},
      {"docs/accuracy.md", "8·10⁻⁷ (`published`)", "tb/bounds/evidence.txt", "bound = 8e-07 colour steps"},
      {"docs/accuracy.md", "within 5.00 colour steps", "model/shading/bell_test.cpp",
       "constexpr double c_most = 5.0,"},
      {"docs/accuracy.md", "The largest error found is 4.92,", "model/shading/bell_test.cpp",
       "EXPECT_NEAR(worst.total(), 4.92, 0.005);"},
      {"docs/accuracy.md", "at n = 2.65,", "model/shading/bell_test.cpp",
       "EXPECT_NEAR(worst_exponent, 2.65, 0.005);"},
      {"docs/accuracy.md", "of which the fit has 3.14:", "model/shading/bell_test.cpp",
       "EXPECT_NEAR(worst.fit, 3.14, 0.005);"},
      {"docs/accuracy.md", "off by up to 8.67 colour steps", "model/shading/bell_test.cpp",
       "EXPECT_NEAR(most, 8.67, 0.01)"},
      {"docs/accuracy.md", "(n = 1.305)", "model/shading/bell_test.cpp", "EXPECT_NEAR(at, 1.305, 0.01);"},
      {"docs/accuracy.md", "A highlight is within 0.99 colour steps of 255 cosⁿ",
       "model/shading/bell_test.cpp", "EXPECT_NEAR(all.total(), 0.99, 0.005);"},
      {"docs/accuracy.md", "Diffuse light is within 0.86 colour steps.", "model/shading/bell_test.cpp",
       "EXPECT_NEAR(diffuse, 0.86, 0.005);"},
      {"docs/accuracy.md", "A factor is at most 65 535 colour steps, 257 times white.",
       "model/setup/spherical_setup_test.cpp", "c_limit = c_exact ? 65535 : 1023;"},
      {"docs/accuracy.md", "clamps factors at 1023 colour steps, four times white.",
       "model/setup/spherical_setup_test.cpp", "c_limit = c_exact ? 65535 : 1023;"},
      {"docs/results/bounds.md", "the error is four colour steps, and the bound is 4.0.",
       "tb/bounds/rule_test.cpp",
       "EXPECT_EQ(worst_pixel(rule, fragments), 4); EXPECT_NEAR(rule.bound, 4.0, 0.01);"},
      {"docs/results/bounds.md", "drift by 8 addresses in 1024 pixels,", "tb/bounds/evidence.txt",
       "| 6 | 1023 | 8 | 7.998 |"},
      {"docs/results/bounds.md", "off by up to 0.014 of its light, 3.5 colour steps.",
       "tb/bounds/evidence.txt", "bound = 0.014 of the spot's light"},
      {"tb/oracle/README.md", "depth within 0.5 + 0.19 steps", "tb/oracle/oracle_test.cpp",
       "c_depth_tolerance = 0.5L + 0.19L;"},
      {"docs/board.md", "Levels of 3.3 V", "rtl/board/board.pcf", "Levels of 3.3 V"},
      // Constants of the program.
      {"docs/performance.md", "have 2²⁶ pixels or more.", "sim/run/open_engine.hpp",
       "c_least_lane_pixels = double(1U << 26);"},
      {"sim/scenes/README.md", "10 million triangles, 30 million vertices,", "model/scene/scene.hpp",
       "c_max_triangles = 10'000'000;"},
      {"sim/scenes/README.md", "4 GiB.", "sim/scene_files/load_mesh.cpp",
       "c_max_file_bytes = std::uintmax_t{4} << 30;"},
      {"sim/studies/README.md", "FLIP above 0.0575,", "sim/pictures/perception.hpp",
       "FLIP (flip.hpp) is above 0.0575,"},
      {"sim/figures/page.md.mustache", "is above 0.0575 there,", "sim/pictures/perception.hpp",
       "FLIP (flip.hpp) is above 0.0575,"},
      {"tb/fuzz/README.md", "a replay of 20 seconds or more is a failure.", "tb/fuzz/replay.cpp",
       "c_longest{20};"},
      {"sim/bench/page.md.mustache",
       "in space for at most four times as many), and space for two million fragments",
       "sim/lanes/lane_runner.hpp", "c_kept_room = std::size_t{1} << 21;"},
      {"sim/bench/page.md.mustache", "{{outline}} of a million pixels", "sim/bench/program/way_table.cpp",
       "1e6 * picture->outline_off"},
      {"sim/bench/page.md.mustache", "over the last quarter of an hour.",
       "sim/bench/program/halfway_bench.cpp", "::getloadavg(minutes.data(), 3)"},
      {"sim/bench/page.md.mustache", "the last column below 100 %,", "sim/bench/page.md.mustache",
       "| ours relative to it |"},
      // The papers' example, and what a transcript on the same page prints.
      {"sim/bench/page.md.mustache", "draws 30 frames of a million pixels per second;", "docs/effects.md",
       "M = 1000000 pixels, 30 frames a second,"},
      {"docs/rtl/quadratic.md",
       "with the value 162.176. Two pixels later it is 162.176 − 1.044 − (1.044 + 1.035) = 159.053. The "
       "start value contains 0.5. `saturate` drops the fraction: 159.053 gives 159.",
       "docs/rtl/quadratic.md", "grey span_value golden 09f0d886d3 = 159.052863"},
      {"docs/rtl/spherical.md", "That is 4.578 + 114.953 · 253/256 + 45.016 · 250/256 = 162.14.",
       "docs/rtl/spherical.md", "light 1 diffuse product golden 00719b24 = 113.606018"},
      {"docs/rtl/processors.md", "162.83 gives 162.", "docs/rtl/processors.md",
       "grey so far golden 0a2d51 = 162.832275"},
  };
}

// Pages that commands write from this heading on, as docs/README.md lists them; empty: the whole page.
const std::map<std::string, std::string>& written_from() {
  static const std::map<std::string, std::string> c_headings = {
      {"CHANGELOG.md", ""},  // history: measured at the time
      {"docs/results/bounds.md", "## Formats of preset exact"},
      {"docs/results/figures/README.md", ""},  // its template is tested
      {"docs/results/hard_cases.md", "## Search: triangles"},
      {"docs/results/mutants.md", "## Netlist faults"},
      {"docs/results/proofs.md", "## Results"},
      {"docs/results/speed.md", ""},  // its template is tested
      {"docs/results/synthesis.md", "## Figures"},
      {"docs/rtl/init-vectors.md", ""},
  };
  return c_headings;
}

// What a person writes of each page and each template of a page.
std::map<std::string, HandWritten> hand_written_pages() {
  std::map<std::string, HandWritten> pages;
  for (fs::recursive_directory_iterator it(c_source_folder), end; it != end; ++it) {
    const std::string name = it->path().filename();
    if (it->is_directory() && (name == "build" || name.starts_with('.'))) it.disable_recursion_pending();
    if (!name.ends_with(".md") && !name.ends_with(".md.mustache")) continue;
    const std::string page = fs::relative(it->path(), c_source_folder);
    std::string text = text_of(page);
    if (const auto written = written_from().find(page); written != written_from().end()) {
      const std::size_t from = text.find(written->second);
      EXPECT_NE(from, std::string::npos) << page << ": no heading " << written->second;
      text.resize(std::min(from, text.size()));
    }
    pages.emplace(page, HandWritten(text));
  }
  return pages;
}

TEST(Pages, FiguresHaveASource) {
  const std::map<std::string, HandWritten> pages = hand_written_pages();
  std::vector<Sourced> list = formed();
  std::ranges::copy(quoted(), std::back_inserter(list));
  for (const Sourced& figure : list) {
    ASSERT_TRUE(pages.contains(figure.page)) << figure.page;
    EXPECT_NE(pages.at(figure.page).text().find(figure.sentence), std::string::npos)
        << figure.page << ": should say, by tb/structure/figures_test.cpp: " << figure.sentence;
    if (!figure.file.empty()) {
      EXPECT_NE(words_of(text_of(figure.file)).find(figure.source), std::string::npos)
          << figure.page << ": '" << figure.sentence << "' is no longer what " << figure.file
          << " says. Correct the page and its source in tb/structure/figures_test.cpp";
    }
  }

  // Every other figure fails.
  for (const auto& [page, written] : pages) {
    for (const HandWritten::Figure& found : written.figures()) {
      const auto covers = [&, &page = page, &written = written](const Sourced& figure) {
        const std::string& text = written.text();
        for (std::size_t at = 0;
             figure.page == page && (at = text.find(figure.sentence, at)) != std::string::npos; ++at)
          if (at <= found.position && found.position < at + figure.sentence.size()) return true;
        return false;
      };
      if (std::ranges::any_of(list, covers)) continue;
      ADD_FAILURE() << fmt::format(
          "{}:{}: '{}' looks like a measured figure that no command writes. Link to the page that has it "
          "instead, or let a "
          "command write it (<!-- NAME: written by … -->, or a quoted $ build/halfway …), or give its source "
          "in "
          "tb/structure/figures_test.cpp",
          page, written.line_at(found.position), found.words);
    }
  }
}

std::vector<std::string> words_of_figures(std::string_view page) {
  std::vector<std::string> words;
  for (const HandWritten::Figure& figure : HandWritten(page).figures()) words.push_back(figure.words);
  return words;
}

TEST(HandWritten, NumbersWithAUnitAreFigures) {
  EXPECT_THAT(
      words_of_figures("The core reaches 105 MHz, and *12 ns* (3 %) in\n5 to 7\nminutes: 1.9 times, 40% "
                       "or\na minute.\n"),
      testing::ElementsAre("105 MHz", "12 ns", "3 %", "7 minutes", "1.9", "40%", "a minute"));
  EXPECT_THAT(
      words_of_figures("Up to 51 colour steps, 15 233 line records, 44 million random pixels, 60 frames "
                       "per second.\n"),
      testing::ElementsAre("51 colour steps", "15 233 line records", "44 million random pixels",
                           "60 frames"));
  EXPECT_THAT(words_of_figures("```\nmake sim   # takes 5 minutes\n```\n"),
              testing::ElementsAre("5 minutes"));
  const HandWritten page("One.\n\nTwo takes\n3 ms.\n");
  EXPECT_EQ(page.line_at(page.figures().at(0).position), 4U);
}

TEST(HandWritten, CellsOfATableAreFigures) {
  EXPECT_THAT(
      words_of_figures("| design | clock, MHz | error |\n| --- | --- | --- |\n| `a` | 105 | 1/255 |\n"),
      testing::ElementsAre("105", "1/255"));
  EXPECT_THAT(
      words_of_figures("| | field | bits | clocks |\n| --- | --- | --- | --- |\n| 1 | `x` | 12 | 3 |\n"),
      testing::IsEmpty());
}

TEST(HandWritten, DefinitionsAndPartsThatCommandsWriteAreNoFigures) {
  EXPECT_THAT(words_of_figures(
                  "Six samples, 2 pixels, 640×480 pixels, GHDL 2.0 and Apache-2.0, `--limit 3 ms`, 0.5.\n"),
              testing::IsEmpty());
  EXPECT_THAT(
      words_of_figures("<!-- clocks: written by make synth -->\n\n105 MHz\n\n<!-- end of clocks -->\n"),
      testing::IsEmpty());
  EXPECT_THAT(words_of_figures("```\n$ build/halfway plan matte\nsaves 52 %\n```\n"), testing::IsEmpty());
}

}  // namespace
}  // namespace halfway
