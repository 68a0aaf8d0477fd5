// SPDX-License-Identifier: Apache-2.0
#include "page/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <pugixml.hpp>

#include "sim/pages/template.hpp"
#include "sim/system/file.hpp"

namespace halfway::page {
namespace {

std::string heading_of(std::string_view suite) {
  std::string heading(suite.substr(0, suite.find('/')));
  std::ranges::replace(heading, '_', ' ');
  return heading;
}

std::vector<std::string> properties_of(const pugi::xml_node& test, const char* attribute) {
  std::vector<std::string> texts;
  for (const pugi::xml_node& property : test.child("properties").children("property"))
    texts.emplace_back(property.attribute(attribute).value());
  return texts;
}

std::string joined(std::span<const std::vector<std::string>> rows) {
  std::string text;
  for (const std::vector<std::string>& row : rows) text += row.front();
  return text;
}

// The reason for which the test has no row; empty if it has one.
std::string fault_of(const pugi::xml_node& test, const std::vector<std::string>& columns) {
  if (test.child("failure")) return "failed";
  if (std::string_view(test.attribute("result").value()) != "completed") return "did not run";
  if (properties_of(test, "name") != columns) return "records other properties than the suite's first test";
  return "";
}

}  // namespace

std::string with_sections(std::string_view text, std::span<const Section> sections) {
  std::string page(text);
  if (!page.empty() && page.back() != '\n') page += '\n';
  for (const Section& section : sections) {
    const std::string mark = fmt::format("\n## {}\n", section.heading);
    const std::string written = fmt::format("{}\n{}", mark, section.body);
    const std::size_t begin = page.find(mark);
    if (begin == std::string::npos) {
      page += written;
      continue;
    }
    const std::size_t next = page.find("\n## ", begin + mark.size() - 1);
    page.replace(begin, (next == std::string::npos ? page.size() : next) - begin, written);
  }
  return page;
}

Status write_sections(const std::filesystem::path& page, std::span<const Section> sections) {
  const auto text = read_file(page);
  if (!text) return text.error();
  return write_file(page, with_sections(*text, sections));
}

Result<std::vector<Section>> read_results(std::string_view file, const std::string& xml) {
  pugi::xml_document document;
  if (const auto read = document.load_string(xml.c_str()); !read)
    return bad_input(fmt::format("{}: {}", file, read.description()));
  std::vector<Section> sections;
  for (const pugi::xml_node& suite : document.child("testsuites").children("testsuite")) {
    const std::vector<std::string> columns = properties_of(suite.child("testcase"), "name");
    std::vector<std::vector<std::string>> rows;
    for (const pugi::xml_node& test : suite.children("testcase")) {
      if (const std::string fault = fault_of(test, columns); !fault.empty())
        return Error{ExitCode::differs, fmt::format("{}: {}.{} {}", file, suite.attribute("name").value(),
                                                    test.attribute("name").value(), fault)};
      rows.push_back(properties_of(test, "value"));
    }
    if (columns.empty()) continue;
    const bool is_whole = columns == std::vector<std::string>{std::string(c_table)};
    sections.push_back({heading_of(suite.attribute("name").value()),
                        is_whole ? joined(rows) : markdown_table(columns, rows)});
  }
  if (sections.empty()) return bad_input(fmt::format("{}: no test records a property", file));
  return sections;
}

}  // namespace halfway::page
