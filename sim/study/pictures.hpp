// SPDX-License-Identifier: Apache-2.0
// Scene and reference picture of a study's points.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
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

/// The reference of the point's picture. A filtered one is of the whole frame.
Reference render(const Subject& subject, const DesignPoint& point, const std::optional<Tile>& tile = {});

/// Thread-safe cache of named values. Each value is made once and shared. The oldest values are dropped
/// first.
template <class Value>
class Shelf {
 public:
  using Shared = std::shared_ptr<const Value>;

  /// `make` returns a Shared, or throws; then the next caller makes the value.
  template <class Make>
  Shared of(const std::string& name, const Make& make) {
    std::shared_ptr<Thing> thing;
    {
      const std::scoped_lock lock(mutex_);
      const auto found =
          std::ranges::find(kept_, name, &std::pair<std::string, std::shared_ptr<Thing>>::first);
      thing = found == kept_.end() ? std::make_shared<Thing>() : found->second;
      if (found == kept_.end()) kept_.emplace_back(name, thing);
      if (kept_.size() > c_most_kept) kept_.pop_front();
    }
    std::call_once(thing->once, [&] { thing->made = make(); });
    return thing->made;
  }

 private:
  static constexpr std::size_t c_most_kept = 8;
  struct Thing {
    std::once_flag once;
    Shared made;
  };
  std::mutex mutex_;
  std::deque<std::pair<std::string, std::shared_ptr<Thing>>> kept_;
};

/// The pictures of a scene.
class PictureShelf {
 public:
  /// Makes the reference of a picture; empty: render it.
  using MakeReference = std::function<Reference()>;

  PictureShelf(std::string scene, std::filesystem::path scenes_folder)
      : scene_(std::move(scene)), scenes_folder_(std::move(scenes_folder)) {}

  std::shared_ptr<const Subject> subject(const DesignPoint& point);
  std::shared_ptr<const Pictures> of(const DesignPoint& point, const MakeReference& reference = {});

 private:
  std::string scene_;
  std::filesystem::path scenes_folder_;
  Shelf<Subject> subjects_;
  Shelf<Pictures> pictures_;
};

}  // namespace halfway::study
