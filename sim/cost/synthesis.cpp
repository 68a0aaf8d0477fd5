// SPDX-License-Identifier: Apache-2.0
#include "sim/cost/synthesis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cinttypes>
#include <csignal>
#include <cstdio>
#include <functional>
#include <nlohmann/json.hpp>
#include <tuple>

#include "sim/cost/global_buffers.hpp"
#include "sim/cost/ice40_cells.hpp"
#include "sim/engines/verilator/netlist.hpp"
#include "sim/os/file.hpp"
#include "sim/os/must.hpp"
#include "sim/os/subprocess.hpp"

namespace halfway::synth {
namespace {

using nlohmann::json;

constexpr const char* c_no_end = "no_end";
constexpr const char* c_wrapped = "wrapped.json";
constexpr const char* c_report = "report.json";
constexpr const char* c_packing = "packing";
constexpr unsigned c_most_inputs = 256;  // flip-flops before a design
constexpr int c_frequency = 200;         // target clock in MHz, higher than any design reaches

// nextpnr's error message if it runs out of logic cells.
constexpr std::string_view c_too_large = "Unable to place cell";

std::vector<std::string> nextpnr_arguments() {
  return {"nextpnr-ice40",        "--hx8k", "--package", "ct256", "--freq", std::to_string(c_frequency),
          "--no-promote-globals", "--json", c_wrapped};
}

// The number in "Yosys 0.23 (git ...)" and "nextpnr-ice40 -- ... (Version 0.4-1+b1)".
std::string number_of(std::string_view version) {
  const std::size_t digit = std::min(version.find_first_of("0123456789", version.find(' ')), version.size());
  constexpr std::string_view c_mark = "Version ";
  const std::size_t mark = version.find(c_mark);
  const std::size_t from = mark == std::string_view::npos ? digit : mark + c_mark.size();
  return std::string(version.substr(from, version.find_first_of(" )\n", from) - from));
}

struct Port {
  std::string name;
  bool output = false;
  unsigned bits = 1;
};

std::vector<Port> ports_of(std::string_view netlist, std::string_view top) {
  const std::string head = fmt::format("module {}\n", top);
  const std::size_t at = netlist.find(head);
  const std::size_t end = at == std::string_view::npos ? at : netlist.find(';', at);
  if (end == std::string_view::npos)
    throw Failure{tool_failed(fmt::format("{}: the netlist has no such module", top))};
  std::string_view text = netlist.substr(at + head.size(), end - at - head.size());
  std::vector<Port> ports;
  while (!text.empty()) {
    const std::size_t line_end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, line_end);
    text.remove_prefix(std::min(line_end + 1, text.size()));
    Port port;
    std::size_t from = line.find("output ");
    port.output = from != std::string_view::npos;
    if (!port.output && (from = line.find("input ")) == std::string_view::npos) continue;
    line.remove_prefix(line.find(' ', from) + 1);
    if (const std::size_t open = line.find('['); open != std::string_view::npos) {
      port.bits = static_cast<unsigned>(std::stoul(std::string(line.substr(open + 1)))) + 1;
      line.remove_prefix(line.find(']') + 1);
    }
    line.remove_prefix(std::min(line.find_first_not_of(' '), line.size()));
    port.name = line.substr(0, line.find_first_of(",) "));
    ports.push_back(std::move(port));
  }
  return ports;
}

// The registers of a netlist for nextpnr, by the names of the logic cells that nextpnr packs them into.
class Registers {
 public:
  explicit Registers(const json& module) : cells_(module.at("cells")), names_(module.at("netnames")) {}

  /// Name of the register's output in the RTL.
  std::string name(std::string cell) const {
    for (const std::string_view suffix : {"_DFFLC", "_LC", "_RAM", "$nextpnr_RAM"})
      if (cell.ends_with(suffix)) {
        cell.erase(cell.size() - suffix.size());
        break;
      }
    const auto found = cells_.find(cell);
    if (found == cells_.end()) return tidy(cell);
    const auto& pins = found->at("connections");
    if (is_register(*found)) return name_of(pins.at("Q").at(0));
    if (found->value("type", "") != "SB_LUT4") return tidy(cell);
    const json& made = pins.at("O").at(0);
    for (const auto& other : cells_)
      if (is_register(other) && other.at("connections").at("D").at(0) == made)
        return name_of(other.at("connections").at("Q").at(0));
    return name_of(made);
  }

