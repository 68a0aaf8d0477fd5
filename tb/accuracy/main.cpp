// SPDX-License-Identifier: Apache-2.0
// halfway_accuracy: measures the tables of docs/accuracy.md.
#include "accuracy/row.hpp"
#include "page/test_rows.hpp"

namespace halfway::accuracy {
namespace {

// The largest error of each frame or fit, in steps of the colour.
std::vector<page::Value> values_of(std::span<const page::Row> rows) {
  std::vector<page::Value> values;
  for (const page::Row& row : rows)
    for (const auto& [column, text] : row.fields)
      if (column.starts_with("largest error")) values.push_back({"accuracy", row.name, {std::stod(text)}});
  return values;
}

}  // namespace
}  // namespace halfway::accuracy

int main(int argc, char** argv) {
  using namespace halfway;
  return page::run_tests(argc, argv,
                         {.name = "accuracy",
                          .root = accuracy::folders().source,
                          .file = "docs/accuracy.md",
                          .tools = {"ghdl", "verilator", "yosys"},
                          .rows = {},
                          .values = accuracy::values_of});
}
