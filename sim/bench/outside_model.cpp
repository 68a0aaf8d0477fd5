// SPDX-License-Identifier: Apache-2.0
#include "sim/bench/outside_model.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <cstring>
#include <string>

#include "sim/system/file.hpp"
#include "sim/system/shared_library.hpp"
#include "sim/verilator/netlist.hpp"
#include "sim/verilator/shader_netlist.hpp"

namespace halfway {
namespace {

constexpr const char* c_install_yosys = "apt-get install yosys yosys-dev";

/// CXXRTL's name of a module: prefix p_, underscores doubled.
std::string cxxrtl_name(const std::string& module) {
  std::string name = "p_";
  for (const char c : module) name += c == '_' ? "__" : std::string(1, c);
  return name;
}

}  // namespace

Result<OutsideModel> OutsideModel::open(OutsideTool tool, const HardwareKey& key,
                                        const SimulatorFolders& folders, bool fast) {
  const bool verilated = tool == OutsideTool::verilator;
  const auto version = verilated ? ask({"verilator", "--version"}, c_install_verilator)
                                 : ask({"yosys", "-V"}, c_install_yosys);
  if (!version) return version.error();
  const auto include = verilated ? Result<std::string>(std::string())
                                 : ask({"yosys-config", "--datdir/include"}, c_install_yosys);
  if (!include) return include.error();
  const auto compiler = Compiler::find(verilated ? "g++" : "");
  if (!compiler) return compiler.error();
  const auto netlist = netlist_of(key, folders);
  if (!netlist) return netlist.error();
  const auto harness = read_file(folders.source / "sim/bench/plain_harness.cpp");
  if (!harness) return tool_failed(harness.error().message);

  const std::string bits =
      fmt::format("-DHALFWAY_INIT_BITS={}", port_bits(*netlist, key.entity(), "init_data"));
  Command translate, compile;
  if (verilated) {
    // The same warnings as in sim/verilator are waived.
    translate.arguments = {"verilator",           "--cc",           "--exe",    "--build",   "-Wno-COMBDLY",
                           "-Wno-CASEINCOMPLETE", "-Wno-UNOPTFLAT", "--prefix", "Vshader",   "--top-module",
                           key.entity(),          "-CFLAGS",        bits,       "netlist.v", "harness.cpp"};
  } else {
    translate.arguments = {
        "yosys", "-q", "-p",
        fmt::format("read_verilog netlist.v; hierarchy -top {}; write_cxxrtl model.cc", key.entity())};
    compile.arguments = {compiler->program,
                         "-std=c++17",
                         fast ? "-O3" : "-O0",
                         "-march=native",
                         "-w",
                         "-I" + *include,
                         "-DHALFWAY_CXXRTL",
                         "-DHALFWAY_TOP=" + cxxrtl_name(key.entity()),
                         bits,
                         "harness.cpp",
                         "-o",
                         "shader"};
  }
  ContentHash hash;
  hash.add("outside model 1").add(*version).add(compiler->identity).add(*netlist).add(*harness);
  for (const Command* command : {&translate, &compile})
    for (const std::string& argument : command->arguments) hash.add(argument);
  const std::filesystem::path parent = std::filesystem::absolute(folders.cache) / "bench";
  const std::filesystem::path folder =
      parent / fmt::format("{}-{}-{}", verilated ? "verilator" : "cxxrtl", key.name(), hash.hex());
  const std::filesystem::path program = folder / (verilated ? "obj_dir/Vshader" : "shader");
  if (std::filesystem::exists(folder)) return OutsideModel(program, parent);

  auto fresh = TemporaryFolder::make(parent);
  if (!fresh) return fresh.error();
  if (auto written = write_file(fresh->path() / "netlist.v", *netlist); !written) return written.error();
  if (auto written = write_file(fresh->path() / "harness.cpp", *harness); !written) return written.error();
  const std::string doing = fmt::format("{} of {}", to_string(tool), key.name());
  translate.working_folder = compile.working_folder = fresh->path();
  if (auto done = run_tool(translate, verilated ? c_install_verilator : c_install_yosys, doing); !done)
    return done.error();
  if (!verilated)
    if (auto done = run_tool(compile, c_install_compiler, doing); !done) return done.error();
  if (auto moved = fresh->move_to(folder); !moved) return moved.error();
  return OutsideModel(program, parent);
}

Result<OutsideRun> OutsideModel::run(std::span<const std::uint32_t> init_words) const {
  auto scratch = TemporaryFolder::make(scratch_);
  if (!scratch) return scratch.error();
  const std::filesystem::path init = scratch->path() / "init", drawn = scratch->path() / "fragments";
  const std::string_view bytes(reinterpret_cast<const char*>(init_words.data()), init_words.size_bytes());
  if (auto written = write_file(init, bytes); !written) return written.error();
  const auto end =
      run_process({.arguments = {program_.string(), init.string(), drawn.string()}}, "make bench");
  if (!end) return end.error();
  OutsideRun run;
  unsigned long long cycles = 0;
  if (!end->succeeded() || std::sscanf(end->output.c_str(), "%lf %llu", &run.seconds, &cycles) != 2)
    return Error{ExitCode::differs, fmt::format("{}: {}: {}", program_.string(), end->how(), end->output)};
  run.cycles = cycles;
  const auto fragments = read_file(drawn);
  if (!fragments) return fragments.error();
  run.fragments.resize(fragments->size() / sizeof(Fragment));
  std::memcpy(run.fragments.data(), fragments->data(), run.fragments.size() * sizeof(Fragment));
  return run;
}

}  // namespace halfway
