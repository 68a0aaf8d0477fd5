// SPDX-License-Identifier: Apache-2.0
#include "study/measure.hpp"

#include <utility>

#include "frame/perception.hpp"
#include "run/verilator_frame.hpp"
#include "study/hardware.hpp"

namespace halfway::study {
namespace {

// Adds what hardware draws and takes; the mask of what it covers.
Result<std::vector<std::uint8_t>> draw_in_hardware(const DesignPoint& point, const Scene& scene,
                                                   const SimulatorFolders& folders, Measurement& m) {
  const auto hardware = drawing_hardware_of(point, scene, folders);
  if (!hardware) return hardware.error();
  const auto rtl_folders = rtl_of(point, folders);
  if (!rtl_folders) return rtl_folders.error();
  const HardwareKey& key = hardware->key;
  auto drawn = draw_in_verilator(scene, point.size, key, point.setup(), *rtl_folders, 1);
  if (!drawn) return drawn.error();
  m.frame = std::move(drawn->frame);
  m.fragments = drawn->fragments;
  m.cycles = drawn->cycles;
  m.hardware = key.name();
  m.setup = drawn->counts;
  return std::move(drawn->mask);
}

}  // namespace

Result<Measurement> measure(const DesignPoint& point, const Pictures& pictures,
                            const SimulatorFolders& folders) {
  Measurement m;
  m.triangles = pictures.scene.triangles.size();
  std::vector<std::uint8_t> mask = pictures.reference.mask;
  if (in_hardware(point.method)) {
    const auto covered = draw_in_hardware(point, pictures.scene, folders, m);
    if (!covered) return covered.error();
    for (std::size_t i = 0; i < mask.size(); ++i) mask[i] |= (*covered)[i];
  } else if (point.method == Method::gouraud) {
    m.frame = render_gouraud(pictures.scene, pictures.triangles,
                             {.frame = point.size, .subpixel_bits = 4, .threads = 1})
                  .frame;
  } else {
    m.frame = pictures.reference.frame;
  }
  const Frame& reference = pictures.reference.frame;
  const auto picture = frame_distance(m.frame, reference, mask);
  if (!picture) return picture.error();
  m.picture = *picture;
  const auto highlight = frame_distance(m.frame, reference, pictures.highlight);
  if (!highlight) return highlight.error();
  m.highlight = *highlight;
  const auto perceived = perceived_pixels(m.frame, reference);
  if (!perceived) return perceived.error();
  m.perceived = *perceived;
  const auto bands = mach_bands(m.frame, reference, pictures.scene, pictures.triangles);
  if (!bands) return bands.error();
  m.mach_bands = *bands;
  return m;
}

}  // namespace halfway::study
