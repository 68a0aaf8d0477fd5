// SPDX-License-Identifier: Apache-2.0
#include "setup/spherical_setup.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <utility>

#include "common/cosine_power.hpp"
#include "scene/lights.hpp"
#include "setup/half_triangle.hpp"
#include "setup/span_bound.hpp"
#include "setup/walk_header.hpp"
#include "shading/arc.hpp"
#include "shading/shade.hpp"

namespace halfway {
namespace {

using words::Exact, words::Published;

// Beyond the end of any bell, so that the bell is zero.
constexpr double c_outside = 2.0;

// If the cosine of the angle between a span's ends is below this, the middle is needed: the ends of an arc of
// nearly pi do not define its plane.
constexpr double c_nearly_opposed = -0.99;

// From the peak of a cosine to its zero.
constexpr double c_half_bell = 0.5 * std::numbers::pi;

bool nearly_opposed(glm::dvec3 a, glm::dvec3 b) {
  return glm::dot(a, b) < c_nearly_opposed;
}

bool is_there(glm::dvec3 direction) {
  return direction != glm::dvec3(0.0);
}

// Where the triangle's edges cross the centre of a line, left and right, and the position along the edge.
struct EdgeCrossing {
  double x;  // pixels
  std::size_t top, bottom;
  double t;
};

std::array<EdgeCrossing, 2> crossings(const ScreenTriangle& triangle, int subpixel_bits, std::uint32_t y) {
  const double unit = 1 << subpixel_bits, centre = (y + 0.5) * unit;
  std::array<EdgeCrossing, 2> side{};
  bool any = false;
  for (std::size_t i = 0; i < 3; ++i) {
    std::size_t top = i, bottom = (i + 1) % 3;
    if (triangle.vertex[bottom].y < triangle.vertex[top].y) std::swap(top, bottom);
    const ScreenVertex &a = triangle.vertex[top], &b = triangle.vertex[bottom];
    if (a.y == b.y || centre < a.y || centre > b.y) continue;
    const double t = (centre - a.y) / (b.y - a.y);
    const EdgeCrossing here{(a.x + t * (b.x - a.x)) / unit, top, bottom, t};
    if (!any || here.x < side[0].x) side[0] = here;
    if (!any || here.x > side[1].x) side[1] = here;
    any = true;
  }
  return side;
}

double clamped_exponent(const Material& material) {
  return std::min(material.exponent, c_largest_exponent);
}

}  // namespace

Bells fitted_bells(const Scene& scene, unsigned powers) {
  std::vector<double> exponents;
  for (const Material& m : scene.materials) exponents.push_back(clamped_exponent(m));
  return fitted_bells(exponents, powers);
}

SphericalSetup::SphericalSetup(const Scene& scene, FrameSize frame, const HardwareKey& key,
                               SphericalSetupOptions options)
    : scene_(&scene),
      scene_lights_(lights_of(scene)),
      frame_(frame),
      preset_(key.preset),
      options_(std::move(options)),
      config_(golden_config(key)),
      own_tables_(!key.spherical.own.empty()),
      has_records_(key.spherical.records()),
      init_bits_(static_cast<unsigned>(preset_ == Preset::exact
                                           ? words::SphericalLayout<Exact>(config_).init_bits()
                                           : words::SphericalLayout<Published>(config_).init_bits())),
      projector_(scene, frame,
                 preset_ == Preset::exact ? ProjectionOptions{.subpixel_bits = 4, .clip_to_frame = false}
                                          : ProjectionOptions{.subpixel_bits = 0, .clip_to_frame = true}) {
  for (const LightRef light : reflected_lights(scene)) lights_.push_back(light_of(scene, light));
  const std::vector<double>& own = key.spherical.own;
  if (preset_ == Preset::exact && own.empty() && !options_.bells)
    options_.bells = std::make_shared<const Bells>(fitted_bells(scene));
  for (const Material& m : scene.materials)
    bells_.push_back(preset_ == Preset::published ? Bell{2, published_scale(clamped_exponent(m))}
                     : own.empty()                ? options_.bells->at(clamped_exponent(m))
                                                  : own_bell(own, m.exponent));
}

PointVectors SphericalSetup::vectors_at(const Material& material, const SurfacePoint& point) const {
  PointVectors out;
  out.normal = point.normal_world;
  glm::dvec3 to_eye = direction(point.position_world, scene_->camera.eye_world);
  if (to_eye == glm::dvec3(0.0)) to_eye = point.normal_world;
  for (std::size_t i = 0; i < lights_.size(); ++i) {
    const Light& source = lights_[i];
    LightVectors& light = out.light[i];
    light = {};
    light.to_light = direction_to(source, point.position_world);
    light.spot = cone_share(source, light.to_light);
    if (!config_.specular || !has_specular(material) || !is_there(light.to_light)) continue;
    if (material.brdf == Brdf::phong) {
      light.u = 2.0 * glm::dot(out.normal, light.to_light) * out.normal - light.to_light;
      light.v = to_eye;
    } else {
      const glm::dvec3 sum = light.to_light + to_eye;
      const double length = glm::length(sum);
      light.u = out.normal;
      light.v = length > 0.0 ? sum / length : glm::dvec3(0.0);
    }
  }
  return out;
}

PointVectors SphericalSetup::slerped(const PointVectors& a, const PointVectors& b, double t) const {
  PointVectors out;
  out.normal = slerp(a.normal, b.normal, t);
  for (std::size_t i = 0; i < lights_.size(); ++i) {
    const LightVectors &la = a.light[i], &lb = b.light[i];
    out.light[i] = {slerp(la.to_light, lb.to_light, t), slerp(la.u, lb.u, t), slerp(la.v, lb.v, t),
                    la.spot + t * (lb.spot - la.spot)};
  }
  return out;
}

template <class P>
std::int64_t SphericalSetup::factor_word(double steps, SetupCounts& counts) const {
  // Treat NaN as 0. It results from infinite light on a material that reflects none of it.
  if (!(steps > 0.0)) return 0;
  if (steps > c_largest_factor<P>) ++counts.overexposed;
  return fixed(std::min(steps, c_largest_factor<P>), P::c_factor_fraction_bits);
}

void SphericalSetup::put_ambient(InitVector& init, const Material& material, SetupCounts& counts) const {
  const words::SphericalLayout<Exact> exact(config_);
  const words::SphericalLayout<Published> published(config_);
  const glm::dvec3 ambient = ambient_radiance(*scene_, material);
  for (int c = 0; c < config_.channels; ++c) {
    // Add one half: truncating the sum's fraction then rounds.
    const double steps = 255.0 * ambient[c] + 0.5;
    if (preset_ == Preset::exact)
      init.put(Exact::ambient_channel_at::ambient, factor_word<Exact>(steps, counts), exact.ambient_low(c));
    else
      init.put(Published::ambient_channel_at::ambient, factor_word<Published>(steps, counts),
               published.ambient_low(c));
  }
}

template <class Middle>
void SphericalSetup::set_arcs(const Material& material, const SpanVectors& span, Middle&& middle,
                              std::span<LightArcs> out) const {
  const bool specular = config_.specular && has_specular(material);
  std::optional<PointVectors> known_middle;
  const auto at_middle = [&]() -> const PointVectors& {
    if (!known_middle) known_middle = middle();
    return *known_middle;
  };
  for (std::size_t i = 0; i < lights_.size(); ++i) {
    const LightVectors &a = span.begin.light[i], &b = span.end.light[i];
    LightArcs& arcs = out[i];
    ArcMiddle hint;
    if (nearly_opposed(span.begin.normal, span.end.normal) || nearly_opposed(a.to_light, b.to_light))
      hint = {at_middle().normal, at_middle().light[i].to_light};
    arcs.diffuse = cosine_arc(span.begin.normal, span.end.normal, a.to_light, b.to_light, hint);
    arcs.specular = {};
    if (specular) {
      hint = {};
      if (nearly_opposed(a.u, b.u) || nearly_opposed(a.v, b.v))
        hint = {at_middle().light[i].u, at_middle().light[i].v};
      arcs.specular = cosine_arc(a.u, b.u, a.v, b.v, hint);
    }
    arcs.spot = 0.5 * (a.spot + b.spot);
    arcs.exact_at_ends =
        a.spot == b.spot && is_there(a.to_light) == is_there(b.to_light) && is_there(a.v) == is_there(b.v);
  }
}

template <class P>
void SphericalSetup::put_record(InitVector& record, std::uint32_t material_index, const SpanArcs& span,
                                SetupCounts& counts) const {
  constexpr bool c_exact = std::is_same_v<P, Exact>;
  // The published cosine table covers the full period, so its angles are in units of half turns.
  constexpr double c_diffuse_unit = c_exact ? c_half_bell : std::numbers::pi;
  const words::SphericalLayout<P> at(config_);
  const Material& material = scene_->materials[material_index];
  const Bell& bell = bells_[material_index];
  // A table's largest entry is 2^D - 1 and represents 1.
  const auto entries = static_cast<double>(1 << config_.size.data_bits);
  const double full = entries / (entries - 1.0);
  const bool diffuse = has_diffuse(material), specular = config_.specular && has_specular(material);

  // Write angle and slope in the table's unit. A light with zero amplitude stays dark at any angle.
  const auto put_angle = [&](const words::Field& angle, const words::Field& slope, const CosineArc& arc,
                             double scale, int low) {
    const double start = arc.amplitude > 0.0 ? scale * (span.first * arc.sweep - arc.phase) : c_outside;
    const double step = arc.amplitude > 0.0 ? scale * span.step * arc.sweep : 0.0;
    const double centred =
        own_tables_ ? centred_start(start, step, span.steps, P::c_angle_fraction_bits) : start;
    record.put(angle, wrapped_word(centred, P::c_angle_fraction_bits, P::c_angle_bits), low);
    record.put(slope, wrapped_word(step, P::c_angle_fraction_bits, P::c_angle_bits), low);
  };

  for (std::size_t i = 0; i < lights_.size(); ++i) {
    const LightArcs& arcs = span.light[i];
    const int light = static_cast<int>(i);
    const glm::dvec3 steps = 255.0 * full * arcs.spot * lights_[i].intensity;
    if (at.has_diffuse_part() && (diffuse || specular)) {
      using At = typename P::diffuse_header_at;
      const int low = at.diffuse_low(light);
      put_angle(At::angle, At::slope, arcs.diffuse, 1.0 / c_diffuse_unit, low);
      for (int c = 0; c < at.diffuse_channels(); ++c)
        record.put(
            P::diffuse_channel_at::factor,
            factor_word<P>(steps[c] * material.diffuse * material.colour[c] * arcs.diffuse.amplitude, counts),
            low + P::c_diffuse_header_bits + c * P::c_diffuse_channel_bits);
    }
    if (specular) {
      using At = typename P::specular_header_at;
      const int low = at.specular_low(light);
      put_angle(At::angle, At::slope, arcs.specular, bell.scale / c_half_bell, low);
      if constexpr (c_exact) record.put(At::power, std::countr_zero(static_cast<unsigned>(bell.power)), low);
      const double peak = bell.gain * highlight_power(arcs.specular.amplitude,
                                                      std::min(material.exponent, c_largest_exponent));
      for (int c = 0; c < config_.highlight_channels; ++c)
        record.put(P::specular_channel_at::factor,
                   factor_word<P>(steps[c] * material.specular * material.specular_colour[c] * peak, counts),
                   low + P::c_specular_header_bits + c * P::c_specular_channel_bits);
    }
  }
}

double SphericalSetup::interpolation_error(const Material& material, const SpanArcs& span, double t,
                                           const SurfacePoint& there) const {
  glm::dvec3 sum = ambient_radiance(*scene_, material);
  for (std::size_t i = 0; i < lights_.size(); ++i) {
    const LightArcs& arcs = span.light[i];
    const double cosine = arcs.diffuse.at(t);
    if (!(cosine > 0.0)) continue;
    const double highlight =
        has_specular(material) ? highlight_power(arcs.specular.at(t), material.exponent) : 0.0;
    sum += arcs.spot * lights_[i].intensity *
           (cosine * material.diffuse * material.colour +
            highlight * material.specular * material.specular_colour);
  }
  const glm::dvec3 truth =
      radiance(*scene_, scene_lights_, material, there.position_world, there.normal_world);
  double largest = 0.0;
  for (int c = 0; c < 3; ++c)
    largest = std::max(largest, std::abs(std::min(sum[c], 1.0) - std::min(truth[c], 1.0)));
  return 255.0 * largest;
}

// Divides one triangle of preset exact into strips.
class SphericalSetup::ExactTriangle {
 public:
  // The part of a triangle as it is drawn. The arcs take most of the setup's time. Keep them after the check
  // to write them later.
  struct Line {
    bool empty;
    double first, step;  ///< this and the following as in SpanArcs
    std::int64_t steps;
  };
  struct Part {
    std::vector<std::uint32_t> headers;
    std::vector<std::size_t> ends;  ///< end of each header's lines
    std::vector<Line> lines;
    std::vector<LightArcs> arcs;  ///< of all lights, for each line that is not empty
    SetupCounts counts;

