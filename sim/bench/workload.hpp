// SPDX-License-Identifier: Apache-2.0
// Workloads of `make bench`: streams of init vectors with the golden model's fragments, a whole frame from
// the mesh to the picture, and counts of a walk over small triangles.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "common/result.hpp"
#include "frame/fragment.hpp"
#include "frame/frame_size.hpp"
#include "golden_run/walk_counts.hpp"
#include "plan/plan.hpp"
#include "scene/scene.hpp"
#include "sim/engine/engine.hpp"

namespace halfway {

/// A sphere of approximately this number of triangles with one light. The fitted camera sees all of it.
Scene sphere_scene(std::uint64_t triangles);
/// Spheres of about 1000 triangles, one for each thousand requested, at 12 by 12 places of a square frame.
/// All triangles have similar shapes and cover similar numbers of pixels.
Scene many_spheres(std::uint64_t triangles);
/// Replaces the scene's lights by 1 to 16 equal directional lights, together as bright as the original ones.
Scene with_lights(Scene scene, unsigned lights);

/// A scene's init vectors and the golden model's fragments for them.
struct InitBatches {
  HardwareKey key;
  unsigned init_bits = 0;
  std::vector<std::uint32_t> words;
  std::vector<Fragment> golden;
  std::vector<std::size_t> batches;  ///< in vectors; whole triangles, at least c_batch except for the last
  std::size_t words_per_vector() const { return (init_bits + 31) / 32; }
  std::size_t vectors() const { return words.size() / words_per_vector(); }
};
inline constexpr std::size_t c_batch = 512;

/// If not `draw`, the result contains no fragments.
Result<InitBatches> make_batches(const Scene& scene, FrameSize size, const PlanRequest& plan,
                                 bool draw = true);

/// Processor seconds of the parts of a frame, and its counts.
struct FrameCost {
  double setup = 0, golden = 0, rtl = 0, compare = 0, assemble = 0;
  std::uint64_t triangles = 0;  ///< of the mesh
  std::uint64_t vectors = 0;    ///< init vectors that start a triangle on the screen
  std::uint64_t records = 0;    ///< line records
  std::uint64_t fragments = 0;
  std::uint64_t mismatches = 0;    ///< between golden model and RTL
  double pace = 0, best_pace = 0;  ///< seconds for drawing `pace` between the batches: mean, minimum
  std::uint64_t memory_bytes = 0;  ///< peak memory, without scene and program
  double drawing() const { return golden + rtl + compare + assemble; }
  double seconds() const { return setup + drawing(); }
};

/// Draws a frame on one thread in a new process: setup, golden model, RTL, comparison of every field and
/// assembly to a picture. `make_scene` is called in that process; its time is not included. Between the
/// batches the golden model draws `pace`. This work is always the same, so its time shows the speed of the
/// machine during the measurement.
Result<FrameCost> draw_frame(const std::function<Scene()>& make_scene, FrameSize size, const HardwareKey& key,
                             const std::shared_ptr<Engine>& engine, const InitBatches& pace);

/// Frames per second of elapsed time: whole frames as in draw_frame, each on one thread, on as many threads
/// as there are engines. Each thread first draws one frame that is not timed.
Result<double> frame_rate(const Scene& scene, FrameSize size, const HardwareKey& key,
                          std::span<const std::shared_ptr<Engine>> engines, std::size_t frames);

/// For vectors of preset exact without shadows.
WalkCounts count_walk(const InitBatches& batches);

/// A linear model: t is the sum of a row's terms, each multiplied by its factor.
using Terms = std::vector<double>;
struct Fit {
  Terms factors;                 ///< empty if the rows do not determine them
  double largest_deviation = 0;  ///< largest |t / sum - 1|
  double at(const Terms& row) const;
};
/// Minimizes the squares of the relative deviations.
Fit fit(const std::vector<Terms>& rows, std::span<const double> t);

}  // namespace halfway
