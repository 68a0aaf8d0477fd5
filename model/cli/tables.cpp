// SPDX-License-Identifier: Apache-2.0
// `halfway tables`: writes what is generated, or checks that it is as it would be written.
#include <fmt/format.h>

#include "cli/options.hpp"
#include "common/file.hpp"
#include "tables/formats.hpp"

namespace halfway::cli {
namespace {

struct GeneratedFile {
  std::filesystem::path path;  ///< from the checkout's root
  std::string text;
};

std::vector<GeneratedFile> generated_files() {
  const auto presets = tables::preset_formats();
  return {{"rtl/tables/formats_pkg.vhd", tables::vhdl_package(presets)},
          {"model/golden/formats.hpp", tables::cpp_header(presets)}};
}

int run(const Folders& folders, bool check) {
  bool differs = false;
  for (const GeneratedFile& file : generated_files()) {
    const std::filesystem::path path = folders.source / file.path;
    const Result<std::string> present = read_file(path);
    if (present && *present == file.text) {
      fmt::print("{}: as generated\n", file.path.string());
      continue;
    }
    if (check) {
      std::size_t line = 1;
      if (present)
        for (std::size_t i = 0;
             i < std::min(present->size(), file.text.size()) && (*present)[i] == file.text[i]; ++i)
          line += file.text[i] == '\n';
      fmt::print(stderr, "{}:{}: not what the generator writes; edit model/tables, then run `make tables`\n",
                 file.path.string(), line);
      differs = true;
      continue;
    }
    if (const Status status = write_file(path, file.text); !status) return report(status.error());
    fmt::print("{}: written\n", file.path.string());
  }
  return static_cast<int>(differs ? ExitCode::differs : ExitCode::equal);
}

}  // namespace

void add_tables(CLI::App& app, const Folders& folders, int& exit_code) {
  CLI::App* command = app.add_subcommand("tables", "write the generated VHDL and C++ (formats) anew");
  auto check = std::make_shared<bool>(false);
  command->add_flag("--check", *check, "write nothing; exit 1 if a file is not as it would be written");
  command->callback([=, &folders, &exit_code] { exit_code = run(folders, *check); });
}

}  // namespace halfway::cli
