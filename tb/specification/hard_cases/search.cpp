// SPDX-License-Identifier: Apache-2.0
#include "specification/hard_cases/search.hpp"

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

std::string Tally::add(const char* quantity, const Worst& of_input) {
  if (of_input.count == 0) return "";
  worst[quantity].add(of_input.figure, of_input.bound, [&] { return of_input.where; });
  if (of_input.within()) return "";
  return fmt::format("{}: {}: {:.4g} of {:.4g}", quantity, of_input.where, of_input.figure, of_input.bound);
}

Result<std::string> rtl_failure(const Trial& trial, std::uint64_t inputs, Tally& tally) {
  if (!trial.tools()) return trial.tools().error();
  tally.rtl_inputs += inputs;
  tally.rtl_fragments += trial.rtl_fragments();
  return trial.failure();
}

}  // namespace halfway::stability
