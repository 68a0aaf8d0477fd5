// SPDX-License-Identifier: Apache-2.0
#include "sim/study/measure.hpp"

#include "sim/files/flip.hpp"
#include "sim/files/load_scene.hpp"
#include "sim/os/must.hpp"
#include "sim/study/hardware.hpp"

namespace halfway::study {
namespace {

Drawing draw_in_hardware(const DesignPoint& point, const Scene& scene, const SimulatorFolders& folders,
                         const std::optional<Tile>& tile) {
  const PointHardware hardware = drawing_hardware_of(point, scene, folders);
  return {draw_in_verilator(scene, point.size, hardware.key, rtl_of(point, scene, folders),
                            {.setup = point.setup(), .tile = tile, .models = hardware.models}),
          hardware.key.name()};
}

// The pixels of another colour than the background.
std::vector<std::uint8_t> mask_of(const Frame& frame, const Scene& scene) {
  const std::array<std::uint8_t, 3> background{to_byte(scene.background.r), to_byte(scene.background.g),
                                               to_byte(scene.background.b)};
  std::vector<std::uint8_t> mask(frame.pixels());
  for (std::size_t i = 0; i < mask.size(); ++i)
    mask[i] = !std::equal(background.begin(), background.end(), &frame.rgb[3 * i]);
  return mask;
}

// As the shader's picture: filtered or not.
ReferenceImage draw_reference(const Scene& scene, const Subject& subject, const RenderOptions& options,
                              bool filtered) {
  return filtered ? render_filtered(scene, subject.triangles, options, words::c_filter_weights)
                  : render_reference(scene, subject.triangles, options);
}

std::vector<std::uint8_t> highlight_mask(const Subject& subject, const RenderOptions& options,
                                         const ReferenceImage& reference, bool filtered) {
  Scene dull = subject.scene;
  for (Material& material : dull.materials) material.specular = 0.0;
  const Frame without = draw_reference(dull, subject, options, filtered).frame;
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
  reference.image = draw_reference(subject.scene, subject, options, point.filtered());
  reference.highlight = highlight_mask(subject, options, reference.image, point.filtered());
  return reference;
}

Subject subject_of(const std::string& scene, const std::filesystem::path& scenes_folder,
                   const DesignPoint& point) {
  Subject subject{scene, drawn_scene(scene, scenes_folder, point), {}};
  subject.triangles = Projector(subject.scene, point.size, {}).project_all();
  return subject;
}

MesaRequest mesa_request(const DesignPoint& point, const std::string& scene) {
  return {.scene = scene, .size = point.size, .tessellation = point.tessellation, .exponent = point.exponent};
}

Drawing draw(const DesignPoint& point, const Subject& subject, const SimulatorFolders& folders,
             const std::optional<Tile>& tile) {
  if (in_hardware(point.method)) return draw_in_hardware(point, subject.scene, folders, tile);
  Drawing drawing;
  if (point.method == Method::phong_mesa) {
    MesaPicture picture = draw_by_mesa(mesa_request(point, subject.name), folders.source);
    drawing.frame = tile ? cut_tile(picture.frame, *tile) : std::move(picture.frame);
    drawing.mask = mask_of(drawing.frame, subject.scene);
    return drawing;
  }
  drawing.frame = render_gouraud(subject.scene, subject.triangles, {.frame = point.size, .tile = tile}).frame;
  return drawing;
}

Measurement measure(const Pictures& pictures, std::optional<Drawing> drawing) {
  Measurement m;
  const auto& [name, scene, triangles] = *pictures.subject;
  const Frame& reference = pictures.reference.image.frame;
  m.triangles = scene.triangles.size();
  std::vector<std::uint8_t> mask = pictures.reference.image.mask;
  if (drawing)
    static_cast<Drawing&>(m) = std::move(*drawing);
  else
    m.frame = reference;
  for (std::size_t i = 0; i < m.mask.size(); ++i) mask[i] |= m.mask[i];
  m.mask.clear();
  m.picture = must(frame_distance(m.frame, reference, mask));
  m.highlight = must(frame_distance(m.frame, reference, pictures.reference.highlight));
  m.perceived = must(perceived_pixels(m.frame, reference));
  m.mach_bands = mach_bands(m.frame, reference, scene, triangles);
  return m;
}

}  // namespace halfway::study