    void clear() {
      headers.clear();
      ends.clear();
      lines.clear();
      arcs.clear();
      counts = {};
    }
  };

  // `part` is memory that the next triangles use again.
  ExactTriangle(const SphericalSetup& setup, const ScreenTriangle& triangle, Part& part,
                std::vector<std::uint32_t>& words, SetupCounts& counts)
      : setup_(setup),
        triangle_(triangle),
        material_(setup.scene_->materials[triangle.material]),
        part_(part),
        words_(words),
        counts_(counts),
        subpixel_bits_(setup.projector_.options().subpixel_bits),
        corners_(screen_points(triangle)) {}

  void append() {
    const auto [left, right] = std::minmax({corners_[0].x, corners_[1].x, corners_[2].x});
    const std::int64_t unit = std::int64_t{1} << subpixel_bits_;
    const Columns columns{std::max<std::int64_t>(0, floor_divide(left, unit).quotient),
                          std::min<std::int64_t>(setup_.frame_.width, ceil_divide(right, unit) + 1)};
    if (columns.width() <= 0) return;
    Walks walks = walks_of(columns);
    // A triangle that covers no pixel needs no vector.
    if (walks.empty()) return;
    depth_.emplace(corners_, subpixel_bits_, fixed_depths(triangle_));
    if (setup_.options_.ends == SpanEnds::slerped_along_edges)
      for (std::size_t i = 0; i < 3; ++i)
        vertex_[i] = vectors(surface_point(triangle_, barycentric_at_vertex(i)));
    append(columns, walks);
  }

