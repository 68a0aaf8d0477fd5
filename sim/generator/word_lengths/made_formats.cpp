// SPDX-License-Identifier: Apache-2.0
#include "sim/generator/word_lengths/made_formats.hpp"

#include <fmt/format.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "sim/generator/generated_files.hpp"
#include "sim/generator/word_lengths/format_sources.hpp"
#include "sim/generator/word_lengths/made_tables.hpp"
#include "sim/os/file.hpp"
#include "sim/os/shared_library.hpp"

namespace halfway {
namespace {

namespace fs = std::filesystem;

constexpr const char* c_library = "formats.so";

// The flags of CMakeLists.txt for these sources, plus position-independent code: the counted host
// instructions must be comparable. The library and the program must not share any symbol, not even an inline
// constant.
constexpr std::array c_flags = {
    "-std=gnu++20", "-O2",           "-DFMT_SHARED",        "-fPIC",
    "-shared",      "-pthread",      "-fvisibility=hidden", "-fvisibility-inlines-hidden",
    "-w",           "-Wl,-Bsymbolic"};

// The library and its functions (formats_harness.cpp).
struct MadeFormats {
  SharedLibrary library;
  Setup* (*make_setup)(const Scene&, const FrameSize&, const HardwareKey&, const SetupOptions&) = nullptr;
  GoldenModel* (*make_golden_model)(const HardwareKey&) = nullptr;
};

}  // namespace

Models made_models(const HardwareKey& key, const SimulatorFolders& folders) {
  const fs::path source = fs::absolute(folders.source);
  const std::string sources = format_sources_hash(source);
  if (sources != built_from())
    throw_bad_input(
        "{}: the program was built from other sources; word lengths other than the preset's need the "
        "same sources: run make program",
        (source / "model").lexically_normal().string());
  const bool exact = key.preset == Preset::exact;
  const tables::WordLengths& words = key.words;
  const auto headers = tables::cpp_headers(tables::compiled_sizes(), exact, words);
  const Compiler compiler = must(Compiler::find(HALFWAY_CXX));
  std::vector<std::string> flags(c_flags.begin(), c_flags.end());
  // g++ would let the program and the library share inline variables.
  if (compiler.program.find("clang") == std::string::npos) flags.emplace_back("-fno-gnu-unique");
  flags.push_back(fmt::format("-DHALFWAY_SHADER={}", static_cast<int>(key.shader)));
  flags.emplace_back(exact ? "-DHALFWAY_PRESET=Exact" : "-DHALFWAY_PRESET=Published");
  ContentHash hash;
  hash.add("formats 4").add(sources).add(compiler.identity);
  for (const tables::GeneratedFile& header : headers) hash.add(header.text);
  for (const std::string& flag : flags) hash.add(flag);

  const fs::path parent = fs::absolute(folders.cache) / "formats";
  const std::string name =
      fmt::format("{}-{}-{}-{}", to_string(key.shader), to_string(key.preset), words.name(), hash.hex());
  const fs::path folder = parent / name;
  if (!fs::exists(folder)) {
    // Compiling takes half a minute. Other points with the same formats wait for it.
    const fs::path locked = parent / (name + ".lock");
    must(make_folders(locked));
    const Descriptor lock = must(lock_folder(locked, [] {}));
    make_once(folder, [&](const fs::path& fresh) {
      must(tables::write_files(fresh, headers));
      Command compile{.arguments = {compiler.program}, .working_folder = fresh};
      compile.arguments.insert(compile.arguments.end(), flags.begin(), flags.end());
      compile.arguments.insert(compile.arguments.end(),
                               {"-I.", "-I" + (source / "model").string(), "-I" + source.string()});
      for (const std::string& file : format_sources(key.shader))
        compile.arguments.push_back((source / file).string());
      compile.arguments.insert(compile.arguments.end(), {"-o", c_library});
      must(run_tool(compile, c_install_compiler, words.name()));
    });
  }
  const auto made = std::make_shared<MadeFormats>(must(SharedLibrary::load(folder / c_library)));
  must(made->library.bind(made->make_setup, "halfway_make_setup", made->make_golden_model,
                          "halfway_make_golden_model"));
  return {
      [made](const Scene& scene, FrameSize size, const HardwareKey& of, const SetupOptions& options) {
        return std::unique_ptr<Setup>(made->make_setup(scene, size, of, options));
      },
      [made](const HardwareKey& of) { return std::unique_ptr<GoldenModel>(made->make_golden_model(of)); }};
}

}  // namespace halfway
