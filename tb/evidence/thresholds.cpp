// SPDX-License-Identifier: Apache-2.0
#include "evidence/thresholds.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <regex>
#include <set>

#include "sim/os/file.hpp"
#include "sim/os/machine.hpp"
#include "sim/os/must.hpp"
#include "sim/os/toml_file.hpp"

namespace halfway::page {
namespace {

constexpr std::string_view c_file = "tb/evidence/thresholds.toml";

Failure at(const toml::node& node, std::string_view what) {
  return Failure{bad_input(fmt::format("{}:{}: {}", c_file, node.source().begin.line, what))};
}

// The rule with these words; nothing if there is no such rule.
std::optional<Thresholds::Rule> rule_of(const std::string& text) {
  static const std::regex c_one_sided(R"(at (least|most)(?: ([0-9.]+) %)?)"),
      c_within(R"(within ([0-9.]+) %(?: or ([0-9.]+))?)");
  constexpr double c_percent = 100;
  std::smatch match;
  if (text == "equal") return Thresholds::Rule{text, 0, 0};
  if (std::regex_match(text, match, c_one_sided)) {
    const double share = match[2].matched ? std::abs(1 - std::stod(match[2]) / c_percent) : 0;
    return match[1] == "least" ? Thresholds::Rule{text, share, {}} : Thresholds::Rule{text, {}, share};
  }
  if (!std::regex_match(text, match, c_within)) return std::nullopt;
  const double share = std::stod(match[1]) / c_percent;
  return Thresholds::Rule{text, share, share, match[2].matched ? std::stod(match[2]) : 0};
}

// The texts or numbers of a list, or of one value.
template <class T>
std::vector<T> list_of(const toml::node* node) {
  std::vector<T> list;
  const auto add = [&](const toml::node& one) {
    if (const auto value = one.value<T>()) list.push_back(*value);
  };
  if (node == nullptr) return list;
  if (const toml::array* array = node->as_array()) {
    for (const toml::node& one : *array) add(one);
    if (list.size() != array->size()) list.clear();
  } else {
    add(*node);
  }
  return list;
}

}  // namespace

bool Thresholds::Rule::is_broken_by(double number, double threshold) const {
  if (std::isnan(number)) return true;
  constexpr double c_rounding = 1e-9;  // of decimal fractions in binary
  const auto slack = [&](double share) {
    return std::max(share * std::abs(threshold), margin) + c_rounding * std::abs(threshold);
  };
  return (below && number < threshold - slack(*below)) || (above && number > threshold + slack(*above));
}

Thresholds Thresholds::read(const std::filesystem::path& root) {
  return parse(must(read_file(root / c_file)));
}

Thresholds Thresholds::parse(std::string_view text) {
  Thresholds thresholds;
  for (const auto& [section_name, node] : parse_toml(text, std::string(c_file))) {
    const toml::table* table = node.as_table();
    if (table == nullptr) throw at(node, fmt::format("{}: is not a section", section_name.str()));
    Section section{.line = node.source().begin.line};
    section.release = (*table)["release"].value_or(std::string());
    section.columns = list_of<std::string>(table->get("columns"));
    for (const std::string& rule :
         list_of<std::string>(table->get(section.columns.empty() ? "rule" : "rules"))) {
      const auto known = rule_of(rule);
      if (!known) throw at(node, fmt::format("{}: no such rule: {}", section_name.str(), rule));
      section.rules.push_back(*known);
    }
    if (section.columns.empty()) section.columns = {"it"};
    if (section.rules.size() != section.columns.size())
      throw at(node, fmt::format("{}: give a rule, or columns and as many rules", section_name.str()));
    for (const auto& [name, limit] : *table) {
      if (name == "release" || name == "rule" || name == "rules" || name == "columns") continue;
      std::vector<double> numbers = list_of<double>(&limit);
      if (numbers.size() != section.columns.size())
        throw at(limit, fmt::format("{}: wants {} numbers", name.str(), section.columns.size()));
      section.limits[std::string(name.str())] = {std::move(numbers), limit.source().begin.line};
    }
    thresholds.sections_[std::string(section_name.str())] = std::move(section);
  }
  return thresholds;
}

std::vector<std::string> Thresholds::broken(const Value& value) const {
  const auto section = sections_.find(value.section);
  if (section == sections_.end()) return {fmt::format("{}: has no section [{}]", c_file, value.section)};
  const auto& [columns, rules, limits, line, release] = section->second;
  const auto limit = limits.find(value.name);
  if (limit == limits.end())
    return {fmt::format("{}:{}: {}: {} has no threshold; it is {}", c_file, line, value.section, value.name,
                        fmt::join(value.numbers, ", "))};
  if (value.numbers.size() != columns.size())
    return {fmt::format("{}:{}: {}: {} has {} numbers, not {}", c_file, limit->second.line, value.section,
                        value.name, value.numbers.size(), columns.size())};
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < columns.size(); ++i)
    if (rules[i].is_broken_by(value.numbers[i], limit->second.numbers[i]))
      lines.push_back(fmt::format("{}:{}: {}: {}: {} is {:.6g}; the threshold is {:.6g}, {}", c_file,
                                  limit->second.line, value.section, value.name, columns[i], value.numbers[i],
                                  limit->second.numbers[i], rules[i].text));
  return lines;
}

