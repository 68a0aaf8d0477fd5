// SPDX-License-Identifier: Apache-2.0
// halfway_built_from CHECKOUT FILE: writes the function `built_from` of the program. The build runs it.
#include <fmt/format.h>

#include <cstdio>

#include "sim/generator/word_lengths/format_sources.hpp"
#include "sim/os/file.hpp"

int main(int argc, char** argv) {
  using namespace halfway;
  const auto written = caught([&] {
    if (argc != 3) throw_bad_input("halfway_built_from: takes a checkout and the file to write");
    must(write_file(argv[2], fmt::format("#include \"sim/generator/word_lengths/format_sources.hpp\"\n\n"
                                         "const char* halfway::built_from() {{ return \"{}\"; }}\n",
                                         format_sources_hash(argv[1]))));
  });
  if (written) return 0;
  fmt::print(stderr, "{}\n", written.error().message);
  return static_cast<int>(written.error().code);
}
