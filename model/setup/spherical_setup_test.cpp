// SPDX-License-Identifier: Apache-2.0
// Compares the golden model, with init vectors from the setup, with two references: the papers' formulas in
// long double, span by span, within bounds that include every rounding; and the illumination model, pixel by
// pixel.
#include "setup/spherical_setup.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <vector>

#include "golden/diffuse_slice.hpp"
#include "golden/multiplier.hpp"
#include "golden/saturating_sum.hpp"
#include "golden/specular_slice.hpp"
#include "golden/triangle_walker.hpp"
#include "golden_run/test/drawing.hpp"
#include "golden_run/test/spherical_drawing.hpp"
#include "reference/renderer.hpp"
#include "scene/builtin_meshes.hpp"
#include "scene/test/random_scenes.hpp"
#include "setup/test/paper_spans.hpp"
#include "setup/test/pixels.hpp"
#include "setup/test/random_triangles.hpp"
#include "sim/os/file.hpp"
#include "sim/os/must.hpp"
#include "sim/os/threads.hpp"
#include "sim/run/simulate.hpp"
#include "words/generator/cosine.hpp"

namespace halfway {
namespace {

using paper::Ends, paper::LightThere, paper::Real, paper::Span, paper::SpanThere, paper::Vector;
using ::testing::HasSubstr, ::testing::Not;
using words::Exact, words::Published;

// ---- The papers' formulas

// For a turn smaller than this, doubles do not define its plane.
constexpr Real c_no_turn = 1e-9L;

struct Arc {
  Real amplitude, sweep, phase;
};

// v fixed at v1, u2 rotated back by v's rotation.
Arc arc_between(Vector u1, Vector u2, Vector v1, Vector v2) {
  const Vector c = glm::cross(v1, v2);
  const Real cos_v = glm::dot(v1, v2);
  const Vector back = u2 * cos_v - glm::cross(c, u2) + c * (glm::dot(c, u2) / (1 + cos_v));
  const Real sweep = 2 * std::atan2(glm::length(back - u1), glm::length(back + u1));
  const Real begin = glm::dot(u1, v1), end = glm::dot(u2, v2);
  if (sweep < c_no_turn) return {std::fabs(begin), 0, begin < 0 ? paper::c_pi : 0};
  const Real b = (end - begin * std::cos(sweep)) / std::sin(sweep);
  Real phase = std::atan2(b, begin);
  // Choose the multiple of 2 pi for which the middle is within pi of the peak.
  phase += 2 * paper::c_pi * std::round((sweep / 2 - phase) / (2 * paper::c_pi));
  return {std::hypot(begin, b), sweep, phase};
}

// Above this error an arc's amplitude and angle count as unknown. Their cosine is still known.
constexpr Real c_unknown = 1e-6L;

struct LightOnSpan {
  Arc diffuse, specular;
  Real spot;
  Real doubt;                          ///< error of u.v and N.L
  Real doubt_diffuse, doubt_specular;  ///< errors of the arcs' angles and amplitudes
};

LightOnSpan on_span(const SpanThere& span, std::size_t light) {
  const LightThere &a = span.begin.light[light], &b = span.end.light[light];
  LightOnSpan out{arc_between(span.begin.normal, span.end.normal, a.l, b.l),
                  arc_between(a.u, b.u, a.v, b.v),
                  (a.spot + b.spot) / 2,
                  0,
                  0,
                  0};
  const Real directions = std::max(span.begin.doubt, span.end.doubt);
  const auto doubt = [&](const Arc& arc) {
    if (span.step == 0) return 4 * directions;  // one pixel: constant
    if (arc.sweep == 0) return c_unknown;
    return 4 * directions / std::sin(arc.sweep) + span.doubt * arc.sweep;
  };
  out.doubt = 4 * directions + c_no_turn + span.doubt * std::max(out.diffuse.sweep, out.specular.sweep);
  out.doubt_diffuse = doubt(out.diffuse);
  out.doubt_specular = doubt(out.specular);
  return out;
}

// Steps of 1/255 that a light adds to a channel, and the greatest error of the golden model.
struct Term {
  Real value, bound;
};
enum class Horizon { before, beyond, either };  ///< either: rounding decides

template <class P>
class Specification {
 public:
  static constexpr bool c_exact = std::is_same_v<P, Exact>;

  Specification(const Scene& scene, const HardwareKey& key)
      : scene_(scene),
        lights_(shining_lights(scene)),
        material_(scene.materials[0]),
        exponent_(material_.exponent),
        tables_(key.spherical.tables),
        bell_(c_exact ? fitted_bell(material_.exponent) : Bell{2, published_scale(material_.exponent)}),
        cosine_error_(error_of(1)),
        bell_error_(error_of(bell_.power)),
        fit_error_(fit_error(material_.exponent, bell_)) {
    const Real m = bell_.power;
    bell_slope_ = paper::c_pi / 2 * std::sqrt(m) * std::pow(1 - 1 / m, (m - 1) / 2);
  }

