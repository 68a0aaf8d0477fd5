// SPDX-License-Identifier: Apache-2.0
#include "evidence/test_rows.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <vector>

#include "sim/program/program.hpp"
#include "sim/system/file.hpp"
#include "sim/system/threads.hpp"

namespace halfway::evidence {
namespace {

constexpr std::string_view c_full = "Full/";
constexpr unsigned c_threads = 2;

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

Result<std::string> hash_of(const TestRows& rows, const std::string& common, const std::string& details) {
  const auto inputs = details.empty() ? Result<std::string>(std::string()) : rows.of_details(details);
  if (!inputs) return inputs.error();
  return ContentHash().add("test 1").add(common).add(*inputs).hex();
}

// Stores the row of each test that passes.
class Recorder : public testing::EmptyTestEventListener {
 public:
  Recorder(const TestRows& rows, const Evidence& evidence, std::string common, std::size_t total)
      : rows_(rows), evidence_(evidence), common_(std::move(common)), total_(total) {}
  const Status& status() const { return status_; }

  void OnTestEnd(const testing::TestInfo& test) override {
    const std::string name = row_name(test);
    if (name.empty()) return;
    const testing::TestResult& result = *test.result();
    fmt::print("[{}/{}] {}: {} ({:.1f} s)\n", ++done_, total_, name, result.Passed() ? "holds" : "FAILED",
               static_cast<double>(result.elapsed_time()) / 1000);
    std::fflush(stdout);
    if (const Status stored = result.Passed() ? store(name, result) : evidence_.remove(name); !stored)
      status_ = stored;
  }

 private:
  Status store(const std::string& name, const testing::TestResult& result) const {
    Row row{.name = name, .section = section_of(name)};
    for (int i = 0; i < result.test_property_count(); ++i) {
      const testing::TestProperty& property = result.GetTestProperty(i);
      if (property.key() == c_details_property)
        row.details = property.value();
      else
        row.fields.emplace_back(property.key(), property.value());
    }
    if (row.fields.empty()) return bad_input(fmt::format("{}: the test records no property", name));
    auto hash = hash_of(rows_, common_, row.details);
    if (!hash) return hash.error();
    row.hash = std::move(*hash);
    return evidence_.put(std::move(row));
  }

  const TestRows& rows_;
  const Evidence& evidence_;
  std::string common_;
  std::size_t total_, done_ = 0;
  Status status_ = Ok{};
};

Result<ExitCode> run_rows(const TestRows& rows, Mode mode, const std::string& part) {
  const auto common = rows.common();
  if (!common) return common.error();
  const auto before = read_rows(rows.place.root / rows.place.rows);
  if (!before) return before.error();
  const auto tests = tests_with_rows();
  const auto is_selected = [&](const std::string& name) { return name.find(part) != std::string::npos; };
  std::vector<Today> today;
  for (const auto& [name, test] : tests) today.push_back({.name = name, .section = section_of(name)});
  const Status hashed = for_each_on_threads(c_threads, today.size(), [&](std::size_t i) -> Status {
    const auto row = std::ranges::find(*before, today[i].name, &Row::name);
    if (mode == Mode::all || row == before->end() || !is_selected(row->name)) return Ok{};
    auto hash = hash_of(rows, *common, row->details);
    if (!hash) return hash.error();
    today[i].hash = std::move(*hash);
    return Ok{};
  });
  if (!hashed) return hashed.error();
  const auto evidence = Evidence::open(rows.place, std::move(today));
  if (!evidence) return evidence.error();
  if (mode == Mode::check) return report(*evidence);
  // Without a row, the hash is empty, and the row is stale.
  std::string filter;
  std::size_t total = 0;
  for (const auto& [name, test] : tests) {
    if (!is_selected(name) || (mode == Mode::stale && !evidence->is_stale(name))) continue;
    filter += (filter.empty() ? "" : ":") + test;
    ++total;
  }
  ExitCode end = ExitCode::equal;
  if (total > 0) {
    testing::GTEST_FLAG(filter) = filter;
    auto recorder = std::make_unique<Recorder>(rows, *evidence, *common, total);
    Recorder* const observer = recorder.get();
    testing::UnitTest::GetInstance()->listeners().Append(recorder.release());
    end = RUN_ALL_TESTS() == 0 ? ExitCode::equal : ExitCode::differs;
    if (!observer->status()) return observer->status().error();
  }
  if (const Status finished = evidence->finish(); !finished) return finished.error();
  return end;
}

// Takes `--NAME=value` from the arguments.
std::string take_option(std::vector<std::string>& arguments, const std::string& name) {
  const std::string begin = "--" + name + "=";
  std::string value;
  std::erase_if(arguments, [&](const std::string& argument) {
    if (!argument.starts_with(begin)) return false;
    value = argument.substr(begin.size());
    return true;
  });
  return value;
}

}  // namespace

int run_tests(int argc, char** argv, const TestRows& rows) {
  testing::InitGoogleTest(&argc, argv);
  std::vector<std::string> arguments(argv + 1, argv + argc);
  const std::string mode = take_option(arguments, "evidence"), part = take_option(arguments, "part");
  if (!arguments.empty() || !(mode.empty() || modes().contains(mode)))
    return cli::report(
        bad_input(fmt::format("{}: unknown argument; give --evidence=all|stale|check, --part=TEXT "
                              "or options of GoogleTest",
                              arguments.empty() ? mode : arguments.front())));
  if (mode.empty()) return RUN_ALL_TESTS();
  const auto end = run_rows(rows, modes().at(mode), part);
  return end ? static_cast<int>(*end) : cli::report(end.error());
}

}  // namespace halfway::evidence
