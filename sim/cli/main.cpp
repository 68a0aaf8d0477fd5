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
  // In the order of the help.
  for (cli::AddCommand* add :
       {cli::add_sim, cli::add_view,
#ifdef HALFWAY_EXTRAS
        cli::add_live,
#endif
        cli::add_compare, cli::add_why,
#ifdef HALFWAY_EXTRAS
        cli::add_board_sim, cli::add_core_sim,
#endif
        cli::add_plan, cli::add_savings, cli::add_study, cli::add_report, cli::add_render, cli::add_init,
        cli::add_verilog, cli::add_tables, cli::add_figures})
    add(app, folders, exit_code);
  return cli::run_program(app, argc, argv, exit_code);
}
