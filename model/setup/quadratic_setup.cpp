// SPDX-License-Identifier: Apache-2.0
#include "setup/quadratic_setup.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "common/recent_values.hpp"
#include "setup/half_triangle.hpp"
#include "setup/highlight_bound.hpp"
#include "setup/proved_bound.hpp"
#include "setup/quadratic_fit.hpp"
#include "setup/walk.hpp"
#include "setup/walk_header.hpp"
#include "shading/shade.hpp"
#include "words/quadratic_layout.hpp"

namespace halfway {
namespace {

using words::Exact;
using words::Published;

// A vertex of a piece of a screen triangle: exact on the screen and in barycentric coordinates of the
// triangle.
struct Corner {
  ScreenPoint point;
  glm::dvec3 barycentric;
};

// A sample of the surface and its radiance. Neighbours in the subdivision share it.
struct Sample {
  Corner corner;
  SurfacePoint surface;
  glm::dvec3 radiance;
};

// Vertices, then midpoints of 1-2, 1-3, 2-3. Points of vertices are in units of the piece's own level. Points
// of midpoints are in units of the next level: see `deeper`.
using SixPoints = std::array<Sample, 6>;

struct Piece {
  SixPoints samples;
  int level;
};

ScreenPoint doubled(ScreenPoint p) {
  return {2 * p.x, 2 * p.y};
}

// The midpoint in units of the next level, where it is exact.
ScreenPoint middle(ScreenPoint a, ScreenPoint b) {
  return {a.x + b.x, a.y + b.y};
}

// Names a vertex of the mesh (both ends are the same), or the middle of an edge.
struct SampleKey {
  VertexKey a, b;  // the lesser one first
  std::uint32_t material = 0;

  std::size_t hash() const { return 3 * a.hash() + 5 * b.hash(); }
  friend bool operator==(const SampleKey&, const SampleKey&) = default;
};

// The surface and its radiance. On a smooth surface it does not depend on the triangle.
struct ShadedPoint {
  SurfacePoint surface;
  glm::dvec3 radiance;
};
using RecentSamples = RecentValues<SampleKey, ShadedPoint, 2048>;

// Samples a triangle. Triangles of the mesh share the samples at their vertices and in the middles of their
// edges: the values are the same in both, because a sum of two terms does not depend on their order.
class Sampler {
 public:
  Sampler(const Scene& scene, std::span<const Light> lights, const ScreenTriangle& triangle,
          RecentSamples& recent, SetupCounts& counts)
      : scene_(scene),
        lights_(lights),
        triangle_(triangle),
        material_(scene.materials[triangle.material]),
        recent_(recent),
        counts_(counts) {}

  Sample at(const Corner& corner) const { return sample(corner, shaded(corner.barycentric)); }
  Sample at_vertex(std::size_t i) const {
    const ScreenVertex& v = triangle_.vertex[i];
    return shared({{v.x, v.y}, barycentric_at_vertex(i)}, i, i);
  }
  /// In the middle of the edge between vertices i and j, which are the samples a and b.
  Sample at_edge(const Sample& a, std::size_t i, const Sample& b, std::size_t j) const {
    return shared(middle_of(a, b), i, j);
  }
  /// `a` and `b` are in units of one level, the sample's point in units of the next.
  Sample between(const Sample& a, const Sample& b) const { return at(middle_of(a, b)); }
  /// The radiance at the centre of a pixel.
  glm::dvec3 at_centre(Pixel pixel, int subpixel_bits) const {
    ++counts_.shaded;
    return shaded(barycentric_at_centre(triangle_, subpixel_bits, pixel.x, pixel.y)).radiance;
  }
  const Material& material() const { return material_; }
  const Scene& scene() const { return scene_; }
  std::span<const Light> lights() const { return lights_; }