 private:
  // Remove the wrapper's prefix and Yosys's suffixes.
  static std::string tidy(std::string_view name) {
    if (name.starts_with("dut.")) name.remove_prefix(4);
    return std::string(name.substr(0, name.find("_SB_")));
  }

  // Preference among several names: names of the RTL, then names made by GHDL, then names made by Yosys.
  static int worth(std::string_view name) {
    if (name.find("_SB_") != std::string_view::npos) return 0;
    const std::string_view last = name.substr(name.rfind('.') + 1);
    const std::size_t digits = last.find_first_not_of("0123456789", 1);
    if (last.starts_with('n') && digits != 1 && (last.substr(digits) == "_q" || last.substr(digits) == "_o"))
      return 1;
    return name.starts_with("dut.") ? 3 : 2;
  }

  std::string name_of(const json& bit) const {
    std::string best;
    for (const auto& [name, net] : names_.items()) {
      const json& bits = net.at("bits");
      const auto at = std::find(bits.begin(), bits.end(), bit);
      if (at == bits.end() || net.value("hide_name", 0) != 0) continue;
      const std::string whole = bits.size() == 1 ? name : fmt::format("{}[{}]", name, at - bits.begin());
      const int more = worth(name) - (best.empty() ? -1 : worth(best.substr(0, best.find('['))));
      if (more > 0 || (more == 0 && whole.size() < best.size())) best = whole;
    }
    return tidy(best.empty() ? "?" : best);
  }

  const json& cells_;
  const json& names_;
};

CriticalPath read_path(const json& path, const Registers& registers) {
  CriticalPath result;
  for (const json& part : path) {
    const double delay = part.value("delay", 0.0);
    const std::string type = part.value("type", "");
    (type == "routing" ? result.routing : result.logic) += delay;
    if (type != "logic") continue;
    const std::string port = part.at("to").value("port", "");
    ++(port == "COUT" ? result.carries : result.luts);
  }
  result.from = registers.name(path.front().at("from").value("cell", ""));
  result.to = registers.name(path.back().at("to").value("cell", ""));
  return result;
}

}  // namespace

