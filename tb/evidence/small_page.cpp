// SPDX-License-Identifier: Apache-2.0
// A page of three rows for evidence.sh, in the checkout whose root is the current folder. Row `b` waits for
// the file build/go; row `c` is the number in the file build/c.
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

#include "evidence/test_rows.hpp"

namespace halfway::page {
namespace {

void record(const char* name, double value) {
  testing::Test::RecordProperty("item", name);
  testing::Test::RecordProperty("value", std::to_string(value));
  std::ofstream("build/measured", std::ios::app) << name << '\n';
}

class Item : public testing::TestWithParam<const char*> {};

TEST_P(Item, Full) {
  const std::string name = GetParam();
  if (name == "b")
    while (!std::filesystem::exists("build/go")) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  double value = 1;
  if (name == "c") std::ifstream("build/c") >> value;
  ASSERT_GE(value, 0);
  record(name.c_str(), value);
}

INSTANTIATE_TEST_SUITE_P(items, Item, testing::Values("a", "b", "c"),
                         [](const auto& item) { return std::string(item.param); });

std::vector<Value> values_of(std::span<const Row> rows) {
  std::vector<Value> values;
  for (const Row& row : rows) values.push_back({"items", row.field("item"), {std::stod(row.field("value"))}});
  return values;
}

}  // namespace
}  // namespace halfway::page

int main(int argc, char** argv) {
  using namespace halfway;
  return page::run_tests(argc, argv,
                         {.name = "small",
                          .root = ".",
                          .file = "page.md",
                          .tools = {"git"},
                          .rows = {},
                          .values = page::values_of});
}