 private:
  static Corner middle_of(const Sample& a, const Sample& b) {
    return {middle(a.corner.point, b.corner.point), (a.corner.barycentric + b.corner.barycentric) * 0.5};
  }
  Sample sample(const Corner& corner, const ShadedPoint& point) const {
    ++counts_.shaded;
    return {corner, point.surface, point.radiance};
  }
  // The sample in the middle between vertices i and j.
  Sample shared(const Corner& corner, std::size_t i, std::size_t j) const {
    if (!triangle_.is_whole) return at(corner);
    const VertexKey a = key_of(i), b = key_of(j);
    const ShadedPoint& point = recent_.get({std::min(a, b), std::max(a, b), triangle_.material},
                                           [&] { return shaded(corner.barycentric); });
    return point.surface.is_smooth() ? sample(corner, point) : at(corner);
  }
  VertexKey key_of(std::size_t vertex) const {
    return vertex_key(scene_.triangles[triangle_.source], (3 - vertex) % 3);
  }
  ShadedPoint shaded(const glm::dvec3& barycentric) const {
    const SurfacePoint surface = surface_point(triangle_, barycentric);
    return {surface, radiance(scene_, lights_, material_, surface.position_world, surface.normal_world)};
  }

  const Scene& scene_;
  std::span<const Light> lights_;
  const ScreenTriangle& triangle_;
  const Material& material_;
  RecentSamples& recent_;
  SetupCounts& counts_;
};

// A plane that is never tested needs no samples at midpoints.
Piece whole(const Sampler& sampler, bool midpoints) {
  const Sample a = sampler.at_vertex(0), b = sampler.at_vertex(1), c = sampler.at_vertex(2);
  if (!midpoints) return {{a, b, c}, 0};
  return {{a, b, c, sampler.at_edge(a, 0, b, 1), sampler.at_edge(a, 0, c, 2), sampler.at_edge(b, 1, c, 2)},
          0};
}

// Converts a sample's point from units of one level to units of the next.
Sample deeper(Sample s) {
  s.corner.point = doubled(s.corner.point);
  return s;
}

std::array<Piece, 4> split(const Piece& p, const Sampler& sampler) {
  // All six in units of the next level.
  const Sample a = deeper(p.samples[0]), b = deeper(p.samples[1]), c = deeper(p.samples[2]);
  const Sample &ab = p.samples[3], &ac = p.samples[4], &bc = p.samples[5];
  const Sample ab_ac = sampler.between(ab, ac), ab_bc = sampler.between(ab, bc),
               ac_bc = sampler.between(ac, bc);
  const auto piece = [&](const Sample& x, const Sample& y, const Sample& z, const Sample& xy,
                         const Sample& xz,
                         const Sample& yz) { return Piece{{x, y, z, xy, xz, yz}, p.level + 1}; };
  return {piece(a, ab, ac, sampler.between(a, ab), sampler.between(a, ac), ab_ac),
          piece(ab, b, bc, sampler.between(ab, b), ab_bc, sampler.between(b, bc)),
          piece(ac, bc, c, ac_bc, sampler.between(ac, c), sampler.between(bc, c)),
          piece(ab, bc, ac, ab_bc, ab_ac, ac_bc)};
}

// Sets the radiance at the midpoints to that of the plane through the vertices. Returns the largest change,
// in colour steps.
double flatten(SampledTriangle& t) {
  double largest = 0.0;
  for (const auto& [middle, a, b] : {std::array{3, 0, 1}, {4, 0, 2}, {5, 1, 2}}) {
    const auto at = [&](int i) -> glm::dvec3& { return t.radiance[static_cast<std::size_t>(i)]; };
    const glm::dvec3 on_plane = 0.5 * (at(a) + at(b)), change = glm::abs(at(middle) - on_plane);
    largest = std::max({largest, change.r, change.g, change.b});
    at(middle) = on_plane;
  }
  return 255.0 * largest;
}

// Normals that nearly cancel turn unevenly, which the conservative test does not expect.
bool normals_nearly_cancel(const SampledTriangle& t) {
  constexpr double c_least_part = 0.7;
  double least = t.surface[0].normal_length, most = least;
  for (const SurfacePoint& point : t.surface) {
    least = std::min(least, point.normal_length);
    most = std::max(most, point.normal_length);
  }
  return least < c_least_part * most;
}

bool is_above_threshold(const Piece& p, const Sampler& sampler, const QuadraticSetupOptions& options,
                        int degree) {
  if (options.test == HighlightTest::none) return false;
  SampledTriangle t;
  for (std::size_t i = 0; i < 6; ++i) {
    t.surface[i] = p.samples[i].surface;
    t.radiance[i] = p.samples[i].radiance;
  }
  if (options.test == HighlightTest::proved ||
      (options.test == HighlightTest::conservative && normals_nearly_cancel(t)))
    return !(proved_bound(sampler.scene(), sampler.lights(), sampler.material(), t) +
                 (degree == 1 ? c_midpoint_weights * flatten(t) : 0.0) <=
             options.threshold);
  if (options.test == HighlightTest::conservative &&
      may_miss_highlight(sampler.scene(), sampler.material(), t, options.threshold))
    return true;
  if (degree == 1 && flatten(t) > options.threshold) return true;
  const glm::dvec3 centroid =
      (p.samples[0].corner.barycentric + p.samples[1].corner.barycentric + p.samples[2].corner.barycentric) /
      3.0;
  return centroid_error(t, sampler.at({{}, centroid}).radiance) > options.threshold;
}

std::array<ScreenPoint, 3> screen_points(const Piece& p) {
  return {p.samples[0].corner.point, p.samples[1].corner.point, p.samples[2].corner.point};
}

bool is_small(const std::array<ScreenPoint, 3>& p, int unit_bits) {
  const auto [x0, x1] = std::minmax({p[0].x, p[1].x, p[2].x});
  const auto [y0, y1] = std::minmax({p[0].y, p[1].y, p[2].y});
  return std::max(x1 - x0, y1 - y0) <= c_small_pixels << unit_bits;
}

// Calls leaf(piece) for each piece that is not split. A small piece that is drawn pixel by pixel has no error
// to test.
template <class Leaf>
void subdivide(const Piece& p, const Sampler& sampler, const QuadraticSetupOptions& options, int degree,
               int subpixel_bits, bool small_by_pixel, SetupCounts& counts, Leaf&& leaf) {
  const bool small = is_small(screen_points(p), subpixel_bits + p.level);
  if (!(small && small_by_pixel) && is_above_threshold(p, sampler, options, degree)) {
    if (!small && p.level < options.max_level) {
      if (p.level == 0) ++counts.subdivided;
      for (const Piece& quarter : split(p, sampler))
        subdivide(quarter, sampler, options, degree, subpixel_bits, small_by_pixel, counts, leaf);
      return;
    }
    ++counts.unresolved;
  }
  ++counts.leaves;
  leaf(p);
}

double clamped_sample(double radiance, SetupCounts& counts) {
  const double steps = radiance * 255.0;
  if (steps <= c_largest_sample) return std::max(0.0, steps);
  ++counts.overexposed;
  return c_largest_sample;
}

template <class Preset>
int channel_low(int degree, int channel) {
  return degree == 1 ? words::QuadraticLayout<Preset, 1>::channel_low(channel)
                     : words::QuadraticLayout<Preset, 2>::channel_low(channel);
}

template <class Preset>
unsigned vector_bits(int degree, int channels) {
  return static_cast<unsigned>(channel_low<Preset>(degree, channels));
}

// Of degree 1: at the vertices.
ChannelSamples clamped_samples(const Piece& piece, int channels, int degree, SetupCounts& counts) {
  ChannelSamples samples{};
  for (int c = 0; c < channels; ++c)
    for (std::size_t i = 0; i < (degree == 1 ? 3 : 6); ++i)
      samples[static_cast<std::size_t>(c)][i] = clamped_sample(piece.samples[i].radiance[c], counts);
  return samples;
}

constexpr int c_exact_fraction = Exact::c_intensity_fraction_bits;

// Appends one vector of preset exact per walk. words_at(start) returns a function, which returns the words of
// channel c.
template <class WordsAt>
void append_walks(const QuadraticStream& to, std::uint32_t triangle, std::span<const Walk> walks,
                  const DepthFit& depth, WordsAt&& words_at) {
  using ChannelAt = Exact::init_channel_at;
  for (const Walk& walk : walks) {
    InitVector init(to.words, vector_bits<Exact>(to.degree, to.channels));
    const DifferenceStart start = difference_start(walk);
    put_header(init, triangle, walk, depth.words(start, half(Exact::c_depth_sum_fraction_bits)));
    const auto channel_words = words_at(start);
    for (int c = 0; c < to.channels; ++c) {
      const QuadraticWords w = channel_words(static_cast<std::size_t>(c));
      const int low = channel_low<Exact>(to.degree, c);
      init.put(ChannelAt::value, w.value, low);
      init.put(ChannelAt::dx, w.dx, low);
      init.put(ChannelAt::de0, w.de0, low);
      init.put(ChannelAt::de1, w.de1, low);
      if (to.degree == 1) continue;
      init.put(ChannelAt::dxx, w.dxx, low);
      init.put(ChannelAt::dxe0, w.dxe0, low);
      init.put(ChannelAt::dxe1, w.dxe1, low);
      init.put(ChannelAt::de0e0, w.de0e0, low);
      init.put(ChannelAt::de0e1, w.de0e1, low);
      init.put(ChannelAt::de1e1, w.de1e1, low);
    }
  }
}

}  // namespace

void append_exact(const QuadraticStream& to, const ExactPiece& piece) {
  const auto append = [&](auto&& words_at) {
    append_walks(to, piece.triangle, piece.walks, piece.depth, words_at);
  };
  const auto sample = [&](std::size_t c, std::size_t i) {
    return fixed(piece.samples[c][i], c_exact_fraction);
  };
  if (to.degree == 1) {
    const PlaneFit plane(piece.points, piece.unit_bits);
    append([&](const DifferenceStart& walk_start) {
      return [&, start = plane.at(walk_start)](std::size_t c) {
        const DepthWords w =
            plane.words({sample(c, 0), sample(c, 1), sample(c, 2)}, start, half(c_exact_fraction));
        return QuadraticWords{.value = w.value, .dx = w.dx, .de0 = w.de0, .de1 = w.de1};
      };
    });
    return;
  }
  const QuadraticFit fit(piece.points, piece.unit_bits);
  append([&](const DifferenceStart& walk_start) {
    return [&, start = fit.at(walk_start)](std::size_t c) {
      return start.words(
          {{sample(c, 0), sample(c, 1), sample(c, 2)}, sample(c, 3), sample(c, 4), sample(c, 5)},
          half(c_exact_fraction));
    };
  });
}

std::size_t append_published(const QuadraticStream& to, std::uint32_t triangle,
                             const std::array<HalfVertex, 3>& p, const ChannelSamples& samples) {
  constexpr int c_fraction = Published::c_intensity_fraction_bits, c_bits = Published::c_intensity_bits;
  using ChannelAt = Published::init_channel_at;
  using Real = long double;
  const Real x2 = p[1].x - p[0].x, y2 = p[1].y - p[0].y, x3 = p[2].x - p[0].x, y3 = p[2].y - p[0].y;
  const Real d = x2 * y3 - y2 * x3;
  const std::vector<HalfTriangle> halves = half_triangles(p);
  for (const HalfTriangle& half_triangle : halves) {
    InitVector init(to.words, vector_bits<Published>(to.degree, to.channels));
    put_header(init, triangle, half_triangle, p);
    const Real u = half_triangle.x_start - p[0].x, v = static_cast<Real>(half_triangle.y) - p[0].y;
    const Real a = half_triangle.slope_start;
    for (int c = 0; c < to.channels; ++c) {
      const int low = channel_low<Published>(to.degree, c);
      const auto sample = [&](std::size_t n) { return Real{samples[static_cast<std::size_t>(c)][n]}; };
      // Degree 1: the midpoints are on the plane through the vertices.
      const auto i = [&](std::size_t n) {
        if (to.degree == 2 || n < 3) return sample(n);
        return (sample(n == 5 ? 1 : 0) + sample(n == 3 ? 1 : 2)) / 2;
      };
      // Solve for T1 to T5 of equation 4 of the quadratic paper, with vertex 1 at the origin and the
      // denominators D and D^2. c2 and c3 are its C2 and C3, q2 and q3 are twice its C12 and C13, b is C23.
      const Real c2 = 4 * i(3) - 3 * i(0) - i(1), c3 = 4 * i(4) - 3 * i(0) - i(2);
      const Real q2 = 2 * (i(0) + i(1) - 2 * i(3)), q3 = 2 * (i(0) + i(2) - 2 * i(4));
      const Real b = 4 * (i(5) - i(3) - i(4) + i(0));
      const Real t1 = (c3 * x2 - c2 * x3) / d, t2 = (c2 * y3 - c3 * y2) / d;
      const Real t3 = (q2 * x3 * x3 - b * x2 * x3 + q3 * x2 * x2) / (d * d);
      const Real t4 = (-2 * q2 * x3 * y3 + b * (x2 * y3 + x3 * y2) - 2 * q3 * x2 * y2) / (d * d);
      const Real t5 = (q2 * y3 * y3 - b * y2 * y3 + q3 * y2 * y2) / (d * d);
      const auto word = [&](Real value) { return Int128{wrapped_word(value, c_fraction, c_bits)}; };
      // value is equation 4 at the first pixel (u, v). dx is equation 5, dxx its change per pixel, dxe0 its
      // change per line along the start edge of slope a. de0 is the change of equation 4 per line along this
      // edge, de0e0 the change of de0 (section 5).
      init.put(ChannelAt::value, word(i(0) + t2 * u + t1 * v + t5 * u * u + t4 * u * v + t3 * v * v + 0.5L),
               low);
      init.put(ChannelAt::dx, word(2 * t5 * u + t4 * v + t5 + t2), low);
      init.put(ChannelAt::de0,
               word(t5 * a * a + (2 * t5 * u + t4 * v + t4 + t2) * a + t4 * u + 2 * t3 * v + t3 + t1), low);
      if (to.degree == 1) continue;
      init.put(ChannelAt::dxx, word(2 * t5), low);
      init.put(ChannelAt::dxe0, word(2 * t5 * a + t4), low);
      init.put(ChannelAt::de0e0, word(2 * (t5 * a * a + t4 * a + t3)), low);
    }
  }
  return halves.size();
}

QuadraticSetup::QuadraticSetup(const Scene& scene, FrameSize frame, const HardwareKey& key,
                               QuadraticSetupOptions options)
    : scene_(&scene),
      lights_(lights_of(scene)),
      frame_(frame),
      preset_(key.preset),
      channels_(static_cast<int>(key.channels)),
      degree_(key.degree),
      init_bits_(preset_ == Preset::exact ? vector_bits<Exact>(degree_, channels_)
                                          : vector_bits<Published>(degree_, channels_)),
      options_(options),
      small_by_pixel_(draws_small_by_pixel(preset_, options.test)),
      projector_(scene, frame,
                 preset_ == Preset::exact ? ProjectionOptions{.subpixel_bits = 4, .clip_to_frame = false}
                                          : ProjectionOptions{.subpixel_bits = 0, .clip_to_frame = true}) {}

// One triangle of preset exact.
class QuadraticSetup::ExactTriangle {
 public:
  ExactTriangle(const QuadraticSetup& setup, const ScreenTriangle& triangle, const Sampler& sampler,
                std::vector<std::uint32_t>& words, SetupCounts& counts)
      : setup_(setup),
        triangle_(triangle),
        words_(words),
        counts_(counts),
        subpixel_bits_(setup.projector_.options().subpixel_bits),
        corners_(screen_points(triangle)),
        depths_(fixed_depths(triangle)),
        sampler_(sampler) {}

