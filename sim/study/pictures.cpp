// SPDX-License-Identifier: Apache-2.0
#include "sim/study/pictures.hpp"

#include "projection/project.hpp"
#include "sim/files/load_scene.hpp"
#include "sim/os/must.hpp"

namespace halfway::study {
namespace {

// As the shader's picture: filtered or not.
ReferenceImage draw(const Scene& scene, const Subject& subject, const RenderOptions& options, bool filtered) {
  return filtered ? render_filtered(scene, subject.triangles, options, words::c_filter_weights)
                  : render_reference(scene, subject.triangles, options);
}

std::vector<std::uint8_t> highlight_mask(const Subject& subject, const RenderOptions& options,
                                         const ReferenceImage& reference, bool filtered) {
  Scene dull = subject.scene;
  for (Material& material : dull.materials) material.specular = 0.0;
  const Frame without = draw(dull, subject, options, filtered).frame;
  std::vector<std::uint8_t> mask(reference.mask.size());
  for (std::size_t pixel = 0; pixel < mask.size(); ++pixel)
    for (std::size_t i = 3 * pixel; i < 3 * pixel + 3; ++i)
      if (reference.frame.rgb[i] - without.rgb[i] >= c_highlight) mask[pixel] = 1;
  return mask;
}

}  // namespace

Scene drawn_scene(const std::string& scene, const std::filesystem::path& scenes_folder,
                  const DesignPoint& point) {
  Scene drawn = must(load_scene(scene, scenes_folder, {.tessellation = point.tessellation}));
  if (point.exponent)
    for (Material& material : drawn.materials) material.exponent = *point.exponent;
  return drawn;
}

Reference render(const Subject& subject, const DesignPoint& point, const std::optional<Tile>& tile) {
  const RenderOptions options{.frame = point.size, .tile = tile};
  Reference reference;
  reference.image = draw(subject.scene, subject, options, point.filtered());
  reference.highlight = highlight_mask(subject, options, reference.image, point.filtered());
  return reference;
}

Subject subject_of(const std::string& scene, const std::filesystem::path& scenes_folder,
                   const DesignPoint& point) {
  Subject subject{scene, drawn_scene(scene, scenes_folder, point), {}};
  subject.triangles = Projector(subject.scene, point.size, {}).project_all();
  return subject;
}

}  // namespace halfway::study
