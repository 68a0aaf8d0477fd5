// SPDX-License-Identifier: Apache-2.0
#include "sim/verilator/verilated_library.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <future>

#include "sim/system/file.hpp"

namespace halfway {
namespace {

constexpr const char* c_library_name = "shader.so";

// Every warning is an error, with these exceptions. COMBDLY and CASEINCOMPLETE are caused by GHDL's output of
// state machines. UNOPTFLAT reports that parts of a vector depend on one another, such as the copies of a
// grey colour. Verilator then evaluates it more than once, which only costs time.
const std::vector<std::string> c_verilator_flags = {
    "--cc",          "--prefix",   "Vshader", "--x-assign", "fast",         "--x-initial",
    "fast",          "--noassert", "-O3",     "--flatten",  "-Wno-COMBDLY", "-Wno-CASEINCOMPLETE",
    "-Wno-UNOPTFLAT"};
const std::vector<std::string> c_compiler_flags = {
    "-std=gnu++20", "-march=native",       "-fPIC",           "-pthread",
    "-w",           "-fvisibility=hidden", "-DVM_COVERAGE=0", "-DVM_SC=0"};
const std::vector<std::string> c_link_flags = {"-shared", "-Wl,-Bsymbolic", "-Wl,-z,defs", "-latomic"};

Result<std::vector<std::string>> generated_sources(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    if (name.ends_with(".cpp") && name.find("__ALL") == std::string::npos) names.push_back(name);
  }
  if (error || names.empty()) return tool_failed(folder.string() + ": Verilator wrote no C++ here");
  std::sort(names.begin(), names.end());
  return names;
}

/// Verilator's runtime and header, built once for all libraries. For a small shader they are most of the code
/// to compile and to read.
struct Runtime {
  std::filesystem::path object;
  std::filesystem::path header;  ///< precompiled header, for clang++ only
};

Result<Runtime> runtime_of(const std::filesystem::path& parent, const std::string& key,
                           const std::string& compiler, const std::string& headers,
                           const std::vector<std::string>& flags) {
  const std::filesystem::path folder = parent / ("runtime-" + key);
  const Runtime runtime{folder / "runtime.o", folder / "verilated.pch"};
  if (std::filesystem::exists(folder)) return runtime;
  auto fresh = TemporaryFolder::make(parent);
  if (!fresh) return fresh.error();
  const std::string source = "#include \"verilated.cpp\"\n#include \"verilated_threads.cpp\"\n";
  if (auto written = write_file(fresh->path() / "runtime.cpp", source); !written) return written.error();
  Command compile{.arguments = {compiler}, .working_folder = fresh->path()};
  compile.arguments.insert(compile.arguments.end(), flags.begin(), flags.end());
  compile.arguments.emplace_back("-O1");
  Command precompile = compile;
  compile.arguments.insert(compile.arguments.end(), {"-c", "runtime.cpp", "-o", "runtime.o"});
  if (auto done = run_tool(compile, c_install_compiler, "Verilator's runtime"); !done) return done.error();
  if (compiler.find("clang") != std::string::npos) {
    precompile.arguments.insert(precompile.arguments.end(), {"-x", "c++-header", headers + "/verilated.h",
                                                             "-o", runtime.header.filename().string()});
    if (auto done = run_tool(precompile, c_install_compiler, "Verilator's header"); !done)
      return done.error();
  }
  if (auto moved = fresh->move_to(folder); !moved) return moved.error();
  return runtime;
}

}  // namespace