 private:
  Walks walks_of(Columns columns) const {
    return plan_walks(corners_, subpixel_bits_, columns, setup_.frame_.height);
  }

  // With ends interpolated along the edges, splitting changes nothing.
  bool may_cut() const { return setup_.options_.ends == SpanEnds::on_surface && !setup_.lights_.empty(); }

  void append(Columns columns, const Walks& walks) {
    if (walks.empty()) return;
    part_.clear();
    if (!plan(walks, may_cut() && columns.width() > 1)) {
      if (!split_) ++counts_.subdivided;
      split_ = true;
      const std::int64_t middle = columns.begin + columns.width() / 2;
      for (const Columns half : {Columns{columns.begin, middle}, Columns{middle, columns.end}})
        append(half, walks_of(half));
      return;
    }
    ++counts_.leaves;
    counts_ += part_.counts;
    const std::size_t lights = setup_.lights_.size(), header_words = part_.headers.size() / walks.size();
    std::span<const LightArcs> arcs = part_.arcs;
    std::size_t line = 0;
    for (std::size_t i = 0; i < walks.size(); ++i) {
      ++counts_.vectors;
      const auto header = part_.headers.begin() + static_cast<std::ptrdiff_t>(i * header_words);
      words_.insert(words_.end(), header, header + static_cast<std::ptrdiff_t>(header_words));
      for (; line < part_.ends[i]; ++line) {
        ++counts_.records;
        InitVector record(words_, setup_.init_bits_);
        const Line& at = part_.lines[line];
        if (at.empty) continue;
        setup_.put_record<Exact>(record, triangle_.material,
                                 {arcs.first(lights), at.first, at.step, at.steps}, counts_);
        arcs = arcs.subspan(lights);
      }
    }
  }

