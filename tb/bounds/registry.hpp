// SPDX-License-Identifier: Apache-2.0
// What is checked of a bound: how, the worst that was found, and where.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tables/formats.hpp"

namespace halfway::bounds {

/// What a check goes by.
struct Context {
  bool quick = false;             ///< a few seconds in all: strides in place of exhaustion
  std::filesystem::path scratch;  ///< for Gappa's scripts
};

struct Finding {
  double worst = 0;        ///< in the bound's unit: the largest that was found
  std::string where;       ///< the very argument
  double proved = 0;       ///< in the bound's unit: what nothing exceeds; 0 where that was not shown
  double of_stated = 0.0;  ///< worst over what is stated there, of a bound that is a function; else 0
  std::string failure{};   ///< why the check itself says no; empty where it does not
};

struct Check {
  std::string_view preset;  ///< exact, published, or both
  std::string_view name;    ///< of the format or table
  std::string_view of;      ///< which of its bounds
  std::string_view how;     ///< for the page
  std::function<Finding(const Context&, const tables::PresetFormats&, const tables::Format&,
                        const tables::Bound&)>
      run;
  /// Why the format holds twice the largest number that comes and more; empty: it must not.
  std::string_view roomy{};
};

// A family each, in a file of its name.
std::vector<Check> integer_checks();
std::vector<Check> difference_checks();
std::vector<Check> angle_checks();
std::vector<Check> root_checks();
std::vector<Check> power_checks();
std::vector<Check> setup_checks();
std::vector<Check> sum_checks();

/// A table's row of the page.
struct TableFinding {
  std::string table;
  double bound = 0, derived = 0, worst = 0;
  std::string where;
  /// Sollya's answer for the same cells, of its own arithmetic; of a chord without what is cut. 0: not asked.
  double sollya = 0;
  std::string failure{};
};

/// Over whole cells, by intervals with outward rounding: the generated tables, and all sizes of cosine tables
/// (quick: a few).
std::vector<TableFinding> cosine_tables(const Context& context);
std::vector<TableFinding> function_tables(const Context& context);

/// The published rule of fraction bits, b > log2 M, beside ours: a row for each M.
struct RuleRow {
  int walked;            ///< M: lines and pixels
  int rule_bits;         ///< the fewest that the rule asks for
  double rule_error;     ///< colour steps, of a triangle drawn by the golden model with so many
  int rule_shown;        ///< colour steps by which a pixel of that triangle comes out wrong
  int our_bits;          ///< the fewest with which ours is below half a step
  double our_bound;      ///< colour steps
  double our_error;      ///< of a triangle, the worst found
  std::string triangle;  ///< its samples
};
std::vector<RuleRow> rule_rows(const Context& context);

/// An init vector of the published shader, one channel: a triangle of 4096 lines, drawn with figure 7's 20
/// fraction bits, which the published rule takes to be more than enough.
struct RuleCase {
  std::vector<std::uint32_t> init;
  std::function<double(std::int64_t x, std::int64_t y)> right;  ///< colour steps, at a pixel's centre
  double bound;                                                 ///< colour steps: what its words may be off
};
RuleCase published_rule_case();

/// How far the spherical paper's angle drifts with so many bits below the table's address.
struct DriftRow {
  int bits_below, steps;
  double addresses;  ///< of the table, either way; found by the golden interpolator
  double bound;
};
std::vector<DriftRow> drift_rows();

/// Gappa's answer to a script; an empty string where it proves all of it, else what it says. Empty optional:
/// there is no Gappa.
std::optional<std::string> gappa(const Context& context, std::string_view script);

/// What Sollya prints for a script; an empty optional where it is not asked: --quick.
std::optional<std::string> sollya(const Context& context, std::string_view script);

}  // namespace halfway::bounds
