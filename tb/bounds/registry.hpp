// SPDX-License-Identifier: Apache-2.0
// The check of a bound: its method, the worst case found, and its argument.
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

/// Parameters of a check.
struct Context {
  bool quick = false;             ///< a few seconds in total: strides instead of all arguments
  std::filesystem::path scratch;  ///< for Gappa's scripts
};

struct Finding {
  double worst = 0;        ///< in the bound's unit: the largest value found
  std::string where;       ///< the argument of the largest value
  double proved = 0;       ///< in the bound's unit: a proved bound; 0 if none was proved
  double of_stated = 0.0;  ///< if the bound is a function: worst / its stated value there; else 0
  std::string failure{};   ///< the reason for which the check failed; empty if it passed
};

struct Check {
  std::string_view preset;  ///< exact, published, or both
  std::string_view name;    ///< of the format or table
  std::string_view of;      ///< which of its bounds
  std::string_view how;     ///< for the page
  std::function<Finding(const Context&, const tables::PresetFormats&, const tables::Format&,
                        const tables::Bound&)>
      run;
  /// The reason for which the format holds more than twice the largest number. Empty: it must not.
  std::string_view roomy{};
};

// One family of checks each, in a file of that name.
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
  /// Sollya's result for the same cells, computed independently; for a chord without the cut. 0: not
  /// computed.
  double sollya = 0;
  std::string failure{};
};

/// Whole cells, by intervals with outward rounding. All generated tables, and cosine tables of all sizes
/// (quick: of a few).
std::vector<TableFinding> cosine_tables(const Context& context);
std::vector<TableFinding> function_tables(const Context& context);

/// The published rule of fraction bits, b > log2 M, compared with ours: one row for each M.
struct RuleRow {
  int walked;            ///< M: lines and pixels
  int rule_bits;         ///< the fewest bits that satisfy the rule
  double rule_error;     ///< colour steps, of a triangle drawn by the golden model with these bits
  int rule_shown;        ///< colour steps by which a pixel of that triangle is wrong
  int our_bits;          ///< the fewest bits with which our error is below half a step
  double our_bound;      ///< colour steps
  double our_error;      ///< the worst found of a triangle
  std::string triangle;  ///< its samples
};
std::vector<RuleRow> rule_rows(const Context& context);

/// An init vector of the published shader with one channel: a triangle of 4096 lines, drawn with the 20
/// fraction bits of figure 7, which are more than sufficient by the published rule.
struct RuleCase {
  std::vector<std::uint32_t> init;
  std::function<double(std::int64_t x, std::int64_t y)> right;  ///< colour steps, at a pixel's centre
  double bound;                                                 ///< colour steps: error bound of its words
};
RuleCase published_rule_case();

/// The drift of the spherical paper's angle with `bits_below` bits below the table's address.
struct DriftRow {
  int bits_below, steps;
  double addresses;  ///< addresses of the table, in both directions; found by the golden interpolator
  double bound;
};
std::vector<DriftRow> drift_rows();

/// Gappa's result for a script: an empty string if it proves everything, else its output. Empty optional:
/// Gappa is not installed.
std::optional<std::string> gappa(const Context& context, std::string_view script);

/// Sollya's output for a script. Empty optional: not run (--quick).
std::optional<std::string> sollya(const Context& context, std::string_view script);

}  // namespace halfway::bounds
