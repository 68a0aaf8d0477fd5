// SPDX-License-Identifier: Apache-2.0
#include "stability/search.hpp"

#include <fmt/format.h>

namespace halfway::stability {

void Tally::add(const Tally& other) {
  inputs += other.inputs;
  fragments += other.fragments;
  rtl_inputs += other.rtl_inputs;
  rtl_fragments += other.rtl_fragments;
  for (const auto& [quantity, theirs] : other.worst) {
    Worst& ours = worst[quantity];
    const std::uint64_t count = ours.count + theirs.count;
    ours.add(theirs.figure, theirs.bound, [&where = theirs.where] { return where; });
    ours.count = count;
  }
}

void InputFigures::add(const char* quantity, const Worst& worst) {
  if (worst.count == 0) return;
  tally_.worst[quantity].add(worst.figure, worst.bound, [&] { return worst.where; });
  if (!worst.within() && !failure_)
    failure_ = {quantity, fmt::format("{}: {:.4g} of {:.4g}", worst.where, worst.figure, worst.bound)};
}

Result<std::optional<Failure>> rtl_failure(const Trial& trial, std::uint64_t inputs, Tally& tally) {
  if (!trial.tools()) return trial.tools().error();
  tally.rtl_inputs += inputs;
  tally.rtl_fragments += trial.rtl_fragments();
  if (trial.failure().empty()) return std::optional<Failure>{};
  return std::optional(Failure{"rtl", trial.failure()});
}

}  // namespace halfway::stability
