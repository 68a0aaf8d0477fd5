// SPDX-License-Identifier: Apache-2.0
// Tests the path from VHDL to Verilator. Random vectors go through GHDL's simulation and through the netlist;
// every bit must be equal. Constructs that GHDL is known to miscompile must be detected.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "sim/ghdl/ghdl_library.hpp"
#include "sim/stream_files/init_file.hpp"
#include "sim/system/file.hpp"
#include "sim/system/subprocess.hpp"
#include "sim/verilator/netlist.hpp"
#include "sim/verilator/verilated_library.hpp"

namespace halfway {
namespace {

constexpr unsigned c_stimulus_bits = 160, c_lane_bits = 80, c_lanes = 42;
constexpr unsigned c_response_bits = c_lane_bits * c_lanes;
constexpr std::size_t c_vectors = 4000;

using Generics = std::vector<std::pair<std::string, std::string>>;
enum class Netlist { raw, mended };

std::string to_hex(std::span<const std::uint32_t> words, unsigned bits) {
  std::string text;
  for (unsigned digit = (bits + 3) / 4; digit-- > 0;) {
    text += "0123456789ABCDEF"[(words[digit / 8] >> (digit % 8 * 4)) & 15U];
  }
  return text;
}

/// Uniform bits, and inputs at the limits of comparisons and saturation: runs of zeros and ones, equal
/// operands, small values.
std::vector<std::uint32_t> make_stimuli() {
  std::mt19937 random(20240229);
  constexpr std::size_t c_words = c_stimulus_bits / 32;
  std::vector<std::uint32_t> stimuli(c_vectors * c_words);
  for (std::size_t i = 0; i < c_vectors; ++i) {
    std::uint32_t* vector = &stimuli[i * c_words];
    for (std::size_t w = 0; w < c_words; ++w) vector[w] = static_cast<std::uint32_t>(random());
    const auto set_bit = [&](unsigned bit, bool value) {
      vector[bit / 32] = (vector[bit / 32] & ~(1U << bit % 32)) | (std::uint32_t{value} << bit % 32);
    };
    const auto bit = [&](unsigned index) { return ((vector[index / 32] >> index % 32) & 1U) != 0; };
    const auto kind = static_cast<unsigned>(random() % 8);
    if (kind == 1 || kind == 2) {  // sign extended from a random bit
      for (const unsigned low : {16U, 88U}) {
        const auto from = static_cast<unsigned>(random() % 72);
        for (unsigned k = from; k < 72; ++k) set_bit(low + k, bit(low + from));
      }
    } else if (kind == 3) {  // b is equal to a, or almost
      for (unsigned k = 0; k < 72; ++k) set_bit(88 + k, bit(16 + k));
      if (random() % 2 == 0) set_bit(88 + static_cast<unsigned>(random() % 72), random() % 2 == 0);
    } else if (kind == 4) {  // all ones, all zeros, the least and the greatest number
      for (const unsigned low : {16U, 88U}) {
        const auto choice = static_cast<unsigned>(random() % 4);
        for (unsigned k = 0; k < 72; ++k) set_bit(low + k, (choice & 1U) != 0);
        const unsigned width = std::vector<unsigned>{12, 18, 32, 40, 72}[random() % 5];
        if (choice >= 2) set_bit(low + width - 1, (choice & 1U) == 0);
      }
    }
  }
  return stimuli;
}

class NetlistConstructs : public testing::Test {
 protected:
  void SetUp() override {
    auto tool = GhdlTool::find();
    ASSERT_TRUE(tool) << tool.error().message;
    tool_.emplace(*tool);
    auto made = TemporaryFolder::make(std::filesystem::path(testing::TempDir()) / "netlist");
    ASSERT_TRUE(made) << made.error().message;
    scratch_.emplace(std::move(*made));
    stimuli_ = make_stimuli();
  }

  std::vector<VhdlSource> sources(bool testbench) const {
    auto rtl = read_rtl_sources(HALFWAY_SOURCE_DIR);
    EXPECT_TRUE(rtl) << rtl.error().message;
    std::vector<VhdlSource> found = std::move(*rtl);
    std::vector<std::string> names = {"tb/netlist/netlist_constructs.vhd", "tb/netlist/netlist_known_bad.vhd",
                                      "tb/netlist/netlist_shading.vhd"};
    if (testbench) names.emplace_back("tb/netlist/netlist_constructs_tb.vhd");
    for (const std::string& name : names) {
      auto source = read_vhdl_source(HALFWAY_SOURCE_DIR, name);
      EXPECT_TRUE(source) << source.error().message;
      found.push_back(*source);
    }
    return found;
  }

