// SPDX-License-Identifier: Apache-2.0
// Setup of the quadratic shader: converts the scene's triangles to init vectors.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "plan/hardware_key.hpp"
#include "projection/project.hpp"
#include "scene/lights.hpp"
#include "scene/scene.hpp"
#include "setup/half_triangle.hpp"
#include "setup/quadratic_fit.hpp"
#include "setup/setup.hpp"
#include "setup/walk.hpp"

namespace halfway {

/// Samples of each channel, in colour steps, 0 to c_largest_sample: at the three vertices, then at the
/// midpoints of edges 1-2, 1-3, 2-3.
using ChannelSamples = std::array<std::array<double, 6>, 3>;

/// Appends the vectors of preset exact that draw a screen triangle or a piece of one, one vector per walk.
/// Points are in 1/2^unit_bits pixels. `depth` may be the plane of a larger triangle. Degree 1 is the plane
/// through the samples at the vertices.
void append_vectors(std::vector<std::uint32_t>& words, int channels, std::uint32_t triangle,
                    std::span<const Walk> walks, const std::array<ScreenPoint, 3>& points, int unit_bits,
                    const DepthFit& depth, const ChannelSamples& samples, int degree = 2);

/// The same for preset published, one vector per half. Returns the number of vectors.
std::size_t append_vectors(std::vector<std::uint32_t>& words, int channels, std::uint32_t triangle,
                           const std::array<HalfVertex, 3>& vertices, const ChannelSamples& samples,
                           int degree = 2);

/// Hardware of degree 1 draws planes through the samples at the three vertices, as in Gouraud's shading.
/// With degree 2, preset exact with the conservative test draws small leaves pixel by pixel (PixelFit), so
/// that the colour of every pixel is the reference's, rounded. All other leaves are drawn by the quadratic
/// through six samples.
class QuadraticSetup final : public Setup {
 public:
  /// The scene must outlive the setup.
  QuadraticSetup(const Scene& scene, FrameSize frame, const HardwareKey& key, QuadraticSetupOptions options);

  unsigned init_bits() const override { return init_bits_; }
  std::uint32_t units() const override { return static_cast<std::uint32_t>(scene_->triangles.size()); }
  Tile reach(std::uint32_t triangle) const override { return projector_.reach(triangle); }
  std::unique_ptr<SetupWorker> worker() const override;

 private:
  class Worker;
  class ExactTriangle;
  bool needs_midpoints() const { return degree_ == 2 || options_.test != HighlightTest::none; }

  const Scene* scene_;
  std::vector<Light> lights_;
  FrameSize frame_;
  Preset preset_;
  int channels_, degree_;
  unsigned init_bits_;
  QuadraticSetupOptions options_;
  bool small_by_pixel_;  ///< small leaves are drawn by PixelFit
  Projector projector_;
};

}  // namespace halfway