Result<SharedLibrary> open_verilated(const VerilatedBuild& build, const std::filesystem::path& cache) {
  // Run these in parallel, because each takes long to start.
  auto asked_root =
      std::async(std::launch::async, ask, std::vector<std::string>{"verilator", "--getenv", "VERILATOR_ROOT"},
                 std::string(c_install_verilator));
  auto asked_compiler = std::async(std::launch::async, Compiler::find, build.compiler);
  const auto verilator_version = ask({"verilator", "--version"}, c_install_verilator);
  const auto verilator_root = asked_root.get();
  const auto compiler = asked_compiler.get();
  if (!verilator_version) return verilator_version.error();
  if (!verilator_root) return verilator_root.error();
  if (!compiler) return compiler.error();
  const auto harness = read_file(build.harness);
  if (!harness) return tool_failed(harness.error().message);

  std::vector<std::string> flags = c_compiler_flags;
  // g++ would share inline variables between all libraries of the process.
  if (compiler->program.find("clang") == std::string::npos) flags.emplace_back("-fno-gnu-unique");
  flags.emplace_back(build.waves ? "-DVM_TRACE=1" : "-DVM_TRACE=0");
  if (build.waves) flags.insert(flags.end(), {"-DVM_TRACE_FST=1", "-DHALFWAY_WAVES=1"});
  flags.insert(flags.end(),
               {"-I" + *verilator_root + "/include", "-I" + *verilator_root + "/include/vltstd"});

  const char* const level = build.fast && std::getenv("HALFWAY_QUICK_BUILDS") == nullptr ? "-O3" : "-O1";
  ContentHash tools;
  tools.add("verilated library 3").add(*verilator_version).add(*verilator_root).add(compiler->identity);
  for (const std::string& flag : flags) tools.add(flag);
  ContentHash hash;
  hash.add(tools.hex()).add(build.netlist).add(build.top).add(*harness).add(level);
  for (const auto& header : build.harness_headers) {
    const auto text = read_file(header);
    if (!text) return tool_failed(text.error().message);
    hash.add(*text);
  }
  for (const auto* list : {&c_verilator_flags, &c_link_flags, &build.definitions}) {
    hash.add(std::to_string(list->size()));
    for (const std::string& flag : *list) hash.add(flag);
  }
  const std::filesystem::path parent = std::filesystem::absolute(cache) / "verilator";
  const std::filesystem::path folder = parent / fmt::format("{}-{}", build.name, hash.hex());

  if (!std::filesystem::exists(folder)) {
    const auto runtime =
        runtime_of(parent, tools.hex(), compiler->program, *verilator_root + "/include", flags);
    if (!runtime) return runtime.error();
    auto fresh = TemporaryFolder::make(parent);
    if (!fresh) return fresh.error();
    if (auto written = write_file(fresh->path() / "netlist.v", build.netlist); !written)
      return written.error();

    Command verilate{.arguments = {"verilator"}, .working_folder = fresh->path()};
    verilate.arguments.insert(verilate.arguments.end(), c_verilator_flags.begin(), c_verilator_flags.end());
    verilate.arguments.insert(verilate.arguments.end(), {"--top-module", build.top, "--Mdir", "verilated"});
    if (build.waves) verilate.arguments.emplace_back("--trace-fst");
    verilate.arguments.emplace_back("netlist.v");
    if (auto done = run_tool(verilate, c_install_verilator, build.name); !done) return done.error();

    const auto sources = generated_sources(fresh->path() / "verilated");
    if (!sources) return sources.error();
    // The trace's templates must be specialized before their first use.
    std::string unity = build.waves ? "#include \"verilated_fst_c.cpp\"\n" : "";
    for (const std::string& source : *sources) unity += fmt::format("#include \"verilated/{}\"\n", source);
    // The harness calls functions of the model, so it must follow the model.
    unity += "#include \"harness.cpp\"\n";
    if (auto written = write_file(fresh->path() / "unity.cpp", unity); !written) return written.error();
    if (auto written = write_file(fresh->path() / "harness.cpp", *harness); !written) return written.error();

    Command compile{.arguments = {compiler->program}, .working_folder = fresh->path()};
    auto& arguments = compile.arguments;
    arguments.insert(arguments.end(), flags.begin(), flags.end());
    arguments.emplace_back(level);
    for (const std::string& definition : build.definitions) arguments.push_back("-D" + definition);
    arguments.insert(
        arguments.end(),
        {"-I" + std::filesystem::absolute(build.include_folder).string(), "-Iverilated", "unity.cpp",
         std::filesystem::absolute(runtime->object).string(), "-o", c_library_name});
    arguments.insert(arguments.end(), c_link_flags.begin(), c_link_flags.end());
    if (build.waves) arguments.emplace_back("-lz");
    bool compiled = false;
    if (std::filesystem::exists(runtime->header)) {
      // clang++ refuses a precompiled header whose sources have changed.
      Command quick = compile;
      quick.arguments.insert(quick.arguments.end(), {"-include-pch", runtime->header.string()});
      compiled = static_cast<bool>(run_tool(quick, c_install_compiler, build.name));
    }
    if (!compiled)
      if (auto done = run_tool(compile, c_install_compiler, build.name); !done) return done.error();
    if (auto moved = fresh->move_to(folder); !moved) return moved.error();
  }

  return SharedLibrary::load(folder / c_library_name);
}

}  // namespace halfway
