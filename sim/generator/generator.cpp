// SPDX-License-Identifier: Apache-2.0
// `halfway tables` as a separate program, for `make tables`; the build makes the C++ headers by its command
// `headers`. It does not depend on the files that it writes.
#include <CLI/CLI.hpp>

#include "sim/generator/generated_files.hpp"
#include "sim/os/command_line.hpp"
#include "sim/os/must.hpp"

int main(int argc, char** argv) {
  using namespace halfway;
  cli::Folders folders{HALFWAY_SOURCE_DIR};
  CLI::App app{"Halfway's generator of number formats and cosine tables.", "halfway_generator"};
  app.require_subcommand(1);
  app.add_option("--source", folders.source, "the checkout that is written to")->capture_default_str();
  int exit_code = 0;
  cli::add_tables(app, folders, exit_code);
  std::filesystem::path out;
  CLI::App* headers = app.add_subcommand("headers", "write the headers of formats, tables and registers");
  headers->add_option("FOLDER", out, "folder that is written to")->required();
  headers->callback([&] {
    auto files = tables::cpp_headers(tables::sizes_of(folders.source));
    files.push_back(tables::registers_header(folders.source));
    must(tables::write_files(out, files));
  });
  return cli::run_program(app, argc, argv, exit_code);
}