  void append() const {
    // A triangle that covers no pixel needs no samples; a small one only those at its pixels.
    const Walks walks = walks_of(corners_, 0);
    if (walks.empty()) return;
    if (is_by_pixel(corners_, 0)) {
      ++counts_.leaves;
      append_pixels(corners_, 0, walks);
      return;
    }
    subdivide(whole(sampler_, setup_.needs_midpoints()), sampler_, setup_.options_, setup_.degree_,
              subpixel_bits_, setup_.small_by_pixel_, counts_, [&](const Piece& piece) {
                const std::array<ScreenPoint, 3> points = screen_points(piece);
                const Walks of_piece = piece.level == 0 ? walks : walks_of(points, piece.level);
                if (of_piece.empty()) return;
                if (is_by_pixel(points, piece.level))
                  append_pixels(points, piece.level, of_piece);
                else
                  append_quadratic(points, piece, of_piece);
              });
  }

 private:
  QuadraticStream stream() const { return {words_, setup_.channels_, setup_.degree_}; }
  Walks walks_of(const std::array<ScreenPoint, 3>& points, int level) const {
    return plan_walks(points, subpixel_bits_ + level, setup_.frame_);
  }
  bool is_by_pixel(const std::array<ScreenPoint, 3>& points, int level) const {
    return setup_.small_by_pixel_ && is_small(points, subpixel_bits_ + level);
  }

