// SPDX-License-Identifier: Apache-2.0
// Rows of evidence that GoogleTests measure: one per test `FAMILY/SUITE.Full/NAME`, called `FAMILY/NAME`. The
// section is the family. The properties that the test records are the columns.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "evidence/evidence.hpp"

namespace halfway::evidence {

/// A test records this property for the details of its row.
inline constexpr std::string_view c_details_property = "details of the row";

struct TestRows {
  Place place;
  /// Hash of everything that all tests depend on.
  std::function<Result<std::string>()> common;
  /// Hash of what the details of a row name. Called by several threads.
  std::function<Result<std::string>(const std::string& details)> of_details;
};

/// Run the tests of the program. `--evidence=all|stale|check` stores or checks rows, and `--part=TEXT`
/// selects rows with this text in their names. Without `--evidence`, nothing is stored.
int run_tests(int argc, char** argv, const TestRows& rows);

}  // namespace halfway::evidence