  Term ambient(int c) const {
    const Real steps = Real{255} * scene_.ambient[c] * material_.ambient * material_.colour[c] + 0.5L;
    return {std::min<Real>(steps, c_limit), c_factor_rounding};
  }
  Term diffuse(const SpanThere& span, const LightOnSpan& on, std::size_t light, int c, int steps) const {
    const Real brightest = strength(on, light, c) * material_.diffuse * material_.colour[c];
    const Real factor = clamped(brightest * on.diffuse.amplitude),
               cosine = std::cos(x(on.diffuse, span, steps));
    const bool known = on.doubt_diffuse < c_unknown;
    return {factor * std::max<Real>(0, cosine),
            c_factor_rounding +
                (known ? factor : brightest) * (cosine_error_ + drift(steps) * c_diffuse_unit) +
                brightest * (known ? on.doubt_diffuse : on.doubt) + lost(known, brightest)};
  }
  Term specular(const SpanThere& span, const LightOnSpan& on, std::size_t light, int c, int steps) const {
    const Real brightest = strength(on, light, c) * material_.specular * material_.specular_colour[c];
    const Real factor =
        clamped(brightest * bell_.gain * std::pow(std::min<Real>(1, on.specular.amplitude), exponent_));
    const Real y = bell_.scale * x(on.specular, span, steps);
    const Real bell =
        c_exact && std::fabs(y) >= paper::c_pi / 2 ? 0 : std::pow(std::fabs(std::cos(y)), bell_.power);
    Term term{factor * bell, c_factor_rounding + factor * (bell_error_ + drift(steps) * bell_slope_)};
    // If an arc is unknown, only the product of its amplitude and its bell is known: cos^n, within the fit's
    // error.
    if (on.doubt_specular < c_unknown)
      term.bound += brightest * (exponent_ + bell_.scale * bell_slope_) * on.doubt_specular;
    else if (c_exact)
      term.bound +=
          brightest * (2 * fit_error_ + exponent_ * on.doubt + bell_error_ + drift(steps) * bell_slope_);
    else
      term.bound += 2 * brightest;
    term.bound += lost(on.doubt_specular < c_unknown, brightest);
    return term;
  }
  Horizon horizon(const SpanThere& span, const LightOnSpan& on, int steps) const {
    if (!c_exact) return Horizon::before;
    const bool known = on.doubt_diffuse < c_unknown;
    const Real cosine = on.diffuse.amplitude * std::cos(x(on.diffuse, span, steps));
    const Real angle = (drift(steps) + std::ldexp(1.0L, -P::c_angle_fraction_bits)) * c_diffuse_unit;
    const Real doubt = known ? on.diffuse.amplitude * (angle + on.doubt_diffuse) : angle + on.doubt;
    if (std::fabs(cosine) <= doubt) return Horizon::either;
    return cosine > 0 ? Horizon::before : Horizon::beyond;
  }
  /// Error of an angle word: start and slope are rounded; the slope's error accumulates per pixel.
  static Real drift(int steps) { return std::ldexp(Real(1 + steps), -P::c_angle_fraction_bits - 1); }

 private:
  static constexpr Real c_factor_rounding = 0x1p-9L;
  static constexpr Real c_diffuse_unit = c_exact ? paper::c_pi / 2 : paper::c_pi;

  double error_of(int power) const {
    return tables::table_error(tables::cosine_table(c_exact, power, tables_));
  }
  static Real x(const Arc& arc, const SpanThere& span, int steps) {
    return (span.first + steps * span.step) * arc.sweep - arc.phase;
  }
  Real strength(const LightOnSpan& on, std::size_t light, int c) const {
    return 255 * on.spot * light_of(scene_, lights_[light]).intensity[c];
  }
  // Factors are clamped such that the table's largest entry represents 1.
  static constexpr Real c_limit = c_exact ? 65535 : 1023;
  Real clamped(Real steps) const {
    const Real entries = std::ldexp(1.0L, tables_.data_bits);
    return std::min(steps, c_limit * (entries - 1) / entries);
  }

  // If the factor is clamped and the amplitude is unknown, the bound is the full brightness.
  static Real lost(bool known, Real brightest) {
    return !known && brightest > 0.996L * c_limit ? brightest : 0;
  }

