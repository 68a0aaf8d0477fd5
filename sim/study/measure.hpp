// SPDX-License-Identifier: Apache-2.0
// Measurement of one point of a study: scene and reference picture, the difference of the point's picture
// from the reference, and its cost.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "frame/metrics.hpp"
#include "projection/screen_triangle.hpp"
#include "reference/renderer.hpp"
#include "scene/scene.hpp"
#include "sim/engines/ghdl/ghdl_library.hpp"
#include "sim/engines/mesa/mesa_picture.hpp"
#include "sim/run/verilator_frame.hpp"
#include "sim/study/design_point.hpp"
#include "sim/study/mach_bands.hpp"

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

/// The picture of a point's design and its cost, for a frame or a tile. In software, fragments, cycles and
/// counts are 0, and an empty mask stands for the reference's.
struct Drawing : VerilatorFrame {
  std::string hardware;  ///< the key's name; empty in software
};

/// The host's work for a frame, in time of one core of the machine that measured it.
struct HostTime {
  double ns = 0;
  std::uint64_t words = 0;  ///< 32-bit words sent to the hardware; 0 in software
};

/// The drawing of the whole frame, without its mask. With tiles, its figures are their sums.
struct Measurement : Drawing {
  FrameDistance picture;        ///< compared with the reference, over the pixels that either covers
  FrameDistance highlight;      ///< over the pixels of Reference::highlight
  std::uint64_t perceived = 0;  ///< pixels with a visible difference (FLIP)
  MachBands mach_bands;
  std::uint64_t triangles = 0;  ///< of the scene
  /// Host instructions for the frame's init vectors; std::nullopt in software, or if not counted.
  std::optional<std::uint64_t> host_instructions;
  /// Not a column of the study's table, because it varies from run to run.
  std::optional<HostTime> host_time{};
};

/// The picture of phong-mesa.
MesaRequest mesa_request(const DesignPoint& point, const std::string& scene);

/// Draw the frame or a tile. Hardware is drawn by the RTL in Verilator. If a fragment differs from the golden
/// model's, throws Failure with the exit code `differs`. The point must be drawn (is_drawn).
Drawing draw(const DesignPoint& point, const Subject& subject, const SimulatorFolders& folders,
             const std::optional<Tile>& tile = {});

/// Compare the drawing of the whole frame with the reference. Without a drawing, the reference is compared
/// with itself.
Measurement measure(const Pictures& pictures, std::optional<Drawing> drawing);

/// Call `visit` with each setup counter and its name.
template <class Counts, class Visit>
void for_each_setup_figure(Counts& setup, const Visit& visit) {
  visit("screen_triangles", setup.triangles);
  visit("leaves", setup.leaves);
  visit("unresolved", setup.unresolved);
  visit("init_vectors", setup.vectors);
  visit("line_records", setup.records);
  visit("host_evaluations", setup.shaded);
}

/// Call `visit` with every value of a measurement and its column name, in the table's order.
template <class Measured, class Visit>
void for_each_figure(Measured& m, const Visit& visit) {
  visit("hardware", m.hardware);
  visit("triangles", m.triangles);
  visit("fragments", m.fragments);
  visit("cycles", m.cycles);
  visit("pixels", m.picture.pixels);
  visit("largest_error", m.picture.max_lsb);
  visit("error_99", m.picture.percentile99);
  visit("rms", m.picture.rms);
  visit("psnr_db", m.picture.psnr_db);
  visit("highlight_pixels", m.highlight.pixels);
  visit("highlight_largest_error", m.highlight.max_lsb);
  visit("highlight_error_99", m.highlight.percentile99);
  visit("highlight_rms", m.highlight.rms);
  visit("highlight_psnr_db", m.highlight.psnr_db);
  visit("perceived_pixels", m.perceived);
  visit("mach_edges", m.mach_bands.edges);
  visit("mach_rms", m.mach_bands.rms);
  visit("mach_largest", m.mach_bands.largest);
  for_each_setup_figure(m.counts, visit);
  visit("host_instructions", m.host_instructions);
}

}  // namespace halfway::study
