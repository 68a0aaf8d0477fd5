// SPDX-License-Identifier: Apache-2.0
// `halfway savings`: measures the tables of docs/effects.md.
#include "sim/costs/savings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <thread>
#include <vector>

#include "sim/cli/options.hpp"
#include "sim/system/file.hpp"
#include "sim/system/page_part.hpp"

namespace halfway::cli {
namespace {

struct SavingsCommand {
  unsigned threads = 0;
  bool draw = false;
};

Result<std::vector<Savings>> savings_of(const Folders& folders, const SavingsCommand& command) {
  const std::filesystem::path csv = folders.source / c_savings;
  if (command.draw) return read_savings(csv);
  auto savings = measure_savings(
      {folders.source, folders.cache()},
      command.threads != 0 ? command.threads : std::max(1U, std::thread::hardware_concurrency()),
      [](const std::string& line) {
        fmt::print("{}", line);
        std::fflush(stdout);
      });
  if (!savings) return savings.error();
  if (const Status written = write_file(csv, to_csv(*savings)); !written) return written.error();
  return savings;
}

int run(const Folders& folders, const SavingsCommand& command) {
  const auto savings = savings_of(folders, command);
  if (!savings) return report(savings.error());
  const Status written = rewrite_page(folders.source / "docs/effects.md",
                                      [&](const std::string& page) { return with_savings(page, *savings); });
  return written ? 0 : report(written.error());
}

}  // namespace

void add_savings(CLI::App& app, const Folders& folders, int& exit_code) {
  CLI::App* sub =
      app.add_subcommand("savings", "measure the tables of docs/effects.md again and write them (minutes)");
  const auto command = std::make_shared<SavingsCommand>();
  sub->add_option("--threads", command->threads, "threads (0: all cores)")->capture_default_str();
  sub->add_flag("--draw", command->draw, fmt::format("do not measure; write the figures of {}", c_savings));
  sub->callback([=, &folders, &exit_code] { exit_code = run(folders, *command); });
}

}  // namespace halfway::cli
