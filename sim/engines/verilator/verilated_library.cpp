// SPDX-License-Identifier: Apache-2.0
#include "sim/engines/verilator/verilated_library.hpp"

#include <fmt/format.h>

#include <future>
#include <utility>

#include "sim/os/file.hpp"

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

std::vector<std::string> generated_sources(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& file : must(files_below(folder, ".cpp")))
    if (file.string().find("__ALL") == std::string::npos) names.push_back(file.string());
  if (names.empty()) throw_tool_failed("{}: Verilator wrote no C++ here", folder.string());
  return names;
}

struct Verilator {
  std::string version, root;
};

// Asked once per process, in parallel, because each question takes a tenth of a second.
const Verilator& installed_verilator() {
  static const Verilator found = [] {
    auto root = std::async(std::launch::async, ask,
                           std::vector<std::string>{"verilator", "--getenv", "VERILATOR_ROOT"},
                           std::string(c_install_verilator));
    std::string version = must(ask({"verilator", "--version"}, c_install_verilator));
    return Verilator{std::move(version), must(root.get())};
  }();
  return found;
}

/// Verilator's runtime and header, built once for all libraries. For a small shader they are most of the code
/// to compile and to read.
struct Runtime {
  std::filesystem::path object;
  std::filesystem::path header;  ///< precompiled header, for clang++ only
};

Runtime runtime_of(const std::filesystem::path& parent, const std::string& key, const std::string& compiler,
                   const std::string& headers, const std::vector<std::string>& flags) {
  const std::filesystem::path folder = parent / ("runtime-" + key);
  const Runtime runtime{folder / "runtime.o", folder / "verilated.pch"};
  make_once(folder, [&](const std::filesystem::path& fresh) {
    must(write_file(fresh / "runtime.cpp",
                    "#include \"verilated.cpp\"\n#include \"verilated_threads.cpp\"\n"));
    Command compile{.arguments = {compiler}, .working_folder = fresh};
    compile.arguments.insert(compile.arguments.end(), flags.begin(), flags.end());
    compile.arguments.emplace_back("-O1");
    Command precompile = compile;
    compile.arguments.insert(compile.arguments.end(), {"-c", "runtime.cpp", "-o", "runtime.o"});
    must(run_tool(compile, c_install_compiler, "Verilator's runtime"));
    if (compiler.find("clang") == std::string::npos) return;
    precompile.arguments.insert(precompile.arguments.end(), {"-x", "c++-header", headers + "/verilated.h",
                                                             "-o", runtime.header.filename().string()});
    must(run_tool(precompile, c_install_compiler, "Verilator's header"));
  });
  return runtime;
}

}  // namespace

Result<SharedLibrary> open_verilated(const VerilatedBuild& build, const std::filesystem::path& cache) try {
  const auto& [verilator_version, verilator_root] = installed_verilator();
  const Compiler compiler = must(Compiler::find(build.compiler));
  const std::string harness = read_own_file(build.harness);

  std::vector<std::string> flags = c_compiler_flags;
  // g++ would share inline variables between all libraries of the process.
  if (compiler.program.find("clang") == std::string::npos) flags.emplace_back("-fno-gnu-unique");
  flags.emplace_back(build.waves ? "-DVM_TRACE=1" : "-DVM_TRACE=0");
  if (build.waves) flags.insert(flags.end(), {"-DVM_TRACE_FST=1", "-DHALFWAY_WAVES=1"});
  flags.insert(flags.end(), {"-I" + verilator_root + "/include", "-I" + verilator_root + "/include/vltstd"});

  std::vector<std::string> verilator_flags = c_verilator_flags;
  verilator_flags.insert(verilator_flags.end(), build.verilator_flags.begin(), build.verilator_flags.end());
  const std::string level = optimization(build.fast ? "-O3" : "-O1");
  ContentHash tools;
  tools.add("verilated library 3").add(verilator_version).add(verilator_root).add(compiler.identity);
  for (const std::string& flag : flags) tools.add(flag);
  ContentHash hash;
  hash.add(tools.hex()).add(build.netlist).add(build.top).add(harness).add(level);
  for (const auto& header : build.harness_headers) hash.add(read_own_file(header));
  for (const auto* list : {&std::as_const(verilator_flags), &c_link_flags, &build.definitions}) {
    hash.add(std::to_string(list->size()));
    for (const std::string& flag : *list) hash.add(flag);
  }
  const std::filesystem::path parent = std::filesystem::absolute(cache) / "verilator";
  const std::filesystem::path folder = parent / fmt::format("{}-{}", build.name, hash.hex());

  make_once(folder, [&](const std::filesystem::path& fresh) {
    const Runtime runtime =
        runtime_of(parent, tools.hex(), compiler.program, verilator_root + "/include", flags);
    must(write_file(fresh / "netlist.v", build.netlist));
    Command verilate{.arguments = {"verilator"}, .working_folder = fresh};
    verilate.arguments.insert(verilate.arguments.end(), verilator_flags.begin(), verilator_flags.end());
    verilate.arguments.insert(verilate.arguments.end(), {"--top-module", build.top, "--Mdir", "verilated"});
    if (build.waves) verilate.arguments.emplace_back("--trace-fst");
    verilate.arguments.emplace_back("netlist.v");
    must(run_tool(verilate, c_install_verilator, build.name));

    // The trace's templates must be specialized before their first use.
    std::string unity = build.waves ? "#include \"verilated_fst_c.cpp\"\n" : "";
    for (const std::string& source : generated_sources(fresh / "verilated"))
      unity += fmt::format("#include \"verilated/{}\"\n", source);
    // The harness calls functions of the model, so it must follow the model.
    unity += "#include \"harness.cpp\"\n";
    must(write_file(fresh / "unity.cpp", unity));
    must(write_file(fresh / "harness.cpp", harness));

    Command compile{.arguments = {compiler.program}, .working_folder = fresh};
    auto& arguments = compile.arguments;
    arguments.insert(arguments.end(), flags.begin(), flags.end());
    arguments.emplace_back(level);
    for (const std::string& definition : build.definitions) arguments.push_back("-D" + definition);
    arguments.insert(arguments.end(),
                     {"-I" + std::filesystem::absolute(build.include_folder).string(), "-Iverilated",
                      "unity.cpp", runtime.object.string(), "-o", c_library_name});
    arguments.insert(arguments.end(), c_link_flags.begin(), c_link_flags.end());
    if (build.waves) arguments.emplace_back("-lz");
    if (std::filesystem::exists(runtime.header)) {
      // clang++ refuses a precompiled header whose sources have changed.
      Command quick = compile;
      quick.arguments.insert(quick.arguments.end(), {"-include-pch", runtime.header.string()});
      if (run_tool(quick, c_install_compiler, build.name)) return;
    }
    must(run_tool(compile, c_install_compiler, build.name));
  });
  return SharedLibrary::load(folder / c_library_name);
} catch (const Failure& failure) {
  return failure.error;
}

}  // namespace halfway
