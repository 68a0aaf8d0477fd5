// SPDX-License-Identifier: Apache-2.0
// halfway_synth: cells of the listed designs on the FPGA families by Yosys, their clocks by nextpnr, and the
// board's bitstream. Prints them and compares them with tb/evidence/thresholds.toml; with
// --page, writes them into pages.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "measure.hpp"
#include "sim/os/command_line.hpp"

int main(int argc, char** argv) {
  using namespace halfway;
  synth::Options options;
  CLI::App app{"Cells and clocks on two FPGA families", "halfway_synth"};
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
    command->add_option("PART", options.part,
                        "only designs whose names contain it; with --page, others keep their stored values");
    auto* quick = command->add_flag("--quick", options.quick, "only small designs; cells: only on the iCE40");
    command->get_option("--page")->excludes(quick);
    command->add_option("--jobs", options.jobs, "at a time")
        ->check(CLI::Range(1, 999))
        ->capture_default_str();
    return command;
  };
  CLI::App* cells = add_designs(add("cells", "cells on iCE40 and ECP5", synth::cells));
  cells->get_option("--page")->excludes(cells->get_option("PART"));
  CLI::App* clocks = add_designs(
      add("clocks", "clocks on an iCE40 HX8K and an ECP5 LFE5U-85F: minutes for each design", synth::clocks));
  clocks->add_option("--seeds", options.seeds, "of placement (as stored, or 3)")->check(CLI::Range(1, 999));
  auto* device =
      clocks
          ->add_option("--device", options.device, "hx8k, or ecp5, with thresholds for complete shaders only")
          ->check(CLI::IsMember(synth::device_options()));
  clocks->get_option("--page")->excludes(device);
  clocks->add_flag("--again", options.again,
                   "place hardware that has a stored clock, too: the flow has changed");
  add("board", "the board's bitstream and its figures", synth::board);
  return cli::run_program(app, argc, argv, exit_code);
}
