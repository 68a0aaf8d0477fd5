// SPDX-License-Identifier: Apache-2.0
// halfway_page: for scripts/evidence.sh.
//
//   halfway_page ROOT                      prints the commit that evidence is of; fails if files have changes
//   halfway_page ROOT PAGE FILE TOOL...    writes the line with commit, date, tools and machine into the
//   page's file
//   halfway_page ROOT --judge SECTION FILE COLUMN  compares the column of a page with thresholds
//   halfway_page ROOT --table PART FILE CSV...     writes tables of studies into the part of a page
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <vector>

#include "evidence/measured.hpp"
#include "evidence/study_table.hpp"
#include "sim/os/file.hpp"
#include "sim/os/program.hpp"

namespace halfway::page {
namespace {

Status write_origin(const std::filesystem::path& file, const std::string& page, const std::string& commit,
                    std::span<const std::string_view> tools) {
  const auto origin = origin_text(tools);
  if (!origin) return origin.error();
  const auto text = read_file(file);
  if (!text) return text.error();
  return write_file(file, with_origin(*text, {.page = page, .commit = commit, .text = *origin}));
}

Result<ExitCode> judge_column(const std::filesystem::path& root, const std::string& section,
                              const std::string& file, const std::string& column) {
  const auto thresholds = Thresholds::read(root);
  if (!thresholds) return thresholds.error();
  const auto text = read_file(root / file);
  if (!text) return text.error();
  std::vector<Value> values;
  for (const std::string& name : thresholds->names(section)) {
    const std::string cell = cell_of(*text, name, column);
    values.push_back({section, name, {cell.empty() ? std::nan("") : std::strtod(cell.c_str(), nullptr)}});
  }
  if (values.empty()) return bad_input("tb/evidence/thresholds.toml: has no names in [" + section + "]");
  return judged(root, values);
}

Status write_table(const std::filesystem::path& root, const std::string& part, const std::string& file,
                   std::span<const std::string> studies) {
  std::vector<Table> tables;
  for (const std::string& study : studies) {
    auto table = read_csv(root / study);
    if (!table) return table.error();
    if (table->rows.empty()) return bad_input(study + ": has no row");
    tables.push_back(std::move(*table));
  }
  return write_sections(root / file, std::vector<Section>{{part, study_table(tables)}});
}

int run(const std::vector<std::string>& arguments) {
  constexpr std::size_t c_root = 1, c_page = 3;  // numbers of arguments
  if (arguments.size() != c_root && arguments.size() < c_page)
    return cli::report(bad_input("halfway_page: give ROOT, or ROOT PAGE FILE TOOL..."));
  constexpr std::size_t c_judge = 5;
  if (arguments.size() == c_judge && arguments[1] == "--judge") {
    const auto end = judge_column(arguments[0], arguments[2], arguments[3], arguments[4]);
    return end ? static_cast<int>(*end) : cli::report(end.error());
  }
  if (arguments.size() >= c_judge && arguments[1] == "--table") {
    const Status written =
        write_table(arguments[0], arguments[2], arguments[3], std::span(arguments).subspan(c_judge - 1));
    return written ? 0 : cli::report(written.error());
  }
  const auto commit = measured_commit(arguments[0]);
  if (!commit) return cli::report(commit.error());
  if (arguments.size() == c_root) {
    fmt::print("{}\n", *commit);
    return 0;
  }
  const std::vector<std::string_view> tools(arguments.begin() + c_page, arguments.end());
  const Status written =
      write_origin(std::filesystem::path(arguments[0]) / arguments[2], arguments[1], *commit, tools);
  return written ? 0 : cli::report(written.error());
}

}  // namespace
}  // namespace halfway::page

int main(int argc, char** argv) {
  return halfway::page::run({argv + 1, argv + argc});
}
