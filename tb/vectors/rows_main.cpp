// SPDX-License-Identifier: Apache-2.0
// halfway_row_testbenches SOURCE FOLDER: writes FOLDER/ENTITY_tb.vhd for the entities of
// tb/vectors/rows.toml.
#include <fmt/format.h>

#include <cstdio>

#include "sim/os/file.hpp"
#include "sim/os/must.hpp"
#include "vectors/rows.hpp"

int main(int argc, char** argv) {
  using namespace halfway;
  if (argc != 3) {
    fmt::print(stderr, "usage: halfway_row_testbenches SOURCE FOLDER\n");
    return static_cast<int>(ExitCode::bad_input);
  }
  const std::filesystem::path folder = argv[2];
  const auto written = caught([&] {
    must(make_folders(folder));
    for (const auto& [entity, text] : rows::testbenches(argv[1]))
      must(write_file(folder / (entity + "_tb.vhd"), text));
  });
  if (written) return static_cast<int>(ExitCode::equal);
  fmt::print(stderr, "{}\n", written.error().message);
  return static_cast<int>(written.error().code);
}
