// SPDX-License-Identifier: Apache-2.0
// `halfway tables` as a separate program, for `make tables`. It does not depend on the files that it writes.
#include <CLI/CLI.hpp>

#include "sim/program/program.hpp"

int main(int argc, char** argv) {
  using namespace halfway;
  cli::Folders folders{HALFWAY_SOURCE_DIR};
  CLI::App app{"Halfway's generator of number formats and cosine tables.", "halfway_generator"};
  app.require_subcommand(1);
  app.add_option("--source", folders.source, "the checkout that is written to")->capture_default_str();
  int exit_code = 0;
  cli::add_tables(app, folders, exit_code);
  return cli::run_program(app, argc, argv, exit_code);
}
