// SPDX-License-Identifier: Apache-2.0
#include "setup/quadratic_setup.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "golden/quadratic_shader.hpp"
#include "reference/shade.hpp"
#include "setup/highlight_bound.hpp"
#include "setup/quadratic_fit.hpp"
#include "setup/walk.hpp"

namespace halfway {
namespace {

using golden::Exact;
using golden::Published;

// A vertex of a piece of a screen triangle: exact on the screen, exact in the triangle's barycentrics.
struct Corner {
  ScreenPoint point;
  glm::dvec3 barycentric;
};

// A surface sample and its radiance, kept so that neighbours in the subdivision share it.
struct Sample {
  Corner corner;
  SurfacePoint surface;
  glm::dvec3 radiance;
};

// Vertices, then midpoints of 1-2, 1-3, 2-3. Vertex points are in units of the piece's own level, and so are
// the midpoints' once doubled: see `deeper`.
using SixPoints = std::array<Sample, 6>;

struct Piece {
  SixPoints samples;
  int level;
};

ScreenPoint doubled(ScreenPoint p) {
  return {2 * p.x, 2 * p.y};
}

// The midpoint in the next level's units, where it is exact.
ScreenPoint middle(ScreenPoint a, ScreenPoint b) {
  return {a.x + b.x, a.y + b.y};
}

class Sampler {
 public:
  Sampler(const Scene& scene, const ScreenTriangle& triangle, SetupCounts& counts)
      : scene_(scene), triangle_(triangle), material_(scene.materials[triangle.material]), counts_(counts) {}

  Sample at(const Corner& corner) const {
    ++counts_.shaded;
    const SurfacePoint surface = surface_point(triangle_, corner.barycentric);
    return {corner, surface, radiance(scene_, material_, surface.position_world, surface.normal_world)};
  }
  /// `a` and `b` in units of one level; the sample's point in units of the next.
  Sample between(const Sample& a, const Sample& b) const {
    return at({middle(a.corner.point, b.corner.point), (a.corner.barycentric + b.corner.barycentric) * 0.5});
  }
  const Material& material() const { return material_; }
  const Scene& scene() const { return scene_; }

 private:
  const Scene& scene_;
  const ScreenTriangle& triangle_;
  const Material& material_;
  SetupCounts& counts_;
};

Piece whole(const ScreenTriangle& t, const Sampler& sampler) {
  std::array<Sample, 3> v;
  for (std::size_t i = 0; i < 3; ++i) {
    glm::dvec3 barycentric(0.0);
    barycentric[static_cast<int>(i)] = 1.0;
    v[i] = sampler.at({{t.vertex[i].x, t.vertex[i].y}, barycentric});
  }
  return {{v[0], v[1], v[2], sampler.between(v[0], v[1]), sampler.between(v[0], v[2]),
           sampler.between(v[1], v[2])},
          0};
}

// A sample whose point is in units of a level, in units of the next one.
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
                         const Sample& xz, const Sample& yz) {
    return Piece{{x, y, z, xy, xz, yz}, p.level + 1};
  };
  return {piece(a, ab, ac, sampler.between(a, ab), sampler.between(a, ac), ab_ac),
          piece(ab, b, bc, sampler.between(ab, b), ab_bc, sampler.between(b, bc)),
          piece(ac, bc, c, ac_bc, sampler.between(ac, c), sampler.between(bc, c)),
          piece(ab, bc, ac, ab_bc, ab_ac, ac_bc)};
}

bool needs_split(const Piece& p, const Sampler& sampler, const QuadraticSetupOptions& options) {
  if (options.test == HighlightTest::none) return false;
  SampledTriangle t;
  for (std::size_t i = 0; i < 6; ++i) {
    t.surface[i] = p.samples[i].surface;
    t.radiance[i] = p.samples[i].radiance;
  }
  if (options.test == HighlightTest::conservative &&
      missed_highlight_bound(sampler.scene(), sampler.material(), t) > options.threshold)
    return true;
  const glm::dvec3 centroid =
      (p.samples[0].corner.barycentric + p.samples[1].corner.barycentric + p.samples[2].corner.barycentric) /
      3.0;
  return centroid_error(t, sampler.at({{}, centroid}).radiance) > options.threshold;
}

