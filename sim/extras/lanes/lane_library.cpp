// SPDX-License-Identifier: Apache-2.0
#include "sim/extras/lanes/lane_library.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "sim/os/file.hpp"

namespace halfway {
namespace {

// Same flags as in sim/engines/verilator/verilated_library.cpp.
const std::vector<std::string> c_verilator_flags = {
    "--xml-only",  "--flatten", "-Wno-COMBDLY", "-Wno-CASEINCOMPLETE", "--x-assign", "fast",
    "--x-initial", "fast",      "--noassert",   "--xml-output",        "netlist.xml"};
const std::vector<std::string> c_compiler_flags = {
    "-std=gnu++20",
    "-march=native",
    "-fPIC",
    "-shared",
    "-w",
    "-fvisibility=hidden",
    "-Wl,-Bsymbolic",
    "-Wl,-z,defs",
    // clang++ 14 aligns vectors on the stack only in functions with a frame pointer.
    "-fno-omit-frame-pointer",
#ifdef __x86_64__
    "-mprefer-vector-width=512",
#endif
};
// clang++ runs wasm-opt, with its own option of optimization, on what it has linked.
const std::vector<std::string> c_web_assembly_flags = {
    "--target=wasm32-wasi", "-msimd128", "-std=gnu++20", "-w", "-fno-exceptions", "-fno-threadsafe-statics",
    "-mexec-model=reactor",
    // Debian's wasi-libc contains debug information, more than the hardware's code.
    "-Wl,--strip-debug"};

/// The compiler's options for vectors that are not the widest of the processor: an older processor, because
/// clang 19 keeps AVX-512 with -mno-avx512f on processors that have AVX10.
std::vector<std::string> flags_of(LaneVectors vectors) {
#ifdef __x86_64__
  switch (vectors) {
    case LaneVectors::avx512:
      return {};
    case LaneVectors::avx2:
      if (__builtin_cpu_supports("avx2") == 0) return {};
      return {"-march=x86-64-v3"};
    case LaneVectors::sse:
      return {"-march=x86-64-v2"};
    case LaneVectors::none:
      return {"-march=x86-64", "-mno-sse"};
  }
#endif
  return {};
}

/// The sources of the generator and of the compiled text: this folder's, without tests, and the header of the
/// interface.
std::vector<std::filesystem::path> generator_sources(const std::filesystem::path& source) {
  std::vector<std::filesystem::path> files = {source / "sim/engines/verilator/harness_api.h"};
  for (const auto& file : must(files_below(source / "sim/extras/lanes")))
    if (file.extension() != ".md" && !file.string().ends_with("_test.cpp"))
      files.push_back(source / "sim/extras/lanes" / file);
  return files;
}

/// The compiler of a target and its options.
struct Toolchain {
  Compiler compiler;
  std::string install;  ///< the command that installs it
  std::vector<std::string> flags;
  std::string optimizer;  ///< version of wasm-opt; empty for a shared library
  std::string product;    ///< the compiled file's name
};

Toolchain toolchain_of(const LaneBuild& build) {
  const bool web_assembly = build.target == LaneTarget::web_assembly;
  Toolchain tools{.compiler = must(Compiler::find(web_assembly ? "clang++" : ""))};
  tools.flags = web_assembly ? c_web_assembly_flags : c_compiler_flags;
  // wasm-opt -O3 needs minutes and gigabytes for ten shading processors, and modules become no smaller.
  const char* const most = web_assembly ? "-O2" : "-O3";
  tools.flags.emplace_back(build.fast ? most : "-O1");
  tools.product = web_assembly ? "lanes.wasm" : "lanes.so";
  tools.install = web_assembly ? c_install_web_assembly : c_install_compiler;
  if (web_assembly) {
    tools.optimizer = must(ask({"wasm-opt", "--version"}, c_install_web_assembly));
  } else {
    std::ranges::copy(flags_of(build.vectors), std::back_inserter(tools.flags));
    // g++ would share inline variables between all libraries of the process.
    if (tools.compiler.program.find("clang") == std::string::npos)
      tools.flags.emplace_back("-fno-gnu-unique");
  }
  for (const std::string& definition : build.definitions) tools.flags.push_back("-D" + definition);
  return tools;
}

/// Generate the text in an empty folder.
void generate_text(const LaneBuild& build, const std::filesystem::path& folder) {
  must(write_file(folder / "netlist.v", build.netlist));
  Command verilate{.arguments = {"verilator"}, .working_folder = folder};
  verilate.arguments.insert(verilate.arguments.end(), c_verilator_flags.begin(), c_verilator_flags.end());
  // This optimization removes signals.
  if (!build.ports.observed.empty()) verilate.arguments.emplace_back("-fno-dfg");
  verilate.arguments.insert(verilate.arguments.end(), {"--top-module", build.top, "netlist.v"});
  must(run_tool(verilate, c_install_verilator, build.name));
  const auto lanes = generate_lanes(read_own_file(folder / "netlist.xml"), build.ports, build.names);
  if (!lanes) throw Failure{{lanes.error().code, build.name + ": " + lanes.error().message}};
  must(write_file(folder / "lanes.hpp", *lanes));
}

/// Compile lanes.hpp and harness.cpp, which are in the folder.
void compile(const LaneBuild& build, const Toolchain& tools, const std::filesystem::path& folder) {
  Command compile{.arguments = {tools.compiler.program}, .working_folder = folder};
  auto& arguments = compile.arguments;
  arguments.insert(arguments.end(), tools.flags.begin(), tools.flags.end());
  arguments.insert(arguments.end(), {"-I.", "-I" + std::filesystem::absolute(build.source).string(),
                                     "harness.cpp", "-o", tools.product});
  must(run_tool(compile, tools.install, build.name));
}

}  // namespace

std::filesystem::path build_lanes(const LaneBuild& build, const std::filesystem::path& cache) {
  const std::string verilator_version = must(ask({"verilator", "--version"}, c_install_verilator));
  const Toolchain tools = toolchain_of(build);
  const std::string harness = read_own_file(build.harness);

  ContentHash hash;
  hash.add("lanes 2").add(verilator_version).add(tools.compiler.identity).add(tools.optimizer);
  hash.add(build.netlist).add(build.top).add(build.names.text()).add(harness);
  for (const std::filesystem::path& file : generator_sources(build.source)) hash.add(read_own_file(file));
  for (const auto* list : {&c_verilator_flags, &tools.flags, &build.ports.outputs}) {
    hash.add(std::to_string(list->size()));
    for (const std::string& item : *list) hash.add(item);
  }
  for (const ObservedPart& part : build.ports.observed)
    hash.add(fmt::format("{} {} {}", part.path, part.low, part.bits));
  for (const auto& [port, value] : build.ports.fixed) hash.add(port).add(value ? "1" : "0");
  const std::filesystem::path folder =
      std::filesystem::absolute(cache) / "lanes" / fmt::format("{}-{}", build.name, hash.hex());
  make_once(folder, [&](const std::filesystem::path& fresh) {
    generate_text(build, fresh);
    must(write_file(fresh / "harness.cpp", harness));
    compile(build, tools, fresh);
  });
  return folder / tools.product;
}

}  // namespace halfway
