// SPDX-License-Identifier: Apache-2.0
#include "structure/citations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <regex>
#include <set>
#include <string_view>

namespace halfway::structure {
namespace {

// A section, figure, table or equation, such as {"figure", "12"}.
struct Place {
  std::string kind, number;
  auto operator<=>(const Place&) const = default;
};

// The sections of each paper, with the numbers of the figures, tables and equations that are printed in them.
struct Section {
  std::string number;
  std::vector<int> figures, tables, equations;
};
const std::map<std::string, std::vector<Section>, std::less<>>& papers() {
  static const std::map<std::string, std::vector<Section>, std::less<>> c_all = {
      {"spherical",
       {{"1", {1}, {}, {1, 2}},
        {"2", {2, 3}, {}, {3, 4, 5, 6, 7, 8}},
        {"3", {4, 5, 6}, {}, {9, 10}},
        {"3.1", {7}, {}, {11, 12, 13, 14}},
        {"3.2", {8}, {}, {15, 16, 17}},
        {"4", {9, 10, 11, 12}, {1}, {18, 19, 20}},
        {"5", {13}, {}, {}},
        {"6", {14, 15, 16, 17}, {}, {}},
        {"7", {}, {}, {}}}},
      {"quadratic",
       {{"1", {1}, {}, {1, 2}},
        {"2", {2, 3}, {}, {3}},
        {"3", {}, {}, {4}},
        {"4", {4}, {}, {}},
        {"5", {5, 6}, {}, {5}},
        {"6", {7, 8, 9, 10, 11}, {}, {}},
        {"7", {}, {}, {}}}},
      {"processors",
       {{"1", {}, {}, {}},
        {"2", {}, {1, 2}, {1, 2, 3, 4, 5}},
        {"3", {}, {3}, {}},
        {"3.1", {1}, {}, {}},
        {"3.2", {}, {}, {}},
        {"3.3", {2}, {}, {}},
        {"4", {}, {4, 5}, {}},
        {"5", {}, {}, {}}}}};
  return c_all;
}

// What is found in one place only: a citation before these words must name one of the places.
struct Subject {
  std::string paper, words;
  std::set<Place> places;
};
const std::vector<Subject>& subjects() {
  static const std::vector<Subject> c_all = {
      {"spherical", "L + V", {{"equation", "6"}}},
      {"spherical", "L = −V", {{"equation", "6"}}},
      {"processors", "power by a table", {{"section", "3.1"}, {"figure", "1"}}},
      {"processors", "1/sqrt", {{"section", "3.3"}, {"figure", "2"}}},
  };
  return c_all;
}

// The section in which a figure, table or equation is printed; a section's own number; empty if there is
// none.
std::string section_of(std::string_view paper, const Place& place) {
  for (const Section& section : papers().find(paper)->second) {
    if (place.kind == "section") {
      if (section.number == place.number) return section.number;
      continue;
    }
    const std::vector<int>& numbers = place.kind == "figure"  ? section.figures
                                      : place.kind == "table" ? section.tables
                                                              : section.equations;
    if (std::ranges::any_of(numbers, [&](int n) { return std::to_string(n) == place.number; }))
      return section.number;
  }
  return {};
}

// 3.1 is within 3.
bool is_within(std::string_view inner, std::string_view outer) {
  return inner == outer || (inner.starts_with(outer) && inner[outer.size()] == '.');
}

// The text in one line, without the marks of comments and strings at line ends, and the line of each
// character.
struct Flat {
  std::string text;
  std::vector<int> line;
};
Flat flattened(std::string_view text) {
  Flat flat;
  int line = 1;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    std::string_view part = text.substr(0, end);
    text.remove_prefix(end == text.npos ? text.size() : end + 1);
    part.remove_prefix(std::min(part.find_first_not_of(" \t/-#*>"), part.size()));
    if (flat.text.ends_with("\" ") && part.starts_with('"')) {
      flat.text.resize(flat.text.size() - 2);
      flat.line.resize(flat.text.size());
      part.remove_prefix(1);
    }
    while (!part.empty() && std::isspace(static_cast<unsigned char>(part.back())) != 0) part.remove_suffix(1);
    flat.text.append(part).push_back(' ');
    flat.line.resize(flat.text.size(), line++);
  }
  return flat;
}

struct Citation {
  std::string paper;
  std::vector<Place> places;  ///< in the order of the text
  std::size_t at, end;        ///< in the flat text
};

// Appends the places of "figures 9 to 11" or "sections 3, 5 and 6".
void add_places(std::string kind, const std::string& numbers, std::vector<Place>& places) {
  std::ranges::transform(kind, kind.begin(), [](unsigned char c) { return std::tolower(c); });
  static const std::regex c_one(R"((to )?(\d+(?:\.\d+)?))");
  for (std::sregex_iterator it(numbers.begin(), numbers.end(), c_one), last; it != last; ++it) {
    if ((*it)[1].matched)
      for (int n = std::stoi(places.back().number) + 1; n < std::stoi((*it)[2]); ++n)
        places.push_back({kind, std::to_string(n)});
    places.push_back({kind, (*it)[2]});
  }
}

const std::string c_kind = "([Ss]ection|[Ff]igure|[Tt]able|[Ee]quation)s?",
                  c_numbers = R"((\d+(?:\.\d+)?(?:(?:,| and| to|, and) \d+(?:\.\d+)?)*))";

std::vector<Citation> citations_of(const Flat& flat) {
  const std::string& text = flat.text;
  constexpr std::size_t c_longest = 160;
  static const std::regex c_first("^(?: paper)?(?:'s)?,? " + c_kind + ' ' + c_numbers),
      c_next(R"(^(?: \([^)]*\))?(?:,| and|;) )" + c_kind + ' ' + c_numbers),
      c_before(c_kind + ' ' + c_numbers + " of the $");
  std::vector<Citation> found;
  for (const auto& [paper, sections] : papers())
    for (std::size_t at = 0; (at = text.find(paper, at)) != text.npos; at += paper.size()) {
      Citation citation{paper, {}, at, at + paper.size()};
      const auto take = [&](const std::regex& form) {
        const std::string rest = text.substr(citation.end, c_longest);
        std::smatch match;
        if (!std::regex_search(rest, match, form)) return false;
        add_places(match[1], match[2], citation.places);
        citation.end += static_cast<std::size_t>(match.length());
        return true;
      };
      if (take(c_first)) {
        while (take(c_next)) {
        }
      } else if (text.compare(citation.end, 6, " paper") == 0) {
        const std::size_t begin = at > c_longest ? at - c_longest : 0;
        const std::string earlier = text.substr(begin, at - begin);
        std::smatch match;
        if (std::regex_search(earlier, match, c_before)) add_places(match[1], match[2], citation.places);
      }
      if (!citation.places.empty()) found.push_back(std::move(citation));
    }
  return found;
}

// The words that follow a citation, to the end of the clause.
std::string words_after(const std::string& text, const Citation& citation) {
  constexpr std::size_t c_words = 60;
  const std::string words = text.substr(citation.end, c_words);
  return words.substr(0, words.find_first_of("\";|"));
}

}  // namespace

