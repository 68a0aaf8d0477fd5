// SPDX-License-Identifier: Apache-2.0
// The searches over scenes in the spherical shader and in the shading processors.
#include <fmt/format.h>

#include <glm/geometric.hpp>
#include <map>
#include <tuple>

#include "scene/test/random_scenes.hpp"
#include "setup/walk_header.hpp"
#include "specification/hard_cases/measure.hpp"
#include "specification/hard_cases/search.hpp"
#include "specification/hard_cases/shading_bound.hpp"
#include "specification/hard_cases/spherical_trial.hpp"

namespace halfway::stability {
namespace {

struct Input {
  Scene scene;
  FrameSize frame;
  PlanRequest plan;  ///< of the hardware that the scene needs
  bool many_lights;
  bool is_published() const { return plan.preset == Preset::published; }
};

Input input_of(Shader shader, std::uint32_t seed) {
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

// Counts the pieces that cover each pixel, for each triangle and for all.
class Cover {
 public:
  Cover(const Pieces& pieces, FrameSize frame) {
    for (const ScreenTriangle& t : pieces.all())
      for_each_covered(screen_points(t), 4, frame, [&](std::int64_t x, std::int64_t y) {
        ++by_triangle_[{t.source, x, y}];
        ++pixels_[{x, y}];
      });
  }
  /// Pixels that are drawn too often or not often enough. Each piece draws its pixels once; with an object
  /// stage each pixel is drawn once.
  std::uint64_t wrong(const std::vector<Fragment>& fragments, bool nearest_alone) const {
    std::map<std::tuple<std::uint32_t, std::int64_t, std::int64_t>, int> drawn;
    std::map<std::pair<std::int64_t, std::int64_t>, int> pixels;
    for (const Fragment& f : fragments) ++drawn[{f.triangle, f.x, f.y}], ++pixels[{f.x, f.y}];
    std::uint64_t wrong = 0;
    if (nearest_alone) {
      for (const auto& [at, count] : pixels) wrong += count != 1 || !pixels_.contains(at);
      for (const auto& [at, count] : pixels_) wrong += !pixels.contains(at);
      return wrong;
    }
    for (const auto& [at, count] : by_triangle_) wrong += drawn[at] != count;
    for (const auto& [at, count] : drawn) wrong += !by_triangle_.contains(at);
    return wrong;
  }

 private:
  std::map<std::tuple<std::uint32_t, std::int64_t, std::int64_t>, int> by_triangle_;
  std::map<std::pair<std::int64_t, std::int64_t>, int> pixels_;
};

class SceneSearch final : public Search {
 public:
  SceneSearch(Shader shader, SimulatorFolders folders, bool quick)
      : shader_(shader), folders_(std::move(folders)), quick_(quick) {}

  std::string check(std::uint32_t seed, Tally& tally) override {
    const auto [scene, frame, plan, many_lights] = input_of(shader_, seed);
    const bool published = plan.preset == Preset::published;
    ++tally.inputs;
    const Result<Drawing> drawing = draw_golden(scene, {.plan = plan, .frame = frame});
    if (!drawing) return "plan: " + drawing.error().message;
    tally.fragments += drawing->golden.size();
    if (drawing->fault) return "a counter of shadow volumes exceeded its format";
    // The spans of preset published's spherical shader cover by other rules.
    if (shader_ == Shader::spherical && published) return "";
    const Pieces pieces(scene, frame);
    Worst coverage, colour;
    coverage.add(
        static_cast<double>(Cover(pieces, frame).wrong(drawing->golden, drawing->key.processors.shadows)), 0,
        [] { return "pixels"; });
    const std::string wrong = tally.add("coverage", coverage);
    if (published || !wrong.empty()) return wrong;
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
      input.plan.lights = input.many_lights ? 16 : 3;
      Trial trial(folders_, rtl_, true);
      trial.draw(input.scene, {.plan = input.plan, .frame = input.frame});
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

  Shader shader_;
  SimulatorFolders folders_;
  bool quick_;
  Simulators rtl_;
};

}  // namespace

std::unique_ptr<Search> make_spherical_search(const SimulatorFolders& folders, bool quick) {
  return std::make_unique<SceneSearch>(Shader::spherical, folders, quick);
}
std::unique_ptr<Search> make_processors_search(const SimulatorFolders& folders, bool quick) {
  return std::make_unique<SceneSearch>(Shader::processors, folders, quick);
}

}  // namespace halfway::stability
