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

/// The init words of a quadratic shader. Degree 1 draws the plane through the samples at the vertices.
struct QuadraticStream {
  std::vector<std::uint32_t>& words;
  int channels;
  int degree = 2;
};

/// A screen triangle of preset exact, or a piece of one.
struct ExactPiece {
  std::uint32_t triangle;             ///< its number
  std::array<ScreenPoint, 3> points;  ///< in 1/2^unit_bits pixels
  int unit_bits;
  std::span<const Walk> walks;
  const DepthFit& depth;  ///< may be the plane of a larger triangle
  ChannelSamples samples;
};
/// Appends one vector per walk.
void append_exact(const QuadraticStream& to, const ExactPiece& piece);

/// Preset published: appends one vector per half. Returns their number.
std::size_t append_published(const QuadraticStream& to, std::uint32_t triangle,
                             const std::array<HalfVertex, 3>& vertices, const ChannelSamples& samples);

/// Hardware of degree 1 draws planes through the samples at the three vertices, as in Gouraud's shading.
/// Preset exact with the conservative or the proved test draws small leaves pixel by pixel (PixelFit), in
/// both degrees, so that the colour of every pixel is the reference's, rounded. With degree 2 all other
/// leaves are drawn by the quadratic through six samples.
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
