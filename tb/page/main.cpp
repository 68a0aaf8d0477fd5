// SPDX-License-Identifier: Apache-2.0
// halfway_page: writes the sections of a page from the results of tests.
#include <string>
#include <vector>

#include "page/page.hpp"
#include "sim/program/program.hpp"
#include "sim/system/file.hpp"

namespace halfway::page {
namespace {

Status write_page(const std::filesystem::path& page, std::span<const std::string> results) {
  std::vector<Section> sections;
  for (const std::string& file : results) {
    const auto xml = read_file(file);
    if (!xml) return xml.error();
    auto read = read_results(file, *xml);
    if (!read) return read.error();
    sections.insert(sections.end(), read->begin(), read->end());
  }
  return write_sections(page, sections);
}

}  // namespace
}  // namespace halfway::page

int main(int argc, char** argv) {
  using namespace halfway;
  std::filesystem::path page;
  std::vector<std::string> results;
  CLI::App app{"Writes the sections of a page from the results of tests", "halfway_page"};
  app.add_option("PAGE", page, "Markdown file")->required();
  app.add_option("RESULTS", results, "files of --gtest_output=xml:")->required();
  int exit_code = 0;
  app.callback([&] {
    const Status written = page::write_page(page, results);
    if (!written) exit_code = cli::report(written.error());
  });
  return cli::run_program(app, argc, argv, exit_code);
}
