// SPDX-License-Identifier: Apache-2.0
// The searches over scenes: patches in the quadratic shader; scenes in the spherical shader and in the
// shading processors.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>
#include <numbers>
#include <tuple>
#include <utility>
#include <vector>

#include "scene/test/random_scenes.hpp"
#include "setup/walk_header.hpp"
#include "specification/hard_cases/measure.hpp"
#include "specification/hard_cases/screen_drawing.hpp"
#include "specification/hard_cases/search.hpp"
#include "specification/hard_cases/shading_bound.hpp"

namespace halfway::stability {
namespace {

struct Input {
  Scene scene;
  FrameSize frame;
  PlanRequest plan;  ///< of the hardware that the scene needs
  bool many_lights = false;
  SetupOptions setup{};
  bool is_published() const { return plan.preset == Preset::published; }
};

// Adds a light whose highlight is on the triangle or close to it, or that shines along the surface or against
// the eye.
void add_light_near_highlight(RandomScenes& random, Scene& scene, double size) {
  const auto weight = [&] { return random.within(0, 1); };
  const glm::dvec3 b = glm::dvec3(weight(), weight(), weight());
  glm::dvec3 place(0), normal(0);
  for (std::size_t i = 0; i < 3; ++i) {
    const double share = b[static_cast<int>(i)] / (b.x + b.y + b.z);
    place += share * scene.positions_world[i];
    normal += share * scene.normals_world[i];
  }
  if (glm::length(normal) < 1e-6) normal = glm::dvec3(0, 0, 1);
  normal = glm::normalize(normal);
  const glm::dvec3 to_eye = glm::normalize(scene.camera.eye_world - place),
                   half = glm::normalize(normal + random.within(0, 3) /
                                                      std::sqrt(scene.materials[0].exponent) * random.unit());
  glm::dvec3 to_light = 2 * glm::dot(half, to_eye) * half - to_eye;
  if (random.one_in(8))  // along the surface
    to_light = glm::cross(normal, random.unit()) + random.within(-0.1, 0.1) * normal;
  else if (random.one_in(8))
    to_light = -to_eye + random.log_within(1e-9, 0.1) * random.cube();
  else if (random.one_in(10))
    to_light = random.unit();
  to_light = glm::normalize(to_light);
  const glm::dvec3 intensity = random.within(0.3, random.one_in(5) ? 10 : 1) * random.colour(false),
                   position = place + size * random.log_within(1e-3, 100) * to_light;
  switch (random.whole(0, 2)) {
    case 0:
      scene.directional.push_back({to_light, intensity});
      return;
    case 1:
      scene.positional.push_back({position, intensity});
      return;
    default: {
      const double outer = random.log_within(0.02, 1.4),
                   inner = random.one_in(3) ? outer : random.within(0, 0.95) * outer;
      scene.spots.push_back({position, glm::normalize(random.within(0, 0.6) * random.unit() - to_light),
                             std::cos(inner), std::cos(outer), intensity});
    }
  }
}

// One triangle of 1 to 4096 pixels, flat or curved, with normals that agree, differ or cancel.
Input patch_of(std::uint32_t seed) {
  RandomScenes random(seed);
  Input input{.scene = {}, .frame = {96, 96}, .plan = {.shader = Shader::quadratic}};
  input.setup.quadratic = {.test = random.one_in(2) ? HighlightTest::proved : HighlightTest::conservative,
                           .threshold = 0.5 * (1 << random.whole(0, 4))};
  if (input.setup.quadratic.test == HighlightTest::proved && random.one_in(4)) input.plan.degree = 1;
  Scene& scene = input.scene;
  scene.name = "search";
  Material& m = scene.materials.emplace_back(random.material(false, random.one_in(2)));
  const int brdf = random.whole(0, 3);
  m.brdf = brdf == 0 ? Brdf::cook_torrance : brdf == 1 ? Brdf::phong : Brdf::blinn;
  m.roughness = random.log_within(0.05, 1);
  if (random.one_in(5)) m.diffuse = 0.0;
  scene.ambient = random.colour(false);

  // Twice the circumcircle's area is about that of the square around it.
  const double size = random.log_within(0.1, 10), distance = size * random.log_within(1.2, 100),
               radius_pixels = 0.88 * std::sqrt(random.log_within(1, 4096));
  scene.camera.eye_world = {0, 0, distance};
  scene.camera.vertical_fov_degrees =
      2 * 180 / std::numbers::pi * std::atan(0.5 * input.frame.height * size / (distance * radius_pixels));
  const double tilt = random.one_in(4) ? 0 : random.log_within(0.01, 0.7 * distance / size),
               turn = random.within(0, 7), spread = random.one_in(5) ? 0 : random.log_within(1e-3, 1),
               bend = random.one_in(5) ? 0 : random.log_within(0.01, 3);
  const int normals = random.whole(0, 19);
  for (int i = 0; i < 3; ++i) {
    const double angle = 2 * std::numbers::pi * (i + random.within(0, 0.8)) / 3;
    const glm::dvec3 p(std::cos(angle), std::sin(angle), tilt * std::cos(angle - turn));
    scene.positions_world.push_back(size * p);
    glm::dvec3 n = glm::dvec3(bend * p.x, bend * p.y, 1) + spread * random.cube();
    if (normals == 0) n = random.unit();
    if (normals == 1 && i == 1) n = -scene.normals_world[0] + random.log_within(1e-6, 0.1) * random.cube();
    scene.normals_world.push_back(glm::normalize(n));
  }
  scene.triangles = {{{0, 1, 2}, {0, 1, 2}, 0, Culling::none}};
  const int lights = random.one_in(50) ? 16 : random.whole(1, 3);
  for (int i = 0; i < lights; ++i) add_light_near_highlight(random, scene, size);
  return input;
}

Input input_of(Shader shader, std::uint32_t seed) {
  if (shader == Shader::quadratic) return patch_of(seed);
  const bool processors = shader == Shader::processors;
  RandomScenes random(seed);
  Input input;
  input.frame = {static_cast<std::uint32_t>(random.whole(8, 64)),
                 static_cast<std::uint32_t>(random.whole(8, 48))};
  input.plan = {.shader = shader, .preset = random.one_in(4) ? Preset::published : Preset::exact};
  if (processors) input.plan.form = random.one_in(2) ? ProcessorForm::unrolled : ProcessorForm::folded;
  Scene& scene = input.scene;
  scene.name = "search";
  const int lights = random.one_in(20) ? 16 : random.whole(0, 3);
  input.many_lights = lights > 3;
  // With shadows each pixel is compared for all sets of lights, so keep their number small.
  scene.shadows = processors && lights <= 3 && random.one_in(3);
  random.add_triangles(scene, random.whole(1, 8), random.log_within(0.05, 1.0),
                       random.one_in(3) ? 0.0 : random.log_within(0.01, 1.0));
  random.add_lights(scene, lights, RandomScenes::any, 1.0, random.one_in(3));
  if (processors && random.one_in(6)) {
    scene.camera.eye_world = random.within(0.3, 1.5) * random.unit();
    scene.camera.near = random.log_within(1e-2, 0.5);
  }
  Material m = random.material(random.one_in(3), random.one_in(2), random.one_in(3) ? 8000.0 : 200.0);
  m.name = "m";
  m.brdf = Brdf::blinn;
  if (random.one_in(5)) m.diffuse = 0.0;
  if (random.one_in(5)) m.specular = 0.0;
  scene.materials = {m};
  scene.ambient = random.colour(false);
  return input;
}

// The number of pixels that are drawn too often or not often enough. Each piece draws its pixels once; with
// object processors each pixel is drawn once.
std::size_t wrong_pixels(const Pieces& pieces, FrameSize frame, const std::vector<Fragment>& fragments,
                         bool nearest_alone) {
  using Pixel = std::tuple<std::uint32_t, std::int64_t, std::int64_t>;  // triangle, x, y
  std::vector<Pixel> covered, drawn, wrong;
  for (const ScreenTriangle& t : pieces.all())
    for_each_covered(screen_points(t), c_subpixel_bits, frame, [&](std::int64_t x, std::int64_t y) {
      covered.emplace_back(nearest_alone ? 0 : t.source, x, y);
    });
  for (const Fragment& f : fragments) drawn.emplace_back(nearest_alone ? 0 : f.triangle, f.x, f.y);
  std::ranges::sort(covered);
  std::ranges::sort(drawn);
  if (nearest_alone) covered.erase(std::unique(covered.begin(), covered.end()), covered.end());
  std::ranges::set_symmetric_difference(covered, drawn, std::back_inserter(wrong));
  return wrong.size();
}

class SceneSearch final : public Search {
 public:
  SceneSearch(Shader shader, SimulatorFolders folders, bool quick)
      : shader_(shader), folders_(std::move(folders)), quick_(quick) {}

