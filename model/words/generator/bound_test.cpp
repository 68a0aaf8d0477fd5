// SPDX-License-Identifier: Apache-2.0
// Tests formulas, and compares each stated bound with the result of its derivation: it may be slightly
// larger.
#include "words/generator/bound.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "words/generator/formats.hpp"
#include "words/generator/functions.hpp"

namespace halfway::tables {
namespace {

TEST(Bound, FormulasAreReadAsTheyAreWritten) {
  const Quantity quantities[] = {{"k", 4095}, {"u", 0x1p-20}, {"u_long_name", 7}};
  const auto value = [&](std::string_view formula) { return evaluated(formula, quantities); };
  EXPECT_EQ(value("2 + 3 * 4"), 14);
  EXPECT_EQ(value("(2 + 3) * 4"), 20);
  EXPECT_EQ(value("12 / 4 / 3"), 1);
  EXPECT_EQ(value("12 - 4 - 3"), 5);
  EXPECT_EQ(value("2^3^2"), 512);
  EXPECT_EQ(value("-2^2"), -4);
  EXPECT_EQ(value("2^-15"), 0x1p-15);
  EXPECT_EQ(value("1.5 * 10^2"), 150);
  EXPECT_EQ(value("sqrt(16) * u_long_name"), 28);
  EXPECT_EQ(value("(1 + k + k * (k - 1) / 2) * u / 2"), (1 + 4095 + 4095 * 4094 * 0.5) * 0x1p-21);
}

TEST(Bound, InvalidFormulasAreRefused) {
  const Quantity quantities[] = {{"k", 1}};
  for (const std::string_view formula :
       {"", "1 +", "(1", "1)", "1 2", "m", "kk", "sqrt 4", "sqrt(4", "2 ** 3", "#", "1 + $"})
    EXPECT_THROW(evaluated(formula, quantities), std::logic_error) << formula;
}

TEST(Bound, IsPrintedInOneLine) {
  EXPECT_EQ(to_string(at_most(4095, "frame - 1")), "at most 4095: frame - 1");
  EXPECT_EQ(to_string(at_most(1, "1")), "at most 1");
  EXPECT_EQ(to_string(off_by(0.15, "colour steps", "k * u")), "off by at most 0.15 colour steps: k * u");
  EXPECT_EQ(to_string(off_by(0x1p-17, "", "u / 2", "diffuse")), "diffuse: off by at most 2^-17: u / 2");
}

// The derivation must be at least 0.8 of the bound: otherwise the bound is too wide.
void expect_near(double stated, double derived, const std::string& name) {
  EXPECT_LE(derived, stated * (1 + 1e-9)) << name;
  EXPECT_GE(derived, stated * 0.8) << name;
}

TEST(Bound, EveryFormatsBoundMatchesItsDerivation) {
  for (const PresetFormats& preset : preset_formats())
    for (const Format& format : preset.formats) {
      const std::string name = std::string(preset.name) + " " + std::string(format.name);
      EXPECT_FALSE(format.bounds.empty()) << name;
      for (const Bound& bound : format.bounds) expect_near(bound.value, derived(preset, format, bound), name);
    }
}

TEST(Bound, EveryFunctionTableHasABound) {
  for (const FunctionTable& table : function_tables())
    expect_near(table.error.value, derived(table), "a table");
}

TEST(Bound, OneBitLessViolatesARoundingBound) {
  for (PresetFormats preset : preset_formats())
    for (Format& format : preset.formats) {
      --format.fraction_bits;
      for (const Bound& bound : format.bounds)
        if (bound.derivation.find("u / 2") != std::string_view::npos && bound.of != "power" &&
            bound.of != "length") {
          EXPECT_GT(derived(preset, format, bound), bound.value)
              << preset.name << ' ' << format.name << ' ' << bound.of;
        }
      ++format.fraction_bits;
    }
}

}  // namespace
}  // namespace halfway::tables
