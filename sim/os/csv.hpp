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
  std::vector<std::vector<std::string>> rows;  ///< each row has as many values as `columns`

  /// Empty if the column does not exist.
  const std::string& text(std::size_t row, const std::string& column) const;
  /// std::nullopt if the value is empty or not a finite number.
  std::optional<double> number(std::size_t row, const std::string& column) const;
};

/// A value may be enclosed in double quotes. It may then contain commas, and a quote in it is written twice.
/// Lines end with '\n' or '\r\n'. An error names the file and the line.
Result<Table> read_csv(const std::filesystem::path& path);
/// Inverse of `read_csv`.
std::string to_csv(const Table& table);

}  // namespace halfway
