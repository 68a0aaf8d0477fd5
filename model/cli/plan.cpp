// SPDX-License-Identifier: Apache-2.0
// `halfway plan`: which hardware a scene calls for, and why.
#include "plan/plan.hpp"

#include <fmt/format.h>

#include "cli/options.hpp"
#include "plan/hardware_units.hpp"
#include "scene/load_scene.hpp"

namespace halfway::cli {
namespace {

int run(const Folders& folders, const std::string& name, const DrawOptions& options) {
  const auto draw = checked(options);
  if (!draw) return report(draw.error());
  const auto scene = load_scene(name, folders.scenes());
  if (!scene) return report(scene.error());
  const auto planned = plan_scene(*scene, draw->plan);
  if (!planned) return report(planned.error());
  const Plan& plan = *planned;
  fmt::print("scene {}, shader {}: hardware {}\n\n", scene->name, options.shader, plan.key.name());
  for (const PlannedEffect& effect : plan.effects)
    fmt::print("  {:<16} {:<4} {}\n", effect.name, effect.called_for ? "yes" : "no", effect.why);
  fmt::print("\n");
  for (const auto& [unit, count] : hardware_units(plan.key)) fmt::print("  {:>3} {}\n", count, unit);
  return 0;
}

}  // namespace

void add_plan(CLI::App& app, const Folders& folders, int& exit_code) {
  CLI::App* command = app.add_subcommand("plan", "the hardware that a scene calls for, and why");
  auto name = std::make_shared<std::string>();
  auto options = std::make_shared<DrawOptions>();
  command->add_option("scene", *name, "as for sim")->required();
  options->add_to(*command);
  command->callback([=, &folders, &exit_code] { exit_code = run(folders, *name, *options); });
}

}  // namespace halfway::cli
