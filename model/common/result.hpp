// SPDX-License-Identifier: Apache-2.0
// Errors as values. An error holds a message and the exit code with which the program ends.
#pragma once

#include <string>
#include <utility>
#include <variant>

namespace halfway {

/// Exit codes of the process.
enum class ExitCode { equal = 0, differs = 1, bad_input = 2, tool_failed = 3 };

struct Error {
  ExitCode code = ExitCode::bad_input;
  std::string message;  ///< "file:line: the fault, and how to mend it"
};

inline Error bad_input(std::string message) {
  return {ExitCode::bad_input, std::move(message)};
}
inline Error tool_failed(std::string message) {
  return {ExitCode::tool_failed, std::move(message)};
}

/// A value, or the error because of which there is no value.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
  Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}

  explicit operator bool() const { return state_.index() == 0; }
  T& operator*() { return std::get<0>(state_); }
  const T& operator*() const { return std::get<0>(state_); }
  T* operator->() { return &std::get<0>(state_); }
  const T* operator->() const { return &std::get<0>(state_); }
  const Error& error() const { return std::get<1>(state_); }

 private:
  std::variant<T, Error> state_;
};

struct Ok {};
using Status = Result<Ok>;

}  // namespace halfway