  // Fills the part. Returns false if a line must be split. Checks errors only if `look` is true.
  bool plan(const Walks& walks, bool look) {
    for (const Walk& walk : walks) {
      append_header(walk);
      const std::int64_t lines = setup_.has_records_ ? walk.upper_lines + walk.lower_lines : 0;
      for (std::int64_t y = walk.y; y < walk.y + lines; ++y)
        if (!plan(line_of(walk, y), look)) return false;
      part_.ends.push_back(part_.lines.size());
    }
    return true;
  }
  bool plan(const WalkLine& line, bool look) {
    if (line.empty() || setup_.lights_.empty()) {
      part_.lines.push_back({true, 0.0, 0.0, 0});
      return true;
    }
    const Span at = span_of(line.walk);
    if (setup_.options_.ends == SpanEnds::slerped_along_edges) {
      append_arcs(at, vectors_along_edges(at));
      return true;
    }
    const SurfaceEnds surface = ends_of(at);
    const SpanVectors ends = vectors_on_surface(at, surface);
    const SpanArcs arcs = append_arcs(at, ends);
    return !look || error_bound(surface, ends, arcs) <= setup_.options_.threshold ||
           interpolates_well(at, arcs);
  }

  void append_header(const Walk& walk) {
    InitVector header(part_.headers, setup_.init_bits_);
    put_header(header, triangle_.source, walk,
               depth_->words(difference_start(walk), half(Exact::c_depth_sum_fraction_bits)));
    setup_.put_ambient(header, material_, part_.counts);
  }

