// SPDX-License-Identifier: Apache-2.0
// Setup of the quadratic shader: from the scene's triangles to init vectors.
#pragma once

#include <cstdint>
#include <vector>

#include "plan/hardware_key.hpp"
#include "scene/scene.hpp"
#include "setup/project.hpp"
#include "setup/setup.hpp"

namespace halfway {

class QuadraticSetup final : public Setup {
 public:
  /// The scene must outlive the setup.
  QuadraticSetup(const Scene& scene, FrameSize frame, const HardwareKey& key, QuadraticSetupOptions options);

  unsigned init_bits() const override { return init_bits_; }
  std::uint32_t units() const override { return static_cast<std::uint32_t>(scene_->triangles.size()); }
  void append(std::uint32_t triangle, std::vector<std::uint32_t>& words, SetupCounts& counts) const override;

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
