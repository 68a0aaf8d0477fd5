// SPDX-License-Identifier: Apache-2.0
// halfway_bounds: checks the bounds that formats and tables state. Each check of all arguments has a row of
// evidence.
#include "evidence/inputs.hpp"
#include "evidence/test_rows.hpp"

int main(int argc, char** argv) {
  using namespace halfway;
  const std::filesystem::path root = HALFWAY_SOURCE_DIR;
  const auto common = [&] {
    constexpr std::string_view c_tools[] = {"gappa", "sollya"};
    return evidence::program_hash(c_tools, root, HALFWAY_FOLDERS);
  };
  return evidence::run_tests(
      argc, argv,
      {.place = {.root = root, .rows = "tb/bounds/evidence.txt", .page = "docs/results/bounds.md"},
       .common = common,
       .of_details = [](const std::string& details) { return Result<std::string>(details); }});
}
