// SPDX-License-Identifier: Apache-2.0
#include "sim/bench/outside_model.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <cstring>
#include <string>

#include "sim/system/file.hpp"
#include "sim/system/must.hpp"
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

OutsideModel::OutsideModel(OutsideTool tool, const HardwareKey& key, const SimulatorFolders& folders,
                           bool fast)
    : scratch_(std::filesystem::absolute(folders.cache) / "bench") {
  const bool verilated = tool == OutsideTool::verilator;
  const std::string version = must(verilated ? ask({"verilator", "--version"}, c_install_verilator)
                                             : ask({"yosys", "-V"}, c_install_yosys));
  const Compiler compiler = must(Compiler::find(verilated ? "g++" : ""));
  const std::string netlist = must(netlist_of(key, folders));
  const std::string harness = must(read_file(folders.source / "sim/bench/plain_harness.cpp"));

  const std::string bits =
      fmt::format("-DHALFWAY_INIT_BITS={}", port_bits(netlist, key.entity(), "init_data"));
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
    compile.arguments = {compiler.program,
                         "-std=c++17",
                         fast ? "-O3" : "-O0",
                         "-march=native",
                         "-w",
                         "-I" + must(ask({"yosys-config", "--datdir/include"}, c_install_yosys)),
                         "-DHALFWAY_CXXRTL",
                         "-DHALFWAY_TOP=" + cxxrtl_name(key.entity()),
                         bits,
                         "harness.cpp",
                         "-o",
                         "shader"};
  }
  ContentHash hash;
  hash.add("outside model 1").add(version).add(compiler.identity).add(netlist).add(harness);
  for (const Command* command : {&translate, &compile})
    for (const std::string& argument : command->arguments) hash.add(argument);
  const char* const name = verilated ? "verilator" : "cxxrtl";
  const std::filesystem::path folder = scratch_ / fmt::format("{}-{}-{}", name, key.name(), hash.hex());
  program_ = folder / (verilated ? "obj_dir/Vshader" : "shader");
  if (std::filesystem::exists(folder)) return;

  TemporaryFolder fresh = must(TemporaryFolder::make(scratch_));
  must(write_file(fresh.path() / "netlist.v", netlist));
  must(write_file(fresh.path() / "harness.cpp", harness));
  const std::string doing = fmt::format("{} of {}", name, key.name());
  translate.working_folder = compile.working_folder = fresh.path();
  must(run_tool(translate, verilated ? c_install_verilator : c_install_yosys, doing));
  if (!verilated) must(run_tool(compile, c_install_compiler, doing));
  must(fresh.move_to(folder));
}

OutsideRun OutsideModel::run(std::span<const std::uint32_t> init_words) const {
  const TemporaryFolder scratch = must(TemporaryFolder::make(scratch_));
  const std::filesystem::path init = scratch.path() / "init", drawn = scratch.path() / "fragments";
  must(write_file(init, {reinterpret_cast<const char*>(init_words.data()), init_words.size_bytes()}));
  const ProcessEnd end =
      must(run_process({.arguments = {program_.string(), init.string(), drawn.string()}}, "make bench"));
  OutsideRun run;
  if (!end.succeeded() || std::sscanf(end.output.c_str(), "%lf", &run.seconds) != 1)
    throw Failure{{ExitCode::differs, fmt::format("{}: {}: {}", program_.string(), end.how(), end.output)}};
  const std::string fragments = must(read_file(drawn));
  run.fragments.resize(fragments.size() / sizeof(Fragment));
  std::memcpy(run.fragments.data(), fragments.data(), run.fragments.size() * sizeof(Fragment));
  return run;
}

}  // namespace halfway
