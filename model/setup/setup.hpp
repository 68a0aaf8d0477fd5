// SPDX-License-Identifier: Apache-2.0
// What the shaders' setups have in common: from the scene to init vectors.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "frame/frame_size.hpp"
#include "frame/tile.hpp"
#include "golden/formats.hpp"
#include "plan/hardware_key.hpp"
#include "scene/scene.hpp"
#include "setup/project.hpp"
#include "shading/bell.hpp"

namespace halfway {

enum class HighlightTest {
  none,         ///< never split
  centroid,     ///< as published: at the centroid
  conservative  ///< and a bound that no highlight slips through
};

struct QuadraticSetupOptions {
  HighlightTest test = HighlightTest::conservative;
  double threshold = 2.0;  ///< colour steps of 1/255; past it a triangle is split in four
  int max_level = 5;       ///< of subdivision, 0 to 5
};

/// Where the spherical shader takes the vectors at the two ends of a span from.
enum class SpanEnds {
  on_surface,  ///< the surface behind the end pixels' centres, perspective-correct
  /// As published: spherical interpolation along the triangle's edges. Never cut into columns, whatever the
  /// threshold: far off where a light is close to the surface, or a spot's edge crosses it.
  slerped_along_edges,
};

struct SphericalSetupOptions {
  SpanEnds ends = SpanEnds::on_surface;  ///< of preset exact; published has slerped_along_edges always
  /// Preset exact, ends on the surface: colour steps of 1/255; where a span's interpolation is farther off
  /// the illumination model, a triangle is cut into columns. Fitted bells, tables and roundings add to it.
  /// Looked at is every pixel of short spans, of longer ones the places that the ends' angles, the surface's
  /// turns, lights, horizons and spots suggest: of 44 million pixels of random scenes, lights of all kinds
  /// close to the surface, exponents 1 to 10^5, one was farther off than all that, by 8 steps.
  double threshold = 2.0;
  /// Preset exact: the scene's bells (fitted_bells), where it is drawn more than once; none: setup fits them,
  /// milliseconds each.
  std::shared_ptr<const Bells> bells{};
};

struct ProcessorsSetupOptions {
  /// Preset published: N is normalized also where no light has a place, as in the paper's version II. The
  /// hardware must have what it takes.
  bool normalize = false;
};

struct SetupOptions {
  QuadraticSetupOptions quadratic;
  SphericalSetupOptions spherical;
  ProcessorsSetupOptions processors;
};

struct SetupCounts {
  ProjectionCounts projection;
  std::uint64_t triangles = 0;    ///< screen triangles
  std::uint64_t subdivided = 0;   ///< of these, split at least once
  std::uint64_t leaves = 0;       ///< triangles after subdivision
  std::uint64_t vectors = 0;      ///< init vectors that begin a triangle
  std::uint64_t records = 0;      ///< line records that follow them
  std::uint64_t shaded = 0;       ///< quadratic: evaluations of the illumination model; spherical: of vectors
  std::uint64_t overexposed = 0;  ///< samples held at c_largest_sample, or factors at theirs
  std::uint64_t unresolved = 0;   ///< leaves past the threshold at the last level
  std::uint64_t shadows = 0;      ///< init vectors of shadow polygons
  /// Shadow polygons of one light, opening or closing ones, on one pixel: the most anywhere, volumes around
  /// the eye included. May be counted: c_most_shadows.
  std::uint64_t deepest_shadow = 0;
  SetupCounts& operator+=(const SetupCounts& other);
};

/// Samples are held at four times full exposure, 1023 steps: then no control point of the quadratic leaves
/// the intensity format, and the quadratic stays inside the hull of its control points.
inline constexpr double c_largest_sample = 1023.0;

/// What a shadow counter takes, either way.
inline constexpr std::uint64_t c_most_shadows = (1U << (golden::Exact::c_shadow_count_bits - 1)) - 1;

/// Makes a stream of vectors, (init_bits() + 31)/32 words each: a prologue, then unit by unit. Hardware that
/// has had the prologue draws each unit alike, whichever came before: so units may go to several golden
/// models.
class Setup {
 public:
  virtual ~Setup() = default;

  /// Bits of one vector of the stream.
  virtual unsigned init_bits() const = 0;
  /// The scene's triangles, in its order; or the frame's lines, for hardware that looks at all of a pixel's
  /// surfaces before it shades one.
  virtual std::uint32_t units() const = 0;
  virtual bool units_are_lines() const { return false; }
  /// A part of the frame that holds every pixel that the unit's vectors cover: empty where there is none.
  virtual Tile reach(std::uint32_t unit) const = 0;
  /// Appends what the hardware is told once.
  virtual void append_prologue(std::vector<std::uint32_t>& /*words*/, SetupCounts& /*counts*/) const {}
  /// Appends one unit's vectors.
  virtual void append(std::uint32_t unit, std::vector<std::uint32_t>& words, SetupCounts& counts) const = 0;
  /// What of the scene the hardware's numbers cannot hold, a sentence each.
  virtual std::vector<std::string> notes() const { return {}; }
};

/// The setup of the hardware that the key names. The scene must outlive it.
std::unique_ptr<Setup> make_setup(const Scene& scene, FrameSize frame, const HardwareKey& key,
                                  const SetupOptions& options);

}  // namespace halfway
