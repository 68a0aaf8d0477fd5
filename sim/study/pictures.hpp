// SPDX-License-Identifier: Apache-2.0
// Scene and reference picture of a study's points.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "projection/screen_triangle.hpp"
#include "reference/renderer.hpp"
#include "scene/scene.hpp"
#include "sim/study/design_point.hpp"

namespace halfway::study {

/// The scene to draw.
struct Subject {
  std::string name;  ///< as for load_scene
  Scene scene;
  std::vector<ScreenTriangle> triangles;
};

/// The correct picture of a frame or a tile.
struct Reference {
  ReferenceImage image;
  /// Pixels where highlights raise the reference by c_highlight steps or more; one byte per pixel.
  std::vector<std::uint8_t> highlight;
};
inline constexpr int c_highlight = 8;

/// Subject and reference of a whole frame.
struct Pictures {
  std::shared_ptr<const Subject> subject;
  Reference reference;
};

/// The scene with the point's tessellation and exponent.
Scene drawn_scene(const std::string& scene, const std::filesystem::path& scenes_folder,
                  const DesignPoint& point);

/// The point's scene, and its triangles at the point's size.
Subject subject_of(const std::string& scene, const std::filesystem::path& scenes_folder,
                   const DesignPoint& point);

/// The reference of the point's picture. A filtered one is of the whole frame.
Reference render(const Subject& subject, const DesignPoint& point, const std::optional<Tile>& tile = {});

}  // namespace halfway::study
