// SPDX-License-Identifier: Apache-2.0
// tb/evidence/thresholds.toml: what measured values must satisfy. A section has a rule and a number for each
// name:
//
//   [mutants]
//   rule = "at least 90 %"      # of the number that stands here
//   triangle_walker = 91.7
//
//   [cells]                     # lists: a rule for each column
//   columns = ["LUTs", "flip-flops"]
//   rules = ["within 3 % or 3", "equal"]
//   accumulator_24 = [24, 24]
//
// With `release`, a section's numbers depend on the tools of that release of an operating system, and are
// judged there only.
//
// Rules: `equal`, `at least`, `at most`, both also with a share of the number in %, `within P %` and
// `within P % or N`.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/result.hpp"

namespace halfway::page {

/// What was measured under a name: a number for each column of the section.
struct Value {
  std::string section, name;
  std::vector<double> numbers;
};

class Thresholds {
 public:
  /// Throws Failure with file and line.
  static Thresholds read(const std::filesystem::path& root);
  static Thresholds parse(std::string_view text);

  /// One line for each number that breaks its threshold, and for a name without a threshold:
  /// "tb/evidence/thresholds.toml:LINE: SECTION: NAME: COLUMN is NUMBER, must be RULE NUMBER".
  std::vector<std::string> broken(const Value& value) const;
  /// One line for each name of these sections that no value has.
  std::vector<std::string> unmeasured(std::span<const Value> values) const;
  /// The names of a section, and the numbers that stand in the file; empty if there are none.
  std::vector<std::string> names(std::string_view section) const;
  std::vector<double> numbers(std::string_view section, std::string_view name) const;
  /// The only release whose measured values the section judges; empty: any.
  std::string release(std::string_view section) const;

  /// How far a measured number may be below and above the number in the file: a share of it, or `margin` if
  /// that is more. Nothing: any distance.
  struct Rule {
    std::string text;
    std::optional<double> below, above;
    double margin = 0;
    bool is_broken_by(double number, double threshold) const;
  };

 private:
  struct Limit {
    std::vector<double> numbers;
    std::size_t line;
  };
  struct Section {
    std::vector<std::string> columns;
    std::vector<Rule> rules;
    std::map<std::string, Limit, std::less<>> limits;
    std::size_t line;
    std::string release{};
  };
  std::map<std::string, Section, std::less<>> sections_;
};

/// The values of sections that are judged with this machine's tools. Says which sections are of another
/// release.
std::vector<Value> judged_here(const Thresholds& thresholds, std::vector<Value> values);

/// Print each threshold that the values break, and each name of their sections that they lack. Returns
/// `differs` if there is one.
ExitCode judged(const std::filesystem::path& root, std::span<const Value> values);

}  // namespace halfway::page