  // First and last pixel, in the order of the walker.
  struct Span {
    std::int64_t first, last;
    std::uint32_t y;
    std::int64_t steps() const { return first < last ? last - first : first - last; }
    std::int64_t way() const { return first <= last ? 1 : -1; }
  };
  static Span span_of(const Walk& line) {
    const std::int64_t way = line.backward ? -1 : 1;
    return {line.start.pixel, line.upper.pixel - way, static_cast<std::uint32_t>(line.y)};
  }

  SurfacePoint point(std::int64_t half_x, std::uint32_t y) const {
    return surface_point(triangle_, barycentric_screen(triangle_, half_x << subpixel_bits_,
                                                       (2 * std::int64_t{y} + 1) << subpixel_bits_));
  }
  // The surface at the centres of the first and the last pixel.
  struct SurfaceEnds {
    SurfacePoint begin, end;
  };
  SurfaceEnds ends_of(const Span& at) const {
    const SurfacePoint begin = point(2 * at.first + 1, at.y);
    return {begin, at.steps() > 0 ? point(2 * at.last + 1, at.y) : begin};
  }

  PointVectors vectors(const SurfacePoint& surface) const {
    ++counts_.shaded;
    return setup_.vectors_at(material_, surface);
  }

  SpanVectors vectors_on_surface(const Span& at, const SurfaceEnds& ends) const {
    // Form the vectors in place: they are large.
    if (at.steps() > 0)
      return {vectors(ends.begin), vectors(ends.end), 0.0, 1.0 / static_cast<double>(at.steps()), at.steps()};
    SpanVectors pixel{vectors(ends.begin), {}};
    pixel.end = pixel.begin;
    return pixel;
  }
  SpanVectors vectors_along_edges(const Span& at) const {
    SpanVectors span;
    span.steps = at.steps();
    // Left to right. A span drawn from right to left has negative steps.
    const auto [from, to] = crossings(triangle_, subpixel_bits_, at.y);
    span.begin = setup_.slerped(vertex_[from.top], vertex_[from.bottom], from.t);
    span.end = setup_.slerped(vertex_[to.top], vertex_[to.bottom], to.t);
    const double length = to.x - from.x;
    if (length == 0.0) return span;
    span.step = static_cast<double>(at.way()) / length;
    span.first = (static_cast<double>(at.first) + 0.5 - from.x) / length;
    return span;
  }

