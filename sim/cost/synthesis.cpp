// SPDX-License-Identifier: Apache-2.0
#include "sim/cost/synthesis.hpp"

#include <fmt/format.h>

#include <csignal>
#include <nlohmann/json.hpp>
#include <tuple>

#include "sim/cost/generic_cells.hpp"
#include "sim/engines/ghdl/ghdl_library.hpp"
#include "sim/engines/verilator/netlist.hpp"
#include "sim/os/file.hpp"
#include "sim/os/must.hpp"

namespace halfway::synth {
namespace {

constexpr const char* c_no_end = "no_end";
constexpr const char* c_wrapped = "wrapped.json";
constexpr const char* c_report = "report.json";
constexpr const char* c_packing = "packing";
constexpr unsigned c_most_inputs = 256;  // flip-flops before a design
constexpr int c_frequency = 200;         // target clock in MHz, higher than any design reaches

// nextpnr's error message if it runs out of logic cells.
constexpr std::string_view c_too_large = "Unable to place cell";

// The number in "Yosys 0.23 (git ...)" and "nextpnr-ice40 -- ... (Version 0.4-1+b1)".
std::string number_of(std::string_view version) {
  const std::size_t digit = std::min(version.find_first_of("0123456789", version.find(' ')), version.size());
  constexpr std::string_view c_mark = "Version ";
  const std::size_t mark = version.find(c_mark);
  const std::size_t from = mark == std::string_view::npos ? digit : mark + c_mark.size();
  return std::string(version.substr(from, version.find_first_of(" )\n", from) - from));
}

// A model of the ECP5's multiplier as Yosys's dsp_map.v connects it: without registers. Yosys has none.
std::string multiplier_model() {
  const auto list = [](char letter, int bits) {
    std::string text;
    for (int bit = bits - 1; bit >= 0; --bit) text += fmt::format("{}{}{}", letter, bit, bit > 0 ? ", " : "");
    return text;
  };
  return fmt::format(
      "module MULT18X18D (input {0}, {1}, {2}, SIGNEDA, SIGNEDB, SOURCEA, SOURCEB, output {3});\n"
      "  wire signed [18:0] a = {{SIGNEDA & A17, {0}}};\n  wire signed [18:0] b = {{SIGNEDB & B17, {1}}};\n"
      "  assign {{{3}}} = a * b;\nendmodule\n",
      list('A', 18), list('B', 18), list('C', 18), list('P', 36));
}

}  // namespace

std::string wrapper(std::string_view netlist, std::string_view top, unsigned most_inputs) {
  unsigned inputs = 0, outputs = 0;
  std::string wires, pins, connections;
  const std::vector<ModulePort> ports = ports_of(netlist, top);
  if (ports.empty()) throw_tool_failed("{}: the netlist has no such module", top);
  for (const ModulePort& port : ports) {
    const bool is_clock = port.name == "clk" || port.name == "aclk";
    connections += fmt::format(",\n    .{}({})", port.name, is_clock ? "clk" : port.name);
    if (is_clock) continue;
    if (port.bits > 1)
      wires += fmt::format("  wire [{}:0] {};\n", port.bits - 1, port.name);
    else
      wires += fmt::format("  wire {};\n", port.name);
    if (port.is_output) {
      pins = port.name + (pins.empty() ? "" : ", ") + pins;
      outputs += port.bits;
      continue;
    }
    std::string bits;
    for (unsigned i = 0; i < port.bits; ++i)
      bits = fmt::format("in[{}]{}{}", (inputs + i) % most_inputs, i == 0 ? "" : ", ", bits);
    wires += fmt::format("  assign {} = {{{}}};\n", port.name, bits);
    inputs += port.bits;
  }
  if (outputs == 0) throw_tool_failed("{}: has no output to register", top);
  inputs = std::max(std::min(inputs, most_inputs), 1U);
  return fmt::format(
      "module wrapped (input clk, input serial_in, output serial_out);\n"
      "  reg [{0}:0] in;\n  wire [{1}:0] out;\n  reg [{1}:0] folded;\n{2}"
      "  assign out = {{{3}}};\n  assign serial_out = folded[{1}];\n"
      "  always @(posedge clk) begin\n    in <= {{in, serial_in}};\n    folded <= out ^ {{folded, 1'b0}};\n  "
      "end\n"
      "  {4} dut ({5});\nendmodule\n",
      inputs - 1, outputs - 1, wires, pins, top, connections.substr(1));
}

std::string does_not_fit(const Device& device, std::string_view what, std::uint64_t count,
                         std::uint64_t most) {
  return count > most ? fmt::format("does not fit the {}: {} {} of {}", device.name, count, what, most)
                      : std::string();
}

std::string does_not_fit(const Device& device, const Cells& cells) {
  for (const auto& [what, count, most] : {std::tuple{"LUTs", cells.luts, device.cells},
                                          {"flip-flops", cells.flip_flops, device.cells},
                                          {"RAMs", cells.rams, device.rams},
                                          {"multipliers", cells.multipliers, device.multipliers}})
    if (std::string why = does_not_fit(device, what, count, most); !why.empty()) return why;
  return {};
}

std::string ghdl_name() {
  return "GHDL " + number_of(must(GhdlTool::find()).version);
}

const Placement* Clock::median() const {
  return placements.empty() ? nullptr : &placements[placements.size() / 2];
}

Synthesizer Synthesizer::open(const Folder& cache, bool place, const Family& family) {
  Synthesizer synthesizer(family, std::filesystem::absolute(cache));
  synthesizer.versions_ = fmt::format("{}, Yosys {}", ghdl_name(), number_of(synthesizer.yosys_version()));
  if (place) {
    const std::string placer(synthesizer.device().placer);
    synthesizer.placer_ = version_of(placer, "--version", synthesizer.device().install);
    synthesizer.versions_ += fmt::format(", {} {}", placer, number_of(synthesizer.placer_));
  }
  return synthesizer;
}

Synthesizer::Folder Synthesizer::mapped(const Design& design, const Family& family) const {
  const std::string script = fmt::format(
      "read_verilog netlist.v; {0} -top {1}; {2}{3}", family.pass, design.entity, c_statistics,
      // Only the design: of the cells' models, later versions keep those with parameters.
      family.device != nullptr ? "; select " + design.entity + "; write_rtlil -selected mapped.il" : "");
  Design fitted = design;
  if (takes_multiplier_bits(design.entity) && family.multiplier_bits > 0)
    fitted.generics.emplace_back("g_multiplier_bits", std::to_string(family.multiplier_bits));
  return yosys_.run(fmt::format("{}-{}", design.name, family.name), script,
                    {{"netlist.v", netlist_of(fitted, ghdl_cache_)}}, read_statistics);
}

Cells Synthesizer::cells(const Design& design, const Family& family) const {
  return count_cells(mapped(design, family), family.kinds);
}

Cells Synthesizer::generic_cells(const Design& design) const {
  return synth::generic_cells(yosys_, design, netlist_of(design, ghdl_cache_));
}

std::string Synthesizer::from_mapped(const Design& design, const std::string& script, const std::string& file,
                                     const std::string& around) const {
  const std::string core = must(read_file(mapped(design, *family_) / "mapped.il"));
  const Folder folder = yosys_.run(fmt::format("{}-{}", design.name, file), script,
                                   {{"mapped.il", core}, {"wrapper.v", around}},
                                   [&](const Folder& fresh) { must(read_file(fresh / file)); });
  return must(read_file(folder / file));
}

// splitnets, because Verilator takes a carry chain in one vector for a combinational loop.
std::string Synthesizer::simulated(const Design& design) const {
  return from_mapped(
      design,
      fmt::format("read_rtlil mapped.il; delete =A:blackbox; read_verilog -defer {}; "
                  "read_verilog wrapper.v; hierarchy -top {}; proc; flatten; opt_clean -purge; splitnets; "
                  "write_verilog -noattr simulated.v",
                  family_->models, design.entity),
      "simulated.v", family_->multiplier_bits > 0 ? multiplier_model() : "");
}

// Synthesize the wrapper separately and then insert the already synthesized design, so that no optimization
// crosses the boundary.
std::string Synthesizer::wrapped(const Design& design) const {
  const std::string script = fmt::format(
      "read_rtlil mapped.il; blackbox {0}; setattr -mod -unset top ={0}; read_verilog wrapper.v; "
      "{1} -top wrapped; read_rtlil -overwrite mapped.il; setattr -mod -unset top {0}; "
      "hierarchy -top wrapped; flatten; opt_clean -purge; write_json {2}",
      design.entity, family_->pass, c_wrapped);
  const std::string around = wrapper(netlist_of(design, ghdl_cache_), design.entity, c_most_inputs);
  std::string netlist = from_mapped(design, script, c_wrapped, around);
  if (device().prepare == nullptr) return netlist;
  const auto prepared = device().prepare(netlist);
  if (!prepared) throw_tool_failed("{}: {}", design.name, prepared.error().message);
  return *prepared;
}

Synthesizer::Folder Synthesizer::placed(const Design& design, const std::string& kind,
                                        const std::vector<std::string>& arguments, const std::string& netlist,
                                        const std::function<void(const Folder&)>& run) const {
  std::vector<std::string_view> key{"placed 2", placer_, netlist};
  key.insert(key.end(), arguments.begin(), arguments.end());
  return kept(cache_, fmt::format("{}-{}", design.name, kind), key, [&](const Folder& fresh) {
    must(write_file(fresh / c_wrapped, netlist));
    run(fresh);
    std::filesystem::remove(fresh / c_wrapped);
  });
}

std::vector<std::string> Synthesizer::command(const std::vector<std::string>& more) const {
  std::vector<std::string> all(device().clock_options.begin(), device().clock_options.end());
  all.insert(all.end(), {"--json", c_wrapped});
  all.insert(all.end(), more.begin(), more.end());
  return placer_command(device(), c_frequency, all);
}

std::uint64_t Synthesizer::pack(const Design& design) const {
  const std::vector<std::string> arguments = command({"--pack-only"});
  const Folder folder = placed(design, "packed", arguments, wrapped(design), [&](const Folder& fresh) {
    const std::string said = run_tool(arguments, fresh, design.name);
    read_packing(said, device().names);
    must(write_file(fresh / c_packing, said));
  });
  return read_packing(must(read_file(folder / c_packing)), device().names);
}

Placement Synthesizer::place(const Design& design, unsigned seed) const {
  Placement placement = place(design, seed, c_place_time, {});
  // nextpnr's older router takes longer, but ends for designs with many wires.
  if (!placement.ended) placement = place(design, seed, c_most_place_time, {"--router", "router1"});
  return placement;
}

Placement Synthesizer::place(const Design& design, unsigned seed, std::chrono::seconds limit,
                             const std::vector<std::string>& options) const {
  // Limit the processor time by the shell's ulimit, because elapsed time depends on the machine's load. A
  // soft limit, so that the process ends with SIGXCPU.
  std::vector<std::string> arguments = {"sh", "-c", "ulimit -c 0 && ulimit -S -t \"$0\" && exec \"$@\"",
                                        std::to_string(limit.count())};
  for (const std::string& argument :
       command({"--seed", std::to_string(seed), "--timing-allow-fail", "--quiet", "--report", c_report}))
    arguments.push_back(argument);
  arguments.insert(arguments.end(), options.begin(), options.end());
  const std::string netlist = wrapped(design);
  const Folder folder =
      placed(design, fmt::format("placed{}", seed), arguments, netlist, [&](const Folder& fresh) {
        const Command placer{.arguments = arguments, .working_folder = fresh, .timeout = c_tool_timeout};
        const ProcessEnd end = must(run_process(placer, device().install));
        // A timeout and a full device are valid results without a report.
        if (end.signal == SIGXCPU)
          must(write_file(fresh / c_no_end, ""));
        else if (!end.succeeded() && end.output.find(c_too_large) == std::string::npos)
          throw_tool_failed("{}",
                            failed_text(fmt::format("{}: {}", design.name, device().placer), placer, end));
      });
  if (std::filesystem::exists(folder / c_no_end)) return {.seed = seed, .ended = false};
  if (!std::filesystem::exists(folder / c_report)) return {.seed = seed};
  return read_placement(must(read_file(folder / c_report)), netlist, seed, device().names);
}

std::string Synthesizer::no_room(const Design& design) const {
  // Each cell takes a logic cell; some share one.
  if (std::string why = does_not_fit(device(), cells(design, *family_)); !why.empty()) return why;
  const std::uint64_t used = pack(design);
  if (used <= device().most_placed) return {};
  return fmt::format("too full: {} of the {}'s {} logic cells", used, device().name, device().cells);
}

Clock Synthesizer::clock(const Design& design, unsigned seeds) const {
  Clock clock{.none = no_room(design)};
  for (unsigned seed = 1; clock.none.empty() && seed <= seeds; ++seed) {
    Placement placement = place(design, seed);
    if (!placement.ended)
      ++clock.endless;
    else if (placement.fits())
      clock.placements.push_back(std::move(placement));
    else
      clock = {.none = fmt::format("does not fit the {}", device().name)};
  }
  std::ranges::sort(clock.placements, {}, &Placement::mhz);
  if (clock.none.empty() && clock.placements.empty())
    clock.none = fmt::format("nextpnr does not end with {} seeds", clock.endless);
  return clock;
}

}  // namespace halfway::synth