  const Scene& scene_;
  std::vector<LightRef> lights_;
  const Material& material_;
  Real exponent_;
  words::CosineSize tables_;
  Bell bell_;
  Real cosine_error_, bell_error_, fit_error_, bell_slope_ = 0;
};

// ---- The comparison

// Largest error relative to its bound.
struct FormulaFigures {
  std::uint64_t fragments = 0, terms = 0, behind_horizon = 0, either = 0, outside_bell = 0;
  Real diffuse = 0, specular = 0, fragment = 0;
  std::uint64_t cut = 0, overexposed = 0;
};
// Checks every fragment of the triangles that are one piece on the screen.
template <class P>
void expect_specification(const Scene& scene, FrameSize frame, const HardwareKey& key,
                          const SphericalSetupOptions& options, FormulaFigures& figures) {
  constexpr bool c_exact = std::is_same_v<P, Exact>;
  const SphericalSetup setup(scene, frame, key, options);
  const Specification<P> specification(scene, key);
  const words::SphericalConfig config = golden_config(key);
  const words::SphericalLayout<P> layout(config);
  const std::size_t vector_words = (setup.init_bits() + 31) / 32;
  const auto model = make_golden_model(key);
  const Projector projector(
      scene, frame, {.subpixel_bits = c_exact ? c_exact_subpixel_bits : 0, .clip_to_frame = !c_exact});
  const Real one = std::ldexp(Real{1}, P::c_factor_fraction_bits + config.size.data_bits);
  const auto lights = static_cast<std::size_t>(config.lights);
  using golden::DiffuseSlice, golden::SpecularSlice;
  std::vector<DiffuseSlice<P>> diffuse;
  std::vector<SpecularSlice<P>> specular;
  if (layout.has_diffuse_part())
    diffuse.assign(lights, DiffuseSlice<P>(layout.diffuse_channels(), config.size));
  if (config.specular)
    specular.assign(lights, SpecularSlice<P>(config.highlight_channels, config.powers, config.size));

  for (std::uint32_t source = 0; source < scene.triangles.size(); ++source) {
    std::vector<ScreenTriangle> on_screen;
    projector.project(source, on_screen);
    if (on_screen.size() != 1) continue;
    const Ends ends(scene, scene.materials[0], on_screen[0]);
    std::vector<std::uint32_t> words;
    SetupCounts counts;
    setup.append(source, words, counts);
    figures.cut += counts.subdivided;
    figures.overexposed += counts.overexposed;
    std::vector<Fragment> fragments;
    model->draw(words, fragments);
    auto fragment = fragments.begin();

    std::span<const std::uint32_t> rest = words;
    while (!rest.empty()) {
      const std::size_t vectors = model->group(rest);
      golden::TriangleWalker<P> walker;
      walker.line_load(rest);
      const bool upper_half = !c_exact && ends.upper_half(walker.y());
      for (std::size_t line = 1;; ++line) {
        if (!walker.line_empty()) {
          // No records if neither lights nor materials need them.
          const auto record = vectors > 1 ? rest.subspan(line * vector_words, vector_words) : rest.first(0);
          const int way = walker.backward() ? -1 : 1;
          const Span span{walker.start().value(), walker.stop().value() - way, walker.y(), upper_half};
          const SpanThere there = !c_exact                               ? ends.published(span)
                                  : options.ends == SpanEnds::on_surface ? ends.on_surface(span)
                                                                         : ends.along_edges(span);
          std::vector<LightOnSpan> on;
          for (std::size_t l = 0; l < lights; ++l) {
            on.push_back(on_span(there, l));
            const int i = static_cast<int>(l);
            if (!diffuse.empty()) diffuse[l].span_load(record, layout.diffuse_low(i));
            if (!specular.empty()) specular[l].span_load(record, layout.specular_low(i));
          }
          for (int steps = 0; steps <= span.steps(); ++steps, ++fragment) {
            ASSERT_NE(fragment, fragments.end());
            ASSERT_EQ(fragment->x, span.first + way * steps);
            ASSERT_EQ(fragment->y, span.y);
            ASSERT_EQ(fragment->triangle, source);
            ++figures.fragments;
            for (int c = 0; c < config.channels; ++c) {
              const Term ambient = specification.ambient(c);
              Real low = ambient.value - ambient.bound, high = ambient.value + ambient.bound;
              for (std::size_t l = 0; l < lights; ++l) {
                const auto where = [&] {
                  return testing::Message()
                         << "triangle " << source << ", pixel " << fragment->x << ',' << span.y << ", step "
                         << steps << " of " << span.steps() << ", channel " << c << ", light " << l;
                };
                const auto check = [&](const Term& term, Real value, Real& worst) {
                  ++figures.terms;
                  worst = std::max(worst, std::fabs(value - term.value) / term.bound);
                  EXPECT_LE(std::fabs(value - term.value), term.bound)
                      << where() << ": " << value << ", formula " << term.value;
                };
                if (config.diffuse) {
                  const Term term = specification.diffuse(there, on[l], l, c, steps);
                  check(term, diffuse[l].product(c) / one, figures.diffuse);
                  low += term.value - term.bound;
                  high += term.value + term.bound;
                }
                if (!config.specular) continue;
                const Term term = specification.specular(there, on[l], l, c, steps);
                const Horizon horizon = specification.horizon(there, on[l], steps);
                const bool lit = !c_exact || diffuse[l].lit();
                const int channel = config.highlight_channels == 1 ? 0 : c;
                if (horizon == Horizon::beyond) {
                  ++figures.behind_horizon;
                  ASSERT_FALSE(lit) << where() << ": lit below the horizon";
                  continue;
                }
                figures.either += horizon == Horizon::either;
                ASSERT_TRUE(lit || horizon == Horizon::either) << where() << ": dark above the horizon";
                figures.outside_bell += term.value == 0;
                if (lit) check(term, specular[l].product(channel, lit) / one, figures.specular);
                low += horizon == Horizon::either ? 0 : term.value - term.bound;
                high += term.value + term.bound;
              }
              const int value = c == 0 ? fragment->red : c == 1 ? fragment->green : fragment->blue;
              ASSERT_GE(value, std::min<Real>(255, std::floor(low)));
              ASSERT_LE(value, std::min<Real>(255, std::floor(high)));
              if (value < 255)
                figures.fragment = std::max(
                    figures.fragment, std::fabs(value + 0.5L - (low + high) / 2) / (0.5L + (high - low) / 2));
              if (testing::Test::HasFailure()) return;
            }
            for (std::size_t l = 0; l < lights; ++l) {
              if (!diffuse.empty()) diffuse[l].span_step();
              if (!specular.empty()) specular[l].span_step();
            }
          }
        }
        if (walker.line_last()) break;
        walker.line_step();
      }
      rest = rest.subspan(vectors * vector_words);
    }
    ASSERT_EQ(fragment, fragments.end());
  }
}

Scene random_scene(RandomScenes& random) {
  Scene scene;
  const bool grey = random.one_in(3), white = grey || random.one_in(2);
  scene.materials = {random.material(grey, white)};
  if (random.one_in(8)) scene.materials[0].diffuse = 0.0;
  if (random.one_in(8)) scene.materials[0].specular = 0.0;
  scene.ambient = random.within(0.0, 0.5) * random.colour(grey);
  random.add_triangles(scene, 4, random.log_within(0.1, 1.5),
                       random.one_in(8) ? 0.0 : random.log_within(0.01, 0.7));
  random.add_lights(scene, random.whole(1, 3), RandomScenes::any, 1.2, grey || white);
  if (random.one_in(6))
    for (DirectionalLight& light : scene.directional)
      light.intensity *= random.log_within(10.0, 1e4);  // over-exposed
  return scene;
}

const SphericalSetupOptions c_never_cut = {.threshold = 1e9}, c_cut = {};

/// Compares random scenes. Each is drawn with one of the widths and one of the options.
template <class P>
FormulaFigures compare(unsigned seed, int scenes, const std::array<unsigned, 2>& widths,
                       const std::array<SphericalSetupOptions, 2>& options) {
  constexpr Preset c_preset = std::is_same_v<P, Exact> ? Preset::exact : Preset::published;
  RandomScenes random(seed);
  FormulaFigures figures;
  for (int i = 0; i < scenes && !testing::Test::HasFailure(); ++i) {
    const Scene scene = random_scene(random);
    SCOPED_TRACE(testing::Message() << "scene " << i << ", exponent " << scene.materials[0].exponent);
    const FrameSize frame{widths[random.one_in(2) ? 0 : 1], 160};
    expect_specification<P>(scene, frame, spherical_key(scene, c_preset), options[random.one_in(2) ? 0 : 1],
                            figures);
  }
  return figures;
}

TEST(SphericalSetup, ExactMatchesThePapersFormulasWithinTheRounding) {
  const FormulaFigures figures = compare<Exact>(1, 160, {240, 70}, {{c_never_cut, {.threshold = 0.5}}});
  EXPECT_GT(figures.fragments, 200'000u);
  EXPECT_GT(figures.cut, 50u);
  EXPECT_GT(figures.overexposed, 50u);
  EXPECT_GT(figures.behind_horizon, 10'000u);
  EXPECT_GT(figures.outside_bell, 10'000u);
  EXPECT_LT(1000 * figures.either, figures.terms);
  // The bounds must not be much too wide.
  EXPECT_GT(figures.diffuse, 0.9);
  EXPECT_GT(figures.specular, 0.9);
  EXPECT_GT(figures.fragment, 0.9);
}

TEST(SphericalSetup, VectorsSlerpedAlongTheEdgesMatchTheFormulas) {
  const SphericalSetupOptions along{.ends = SpanEnds::slerped_along_edges};
  const FormulaFigures figures = compare<Exact>(2, 80, {200, 200}, {along, along});
  EXPECT_GT(figures.fragments, 50'000u);
  EXPECT_EQ(figures.cut, 0u) << "cutting does not change what lies along the edges";
}

TEST(SphericalSetup, PublishedMatchesThePapersFormulasModuloItsRegisters) {
  const FormulaFigures figures = compare<Published>(3, 120, {120, 300}, {});
  EXPECT_GT(figures.fragments, 100'000u);
  EXPECT_GT(figures.diffuse, 0.9);
  EXPECT_GT(figures.specular, 0.9);
}

// ---- Comparison with the illumination model

struct Accuracy {
  std::uint64_t pixels = 0, past = 0;
  double largest = 0.0, largest_past = 0.0, squares = 0.0;
  SetupCounts counts;
  double psnr() const { return 10.0 * std::log10(255.0 * 255.0 * static_cast<double>(pixels) / squares); }
};

void measure(const Scene& scene, FrameSize size, const SphericalSetupOptions& options, Accuracy& out) {
  const HardwareKey key = spherical_key(scene);
  const Drawn drawn = draw(scene, size, key, {.spherical = options});
  const Frame frame = frame_of(scene, size, drawn.fragments);
  const auto triangles = projected(scene, size);
  const ReferenceImage truth = render_reference(
      scene, triangles, {.frame = size, .subpixel_bits = c_exact_subpixel_bits, .workers = on_threads(2)});
  const double promised = promised_steps(scene, key, options.threshold) + 0.5;  // and its rounding
  for (std::size_t pixel = 0; pixel < truth.mask.size(); ++pixel) {
    if (truth.mask[pixel] == 0) continue;
    double error = 0.0;
    for (std::size_t c = 3 * pixel; c < 3 * pixel + 3; ++c)
      error = std::max(error, std::abs(double(frame.rgb[c]) - truth.frame.rgb[c]));
    ++out.pixels;
    out.squares += error * error;
    out.largest = std::max(out.largest, error);
    if (error > promised) ++out.past, out.largest_past = std::max(out.largest_past, error - promised);
  }
  out.counts += drawn.counts;
}

Scene lit_mesh(RandomScenes& random, int kind, RandomScenes::Lights lights) {
  Scene scene;
  scene.materials = {random.material(false, random.one_in(2), random.one_in(3) ? 1e5 : 1e3)};
  scene.camera.eye_world = {0.0, 0.0, 4.0};
  double radius = 1.1;
  if (kind == 0) {
    random.add_triangles(scene, 4, 1.5, 0.6);
  } else if (kind == 1) {
    add_mesh(scene, make_uv_sphere(12, 8, 1.0));
  } else {
    add_mesh(scene, make_teapot(2));
    scene.camera.eye_world = {1.6, 5.0, 9.4};
    scene.camera.target_world = {0.2, 1.4, 0.0};
    radius = 3.0;
  }
  random.add_lights(scene, random.whole(1, 3), lights, radius, random.one_in(2));
  return scene;
}

TEST(SphericalSetup, ExactIsWithinItsBoundOfTheIlluminationModel) {
  RandomScenes random(4);
  for (const auto lights : {RandomScenes::directional, RandomScenes::positional, RandomScenes::spots}) {
    Accuracy whole, cut;
    for (int i = 0; i < 36; ++i) {
      const Scene scene = lit_mesh(random, i % 3, lights);
      measure(scene, {240, 180}, c_never_cut, whole);
      measure(scene, {240, 180}, c_cut, cut);
    }
    EXPECT_GT(cut.pixels, 300'000u);
    EXPECT_EQ(cut.past, 0u);
    EXPECT_GT(cut.psnr(), whole.psnr() + 4.0);
    EXPECT_GT(whole.largest, 30.0) << "these scenes need no cut";
  }
}

// Adds a triangle with these corners, in 1/16 pixel, and random normals, and sets the eye for it.
void add_on_screen(Scene& scene, Points p, FrameSize frame, RandomScenes& random) {
  const double depth = 4.0, focal = 0.5 * frame.height / std::tan(0.5 * 0.7);
  scene.camera.near = 1.0;
  scene.camera.far = 1000.0;
  scene.camera.eye_world = {0.0, 0.0, depth};
  scene.camera.vertical_fov_degrees = 0.7 * 180.0 / std::numbers::pi;
  // The eye sees triangles that are clockwise on the screen (y down).
  if ((std::int64_t{p[1].x} - p[0].x) * (std::int64_t{p[2].y} - p[0].y) >
      (std::int64_t{p[2].x} - p[0].x) * (std::int64_t{p[1].y} - p[0].y))
    std::swap(p[1], p[2]);
  const auto first = static_cast<std::uint32_t>(scene.positions_world.size());
  for (const ScreenPoint& q : p) {
    scene.positions_world.emplace_back((q.x / 16.0 - 0.5 * frame.width) * depth / focal,
                                       (0.5 * frame.height - q.y / 16.0) * depth / focal, 0.0);
    scene.normals_world.push_back(random.unit());
  }
  const std::array<std::uint32_t, 3> corner = {first, first + 1, first + 2};
  scene.triangles.push_back({corner, corner, 0});
}

// For any brightness the flanks of the bells stay correct below white. The remaining error is the resolution
// of the tables, which increases with the light.
TEST(SphericalSetup, OverExposureKeepsTheFlanks) {
  struct Exposure {
    double intensity, least_psnr, largest_error;
  };
  for (const double specular : {0.0, 0.4})
    for (const Exposure& expected :
         {Exposure{1.0, 53.0, 3.0}, {10.0, 53.0, 9.0}, {100.0, 46.0, 50.0}, {1000.0, 34.0, 255.0}}) {
      Scene scene;
      scene.camera.eye_world = {0.0, 0.0, 4.0};
      scene.materials = {
          {.name = "m", .ambient = 0.0, .diffuse = 0.6, .specular = specular, .exponent = 50.0}};
      add_mesh(scene, make_uv_sphere(24, 16, 1.0));
      scene.directional.push_back(
          {glm::normalize(glm::dvec3(0.5, 0.4, 1.0)), glm::dvec3(expected.intensity)});
      Accuracy a;
      measure(scene, {320, 240}, c_cut, a);
      EXPECT_EQ(a.past, 0u) << expected.intensity;
      EXPECT_GT(a.psnr(), expected.least_psnr) << expected.intensity;
      EXPECT_LE(a.largest, expected.largest_error) << expected.intensity;
      EXPECT_EQ(a.counts.overexposed != 0, expected.intensity > 257.0) << expected.intensity;
    }
}

// Spots of three pixels on long lines.
TEST(SphericalSetup, NarrowSpotsAreNotMissed) {
  RandomScenes random(13);
  Accuracy whole, cut;
  for (int i = 0; i < 40; ++i) {
    Scene scene;
    scene.materials = {random.material(false, false)};
    random.add_triangles(scene, 4, 1.5, 0.6);
    for (int k = 0; k < 3; ++k) {
      const double inner = random.log_within(0.001, 0.02);
      const glm::dvec3 position(random.within(-1.0, 1.0), random.within(-1.0, 1.0), 2.0);
      scene.spots.push_back({position, glm::normalize(0.7 * random.cube() - position), std::cos(inner),
                             std::cos(inner * random.within(1.0, 2.0)), glm::dvec3(1.0)});
    }
    measure(scene, {320, 240}, c_never_cut, whole);
    measure(scene, {320, 240}, c_cut, cut);
  }
  EXPECT_GT(whole.largest, 100.0);
  EXPECT_GT(cut.psnr(), 60.0);
  EXPECT_EQ(cut.past, 0u);
}

// Normals that turn by any angle along slivers and triangles of every kind, with a light and a spot close to
// them.
TEST(SphericalSetup, ArbitraryNormalsAreSplit) {
  RandomScenes random(14);
  RandomTriangles triangles(14);
  Accuracy cut;
  for (const FrameSize frame : {FrameSize{64, 48}, FrameSize{7, 200}, FrameSize{400, 9}})
    for (const TriangleKind kind : c_triangle_kinds)
      for (int i = 0; i < 24; ++i) {
        Scene scene;
        scene.materials = {random.material(true, true, i % 2 == 0 ? 4.0 : 1000.0)};
        random.add_lights(scene, 2, RandomScenes::any, 0.5, true);
        add_on_screen(scene, triangles.next(kind, c_exact_subpixel_bits, frame), frame, random);
        measure(scene, frame, c_cut, cut);
      }
  EXPECT_GT(cut.pixels, 100'000u);
  EXPECT_LE(cut.past, 2u);
}

// ---- Other properties

// Slivers, triangles of one line, triangles over the whole guard band, arbitrary normals; cut or not.
TEST(SphericalSetup, AnyTriangleDrawsItsPixelsOnce) {
  RandomScenes random(12);
  RandomTriangles triangles(12);
  std::uint64_t pixels = 0, cut = 0;
  for (const FrameSize frame : {FrameSize{64, 48}, FrameSize{7, 200}, FrameSize{400, 9}})
    for (const TriangleKind kind : c_triangle_kinds) {
      Scene scene;
      scene.materials = {random.material(true, true)};
      random.add_lights(scene, 2, RandomScenes::any, 0.5, true);
      for (int i = 0; i < 20; ++i)
        add_on_screen(scene, triangles.next(kind, c_exact_subpixel_bits, frame), frame, random);
      const HardwareKey key = spherical_key(scene);
      for (const SphericalSetupOptions& options :
           {c_never_cut, c_cut, SphericalSetupOptions{.threshold = 0.01},
            SphericalSetupOptions{.ends = SpanEnds::slerped_along_edges}}) {
        const Drawn drawn = draw(scene, frame, key, {.spherical = options});
        ASSERT_TRUE(drawn_pixels(drawn.fragments) == covered(projected(scene, frame), frame))
            << "kind " << static_cast<int>(kind);
        pixels += drawn.fragments.size();
        cut += drawn.counts.subdivided;
      }
      for (const Fragment& f : draw(scene, frame, spherical_key(scene, Preset::published)).fragments)
        ASSERT_TRUE(f.x < frame.width && f.y < frame.height);
    }
  EXPECT_GT(cut, 100u);
  EXPECT_GT(pixels, 100'000u);
}

TEST(SphericalSetup, DepthIsThatOfThePlaneForEverySplit) {
  const FrameSize frame{320, 240};
  for (const double threshold : {1e9, 0.05}) {
    RandomScenes random(6);
    std::uint64_t cut = 0;
    for (int i = 0; i < 4; ++i) {
      const Scene scene = lit_mesh(random, 1, RandomScenes::positional);
      std::map<std::uint32_t, ScreenTriangle> by_source;
      for (const ScreenTriangle& t : projected(scene, frame)) by_source.emplace(t.source, t);
      const Drawn drawn = draw(scene, frame, spherical_key(scene), {.spherical = {.threshold = threshold}});
      cut += drawn.counts.subdivided;
      for (const Fragment& f : drawn.fragments)
        ASSERT_NEAR(f.z, paper::pixel_point(by_source.at(f.triangle), f.x, f.y).z * double((1 << 24) - 1),
                    0.5 + 0.01);
    }
    EXPECT_EQ(cut > 30, threshold < 1.0) << cut;
  }
}

// Materials of several exponents and of none, on the hardware for all of them.
TEST(SphericalSetup, MaterialsDoNotMix) {
  RandomScenes random(9);
  for (const Preset preset : {Preset::exact, Preset::published}) {
    Scene scene;
    random.add_triangles(scene, 10, 1.5, 0.5);
    random.add_lights(scene, 2, RandomScenes::any, 1.1, false);
    for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
      scene.materials.push_back(random.material(false, false));
      scene.materials[i].exponent = std::pow(3.0, static_cast<double>(i));
      scene.triangles[i].material = static_cast<std::uint32_t>(i);
    }
    scene.materials[1].specular = scene.materials[2].diffuse = 0.0;
    scene.materials[3].diffuse = scene.materials[3].specular = 0.0;
    const FrameSize frame{120, 90};
    std::map<std::uint32_t, std::vector<Fragment>> together;
    for (const Fragment& f : draw(scene, frame, spherical_key(scene, preset)).fragments)
      together[f.triangle].push_back(f);
    std::size_t seen = 0;
    for (std::uint32_t i = 0; i < scene.triangles.size(); ++i) {
      Scene alone = scene;
      for (SceneTriangle& t : alone.triangles) t.material = i;  // so that only this material is in use
      std::vector<Fragment> fragments = draw(alone, frame, spherical_key(alone, preset)).fragments;
      std::erase_if(fragments, [&](const Fragment& f) { return f.triangle != i; });
      EXPECT_TRUE(fragments == together[i]) << "material " << i;
      seen += fragments.size();
    }
    EXPECT_GT(seen, 2000u);
  }
}

TEST(SphericalSetup, CountsAreCorrect) {
  RandomScenes random(10);
  const Scene scene = lit_mesh(random, 1, RandomScenes::positional);
  const FrameSize frame{160, 120};
  const HardwareKey key = spherical_key(scene);
  const SetupCounts whole = draw(scene, frame, key, {.spherical = c_never_cut}).counts,
                    cut = draw(scene, frame, key).counts;
  EXPECT_EQ(whole.subdivided, 0u);
  EXPECT_EQ(whole.leaves, whole.vectors) << "no walk of this scene crosses the frame's side";
  EXPECT_GT(whole.records, 5 * whole.vectors);
  EXPECT_GT(cut.subdivided, 0u);
  EXPECT_EQ(cut.triangles, whole.triangles);
  EXPECT_GE(cut.leaves, whole.leaves + cut.subdivided);
  EXPECT_GT(cut.records, whole.records);
  EXPECT_GT(cut.shaded, whole.shaded);
  EXPECT_EQ(whole.overexposed, 0u);
  // One channel of the ambient light is too bright: counted once per vector, however often it is checked.
  Scene bright = scene;
  bright.ambient = {1e4, 0.0, 0.0};
  bright.materials[0].ambient = 1.0;
  bright.materials[0].colour = {0.5, 0.5, 0.5};
  const SetupCounts counts = draw(bright, frame, spherical_key(bright)).counts;
  EXPECT_EQ(counts.overexposed, counts.vectors);
}

TEST(SphericalSetup, WithoutLightsThereAreNoRecords) {
  RandomScenes random(11);
  for (const Preset preset : {Preset::exact, Preset::published}) {
    Scene scene = lit_mesh(random, 1, RandomScenes::any);
    scene.directional.clear();
    scene.positional.clear();
    scene.spots = {{.intensity = glm::dvec3(0.0)}};
    scene.ambient = {0.3, 0.2, 0.1};
    scene.materials[0].ambient = 0.9;
    scene.materials[0].colour = {1.0, 0.5, 0.25};
    for (const glm::dvec3 emission : {glm::dvec3(0.0), glm::dvec3(0.1, 0.3, 0.0)}) {
      scene.materials[0].emission = emission;
      const Drawn drawn = draw(scene, {160, 120}, spherical_key(scene, preset));
      EXPECT_EQ(drawn.counts.records, 0u);
      EXPECT_EQ(drawn.counts.subdivided, 0u);
      ASSERT_GT(drawn.fragments.size(), 1000u);
      for (const Fragment& f : drawn.fragments) {
        ASSERT_EQ(f.red, to_byte(0.27 + emission.r));
        ASSERT_EQ(f.green, to_byte(0.09 + emission.g));
        ASSERT_EQ(f.blue, to_byte(0.0225 + emission.b));
      }
    }
  }
}

TEST(SphericalSetup, AtTheEyeTheNormalIsUsedAsItsDirection) {
  Scene scene = stage();
  add_side_lights(scene);
  const SphericalSetup setup(scene, c_stage_frame, spherical_key(scene), {});
  const glm::dvec3 normal = glm::normalize(glm::dvec3(0.2, 0.1, 1.0));
  const PointVectors at = setup.vectors_at(scene.materials[0], {scene.camera.eye_world, normal, 0.0});
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(glm::length(at.light[i].v), 1.0, 1e-15);
    EXPECT_NEAR(glm::length(glm::cross(at.light[i].v, at.light[i].to_light + normal)), 0.0, 1e-15);
  }
}

// The notes of `halfway sim` on a scene, with the golden model only.
std::string run_notes(const Scene& scene, Preset preset = Preset::exact) {
  SimulateSettings settings;
  settings.plan.shader = Shader::spherical;
  settings.plan.preset = preset;
  settings.size = {161, 121};
  settings.engines.clear();
  const TemporaryFolder out = must(TemporaryFolder::make(testing::TempDir()));
  settings.out = out.path();
  std::string all;
  for (const std::string& note : simulate(scene, settings).notes) all += note + '\n';
  return all;
}

TEST(SphericalSetup, TooLargeExponentsAreClampedAndNoted) {
  Scene steep = stage({{{0.003, 0.001, 1}, {-0.003, 0.002, 1}, {0, -0.003, 1}}});
  move_eye_away(steep);
  steep.directional.push_back({{0, 0, 1}, glm::dvec3(0.9)});
  Scene clamped = steep;
  steep.materials[0].exponent = 1e9;
  clamped.materials[0].exponent = c_largest_exponent;
  for (const Preset preset : {Preset::exact, Preset::published}) {
    const SetupOptions whole{.spherical = c_never_cut};
    EXPECT_EQ(draw(steep, c_stage_frame, spherical_key(steep, preset), whole).words,
              draw(clamped, c_stage_frame, spherical_key(clamped, preset), whole).words);
  }
  EXPECT_THAT(run_notes(steep), HasSubstr("exponent 1e+09 was clamped to 1e+06"));
  EXPECT_THAT(run_notes(clamped), Not(HasSubstr("exponent")));
}

TEST(SphericalSetup, NotesSayWhereThePictureIsWorse) {
  Scene scene = stage();
  scene.directional.push_back({{0, 0, 1}, glm::dvec3(1.0)});
  for (const double exponent : {1.0, 2.0, 20.0}) {
    scene.materials[0].exponent = exponent;
    EXPECT_EQ(run_notes(scene), "");
  }
  scene.materials[0].exponent = 1.3;
  EXPECT_THAT(run_notes(scene), HasSubstr("that of 1.3 is off by up to 8.6 colour steps"));
  EXPECT_THAT(run_notes(scene, Preset::published), Not(HasSubstr("fits")));
  // A material not in use, or without a highlight.
  scene.materials.push_back({.name = "not used", .exponent = 1.3});
  scene.materials[0].specular = 0.0;
  EXPECT_EQ(run_notes(scene), "");

  scene.directional[0].intensity = glm::dvec3(10.0);
  EXPECT_THAT(run_notes(scene), HasSubstr("a light is reflected 5 times as bright as white"));
  EXPECT_THAT(run_notes(scene), Not(HasSubstr("clamped"))) << "there is room for this";
  EXPECT_THAT(run_notes(scene, Preset::published), HasSubstr("exceed 4 times white and were clamped to it"));
  scene.directional[0].intensity = glm::dvec3(1e6);
  EXPECT_THAT(run_notes(scene), Not(HasSubstr("clamped"))) << "the pixels are white in both cases";
}

// A value that is clamped in preset exact would be white without the clamp, too.
TEST(SphericalSetup, TheLargestFactorTimesTheLeastEntryIsWhite) {
  for (int data_bits = 2; data_bits <= c_white_data_bits; ++data_bits) {
    golden::SaturatingSum sum;
    sum.add(golden::multiply(1, 65535U << Exact::c_factor_fraction_bits));
    EXPECT_EQ(sum.result(Exact::c_factor_fraction_bits + data_bits, Exact::c_colour_bits), 255U) << data_bits;
  }
}

}  // namespace
}  // namespace halfway
