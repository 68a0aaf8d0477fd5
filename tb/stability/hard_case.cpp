// SPDX-License-Identifier: Apache-2.0
#include "stability/hard_case.hpp"

#include <fmt/format.h>

namespace halfway::stability {

std::unique_ptr<Simulators> HardCases::s_simulators;

namespace {

// Empty if the case has no ill-conditioned figures.
std::string without_ill_conditioned(const HardCase& c, const Trial& trial) {
  const Worst &ours = trial.ours(), &rest = trial.well_conditioned();
  if (rest.count == ours.count) return "";
  return fmt::format("; {:.3g} of {:.3g} without the {} of {} figures whose bound is above {:g}", rest.figure,
                     rest.bound, ours.count - rest.count, ours.count, c.conditioned);
}

}  // namespace

void HardCases::sweep(bool quick) {
  const HardCase& c = GetParam();
  Trial trial({HALFWAY_SOURCE_DIR, HALFWAY_CACHE_DIR}, *s_simulators, quick, c.conditioned);
  c.sweep(trial);
  ASSERT_TRUE(trial.tools()) << trial.tools().error().message;
  EXPECT_EQ(trial.failure(), "");
  const Worst &ours = trial.ours(), &published = trial.published();
  EXPECT_EQ(refutation(c.published, ours, published), "") << "in " << c.unit;

  RecordProperty("case", std::string(c.name));
  RecordProperty("breaks", std::string(c.breaks));
  RecordProperty("remedy", std::string(c.remedy));
  RecordProperty("holds", std::string(c.holds));
  RecordProperty("published",
                 c.published == PublishedForm::silent ? "–" : fmt::format("{:.3g}", published.figure));
  RecordProperty("ours", fmt::format("{:.3g} of {:.3g} {}", ours.figure, ours.bound, c.unit) +
                             without_ill_conditioned(c, trial) +
                             (trial.remark().empty() ? "" : "; " + trial.remark()));
  RecordProperty("figures", fmt::format("{}", ours.count + published.count));
  RecordProperty("fragments in golden, RTL",
                 fmt::format("{}, {}", trial.golden_fragments(), trial.rtl_fragments()));
}

TEST_P(HardCases, Quick) {
  sweep(true);
}

TEST_P(HardCases, Full) {
  sweep(false);
}

}  // namespace halfway::stability
