// SPDX-License-Identifier: Apache-2.0
#include "structure/figures.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <span>
#include <sstream>

namespace halfway {
namespace {

using namespace std::string_view_literals;

// Units of a measured figure after any number.
constexpr std::array c_units = {
    "MHz"sv,        "GHz"sv,  "ns"sv,    "µs"sv,         "ms"sv,    "s"sv,      "seconds"sv,
    "minutes"sv,    "hour"sv, "hours"sv, "core-hours"sv, "%"sv,     "LUTs"sv,   "cells"sv,
    "flip-flops"sv, "RAMs"sv, "kB"sv,    "MB"sv,         "GB"sv,    "KiB"sv,    "MiB"sv,
    "GiB"sv,        "dB"sv,   "times"sv, "cases"sv,      "kinds"sv, "designs"sv};
// Units of a measured figure after a number of 1000 or more. Smaller ones are mostly the hardware's own.
constexpr std::array c_counted = {"triangles"sv, "pixels"sv,       "fragments"sv, "vectors"sv, "records"sv,
                                  "samples"sv,   "points"sv,       "cycles"sv,    "faults"sv,  "meshes"sv,
                                  "inputs"sv,    "instructions"sv, "executions"sv};
// Words between a number and its unit.
constexpr std::array c_between = {"a"sv,       "an"sv,       "of"sv,       "colour"sv, "depth"sv,
                                  "logic"sv,   "line"sv,     "init"sv,     "random"sv, "compared"sv,
                                  "million"sv, "thousand"sv, "processor"sv};
constexpr std::array c_number_words = {
    "two"sv,  "three"sv,  "four"sv,   "five"sv,    "six"sv,      "seven"sv,   "eight"sv,    "nine"sv,
    "ten"sv,  "eleven"sv, "twelve"sv, "sixteen"sv, "twenty"sv,   "hundred"sv, "thousand"sv, "million"sv,
    "half"sv, "third"sv,  "thirds"sv, "quarter"sv, "quarters"sv, "fifths"sv};
// Words before a version or a section.
constexpr std::array c_names = {"GHDL"sv, "Yosys"sv, "Verilator"sv, "nextpnr"sv, "glTF"sv, "section"sv};
// Words in the head of a column whose numbers describe the hardware, or heads.
constexpr std::array c_given = {"clocks"sv, "bits"sv, "default"sv, "code"sv};

bool among(std::span<const std::string_view> words, std::string_view word) {
  return std::ranges::find(words, word) != words.end();
}

bool is_digit(char c) {
  return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

// The word without punctuation and emphasis around it.
std::string_view bare(std::string_view word) {
  const std::size_t begin = word.find_first_not_of("([*_~\"'");
  if (begin == std::string_view::npos) return {};
  word.remove_prefix(begin);
  return word.substr(0, word.find_last_not_of(".,;:)]*_?!\"'") + 1);
}

bool ends_a_phrase(std::string_view word) {
  return !word.empty() && ".,;:)]|"sv.find(word.back()) != std::string_view::npos;
}

bool is_number(std::string_view word) {
  const auto is_letter = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; };
  return among(c_number_words, word) ||
         (!word.empty() && is_digit(word.front()) && std::ranges::none_of(word, is_letter));
}

// Three digits: the rest of a number in groups.
bool is_group(std::string_view word) {
  return word.size() == 3 && std::ranges::all_of(word, is_digit);
}

bool has_decimals(std::string_view number) {
  const std::size_t point = number.find('.');
  return point != std::string_view::npos && point > 0 && is_digit(number[point - 1]) &&
         point + 1 < number.size() && is_digit(number[point + 1]) &&
         number.find('.', point + 1) == std::string_view::npos;
}

// 1000 or more. A power counts as such, a size such as 640×480 does not.
bool is_large(std::string_view number) {
  constexpr std::array c_powers = {"^"sv, "¹"sv, "²"sv, "³"sv, "\xE2\x81"sv};  // the last starts ⁰ and ⁴ to ⁹
  const auto has = [&](std::string_view part) { return number.find(part) != number.npos; };
  return number == "million" || number == "thousand" || std::ranges::any_of(c_powers, has) ||
         (std::ranges::count_if(number, is_digit) >= 4 && !has("×"));
}

// A cell that is a number, perhaps with a sign, a range or a second number.
bool is_numeric(std::string_view cell) {
  std::string text(cell);
  for (const char* part : {"–", "−", "×", "→", "·", "to"})
    for (std::size_t at = 0; (at = text.find(part)) != std::string::npos;)
      text.erase(at, std::string_view(part).size());
  return std::ranges::any_of(text, is_digit) &&
         text.find_first_not_of("0123456789.,/()%+-* ") == std::string::npos;
}

std::vector<std::string> cells_of(std::string_view row) {
  std::vector<std::string> cells;
  for (std::size_t at = row.find('|') + 1; at < row.size();) {
    const std::size_t end = std::min(row.find('|', at), row.size());
    std::string cell(row.substr(at, end - at));
    cell.erase(0, std::min(cell.find_first_not_of(' '), cell.size()));
    cell.erase(cell.find_last_not_of(' ') + 1);
    cells.push_back(std::move(cell));
    at = end + 1;
  }
  if (!cells.empty() && cells.back().empty()) cells.pop_back();
  return cells;
}

}  // namespace

HandWritten::HandWritten(std::string_view page) {
  std::string end_of_part;  // the comment that ends the part written by a command
  bool comment = false, code = false, transcript = false;
  std::size_t number = 0;
  std::istringstream lines{std::string(page)};
  for (std::string text; std::getline(lines, text);) {
    std::string_view line = text;
    ++number;
    // Skip parts that commands write, and comments.
    if (!end_of_part.empty()) {
      if (line.starts_with(end_of_part)) end_of_part.clear();
      continue;
    }
    if (const std::size_t colon = line.find(": written by ");
        line.starts_with("<!-- ") && colon != line.npos) {
      end_of_part = "<!-- end of " + std::string(line.substr(5, colon - 5)) + " -->";
      continue;
    }
    if (comment || line.starts_with("<!--")) {
      comment = line.find("-->") == line.npos;
      continue;
    }
    // Skip what `transcripts` compares.
    if (line.starts_with("```")) {
      code = !code;
      transcript = false;
      continue;
    }
    transcript = transcript || line.starts_with("$ build/halfway ");
    if (code && (transcript || line.starts_with("spheres      quadratic  exact "))) continue;
    if (!code && line.starts_with("|")) {
      add_row(line, number);
    } else {
      head_.clear();
      add_words(line, number, code);
    }
  }
}

std::string_view HandWritten::word(std::size_t index) const {
  const std::size_t from = words_[index].position;
  return std::string_view(text_).substr(from, text_.find(' ', from) - from);
}

std::size_t HandWritten::line_at(std::size_t position) const {
  const auto after = std::ranges::upper_bound(words_, position, {}, &Word::position);
  return after == words_.begin() ? 0 : std::prev(after)->line;
}

void HandWritten::add_words(std::string_view line, std::size_t number, bool code) {
  std::istringstream words{std::string(line)};
  for (std::string word; words >> word;) {
    if (!text_.empty()) text_ += ' ';
    words_.push_back({.position = text_.size(), .line = number, .code = code, .given = false, .cell = false});
    text_ += word;
  }
}

void HandWritten::add_row(std::string_view line, std::size_t number) {
  const std::vector<std::string> cells = cells_of(line);
  const bool is_head = head_.empty();
  if (is_head) head_ = cells;
  for (std::size_t column = 0; column < cells.size(); ++column) {
    add_words("|", number, false);
    const std::size_t first = words_.size();
    add_words(cells[column], number, false);
    if (is_head || column >= head_.size() || first == words_.size()) continue;
    // Find out whether the head says that the numbers describe the hardware, or only number the rows.
    const std::string& head = head_[column];
    bool given = head == "clock" || (head.empty() && column == 0);
    std::istringstream words(head);
    for (std::string word; words >> word;) given = given || among(c_given, bare(word));
    for (std::size_t i = first; i < words_.size(); ++i) words_[i].given = given;
    words_[first].cell = is_numeric(cells[column]);
  }
  add_words("|", number, false);
}

std::optional<std::size_t> HandWritten::end_of_figure(std::size_t first) const {
  const auto at = [&](std::size_t index) {
    return index < words_.size() ? bare(word(index)) : std::string_view();
  };
  const std::string_view number = at(first);
  if (words_[first].cell) return first;
  // A number and its unit in one word.
  const std::size_t digits = number.find_first_not_of("0123456789.,");
  if (digits > 0 && digits != number.npos && among(c_units, number.substr(digits))) return first;
  // A single minute or hour.
  const bool single = number == "a" || number == "an" || number == "one";
  if (single && (at(first + 1) == "minute" || at(first + 1) == "hour")) return first + 1;
  if (!is_number(number)) return std::nullopt;
  // A number with decimals.
  const bool of_name = first > 0 && among(c_names, at(first - 1));
  if (!words_[first].code && has_decimals(number) && number != "0.5" && !of_name) return first;
  // A number, perhaps in groups of three digits, some words, and a unit.
  bool large = is_large(number);
  std::size_t unit = first + 1;
  for (; unit < words_.size() && !ends_a_phrase(word(unit - 1)); ++unit) {
    const bool group = is_group(at(unit));
    if (!group && !among(c_between, at(unit))) break;
    large = large || group || is_large(at(unit));
  }
  if (unit == words_.size() || ends_a_phrase(word(unit - 1))) return std::nullopt;
  const bool steps = at(unit) == "steps" && (at(unit - 1) == "colour" || at(unit - 1) == "depth");
  const bool rate = at(unit + 1) == "per" && at(unit + 2) == "second";
  const bool count = large && among(c_counted, at(unit));
  if (steps || rate || count || among(c_units, at(unit))) return unit;
  return std::nullopt;
}

std::vector<HandWritten::Figure> HandWritten::figures() const {
  std::vector<Figure> found;
  bool inline_code = false;
  for (std::size_t i = 0; i < words_.size(); ++i) {
    // Skip inline code. It ends at the latest with its cell.
    const auto ticks = words_[i].code ? 0 : std::ranges::count(word(i), '`');
    if (word(i) == "|") inline_code = false;
    const bool skipped = inline_code || ticks > 0 || words_[i].given;
    if (ticks % 2 == 1) inline_code = !inline_code;
    if (skipped) continue;
    if (const auto last = end_of_figure(i)) {
      const std::size_t from = words_[i].position, to = words_[*last].position + word(*last).size();
      found.push_back({from, std::string(bare(std::string_view(text_).substr(from, to - from)))});
      i = *last;
    }
  }
  return found;
}

}  // namespace halfway
