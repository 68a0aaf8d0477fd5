// SPDX-License-Identifier: Apache-2.0
#include "sim/lanes/lane_library.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "sim/system/file.hpp"

namespace halfway {
namespace {

constexpr const char* c_library_name = "lanes.so";
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

/// The sources of the generated library: this folder's, without tests, and the header of the interface.
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

}  // namespace

Result<SharedLibrary> open_lanes(const LaneBuild& build, const std::filesystem::path& cache) {
  const auto verilator_version = ask({"verilator", "--version"}, c_install_verilator);
  if (!verilator_version) return verilator_version.error();
  const auto compiler = Compiler::find(build.compiler);
  if (!compiler) return compiler.error();
  const auto harness = read_file(build.harness);
  if (!harness) return tool_failed(harness.error().message);

  const std::string vectors = flag_of(build.vectors);
  ContentHash hash;
  hash.add("lanes 1").add(*verilator_version).add(compiler->identity).add(build.netlist).add(build.top);
  hash.add(*harness).add(build.fast ? "-O3" : "-O1").add(vectors);
  const auto sources = generator_sources(build.source);
  if (!sources) return sources.error();
  for (const std::filesystem::path& file : *sources) {
    const auto text = read_file(file);
    if (!text) return tool_failed(text.error().message);
    hash.add(*text);
  }
  for (const auto* list : {&c_verilator_flags, &c_compiler_flags, &build.definitions, &build.ports.outputs}) {
    hash.add(std::to_string(list->size()));
    for (const std::string& item : *list) hash.add(item);
  }
  for (const auto& [port, value] : build.ports.fixed) hash.add(port).add(value ? "1" : "0");
  const std::filesystem::path parent = std::filesystem::absolute(cache) / "lanes";
  const std::filesystem::path folder = parent / fmt::format("{}-{}", build.name, hash.hex());

  if (!std::filesystem::exists(folder)) {
    auto fresh = TemporaryFolder::make(parent);
    if (!fresh) return fresh.error();
    if (auto written = write_file(fresh->path() / "netlist.v", build.netlist); !written)
      return written.error();
    Command verilate{.arguments = {"verilator"}, .working_folder = fresh->path()};
    verilate.arguments.insert(verilate.arguments.end(), c_verilator_flags.begin(), c_verilator_flags.end());
    verilate.arguments.insert(verilate.arguments.end(), {"--top-module", build.top, "netlist.v"});
    if (auto done = run_tool(verilate, c_install_verilator, build.name); !done) return done.error();
    const auto xml = read_file(fresh->path() / "netlist.xml");
    if (!xml) return tool_failed(xml.error().message);
    const auto lanes = generate_lanes(*xml, build.ports);
    if (!lanes) return Error{lanes.error().code, build.name + ": " + lanes.error().message};
    if (auto written = write_file(fresh->path() / "lanes.hpp", *lanes); !written) return written.error();
    if (auto written = write_file(fresh->path() / "harness.cpp", *harness); !written) return written.error();

    Command compile{.arguments = {compiler->program}, .working_folder = fresh->path()};
    auto& arguments = compile.arguments;
    arguments.insert(arguments.end(), c_compiler_flags.begin(), c_compiler_flags.end());
    arguments.emplace_back(build.fast ? "-O3" : "-O1");
    if (!vectors.empty()) arguments.push_back(vectors);
    // g++ would share inline variables between all libraries of the process.
    if (compiler->program.find("clang") == std::string::npos) arguments.emplace_back("-fno-gnu-unique");
    for (const std::string& definition : build.definitions) arguments.push_back("-D" + definition);
    arguments.insert(arguments.end(), {"-I" + std::filesystem::absolute(build.source).string(), "harness.cpp",
                                       "-o", c_library_name});
    if (auto done = run_tool(compile, c_install_compiler, build.name); !done) return done.error();
    if (auto moved = fresh->move_to(folder); !moved) return moved.error();
  }
  return SharedLibrary::load(folder / c_library_name);
}

}  // namespace halfway
