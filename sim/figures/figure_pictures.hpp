// SPDX-License-Identifier: Apache-2.0
// Pictures for figures: scenes, hardware that draws them, sheets of several frames, and plots.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

#include "frame/frame.hpp"
#include "frame/metrics.hpp"
#include "plan/plan.hpp"
#include "reference/renderer.hpp"
#include "scene/mesh.hpp"
#include "scene/scene.hpp"
#include "sim/figures/figure.hpp"
#include "sim/files/gnuplot.hpp"
#include "sim/run/verilator_frame.hpp"

namespace halfway::figures {

/// The mesh under one white directional light. The whole mesh is visible from the direction `to_eye_world`.
Scene scene_of(Mesh mesh, const Material& material, const glm::dvec3& to_eye_world);

/// A sphere with a highlight, as in the quadratic paper's figures 9 to 11.
Scene sphere_scene(std::uint32_t slices, std::uint32_t stacks, double exponent);

/// Our chicken and the teapot; the papers' chicken is not available.
Scene hen_scene();
Scene teapot_scene(const Context& context);

/// A scene's triangles, with Phong shading per pixel and Gouraud shading, at one size.
struct Software {
  std::vector<ScreenTriangle> triangles;
  ReferenceImage phong, gouraud;
};
Software draw_in_software(const Scene& scene, FrameSize size, unsigned threads);

/// A frame and the hardware that drew it. `cycles` is 0 if the golden model drew.
struct Hardware : VerilatorFrame {
  HardwareKey key;
};
/// Draw by the RTL in Verilator. Each fragment is compared with the golden model's; a difference throws
/// Failure. With Context::quick, draw by the golden model only. With ProcessorsSetupOptions::normalize, the
/// hardware has the units that normalize N.
Hardware draw_in_hardware(const Context& context, const Scene& scene, FrameSize size, const PlanRequest& plan,
                          const SetupOptions& options = {});

/// The mesh's edges without hidden lines.
Frame draw_mesh(const Scene& scene, FrameSize size, unsigned threads);

/// Frames of equal size in the given number of columns, on white.
Frame sheet(std::span<const Frame> frames, std::uint32_t columns);

/// Write NAME.png into the context's folder and register it in the drawing.
void save_picture(const Context& context, const std::string& name, const Frame& frame, std::string alt,
                  Drawing& drawing);

/// Over the pixels of the mask. All sizes must be equal.
FrameDistance distance(const Frame& frame, const Frame& other, std::span<const std::uint8_t> mask);
/// For example "66/255 at most, 32.8 dB".
std::string shown(const FrameDistance& distance);

/// Pictures are compared at this size, independent of the size shown.
inline constexpr FrameSize c_compared_size{640, 480};

/// Visual similarity of two pictures: percentage of the mask's pixels with a visible difference in brightness
/// (flip.hpp), and the distance.
struct Likeness {
  double seen_percent = 0.0;
  FrameDistance distance;
  /// For example "0.02 % of the pixels seen to differ; 31/255 at most, 51.9 dB".
  Measured measured() const;
};
Likeness likeness(const Frame& frame, const Frame& other, std::span<const std::uint8_t> mask);

/// A plot as SVG.
struct Plot {
  std::string title;    ///< title of the SVG, and text on the page
  std::string words{};  ///< alternative text; may be empty
  std::string script;   ///< for gnuplot, from plot_style on
};

/// "$name << EOD", rows of numbers, "EOD".
std::string data_block(const std::string& name, std::span<const std::vector<double>> rows);

/// Write NAME.svg and its script into the context's folder, and register the picture in the drawing. Throws
/// Failure without gnuplot.
void draw_plot(const Context& context, const std::string& name, const Plot& plot, Drawing& drawing);

}  // namespace halfway::figures
