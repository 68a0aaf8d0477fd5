// SPDX-License-Identifier: Apache-2.0
// A CSV file as rows of named values.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/result.hpp"

namespace halfway {

struct Table {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;  ///< each as long as `columns`

  /// Empty where there is no such column.
  const std::string& text(std::size_t row, const std::string& column) const;
  /// None where it is empty or no finite number.
  std::optional<double> number(std::size_t row, const std::string& column) const;
};

/// Values may stand between double quotes, and hold commas then; a quote in them is two. Lines end in one
/// '\n' or '\r\n'. An error names file and line.
Result<Table> read_csv(const std::filesystem::path& path);
/// What `read_csv` reads as the same table.
std::string to_csv(const Table& table);

}  // namespace halfway