// A triangle of at most this many pixels either way is not worth splitting.
constexpr std::int32_t c_least_pixels = 2;

bool is_small(const Piece& p, int subpixel_bits) {
  const auto [x0, x1] =
      std::minmax({p.samples[0].corner.point.x, p.samples[1].corner.point.x, p.samples[2].corner.point.x});
  const auto [y0, y1] =
      std::minmax({p.samples[0].corner.point.y, p.samples[1].corner.point.y, p.samples[2].corner.point.y});
  return std::max(x1 - x0, y1 - y0) <= c_least_pixels << (subpixel_bits + p.level);
}

template <class Leaf>
void subdivide(const Piece& p, const Sampler& sampler, const QuadraticSetupOptions& options,
               int subpixel_bits, SetupCounts& counts, Leaf&& leaf) {
  if (!is_small(p, subpixel_bits) && needs_split(p, sampler, options)) {
    if (p.level < options.max_level) {
      if (p.level == 0) ++counts.subdivided;
      for (const Piece& quarter : split(p, sampler))
        subdivide(quarter, sampler, options, subpixel_bits, counts, leaf);
      return;
    }
    ++counts.unresolved;
  }
  ++counts.leaves;
  leaf(p);
}

double held_sample(double radiance, SetupCounts& counts) {
  const double steps = radiance * 255.0;
  if (steps <= c_largest_sample) return std::max(0.0, steps);
  ++counts.overexposed;
  return c_largest_sample;
}

// One init vector under construction, at the end of a list of words.
template <class Preset>
class InitVector {
 public:
  InitVector(std::vector<std::uint32_t>& words, unsigned bits) {
    const std::size_t begin = words.size(), count = (bits + 31) / 32;
    words.resize(begin + count, 0);
    words_ = std::span(words).subspan(begin, count);
  }
  void put(const golden::Field& field, std::int64_t value) {
    golden::set_bits(words_, field, static_cast<std::uint64_t>(value));
  }
  // Sums wrap modulo the field's width, so a start word may as well.
  void put_wrapped(const golden::Field& field, Int128 value) {
    golden::set_bits(words_, field, static_cast<std::uint64_t>(value));
  }
  void put_channel(int channel, const golden::Field& field, Int128 value) {
    golden::set_bits(words_, field, static_cast<std::uint64_t>(value),
                     Preset::c_init_header_bits + channel * Preset::c_init_channel_bits);
  }

 private:
  std::span<std::uint32_t> words_;
};

constexpr double c_depth_steps = double((1 << Exact::c_depth_bits) - 1);

std::int64_t fixed(double value, int fraction_bits) {
  return std::llround(std::ldexp(value, fraction_bits));
}

// Depth words keep one step clear of either end, so that rounding never wraps the 24 bits.
std::array<std::int64_t, 3> fixed_depths(const ScreenTriangle& t) {
  std::array<std::int64_t, 3> z;
  for (std::size_t i = 0; i < 3; ++i)
    z[i] = fixed(std::clamp(t.vertex[i].z * c_depth_steps, 1.0, c_depth_steps - 2.0),
                 Exact::c_depth_sum_fraction_bits);
  return z;
}

constexpr std::int64_t half(int fraction_bits) {
  return std::int64_t{1} << (fraction_bits - 1);
}

void put_section(InitVector<Exact>& init, const EdgeSection& s, const golden::Field& x,
                 const golden::Field& quotient, const golden::Field& remainder, const golden::Field& divisor,
                 const golden::Field& error, const golden::Field& carry) {
  init.put(x, s.pixel);
  init.put(quotient, s.quotient);
  init.put(remainder, s.remainder);
  init.put(divisor, s.divisor);
  init.put(error, s.error);
  init.put(carry, s.carry);
}

// Word of a real number modulo 2^bits; a sliver's differences may be far past any integer type.
std::int64_t wrapped_word(long double value, int fraction_bits, int bits) {
  const long double modulus = std::ldexp(1.0L, bits);
  return static_cast<std::int64_t>(std::fmod(std::rint(std::ldexp(value, fraction_bits)), modulus));
}

}  // namespace

