// SPDX-License-Identifier: Apache-2.0
// The command line of every command that draws, one argument per line. It is accepted or refused; accepted
// values are in their ranges.
#include "sim/cli/options.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>
#include <vector>

#include "frame/frame.hpp"
#include "inputs/random/fuzz.hpp"
#include "sim/os/must.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace halfway;
  using namespace halfway::fuzz;
  std::vector<std::string> arguments{""};
  for (const char c : text_of(data, size)) {
    if (c == '\0') return -1;  // an argument cannot contain this character
    if (c == '\n')
      arguments.emplace_back();
    else
      arguments.back() += c;
  }
  // CLI11 expects the arguments in reverse order.
  std::reverse(arguments.begin(), arguments.end());
  CLI::App app{"", "halfway"};
  cli::DrawOptions options;
  std::string scene;
  std::vector<std::string> simulators;
  app.add_option("scene", scene);
  app.add_option("--simulator", simulators);
  options.add_to(app);
  try {
    app.parse(arguments);
  } catch (const CLI::ParseError&) {
    return 0;
  }
  (void)cli::result_name(scene);
  if (const auto chosen = caught([&] { return cli::checked_simulators(simulators); }); !chosen)
    demand(chosen.error().code == ExitCode::bad_input && !chosen.error().message.empty(), "exit code 2");
  const auto checked = caught([&] { return cli::checked(options); });
  if (!checked) {
    demand(checked.error().code == ExitCode::bad_input && !checked.error().message.empty(), "exit code 2");
    return 0;
  }
  demand(checked->size.width >= 1 && checked->size.width <= c_max_frame_side && checked->size.height >= 1 &&
             checked->size.height <= c_max_frame_side,
         "a size from 1x1 to 4096x4096");
  demand(checked->threads >= 1 && checked->threads <= 1024, "1 to 1024 threads");
  demand(checked->setup.quadratic.max_level >= 0 && checked->setup.quadratic.max_level <= 5, "levels");
  demand(checked->setup.quadratic.threshold >= 0.0 && checked->setup.spherical.threshold >= 0.0, "threshold");
  demand(!checked->out.empty(), "a folder's name");
  return 0;
}
