// SPDX-License-Identifier: Apache-2.0
// Which constructs this GHDL prints rightly as Verilog, which are repaired or refused, and which are wrong:
// seen as a difference between GHDL's simulation and the netlist in Verilator, for the same random vectors.
#include "sim/engines/verilator/netlist.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <iostream>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "sim/engines/ghdl/ghdl_library.hpp"
#include "sim/engines/verilator/verilated_library.hpp"
#include "sim/os/file.hpp"
#include "sim/os/must.hpp"

namespace halfway {
namespace {

constexpr std::size_t c_stimulus_words = 5, c_response_words = 3, c_vectors = 4000;
constexpr const char* c_entity = "netlist_known_bad";
constexpr const char* c_testbench = "netlist_known_bad_tb";

const std::filesystem::path c_root = HALFWAY_SOURCE_DIR;

// One line of hexadecimal digits per vector.
std::string to_lines(std::span<const std::uint32_t> words, std::size_t words_of_line) {
  std::string text;
  for (std::size_t at = 0; at < words.size(); at += words_of_line) {
    for (std::size_t i = words_of_line; i-- > 0;) text += fmt::format("{:08X}", words[at + i]);
    text += '\n';
  }
  return text;
}

class KnownBad : public testing::Test {
 protected:
  KnownBad() {
    std::mt19937 random(20240229);
    for (std::uint32_t& word : stimuli_) word = static_cast<std::uint32_t>(random());
  }

  std::vector<VhdlSource> sources() const {
    return {must(read_vhdl_source(c_root, "tb/mutants/netlist_known_bad.vhd")),
            must(read_vhdl_source(c_root, "tb/mutants/netlist_known_bad_tb.vhd"))};
  }

  /// The responses in GHDL's own simulation.
  std::string simulate(const std::string& construct) const {
    const auto in = scratch_.path() / "stimuli.txt", out = scratch_.path() / "responses.txt";
    must(write_file(in, to_lines(stimuli_, c_stimulus_words)));
    must(run_testbench(
        c_testbench, sources(),
        {"-gg_construct=" + construct, "-gg_stimuli=" + in.string(), "-gg_responses=" + out.string()},
        HALFWAY_CACHE_DIR));
    return must(read_file(out));
  }

  /// GHDL's netlist.
  Result<std::string> synthesize(const std::string& construct) const {
    const auto library = must(GhdlLibrary::for_synthesis(tool_, sources(), HALFWAY_CACHE_DIR));
    return library.synthesize(c_entity, {{"g_construct", construct}});
  }

  /// The responses of the netlist in Verilator.
  Result<std::string> verilate(const std::string& netlist) const {
    const auto verilated = open_verilated({.name = c_entity,
                                           .netlist = netlist,
                                           .top = c_entity,
                                           .harness = c_root / "tb/mutants/netlist_harness.cpp",
                                           .include_folder = c_root,
                                           .harness_headers = {},
                                           .definitions = {},
                                           .waves = false,
                                           .compiler = ""},
                                          HALFWAY_CACHE_DIR);
    if (!verilated) return verilated.error();
    const auto run =
        must(verilated->function<void(const std::uint32_t*, std::size_t, std::uint32_t*)>("netlist_run"));
    std::vector<std::uint32_t> responses(c_vectors * c_response_words);
    run(stimuli_.data(), c_vectors, responses.data());
    return to_lines(responses, c_response_words);
  }

  const GhdlTool tool_ = must(GhdlTool::find());
  const TemporaryFolder scratch_ =
      must(TemporaryFolder::make(std::filesystem::path(testing::TempDir()) / "netlist"));
  std::vector<std::uint32_t> stimuli_ = std::vector<std::uint32_t>(c_vectors * c_stimulus_words);
};

// What GHDL and the driver make of a construct.
enum class Verdict { right, mended, refused, wrong };

std::ostream& operator<<(std::ostream& out, Verdict verdict) {
  constexpr const char* c_names[] = {"right", "mended", "refused", "wrong"};
  return out << c_names[static_cast<std::size_t>(verdict)];
}

struct Construct {
  const char* number;
  const char* vhdl;
  Verdict by_2, later;  // by GHDL 2, and by 5 and 6
};

// The table in docs/rtl/README.md. `wrong` ones are not used in rtl/.
constexpr Construct c_constructs[] = {
    {"0", "a + b", Verdict::right, Verdict::right},
    {"1", "shift_right", Verdict::refused, Verdict::right},
    {"2", "resize to fewer bits", Verdict::wrong, Verdict::wrong},
    {"3", "abs", Verdict::refused, Verdict::right},
    {"4", "/", Verdict::refused, Verdict::right},
    {"5", "minimum", Verdict::refused, Verdict::refused},
    {"6", "a constant of 40 bits", Verdict::mended, Verdict::right},
    {"7", "mod", Verdict::refused, Verdict::refused},
    {"8", "when others", Verdict::refused, Verdict::right},
    {"9", "a constant with ones in its upper 32 bits only", Verdict::wrong, Verdict::right},
    {"10", "comparison with an integer that has more bits", Verdict::wrong, Verdict::wrong}};

class ConstructOfGhdl : public KnownBad, public testing::WithParamInterface<Construct> {
 protected:
  Verdict verdict() const {
    const auto raw = synthesize(GetParam().number);
    if (!raw) return Verdict::refused;
    const auto mended = mend_netlist(*raw);
    if (!mended) {
      EXPECT_EQ(mended.error().code, ExitCode::tool_failed);
      return Verdict::refused;
    }
    const std::string expected = simulate(GetParam().number);
    if (must(verilate(*mended)) != expected) return Verdict::wrong;
    const auto as_printed = verilate(*raw);
    return as_printed && *as_printed == expected ? Verdict::right : Verdict::mended;
  }
};

// A version after those that were tried may mend more, but must not add a wrong one.
TEST_P(ConstructOfGhdl, IsRightOrRefused) {
  const bool is_2 = tool_.version.starts_with("GHDL 2.");
  const Verdict expected = is_2 ? GetParam().by_2 : GetParam().later, found = verdict();
  std::cout << tool_.version.substr(0, tool_.version.find('\n')) << ", " << GetParam().vhdl << ": " << found
            << '\n';
  EXPECT_TRUE(found == expected || (!is_2 && found == Verdict::right)) << "expected: " << expected;
}

INSTANTIATE_TEST_SUITE_P(Each, ConstructOfGhdl, testing::ValuesIn(c_constructs));

}  // namespace
}  // namespace halfway
