// SPDX-License-Identifier: Apache-2.0
// Reduces a failing input to a simplest one that still fails, and stores such inputs in small text files.
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

/// Takes steps to simpler inputs while they fail: each parameter alone towards its simplest value, and the
/// inputs of `simpler`. The result fails, and no single step from it fails (unless the options end the search
/// earlier).
Input shrink(std::span<const Parameter> parameters, Input input,
             const std::function<bool(const Input&)>& fails,
             const std::function<std::vector<Input>(const Input&)>& simpler,
             const ShrinkOptions& options = {});

/// An input as a file: the name of the search, then one line `name value` for each parameter that is not at
/// its simplest value. Lines that start with # are comments.
struct Regression {
  std::string search{};
  Input input{};
};
std::string write_regression(std::string_view search, std::span<const Parameter> parameters,
                             const Input& input, std::string_view comment);
/// `parameters_of`: the parameters of the search of that name; empty if there is no such search. `file` is
/// used in error messages.
Result<Regression> read_regression(
    std::string_view file, std::string_view text,
    const std::function<std::span<const Parameter>(std::string_view)>& parameters_of);

}  // namespace halfway::stability
