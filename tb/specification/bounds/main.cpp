// SPDX-License-Identifier: Apache-2.0
// halfway_bounds: checks the bounds that formats and tables state. Each check of all arguments is a row of
// docs/results/bounds.md.
#include "evidence/test_rows.hpp"

int main(int argc, char** argv) {
  using namespace halfway;
  return page::run_tests(argc, argv,
                         {.name = "bounds",
                          .root = HALFWAY_SOURCE_DIR,
                          .file = "docs/results/bounds.md",
                          .tools = {"gappa"},
                          .rows = {}});
}
