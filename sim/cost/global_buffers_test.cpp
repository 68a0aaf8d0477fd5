// SPDX-License-Identifier: Apache-2.0
// Checks which nets of small netlists get a buffer, and, if the tools are installed, how many of the device's
// buffers a design uses.
#include "sim/cost/global_buffers.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "common/test/is_error.hpp"
#include "sim/cost/synthesis.hpp"
#include "sim/os/subprocess.hpp"
#include "sim/os/test/folder_test.hpp"

namespace halfway::synth {
namespace {

using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

// A module with a clock. Tests add enables.
class Netlist {
 public:
  Netlist() {
    module_["ports"]["clk"] = {{"direction", "input"}, {"bits", {c_clock}}};
    name("clk", {c_clock});
    module_["cells"] = json::object();
  }

  void name(const std::string& name, const std::vector<int>& bits) {
    module_["netnames"][name] = {{"hide_name", 0}, {"bits", bits}};
  }
  int net() { return last_++; }

  /// Add registers with this enable, each after a lookup table with `inputs`; `x` is a carry.
  void registers(int enable, int count, const std::string& inputs = "aaax") {
    for (int i = 0; i < count; ++i) {
      const int carry = net(), sum = net(), output = net();
      cell("SB_CARRY", {{"CO", {carry}}}, "CO");
      json pins = {{"O", {sum}}};
      for (std::size_t pin = 0; pin < inputs.size(); ++pin)
        pins[fmt::format("I{}", pin)] = inputs[pin] == 'x'   ? json{carry}
                                        : inputs[pin] == 'a' ? json{c_input}
                                                             : json{std::string(1, inputs[pin])};
      cell("SB_LUT4", pins, "O");
      cell("SB_DFFE", {{"C", {c_clock}}, {"D", {sum}}, {"E", {enable}}, {"Q", {output}}}, "Q");
    }
  }
  /// Add an enable with this name and number of full sums.
  int enable(const std::string& named, int sums) {
    const int enable = net();
    name(named, {enable});
    registers(enable, sums);
    return enable;
  }
  void cell(const std::string& type, const json& pins, const std::string& output) {
    json directions;
    for (const auto& [pin, bits] : pins.items()) directions[pin] = pin == output ? "output" : "input";
    module_["cells"][fmt::format("cell{}", cells_++)] = {
        {"type", type}, {"port_directions", directions}, {"connections", pins}};
  }
  std::string text() const { return json{{"modules", {{"wrapped", module_}}}}.dump(); }

  static constexpr int c_clock = 2, c_input = 3;

