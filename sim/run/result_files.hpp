// SPDX-License-Identifier: Apache-2.0
// Paths of the results of a scene and a shader.
#pragma once

#include <filesystem>
#include <string>

#include "plan/plan.hpp"

namespace halfway {

/// The files that a run writes to <out>/<scene>/<shader>/. With all effects the folder is
/// <shader>-all-effects/, so that both can be compared.
struct ResultFiles {
  std::filesystem::path folder;

  static ResultFiles of(const std::filesystem::path& out, const std::string& scene, const PlanRequest& plan) {
    std::string hardware = to_string(plan.shader);
    if (plan.all_effects) hardware += "-all-effects";
    return {out / scene / hardware};
  }
  std::filesystem::path init() const { return folder / "init.txt"; }
  std::filesystem::path trace(const std::string& who) const { return folder / (who + ".trace"); }
  std::filesystem::path frame(const std::string& who) const { return folder / (who + ".png"); }
  std::filesystem::path summary() const { return folder / "summary.json"; }
};

}  // namespace halfway
