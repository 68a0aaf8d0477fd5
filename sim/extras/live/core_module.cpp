// SPDX-License-Identifier: Apache-2.0
#include "sim/extras/live/core_module.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "sim/generator/generated_files.hpp"
#include "sim/generator/word_lengths/made_tables.hpp"
#include "sim/os/file.hpp"
#include "sim/os/must.hpp"
#include "sim/os/shared_library.hpp"
#include "sim/os/subprocess.hpp"
#include "sim/os/threads.hpp"

namespace halfway {
namespace {

namespace fs = std::filesystem;

constexpr const char* c_module_name = "core.wasm";

// Folders whose headers these sources include.
const std::vector<std::string> c_header_folders = {"model", "sim/driver", "sim/extras/live_core",
                                                   "sim/engines/verilator"};
// Headers of libraries: linked into a folder of their own, because the other headers of /usr/include are
// those of another system.
const std::vector<std::string> c_libraries = {"fmt", "glm", "nlohmann", "toml++"};

// WebAssembly has no fused multiply-add, so set-up and golden model compute as the program's do. Vectors are
// not used: clang++ 14 with -O2 -msimd128 compiles the golden model of the quadratic shader wrongly.
const std::vector<std::string> c_flags = {"--target=wasm32-wasi",
                                          "-std=gnu++20",
                                          "-O2",
                                          "-w",
                                          "-fno-exceptions",
                                          "-fno-threadsafe-statics",
                                          "-ffunction-sections",
                                          "-fdata-sections",
                                          "-DFMT_HEADER_ONLY=1"};
// Without an option of optimization clang++ does not run wasm-opt, which would make the module 4 % smaller.
const std::vector<std::string> c_link_flags = {"--target=wasm32-wasi", "-mexec-model=reactor",
                                               "-fno-exceptions", "-Wl,--gc-sections", "-Wl,--strip-all"};

bool is_source(const fs::path& file) {
  return file.extension() == ".cpp" && !file.filename().string().ends_with("_test.cpp");
}

/// Paths of all sources of core_sources.txt, relative to the project's root.
std::vector<std::string> sources_of(const fs::path& root) {
  std::vector<std::string> sources;
  std::istringstream lines(must(read_file(root / "sim/extras/live/core_sources.txt")));
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with('#')) continue;
    if (line.ends_with(".cpp")) {
      sources.push_back(line);
      continue;
    }
    for (const fs::path& file : must(files_below(root / line, ".cpp")))
      if (is_source(file)) sources.push_back((line / file).string());
  }
  std::sort(sources.begin(), sources.end());
  return sources;
}

/// What the module depends on.
std::string hash_of(const fs::path& root, const std::vector<std::string>& sources,
                    const std::vector<tables::GeneratedFile>& generated,
                    const std::vector<std::string>& tools) {
  std::vector<std::string> files = sources;
  for (const std::string& folder : c_header_folders)
    for (const char* ending : {".hpp", ".h"})
      for (const fs::path& header : must(files_below(root / folder, ending)))
        files.push_back((folder / header).string());
  ContentHash hash;
  hash.add("core 2");
  for (const auto* list : {&tools, &c_flags, &c_link_flags}) {
    hash.add(std::to_string(list->size()));
    for (const std::string& item : *list) hash.add(item);
  }
  for (const tables::GeneratedFile& header : generated) hash.add(header.text);
  for (const std::string& file : files) hash.add(file).add(must(read_file(root / file)));
  return hash.hex();
}

void link_libraries(const fs::path& folder) {
  must(make_folders(folder));
  for (const std::string& library : c_libraries) {
    std::error_code fault;
    fs::create_directory_symlink(fs::path("/usr/include") / library, folder / library, fault);
    if (fault) throw_tool_failed("{}: {}", (folder / library).string(), fault.message());
  }
}

/// The sources of each folder in one file: most of a compilation is the headers.
std::vector<std::string> units_of(const fs::path& root, const std::vector<std::string>& sources) {
  std::map<fs::path, std::string> units;
  for (const std::string& source : sources)
    units[fs::path(source).parent_path()] += fmt::format("#include \"{}\"\n", (root / source).string());
  std::vector<std::string> texts;
  for (const auto& [folder, text] : units) texts.push_back(text);
  return texts;
}

/// Compile the sources in the folder, several files at a time, and link them.
void compile(const Compiler& compiler, const fs::path& root, const std::vector<std::string>& sources,
             const std::vector<tables::GeneratedFile>& generated, const fs::path& folder) {
  link_libraries(folder / "include");
  must(tables::write_files(folder / "include", generated));
  const auto run = [&](const std::vector<std::string>& flags, const std::vector<std::string>& arguments) {
    Command command{.arguments = {compiler.program}, .working_folder = folder};
    command.arguments.insert(command.arguments.end(), flags.begin(), flags.end());
    command.arguments.insert(command.arguments.end(), arguments.begin(), arguments.end());
    must(run_tool(command, c_install_web_assembly, "core of the page"));
  };
  std::vector<std::string> flags = c_flags;
  flags.insert(flags.end(),
               {"-I" + (root / "model").string(), "-I" + root.string(), "-isystem", "include", "-c"});
  const std::vector<std::string> units = units_of(root, sources);
  const auto name = [](std::size_t i, const char* ending) { return fmt::format("{}.{}", i, ending); };
  must_for_each(std::max(1U, std::thread::hardware_concurrency()), units.size(), [&](std::size_t i) {
    must(write_file(folder / name(i, "cpp"), units[i]));
    run(flags, {name(i, "cpp"), "-o", name(i, "o")});
  });
  std::vector<std::string> objects;
  for (std::size_t i = 0; i < units.size(); ++i) objects.push_back(name(i, "o"));
  objects.insert(objects.end(), {"-o", c_module_name});
  run(c_link_flags, objects);
  std::error_code ignored;
  for (std::size_t i = 0; i < units.size(); ++i)
    for (const char* ending : {"cpp", "o"}) fs::remove(folder / name(i, ending), ignored);
}

}  // namespace

fs::path build_core_module(const SimulatorFolders& folders) {
  const Compiler compiler = must(Compiler::find("clang++"));
  const fs::path root = fs::absolute(folders.source);
  const std::vector<std::string> sources = sources_of(root);
  const auto generated = tables::cpp_headers(tables::compiled_sizes());
  const fs::path folder = fs::absolute(folders.cache) / "live" /
                          ("core-" + hash_of(root, sources, generated, {compiler.identity}));
  make_once(folder, [&](const fs::path& fresh) { compile(compiler, root, sources, generated, fresh); });
  return folder / c_module_name;
}

}  // namespace halfway
