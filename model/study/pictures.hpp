// SPDX-License-Identifier: Apache-2.0
// What the points of a study are measured by: the scene as they draw it, and its reference picture.
#pragma once

#include <cstdint>
#include <deque>
#include <future>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "common/result.hpp"
#include "reference/renderer.hpp"
#include "scene/scene.hpp"
#include "setup/screen_triangle.hpp"
#include "study/design_point.hpp"

namespace halfway::study {

struct Pictures {
  Scene scene;
  std::vector<ScreenTriangle> triangles;
  ReferenceImage reference;
  /// Pixels where highlights take the reference up by c_highlight steps or more; one byte a pixel.
  std::vector<std::uint8_t> highlight;
};
inline constexpr int c_highlight = 8;

/// The scene as the point draws it.
Result<Scene> drawn_scene(const std::string& scene, const std::filesystem::path& scenes_folder,
                          const DesignPoint& point);

/// Those of a scene, each made once for all points that share them, and kept while they are likely to be
/// asked for. Threads may ask at once.
class PictureShelf {
 public:
  PictureShelf(std::string scene, std::filesystem::path scenes_folder)
      : scene_(std::move(scene)), scenes_folder_(std::move(scenes_folder)) {}

  Result<std::shared_ptr<const Pictures>> of(const DesignPoint& point);

 private:
  using Made = std::shared_future<Result<std::shared_ptr<const Pictures>>>;
  Result<std::shared_ptr<const Pictures>> make(const DesignPoint& point) const;
  std::string scene_;
  std::filesystem::path scenes_folder_;
  std::mutex mutex_;
  std::deque<std::pair<std::string, Made>> kept_;
};

}  // namespace halfway::study
