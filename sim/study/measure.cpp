// SPDX-License-Identifier: Apache-2.0
#include "sim/study/measure.hpp"

#include <utility>

#include "sim/pictures/perception.hpp"
#include "sim/run/verilator_frame.hpp"
#include "sim/study/hardware.hpp"

namespace halfway::study {
namespace {

Result<Drawing> draw_in_hardware(const DesignPoint& point, const Scene& scene,
                                 const SimulatorFolders& folders, const std::optional<Tile>& tile) {
  const auto hardware = drawing_hardware_of(point, scene, folders);
  if (!hardware) return hardware.error();
  const auto rtl_folders = rtl_of(point, folders);
  if (!rtl_folders) return rtl_folders.error();
  const HardwareKey& key = hardware->key;
  auto drawn = draw_in_verilator(scene, point.size, key, point.setup(), *rtl_folders, 1, tile,
                                 hardware->formats.get());
  if (!drawn) return drawn.error();
  return Drawing{std::move(drawn->frame), std::move(drawn->mask), key.name(),
                 drawn->fragments,        drawn->cycles,          drawn->counts};
}

}  // namespace

Result<Drawing> draw(const DesignPoint& point, const Subject& subject, const SimulatorFolders& folders,
                     const std::optional<Tile>& tile) {
  if (in_hardware(point.method)) return draw_in_hardware(point, subject.scene, folders, tile);
  Drawing drawing;
  drawing.frame = render_gouraud(subject.scene, subject.triangles,
                                 {.frame = point.size, .subpixel_bits = 4, .tile = tile})
                      .frame;
  return drawing;
}

Result<Measurement> measure(const Pictures& pictures, std::optional<Drawing> drawing) {
  Measurement m;
  const auto& [scene, triangles] = *pictures.subject;
  const Frame& reference = pictures.reference.image.frame;
  m.triangles = scene.triangles.size();
  std::vector<std::uint8_t> mask = pictures.reference.image.mask;
  if (drawing) {
    for (std::size_t i = 0; i < drawing->mask.size(); ++i) mask[i] |= drawing->mask[i];
    m.frame = std::move(drawing->frame);
    m.fragments = drawing->fragments;
    m.cycles = drawing->cycles;
    m.hardware = std::move(drawing->hardware);
    m.setup = drawing->setup;
  } else {
    m.frame = reference;
  }
  const auto picture = frame_distance(m.frame, reference, mask);
  if (!picture) return picture.error();
  m.picture = *picture;
  const auto highlight = frame_distance(m.frame, reference, pictures.reference.highlight);
  if (!highlight) return highlight.error();
  m.highlight = *highlight;
  const auto perceived = perceived_pixels(m.frame, reference);
  if (!perceived) return perceived.error();
  m.perceived = *perceived;
  const auto bands = mach_bands(m.frame, reference, scene, triangles);
  if (!bands) return bands.error();
  m.mach_bands = *bands;
  return m;
}

}  // namespace halfway::study
