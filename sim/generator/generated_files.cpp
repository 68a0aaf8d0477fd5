// SPDX-License-Identifier: Apache-2.0
#include "sim/generator/generated_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "sim/generator/core_registers.hpp"
#include "sim/os/file.hpp"
#include "sim/os/must.hpp"
#include "sim/os/page_part.hpp"
#include "words/generator/formats.hpp"
#include "words/generator/functions.hpp"
#include "words/generator/layout_page.hpp"

namespace halfway::tables {
namespace {

constexpr const char* c_registers = "rtl/core/core_registers.toml";

// Adds a page of the checkout with these parts written again. A copy of the sources has no pages.
void add_page(std::vector<GeneratedFile>& files, const std::filesystem::path& checkout, const char* path,
              const std::vector<std::pair<std::string, std::string>>& parts, const std::string& source) {
  auto page = read_file(checkout / path);
  if (!page) return;
  for (const auto& [part, table] : parts) {
    page = with_page_part(*page, part, table);
    if (!page) throw_bad_input("{}: {}", path, page.error().message);
  }
  files.push_back({path, *page, source});
}

// The core file of FuseSoC (CAPI2): the RTL for other designs. `files`: the text of rtl/files.f.
std::string core_text(const std::string& files) {
  std::string text = fmt::format(
      "CAPI=2:\n"
      "# SPDX-License-Identifier: Apache-2.0\n"
      "# For FuseSoC. Made by `make tables` from rtl/files.f: change that file.\n"
      "name: ::halfway:{}\n"
      "description: Shading hardware between Gouraud and Phong, with AXI4-Stream ports or as a core with "
      "AXI4\n\n"
      "filesets:\n"
      "  rtl:\n"
      "    file_type: vhdlSource-2008\n"
      "    logical_name: halfway\n"
      "    files:\n",
      HALFWAY_VERSION);
  std::istringstream lines(files);
  for (std::string line; std::getline(lines, line);)
    if (!line.empty() && line.front() != '#') text += fmt::format("      - rtl/{}\n", line);
  return text +
         "\ntargets:\n"
         "  default:\n"
         "    filesets: [rtl]\n"
         "  # Analyses all files in their order and elaborates the core, which contains words_to_fragments.\n"
         "  check:\n"
         "    default_tool: ghdl\n"
         "    filesets: [rtl]\n"
         "    toplevel: halfway.halfway_core\n";
}

}  // namespace

std::vector<GeneratedFile> generated_files(const std::filesystem::path& checkout, const CosineSizes& sizes) {
  const auto presets = preset_formats();
  std::vector<GeneratedFile> files = {{"rtl/tables/formats_pkg.vhd", vhdl_package(presets)},
                                      {"rtl/tables/cosine_pkg.vhd", cosine_vhdl_package(sizes)},
                                      {"rtl/tables/function_pkg.vhd", function_vhdl_package()}};
  add_page(files, checkout, "docs/rtl/init-vectors.md", layout_tables(presets), "model/words/generator");
  if (const auto list = read_file(checkout / "rtl/files.f"))
    files.push_back({"halfway.core", core_text(*list), "rtl/files.f"});
  if (const auto toml = read_file(checkout / c_registers)) {
    const CoreRegisters core = core_registers(*toml, c_registers);
    files.push_back({"rtl/core/core_registers_pkg.vhd", core_registers_vhdl(core), c_registers});
    add_page(files, checkout, "docs/rtl/core.md",
             {{"registers", register_table(core)}, {"command", command_table(core)}}, c_registers);
  }
  return files;
}

std::vector<GeneratedFile> cpp_headers(const CosineSizes& sizes, bool exact, const WordLengths& words) {
  return {{"words/formats.hpp", cpp_header(preset_formats(exact, words))},
          {"words/cosine_tables.hpp", cosine_cpp_header(sizes)},
          {"words/function_tables.hpp", function_cpp_header(function_tables(exact, words))}};
}

GeneratedFile registers_header(const std::filesystem::path& checkout) {
  const std::string toml = must(read_file(checkout / c_registers));
  return {"sim/extras/library/halfway_core_registers.h",
          core_registers_header(core_registers(toml, c_registers))};
}

Status write_files(const std::filesystem::path& folder, const std::vector<GeneratedFile>& files) {
  for (const GeneratedFile& file : files) {
    const std::filesystem::path path = folder / file.path;
    if (const auto present = read_file(path); present && *present == file.text) continue;
    if (Status made = make_folders(path.parent_path()); !made) return made;
    if (Status written = write_file(path, file.text); !written) return written;
  }
  return Ok{};
}

CosineSizes sizes_of(const std::filesystem::path& checkout) {
  const auto package = read_file(checkout / "rtl/tables/cosine_pkg.vhd");
  const CosineSizes sizes = package ? cosine_sizes_in(*package) : CosineSizes{};
  return sizes.exact.empty() || sizes.published.empty() ? CosineSizes{} : sizes;
}

std::size_t first_different_line(const std::filesystem::path& checkout, const GeneratedFile& file) {
  const Result<std::string> present = read_file(checkout / file.path);
  if (!present) return 1;
  if (*present == file.text) return 0;
  const auto [here, there] = std::ranges::mismatch(*present, file.text);
  return 1 + static_cast<std::size_t>(std::count(present->begin(), here, '\n'));
}

std::vector<std::string> stale_files(const std::filesystem::path& checkout, const CosineSizes& sizes,
                                     bool all) {
  std::vector<std::string> messages;
  for (const GeneratedFile& file : generated_files(checkout, sizes)) {
    const std::filesystem::path kind = file.path.extension();
    if (!all && (kind == ".md" || kind == ".core")) continue;
    if (const std::size_t line = first_different_line(checkout, file); line != 0)
      messages.push_back(fmt::format("{}:{}: not what the generator writes; edit {}, then run `make tables`",
                                     file.path.string(), line, file.source));
  }
  return messages;
}

}  // namespace halfway::tables