  std::string check(std::uint32_t seed, Tally& tally) override {
    const Input input = input_of(shader_, seed);
    const auto& [scene, frame, input_plan, many_lights, setup] = input;
    PlanRequest plan = input_plan;
    if (scene.shadows) plan.objects = c_golden_objects;
    const bool published = plan.preset == Preset::published;
    ++tally.inputs;
    const Result<Drawing> drawing = draw_golden(scene, {.plan = plan, .frame = frame, .setup = setup});
    if (!drawing) return "plan: " + drawing.error().message;
    tally.fragments += drawing->golden.size();
    if (drawing->counts.objects > c_golden_objects) return "";  // refused
    if (drawing->fault) return "the hardware refused a vector";
    // The spans of preset published's spherical shader cover by other rules.
    if (shader_ == Shader::spherical && published) return "";
    const Pieces pieces(scene, frame);
    Worst coverage, colour;
    coverage.add(static_cast<double>(
                     wrong_pixels(pieces, frame, drawing->golden, drawing->key.processors.objects > 0)),
                 0, [] { return "pixels"; });
    const std::string wrong = tally.add("coverage", coverage);
    if (published || !wrong.empty()) return wrong;
    if (shader_ == Shader::quadratic) return against_threshold(input, *drawing, pieces, tally);
    if (shader_ == Shader::processors)
      against_range(scene, frame, *drawing, pieces, colour);
    else
      against_promise(scene, frame, *drawing, colour);
    return tally.add("colour", colour);
  }

