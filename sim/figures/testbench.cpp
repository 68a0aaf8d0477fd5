// SPDX-License-Identifier: Apache-2.0
#include "sim/figures/testbench.hpp"

#include "sim/system/subprocess.hpp"

namespace halfway::figures {

std::string run_testbench(const Context& context, const std::string& top, std::vector<VhdlSource> sources,
                          const std::vector<std::string>& testbench_files,
                          const std::vector<std::string>& options) {
  const GhdlTool tool = must(GhdlTool::find());
  for (const std::string& name : testbench_files)
    sources.push_back(must(read_vhdl_source(context.folders.source, name)));
  const GhdlLibrary library = must(GhdlLibrary::open(tool, sources, top, context.folders.cache));
  Command command{.arguments = library.run_arguments(top), .working_folder = library.folder()};
  command.arguments.insert(command.arguments.end(), options.begin(), options.end());
  for (const char* checks : {"--ieee-asserts=disable", "--assert-level=error"})
    command.arguments.emplace_back(checks);
  const ProcessEnd end = must(run_process(command, c_install_ghdl));
  if (!end.succeeded())
    throw Failure{{ExitCode::differs, fmt::format("{}: {}\n{}", top, end.how(), end.output)}};
  return end.output;
}

}  // namespace halfway::figures
