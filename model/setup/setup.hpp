// SPDX-License-Identifier: Apache-2.0
// Common part of the shaders' setups: converts the scene to init vectors.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "common/result.hpp"
#include "frame/frame_size.hpp"
#include "frame/tile.hpp"
#include "plan/hardware_key.hpp"
#include "projection/project.hpp"
#include "scene/scene.hpp"
#include "shading/arc.hpp"
#include "shading/bell.hpp"
#include "words/formats.hpp"

namespace halfway {

enum class HighlightTest {
  none,          ///< never split
  centroid,      ///< as published: test at the centroid
  conservative,  ///< additionally uses a bound on missed highlights, and `proved` where normals nearly
                 ///< cancel; preset exact draws small leaves by pixel
  proved,        ///< an upper bound of the error (proved_bound.hpp) instead; small leaves as conservative
};

/// As for --highlight-test and in study spaces.
inline const char* to_string(HighlightTest test) {
  switch (test) {
    case HighlightTest::none:
      return "none";
    case HighlightTest::centroid:
      return "centroid";
    case HighlightTest::conservative:
      return "conservative";
    case HighlightTest::proved:
      break;
  }
  return "proved";
}

/// True if small leaves are drawn pixel by pixel, without error.
inline bool draws_small_by_pixel(Preset preset, HighlightTest test) {
  return preset == Preset::exact && (test == HighlightTest::conservative || test == HighlightTest::proved);
}

/// A triangle or piece of at most this width and height, in pixels, is small: it is not split. It covers at
/// most three pixels, so preset exact can draw it with the exact colours at their centres (PixelFit).
inline constexpr std::int32_t c_small_pixels = 2;

struct QuadraticSetupOptions {
  HighlightTest test = HighlightTest::conservative;
  /// Colour steps of 1/255; above it a triangle is split into four, unless it is small.
  double threshold = 2.0;
  int max_level = 5;  ///< of subdivision, 0 to 5
};

struct SphericalSetupOptions {
  SpanEnds ends = SpanEnds::on_surface;  ///< for preset exact; published always uses slerped_along_edges
  /// Preset exact, ends on the surface: colour steps of 1/255. If a span's interpolation differs more from
  /// the illumination model, the triangle is cut into strips. The errors of fitted bells, tables and
  /// rounding are additional. A span is checked at every pixel unless a bound from its two ends is below the
  /// threshold.
  double threshold = 2.0;
  /// Preset exact without own tables: the scene's bells (fitted_bells), for a scene that is drawn more than
  /// once. Without them the setup fits the bells, which takes milliseconds per bell.
  std::shared_ptr<const Bells> bells{};
};

struct ProcessorsSetupOptions {
  /// Preset published: normalize N even if no light has a place, as in version II of the paper. The hardware
  /// must have the units for it.
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
  std::uint64_t leaves = 0;       ///< triangles or columns after subdivision
  std::uint64_t vectors = 0;      ///< init vectors that start a triangle
  std::uint64_t records = 0;      ///< line records that follow them
  std::uint64_t shaded = 0;       ///< samples of the illumination model; spherical: of the vectors
  std::uint64_t overexposed = 0;  ///< samples clamped at c_largest_sample, or factors at their limit
  std::uint64_t unresolved = 0;   ///< leaves above the threshold: small, or at the last level
  std::uint64_t shadows = 0;      ///< init vectors of shadow polygons
  std::uint64_t objects = 0;      ///< object processors that a line of a strip needs, at most
  SetupCounts& operator+=(const SetupCounts& other);
};

/// Samples are clamped at four times full exposure, 1023 steps. No control point of the quadratic then leaves
/// the intensity format, and the quadratic stays in the convex hull of its control points.
inline constexpr double c_largest_sample = 1023.0;

/// Appends the vectors of units, for one thread. It keeps what the next units may use again, because
/// neighbours in the mesh share vertices and edges. The result does not depend on the units before.
class SetupWorker {
 public:
  virtual ~SetupWorker() = default;
  /// Appends the vectors of one unit.
  virtual void append(std::uint32_t unit, std::vector<std::uint32_t>& words, SetupCounts& counts) = 0;
};

/// Makes a stream of vectors, (init_bits() + 31)/32 words each: a prologue, then unit by unit. After the
/// prologue the hardware draws each unit independently of the units before it. The units may therefore be
/// distributed over several golden models.
class Setup {
 public:
  virtual ~Setup() = default;

  /// Bits of one vector of the stream.
  virtual unsigned init_bits() const = 0;
  /// Number of the scene's triangles, in its order; or of the frame's strips, for object processors.
  virtual std::uint32_t units() const = 0;
  virtual bool units_are_strips() const { return false; }
  /// A part of the frame that contains every pixel covered by the unit's vectors. Empty if there is none.
  virtual Tile reach(std::uint32_t unit) const = 0;
  /// Appends the vectors that the hardware needs once.
  virtual void append_prologue(std::vector<std::uint32_t>& /*words*/, SetupCounts& /*counts*/) const {}
  /// A worker for one thread. The setup must outlive it.
  virtual std::unique_ptr<SetupWorker> worker() const = 0;
  /// Appends the vectors of one unit, by a worker of its own.
  void append(std::uint32_t unit, std::vector<std::uint32_t>& words, SetupCounts& counts) const {
    worker()->append(unit, words, counts);
  }
  /// Appends the vectors of all units.
  void append_all(std::vector<std::uint32_t>& words, SetupCounts& counts) const;
  /// Parts of the scene that exceed the hardware's number formats, one sentence each.
  virtual std::vector<std::string> notes() const { return {}; }
};

/// Makes the setup for the hardware named by the key. The scene must outlive it.
std::unique_ptr<Setup> make_setup(const Scene& scene, FrameSize frame, const HardwareKey& key,
                                  const SetupOptions& options);

/// Returns bad input if a pixel has more objects than the key has object processors. `fault`: that of the
/// golden model that draws the vectors.
Status check_pixels(const Scene& scene, const HardwareKey& key, const SetupCounts& counts, bool fault);
/// The first of these checks before anything is drawn or built.
Status check_objects(const Scene& scene, FrameSize frame, const HardwareKey& key,
                     const SetupOptions& options);
/// Returns bad input if a triangle does not project to finite points on the screen.
Status check_projection(const Scene& scene, const SetupCounts& counts);

}  // namespace halfway
