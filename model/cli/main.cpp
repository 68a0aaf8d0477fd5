// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cstdio>
#include <exception>

#include "cli/options.hpp"

int main(int argc, char** argv) {
  using namespace halfway;
  cli::Folders folders{HALFWAY_SOURCE_DIR};
  CLI::App app{"Halfway: shading hardware between Gouraud and Phong, simulated and checked bit for bit.",
               "halfway"};
  app.require_subcommand(1);
  app.set_version_flag("--version", HALFWAY_VERSION);
  app.footer(
      "Exit codes: 0 all equal, 1 a comparison or check failed, 2 bad usage or input, 3 a tool is missing or "
      "broke.");
  app.add_option("--source", folders.source, "the checkout whose rtl, tb and sim are used")
      ->capture_default_str();
  int exit_code = 0;
  cli::add_sim(app, folders, exit_code);
  cli::add_compare(app, folders, exit_code);
  cli::add_why(app, folders, exit_code);
  cli::add_plan(app, folders, exit_code);
  cli::add_render(app, folders, exit_code);
  cli::add_init(app, folders, exit_code);
  cli::add_tables(app, folders, exit_code);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // help and version, on stdout
    fmt::print(stderr, "halfway: {}; see halfway --help\n", error.what());
    return static_cast<int>(ExitCode::bad_input);
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "halfway: out of memory; a smaller frame or mesh, or fewer threads, may fit\n");
    return static_cast<int>(ExitCode::tool_failed);
  } catch (const std::exception& error) {
    fmt::print(stderr, "halfway: {}; this should not happen, please report it\n", error.what());
    return static_cast<int>(ExitCode::tool_failed);
  }
  return exit_code;
}