std::vector<std::string> Thresholds::unmeasured(std::span<const Value> values) const {
  std::set<std::string> judged, measured;
  for (const Value& value : values) {
    judged.insert(value.section);
    measured.insert(value.section + '\n' + value.name);
  }
  std::vector<std::string> lines;
  for (const std::string& name : judged)
    if (const auto section = sections_.find(name); section != sections_.end())
      for (const auto& [of, limit] : section->second.limits)
        if (!measured.contains(name + '\n' + of))
          lines.push_back(
              fmt::format("{}:{}: {}: {} is not measured any more; remove it", c_file, limit.line, name, of));
  return lines;
}

std::vector<std::string> Thresholds::names(std::string_view section) const {
  std::vector<std::string> names;
  if (const auto found = sections_.find(section); found != sections_.end())
    for (const auto& [name, limit] : found->second.limits) names.push_back(name);
  return names;
}

std::vector<double> Thresholds::numbers(std::string_view section, std::string_view name) const {
  const auto found = sections_.find(section);
  if (found == sections_.end()) return {};
  const auto limit = found->second.limits.find(name);
  return limit == found->second.limits.end() ? std::vector<double>() : limit->second.numbers;
}

std::string Thresholds::release(std::string_view section) const {
  const auto found = sections_.find(section);
  return found == sections_.end() ? std::string() : found->second.release;
}

std::vector<Value> judged_here(const Thresholds& thresholds, std::vector<Value> values) {
  const std::string here = operating_system();
  std::set<std::string> elsewhere;
  std::erase_if(values, [&](const Value& value) {
    const std::string release = thresholds.release(value.section);
    const bool is_elsewhere = !release.empty() && release != here;
    if (is_elsewhere && elsewhere.insert(value.section).second)
      fmt::print(stderr, "{}: [{}] is of the tools of {}: not judged on {}\n", c_file, value.section, release,
                 here);
    return is_elsewhere;
  });
  return values;
}

ExitCode judged(const std::filesystem::path& root, std::span<const Value> all) {
  if (all.empty()) return ExitCode::equal;
  const Thresholds thresholds = Thresholds::read(root);
  const std::vector<Value> values = judged_here(thresholds, {all.begin(), all.end()});
  std::vector<std::string> lines = thresholds.unmeasured(values);
  for (const Value& value : values)
    for (std::string& line : thresholds.broken(value)) lines.push_back(std::move(line));
  for (const std::string& line : lines) fmt::print(stderr, "{}\n", line);
  return lines.empty() ? ExitCode::equal : ExitCode::differs;
}

}  // namespace halfway::page