 private:
  json module_;
  int last_ = 4, cells_ = 0;
};

// Pins driven by each buffer, by the buffer's name.
using PinWidths = std::map<std::string, int>;

struct Buffered {
  PinWidths pins;
  json cells;
  explicit Buffered(const std::string& netlist) {
    cells = json::parse(must(with_global_buffers(netlist)))["modules"]["wrapped"]["cells"];
    for (const auto& [name, buffer] : cells.items()) {
      if (buffer["type"] != "SB_GB") continue;
      pins[name] = 0;
      for (const json& cell : cells)
        for (const auto& [pin, bits] : cell["connections"].items())
          pins[name] += cell["port_directions"][pin] == "input" &&
                        bits == buffer["connections"]["GLOBAL_BUFFER_OUTPUT"];
    }
  }
  /// Loads of a net except its buffer.
  std::vector<std::string> users(int net) const {
    std::vector<std::string> users;
    for (const json& cell : cells)
      for (const auto& [pin, bits] : cell["connections"].items())
        if (cell["type"] != "SB_GB" && cell["port_directions"][pin] == "input" && bits == json{net})
          users.push_back(pin);
    return users;
  }
};

TEST(SynthGlobalBuffers, AreForTheClockOnlyWithoutAnEnableOfFullSums) {
  Netlist netlist;
  netlist.enable("few", 7);
  const int partial = netlist.net();
  netlist.name("partial", {partial});
  netlist.registers(partial, 9, "0aax");
  netlist.registers(partial, 9, "a1ax");
  netlist.registers(partial, 9, "aa0x");
  netlist.registers(partial, 9, "aaaa");
  netlist.registers(partial, 9, "aaxa");
  const Buffered buffered(netlist.text());
  EXPECT_EQ(buffered.pins, (PinWidths{{"clk_SB_GB", 7 + 5 * 9}}));
  EXPECT_THAT(buffered.users(Netlist::c_clock), IsEmpty());
}

TEST(SynthGlobalBuffers, AreForTheFourLargestOfFiveEnablesAndOfEqualOnesTheFirstNames) {
  Netlist sizes, names;
  for (const auto& [name, sums] : {std::pair{"a", 9}, {"b", 8}, {"c", 10}, {"d", 12}, {"e", 11}})
    sizes.enable(name, sums);
  EXPECT_EQ(
      Buffered(sizes.text()).pins,
      (PinWidths{{"clk_SB_GB", 50}, {"a_SB_GB", 9}, {"c_SB_GB", 10}, {"d_SB_GB", 12}, {"e_SB_GB", 11}}));
  const int several = names.enable("z", 8);
  for (const char* name : {"e", "d", "c", "b"}) names.enable(name, 8);
  names.name("a", {Netlist::c_input, several});
  EXPECT_EQ(
      Buffered(names.text()).pins,
      (PinWidths{{"clk_SB_GB", 40}, {"a[1]_SB_GB", 8}, {"b_SB_GB", 8}, {"c_SB_GB", 8}, {"d_SB_GB", 8}}));
}

TEST(SynthGlobalBuffers, DriveOnlyTheRegistersOfAnEnable) {
  Netlist netlist;
  const int enable = netlist.enable("enable", 8), other = netlist.enable("other", 3);
  netlist.registers(enable, 2, "00aa");
  netlist.cell("SB_LUT4", {{"I0", {enable}}, {"O", {netlist.net()}}}, "O");
  netlist.cell("SB_DFFSR", {{"C", {Netlist::c_clock}}, {"D", {Netlist::c_input}}, {"R", {enable}}}, "Q");
  netlist.cell("SB_RAM40_4K", {{"RCLK", {Netlist::c_clock}}, {"WE", {enable}}}, "RDATA");
  const Buffered buffered(netlist.text());
  EXPECT_EQ(buffered.pins, (PinWidths{{"clk_SB_GB", 8 + 3 + 2 + 2}, {"enable_SB_GB", 10}}));
  EXPECT_THAT(buffered.users(enable), ::testing::UnorderedElementsAre("I0", "R", "WE"));
  EXPECT_THAT(buffered.users(other), ElementsAre("E", "E", "E"));
}

TEST(SynthGlobalBuffers, ADesignWithoutClockIsRefused) {
  const json netlist = json::parse(Netlist().text());
  EXPECT_TRUE(with_global_buffers(netlist.dump()));
  EXPECT_TRUE(is_error(with_global_buffers(""), "not a netlist to place"));
  for (const json& change : json::parse(R"([{"modules": null}, {"modules": {"wrapped": {"cells": null}}},
      {"modules": {"wrapped": {"netnames": null}}},
      {"modules": {"wrapped": {"ports": {"clk": {"bits": []}}}}},
      {"modules": {"wrapped": {"ports": {"clk": {"bits": ["0"]}}}}}])")) {
    json changed = netlist;
    changed.merge_patch(change);
    EXPECT_TRUE(is_error(with_global_buffers(changed.dump()), "not a netlist to place")) << change;
  }
}

// Two sums with one enable each, and registers with a third enable, to which nextpnr would give a buffer.
constexpr const char* c_buffered_entity = R"(library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;

entity sums is
  port (
    clk, flip      : in  std_logic;
    enable         : in  std_logic_vector(2 downto 0);
    step           : in  unsigned(35 downto 0);
    low, high      : out unsigned(11 downto 0) := (others => '0');
    held           : out unsigned(35 downto 0)
  );
end entity;

architecture rtl of sums is
begin
  low <= (low + step(11 downto 0)) xor (11 downto 0 => flip) when rising_edge(clk) and enable(0) = '1';
  high <= (high + step(11 downto 0)) xor (11 downto 0 => flip) when rising_edge(clk) and enable(1) = '1';
  held <= step when rising_edge(clk) and enable(2) = '1';
end architecture;
)";

using PackedGlobalBuffers = FolderTest;

TEST_F(PackedGlobalBuffers, AreThoseOfNextpnr) {
  for (const char* tool : {"ghdl", "yosys", "nextpnr-ice40"})
    ASSERT_FALSE(find_program(tool).empty()) << "no " << tool << ": " << c_install_tools;
  write("rtl/files.f", "sums.vhd\n");
  write("rtl/sums.vhd", c_buffered_entity);
  Synthesizer::open(at("cache"), true).pack({.name = "sums", .entity = "sums", .root = here()});
  std::string said;
  for (const auto& kept : std::filesystem::directory_iterator(at("cache/synth")))
    if (const auto text = read_file(kept.path() / "packing")) said = *text;
  EXPECT_THAT(said, ::testing::ContainsRegex("SB_GB: +3/ +8 "));
}

}  // namespace
}  // namespace halfway::synth
