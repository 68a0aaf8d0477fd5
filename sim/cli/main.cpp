// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <system_error>

#include "sim/cli/options.hpp"

namespace {

/// The checkout of this program: the one it lies in, as build/halfway, or the one it was compiled in.
std::filesystem::path own_checkout() {
  std::error_code error;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", error);
  const auto checkout = program.parent_path().parent_path();
  return exists(checkout / "rtl" / "files.f", error) ? checkout : std::filesystem::path(HALFWAY_SOURCE_DIR);
}

}  // namespace

int main(int argc, char** argv) {
  using namespace halfway;
  cli::Folders folders{own_checkout()};
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
  cli::add_view(app, folders, exit_code);
#ifdef HALFWAY_EXTRAS
  cli::add_live(app, folders, exit_code);
#endif
  cli::add_compare(app, folders, exit_code);
  cli::add_why(app, folders, exit_code);
#ifdef HALFWAY_EXTRAS
  cli::add_board_sim(app, folders, exit_code);
  cli::add_core_sim(app, folders, exit_code);
#endif
  cli::add_plan(app, folders, exit_code);
  cli::add_savings(app, folders, exit_code);
  cli::add_study(app, folders, exit_code);
  cli::add_report(app, folders, exit_code);
  cli::add_render(app, folders, exit_code);
  cli::add_init(app, folders, exit_code);
  cli::add_verilog(app, folders, exit_code);
  cli::add_tables(app, folders, exit_code);
  cli::add_figures(app, folders, exit_code);
  return cli::run_program(app, argc, argv, exit_code);
}
