// SPDX-License-Identifier: Apache-2.0
#include "sim/os/page_part.hpp"

#include <fmt/format.h>

#include "sim/os/file.hpp"

namespace halfway {

Result<std::string> with_page_part(std::string_view page, std::string_view name, std::string_view text) {
  const std::string opens = fmt::format("\n<!-- {}: ", name),
                    closes = fmt::format("\n<!-- end of {} -->\n", name);
  const std::size_t open = page.find(opens);
  const std::size_t begin = open == page.npos ? open : page.find('\n', open + 1);
  const std::size_t end = begin == page.npos ? begin : page.find(closes, begin);
  if (end == page.npos || page.find(opens, begin) != page.npos)
    return bad_input(fmt::format("wants one part between the lines '<!-- {}: … -->' and '<!-- end of {} -->'",
                                 name, name));
  return fmt::format("{}\n{}\n{}", page.substr(0, begin + 1), text, page.substr(end + 1));
}

Status rewrite_page(const std::filesystem::path& path,
                    const std::function<Result<std::string>(const std::string& page)>& rewritten) {
  const auto page = read_file(path);
  if (!page) return page.error();
  const auto text = rewritten(*page);
  if (!text) return Error{text.error().code, fmt::format("{}: {}", path.string(), text.error().message)};
  return write_file(path, *text);
}

}  // namespace halfway
