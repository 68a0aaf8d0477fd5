// SPDX-License-Identifier: Apache-2.0
#include "stability/scene_search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>

#include "setup/init_vector.hpp"
#include "setup/test/random_scenes.hpp"
#include "stability/measure.hpp"
#include "stability/shading_bound.hpp"
#include "stability/spherical_trial.hpp"

namespace halfway::stability {
namespace {

// Number formats of a scene's integers.
constexpr int c_place_bits = 12, c_part_bits = 8, c_cosine_bits = 16, c_exponent_bits = 4;
constexpr std::int64_t c_farthest = std::int64_t{1} << 20, c_unit = std::int64_t{1} << c_place_bits,
                       c_full = std::int64_t{1} << c_part_bits, c_one = std::int64_t{1} << c_cosine_bits;
constexpr std::size_t c_triangles = 8;

// Indices of the values in an input.
enum At : std::size_t {
  width,
  height,
  preset,
  shadows,
  form,
  eye,
  near_plane = eye + 3,
  colour,
  highlight = colour + 3,
  ambient = highlight + 3,
  diffuse,
  specular,
  exponent,
  ambient_light,
  lights = ambient_light + 3,
  first_light
};
// Offsets within a light, and within a triangle's vertex.
enum AtLight : std::size_t {
  kind,
  place,
  in = place + 3,
  axis = in + 3,
  inner = axis + 3,
  outer,
  light_size
};
constexpr std::size_t c_vertex = 6, c_triangle = 3 * c_vertex;
constexpr std::size_t c_triangle_count = first_light + c_most_lights * light_size,
                      c_first_triangle = c_triangle_count + 1;

// Owns the names to which the parameters' views refer.
class Parameters {
 public:
  Parameters() {
    const auto add = [&](std::string name, std::int64_t simplest, std::int64_t least, std::int64_t greatest) {
      names_.push_back(std::make_unique<std::string>(std::move(name)));
      all_.push_back({*names_.back(), simplest, least, greatest});
    };
    const auto vector = [&](const std::string& name, std::int64_t simplest_z) {
      for (const char* component : {"x", "y", "z"})
        add(name + "_" + component, *component == 'z' ? simplest_z : 0, -c_farthest, c_farthest);
    };
    const auto channels = [&](const std::string& name, std::int64_t simplest, std::int64_t greatest) {
      for (const char* channel : {"red", "green", "blue"}) add(name + "_" + channel, simplest, 0, greatest);
    };
    add("width", 1, 1, 4096);
    add("height", 1, 1, 4096);
    add("published", 0, 0, 1);
    add("shadows", 0, 0, 1);
    add("unrolled", 0, 0, 1);
    vector("eye", 4 * c_unit);
    add("near", 0, 0, c_farthest);
    channels("colour", c_full, c_full);
    channels("highlight", c_full, c_full);
    add("ambient", 0, 0, c_full);
    add("diffuse", 0, 0, c_full);
    add("specular", 0, 0, c_full);
    add("exponent", 1 << c_exponent_bits, 1 << c_exponent_bits, std::int64_t{1} << 24);
    channels("ambient_light", 0, c_full);
    add("lights", 0, 0, c_most_lights);
    for (std::size_t i = 1; i <= c_most_lights; ++i) {
      const std::string name = fmt::format("light{}", i);
      add(name + "_kind", 0, 0, 2);
      vector(name, c_unit);
      channels(name, c_full, 64 * c_full);
      vector(name + "_axis", -c_unit);
      add(name + "_inner", c_one, 0, c_one);
      add(name + "_outer", 0, 0, c_one);
    }
    add("triangles", 1, 1, c_triangles);
    for (std::size_t t = 1; t <= c_triangles; ++t)
      for (std::size_t v = 1; v <= 3; ++v) {
        vector(fmt::format("triangle{}_point{}", t, v), 0);
        vector(fmt::format("triangle{}_normal{}", t, v), c_unit);
      }
  }
  std::span<const Parameter> all() const { return all_; }

