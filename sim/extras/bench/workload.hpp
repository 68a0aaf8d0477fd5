// SPDX-License-Identifier: Apache-2.0
// Workloads of `make bench`: streams of init vectors with the golden model's fragments, and a whole frame
// from the scene to the picture.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "frame/frame_size.hpp"
#include "plan/plan.hpp"
#include "scene/scene.hpp"
#include "sim/driver/engine.hpp"
#include "sim/driver/frame_driver.hpp"

namespace halfway {

/// A sphere of approximately this number of triangles with one light. The fitted camera sees all of it.
Scene sphere_scene(std::uint64_t triangles);

/// A scene's init vectors and the golden model's fragments for them.
struct GoldenStream : FrameStream {
  HardwareKey key;
};
GoldenStream golden_stream(const Scene& scene, FrameSize size, const PlanRequest& plan);

/// Draws frames of a scene on one thread: set-up, golden model, RTL, comparison of every field and assembly
/// of the picture. All frames use the same memory. What a host computes once per scene is not measured.
class WholeFrame {
 public:
  /// The scene must outlive the object.
  WholeFrame(const Scene& scene, FrameSize size, const HardwareKey& key, std::shared_ptr<Engine> engine);
  /// Throws Failure if a fragment differs.
  FrameSeconds draw();

 private:
  std::unique_ptr<FrameDriver> driver_;
};

/// Frames per second of elapsed time, each thread drawing with one of the objects. Each thread first draws
/// one frame that is not timed.
double frame_rate(std::span<WholeFrame> drawings, std::size_t frames);

}  // namespace halfway
