// SPDX-License-Identifier: Apache-2.0
// halfway_synth: cells of the listed designs on the FPGA families by Yosys, their clocks on an iCE40 HX8K by
// nextpnr, and the board's bitstream. Prints them and compares them with tb/evidence/thresholds.toml; with
// --page, writes them into pages.
#include <CLI/CLI.hpp>
#include <filesystem>

#include "pages.hpp"
#include "sim/os/program.hpp"

int main(int argc, char** argv) {
  using namespace halfway;
  synth::Options options;
  CLI::App app{"Cells on two FPGA families, and the clock on an iCE40 HX8K", "halfway_synth"};
  app.require_subcommand(1);
  int exit_code = 0;
  const auto add = [&](const char* name, const char* help, ExitCode (*run)(const synth::Options&)) {
    CLI::App* command = app.add_subcommand(name, help);
    command->add_flag("--page", options.page, "write the page of evidence of this name");
    command->add_option("--source", options.folders.source, "the project's root (the current folder)");
    command->callback([&options, &exit_code, run] {
      options.folders.source = std::filesystem::absolute(options.folders.source);
      options.folders.cache = options.folders.source / "build" / "cache";
      exit_code = static_cast<int>(run(options));
    });
    return command;
  };
  const auto add_designs = [&](CLI::App* command) {
    auto* part = command->add_option("PART", options.part, "only designs whose names contain it");
    auto* quick = command->add_flag("--quick", options.quick, "only small designs; cells: only on the iCE40");
    command->get_option("--page")->excludes(quick)->excludes(part);
    command->add_option("--jobs", options.jobs, "at a time")
        ->check(CLI::Range(1, 999))
        ->capture_default_str();
    return command;
  };
  add_designs(add("cells", "cells on iCE40 and ECP5", synth::cells));
  add_designs(add("clocks", "clocks on an iCE40 HX8K: minutes for each design", synth::clocks))
      ->add_option("--seeds", options.seeds, "of placement (as stored, or 3)")
      ->check(CLI::Range(1, 999));
  add("board", "the board's bitstream and its figures", synth::board);
  return cli::run_program(app, argc, argv, exit_code);
}
