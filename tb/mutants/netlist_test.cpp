// SPDX-License-Identifier: Apache-2.0
// The constructs that GHDL 2.0.0 is known to miscompile are refused, repaired, or seen as a difference
// between GHDL's simulation and the netlist in Verilator, for the same random vectors.
#include "sim/engines/verilator/netlist.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

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

  Result<std::string> mended(const std::string& construct) const {
    const auto netlist = synthesize(construct);
    return netlist ? mend_netlist(*netlist) : netlist;
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

TEST_F(KnownBad, TheDriverRefuses) {
  for (const auto& [construct, part] : {std::pair{"1", "shift_right"},
                                        {"3", "VHDL text"},
                                        {"4", "signed division"},
                                        {"5", "VHDL text"},
                                        {"7", "signed division"},
                                        {"8", "when others"}}) {
    const auto netlist = mended(construct);
    ASSERT_FALSE(netlist) << construct;
    EXPECT_EQ(netlist.error().code, ExitCode::tool_failed);
    EXPECT_NE(netlist.error().message.find(part), std::string::npos) << netlist.error().message;
  }
}

TEST_F(KnownBad, NarrowingResizeDiffers) {
  EXPECT_NE(must(verilate(must(mended("2")))), simulate("2"));
}

TEST_F(KnownBad, WideConstantsNeedTheMending) {
  const std::string expected = simulate("6");
  EXPECT_EQ(must(verilate(must(mended("6")))), expected);
  const auto raw = verilate(must(synthesize("6")));
  EXPECT_TRUE(!raw || *raw != expected);
}

TEST_F(KnownBad, ASoundConstructIsEqual) {
  EXPECT_EQ(must(verilate(must(mended("0")))), simulate("0"));
}

}  // namespace
}  // namespace halfway
