// SPDX-License-Identifier: Apache-2.0
#include "sim/lanes/lane_library.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "sim/system/file.hpp"

namespace halfway {
namespace {

// Same flags as in sim/verilator/verilated_library.cpp.
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

/// The compiler's option for vectors that are not the widest of the processor.
std::string flag_of(LaneVectors vectors) {
#ifdef __x86_64__
  switch (vectors) {
    case LaneVectors::avx512:
      return "";
    case LaneVectors::avx2:
      return "-mno-avx512f";
    case LaneVectors::sse:
      return "-mno-avx";
    case LaneVectors::none:
      return "-mno-sse";
  }
#endif
  return "";
}

/// The sources of the generator and of the compiled text: this folder's, without tests, and the header of the
/// interface.
Result<std::vector<std::filesystem::path>> generator_sources(const std::filesystem::path& source) {
  std::vector<std::filesystem::path> files = {source / "sim/verilator/harness_api.h"};
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(source / "sim/lanes", error)) {
    const std::string name = entry.path().filename().string();
    const bool code = name.ends_with(".cpp") || name.ends_with(".hpp") || name.ends_with(".h");
    if (code && !name.ends_with("_test.cpp")) files.push_back(entry.path());
  }
  if (error) return tool_failed(fmt::format("{}: {}", (source / "sim/lanes").string(), error.message()));
  std::sort(files.begin(), files.end());
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

Result<Toolchain> toolchain_of(const LaneBuild& build) {
  const bool web_assembly = build.target == LaneTarget::web_assembly;
  const auto compiler = Compiler::find(web_assembly ? "clang++" : build.compiler);
  if (!compiler) return compiler.error();
  Toolchain tools{.compiler = *compiler};
  tools.flags = web_assembly ? c_web_assembly_flags : c_compiler_flags;
  // wasm-opt -O3 needs minutes and gigabytes for ten shading processors, and modules become no smaller.
  const char* const most = web_assembly ? "-O2" : "-O3";
  tools.flags.emplace_back(build.fast ? most : "-O1");
  tools.product = web_assembly ? "lanes.wasm" : "lanes.so";
  tools.install = web_assembly ? c_install_web_assembly : c_install_compiler;
  if (web_assembly) {
    const auto version = ask({"wasm-opt", "--version"}, c_install_web_assembly);
    if (!version) return version.error();
    tools.optimizer = *version;
  } else {
    if (const std::string vectors = flag_of(build.vectors); !vectors.empty()) tools.flags.push_back(vectors);
    // g++ would share inline variables between all libraries of the process.
    if (compiler->program.find("clang") == std::string::npos) tools.flags.emplace_back("-fno-gnu-unique");
  }
  for (const std::string& definition : build.definitions) tools.flags.push_back("-D" + definition);
  return tools;
}

/// Generate the text in an empty folder.
Status generate_text(const LaneBuild& build, const std::filesystem::path& folder) {
  if (auto written = write_file(folder / "netlist.v", build.netlist); !written) return written.error();
  Command verilate{.arguments = {"verilator"}, .working_folder = folder};
  verilate.arguments.insert(verilate.arguments.end(), c_verilator_flags.begin(), c_verilator_flags.end());
  // This optimization removes signals.
  if (!build.ports.observed.empty()) verilate.arguments.emplace_back("-fno-dfg");
  verilate.arguments.insert(verilate.arguments.end(), {"--top-module", build.top, "netlist.v"});
  if (auto done = run_tool(verilate, c_install_verilator, build.name); !done) return done.error();
  const auto xml = read_file(folder / "netlist.xml");
  if (!xml) return tool_failed(xml.error().message);
  const auto lanes = generate_lanes(*xml, build.ports, build.names);
  if (!lanes) return Error{lanes.error().code, build.name + ": " + lanes.error().message};
  return write_file(folder / "lanes.hpp", *lanes);
}

/// Compile lanes.hpp and harness.cpp, which are in the folder.
Status compile(const LaneBuild& build, const Toolchain& tools, const std::filesystem::path& folder) {
  Command compile{.arguments = {tools.compiler.program}, .working_folder = folder};
  auto& arguments = compile.arguments;
  arguments.insert(arguments.end(), tools.flags.begin(), tools.flags.end());
  arguments.insert(arguments.end(), {"-I.", "-I" + std::filesystem::absolute(build.source).string(),
                                     "harness.cpp", "-o", tools.product});
  if (auto done = run_tool(compile, tools.install, build.name); !done) return done.error();
  return Ok{};
}

}  // namespace

Result<std::filesystem::path> build_lanes(const LaneBuild& build, const std::filesystem::path& cache) {
  const auto verilator_version = ask({"verilator", "--version"}, c_install_verilator);
  if (!verilator_version) return verilator_version.error();
  const auto tools = toolchain_of(build);
  if (!tools) return tools.error();
  const auto harness = read_file(build.harness);
  if (!harness) return tool_failed(harness.error().message);

  ContentHash hash;
  hash.add("lanes 2").add(*verilator_version).add(tools->compiler.identity).add(tools->optimizer);
  hash.add(build.netlist).add(build.top).add(build.names.text()).add(*harness);
  const auto sources = generator_sources(build.source);
  if (!sources) return sources.error();
  for (const std::filesystem::path& file : *sources) {
    const auto text = read_file(file);
    if (!text) return tool_failed(text.error().message);
    hash.add(*text);
  }
  for (const auto* list : {&c_verilator_flags, &tools->flags, &build.ports.outputs}) {
    hash.add(std::to_string(list->size()));
    for (const std::string& item : *list) hash.add(item);
  }
  for (const ObservedPart& part : build.ports.observed)
    hash.add(fmt::format("{} {} {}", part.path, part.low, part.bits));
  for (const auto& [port, value] : build.ports.fixed) hash.add(port).add(value ? "1" : "0");
  const std::filesystem::path parent = std::filesystem::absolute(cache) / "lanes";
  const std::filesystem::path folder = parent / fmt::format("{}-{}", build.name, hash.hex());

  if (!std::filesystem::exists(folder)) {
    auto fresh = TemporaryFolder::make(parent);
    if (!fresh) return fresh.error();
    if (Status generated = generate_text(build, fresh->path()); !generated) return generated.error();
    if (auto written = write_file(fresh->path() / "harness.cpp", *harness); !written) return written.error();
    if (Status compiled = compile(build, *tools, fresh->path()); !compiled) return compiled.error();
    if (auto moved = fresh->move_to(folder); !moved) return moved.error();
  }
  return folder / tools->product;
}

Result<SharedLibrary> open_lanes(const LaneBuild& build, const std::filesystem::path& cache) {
  const auto library = build_lanes(build, cache);
  if (!library) return library.error();
  return SharedLibrary::load(*library);
}

}  // namespace halfway
