// SPDX-License-Identifier: Apache-2.0
// Setup of the quadratic shader: from the scene's triangles to init vectors.
#pragma once

#include <cstdint>
#include <vector>

#include "plan/hardware_key.hpp"
#include "scene/scene.hpp"
#include "setup/project.hpp"

namespace halfway {

enum class HighlightTest {
  none,         ///< never split
  centroid,     ///< as published: at the centroid
  conservative  ///< and a bound that no highlight slips through
};

struct QuadraticSetupOptions {
  HighlightTest test = HighlightTest::conservative;
  double threshold = 2.0;  ///< colour steps of 1/255; past it a triangle is split in four
  int max_level = 5;       ///< of subdivision, 0 to 5
};

struct SetupCounts {
  ProjectionCounts projection;
  std::uint64_t triangles = 0;    ///< screen triangles
  std::uint64_t subdivided = 0;   ///< of these, split at least once
  std::uint64_t leaves = 0;       ///< triangles after subdivision
  std::uint64_t vectors = 0;      ///< init vectors
  std::uint64_t shaded = 0;       ///< evaluations of the illumination model
  std::uint64_t overexposed = 0;  ///< samples held at c_largest_sample
  std::uint64_t unresolved = 0;   ///< leaves past the threshold at the last level
  SetupCounts& operator+=(const SetupCounts& other);
};

/// Samples are held at four times full exposure, 1023 steps: then no control point of the quadratic leaves
/// the intensity format, and the quadratic stays inside the hull of its control points.
inline constexpr double c_largest_sample = 1023.0;

class QuadraticSetup {
 public:
  /// The scene must outlive the setup.
  QuadraticSetup(const Scene& scene, FrameSize frame, const HardwareKey& key, QuadraticSetupOptions options);

  /// Bits of one init vector.
  unsigned init_bits() const { return init_bits_; }

  /// Appends the init vectors of one of the scene's triangles, (init_bits() + 31)/32 words each.
  void append(std::uint32_t triangle, std::vector<std::uint32_t>& words, SetupCounts& counts) const;

 private:
  void append_exact(const ScreenTriangle& triangle, std::vector<std::uint32_t>& words,
                    SetupCounts& counts) const;
  void append_published(const ScreenTriangle& triangle, std::vector<std::uint32_t>& words,
                        SetupCounts& counts) const;

  const Scene* scene_;
  FrameSize frame_;
  Preset preset_;
  int channels_;
  unsigned init_bits_;
  QuadraticSetupOptions options_;
  Projector projector_;
};

}  // namespace halfway
