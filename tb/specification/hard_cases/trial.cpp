// SPDX-License-Identifier: Apache-2.0
#include "specification/hard_cases/trial.hpp"

#include <fmt/format.h>

#include <cmath>

#include "golden_run/golden_run.hpp"
#include "sim/driver/limits.hpp"
#include "sim/driver/rtl_frame.hpp"
#include "sim/engines/ghdl/ghdl_engine.hpp"
#include "sim/engines/verilator/verilator_simulator.hpp"

namespace halfway::stability {
namespace {

// What GHDL draws in minutes.
constexpr std::size_t c_most_for_ghdl = 4000;
constexpr unsigned c_most_lights_for_ghdl = 3;

bool is_for_ghdl(const HardwareKey& key, std::size_t fragments) {
  return fragments <= c_most_for_ghdl &&
         (key.shader != Shader::processors || key.processors.lights() <= c_most_lights_for_ghdl);
}

}  // namespace

void Worst::add(double next, double next_bound, const std::function<std::string()>& where_of) {
  ++count;
  // Compares the figures relative to their bounds, without a division by a bound of 0.
  const auto nearer = [&] {
    if (!std::isfinite(figure)) return false;
    if (within() != (next <= next_bound)) return within();
    return !(next * bound <= figure * next_bound) || (bound == 0.0 && !(next <= figure));
  };
  if (count > 1 && !nearer()) return;
  figure = next;
  bound = next_bound;
  where = where_of();
}

std::string refutation(bool is_silent, const Worst& ours, const Worst& published) {
  const auto told = [](const Worst& worst) {
    return fmt::format("{:.4g} of {:.4g} at {}", worst.figure, worst.bound, worst.where);
  };
  if (ours.count == 0) return "has no figure";
  if (!ours.within()) return told(ours);
  if (is_silent)
    return published.count == 0 ? "" : "has a figure of the published form, but is listed without one";
  if (published.count == 0) return "has no figure of the published form";
  return published.within() ? "the published form does not break: " + told(published) : "";
}

Result<Drawing> draw_golden(const Scene& scene, const DrawOptions& options) {
  const auto plan = plan_scene(scene, options.plan);
  if (!plan) return plan.error();
  auto stream = whole_stream(scene, options.frame, plan->key, {.setup = options.setup, .check = false});
  if (!stream) return stream.error();
  return Drawing{std::move(*stream), plan->key};
}

Drawing Trial::draw(const Scene& scene, const DrawOptions& options) {
  Result<Drawing> drawing = draw_golden(scene, options);
  if (!drawing) {
    require(false, [&] { return drawing.error().message; });
    return {};
  }
  if (options.in_rtl) compare_rtl(drawing->key, drawing->words, drawing->golden, drawing->fault);
  return std::move(*drawing);
}

std::vector<Fragment> Trial::draw(const HardwareKey& key, std::span<const std::uint32_t> words) {
  const auto golden = make_golden_model(key);
  std::vector<Fragment> fragments;
  golden->draw(words, fragments);
  compare_rtl(key, words, fragments, golden->fault());
  return fragments;
}

void Trial::compare_rtl(const HardwareKey& key, std::span<const std::uint32_t> words,
                        std::span<const Fragment> golden, bool fault) {
  golden_fragments_ += golden.size();
  if (!tools_ || words.empty()) return;
  tools_ = compare_with(verilated(key), key, words, golden, fault);
  if (!tools_ || quick_ || !is_for_ghdl(key, golden.size()) || !rtl_.through_ghdl.insert(key.name()).second)
    return;
  tools_ = compare_with(shared_engine(GhdlEngine::open(key, folders_, 1, {.idle_limit = idle_limit(key)})),
                        key, words, golden, fault);
}

Status Trial::compare_with(const Result<std::shared_ptr<Engine>>& engine, const HardwareKey& key,
                           std::span<const std::uint32_t> words, std::span<const Fragment> golden,
                           bool fault) {
  if (!engine) return engine.error();
  // Fragments are compared, and not assembled: hand-made vectors draw in the largest frame.
  RtlFrame frame(*engine, {c_max_frame_side, c_max_frame_side}, {}, {.tile = Tile{0, 0, {1, 1}}});
  if (const Status drawn = frame.add(words, golden); !drawn) return drawn;
  if (const Status drawn = frame.finish(); !drawn) return drawn;
  const SimulatorRun run = frame.result();
  rtl_fragments_ += run.fragments;
  require(run.fault.empty() != fault, [&] {
    return fmt::format("{}: {}: {}", key.name(), run.simulator,
                       fault ? "reports no fault, but the golden model does" : run.fault);
  });
  // After a fault the fragments have no meaning.
  require(fault || run.mismatches == 0, [&] { return fmt::format("{}: {}", key.name(), run.description); });
  return Ok{};
}

Result<std::shared_ptr<Engine>> Trial::verilated(const HardwareKey& key) {
  std::shared_ptr<Engine>& opened = rtl_.verilated[key.name()];
  if (!opened) {
    auto engine = shared_engine(VerilatorSimulator::open(key, folders_));
    if (!engine) return engine.error();
    opened = std::move(*engine);
  }
  return opened->another();
}

}  // namespace halfway::stability
