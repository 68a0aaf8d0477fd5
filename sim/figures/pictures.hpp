// SPDX-License-Identifier: Apache-2.0
// The pictures of figures: scenes to draw, hardware to draw them, and sheets of several.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

#include "common/result.hpp"
#include "frame/frame.hpp"
#include "frame/metrics.hpp"
#include "plan/plan.hpp"
#include "reference/renderer.hpp"
#include "scene/mesh.hpp"
#include "scene/scene.hpp"
#include "setup/setup.hpp"
#include "sim/figures/figure.hpp"

namespace halfway::figures {

/// The mesh alone under one white directional light, seen whole from `to_eye_world`.
Scene scene_of(Mesh mesh, const Material& material, const glm::dvec3& to_eye_world);

/// A sphere of the quadratic paper's figures 9 to 11, or any other, with a highlight.
Scene sphere_scene(std::uint32_t slices, std::uint32_t stacks, double exponent);

/// The papers' chicken is not to be had: ours, and the teapot.
Scene hen_scene();
Scene teapot_scene(const Context& context);

/// A scene's triangles, its Phong shading per pixel, and Gouraud's, at one size.
struct Software {
  std::vector<ScreenTriangle> triangles;
  ReferenceImage phong, gouraud;
};
Software draw_in_software(const Scene& scene, FrameSize size, unsigned threads);

struct Hardware {
  Frame frame;
  std::uint64_t fragments = 0;
  std::uint64_t cycles = 0;  ///< 0 where the golden model drew
  HardwareKey key;
  SetupCounts counts;
};
/// By the RTL in Verilator, each fragment compared with the golden model's: a difference throws Failure. With
/// Context::quick by the golden model alone.
Hardware draw_in_hardware(const Context& context, const Scene& scene, FrameSize size, const PlanRequest& plan,
                          const SetupOptions& options = {});

/// The mesh's edges, hidden ones left out.
Frame draw_mesh(const Scene& scene, FrameSize size, unsigned threads);

/// Frames of one size, so many beside one another, on white.
Frame sheet(std::span<const Frame> frames, std::uint32_t columns);

/// Writes NAME.png into the context's folder and notes it in the drawing.
void save_picture(const Context& context, const std::string& name, const Frame& frame, std::string alt,
                  Drawing& drawing);

/// Over the pixels of the mask; the sizes must agree.
FrameDistance distance(const Frame& frame, const Frame& other, std::span<const std::uint8_t> mask);
/// "66/255 at most, 32.8 dB"
std::string shown(const FrameDistance& distance);

/// Pictures are compared at this size, whatever the size shown.
inline constexpr FrameSize c_compared_size{640, 480};

/// How alike two pictures look: of the mask's pixels, per cent, those whose difference in brightness is seen
/// (perception.hpp); and the distance.
struct Likeness {
  double seen_percent = 0.0;
  FrameDistance distance;
  /// "0.02 % of the pixels seen to differ; 31/255 at most, 51.9 dB"
  Measured measured() const;
};
Likeness likeness(const Frame& frame, const Frame& other, std::span<const std::uint8_t> mask);

}  // namespace halfway::figures
