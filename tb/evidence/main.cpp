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
#include "sim/os/command_line.hpp"
#include "sim/os/file.hpp"
#include "sim/os/must.hpp"

namespace halfway::page {
namespace {

ExitCode judge_column(const std::filesystem::path& root, const std::string& section, const std::string& file,
                      const std::string& column) {
  const std::string text = must(read_file(root / file));
  std::vector<Value> values;
  for (const std::string& name : Thresholds::read(root).names(section)) {
    const std::string cell = cell_of(text, name, column);
    values.push_back({section, name, {cell.empty() ? std::nan("") : std::strtod(cell.c_str(), nullptr)}});
  }
  if (values.empty())
    throw Failure{bad_input("tb/evidence/thresholds.toml: has no names in [" + section + "]")};
  return judged(root, values);
}

void write_table(const std::filesystem::path& root, const std::string& part, const std::string& file,
                 std::span<const std::string> studies) {
  std::vector<Table> tables;
  for (const std::string& study : studies) {
    tables.push_back(must(read_csv(root / study)));
    if (tables.back().rows.empty()) throw Failure{bad_input(study + ": has no row")};
  }
  must(write_sections(root / file, std::vector<Section>{{part, study_table(tables)}}));
}

ExitCode run(const std::vector<std::string>& arguments) {
  constexpr std::size_t c_root = 1, c_page = 3;  // numbers of arguments
  if (arguments.size() != c_root && arguments.size() < c_page)
    throw Failure{bad_input("halfway_page: give ROOT, or ROOT PAGE FILE TOOL...")};
  constexpr std::size_t c_judge = 5;
  if (arguments.size() == c_judge && arguments[1] == "--judge")
    return judge_column(arguments[0], arguments[2], arguments[3], arguments[4]);
  if (arguments.size() >= c_judge && arguments[1] == "--table") {
    write_table(arguments[0], arguments[2], arguments[3], std::span(arguments).subspan(c_judge - 1));
    return ExitCode::equal;
  }
  const std::string commit = measured_commit(arguments[0]);
  if (arguments.size() == c_root) {
    fmt::print("{}\n", commit);
    return ExitCode::equal;
  }
  const std::filesystem::path file = std::filesystem::path(arguments[0]) / arguments[2];
  const std::vector<std::string_view> tools(arguments.begin() + c_page, arguments.end());
  must(write_file(file, with_origin(must(read_file(file)), {arguments[1], commit, origin_text(tools)})));
  return ExitCode::equal;
}

}  // namespace
}  // namespace halfway::page

int main(int argc, char** argv) {
  using namespace halfway;
  const auto end = caught([&] { return page::run({argv + 1, argv + argc}); });
  return end ? static_cast<int>(*end) : cli::report(end.error());
}