  Result<std::string> check_rtl(std::span<const std::uint32_t> seeds, Tally& tally) override {
    for (const std::uint32_t seed : seeds) {
      Input input = input_of(shader_, seed);
      // Sixteen lights take a minute to build: use only one form of the hardware.
      if (input.many_lights && (quick_ || input.is_published() || input.plan.form == ProcessorForm::folded))
        continue;
      // Lights of fixed kinds in order: many scenes share the same hardware.
      input.plan.all_effects = true;
      if (shader_ != Shader::quadratic) input.plan.lights = input.many_lights ? 16 : 3;
      // Unrolled, sixteen object processors take as long.
      if (quick_ && input.scene.shadows) input.plan.form = ProcessorForm::folded;
      Trial trial(folders_, rtl_, true);
      trial.draw(input.scene, {.plan = input.plan, .frame = input.frame, .setup = input.setup});
      auto failure = rtl_failure(trial, 1, tally);
      if (!failure || !failure->empty()) return failure;
    }
    return std::string();
  }

 private:
  static std::string where(const Fragment& f) { return fmt::format("pixel {},{}", f.x, f.y); }

  // With shadows a light may or may not reach a pixel. The colour must match for some set of lights.
  static void against_range(const Scene& scene, FrameSize frame, const Drawing& drawing, const Pieces& pieces,
                            Worst& worst) {
    const ShadingBound bound(scene, frame);
    const std::size_t lights = bound.lights().size();
    if (drawing.key.processors.shadows && lights > 6) return;  // too many sets
    const std::uint32_t all = drawing.key.processors.shadows ? (1U << lights) - 1 : 0;
    for (const Fragment& f : drawing.golden) {
      const ScreenTriangle* piece = pieces.covering(f);
      Worst best;
      for (std::uint32_t dark = 0; dark <= all && !(best.count > 0 && best.within()); ++dark) {
        const Promise promise = bound.at(*piece, f.x, f.y, [&](std::size_t i) { return !(dark >> i & 1); });
        Worst here;
        for (std::size_t c = 0; c < 3; ++c)
          here.add(static_cast<double>(std::abs(promise.exact[c] - channels(f)[c])),
                   static_cast<double>(promise.bound(c)), [&] { return where(f); });
        if (best.count == 0 || here.figure * best.bound < best.figure * here.bound) best = here;
      }
      worst.add(best.figure, best.bound, [&] { return best.where; });
    }
  }

  static void against_promise(const Scene& scene, FrameSize frame, const Drawing& drawing, Worst& worst) {
    const double bound = promised_steps(scene, drawing.key, SphericalSetupOptions{}.threshold);
    const Truth truth(scene, frame);
    for (const Fragment& f : drawing.golden)
      worst.add(static_cast<double>(colour_error(f, truth.radiance_at(f.triangle, f.x, f.y))), bound,
                [&] { return where(f); });
  }

  // Greater than the errors found, which exceed what the conservative test is calibrated to.
  static constexpr double c_of_conservative = 5.0;

  // The error of the worst pixel beyond the rounding of the hardware, in thresholds. Unresolved leaves have
  // no bound.
  static std::string against_threshold(const Input& input, const Drawing& drawing, const Pieces& pieces,
                                       Tally& tally) {
    const auto& [test, threshold, level] = input.setup.quadratic;
    const bool unresolved = drawing.counts.unresolved > 0;
    const double rounding = colour_bound(Preset::exact, 3.0 * input.frame.width),
                 bound = unresolved                      ? 255 / threshold
                         : test == HighlightTest::proved ? thresholds_of(test)
                                                         : c_of_conservative;
    Worst worst;
    for_each_error(input.scene, pieces, drawing.golden, [&](double off, const Fragment& f) {
      worst.add(std::max(0.0, off - rounding) / threshold, bound, [&] { return where(f); });
    });
    if (unresolved) return tally.add("error in thresholds, unresolved leaves", worst);
    return tally.add(
        test == HighlightTest::proved ? "error in thresholds, proved" : "error in thresholds, conservative",
        worst);
  }

  Shader shader_;
  SimulatorFolders folders_;
  bool quick_;
  Simulators rtl_;
};

}  // namespace

std::unique_ptr<Search> make_scene_search(Shader shader, const SimulatorFolders& folders, bool quick) {
  return std::make_unique<SceneSearch>(shader, folders, quick);
}

}  // namespace halfway::stability
