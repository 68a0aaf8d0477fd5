// SPDX-License-Identifier: Apache-2.0
// `halfway verilog`: the hardware of a scene as plain Verilog, for designs and tools without VHDL.
#include <fmt/format.h>

#include <memory>
#include <regex>

#include "plan/plan.hpp"
#include "sim/cli/options.hpp"
#include "sim/cost/design.hpp"
#include "sim/engines/ghdl/ghdl_library.hpp"
#include "sim/engines/verilator/netlist.hpp"
#include "sim/engines/verilator/shader_netlist.hpp"
#include "sim/files/load_scene.hpp"
#include "sim/os/file.hpp"
#include "sim/os/must.hpp"
#include "sim/os/printable.hpp"

namespace halfway::cli {
namespace {

struct VerilogCommand {
  DrawOptions draw;
  std::string scene = "spheres";
  bool axi = false;   // words_to_fragments
  bool core = false;  // halfway_core
  CoreOptions core_options;
  unsigned multiplier_bits = 18;  // as in most FPGAs
};

// Before the name of each module and file, which else is that of an entity: users may have a multiplier, too.
constexpr std::string_view c_prefix = "halfway_";

// The netlist with the prefix at each declaration of a module and at each instance.
std::string with_prefix(const std::string& netlist) {
  static const std::regex c_name(R"(((?:^|\n)module |\n  (?=\w+ \w+ \(\n))(?!halfway_))");
  return std::regex_replace(netlist, c_name, fmt::format("$&{}", c_prefix));
}

using Generics = std::vector<std::pair<std::string, std::string>>;

Generics generics_of(const HardwareKey& key, const std::string& top, const VerilogCommand& command) {
  const CoreOptions& core = command.core_options;
  auto generics = top == c_core_top     ? key.core_generics(core.true_colour(), core.bus_bits)
                  : top == c_stream_top ? key.stream_generics()
                                        : key.generics();
  if (synth::takes_multiplier_bits(top))
    generics.emplace_back("g_multiplier_bits", std::to_string(command.multiplier_bits));
  return generics;
}

std::string header(const VerilogCommand& command, const HardwareKey& key, const std::string& top,
                   const std::string& module, const Generics& generics, const std::vector<ModulePort>& ports,
                   const std::string& version) {
  std::string text = fmt::format(
      "// SPDX-License-Identifier: Apache-2.0\n// {}, hardware key {}: written by Halfway {} with\n"
      "//   halfway verilog {} {}{}{}\n"
      "// from the VHDL in rtl/, by GHDL. Do not edit it: change the VHDL.\n// Generics:",
      module, key.name(), version, printable(command.scene), hardware_options(command.draw),
      command.core ? fmt::format(" --core --format {} --bus {}", command.core_options.format,
                                 command.core_options.bus_bits)
                   : std::string(command.axi ? " --axi" : ""),
      synth::takes_multiplier_bits(top) ? fmt::format(" --multiplier-bits {}", command.multiplier_bits)
                                        : std::string());
  for (const auto& [name, value] : generics) text += fmt::format(" {}={}", name, value);
  text += "\n// Ports, in this order:\n";
  for (const ModulePort& port : ports)
    text += fmt::format("//   {:<6}  {:>5}  {}\n", port.is_output ? "output" : "input", port.bits, port.name);
  return text;
}

void run(const Folders& folders, const VerilogCommand& command, const std::string& version) {
  const auto draw = checked(command.draw);
  const auto scene = must(load_scene(command.scene, folders.scenes()));
  const auto plan = must(plan_scene(scene, draw.plan));
  const HardwareKey& key = plan.key;
  const std::string top = command.core ? c_core_top : command.axi ? c_stream_top : key.entity();
  const std::string module = top == c_core_top ? top : fmt::format("{}{}", c_prefix, top);
  const Generics generics = generics_of(key, top, command);
  const GhdlLibrary library = rtl_library({folders.source, folders.cache()});
  const auto netlist = with_prefix(must(mend_netlist(must(library.synthesize(top, generics)))));
  const std::vector<ModulePort> ports = ports_of(netlist, module);
  if (ports.empty()) throw_tool_failed("{}: GHDL's netlist has no module {}", key.name(), module);

  const std::filesystem::path folder = draw.out / key.name();
  const std::filesystem::path file = folder / (module + ".v"), list = folder / (module + ".f");
  must(make_folders(folder));
  must(write_file(file, header(command, key, top, module, generics, ports, version) + netlist));
  must(write_file(list, module + ".v\n"));
  fmt::print("{}: module {} with {} ports\n{}: the list of files\n", file.string(), module, ports.size(),
             list.string());
}

}  // namespace

void add_verilog(CLI::App& app, const Folders& folders, int&) {
  CLI::App* sub =
      app.add_subcommand("verilog", "write the hardware of a scene as Verilog, with a list of files");
  auto command = std::make_shared<VerilogCommand>();
  command->draw.out = "build/verilog";
  sub->add_option("scene", command->scene, "as for sim")->capture_default_str();
  command->draw.add_to(*sub);
  CLI::Option* axi =
      sub->add_flag("--axi", command->axi, "words_to_fragments: the shader with AXI4-Stream ports");
  CLI::Option* core =
      sub->add_flag("--core", command->core, "halfway_core: from commands in memory to a picture in memory")
          ->excludes(axi);
  command->core_options.add_to(*sub, core);
  sub->add_option("--multiplier-bits", command->multiplier_bits,
                  "width of the device's multipliers; 0: products in lookup tables")
      ->check(CLI::Range(0, 64))
      ->capture_default_str();
  sub->callback([=, &app, &folders] { run(folders, *command, app.version()); });
}

}  // namespace halfway::cli
