// SPDX-License-Identifier: Apache-2.0
#include "evidence/test_rows.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <memory>

#include "sim/os/command_line.hpp"
#include "sim/os/must.hpp"

namespace halfway::page {
namespace {

constexpr std::string_view c_full = "Full/";
constexpr std::string_view c_evidence = "--evidence", c_part = "--part=";

// The name of the test's row; empty if it has none.
std::string row_name(const testing::TestInfo& test) {
  const std::string_view suite = test.test_suite_name(), name = test.name();
  if (!name.starts_with(c_full)) return {};
  return fmt::format("{}/{}", suite.substr(0, suite.find('/')), name.substr(c_full.size()));
}

std::string section_of(std::string_view row_name) {
  std::string section(row_name.substr(0, row_name.find('/')));
  std::ranges::replace(section, '_', ' ');
  return section;
}

// All tests that have rows, by the names of the rows, in order.
std::vector<std::pair<std::string, std::string>> tests_with_rows() {
  std::vector<std::pair<std::string, std::string>> tests;
  const testing::UnitTest& all = *testing::UnitTest::GetInstance();
  for (int i = 0; i < all.total_test_suite_count(); ++i)
    for (int j = 0; j < all.GetTestSuite(i)->total_test_count(); ++j) {
      const testing::TestInfo& test = *all.GetTestSuite(i)->GetTestInfo(j);
      if (std::string name = row_name(test); !name.empty())
        tests.emplace_back(std::move(name), fmt::format("{}.{}", test.test_suite_name(), test.name()));
    }
  return tests;
}

// Adds the row of each test that passes to the journal.
class Recorder : public testing::EmptyTestEventListener {
 public:
  Recorder(const Measured& measured, std::size_t total) : measured_(measured), countdown_(total) {}
  const Status& status() const { return status_; }

  void OnTestEnd(const testing::TestInfo& test) override {
    const std::string name = row_name(test);
    if (name.empty()) return;
    const testing::TestResult& result = *test.result();
    fmt::print("{} {}: {} ({:.1f} s)\n", countdown_.next(), name, result.Passed() ? "holds" : "FAILED",
               static_cast<double>(result.elapsed_time()) / 1000);
    std::fflush(stdout);
    if (!result.Passed()) return;
    if (const Status stored = caught([&] { store(name, result); }); !stored) status_ = stored;
  }

 private:
  void store(const std::string& name, const testing::TestResult& result) const {
    Row row{.name = name, .section = section_of(name)};
    for (int i = 0; i < result.test_property_count(); ++i) {
      const testing::TestProperty& property = result.GetTestProperty(i);
      row.fields.emplace_back(property.key(), property.value());
    }
    if (row.fields.empty()) throw Failure{bad_input(fmt::format("{}: the test records no property", name))};
    measured_.put(row);
  }

  const Measured& measured_;
  Countdown countdown_;
  Status status_ = Ok{};
};

ExitCode measure(Page page, const std::string& part) {
  const auto tests = tests_with_rows();
  for (const auto& [name, test] : tests) page.rows.push_back(name);
  const Measured measured(std::move(page));
  std::string filter;
  std::size_t total = 0;
  for (const auto& [name, test] : tests) {
    if (name.find(part) == std::string::npos || measured.has(name)) continue;
    filter += (filter.empty() ? "" : ":") + test;
    ++total;
  }
  if (total > 0) {
    testing::GTEST_FLAG(filter) = filter;
    auto recorder = std::make_unique<Recorder>(measured, total);
    const Recorder* const observer = recorder.get();
    testing::UnitTest::GetInstance()->listeners().Append(recorder.release());
    const int failed = RUN_ALL_TESTS();
    must(observer->status());
    if (failed != 0) return ExitCode::differs;
  }
  return measured.finish();
}

}  // namespace

int run_tests(int argc, char** argv, Page page) {
  testing::InitGoogleTest(&argc, argv);
  std::vector<std::string> arguments(argv + 1, argv + argc);
  // GoogleTest has printed the help of its own options.
  if (std::erase(arguments, "--help") > 0) {
    fmt::print(
        "\n  --evidence             measure the page of evidence\n"
        "  --evidence --part=TEXT only its rows whose names contain the text\n");
    return 0;
  }
  const bool is_evidence = std::erase(arguments, c_evidence) > 0;
  std::string part;
  if (!arguments.empty() && arguments.front().starts_with(c_part) && is_evidence) {
    part = arguments.front().substr(c_part.size());
    arguments.erase(arguments.begin());
  }
  if (!arguments.empty())
    return cli::report(bad_input(
        fmt::format("{}: unknown argument; give --evidence, with it --part=TEXT, or options of GoogleTest",
                    arguments.front())));
  if (!is_evidence) return RUN_ALL_TESTS();
  const auto end = caught([&] { return measure(std::move(page), part); });
  return end ? static_cast<int>(*end) : cli::report(end.error());
}

}  // namespace halfway::page