  void append_quadratic(const std::array<ScreenPoint, 3>& points, const Piece& piece,
                        const Walks& walks) const {
    append_exact(stream(),
                 {triangle_.source, points, subpixel_bits_ + piece.level, walks, depth_fit(piece.level),
                  clamped_samples(piece, setup_.channels_, setup_.degree_, counts_)});
    counts_.vectors += walks.size();
  }

  void append_pixels(const std::array<ScreenPoint, 3>& points, int level, const Walks& walks) const {
    const std::vector<Pixel> pixels = covered_pixels(points, subpixel_bits_ + level, setup_.frame_);
    std::array<std::vector<std::int64_t>, 3> colour;
    for (const Pixel pixel : pixels) {
      const glm::dvec3 radiance = sampler_.at_centre(pixel, subpixel_bits_);
      for (int c = 0; c < setup_.channels_; ++c)
        colour[static_cast<std::size_t>(c)].push_back(
            fixed(clamped_sample(radiance[c], counts_), c_exact_fraction));
    }
    const PixelFit fit(pixels);
    append_walks(stream(), triangle_.source, walks, depth_fit(level), [&](const DifferenceStart& start) {
      return [&, start](std::size_t c) { return fit.words(colour[c], start, half(c_exact_fraction)); };
    });
    counts_.vectors += walks.size();
  }

