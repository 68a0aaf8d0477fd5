// SPDX-License-Identifier: Apache-2.0
// What `make bench` measures: streams of init vectors with the golden model's fragments, a whole frame from
// the mesh to the picture, and what a walk over small triangles is made of.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "common/result.hpp"
#include "frame/fragment.hpp"
#include "frame/frame_size.hpp"
#include "plan/plan.hpp"
#include "scene/scene.hpp"
#include "sim/engine/engine.hpp"

namespace halfway {

/// A sphere of about so many triangles in one light, seen whole by a camera that fits it.
Scene sphere_scene(std::uint64_t triangles);
/// Spheres of about 1000 triangles, one for each thousand asked for, on 12 by 12 places of a square frame:
/// all triangles of one kind, and as many pixels each.
Scene many_spheres(std::uint64_t triangles);
/// The scene under this many equal directional lights in place of its own, 1 to 16, as bright together.
Scene with_lights(Scene scene, unsigned lights);

/// A scene's init vectors and the golden model's fragments for them.
struct InitBatches {
  HardwareKey key;
  unsigned init_bits = 0;
  std::vector<std::uint32_t> words;
  std::vector<Fragment> golden;
  std::vector<std::size_t> batches;  ///< in vectors; whole triangles, at least c_batch but for the last
  std::size_t words_per_vector() const { return (init_bits + 31) / 32; }
  std::size_t vectors() const { return words.size() / words_per_vector(); }
};
inline constexpr std::size_t c_batch = 512;

/// Without fragments where they are not to be drawn.
Result<InitBatches> make_batches(const Scene& scene, FrameSize size, const PlanRequest& plan,
                                 bool draw = true);

/// Processor seconds of the parts of a frame, and what it took beside them.
struct FrameCost {
  double setup = 0, golden = 0, rtl = 0, compare = 0, assemble = 0;
  std::uint64_t triangles = 0;  ///< of the mesh
  std::uint64_t vectors = 0;    ///< init vectors that begin a triangle on the screen
  std::uint64_t records = 0;    ///< line records
  std::uint64_t fragments = 0;
  std::uint64_t mismatches = 0;    ///< between golden model and RTL
  double pace = 0, best_pace = 0;  ///< seconds that the pace takes between the batches: on average, at best
  std::uint64_t memory_bytes = 0;  ///< the most beside scene and program at a time
  double drawing() const { return golden + rtl + compare + assemble; }
  double seconds() const { return setup + drawing(); }
};

/// A frame on one thread in a process of its own: triangles set up, drawn by golden model and RTL, compared
/// in every field and assembled to a picture. `make_scene` is called there, too, and its time not counted.
/// `pace` is drawn by its golden model between the batches: the same work all the time, by which one can
/// tell how quick the machine was meanwhile.
Result<FrameCost> draw_frame(const std::function<Scene()>& make_scene, FrameSize size, const HardwareKey& key,
                             const std::shared_ptr<Engine>& engine, const InitBatches& pace);

/// What the walker of preset exact makes of the vectors: the same for every shader that has it.
struct WalkCounts {
  std::uint64_t headers = 0, lines = 0, empty_lines = 0, spans = 0, pixels = 0;
  /// With a line in a clock, beside the pixels of the span before it: the clocks in which no pixel is walked.
  std::uint64_t lost_to_lines = 0;
  /// Those that come on top: a header's two clocks before line records, the second clock of a triangle with a
  /// single line elsewhere.
  std::uint64_t lost_to_headers = 0;
};
/// Of preset exact, without shadows.
WalkCounts count_walk(const InitBatches& batches);

/// t = the sum of a row's terms, each by its factor.
using Terms = std::vector<double>;
struct Fit {
  Terms factors;                 ///< none where the rows do not tell them
  double largest_deviation = 0;  ///< of t beside the sum, as a part of it
  double at(const Terms& row) const;
};
/// With the least squares of relative deviations.
Fit fit(const std::vector<Terms>& rows, std::span<const double> t);

}  // namespace halfway
