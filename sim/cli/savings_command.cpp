// SPDX-License-Identifier: Apache-2.0
// `halfway savings`: measures the tables of docs/effects.md.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <thread>
#include <vector>

#include "sim/cli/options.hpp"
#include "sim/os/must.hpp"
#include "sim/os/page_part.hpp"
#include "sim/study/savings.hpp"

namespace halfway::cli {
namespace {

void run(const Folders& folders, unsigned threads) {
  const std::vector<Savings> savings =
      measure_savings({folders.source, folders.cache()},
                      threads != 0 ? threads : std::max(1U, std::thread::hardware_concurrency()),
                      [](const std::string& line) {
                        fmt::print("{}", line);
                        std::fflush(stdout);
                      });
  must(rewrite_page(folders.source / "docs/effects.md",
                    [&](const std::string& page) { return with_savings(page, savings); }));
}

}  // namespace

void add_savings(CLI::App& app, const Folders& folders, int&) {
  CLI::App* sub =
      app.add_subcommand("savings", "measure the tables of docs/effects.md again and write them (minutes)");
  const auto threads = std::make_shared<unsigned>(0);
  sub->add_option("--threads", *threads, "threads (0: all cores)")->capture_default_str();
  sub->callback([=, &folders] { run(folders, *threads); });
}

}  // namespace halfway::cli
