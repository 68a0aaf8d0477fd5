// SPDX-License-Identifier: Apache-2.0
// halfway_stability: the hard cases. Each full sweep is a row of docs/results/hard_cases.md.
#include "specification/hard_cases/hard_case.hpp"

#include <fmt/format.h>

#include <limits>

#include "evidence/test_rows.hpp"
#include "sim/os/toml_file.hpp"

namespace halfway::stability {

std::unique_ptr<Simulators> HardCases::s_simulators;

namespace {

const toml::table& all_cases() {
  static const toml::table c_all = read_toml(HALFWAY_SOURCE_DIR "/tb/specification/hard_cases/cases.toml");
  return c_all;
}

// A case in cases.toml, with what its family states.
class Statement {
 public:
  explicit Statement(std::string_view id) {
    const std::string_view suite = testing::UnitTest::GetInstance()->current_test_suite()->name();
    family_ = all_cases()[suite.substr(0, suite.find('/'))];
    case_ = family_[id];
  }
  std::string text(std::string_view key) const {
    const std::string text = case_[key].value_or(family_[key].value_or(std::string()));
    EXPECT_NE(text, "") << "cases.toml: no " << key;
    return text;
  }
  bool is_silent() const { return case_["published"].value_or(std::string()) == "silent"; }
  double conditioned() const {
    return case_["conditioned"].value_or(std::numeric_limits<double>::infinity());
  }

 private:
  toml::node_view<const toml::node> family_, case_;
};

// Empty if the case has no ill-conditioned figures.
std::string without_ill_conditioned(double conditioned, const Trial& trial) {
  const Worst &ours = trial.ours(), &rest = trial.well_conditioned();
  if (rest.count == ours.count) return "";
  return fmt::format("; {:.3g} of {:.3g} without the {} of {} figures whose bound is above {:g}", rest.figure,
                     rest.bound, ours.count - rest.count, ours.count, conditioned);
}

}  // namespace

void HardCases::sweep(bool quick) {
  const Statement statement(GetParam().id);
  const bool silent = statement.is_silent();
  Trial trial({HALFWAY_SOURCE_DIR, HALFWAY_CACHE_DIR}, *s_simulators, quick, statement.conditioned());
  GetParam().sweep(trial);
  ASSERT_TRUE(trial.tools()) << trial.tools().error().message;
  EXPECT_EQ(trial.failure(), "");
  const Worst &ours = trial.ours(), &published = trial.published();
  EXPECT_EQ(refutation(silent, ours, published), "") << "in " << statement.text("unit");

  RecordProperty("case", statement.text("name"));
  for (const char* key : {"breaks", "remedy", "holds"}) RecordProperty(key, statement.text(key));
  RecordProperty("published", silent ? "–" : fmt::format("{:.3g}", published.figure));
  RecordProperty("ours", fmt::format("{:.3g} of {:.3g} {}", ours.figure, ours.bound, statement.text("unit")) +
                             without_ill_conditioned(statement.conditioned(), trial) +
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

TEST(Cases, HaveSweeps) {
  std::size_t stated = 0, swept = 0;
  for (const auto& [family, cases] : all_cases())
    for (const auto& [id, one] : *cases.as_table()) stated += one.is_table();
  const testing::UnitTest& all = *testing::UnitTest::GetInstance();
  for (int i = 0; i < all.total_test_suite_count(); ++i)
    for (int j = 0; j < all.GetTestSuite(i)->total_test_count(); ++j)
      swept += std::string_view(all.GetTestSuite(i)->GetTestInfo(j)->name()).starts_with("Full/");
  EXPECT_EQ(stated, swept);
}

}  // namespace halfway::stability

int main(int argc, char** argv) {
  using namespace halfway;
  return page::run_tests(argc, argv,
                         {.name = "hard_cases",
                          .root = HALFWAY_SOURCE_DIR,
                          .file = "docs/results/hard_cases.md",
                          .tools = {"ghdl", "verilator"},
                          .rows = {}});
}
