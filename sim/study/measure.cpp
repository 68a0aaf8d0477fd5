// SPDX-License-Identifier: Apache-2.0
#include "sim/study/measure.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "sim/files/flip.hpp"
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

}  // namespace

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
