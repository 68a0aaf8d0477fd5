// SPDX-License-Identifier: Apache-2.0
#include "sim/extras/bench/measurements.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <random>

#include "sim/files/load_scene.hpp"
#include "sim/os/seconds.hpp"

namespace halfway {

Scene builtin(const char* name) {
  return must(load_scene(name, c_source / "sim" / "scenes"));
}

std::string figure(double value) {
  if (value == 0) return "0";
  return fmt::format("{:.{}f}", value, value >= 100 ? 0 : value >= 10 ? 1 : 2);
}

double median(std::vector<double> all) {
  std::ranges::sort(all);
  const std::size_t half = all.size() / 2;
  return all.size() % 2 != 0 ? all[half] : 0.5 * (all[half - 1] + all[half]);
}

Measurements::Measurements()
    : work_(golden_stream(builtin("spheres"), {560, 420}, {.shader = Shader::quadratic})),
      golden_(make_golden_model(work_.key)) {}

double Measurements::take_pace() {
  constexpr int c_times = 4;
  const double start = process_seconds();
  for (int i = 0; i < c_times; ++i) golden_->draw(work_.words);
  const double pace = (process_seconds() - start) / c_times;
  best_pace_ = std::min(best_pace_, pace);
  return pace;
}

void Measurements::add(const std::string& name, int repetitions, std::function<double()> go) {
  all_[name] = {std::move(go), repetitions};
}

void Measurements::run() {
  std::vector<std::pair<const std::string, Measured>*> order;
  for (auto& each : all_) order.insert(order.end(), static_cast<std::size_t>(each.second.repetitions), &each);
  std::ranges::shuffle(order, std::mt19937(1));
  std::size_t done = 0;
  for (auto* each : order) {
    auto& [name, measured] = *each;
    const double before = take_pace(), seconds = measured.go(), after = take_pace();
    measured.paces.push_back(seconds / (0.5 * (before + after)));
    fmt::print(stderr, "{} of {}: {}: {:.4g} s\n", ++done, order.size(), name, seconds);
  }
}

std::optional<double> Measurements::seconds(const std::string& name) const {
  const auto found = all_.find(name);
  return found == all_.end() ? std::nullopt : std::optional(median(found->second.paces) * best_pace_);
}

}  // namespace halfway