  /// GHDL's own simulation: one hexadecimal line per vector.
  std::vector<std::string> simulate(const Generics& generics) {
    const auto library = GhdlLibrary::open(*tool_, sources(true), "netlist_constructs_tb", HALFWAY_CACHE_DIR);
    EXPECT_TRUE(library) << library.error().message;
    const auto in = scratch_->path() / "stimuli.txt", out = scratch_->path() / "responses.txt";
    std::string text;
    for (std::size_t i = 0; i < c_vectors; ++i) {
      text += to_hex(std::span(stimuli_).subspan(i * c_stimulus_bits / 32, c_stimulus_bits / 32),
                     c_stimulus_bits) +
              '\n';
    }
    EXPECT_TRUE(write_file(in, text));
    Command command{.arguments = library->run_arguments("netlist_constructs_tb"),
                    .working_folder = library->folder()};
    for (const auto& [name, value] : generics) command.arguments.push_back("-g" + name + '=' + value);
    command.arguments.push_back("-gg_stimuli=" + in.string());
    command.arguments.push_back("-gg_responses=" + out.string());
    command.arguments.emplace_back("--ieee-asserts=disable");
    command.timeout = std::chrono::minutes(60);
    const auto end = run_process(command, c_install_ghdl);
    EXPECT_TRUE(end) << end.error().message;
    EXPECT_TRUE(end->succeeded()) << end->how() << '\n' << end->output;
    std::vector<std::string> lines;
    auto reader = LineReader::open(out);
    EXPECT_TRUE(reader);
    std::string_view line;
    while (reader->next(line) == LineReader::Next::line) lines.emplace_back(line);
    EXPECT_EQ(lines.size(), c_vectors);
    return lines;
  }

  /// The same vectors through the netlist and Verilator.
  Result<std::vector<std::string>> verilate(const std::string& entity, const Generics& generics,
                                            Netlist kind) {
    const auto library = GhdlLibrary::for_synthesis(*tool_, sources(false), HALFWAY_CACHE_DIR);
    if (!library) return library.error();
    auto netlist = library->synthesize(entity, generics);
    if (!netlist) return netlist.error();
    if (kind != Netlist::raw) {
      netlist = mend_netlist(*netlist);
      if (!netlist) return netlist.error();
    }
    const std::filesystem::path root = HALFWAY_SOURCE_DIR;
    const auto verilated = open_verilated({.name = entity,
                                           .netlist = *netlist,
                                           .top = entity,
                                           .harness = root / "tb/netlist/netlist_harness.cpp",
                                           .include_folder = root,
                                           .harness_headers = {},
                                           .definitions = {},
                                           .waves = false,
                                           .compiler = ""},
                                          HALFWAY_CACHE_DIR);
    if (!verilated) return verilated.error();
    const auto run =
        verilated->function<void(const std::uint32_t*, std::size_t, std::uint32_t*)>("netlist_run");
    if (!run) return run.error();
    std::vector<std::uint32_t> responses(c_vectors * c_response_bits / 32);
    (*run)(stimuli_.data(), c_vectors, responses.data());
    std::vector<std::string> lines;
    for (std::size_t i = 0; i < c_vectors; ++i) {
      lines.push_back(to_hex(std::span(responses).subspan(i * c_response_bits / 32, c_response_bits / 32),
                             c_response_bits));
    }
    return lines;
  }

  /// The lanes in which a vector differs, each with its first difference.
  static std::string differences(const std::vector<std::string>& ghdl,
                                 const std::vector<std::string>& verilator) {
    std::string found;
    constexpr std::size_t c_digits = c_lane_bits / 4;
    for (std::size_t lane = 0; lane < c_lanes; ++lane) {
      const std::size_t at = (c_lanes - 1 - lane) * c_digits;
      for (std::size_t i = 0; i < ghdl.size(); ++i) {
        const std::string a = ghdl[i].substr(at, c_digits), b = verilator[i].substr(at, c_digits);
        if (a == b) continue;
        found += fmt::format("lane {}, vector {}: GHDL {}, Verilator {}\n", lane, i, a, b);
        break;
      }
    }
    return found;
  }

