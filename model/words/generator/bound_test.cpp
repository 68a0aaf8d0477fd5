// SPDX-License-Identifier: Apache-2.0
// Tests formulas. tb/specification/bounds compares each stated bound with the result of its derivation.
#include "words/generator/bound.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "words/generator/formats.hpp"

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

}  // namespace
}  // namespace halfway::tables
