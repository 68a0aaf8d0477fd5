// SPDX-License-Identifier: Apache-2.0
// Errors as exceptions, for long measurements that end at the first error. must() throws; one place catches.
#pragma once

#include <utility>

#include "common/result.hpp"

namespace halfway {

struct Failure {
  Error error;
};

/// Return the value, or throw Failure on an error.
template <class T>
T must(Result<T> result) {
  if (!result) throw Failure{result.error()};
  return std::move(*result);
}

}  // namespace halfway