  // All pieces use the depth plane of the whole triangle, so that their depths agree.
  DepthFit depth_fit(int level) const {
    std::array<ScreenPoint, 3> scaled = corners_;
    for (ScreenPoint& p : scaled) p = {p.x << level, p.y << level};
    return DepthFit(scaled, subpixel_bits_ + level, depths_);
  }

  const QuadraticSetup& setup_;
  const ScreenTriangle& triangle_;
  std::vector<std::uint32_t>& words_;
  SetupCounts& counts_;
  int subpixel_bits_;
  std::array<ScreenPoint, 3> corners_;
  std::array<std::int64_t, 3> depths_;
  const Sampler& sampler_;
};

class QuadraticSetup::Worker final : public SetupWorker {
 public:
  explicit Worker(const QuadraticSetup& setup) : setup_(setup), mesh_(setup.projector_) {}

  void append(std::uint32_t triangle, std::vector<std::uint32_t>& words, SetupCounts& counts) override {
    for (const ScreenTriangle& t : mesh_.project(triangle, counts.projection)) {
      ++counts.triangles;
      const Sampler sampler(*setup_.scene_, setup_.lights_, t, samples_, counts);
      if (setup_.preset_ == Preset::exact)
        ExactTriangle(setup_, t, sampler, words, counts).append();
      else
        append_published(t, sampler, words, counts);
    }
  }

 private:
  void append_published(const ScreenTriangle& triangle, const Sampler& sampler,
                        std::vector<std::uint32_t>& words, SetupCounts& counts) const {
    const int channels = setup_.channels_, degree = setup_.degree_;
    subdivide(whole(sampler, setup_.needs_midpoints()), sampler, setup_.options_, degree, 0,
              setup_.small_by_pixel_, counts, [&](const Piece& piece) {
                const auto vertex = [&](std::size_t i) {
                  const Sample& sample = piece.samples[i];
                  return half_vertex(sample.corner.point, piece.level, depth_steps(sample.surface.z));
                };
                counts.vectors += halfway::append_published({words, channels, degree}, triangle.source,
                                                            {vertex(0), vertex(1), vertex(2)},
                                                            clamped_samples(piece, channels, degree, counts));
              });
  }

  const QuadraticSetup& setup_;
  MeshProjector mesh_;
  RecentSamples samples_;
};

std::unique_ptr<SetupWorker> QuadraticSetup::worker() const {
  return std::make_unique<Worker>(*this);
}

}  // namespace halfway
