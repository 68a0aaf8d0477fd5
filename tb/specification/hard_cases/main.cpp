// SPDX-License-Identifier: Apache-2.0
// halfway_stability: the hard cases. Each full sweep is a row of docs/results/hard_cases.md.
#include "evidence/test_rows.hpp"

int main(int argc, char** argv) {
  using namespace halfway;
  return page::run_tests(argc, argv,
                         {.name = "hard_cases",
                          .root = HALFWAY_SOURCE_DIR,
                          .file = "docs/results/hard_cases.md",
                          .tools = {"ghdl", "verilator"},
                          .rows = {}});
}