std::string wrapper(std::string_view netlist, std::string_view top, unsigned most_inputs) {
  unsigned inputs = 0, outputs = 0;
  std::string wires, pins, connections;
  for (const Port& port : ports_of(netlist, top)) {
    const bool is_clock = port.name == "clk" || port.name == "aclk";
    connections += fmt::format(",\n    .{}({})", port.name, is_clock ? "clk" : port.name);
    if (is_clock) continue;
    if (port.bits > 1)
      wires += fmt::format("  wire [{}:0] {};\n", port.bits - 1, port.name);
    else
      wires += fmt::format("  wire {};\n", port.name);
    if (port.output) {
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
  if (outputs == 0) throw Failure{tool_failed(fmt::format("{}: has no output to register", top))};
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

Placement read_placement(std::string_view report, std::string_view netlist, unsigned seed) {
  Placement placement{.seed = seed};
  const json figures = json::parse(report, nullptr, false);
  const json design = json::parse(netlist, nullptr, false);
  try {
    const Registers registers(design.at("modules").at("wrapped"));
    const json& logic_cells = figures.at("utilization").at("ICESTORM_LC");
    placement.cells_used = logic_cells.at("used");
    placement.cells_there = logic_cells.at("available");
    if (figures.at("fmax").size() != 1)
      throw Failure{
          tool_failed(fmt::format("nextpnr reports {} clocks, not one", figures.at("fmax").size()))};
    const auto clock = figures.at("fmax").begin();
    placement.mhz = clock->at("achieved");
    for (const json& path : figures.at("critical_paths")) {
      const std::string edge = "posedge " + clock.key();
      if (path.value("from", "") != edge || path.value("to", "") != edge) continue;
      placement.path = read_path(path.at("path"), registers);
    }
  } catch (const json::exception& error) {
    throw Failure{tool_failed(fmt::format("not what nextpnr 0.4 reports: {}", error.what()))};
  }
  return placement;
}

std::string does_not_fit(std::string_view what, std::uint64_t count, std::uint64_t most) {
  return count > most ? fmt::format("does not fit the HX8K: {} {} of {}", count, what, most) : std::string();
}

std::string does_not_fit(const Ice40Cells& cells) {
  for (const auto& [what, count, most] : {std::tuple{"LUTs", cells.luts, c_device_cells},
                                          {"flip-flops", cells.flip_flops, c_device_cells},
                                          {"RAMs", cells.rams, c_device_rams}})
    if (std::string why = does_not_fit(what, count, most); !why.empty()) return why;
  return {};
}

Packing read_packing(std::string_view said) {
  constexpr std::string_view c_cells = "ICESTORM_LC:";
  const std::size_t at = said.find(c_cells);
  Packing packing;
  if (at != std::string_view::npos) {
    const std::string figures(said.substr(at + c_cells.size(), 40));
    if (std::sscanf(figures.c_str(), "%" SCNu64 " / %" SCNu64, &packing.cells_used, &packing.cells_there) ==
        2)
      return packing;
  }
  throw Failure{tool_failed(fmt::format("not what nextpnr 0.4 says of a device's utilisation:\n{}", said))};
}

const Placement* Clock::median() const {
  return placements.empty() ? nullptr : &placements[placements.size() / 2];
}

Synthesizer Synthesizer::open(const SimulatorFolders& folders, bool place,
                              const std::vector<std::string>& more) {
  const Folder cache = std::filesystem::absolute(folders.cache) / "synth";
  Yosys yosys = Yosys::find(cache);
  const GhdlTool ghdl = must(GhdlTool::find());
  std::vector<VhdlSource> sources = must(read_rtl_sources(folders.source));
  for (const std::string& file : more) sources.push_back(must(read_vhdl_source(folders.source, file)));
  Synthesizer synthesizer(must(GhdlLibrary::for_synthesis(ghdl, sources, folders.cache)), std::move(yosys),
                          cache);
  synthesizer.versions_ =
      fmt::format("GHDL {}, Yosys {}", number_of(ghdl.version), number_of(synthesizer.yosys_.version()));
  if (place) {
    synthesizer.nextpnr_ = version_of("nextpnr-ice40", "--version");
    synthesizer.versions_ += ", nextpnr-ice40 " + number_of(synthesizer.nextpnr_);
  }
  return synthesizer;
}

std::string Synthesizer::netlist(const Design& design) const {
  return must(mend_netlist(must(library_.synthesize(design.entity, design.generics))));
}

Synthesizer::Folder Synthesizer::synthesized(const Design& design, const std::string& family,
                                             const std::string& script) const {
  return yosys_.run(design.name + "-" + family, script, {{"netlist.v", netlist(design)}}, read_statistics);
}

Synthesizer::Folder Synthesizer::mapped(const Design& design) const {
  return synthesized(
      design, "ice40",
      fmt::format("read_verilog netlist.v; synth_ice40 -device hx -top {}; {}; write_rtlil mapped.il",
                  design.entity, c_statistics));
}

Ice40Cells Synthesizer::ice40(const Design& design) const {
  Ice40Cells cells;
  count_cells(mapped(design), {{"SB_LUT4", &cells.luts},
                               {"SB_CARRY", &cells.carries},
                               {"SB_DFF", &cells.flip_flops},
                               {"SB_RAM40_4K", &cells.rams}});
  return cells;
}

Ecp5Cells Synthesizer::ecp5(const Design& design) const {
  Ecp5Cells cells;
  count_cells(
      synthesized(design, "ecp5",
                  fmt::format("read_verilog netlist.v; synth_ecp5 -top {}; {}", design.entity, c_statistics)),
      {{"LUT4", &cells.luts},
       {"CCU2C", &cells.luts, 2},
       {"TRELLIS_FF", &cells.flip_flops},
       {"DP16KD", &cells.rams},
       {"MULT18X18D", &cells.multipliers},
       {"TRELLIS_DPR16X4", &cells.luts, 4},
       // Multiplexers between the LUTs of a slice.
       {"PFUMX", nullptr},
       {"L6MUX21", nullptr}});
  return cells;
}

std::string Synthesizer::from_mapped(const Design& design, const std::string& script, const std::string& file,
                                     const std::string& around) const {
  const std::string core = must(read_file(mapped(design) / "mapped.il"));
  const Folder folder = yosys_.run(fmt::format("{}-{}", design.name, file), script,
                                   {{"mapped.il", core}, {"wrapper.v", around}},
                                   [&](const Folder& fresh) { must(read_file(fresh / file)); });
  return must(read_file(folder / file));
}

// splitnets, because Verilator takes a carry chain in one vector for a combinational loop.
std::string Synthesizer::simulated(const Design& design) const {
  return from_mapped(
      design,
      fmt::format(
          "read_rtlil mapped.il; delete =A:blackbox; read_verilog -defer -D ICE40_HX +/ice40/cells_sim.v; "
          "hierarchy -top {}; proc; flatten; opt_clean -purge; splitnets; write_verilog -noattr simulated.v",
          design.entity),
      "simulated.v", "");
}

// Synthesize the wrapper separately and then insert the already synthesized design, so that no optimization
// crosses the boundary.
std::string Synthesizer::wrapped(const Design& design) const {
  const std::string script = fmt::format(
      "read_rtlil mapped.il; blackbox {0}; setattr -mod -unset top {0}; read_verilog wrapper.v; "
      "synth_ice40 -device hx -top wrapped; read_rtlil -overwrite mapped.il; setattr -mod -unset top {0}; "
      "hierarchy -top wrapped; flatten; opt_clean -purge; write_json {1}",
      design.entity, c_wrapped);
  const auto buffered = with_global_buffers(
      from_mapped(design, script, c_wrapped, wrapper(netlist(design), design.entity, c_most_inputs)));
  if (!buffered) throw Failure{tool_failed(fmt::format("{}: {}", design.name, buffered.error().message))};
  return *buffered;
}

Synthesizer::Folder Synthesizer::placed(const Design& design, const std::string& kind,
                                        const std::vector<std::string>& arguments, const std::string& netlist,
                                        const std::function<void(const Folder&)>& run) const {
  ContentHash hash;
  hash.add("placed 2").add(nextpnr_).add(netlist);
  for (const std::string& argument : arguments) hash.add(argument);
  Folder folder = cache_ / fmt::format("{}-{}-{}", design.name, kind, hash.hex());
  make_once(folder, [&](const Folder& fresh) {
    must(write_file(fresh / c_wrapped, netlist));
    run(fresh);
    std::filesystem::remove(fresh / c_wrapped);
  });
  return folder;
}

Packing Synthesizer::pack(const Design& design) const {
  std::vector<std::string> arguments = nextpnr_arguments();
  arguments.push_back("--pack-only");
  const Folder folder = placed(design, "packed", arguments, wrapped(design), [&](const Folder& fresh) {
    const std::string said = run_tool(arguments, fresh, design.name);
    read_packing(said);
    must(write_file(fresh / c_packing, said));
  });
  return read_packing(must(read_file(folder / c_packing)));
}

Placement Synthesizer::place(const Design& design, unsigned seed) const {
  // Limit the processor time by the shell's ulimit, because elapsed time depends on the machine's load. A
  // soft limit, so that the process ends with SIGXCPU.
  std::vector<std::string> arguments = {"sh", "-c", "ulimit -c 0 && ulimit -S -t \"$0\" && exec \"$@\"",
                                        std::to_string(c_place_time.count())};
  for (const std::string& argument : nextpnr_arguments()) arguments.push_back(argument);
  arguments.insert(arguments.end(),
                   {"--seed", std::to_string(seed), "--timing-allow-fail", "--quiet", "--report", c_report});
  const std::string netlist = wrapped(design);
  const Folder folder =
      placed(design, fmt::format("placed{}", seed), arguments, netlist, [&](const Folder& fresh) {
        const Command command{.arguments = arguments, .working_folder = fresh, .timeout = c_tool_timeout};
        const ProcessEnd end = must(run_process(command, c_install_tools));
        // A timeout and a full device are valid results without a report.
        if (end.signal == SIGXCPU)
          must(write_file(fresh / c_no_end, ""));
        else if (!end.succeeded() && end.output.find(c_too_large) == std::string::npos)
          throw Failure{tool_failed(fmt::format("{}: nextpnr-ice40 failed ({}):\n{}\n  while running: {}",
                                                design.name, end.how(), end.output, to_string(command)))};
      });
  if (std::filesystem::exists(folder / c_no_end)) return {.seed = seed, .ended = false};
  if (!std::filesystem::exists(folder / c_report)) return {.seed = seed};
  return read_placement(must(read_file(folder / c_report)), netlist, seed);
}

std::string Synthesizer::no_room(const Design& design) const {
  // Each cell takes a logic cell; some share one.
  if (std::string why = does_not_fit(ice40(design)); !why.empty()) return why;
  const Packing packing = pack(design);
  if (packing.cells_used <= c_most_placed) return {};
  return fmt::format("too full: {} of the HX8K's {} logic cells", packing.cells_used, packing.cells_there);
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
      clock = {.none = "does not fit the HX8K"};
  }
  std::ranges::sort(clock.placements, {}, &Placement::mhz);
  if (clock.none.empty() && clock.placements.empty())
    clock.none = fmt::format("nextpnr does not end with {} seeds", clock.endless);
  return clock;
}

}  // namespace halfway::synth
