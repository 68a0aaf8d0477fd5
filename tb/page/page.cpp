// SPDX-License-Identifier: Apache-2.0
#include "page/page.hpp"

#include <fmt/format.h>

#include <utility>

#include "sim/system/file.hpp"
#include "sim/system/page_part.hpp"

namespace halfway::page {
std::string with_sections(std::string_view text, std::span<const Section> sections) {
  std::string page(text);
  if (!page.empty() && page.back() != '\n') page += '\n';
  for (const Section& section : sections) {
    if (auto written = with_page_part(page, section.heading, section.body)) {
      page = std::move(*written);
      continue;
    }
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

}  // namespace halfway::page
