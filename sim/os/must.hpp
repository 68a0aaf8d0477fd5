// SPDX-License-Identifier: Apache-2.0
// Errors as exceptions, for work that ends at the first error: must() throws, and run_program() reports. Code
// that a browser runs, or that is called through a C interface, returns errors instead.
#pragma once

#include <fmt/format.h>

#include <exception>
#include <type_traits>
#include <utility>

#include "common/result.hpp"

namespace halfway {

struct Failure : std::exception {
  explicit Failure(Error thrown) : error(std::move(thrown)) {}
  const char* what() const noexcept override { return error.message.c_str(); }
  Error error;
};

/// Throw Failure: the fault is in the input, or a tool is missing or broke. The message is made by
/// fmt::format.
template <class... Values>
[[noreturn]] void throw_bad_input(fmt::format_string<Values...> message, Values&&... values) {
  throw Failure{bad_input(fmt::format(message, std::forward<Values>(values)...))};
}
template <class... Values>
[[noreturn]] void throw_tool_failed(fmt::format_string<Values...> message, Values&&... values) {
  throw Failure{tool_failed(fmt::format(message, std::forward<Values>(values)...))};
}

/// Return the value, or throw Failure on an error.
template <class T>
T must(Result<T> result) {
  if (!result) throw Failure{result.error()};
  return std::move(*result);
}

/// Call the work; a Failure becomes an error.
template <class Work>
auto caught(const Work& work) {
  using Value = std::invoke_result_t<Work>;
  using Caught = Result<std::conditional_t<std::is_void_v<Value>, Ok, Value>>;
  try {
    if constexpr (std::is_void_v<Value>) {
      work();
      return Caught(Ok{});
    } else {
      return Caught(work());
    }
  } catch (const Failure& failure) {
    return Caught(failure.error);
  }
}

}  // namespace halfway