  // Adds a line that is not empty to the part.
  SpanArcs append_arcs(const Span& at, const SpanVectors& ends) {
    const std::size_t begin = part_.arcs.size();
    part_.arcs.resize(begin + setup_.lights_.size());
    const std::span<LightArcs> of_line = std::span(part_.arcs).subspan(begin);
    setup_.set_arcs(material_, ends, [&] { return vectors(point(at.first + at.last + 1, at.y)); }, of_line);
    part_.lines.push_back({false, ends.first, ends.step, ends.steps});
    return {of_line, ends.first, ends.step, ends.steps};
  }

  // An upper bound of a line's error, in colour steps, from its ends alone. Infinity where none is known.
  double error_bound(const SurfaceEnds& surface, const SpanVectors& ends, const SpanArcs& arcs) const {
    constexpr double c_unknown = std::numeric_limits<double>::infinity();
    if (ends.steps == 0) return 0.0;
    const bool specular = has_specular(material_);
    if (specular && material_.brdf != Brdf::blinn) return c_unknown;
    glm::dvec3 error(0.0);
    for (std::size_t i = 0; i < setup_.lights_.size(); ++i) {
      const Light& light = setup_.lights_[i];
      const auto bounds = arc_bounds(surface.begin, surface.end, light, setup_.scene_->camera.eye_world);
      if (!bounds || light.cone) return c_unknown;
      const LightVectors &first = ends.begin.light[i], &last = ends.end.light[i];
      const auto [least, most] = std::minmax(
          {glm::dot(ends.begin.normal, first.to_light), glm::dot(ends.end.normal, last.to_light)});
      // Below the horizon the light adds nothing.
      if (most < -bounds->diffuse) continue;
      error += light.intensity * bounds->diffuse * material_.diffuse * material_.colour;
      if (!specular) continue;
      const CosineArc& arc = arcs.light[i].specular;
      const bool has_peak = arc.phase >= 0.0 && arc.phase <= arc.sweep;
      const double largest =
          bounds->specular +
          (has_peak ? arc.amplitude : std::max(glm::dot(first.u, first.v), glm::dot(last.u, last.v)));
      // At the horizon the highlight ends abruptly: the whole highlight may be wrong.
      const double highlight = least < bounds->diffuse ? highlight_power(largest, material_.exponent)
                                                       : bounds->specular * slope_up_to(largest);
      error += light.intensity * highlight * material_.specular * material_.specular_colour;
    }
    return 255.0 * std::max({error.x, error.y, error.z});
  }
  // Steepest slope of the highlight with respect to its angle, where the angle's cosine is at most this.
  double slope_up_to(double cosine) const {
    return std::min(steepest_slope_, material_.exponent * highlight_power(cosine, material_.exponent - 1.0));
  }

  // True if a line's error is below the threshold at every pixel.
  bool interpolates_well(const Span& at, const SpanArcs& arcs) const {
    const std::int64_t steps = at.steps();
    if (steps == 0) return true;
    // Skip the ends if the arcs have the surface's own vectors there.
    const bool exact_at_ends = std::all_of(arcs.light.begin(), arcs.light.end(),
                                           [](const LightArcs& light) { return light.exact_at_ends; });
    const std::int64_t first = exact_at_ends ? 1 : 0;
    for (std::int64_t i = first; i <= steps - first; ++i) {
      ++counts_.shaded;
      const double t = arcs.first + static_cast<double>(i) * arcs.step;
      if (!(setup_.interpolation_error(material_, arcs, t, point(2 * (at.first + i * at.way()) + 1, at.y)) <=
            setup_.options_.threshold))
        return false;
    }
    return true;
  }

