// SPDX-License-Identifier: Apache-2.0
// Checks every bound that model/words/generator states for a format or a table: its derivation does not
// exceed it, nothing found or proved exceeds it, and the worst case found is at least half of it. Each test
// records its row of the page, or its table.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <ostream>

#include "evidence/page.hpp"
#include "registry.hpp"
#include "sim/files/template.hpp"

namespace halfway::bounds {
namespace {

std::string number(double value) {
  if (value == std::floor(value) && std::fabs(value) < 0x1p53) return fmt::format("{:.0f}", value);
  return std::fabs(value) >= 0.001 && std::fabs(value) < 1e6 ? fmt::format("{:.5g}", value)
                                                             : fmt::format("{:.4g}", value);
}

constexpr double c_tight = 0.5;      // least worst case as a part of its bound
constexpr double c_derived = 0.8;    // least derivation as a part of its bound
constexpr double c_rounding = 1e-9;  // relative rounding of the doubles in which both sides are computed

std::string number_or_dash(double value) {
  return value > 0 ? number(value) : "–";
}

const std::vector<tables::PresetFormats>& presets() {
  static const auto c_presets = tables::preset_formats();
  return c_presets;
}

std::vector<Check> all_checks() {
  std::vector<Check> all;
  for (const auto& family : {integer_checks(), difference_checks(), angle_checks(), root_checks(),
                             power_checks(), setup_checks(), sum_checks()})
    all.insert(all.end(), family.begin(), family.end());
  return all;
}

bool is_of(const Check& check, const tables::PresetFormats& preset, const tables::Format& format,
           const tables::Bound& bound) {
  return (check.preset == "both" || check.preset == preset.name) && check.name == format.name &&
         check.of == bound.of;
}

// ---- Formats

struct StatedBound {
  const tables::PresetFormats* preset;
  const tables::Format* format;
  const tables::Bound* bound;
  Check check;  ///< without `run` nothing checks the bound

