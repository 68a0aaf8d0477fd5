// SPDX-License-Identifier: Apache-2.0
// Compares the golden model, with init vectors from the setup, with two references: the papers' formulas in
// long double, span by span, within bounds that include every rounding; and the reference renderer's frames.
#include "setup/spherical_setup.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <span>
#include <vector>

#include "frame/metrics.hpp"
#include "golden/multiplier.hpp"
#include "golden/saturating_sum.hpp"
#include "golden_run/test/drawing.hpp"
#include "golden_run/test/spherical_drawing.hpp"
#include "reference/renderer.hpp"
#include "scene/builtin_meshes.hpp"
#include "scene/test/random_scenes.hpp"
#include "setup/test/paper_spans.hpp"
#include "sim/os/file.hpp"
#include "sim/os/must.hpp"
#include "sim/os/threads.hpp"
#include "sim/run/simulate.hpp"
#include "words/generator/cosine.hpp"
#include "words/word.hpp"

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
// What a fragment's channel may be.
struct Range {
  Real low = 0, high = 0;
  void add(const Term& term) {
    low += term.value - term.bound;
    high += term.value + term.bound;
  }
};
enum class Horizon { before, beyond, either };  ///< either: rounding decides

struct FormulaFigures {
  std::uint64_t fragments = 0, terms = 0, behind_horizon = 0, either = 0, outside_bell = 0;
  std::uint64_t cut = 0, overexposed = 0;
  Real worst = 0;  ///< largest error of a fragment relative to its bound
};

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

  /// At the pixel `steps` pixels after the first one of a span. Counts what its lights show there.
  Range range(const SpanThere& span, std::span<const LightOnSpan> on, int c, int steps,
              FormulaFigures& figures) const {
    Range range;
    range.add(ambient(c));
    for (std::size_t l = 0; l < on.size(); ++l) {
      range.add(diffuse(span, on[l], l, c, steps));
      const Horizon at = horizon(span, on[l], steps);
      ++figures.terms;
      figures.behind_horizon += at == Horizon::beyond;
      if (at == Horizon::beyond) continue;
      const Term highlight = specular(span, on[l], l, c, steps);
      figures.outside_bell += highlight.value == 0;
      if (at == Horizon::before) {
        range.add(highlight);
      } else {
        ++figures.either;
        range.high += highlight.value + highlight.bound;
      }
    }
    return range;
  }

 private:
  static constexpr Real c_factor_rounding = 0x1p-9L;
  static constexpr Real c_diffuse_unit = c_exact ? paper::c_pi / 2 : paper::c_pi;

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

// Checks every fragment of the triangles that are one piece on the screen.
template <class P>
void expect_specification(const Scene& scene, FrameSize frame, const HardwareKey& key,
                          const SphericalSetupOptions& options, FormulaFigures& figures) {
  constexpr bool c_exact = std::is_same_v<P, Exact>;
  const SphericalSetup setup(scene, frame, key, options);
  const Specification<P> specification(scene, key);
  const auto model = make_golden_model(key);
  const Projector projector(
      scene, frame, {.subpixel_bits = c_exact ? c_exact_subpixel_bits : 0, .clip_to_frame = !c_exact});
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
    // A vector and the records of its lines, each of which is one span.
    for (std::span<const std::uint32_t> rest = words; !rest.empty();) {
      const auto group = rest.first(model->group(rest) * ((setup.init_bits() + 31) / 32));
      rest = rest.subspan(group.size());
      const bool upper_half =
          !c_exact && ends.upper_half(std::int64_t(words::get_bits(group, P::init_header_at::y)));
      std::vector<Fragment> fragments;
      model->draw(group, fragments);
      for (std::span<const Fragment> line = fragments; !line.empty();) {
        const auto end = std::ranges::find_if(line, [&](const Fragment& f) { return f.y != line[0].y; });
        const auto drawn = line.first(static_cast<std::size_t>(end - line.begin()));
        line = line.subspan(drawn.size());
        const Span span{drawn.front().x, drawn.back().x, drawn.front().y, upper_half};
        ASSERT_EQ(std::ssize(drawn), span.steps() + 1);
        const SpanThere there = !c_exact                               ? ends.published(span)
                                : options.ends == SpanEnds::on_surface ? ends.on_surface(span)
                                                                       : ends.along_edges(span);
        std::vector<LightOnSpan> on;
        for (std::size_t l = 0; l < there.begin.light.size(); ++l) on.push_back(on_span(there, l));
        for (int steps = 0; steps <= span.steps(); ++steps) {
          const Fragment& f = drawn[static_cast<std::size_t>(steps)];
          ++figures.fragments;
          for (int c = 0; c < 3; ++c) {
            const auto [low, high] = specification.range(there, on, c, steps, figures);
            const int value = c == 0 ? f.red : c == 1 ? f.green : f.blue;
            ASSERT_TRUE(value >= std::min<Real>(255, std::floor(low)) &&
                        value <= std::min<Real>(255, std::floor(high)))
                << "triangle " << source << ", pixel " << f.x << ',' << f.y << ", step " << steps << " of "
                << span.steps() << ", channel " << c << ": " << value << ", formulas " << low << " to "
                << high;
            if (value < 255)
              figures.worst = std::max(
                  figures.worst, std::fabs(value + 0.5L - (low + high) / 2) / (0.5L + (high - low) / 2));
          }
        }
      }
    }
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

const SphericalSetupOptions c_never_cut = {.threshold = 1e9};

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
  EXPECT_GT(figures.worst, 0.9);
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
  EXPECT_GT(figures.worst, 0.9);
}

// ---- Other properties

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
  constexpr FrameSize c_size{240, 180};
  RandomScenes random(4);
  std::uint64_t pixels = 0, cut = 0;
  for (const auto lights : {RandomScenes::directional, RandomScenes::positional, RandomScenes::spots})
    for (int i = 0; i < 36; ++i) {
      const Scene scene = lit_mesh(random, i % 3, lights);
      const HardwareKey key = spherical_key(scene);
      const Drawn drawn = draw(scene, c_size, key);
      const ReferenceImage truth = render_reference(scene, Projector(scene, c_size, {}).project_all(),
                                                    {.frame = c_size, .workers = on_threads(2)});
      const FrameDistance distance =
          *frame_distance(frame_of(scene, c_size, drawn.fragments), truth.frame, truth.mask);
      EXPECT_LE(distance.max_lsb, promised_steps(scene, key, SphericalSetupOptions{}.threshold) + 0.5) << i;
      pixels += distance.pixels;
      cut += drawn.counts.subdivided;
    }
  EXPECT_GT(pixels, 900'000u);
  EXPECT_GT(cut, 1000u);
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
