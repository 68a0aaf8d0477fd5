// SPDX-License-Identifier: Apache-2.0
#include "sim/system/page_part.hpp"

#include <fmt/format.h>

#include "sim/system/file.hpp"

namespace halfway {
namespace {

// From the end of the first comment's line to the second comment.
struct Place {
  std::size_t begin, end;
};

Result<Place> place_of(std::string_view page, std::string_view name) {
  const std::string opens = fmt::format("\n<!-- {}: ", name),
                    closes = fmt::format("\n<!-- end of {} -->\n", name);
  const std::size_t open = page.find(opens);
  const std::size_t begin = open == page.npos ? open : page.find('\n', open + 1);
  const std::size_t end = begin == page.npos ? begin : page.find(closes, begin);
  if (end == page.npos || page.find(opens, begin) != page.npos)
    return bad_input(fmt::format("wants one part between the lines '<!-- {}: … -->' and '<!-- end of {} -->'",
                                 name, name));
  return Place{begin + 1, end + 1};
}

}  // namespace

Result<std::string> page_part(std::string_view page, std::string_view name) {
  const auto place = place_of(page, name);
  if (!place) return place.error();
  std::string_view part = page.substr(place->begin, place->end - place->begin);
  while (part.starts_with('\n')) part.remove_prefix(1);
  while (part.ends_with("\n\n") || part == "\n") part.remove_suffix(1);
  return std::string(part);
}

Result<std::string> with_page_part(std::string_view page, std::string_view name, std::string_view text) {
  const auto place = place_of(page, name);
  if (!place) return place.error();
  return fmt::format("{}\n{}\n{}", page.substr(0, place->begin), text, page.substr(place->end));
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
