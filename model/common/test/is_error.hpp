// SPDX-License-Identifier: Apache-2.0
// For tests: expected errors.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include "common/result.hpp"

namespace halfway {

/// True if the result is an error, and if `part` is a part of its message.
template <class T>
testing::AssertionResult is_error(const Result<T>& result, std::string_view part) {
  if (result) return testing::AssertionFailure() << "no error";
  return testing::AssertionResult(result.error().message.find(part) != std::string::npos)
         << "'" << part << "' is not in the message '" << result.error().message << "'";
}

/// The error has this code, too.
template <class T>
testing::AssertionResult is_error(const Result<T>& result, ExitCode code, std::string_view part = "") {
  if (!result && result.error().code != code)
    return testing::AssertionFailure() << "the code is " << static_cast<int>(result.error().code)
                                       << ", the message '" << result.error().message << "'";
  return is_error(result, part);
}

}  // namespace halfway
