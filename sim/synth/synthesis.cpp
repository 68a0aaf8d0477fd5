// SPDX-License-Identifier: Apache-2.0
#include "sim/synth/synthesis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cinttypes>
#include <csignal>
#include <cstdio>
#include <functional>
#include <nlohmann/json.hpp>
#include <tuple>

#include "sim/ghdl/hardware_units.hpp"
#include "sim/synth/global_buffers.hpp"
#include "sim/synth/ice40_cells.hpp"
#include "sim/synth/nameless_netlist.hpp"
#include "sim/synth/netlist_parts.hpp"
#include "sim/system/file.hpp"
#include "sim/system/subprocess.hpp"
#include "sim/verilator/netlist.hpp"

namespace halfway::synth {
namespace {

using nlohmann::json;

constexpr std::chrono::minutes c_timeout{60};
constexpr const char* c_no_end = "no_end";
constexpr const char* c_wrapped = "wrapped.json";
constexpr unsigned c_most_inputs = 256;  // flip-flops before a design
constexpr int c_frequency = 200;         // target clock in MHz, higher than any design reaches

// nextpnr's error message if it runs out of logic cells.
constexpr std::string_view c_too_large = "Unable to place cell";

Result<std::string> run(Command command, const std::string& doing) {
  command.timeout = c_timeout;
  const auto end = run_process(command, c_install_tools);
  if (!end) return end.error();
  if (end->succeeded()) return end->output;
  return tool_failed(fmt::format("{}: {} failed ({}):\n{}\n  while running: {}", doing,
                                 command.arguments.front(), end->how(), end->output, to_string(command)));
}

// Return the folder. Call `make` to fill it if it is missing. Concurrent calls make equal contents.
Result<std::filesystem::path> kept(const std::filesystem::path& folder,
                                   const std::function<Status(const std::filesystem::path&)>& make) {
  if (std::filesystem::exists(folder)) return folder;
  auto fresh = TemporaryFolder::make(folder.parent_path());
  if (!fresh) return fresh.error();
  if (Status made = make(fresh->path()); !made) return made.error();
  if (Status moved = fresh->move_to(folder); !moved) return moved.error();
  return folder;
}

Status run_yosys(const std::string& script, const std::filesystem::path& folder, const Design& design) {
  const auto done = run({.arguments = {"yosys", "-q", "-p", script}, .working_folder = folder}, design.name);
  if (!done) return done.error();
  return Ok{};
}

std::string ice40_script(std::string_view entity) {
  return fmt::format(
      "read_verilog netlist.v; synth_ice40 -device hx -top {}; tee -q -o cells.json stat "
      "-json; write_rtlil mapped.il",
      entity);
}

// Synthesize the wrapper separately and then insert the already synthesized design, so that no optimization
// crosses the boundary.
std::string wrapped_script(std::string_view entity) {
  return fmt::format(
      "read_rtlil mapped.il; blackbox {0}; setattr -mod -unset top {0}; read_verilog wrapper.v; "
      "synth_ice40 -device hx -top wrapped; read_rtlil -overwrite mapped.il; setattr -mod -unset "
      "top {0}; "
      "hierarchy -top wrapped; flatten; opt_clean -purge; write_json {1}",
      entity, c_wrapped);
}

std::vector<std::string> nextpnr_arguments() {
  return {"nextpnr-ice40",       "--hx8k", "--package", "ct256", "--freq", std::to_string(c_frequency),
          "--no-promote-globals"};
}
// nextpnr's options for a placement that affect the result.
std::vector<std::string> place_arguments(unsigned seed) {
  std::vector<std::string> arguments = nextpnr_arguments();
  arguments.insert(arguments.end(), {"--seed", std::to_string(seed), "--timing-allow-fail", "--quiet",
                                     "--report", "report.json"});
  return arguments;
}

std::string first_line(std::string_view text) {
  return std::string(text.substr(0, text.find('\n')));
}

// "Yosys 0.23 (git ...)" and "nextpnr-ice40 -- ... (Version 0.4-1+b1)": keep only the name before the
// version.
std::string version_of(std::string_view said) {
  const std::size_t digit = std::min(said.find_first_of("0123456789", said.find(' ')), said.size());
  const std::size_t version = said.find("Version ");
  const std::size_t from =
      version == std::string_view::npos ? digit : version + std::string_view("Version ").size();
  return std::string(said.substr(from, said.find_first_of(" )\n", from) - from));
}

Status buffer_globals(const std::filesystem::path& path) {
  const auto text = read_file(path);
  if (!text) return text.error();
  const auto buffered = with_global_buffers(*text);
  if (!buffered) return tool_failed(fmt::format("{}: {}", path.string(), buffered.error().message));
  return write_file(path, *buffered);
}

Result<std::string> netlist_of(const GhdlLibrary& library, const Design& design) {
  const auto text = library.synthesize(design.entity, design.generics);
  if (!text) return text.error();
  return mend_netlist(*text);
}

std::string hash_of(std::string_view entity, std::string_view netlist) {
  return ContentHash().add("netlist 3").add("flow 2").add(entity).add(nameless(netlist)).hex();
}

struct Port {
  std::string name;
  bool output = false;
  unsigned bits = 1;
};

Result<std::vector<Port>> ports_of(std::string_view netlist, std::string_view top) {
  const std::string head = fmt::format("module {}\n", top);
  const std::size_t at = netlist.find(head);
  const std::size_t end = at == std::string_view::npos ? at : netlist.find(';', at);
  if (end == std::string_view::npos)
    return tool_failed(fmt::format("{}: the netlist has no such module", top));
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

// Read the statistics of the whole design from Yosys's stat: number of cells by type.
Result<json> read_types(const std::filesystem::path& path) {
  const auto text = read_file(path);
  if (!text) return tool_failed(text.error().message);
  const json whole = json::parse(*text, nullptr, false);
  if (whole.is_object()) {
    json types = whole.value("design", json::object()).value("num_cells_by_type", json());
    if (types.is_object()) return types;
  }
  return tool_failed(
      fmt::format("{}: not the output of Yosys's stat; delete it and try again", path.string()));
}

Error unknown_cells(const Design& design, const std::string& type) {
  return tool_failed(fmt::format("{}: cells of type {}, which nothing counts", design.name, type));
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

Result<CriticalPath> read_path(const json& path, const Registers& registers) {
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

Result<std::string> wrapper(std::string_view netlist, std::string_view top, unsigned most_inputs) {
  const auto ports = ports_of(netlist, top);
  if (!ports) return ports.error();
  unsigned inputs = 0, outputs = 0;
  std::string wires, pins, connections;
  for (const Port& port : *ports) {
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
  if (outputs == 0) return tool_failed(fmt::format("{}: has no output to register", top));
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

Result<Placement> read_placement(std::string_view report, std::string_view netlist, unsigned seed) {
  Placement placement{.seed = seed};
  const json figures = json::parse(report, nullptr, false);
  const json design = json::parse(netlist, nullptr, false);
  try {
    const Registers registers(design.at("modules").at("wrapped"));
    const json& logic_cells = figures.at("utilization").at("ICESTORM_LC");
    placement.cells_used = logic_cells.at("used");
    placement.cells_there = logic_cells.at("available");
    if (figures.at("fmax").size() != 1)
      return tool_failed(fmt::format("nextpnr reports {} clocks, not one", figures.at("fmax").size()));
    const auto clock = figures.at("fmax").begin();
    placement.mhz = clock->at("achieved");
    for (const json& path : figures.at("critical_paths")) {
      const std::string edge = "posedge " + clock.key();
      if (path.value("from", "") != edge || path.value("to", "") != edge) continue;
      auto read = read_path(path.at("path"), registers);
      if (!read) return read.error();
      placement.path = std::move(*read);
    }
  } catch (const json::exception& error) {
    return tool_failed(fmt::format("not what nextpnr 0.4 reports: {}", error.what()));
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

Result<Packing> read_packing(std::string_view said) {
  constexpr std::string_view c_cells = "ICESTORM_LC:";
  const std::size_t at = said.find(c_cells);
  Packing packing;
  if (at != std::string_view::npos) {
    const std::string figures(said.substr(at + c_cells.size(), 40));
    if (std::sscanf(figures.c_str(), "%" SCNu64 " / %" SCNu64, &packing.cells_used, &packing.cells_there) ==
        2)
      return packing;
  }
  return tool_failed(fmt::format("not what nextpnr 0.4 says of a device's utilisation:\n{}", said));
}

Result<std::string> netlist_hash(const GhdlLibrary& library, const Design& design) {
  const auto text = netlist_of(library, design);
  if (!text) return text.error();
  return hash_of(design.entity, *text);
}

Result<std::set<std::string>> part_hashes(const GhdlLibrary& library, const Design& design,
                                          const std::set<std::string>& entities) {
  const auto text = netlist_of(library, design);
  if (!text) return text.error();
  std::set<std::string> hashes;
  for (const NetlistPart& part : parts_of(*text))
    if (const std::string entity = entity_of(part.module, entities); !entity.empty())
      hashes.insert(hash_of(entity, part.netlist));
  return hashes;
}

std::string flow_hash() {
  constexpr std::string_view c_top = "top";
  // A port of each kind, and more input bits than the wrapper's flip-flops.
  static_assert(c_most_inputs < 300);
  const auto around = wrapper(
      "module top\n  (input  clk,\n   input  [299:0] a,\n   input  b,\n   output [1:0] c,\n   output d);\n"
      "endmodule\n",
      c_top, c_most_inputs);
  ContentHash hash;
  hash.add(ice40_script(c_top)).add(wrapped_script(c_top)).add(*around).add(c_buffers_rule);
  for (const std::string& argument : place_arguments(1)) hash.add(argument);
  return hash.hex();
}

Result<Synthesizer> Synthesizer::open(const SimulatorFolders& folders, bool place,
                                      const std::vector<std::string>& more, std::chrono::seconds place_time) {
  const auto tool = GhdlTool::find();
  if (!tool) return tool.error();
  auto yosys = run({.arguments = {"yosys", "-V"}}, "looking for yosys");
  if (!yosys) return yosys.error();
  std::string nextpnr;
  if (place) {
    const auto said = run({.arguments = {"nextpnr-ice40", "--version"}}, "looking for nextpnr-ice40");
    if (!said) return said.error();
    nextpnr = first_line(*said);
  }
  auto sources = read_rtl_sources(folders.source);
  if (!sources) return sources.error();
  for (const std::string& file : more) {
    auto source = read_vhdl_source(folders.source, file);
    if (!source) return source.error();
    sources->push_back(std::move(*source));
  }
  auto library = GhdlLibrary::for_synthesis(*tool, *sources, folders.cache);
  if (!library) return library.error();
  Synthesizer synthesizer(std::move(*library), std::filesystem::absolute(folders.cache) / "synth");
  synthesizer.yosys_ = *yosys;
  synthesizer.nextpnr_ = nextpnr;
  synthesizer.place_time_ = place_time;
  synthesizer.versions_ = fmt::format("GHDL {}, Yosys {}{}", version_of(tool->version), version_of(*yosys),
                                      nextpnr.empty() ? "" : ", nextpnr-ice40 " + version_of(nextpnr));
  return synthesizer;
}

Result<std::filesystem::path> Synthesizer::synthesized(const Design& design, const std::string& family,
                                                       const std::string& script) const {
  const auto text = netlist_of(library_, design);
  if (!text) return text.error();
  ContentHash hash;
  hash.add("synth 1").add(yosys_).add(script).add(*text);
  return kept(cache_ / fmt::format("{}-{}-{}", design.name, family, hash.hex()),
              [&](const std::filesystem::path& fresh) -> Status {
                if (Status written = write_file(fresh / "netlist.v", *text); !written) return written;
                return run_yosys(script, fresh, design);
              });
}

Result<std::filesystem::path> Synthesizer::ice40_folder(const Design& design) const {
  return synthesized(design, "ice40", ice40_script(design.entity));
}

Result<Ice40Cells> Synthesizer::ice40(const Design& design) const {
  const auto folder = ice40_folder(design);
  if (!folder) return folder.error();
  const auto types = read_types(*folder / "cells.json");
  if (!types) return types.error();
  Ice40Cells cells;
  for (const auto& [type, count] : types->items()) {
    const auto n = count.get<std::uint64_t>();
    if (type == "SB_LUT4")
      cells.luts += n;
    else if (type == "SB_CARRY")
      cells.carries += n;
    else if (is_register_type(type))
      cells.flip_flops += n;
    else if (type.starts_with("SB_RAM40_4K"))
      cells.rams += n;
    else
      return unknown_cells(design, type);
  }
  return cells;
}

Result<std::filesystem::path> Synthesizer::from_mapped(const Design& design, const std::string& kind,
                                                       const std::string& script,
                                                       const std::string& around) const {
  const auto core = ice40_folder(design);
  if (!core) return core.error();
  ContentHash hash;
  hash.add("mapped 1").add(yosys_).add(script).add(around).add(core->filename().string());
  if (!around.empty()) hash.add(c_buffers_rule);
  return kept(
      cache_ / fmt::format("{}-{}-{}", design.name, kind, hash.hex()),
      [&](const std::filesystem::path& fresh) -> Status {
        std::error_code error;
        std::filesystem::copy(*core / "mapped.il", fresh / "mapped.il", error);
        if (error)
          return tool_failed(fmt::format("{}: cannot be copied: {}", core->string(), error.message()));
        if (!around.empty())
          if (Status written = write_file(fresh / "wrapper.v", around); !written) return written;
        if (Status made = run_yosys(script, fresh, design); !made || around.empty()) return made;
        return buffer_globals(fresh / c_wrapped);
      });
}

// splitnets, because Verilator takes a carry chain in one vector for a combinational loop.
Result<std::string> Synthesizer::simulated(const Design& design) const {
  const auto folder = from_mapped(
      design, "simulated",
      fmt::format(
          "read_rtlil mapped.il; delete =A:blackbox; read_verilog -defer -D ICE40_HX +/ice40/cells_sim.v; "
          "hierarchy -top {}; proc; flatten; opt_clean -purge; splitnets; write_verilog -noattr simulated.v",
          design.entity),
      "");
  if (!folder) return folder.error();
  return read_file(*folder / "simulated.v");
}

Result<Ecp5Cells> Synthesizer::ecp5(const Design& design) const {
  const auto folder =
      synthesized(design, "ecp5",
                  fmt::format("read_verilog netlist.v; synth_ecp5 -top {}; tee -q -o cells.json stat -json",
                              design.entity));
  if (!folder) return folder.error();
  const auto types = read_types(*folder / "cells.json");
  if (!types) return types.error();
  Ecp5Cells cells;
  for (const auto& [type, count] : types->items()) {
    const auto n = count.get<std::uint64_t>();
    if (type == "LUT4")
      cells.luts += n;
    else if (type == "CCU2C")
      cells.luts += 2 * n;
    else if (type == "TRELLIS_FF")
      cells.flip_flops += n;
    else if (type == "DP16KD")
      cells.rams += n;
    else if (type == "MULT18X18D")
      cells.multipliers += n;
    else if (type == "TRELLIS_DPR16X4")
      cells.luts += 4 * n;
    else if (type != "PFUMX" && type != "L6MUX21")  // multiplexers between the LUTs of a slice
      return unknown_cells(design, type);
  }
  return cells;
}

Result<std::filesystem::path> Synthesizer::wrapped_folder(const Design& design) const {
  const auto text = netlist_of(library_, design);
  if (!text) return text.error();
  const auto around = wrapper(*text, design.entity, c_most_inputs);
  if (!around) return around.error();
  return from_mapped(design, "wrapped", wrapped_script(design.entity), *around);
}

Result<std::string> Synthesizer::netlist_hash(const Design& design) const {
  return synth::netlist_hash(library_, design);
}

Result<Packing> Synthesizer::pack(const Design& design) const {
  const auto wrapped = wrapped_folder(design);
  if (!wrapped) return wrapped.error();
  std::vector<std::string> arguments = nextpnr_arguments();
  ContentHash hash;
  hash.add("packed 1").add(nextpnr_).add(wrapped->filename().string());
  for (const std::string& argument : arguments) hash.add(argument);
  arguments.insert(arguments.end(), {"--pack-only", "--json", (*wrapped / c_wrapped).string()});
  const auto folder = kept(cache_ / fmt::format("{}-packed-{}", design.name, hash.hex()),
                           [&](const std::filesystem::path& fresh) -> Status {
                             const auto said =
                                 run({.arguments = arguments, .working_folder = fresh}, design.name);
                             if (!said) return said.error();
                             if (const auto read = read_packing(*said); !read) return read.error();
                             return write_file(fresh / "said", *said);
                           });
  if (!folder) return folder.error();
  const auto said = read_file(*folder / "said");
  if (!said) return said.error();
  return read_packing(*said);
}

Result<std::string> Synthesizer::no_room(const Design& design) const {
  const auto cells = ice40(design);
  if (!cells) return cells.error();
  // Each cell takes a logic cell; some share one.
  if (std::string why = does_not_fit(*cells); !why.empty()) return why;
  const auto packing = pack(design);
  if (!packing) return packing.error();
  if (packing->cells_used > c_most_placed)
    return fmt::format("too full: {} of the HX8K's {} logic cells", packing->cells_used,
                       packing->cells_there);
  return std::string();
}

Result<Placement> Synthesizer::place(const Design& design, unsigned seed) const {
  const auto wrapped = wrapped_folder(design);
  if (!wrapped) return wrapped.error();
  const std::string net = (*wrapped / c_wrapped).string();
  const std::vector<std::string> arguments = place_arguments(seed);
  ContentHash hash;
  hash.add("placed 1").add(nextpnr_).add(wrapped->filename().string());
  for (const std::string& argument : arguments) hash.add(argument);
  // Limit the processor time by the shell's ulimit, because elapsed time depends on the machine's load. A
  // soft limit, so that the process ends with SIGXCPU.
  std::vector<std::string> limited = {"sh", "-c", "ulimit -c 0 && ulimit -S -t \"$0\" && exec \"$@\"",
                                      std::to_string(place_time_.count())};
  limited.insert(limited.end(), arguments.begin(), arguments.end());
  limited.insert(limited.end(), {"--json", net});
  hash.add(limited[3]);
  const auto folder =
      kept(cache_ / fmt::format("{}-placed{}-{}", design.name, seed, hash.hex()),
           [&](const std::filesystem::path& fresh) -> Status {
             const Command command{.arguments = limited, .working_folder = fresh, .timeout = c_timeout};
             const auto end = run_process(command, c_install_tools);
             if (!end) return end.error();
             // A timeout and a full device are valid results without a report.
             if (end->signal == SIGXCPU) return write_file(fresh / c_no_end, "");
             if (end->succeeded() || end->output.find(c_too_large) != std::string::npos) return Ok{};
             return tool_failed(fmt::format("{}: nextpnr-ice40 failed ({}):\n{}\n  while running: {}",
                                            design.name, end->how(), end->output, to_string(command)));
           });
  if (!folder) return folder.error();
  if (std::filesystem::exists(*folder / c_no_end)) return Placement{.seed = seed, .ended = false};
  const auto report = read_file(*folder / "report.json");
  if (!report) return Placement{.seed = seed};
  const auto text = read_file(net);
  if (!text) return text.error();
  return read_placement(*report, *text, seed);
}

}  // namespace halfway::synth
