// SPDX-License-Identifier: Apache-2.0
// From an input that fails to a simplest one that still does; and such an input as a small text file.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "common/result.hpp"
#include "stability/search.hpp"

namespace halfway::stability {

struct ShrinkOptions {
  std::uint64_t most_tries = 20'000;
  double most_seconds = 300.0;
};

/// Takes steps to simpler inputs as long as they fail: each parameter by itself towards its simplest value,
/// and what `simpler` offers. The result fails, and no single step from it does (unless the options end it).
Input shrink(std::span<const Parameter> parameters, Input input,
             const std::function<bool(const Input&)>& fails,
             const std::function<std::vector<Input>(const Input&)>& simpler,
             const ShrinkOptions& options = {});

/// An input as a file: the search's name, then a line `name value` for each parameter that is not at its
/// simplest. Lines that begin with # are for readers.
struct Regression {
  std::string search{};
  Input input{};
};
std::string write_regression(std::string_view search, std::span<const Parameter> parameters,
                             const Input& input, std::string_view comment);
/// `parameters_of`: of the search of that name; none: there is no such search. `file` is for errors.
Result<Regression> read_regression(
    std::string_view file, std::string_view text,
    const std::function<std::span<const Parameter>(std::string_view)>& parameters_of);

}  // namespace halfway::stability