SetupCounts& SetupCounts::operator+=(const SetupCounts& o) {
  projection += o.projection;
  triangles += o.triangles;
  subdivided += o.subdivided;
  leaves += o.leaves;
  vectors += o.vectors;
  shaded += o.shaded;
  overexposed += o.overexposed;
  unresolved += o.unresolved;
  return *this;
}

QuadraticSetup::QuadraticSetup(const Scene& scene, FrameSize frame, const HardwareKey& key,
                               QuadraticSetupOptions options)
    : scene_(&scene),
      frame_(frame),
      preset_(key.preset),
      channels_(static_cast<int>(key.channels)),
      init_bits_(static_cast<unsigned>(
          preset_ == Preset::exact
              ? Exact::c_init_header_bits + channels_ * Exact::c_init_channel_bits
              : Published::c_init_header_bits + channels_ * Published::c_init_channel_bits)),
      options_(options),
      projector_(scene, frame,
                 preset_ == Preset::exact ? ProjectionOptions{.subpixel_bits = 4, .clip_to_frame = false}
                                          : ProjectionOptions{.subpixel_bits = 0, .clip_to_frame = true}) {}

void QuadraticSetup::append(std::uint32_t triangle, std::vector<std::uint32_t>& words,
                            SetupCounts& counts) const {
  std::vector<ScreenTriangle> on_screen;
  projector_.project(triangle, on_screen, counts.projection);
  for (const ScreenTriangle& t : on_screen) {
    ++counts.triangles;
    if (preset_ == Preset::exact)
      append_exact(t, words, counts);
    else
      append_published(t, words, counts);
  }
}

void QuadraticSetup::append_exact(const ScreenTriangle& triangle, std::vector<std::uint32_t>& words,
                                  SetupCounts& counts) const {
  const int subpixel_bits = projector_.options().subpixel_bits;
  const std::array<ScreenPoint, 3> corners = {{{triangle.vertex[0].x, triangle.vertex[0].y},
                                               {triangle.vertex[1].x, triangle.vertex[1].y},
                                               {triangle.vertex[2].x, triangle.vertex[2].y}}};
  // A triangle that covers no pixel needs no sample.
  if (plan_walks(corners, subpixel_bits, frame_).empty()) return;
  const Sampler sampler(*scene_, triangle, counts);
  const std::array<std::int64_t, 3> depths = fixed_depths(triangle);
  constexpr int c_fraction = Exact::c_intensity_fraction_bits;
  using At = Exact::init_header_at;
  using ChannelAt = Exact::init_channel_at;

  subdivide(whole(triangle, sampler), sampler, options_, subpixel_bits, counts, [&](const Piece& piece) {
    const int unit_bits = subpixel_bits + piece.level;
    const auto& s = piece.samples;
    const std::array<ScreenPoint, 3> points = {s[0].corner.point, s[1].corner.point, s[2].corner.point};
    const std::vector<Walk> walks = plan_walks(points, unit_bits, frame_);
    if (walks.empty()) return;
    std::array<ScreenPoint, 3> scaled = corners;
    for (ScreenPoint& p : scaled) p = {p.x << piece.level, p.y << piece.level};
    // Depth follows the whole triangle's plane, so that its pieces agree.
    const DepthFit depth(scaled, unit_bits, depths);
    const QuadraticFit fit(points, unit_bits);
    std::array<SixSamples, 3> channel;
    for (int c = 0; c < channels_; ++c) {
      const auto sample = [&](std::size_t i) {
        return fixed(held_sample(s[i].radiance[c], counts), c_fraction);
      };
      channel[static_cast<std::size_t>(c)] = {
          {sample(0), sample(1), sample(2)}, sample(3), sample(4), sample(5)};
    }
    for (const Walk& walk : walks) {
      ++counts.vectors;
      InitVector<Exact> init(words, init_bits_);
      init.put(At::triangle, triangle.source);
      init.put(At::y, walk.y);
      init.put(At::upper_lines, walk.upper_lines);
      init.put(At::lower_lines, walk.lower_lines);
      init.put(At::backward, walk.backward);
      put_section(init, walk.start, At::start_x, At::start_quotient, At::start_remainder, At::start_divisor,
                  At::start_error, At::start_carry);
      put_section(init, walk.upper, At::upper_x, At::upper_quotient, At::upper_remainder, At::upper_divisor,
                  At::upper_error, At::upper_carry);
      put_section(init, walk.lower, At::lower_x, At::lower_quotient, At::lower_remainder, At::lower_divisor,
                  At::lower_error, At::lower_carry);
      const DifferenceStart start{walk.start.pixel, walk.y, walk.start.quotient, walk.backward};
      const DepthWords z = depth.words(start, half(Exact::c_depth_sum_fraction_bits));
      init.put_wrapped(At::z, z.value);
      init.put_wrapped(At::z_dx, z.dx);
      init.put_wrapped(At::z_de0, z.de0);
      init.put_wrapped(At::z_de1, z.de1);
      for (int c = 0; c < channels_; ++c) {
        const QuadraticWords w = fit.words(channel[static_cast<std::size_t>(c)], start, half(c_fraction));
        init.put_channel(c, ChannelAt::value, w.value);
        init.put_channel(c, ChannelAt::dx, w.dx);
        init.put_channel(c, ChannelAt::de0, w.de0);
        init.put_channel(c, ChannelAt::de1, w.de1);
        init.put_channel(c, ChannelAt::dxx, w.dxx);
        init.put_channel(c, ChannelAt::dxe0, w.dxe0);
        init.put_channel(c, ChannelAt::dxe1, w.dxe1);
        init.put_channel(c, ChannelAt::de0e0, w.de0e0);
        init.put_channel(c, ChannelAt::de0e1, w.de0e1);
        init.put_channel(c, ChannelAt::de1e1, w.de1e1);
      }
    }
  });
}

