// SPDX-License-Identifier: Apache-2.0
// Errors as exceptions, for long measurements that the first error ends: thrown by must(), caught in one
// place.
#pragma once

#include <utility>

#include "common/result.hpp"

namespace halfway {

struct Failure {
  Error error;
};

/// The value; throws Failure where there is an error.
template <class T>
T must(Result<T> result) {
  if (!result) throw Failure{result.error()};
  return std::move(*result);
}

}  // namespace halfway
