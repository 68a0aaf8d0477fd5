// SPDX-License-Identifier: Apache-2.0
#include "study/pictures.hpp"

#include <algorithm>
#include <cstdlib>

#include "scene/load_scene.hpp"
#include "setup/project.hpp"

namespace halfway::study {
namespace {

constexpr std::size_t c_most_kept = 8;

std::vector<std::uint8_t> highlight_mask(const Scene& scene, std::span<const ScreenTriangle> triangles,
                                         const RenderOptions& options, const ReferenceImage& reference) {
  Scene dull = scene;
  for (Material& material : dull.materials) material.specular = 0.0;
  const Frame without = render_reference(dull, triangles, options).frame;
  std::vector<std::uint8_t> mask(reference.mask.size());
  for (std::size_t pixel = 0; pixel < mask.size(); ++pixel)
    for (std::size_t i = 3 * pixel; i < 3 * pixel + 3; ++i)
      if (reference.frame.rgb[i] - without.rgb[i] >= c_highlight) mask[pixel] = 1;
  return mask;
}

}  // namespace

Result<Scene> drawn_scene(const std::string& scene, const std::filesystem::path& scenes_folder,
                          const DesignPoint& point) {
  auto drawn = load_scene(scene, scenes_folder, {.tessellation = point.tessellation});
  if (drawn && point.exponent)
    for (Material& material : drawn->materials) material.exponent = *point.exponent;
  return drawn;
}

Result<std::shared_ptr<const Pictures>> PictureShelf::of(const DesignPoint& point) {
  const std::string name = point.picture();
  std::promise<Result<std::shared_ptr<const Pictures>>> promise;
  Made made;
  bool mine = false;
  {
    const std::scoped_lock lock(mutex_);
    const auto found = std::ranges::find(kept_, name, &std::pair<std::string, Made>::first);
    mine = found == kept_.end();
    made = mine ? promise.get_future().share() : found->second;
    if (mine) kept_.emplace_back(name, made);
    if (kept_.size() > c_most_kept) kept_.pop_front();
  }
  if (mine) {
    try {
      promise.set_value(make(point));
    } catch (...) {
      promise.set_exception(std::current_exception());
    }
  }
  return made.get();
}

Result<std::shared_ptr<const Pictures>> PictureShelf::make(const DesignPoint& point) const {
  auto scene = drawn_scene(scene_, scenes_folder_, point);
  if (!scene) return scene.error();
  auto pictures = std::make_shared<Pictures>();
  pictures->scene = std::move(*scene);
  pictures->triangles = Projector(pictures->scene, point.size, {}).project_all();
  const RenderOptions options{.frame = point.size, .subpixel_bits = 4, .threads = 1};
  pictures->reference = render_reference(pictures->scene, pictures->triangles, options);
  pictures->highlight = highlight_mask(pictures->scene, pictures->triangles, options, pictures->reference);
  return std::shared_ptr<const Pictures>(std::move(pictures));
}

}  // namespace halfway::study