  const SphericalSetup& setup_;
  const ScreenTriangle& triangle_;
  const Material& material_;
  Part& part_;
  std::vector<std::uint32_t>& words_;
  SetupCounts& counts_;
  int subpixel_bits_;
  std::array<ScreenPoint, 3> corners_;
  std::array<PointVectors, 3> vertex_;
  std::optional<DepthFit> depth_;
  double steepest_slope_ = steepest_slope(material_.exponent);
  bool split_ = false;
};

class SphericalSetup::Worker final : public SetupWorker {
 public:
  explicit Worker(const SphericalSetup& setup) : setup_(setup), mesh_(setup.projector_) {}

  void append(std::uint32_t triangle, std::vector<std::uint32_t>& words, SetupCounts& counts) override {
    for (const ScreenTriangle& t : mesh_.project(triangle, counts.projection)) {
      ++counts.triangles;
      if (setup_.preset_ == Preset::exact)
        ExactTriangle(setup_, t, part_, words, counts).append();
      else
        setup_.append_published(t, words, counts);
    }
  }

 private:
  const SphericalSetup& setup_;
  MeshProjector mesh_;
  ExactTriangle::Part part_;
};

std::unique_ptr<SetupWorker> SphericalSetup::worker() const {
  return std::make_unique<Worker>(*this);
}

void SphericalSetup::append_published(const ScreenTriangle& triangle, std::vector<std::uint32_t>& words,
                                      SetupCounts& counts) const {
  const Material& material = scene_->materials[triangle.material];
  std::array<HalfVertex, 3> p;
  std::array<PointVectors, 3> vertex;
  for (std::size_t i = 0; i < 3; ++i) {
    const ScreenVertex& v = triangle.vertex[i];
    p[i] = {static_cast<long double>(v.x), static_cast<long double>(v.y), depth_steps(v.z)};
    vertex[i] = vectors_at(material, surface_point(triangle, barycentric_at_vertex(i)));
    ++counts.shaded;
  }
  ++counts.leaves;
  for (const HalfTriangle& h : half_triangles(p)) {
    ++counts.vectors;
    InitVector header(words, init_bits_);
    put_header(header, triangle.source, h, p);
    put_ambient(header, material, counts);
    if (!has_records_) continue;
    for (std::int64_t y = h.y; y < h.y + h.lines; ++y) {
      ++counts.records;
      InitVector record(words, init_bits_);
      const HalfLine line = line_of(h, y);
      if (line.empty() || lights_.empty()) continue;
      const auto on_edge = [&](const HalfEdge& edge) {
        const auto height = p[edge.bottom].y - p[edge.top].y;
        const auto t = static_cast<double>((static_cast<long double>(y) - p[edge.top].y) / height);
        return slerped(vertex[edge.top], vertex[edge.bottom], t);
      };
      SpanVectors span{on_edge(h.start), on_edge(h.stop), 0.0, 0.0};
      const std::int64_t steps = line.last - line.first;
      // On one pixel nothing turns. A plane between ends that are the same point would be determined by
      // rounding.
      if (steps == 0)
        span.end = span.begin;
      else
        span.step = 1.0 / static_cast<double>(steps);
      std::array<LightArcs, c_most_lights> arcs;
      const std::span<LightArcs> of_line = std::span(arcs).first(lights_.size());
      set_arcs(material, span, [&] { return slerped(span.begin, span.end, 0.5); }, of_line);
      put_record<Published>(record, triangle.material, {of_line, span.first, span.step, span.steps}, counts);
    }
  }
}

}  // namespace halfway
