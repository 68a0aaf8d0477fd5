// SPDX-License-Identifier: Apache-2.0
// halfway_bounds: checks the bounds that formats and tables state. Each check of all arguments has a row of
// evidence.
#include "evidence/inputs.hpp"
#include "evidence/test_rows.hpp"
#include "sim/system/file.hpp"

int main(int argc, char** argv) {
  using namespace halfway;
  const std::filesystem::path root = HALFWAY_SOURCE_DIR;
  const auto common = [&]() -> Result<std::string> {
    constexpr std::string_view c_tools[] = {"gappa", "sollya"};
    const auto versions = evidence::versions(c_tools);
    if (!versions) return versions.error();
    const auto sources = evidence::sources_hash(root, HALFWAY_FOLDERS);
    if (!sources) return sources.error();
    return ContentHash().add(*versions).add(*sources).hex();
  };
  return evidence::run_tests(
      argc, argv,
      {.place = {.root = root, .rows = "tb/bounds/evidence.txt", .page = "docs/results/bounds.md"},
       .common = common,
       .of_details = [](const std::string& details) { return Result<std::string>(details); }});
}