 private:
  std::vector<std::unique_ptr<std::string>> names_;
  std::vector<Parameter> all_;
};

glm::dvec3 vector_of(const Input& input, std::size_t at, int bits) {
  const auto value = [&](std::size_t i) { return std::ldexp(double(input[at + i]), -bits); };
  return {value(0), value(1), value(2)};
}
glm::dvec3 unit_of(const Input& input, std::size_t at, glm::dvec3 otherwise) {
  const glm::dvec3 v = vector_of(input, at, c_place_bits);
  return v == glm::dvec3(0.0) ? otherwise : glm::normalize(v);
}
void put(Input& input, std::size_t at, glm::dvec3 v, int bits, std::int64_t least, std::int64_t greatest) {
  for (int i = 0; i < 3; ++i)
    input[at + static_cast<std::size_t>(i)] =
        std::clamp<std::int64_t>(std::llround(std::ldexp(v[i], bits)), least, greatest);
}
void put_vector(Input& input, std::size_t at, glm::dvec3 v) {
  put(input, at, v, c_place_bits, -c_farthest, c_farthest);
}

std::size_t light_at(std::size_t i) {
  return first_light + i * light_size;
}
std::size_t triangle_at(std::size_t i) {
  return c_first_triangle + i * c_triangle;
}

Scene scene_of(const Input& input) {
  const auto part = [&](std::size_t at) { return std::ldexp(double(input[at]), -c_part_bits); };
  Scene scene;
  scene.name = "search";
  scene.camera.eye_world = vector_of(input, At::eye, c_place_bits);
  if (!has_view(scene.camera)) scene.camera.eye_world = {0.0, 0.0, 4.0};
  scene.camera.near = std::ldexp(double(input[At::near_plane]), -c_place_bits);
  scene.shadows = input[At::shadows] != 0;
  scene.ambient = vector_of(input, At::ambient_light, c_part_bits);
  scene.materials = {{.name = "m",
                      .colour = vector_of(input, At::colour, c_part_bits),
                      .specular_colour = vector_of(input, At::highlight, c_part_bits),
                      .ambient = part(At::ambient),
                      .diffuse = part(At::diffuse),
                      .specular = part(At::specular),
                      .exponent = std::ldexp(double(input[At::exponent]), -c_exponent_bits)}};
  for (std::size_t i = 0; i < static_cast<std::size_t>(input[At::lights]); ++i) {
    const std::size_t at = light_at(i);
    const glm::dvec3 position = vector_of(input, at + AtLight::place, c_place_bits),
                     intensity = vector_of(input, at + AtLight::in, c_part_bits);
    const double cos_inner = std::ldexp(double(input[at + AtLight::inner]), -c_cosine_bits),
                 cos_outer = std::ldexp(double(input[at + AtLight::outer]), -c_cosine_bits);
    if (input[at + AtLight::kind] == 0)
      scene.directional.push_back({unit_of(input, at + AtLight::place, {0.0, 0.0, 1.0}), intensity});
    else if (input[at + AtLight::kind] == 1)
      scene.positional.push_back({position, intensity});
    else
      scene.spots.push_back({position, unit_of(input, at + AtLight::axis, {0.0, 0.0, -1.0}),
                             std::max(cos_inner, cos_outer), cos_outer, intensity});
  }
  for (std::size_t t = 0; t < static_cast<std::size_t>(input[c_triangle_count]); ++t) {
    const auto first = static_cast<std::uint32_t>(scene.positions_world.size());
    for (std::size_t v = 0; v < 3; ++v) {
      const std::size_t at = triangle_at(t) + v * c_vertex;
      scene.positions_world.push_back(vector_of(input, at, c_place_bits));
      scene.normals_world.push_back(unit_of(input, at + 3, {0.0, 0.0, 1.0}));
    }
    const std::array<std::uint32_t, 3> corner = {first, first + 1, first + 2};
    scene.triangles.push_back({corner, corner, 0});
  }
  return scene;
}

FrameSize frame_of(const Input& input) {
  return {static_cast<std::uint32_t>(input[At::width]), static_cast<std::uint32_t>(input[At::height])};
}
Preset preset_of(const Input& input) {
  return input[At::preset] == 0 ? Preset::exact : Preset::published;
}

// A scene with lights of fixed kinds in order: many scenes share the same hardware.
PlanRequest request_of(Shader shader, const Input& input) {
  PlanRequest request{.shader = shader, .preset = preset_of(input), .all_effects = true};
  request.lights = input[At::lights] <= 3 ? 3 : 16;
  if (shader == Shader::processors)
    request.form = input[At::form] == 0 ? ProcessorForm::folded : ProcessorForm::unrolled;
  return request;
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

class SceneChecker : public Checker {
 public:
  SceneChecker(Shader shader, SimulatorFolders folders, bool quick)
      : shader_(shader), folders_(std::move(folders)), quick_(quick) {}

  std::optional<Failure> check(const Input& input, Tally& tally) override {
    const Scene scene = scene_of(input);
    const FrameSize frame = frame_of(input);
    ++tally.inputs;
    const Result<Drawing> drawing = draw_golden(scene, {.plan = called_for(input), .frame = frame});
    if (!drawing) return Failure{"plan", drawing.error().message};
    tally.fragments += drawing->fragments.size();
    if (drawing->fault) return Failure{"fault", "a counter of shadow volumes exceeded its format"};
    // The spans of preset published's spherical shader cover by other rules.
    if (shader_ == Shader::spherical && preset_of(input) == Preset::published) return {};
    InputFigures figures(tally);
    const Pieces pieces(scene, frame);
    Worst coverage, colour;
    coverage.add(
        static_cast<double>(Cover(pieces, frame).wrong(drawing->fragments, drawing->key.processors.shadows)),
        0, [] { return "pixels"; });
    figures.add("coverage", coverage);
    if (preset_of(input) == Preset::published || figures.failure()) return figures.failure();
    if (shader_ == Shader::processors)
      against_range(scene, frame, *drawing, pieces, colour);
    else
      against_promise(scene, frame, *drawing, colour);
    figures.add("colour", colour);
    return figures.failure();
  }

  Result<std::optional<Failure>> check_rtl(std::span<const Input> inputs, Tally& tally) override {
    for (const Input& input : inputs) {
      // Sixteen lights take a minute to build: use only one form of the hardware.
      const bool many = input[At::lights] > 3;
      if (many && (quick_ || preset_of(input) == Preset::published || input[At::form] == 0)) continue;
      Trial trial(folders_, rtl_, true);
      trial.draw(scene_of(input), {.plan = request_of(shader_, input), .frame = frame_of(input)});
      auto failure = rtl_failure(trial, 1, tally);
      if (!failure || *failure) return failure;
    }
    return std::optional<Failure>{};
  }

 private:
  static std::string where(const Fragment& f) { return fmt::format("pixel {},{}", f.x, f.y); }

  PlanRequest called_for(const Input& input) const {
    PlanRequest request = request_of(shader_, input);
    request.all_effects = false;
    request.lights.reset();
    return request;
  }

  // With shadows a light may or may not reach a pixel. The colour must match for some set of lights.
  static void against_range(const Scene& scene, FrameSize frame, const Drawing& drawing, const Pieces& pieces,
                            Worst& worst) {
    const ShadingBound bound(scene, frame);
    const std::size_t lights = bound.lights().size();
    if (drawing.key.processors.shadows && lights > 6) return;  // too many sets
    const std::uint32_t all = drawing.key.processors.shadows ? (1U << lights) - 1 : 0;
    for (const Fragment& f : drawing.fragments) {
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
    for (const Fragment& f : drawing.fragments)
      worst.add(static_cast<double>(colour_error(f, truth.radiance_at(f.triangle, f.x, f.y))), bound,
                [&] { return where(f); });
  }

  Shader shader_;
  SimulatorFolders folders_;
  bool quick_;
  Simulators rtl_;
};

class SceneSearch final : public Search {
 public:
  explicit SceneSearch(Shader shader) : shader_(shader) {}
  std::string_view name() const override {
    return shader_ == Shader::spherical ? "spherical-scenes" : "processor-scenes";
  }
  std::string_view about() const override {
    return shader_ == Shader::spherical
               ? "Random scenes in the spherical shader, both presets: up to eight triangles with their own "
                 "normals, up to sixteen lights of all kinds, from close to the surface to far away. The "
                 "figure of a scene is that of its worst pixel; the bound is that of the set-up's threshold, "
                 "of bells and of tables. Preset `published` is only drawn by the RTL."
               : "The same scenes in the shading processors, both presets and both forms, with and without "
                 "shadows, with near planes that cut triangles. The figure of a scene is that of its worst "
                 "pixel; the bound is that of the errors of the units. A shadow may fall on any pixel here; "
                 "the family `shadows` checks shadows.";
  }
  std::span<const Parameter> parameters() const override { return parameters_.all(); }
  std::uint64_t full_count() const override { return 25'000; }
  std::uint64_t quick_count() const override { return 200; }
  std::uint64_t rtl_every() const override { return 10; }
  std::unique_ptr<Checker> checker(const SimulatorFolders& folders, bool quick) const override {
    return std::make_unique<SceneChecker>(shader_, folders, quick);
  }

  Input make(std::uint32_t seed) const override {
    RandomScenes random(seed);
    Input input;
    for (const Parameter& p : parameters_.all()) input.push_back(p.simplest);
    const bool processors = shader_ == Shader::processors;
    input[At::width] = random.whole(8, 64);
    input[At::height] = random.whole(8, 48);
    input[At::preset] = random.one_in(4);
    input[At::form] = !processors || random.one_in(2);
    Scene scene;
    const int count = random.one_in(20) ? 16 : random.whole(0, 3);
    // With shadows each pixel is compared for all sets of lights, so keep their number small.
    input[At::shadows] = processors && count <= 3 && random.one_in(3);
    random.add_triangles(scene, random.whole(1, int{c_triangles}), random.log_within(0.05, 1.0),
                         random.one_in(3) ? 0.0 : random.log_within(0.01, 1.0));
    random.add_lights(scene, count, RandomScenes::any, 1.0, random.one_in(3));
    put_vector(input, At::eye, scene.camera.eye_world);
    if (processors && random.one_in(6)) {
      put_vector(input, At::eye, random.within(0.3, 1.5) * random.unit());
      input[At::near_plane] = std::llround(std::ldexp(random.log_within(1e-2, 0.5), c_place_bits));
    }
    const Material m = random.material(random.one_in(3), random.one_in(2), random.one_in(3) ? 8000.0 : 200.0);
    put(input, At::colour, m.colour, c_part_bits, 0, c_full);
    put(input, At::highlight, m.specular_colour, c_part_bits, 0, c_full);
    const auto part = [](double v) { return std::llround(std::ldexp(v, c_part_bits)); };
    input[At::ambient] = part(m.ambient);
    input[At::diffuse] = random.one_in(5) ? 0 : part(m.diffuse);
    input[At::specular] = random.one_in(5) ? 0 : part(m.specular);
    input[At::exponent] = std::llround(std::ldexp(m.exponent, c_exponent_bits));
    put(input, At::ambient_light, random.colour(false), c_part_bits, 0, c_full);
    // Add the lights by kind, in the order of scenes.
    const auto light = [&](int of_kind, glm::dvec3 where, glm::dvec3 intensity) {
      const std::size_t at = light_at(static_cast<std::size_t>(input[At::lights]++));
      input[at + AtLight::kind] = of_kind;
      put_vector(input, at + AtLight::place, where);
      put(input, at + AtLight::in, intensity, c_part_bits, 0, 64 * c_full);
      return at;
    };
    for (const DirectionalLight& l : scene.directional) light(0, l.to_light_world, l.intensity);
    for (const PositionalLight& l : scene.positional) light(1, l.position_world, l.intensity);
    for (const SpotLight& l : scene.spots) {
      const std::size_t at = light(2, l.position_world, l.intensity);
      put_vector(input, at + AtLight::axis, l.axis_world);
      input[at + AtLight::inner] = std::llround(std::ldexp(l.cos_inner, c_cosine_bits));
      input[at + AtLight::outer] =
          std::max<std::int64_t>(std::llround(std::ldexp(l.cos_outer, c_cosine_bits)), 0);
    }
    input[c_triangle_count] = static_cast<std::int64_t>(scene.triangles.size());
    for (std::size_t t = 0; t < scene.triangles.size(); ++t)
      for (std::size_t v = 0; v < 3; ++v) {
        const std::size_t at = triangle_at(t) + v * c_vertex;
        put_vector(input, at, scene.positions_world[scene.triangles[t].position[v]]);
        put_vector(input, at + 3, scene.normals_world[scene.triangles[t].normal[v]]);
      }
    return input;
  }

  std::vector<Input> simpler(const Input& input) const override {
    std::vector<Input> out;
    // Removes the i-th of several blocks and moves the following ones up.
    const auto drop = [&](std::size_t count_at, std::size_t first, std::size_t size, std::size_t i) {
      const auto count = static_cast<std::size_t>(input[count_at]);
      Input less = input;
      std::copy(input.begin() + std::ptrdiff_t(first + (i + 1) * size),
                input.begin() + std::ptrdiff_t(first + count * size),
                less.begin() + std::ptrdiff_t(first + i * size));
      for (std::size_t k = first + (count - 1) * size; k < first + count * size; ++k)
        less[k] = parameters_.all()[k].simplest;
      --less[count_at];
      out.push_back(std::move(less));
    };
    for (std::size_t i = 0; i < static_cast<std::size_t>(input[At::lights]); ++i)
      drop(At::lights, first_light, light_size, i);
    if (input[c_triangle_count] > 1)
      for (std::size_t i = 0; i < static_cast<std::size_t>(input[c_triangle_count]); ++i)
        drop(c_triangle_count, c_first_triangle, c_triangle, i);
    // Use one normal per triangle, and round all positions.
    for (std::size_t t = 0; t < static_cast<std::size_t>(input[c_triangle_count]); ++t) {
      Input flat = input;
      for (std::size_t v = 1; v < 3; ++v)
        std::copy_n(flat.begin() + std::ptrdiff_t(triangle_at(t) + 3), 3,
                    flat.begin() + std::ptrdiff_t(triangle_at(t) + v * c_vertex + 3));
      if (flat != input) out.push_back(std::move(flat));
    }
    for (const int bits : {10, 8, 6, 4}) {
      Input round = input;
      for (std::size_t i = 0; i < round.size(); ++i) {
        const Parameter& p = parameters_.all()[i];
        if (p.least != -c_farthest) continue;
        const std::int64_t step = std::int64_t{1} << bits;
        round[i] = std::clamp((round[i] + step / 2) / step * step, p.least, p.greatest);
      }
      if (round != input) out.push_back(std::move(round));
    }
    return out;
  }

 private:
  Shader shader_;
  Parameters parameters_;
};

}  // namespace

std::unique_ptr<Search> make_spherical_search() {
  return std::make_unique<SceneSearch>(Shader::spherical);
}
std::unique_ptr<Search> make_processors_search() {
  return std::make_unique<SceneSearch>(Shader::processors);
}

}  // namespace halfway::stability
