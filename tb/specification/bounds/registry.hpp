// SPDX-License-Identifier: Apache-2.0
// The check of a bound: its method, the worst case found, and its argument.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "common/test/big_real.hpp"
#include "words/generator/formats.hpp"

namespace halfway::bounds {

/// Parameters of a check.
struct Context {
  bool quick = false;  ///< a few seconds in total: strides instead of all arguments
};

struct Finding {
  double worst = 0;        ///< in the bound's unit: the largest value found
  std::string where;       ///< the argument of the largest value
  double proved = 0;       ///< in the bound's unit: a proved bound; 0 if none was proved
  double of_stated = 0.0;  ///< if the bound is a function: worst / its stated value there; else 0
  std::string failure{};   ///< the reason for which the check failed; empty if it passed
};

/// Keeps the error and its argument if it is the largest so far.
template <class Where>
void keep_worst(auto& finding, double error, Where&& where) {
  if (error <= finding.worst) return;
  finding.worst = error;
  finding.where = where();
}

/// The distance of the two numbers, rounded up.
inline double distance(double value, const BigReal& truth) {
  return std::nextafter(static_cast<double>(abs(truth - value)), HUGE_VAL);
}

/// A bound as model/words/generator states it.
struct Stated {
  const tables::PresetFormats& preset;
  const tables::Format& format;
  const tables::Bound& bound;
};

struct Check {
  std::string_view preset;  ///< exact, published, or both
  std::string_view name;    ///< of the format or table
  std::string_view of;      ///< which of its bounds
  std::string_view how;     ///< for the page
  std::function<Finding(const Context&, const Stated&)> run;
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
};

/// Whole cells, by 400 bits. All generated tables, and cosine tables of all sizes (quick: of a few).
std::vector<TableFinding> cosine_tables(const Context& context);
std::vector<TableFinding> function_tables(const Context& context);

/// Runs Gappa on the script, unless the context is quick: the limit is then proved, or the check fails.
void prove(const Context& context, const std::string& script, double limit, Finding& finding);

/// A check that has a function for each preset.
using Run = Finding(const Context&, const Stated&);
inline std::function<Run> of_preset(Run* exact, Run* published) {
  return [=](const Context& context, const Stated& stated) {
    return (stated.preset.name == "exact" ? exact : published)(context, stated);
  };
}

}  // namespace halfway::bounds
