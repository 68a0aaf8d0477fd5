// SPDX-License-Identifier: Apache-2.0
#include "measure.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdio>
#include <mutex>

#include "sim/os/command_line.hpp"
#include "sim/os/threads.hpp"

namespace halfway::synth {
namespace {

using page::Row;

// Measure the items and print a line for each. `take` is called for one item at a time.
void measure_all(const std::vector<Item>& items, unsigned jobs,
                 const std::function<void(std::size_t, const Row&)>& take) {
  page::Countdown countdown(items.size());
  std::mutex mutex;
  must_for_each(jobs, items.size(), [&](std::size_t i) {
    const Row row = items[i].measure();
    std::vector<std::string> texts;
    for (const auto& [column, text] : row.fields) texts.push_back(fmt::format("{} {}", column, text));
    const std::lock_guard lock(mutex);
    fmt::print("{} {}\n", countdown.next(), fmt::join(texts, ", "));
    std::fflush(stdout);
    take(i, row);
  });
}

ExitCode print(const Options& options, const Evidence& evidence, const std::vector<Item>& items) {
  std::vector<Row> rows(items.size());
  measure_all(items, options.jobs, [&](std::size_t i, const Row& row) { rows[i] = row; });
  for (const page::Section& section : page::sections_of(rows)) fmt::print("\n{}\n", section.body);
  const auto thresholds = page::Thresholds::read(options.folders.source);
  ExitCode end = ExitCode::equal;
  for (const page::Value& value : page::judged_here(thresholds, evidence.values(rows)))
    for (const std::string& broken : thresholds.broken(value)) {
      cli::say(broken);
      end = ExitCode::differs;
    }
  return end;
}

}  // namespace

ExitCode measure(const Options& options, const Evidence& evidence, std::vector<Item> items) {
  if (!options.page) return print(options, evidence, items);
  page::Page page{.name = evidence.name,
                  .root = options.folders.source,
                  .file = c_page,
                  .tools = evidence.tools,
                  .rows = {}};
  page.values = evidence.values;
  for (const Item& item : items) page.rows.push_back(item.name);
  const page::Measured journal(std::move(page));
  std::erase_if(items, [&](const Item& item) { return journal.has(item.name); });
  measure_all(items, options.jobs, [&](std::size_t, const Row& row) { journal.put(row); });
  return journal.finish();
}

}  // namespace halfway::synth