std::size_t count_citations(const std::string& text) {
  return citations_of(flattened(text)).size();
}

std::vector<std::string> wrong_citations(const std::string& file, const std::string& text) {
  const Flat flat = flattened(text);
  std::vector<std::string> wrong;
  for (const Citation& citation : citations_of(flat)) {
    const auto say = [&](const std::string& what) {
      wrong.push_back(fmt::format("{}:{}: {} paper: {}", file, flat.line[citation.at], citation.paper, what));
    };
    const Place* section = nullptr;
    for (const Place& place : citation.places) {
      const std::string printed = section_of(citation.paper, place);
      if (printed.empty()) {
        say(fmt::format("there is no {} {}", place.kind, place.number));
      } else if (place.kind == "section") {
        section = &place;
      } else if (section != nullptr && !is_within(printed, section->number)) {
        say(fmt::format("{} {} is in section {}, not in {}", place.kind, place.number, printed,
                        section->number));
      }
    }
    const std::string words = words_after(flat.text, citation);
    for (const Subject& subject : subjects())
      if (subject.paper == citation.paper && words.find(subject.words) != words.npos &&
          std::ranges::none_of(citation.places, [&](const Place& p) { return subject.places.contains(p); }))
        say(fmt::format("'{}' is in {} {}", subject.words, subject.places.begin()->kind,
                        subject.places.begin()->number));
  }
  return wrong;
}

}  // namespace halfway::structure