  friend void PrintTo(const StatedBound& b, std::ostream* out) {
    *out << b.format->name << ' ' << b.bound->of;
  }
};

std::vector<StatedBound> bounds_of(std::string_view preset_name) {
  const std::vector<Check> checks = all_checks();
  std::vector<StatedBound> stated;
  for (const tables::PresetFormats& preset : presets())
    for (const tables::Format& format : preset.formats)
      for (const tables::Bound& bound : format.bounds) {
        if (preset.name != preset_name) continue;
        const auto check =
            std::ranges::find_if(checks, [&](const Check& c) { return is_of(c, preset, format, bound); });
        stated.push_back({&preset, &format, &bound, check == checks.end() ? Check{} : *check});
      }
  return stated;
}

std::string name_of(const testing::TestParamInfo<StatedBound>& info) {
  const std::string_view of = info.param.bound->of;
  std::string name = fmt::format("{}{}{}", info.param.format->name, of.empty() ? "" : "_", of);
  std::ranges::replace_if(name, [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}

class FormatBounds : public testing::TestWithParam<StatedBound> {
 protected:
  void check(bool quick) {
    const auto& [preset, format, bound, check] = GetParam();
    ASSERT_TRUE(check.run) << "nothing checks the bound";
    const Finding finding = check.run({quick}, {*preset, *format, *bound});
    EXPECT_EQ(finding.failure, "");
    const double derived = tables::derived(*preset, *format, *bound);
    const double most = bound->value * (1 + c_rounding), worst = std::max(finding.worst, 0.0);
    EXPECT_LE(derived, most) << "its derivation";
    EXPECT_GE(derived, c_derived * bound->value) << "its derivation";
    EXPECT_LE(worst, most) << "found at " << finding.where;
    EXPECT_LE(finding.proved, bound->value * (1 + 0x1p-9)) << "no less is proved";
    double ratio = bound->value == 0 ? 1.0 : worst / bound->value;
    if (finding.of_stated > 0) ratio = finding.of_stated;
    EXPECT_LE(ratio, 1 + c_rounding) << "of what is stated at " << finding.where;
    EXPECT_GE(ratio, c_tight) << "of the bound: nothing comes closer, at " << finding.where;
    if (bound->kind == tables::Bound::Kind::range) {
      // A signed format holds one more value below zero.
      const double capacity =
          std::ldexp(1.0, format->integer_bits) - (format->is_signed ? 0 : format->unit());
      EXPECT_LE(bound->value, capacity) << "the format's largest number";
      if (check.roomy.empty()) {
        EXPECT_GE(2 * bound->value, capacity) << "the format holds twice as much";
      }
    }

    const std::string of(bound->kind == tables::Bound::Kind::range ? "range" : bound->of);
    RecordProperty("format", fmt::format("`{}` {}", format->name, format->text()));
    RecordProperty("of", of.empty() ? "–" : of);
    RecordProperty("bound", fmt::format("{}{}{}", tables::shown(bound->value), bound->unit.empty() ? "" : " ",
                                        bound->unit));
    RecordProperty("from", fmt::format("`{}`", bound->derivation));
    RecordProperty("derived", number(derived));
    RecordProperty("found", number(finding.worst));
    RecordProperty("of the bound", fmt::format("{:.2f}", ratio));
    RecordProperty("where",
                   check.roomy.empty() ? finding.where : fmt::format("{}; {}", finding.where, check.roomy));
    RecordProperty("how", std::string(check.how));
    RecordProperty("proved", number_or_dash(finding.proved));
  }
};

TEST_P(FormatBounds, Quick) {
  check(true);
}
TEST_P(FormatBounds, Full) {
  check(false);
}
INSTANTIATE_TEST_SUITE_P(Formats_of_preset_exact, FormatBounds, testing::ValuesIn(bounds_of("exact")),
                         name_of);
INSTANTIATE_TEST_SUITE_P(Formats_of_preset_published, FormatBounds, testing::ValuesIn(bounds_of("published")),
                         name_of);

TEST(Checks, EachFormatStatesABoundAndEachCheckHasOne) {
  for (const tables::PresetFormats& preset : presets())
    for (const tables::Format& format : preset.formats)
      EXPECT_FALSE(format.bounds.empty()) << preset.name << ' ' << format.name;
  for (const Check& check : all_checks()) {
    const auto has = [&](const StatedBound& b) { return is_of(check, *b.preset, *b.format, *b.bound); };
    EXPECT_TRUE(std::ranges::any_of(bounds_of("exact"), has) ||
                std::ranges::any_of(bounds_of("published"), has))
        << check.preset << ' ' << check.name << ' ' << check.of;
  }
}

// ---- Tables

// Each kind of table is a test of its own suite, so that it has its own section in the page.
class TableBounds : public testing::TestWithParam<std::vector<TableFinding> (*)(const Context&)> {
 protected:
  void check(bool quick) {
    const std::vector<std::string> columns = {"table", "bound", "found", "of the bound", "where"};
    std::vector<std::vector<std::string>> rows;
    for (const TableFinding& f : GetParam()({quick})) {
      EXPECT_LE(f.derived, f.bound * (1 + c_rounding)) << f.table;
      EXPECT_GE(f.derived, c_derived * f.bound) << f.table;
      EXPECT_LE(f.worst, f.bound) << f.table;
      EXPECT_GE(f.worst, c_tight * f.bound) << f.table << ": nothing comes closer";
      rows.push_back(
          {f.table, number(f.bound), number(f.worst), fmt::format("{:.2f}", f.worst / f.bound), f.where});
    }
    EXPECT_FALSE(rows.empty());
    RecordProperty(std::string(page::c_table), markdown_table(columns, rows));
  }
};

TEST_P(TableBounds, Quick) {
  check(true);
}
TEST_P(TableBounds, Full) {
  check(false);
}
INSTANTIATE_TEST_SUITE_P(Cosine_tables, TableBounds, testing::Values(cosine_tables));
INSTANTIATE_TEST_SUITE_P(Function_tables, TableBounds, testing::Values(function_tables));

}  // namespace
}  // namespace halfway::bounds