  std::optional<GhdlTool> tool_;
  std::optional<TemporaryFolder> scratch_;
  std::vector<std::uint32_t> stimuli_;
};

TEST_F(NetlistConstructs, EveryConstructOfTheRtlIsEqual) {
  for (const Generics& generics :
       {Generics{{"g_exact", "true"}, {"g_count", "3"}}, Generics{{"g_exact", "false"}, {"g_count", "4"}}}) {
    const auto expected = simulate(generics);
    const auto found = verilate("netlist_constructs", generics, Netlist::mended);
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_EQ(differences(expected, *found), "") << generics[0].second;
    // The value of every lane must have changed.
    for (std::size_t lane = 0; lane < c_lanes; ++lane) {
      const std::size_t at = (c_lanes - 1 - lane) * c_lane_bits / 4;
      std::vector<std::string> values;
      for (const std::string& line : expected) values.push_back(line.substr(at, c_lane_bits / 4));
      std::sort(values.begin(), values.end());
      const auto distinct = std::unique(values.begin(), values.end()) - values.begin();
      EXPECT_GE(distinct, lane == 35 && generics[0].second == "true" ? 1 : 2)
          << "lane " << lane << " stands still";
    }
  }
}

// GHDL simulates other text for its products and memories than it synthesizes.
TEST_F(NetlistConstructs, TheShadingArithmeticIsEqual) {
  const auto expected = simulate({{"g_shading", "true"}});
  const auto found = verilate("netlist_shading", {}, Netlist::mended);
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_EQ(differences(expected, *found), "");
  constexpr std::size_t c_used_lanes = 24;
  for (std::size_t lane = 0; lane < c_used_lanes; ++lane) {
    const std::size_t at = (c_lanes - 1 - lane) * c_lane_bits / 4;
    std::set<std::string> values;
    for (const std::string& line : expected) values.insert(line.substr(at, c_lane_bits / 4));
    EXPECT_GE(values.size(), 50U) << "lane " << lane << " hardly moves";
  }
}

TEST_F(NetlistConstructs, KnownBadConstructsAreCaught) {
  struct Case {
    int construct;
    const char* name;
    const char* refusal;  ///< part of the driver's message; null: detected as a difference
  };
  for (const Case& bad : {Case{1, "shift_right of a signed", "shift_right"},
                          Case{2, "narrowing resize", nullptr}, Case{3, "abs", "VHDL text"},
                          Case{4, "signed division", "signed division"}, Case{5, "minimum", "VHDL text"},
                          Case{7, "mod", "signed division"}, Case{8, "case with others", "when others"}}) {
    const Generics generics = {{"g_construct", std::to_string(bad.construct)}};
    const auto found = verilate("netlist_known_bad", generics, Netlist::mended);
    if (bad.refusal != nullptr) {
      ASSERT_FALSE(found) << bad.name;
      EXPECT_EQ(found.error().code, ExitCode::tool_failed);
      EXPECT_NE(found.error().message.find(bad.refusal), std::string::npos) << found.error().message;
    } else {
      ASSERT_TRUE(found) << found.error().message;
      Generics simulated = generics;
      simulated.emplace_back("g_known_bad", "true");
      EXPECT_NE(differences(simulate(simulated), *found), "") << bad.name;
    }
  }
}

TEST_F(NetlistConstructs, WideConstantsNeedTheMending) {
  const Generics generics = {{"g_construct", "6"}};
  Generics simulated = generics;
  simulated.emplace_back("g_known_bad", "true");
  const auto expected = simulate(simulated);
  const auto mended = verilate("netlist_known_bad", generics, Netlist::mended);
  ASSERT_TRUE(mended) << mended.error().message;
  EXPECT_EQ(differences(expected, *mended), "");
  const auto raw = verilate("netlist_known_bad", generics, Netlist::raw);
  if (raw) {
    EXPECT_NE(differences(expected, *raw), "");
  }
}

TEST_F(NetlistConstructs, SoundConstructInTheSameTestbenchIsEqual) {
  const auto found = verilate("netlist_known_bad", {{"g_construct", "0"}}, Netlist::mended);
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_EQ(differences(simulate({{"g_construct", "0"}, {"g_known_bad", "true"}}), *found), "");
}

}  // namespace
}  // namespace halfway
