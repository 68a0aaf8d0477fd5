// SPDX-License-Identifier: Apache-2.0
// Measures the rows of a page of evidence. A journal in build/evidence/COMMIT keeps the rows that are
// measured, so that a killed run continues. When all rows are there, the page is written and judged by the
// thresholds.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/result.hpp"
#include "evidence/page.hpp"
#include "evidence/thresholds.hpp"

namespace halfway::page {

/// The last commit that changed what a measurement reads: everything but Markdown files, docs/results and the
/// thresholds. Throws Failure if such files have changes that are not committed.
std::string measured_commit(const std::filesystem::path& root);

/// The first lines that the tools print for their versions. Failure names the package that is missing.
std::string versions(std::span<const std::string_view> tools);

/// Date, tools and machine, for Origin::text.
std::string origin_text(std::span<const std::string_view> tools);

struct Page {
  std::string name;  ///< in `make evidence PAGE=...`
  std::filesystem::path root;
  std::string file;                     ///< Markdown, relative to the root
  std::vector<std::string_view> tools;  ///< whose versions the page names
  std::vector<std::string> rows;        ///< names of all its rows, in their order on the page
  std::function<std::vector<Section>(std::span<const Row>)> sections = sections_of;
  /// The values of the rows that thresholds judge.
  std::function<std::vector<Value>(std::span<const Row>)> values = [](auto) { return std::vector<Value>(); };
};

class Measured {
 public:
  /// Reads the journal. Throws Failure if the checkout has changes, or if a row's name occurs twice.
  explicit Measured(Page page);

  /// Whether the row was measured before.
  bool has(std::string_view name) const;
  /// Add a row to the journal. Other threads and processes may do the same at the same time.
  void put(const Row& row) const;
  /// If all rows are measured: write the page, unless it has them and is of this commit, print each broken
  /// threshold and return `differs` if there is one. Else print how many rows are missing.
  ExitCode finish() const;

 private:
  std::filesystem::path journal() const;
  std::vector<Row> read_journal() const;  ///< rows of the page, in order

  Page page_;
  std::string commit_;
  std::vector<std::string> before_;  ///< names of the rows in the journal at the start
};

/// Progress of a number of items: "[3/20, about 4 min left]".
class Countdown {
 public:
  explicit Countdown(std::size_t total) : total_(total) {}
  std::string next();  ///< after each item

 private:
  std::size_t total_, done_ = 0;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace halfway::page