void QuadraticSetup::append_published(const ScreenTriangle& triangle, std::vector<std::uint32_t>& words,
                                      SetupCounts& counts) const {
  const Sampler sampler(*scene_, triangle, counts);
  constexpr int c_fraction = Published::c_intensity_fraction_bits, c_bits = Published::c_intensity_bits;
  constexpr int c_x_fraction = Published::c_edge_x_fraction_bits, c_x_bits = Published::c_edge_x_bits;
  constexpr int c_z_fraction = Published::c_depth_sum_fraction_bits, c_z_bits = Published::c_depth_sum_bits;
  using At = Published::init_header_at;
  using ChannelAt = Published::init_channel_at;
  using Real = long double;

  subdivide(whole(triangle, sampler), sampler, options_, 0, counts, [&](const Piece& piece) {
    // Vertices are whole pixels: a midpoint between them is rounded, and a T-junction may open (a published
    // fault).
    struct Vertex {
      Real x, y, z;
      std::array<Real, 3> value;
    };
    const auto vertex = [&](std::size_t i) {
      const Corner& corner = piece.samples[i].corner;
      const auto whole_pixel = [&](std::int32_t v) {
        return static_cast<Real>(floor_divide(2 * std::int64_t{v} + (std::int64_t{1} << piece.level),
                                              std::int64_t{2} << piece.level)
                                     .quotient);
      };
      Vertex v{whole_pixel(corner.point.x),
               whole_pixel(corner.point.y),
               std::clamp(piece.samples[i].surface.z * c_depth_steps, 1.0, c_depth_steps - 2.0),
               {}};
      for (int c = 0; c < channels_; ++c)
        v.value[static_cast<std::size_t>(c)] = held_sample(piece.samples[i].radiance[c], counts);
      return v;
    };
    const std::array<Vertex, 3> p = {vertex(0), vertex(1), vertex(2)};
    const Real x2 = p[1].x - p[0].x, y2 = p[1].y - p[0].y, x3 = p[2].x - p[0].x, y3 = p[2].y - p[0].y;
    const Real d = x2 * y3 - y2 * x3;
    if (d == 0) return;
    std::array<std::size_t, 3> order = {0, 1, 2};
    std::ranges::sort(order, [&](std::size_t a, std::size_t b) { return p[a].y < p[b].y; });
    const Vertex &top = p[order[0]], &mid = p[order[1]], &bottom = p[order[2]];
    const Real zu = ((p[1].z - p[0].z) * y3 - (p[2].z - p[0].z) * y2) / d;
    const Real zv = ((p[2].z - p[0].z) * x2 - (p[1].z - p[0].z) * x3) / d;

    // Whole numbers: a rounded edge could fall on the wrong side of a vertex that it meets.
    const bool long_left = (bottom.x - top.x) * (mid.y - top.y) < (mid.x - top.x) * (bottom.y - top.y);

    // The lines from one vertex to the next below it; the long edge runs past both.
    const auto half_triangle = [&](const Vertex& from, const Vertex& to) {
      if (from.y == to.y) return;
      ++counts.vectors;
      InitVector<Published> init(words, init_bits_);
      const Real along = (bottom.x - top.x) / (bottom.y - top.y);
      const Real x_long = top.x + (from.y - top.y) * along, slope_short = (to.x - from.x) / (to.y - from.y);
      const Real x_start = long_left ? x_long : from.x, slope_start = long_left ? along : slope_short;
      const Real x_stop = long_left ? from.x : x_long, slope_stop = long_left ? slope_short : along;
      init.put(At::triangle, triangle.source);
      init.put(At::y, static_cast<std::int64_t>(from.y));
      init.put(At::upper_lines, static_cast<std::int64_t>(to.y - from.y) + 1);
      // The half makes the whole part the nearest pixel.
      init.put(At::start_x, wrapped_word(x_start + 0.5L, c_x_fraction, c_x_bits));
      init.put(At::start_slope, wrapped_word(slope_start, c_x_fraction, c_x_bits));
      init.put(At::upper_x, wrapped_word(x_stop + 0.5L, c_x_fraction, c_x_bits));
      init.put(At::upper_slope, wrapped_word(slope_stop, c_x_fraction, c_x_bits));
      const Real u = x_start - p[0].x, v = from.y - p[0].y, a = slope_start;
      init.put(At::z, wrapped_word(p[0].z + zu * u + zv * v + 0.5L, c_z_fraction, c_z_bits));
      init.put(At::z_dx, wrapped_word(zu, c_z_fraction, c_z_bits));
      init.put(At::z_de0, wrapped_word(zu * a + zv, c_z_fraction, c_z_bits));
      for (int c = 0; c < channels_; ++c) {
        const auto i = [&](std::size_t n) {
          return n < 3 ? p[n].value[static_cast<std::size_t>(c)]
                       : static_cast<Real>(held_sample(piece.samples[n].radiance[c], counts));
        };
        const Real c2 = 4 * i(3) - 3 * i(0) - i(1), c3 = 4 * i(4) - 3 * i(0) - i(2);
        const Real q2 = 2 * (i(0) + i(1) - 2 * i(3)), q3 = 2 * (i(0) + i(2) - 2 * i(4));
        const Real b = 4 * (i(5) - i(3) - i(4) + i(0));
        const Real t1 = (c3 * x2 - c2 * x3) / d, t2 = (c2 * y3 - c3 * y2) / d;
        const Real t3 = (q2 * x3 * x3 - b * x2 * x3 + q3 * x2 * x2) / (d * d);
        const Real t4 = (-2 * q2 * x3 * y3 + b * (x2 * y3 + x3 * y2) - 2 * q3 * x2 * y2) / (d * d);
        const Real t5 = (q2 * y3 * y3 - b * y2 * y3 + q3 * y2 * y2) / (d * d);
        const auto word = [&](Real value) { return Int128{wrapped_word(value, c_fraction, c_bits)}; };
        init.put_channel(c, ChannelAt::value,
                         word(i(0) + t2 * u + t1 * v + t5 * u * u + t4 * u * v + t3 * v * v + 0.5L));
        init.put_channel(c, ChannelAt::dx, word(2 * t5 * u + t4 * v + t5 + t2));
        init.put_channel(
            c, ChannelAt::de0,
            word(t5 * a * a + (2 * t5 * u + t4 * v + t4 + t2) * a + t4 * u + 2 * t3 * v + t3 + t1));
        init.put_channel(c, ChannelAt::dxx, word(2 * t5));
        init.put_channel(c, ChannelAt::dxe0, word(2 * t5 * a + t4));
        init.put_channel(c, ChannelAt::de0e0, word(2 * (t5 * a * a + t4 * a + t3)));
      }
    };
    half_triangle(top, mid);
    half_triangle(mid, bottom);
  });
}

}  // namespace halfway
