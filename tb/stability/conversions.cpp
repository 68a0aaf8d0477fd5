// SPDX-License-Identifier: Apache-2.0
// NaN, infinite, huge, denormal and negative zero at every conversion from real to integer: in the functions
// that convert, in scenes in memory, in scene files and in mesh files.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <random>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "common/to_integer.hpp"
#include "frame/frame.hpp"
#include "golden_run/golden_run.hpp"
#include "reference/ray_cast.hpp"
#include "reference/renderer.hpp"
#include "scene/check_numbers.hpp"
#include "scene/lights.hpp"
#include "setup/init_vector.hpp"
#include "setup/test/gmp_numbers.hpp"
#include "setup/test/random_scenes.hpp"
#include "sim/scene_files/load_scene.hpp"
#include "sim/system/file.hpp"
#include "sim/system/subprocess.hpp"
#include "stability/hard_case.hpp"
#include "stability/measure.hpp"
#include "stability/spherical_trial.hpp"
#include "stability/trial.hpp"

namespace halfway::stability {
namespace {

constexpr double c_nan = std::numeric_limits<double>::quiet_NaN();

constexpr double c_no_numbers[] = {c_nan, -c_nan, c_infinity, -c_infinity};
constexpr double c_extremes[] = {1.7976931348623157e308,
                                 -1.7976931348623157e308,
                                 1e308,
                                 -1e308,
                                 1e155,
                                 -1e155,
                                 1e100,
                                 -1e100,
                                 1e15,
                                 -1e15,
                                 0x1p64,
                                 0x1p63,
                                 -0x1p63,
                                 0x1p32,
                                 0x1p31,
                                 -0x1p31,
                                 5e-324,
                                 -5e-324,
                                 1e-310,
                                 -1e-310,
                                 0.0,
                                 -0.0,
                                 0.5,
                                 -0.5};

std::vector<double> hostile_numbers() {
  std::vector<double> all(std::begin(c_no_numbers), std::end(c_no_numbers));
  all.insert(all.end(), std::begin(c_extremes), std::end(c_extremes));
  return all;
}

// ---- List of the conversions

// Calls of to_integer: every conversion from real to integer in the shipped code, except those of
// integer-valued words in the golden model, which has no real numbers. Each entry gives the functions with
// the calls, and the case of this file that tests them with hostile numbers.
struct Site {
  std::string_view file;
  int calls;
  std::string_view where;
};
constexpr Site c_sites[] = {
    {"sim/bench/program/growth.cpp", 2, "counts of the bench; only `make bench` asks"},
    {"sim/bench/program/small_triangles.cpp", 2, "triangles of a sphere, clamped; only `make bench` asks"},
    {"sim/bench/workload.cpp", 1, "sphere_scene: stacks of so many triangles; only `make bench` asks"},
    {"sim/cli/options.cpp", 1, "Progress::show: a percentage; any part of the work done"},
    {"sim/cli/plan.cpp", 1, "saved: a percentage of cells"},
    {"sim/cli/sim.cpp", 1, "run: a percentage"},
    {"sim/figures/quadratic_figures.cpp", 1, "draw_times: words of an interpolator; numbers of its own"},
    {"sim/figures/rings.cpp", 1, "measure_rings: half a line of a disc"},
    {"sim/figures/spherical_figures.cpp", 1, "entry_at: an entry of a table; angles within it"},
    {"sim/pictures/flip.cpp", 2, "radii of the filters, of constants; flip_test"},
    {"sim/live_core/live_scene.cpp", 2,
     "sides of a frame, checked to be whole numbers in range; live_frame_test"},
    {"sim/report/figures.cpp", 2, "size_of: width and height of an SVG that this project wrote"},
    {"model/common/sine_cosine.cpp", 1, "quarter turns of an angle; sine_cosine_test"},
    {"model/frame/frame.hpp", 1, "to_byte: Channels of a picture"},
    {"model/reference/ray_cast.cpp", 1, "ShadowRays: bins of a tree; Extreme numbers, the reference picture"},
    {"model/mesh_files/ply.cpp", 1, "index of a corner, in range; Numbers of a mesh file"},
    {"model/scene/hen_mesh.cpp", 1, "Net: cells of a lattice; numbers of its own"},
    {"model/scene_files/parse_scene.cpp", 1, "slices at another tessellation, in range; load_scene_test"},
    {"model/setup/exact_division.hpp", 2, "an estimate that exact remainders mend; exact_division_test"},
    {"model/setup/half_triangle.cpp", 2, "whole pixels of preset published; Extreme numbers"},
    {"model/setup/init_vector.hpp", 2, "fixed, wrapped_word: Fixed-point words of any real"},
    {"model/setup/processors_setup.cpp", 1, "clamped; Extreme numbers"},
    {"model/setup/project.cpp", 2, "Projector: guard band and snap; Snapped vertices"},
    {"sim/study/design_point.cpp", 2, "bits of tables, in range and whole; design_point_test"},
    {"model/tables/cosine.cpp", 1, "entries, checked sizes; cosine_test"},
    {"model/tables/functions.cpp", 2,
     "entries, and the root's raise, less than 2^24 of relative errors below 1; functions_test"},
    {"sim/synth/clock_store.cpp", 1, "read_clocks: counts, not negative; clock_store_test"},
};

std::size_t closing(const std::string& text, std::size_t open) {
  int depth = 0;
  for (std::size_t i = open; i < text.size(); ++i) {
    depth += (text[i] == '(') - (text[i] == ')');
    if (depth == 0) return i;
  }
  return text.size();
}

// Casts to integers of expressions that look like real numbers, and the library's functions that round to
// integers.
int other_conversions(const std::string& text) {
  static const std::regex c_rounding(R"(\bl?l(round|rint)\w*\s*\()");
  static const std::regex c_cast(
      R"(static_cast<[^<>]*\b(int|long|short|char|unsigned|size_t|ptrdiff_t|u?int\d+_t|Int128)\b[^<>]*>\s*\()");
  static const std::regex c_real(
      R"(\b(floor|ceil|round|rint|nearbyint|trunc|fmod|ldexp|sqrt|double|float)\b|\d\.\d)");
  int count = static_cast<int>(std::distance(std::sregex_iterator(text.begin(), text.end(), c_rounding), {}));
  for (auto it = std::sregex_iterator(text.begin(), text.end(), c_cast); it != std::sregex_iterator(); ++it) {
    const auto open = static_cast<std::size_t>(it->position() + it->length()) - 1;
    count += std::regex_search(text.substr(open, closing(text, open) - open), c_real);
  }
  return count;
}

std::vector<std::filesystem::path> shipped_sources(const std::filesystem::path& root) {
  std::vector<std::filesystem::path> files;
  for (const char* folder : {"model", "sim"})
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder)) {
      const std::string name = entry.path().filename().string();
      const bool is_source = name.ends_with(".cpp") || name.ends_with(".hpp");
      if (is_source && !name.ends_with("_test.cpp")) files.push_back(entry.path());
    }
  std::ranges::sort(files);
  return files;
}

// In the full sweep the compiler's own analysis is compared, if clang-query is installed.
void ask_clang(Trial& trial, const std::filesystem::path& file, const std::string& name) {
  const auto end = run_process(
      {.arguments =
           {"clang-query", "-c", "set output diag", "-c",
            R"(match castExpr(hasCastKind("CK_FloatingToIntegral"), isExpansionInFileMatching("/(model|sim)/")))",
            file.string(), "--", "-std=gnu++20", "-w", "-I", (trial.source() / "model").string(), "-I",
            trial.source().string(), "-DHALFWAY_SOURCE_DIR=\"\"", "-DHALFWAY_VERSION=\"\""}},
      "apt-get install clang-tools");
  if (!end) return;
  static const std::regex c_place(R"(([^\s:]+):(\d+):\d+: note: "root")");
  for (auto it = std::sregex_iterator(end->output.begin(), end->output.end(), c_place);
       it != std::sregex_iterator(); ++it)
    trial.check((*it)[1].str().ends_with("common/to_integer.hpp"),
                [&] { return fmt::format("{}:{}, a cast", (*it)[1].str(), (*it)[2].str()); });
  trial.ours(0, 0, [&] { return name; });
}

void sites(Trial& trial) {
  std::map<std::string, int> listed;
  for (const Site& site : c_sites) listed[std::string(site.file)] = site.calls;
  const bool clang = !trial.quick() && !find_program("clang-query").empty();
  static const std::regex c_call(R"(\bto_integer<)");
  for (const std::filesystem::path& path : shipped_sources(trial.source())) {
    const std::string name = std::filesystem::relative(path, trial.source()).generic_string();
    const auto text = read_file(path);
    trial.require(bool(text), [&] { return name + ": cannot be read"; });
    if (!text) continue;
    const int calls =
        static_cast<int>(std::distance(std::sregex_iterator(text->begin(), text->end(), c_call), {}));
    const int wanted = listed.contains(name) ? listed[name] : 0;
    listed.erase(name);
    trial.ours(std::abs(calls - wanted), 0, [&] {
      return fmt::format("{}: {} calls of to_integer, {} listed in tb/stability/conversions.cpp", name, calls,
                         wanted);
    });
    if (name != "model/common/to_integer.hpp")
      trial.ours(other_conversions(*text), 0, [&] { return name + ": converts without to_integer"; });
    if (clang && name.ends_with(".cpp") && !name.ends_with("harness.cpp")) ask_clang(trial, path, name);
  }
  trial.require(listed.empty(), [&] { return listed.begin()->first + " is listed and not there"; });
}

// ---- Functions

// A double with random bits.
class AnyDouble {
 public:
  double next() { return std::bit_cast<double>(random_()); }
  template <class F>
  void sweep(int rounds, F&& f) {
    for (const double v : hostile_numbers()) f(v);
    for (int i = 0; i < rounds; ++i) f(next());
  }

 private:
  std::mt19937_64 random_{31};
};

template <class Integer>
mpz_class as_mpz(Integer v) {
  return to_mpz(Int128{v});
}
mpz_class as_mpz(std::uint64_t v) {
  return to_mpz(static_cast<Int128>(v));
}

// The integer part, clamped to Integer; exact.
template <class Integer>
mpz_class held_part(double v) {
  const mpz_class least = as_mpz(std::numeric_limits<Integer>::min()),
                  most = as_mpz(std::numeric_limits<Integer>::max());
  if (std::isnan(v)) return 0;
  if (std::isinf(v)) return v > 0 ? most : least;
  return std::clamp(mpz_class(v), least, most);
}

template <class Integer>
void integers_of(Trial& trial, const char* name) {
  AnyDouble any;
  any.sweep(trial.rounds(5000, 1'000'000), [&](double v) {
    const mpz_class off = abs(as_mpz(to_integer<Integer>(v)) - held_part<Integer>(v));
    trial.ours(off.get_d(), 0, [&] { return fmt::format("{} to {}", v, name); });
  });
}

void integers(Trial& trial) {
  integers_of<int>(trial, "int");
  integers_of<std::uint8_t>(trial, "uint8");
  integers_of<std::uint32_t>(trial, "uint32");
  integers_of<std::int64_t>(trial, "int64");
  integers_of<std::uint64_t>(trial, "uint64");
  integers_of<Int128>(trial, "int128");
}

// fixed() clamps to 64 bits and rounds ties away from zero. wrapped_word() wraps modulo its width and rounds
// ties to even.
void words(Trial& trial) {
  AnyDouble any;
  any.sweep(trial.rounds(5000, 1'000'000), [&](double v) {
    for (const int fraction : {0, 8, 20, 22}) {
      const double scaled = std::ldexp(v, fraction);
      const auto where = [&] { return fmt::format("{} with {} fraction bits", v, fraction); };
      const mpz_class truth = held_part<std::int64_t>(std::round(scaled));
      trial.ours(mpz_class(abs(as_mpz(fixed(v, fraction)) - truth)).get_d(), 0, where);
      for (const int bits : {12, 32, 40}) {
        mpz_class word = 0;  // the result for NaN
        if (std::isfinite(scaled)) word = mpz_class(std::nearbyint(scaled));
        // Above 2^1023 a number is a multiple of every modulus.
        mpz_class off = as_mpz(wrapped_word(v, fraction, bits)) - word;
        mpz_fdiv_r_2exp(off.get_mpz_t(), off.get_mpz_t(), static_cast<mp_bitcnt_t>(bits));
        trial.ours(off.get_d(), 0, where);
      }
    }
  });
}

// Half a step, and the rounding of 255 v + 0.5: 2^-45 below 256.
void channels(Trial& trial) {
  AnyDouble any;
  const auto measure = [&](double v) {
    const long double truth = std::isnan(v) ? 0.0L : 255.0L * std::clamp((long double)v, 0.0L, 1.0L);
    trial.ours(std::fabs(to_byte(v) - truth), 0.5 + 0x1p-44, [&] { return fmt::format("{}", v); });
  };
  any.sweep(trial.rounds(20'000, 4'000'000), measure);
  for (int step = 0; step <= 510; ++step)  // whole steps and ties
    for (const double v :
         {step / 510.0, std::nextafter(step / 510.0, 2.0), std::nextafter(step / 510.0, -1.0)})
      measure(v);
}

// ---- Scenes in memory

Scene base_scene() {
  Scene scene = stage({{{0.3, 0.1, 1}, {-0.3, 0.2, 1}, {0, -0.3, 1}}});
  scene.materials[0].ambient = 0.1;
  scene.camera.near = 1.0;
  scene.camera.far = 100.0;
  add_side_lights(scene);
  return scene;
}

struct Number {
  std::string name;
  double* value;
};
std::vector<Number> numbers_of(Scene& scene) {
  std::vector<Number> all;
  const auto vector = [&](const std::string& name, glm::dvec3& v) {
    for (int i = 0; i < 3; ++i) all.push_back({fmt::format("{}.{}", name, "xyz"[i]), &v[i]});
  };
  vector("eye", scene.camera.eye_world);
  vector("target", scene.camera.target_world);
  vector("up", scene.camera.up_world);
  all.push_back({"fov", &scene.camera.vertical_fov_degrees});
  all.push_back({"near", &scene.camera.near});
  all.push_back({"far", &scene.camera.far});
  vector("ambient", scene.ambient);
  vector("background", scene.background);
  vector("to_light", scene.directional[0].to_light_world);
  vector("directional intensity", scene.directional[0].intensity);
  vector("position", scene.positional[0].position_world);
  vector("positional intensity", scene.positional[0].intensity);
  vector("spot position", scene.spots[0].position_world);
  vector("spot axis", scene.spots[0].axis_world);
  vector("spot intensity", scene.spots[0].intensity);
  all.push_back({"cos_inner", &scene.spots[0].cos_inner});
  all.push_back({"cos_outer", &scene.spots[0].cos_outer});
  Material& m = scene.materials[0];
  vector("colour", m.colour);
  vector("specular_colour", m.specular_colour);
  all.push_back({"k_a", &m.ambient});
  all.push_back({"k_d", &m.diffuse});
  all.push_back({"k_s", &m.specular});
  all.push_back({"exponent", &m.exponent});
  all.push_back({"roughness", &m.roughness});
  all.push_back({"reflectance", &m.reflectance});
  vector("vertex", scene.positions_world[1]);
  vector("normal", scene.normals_world[1]);
  return all;
}

// Calls f(scene, name) for the base scene with each number replaced by each value. A quick sweep uses every
// fourth value, others for the next number.
template <class F>
void with_each_number(const Trial& trial, std::span<const double> values, F&& f) {
  Scene counted = base_scene();
  const std::size_t count = numbers_of(counted).size();
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = 0; j < values.size(); ++j) {
      if (trial.quick() && (i + j) % 4 != 0) continue;
      Scene scene = base_scene();
      const Number number = numbers_of(scene)[i];
      *number.value = values[j];
      f(scene, fmt::format("{} {:g}", number.name, values[j]));
    }
}

constexpr FrameSize c_frame{33, 25};

struct ShaderAndPreset {
  Shader shader;
  Preset preset;
  PlanRequest plan() const {
    PlanRequest request{.shader = shader, .preset = preset, .all_effects = true};
    if (shader != Shader::quadratic) request.lights = 3;
    return request;
  }
  std::string name() const { return fmt::format("{}, {}", to_string(shader), to_string(preset)); }
};
constexpr ShaderAndPreset c_shaders_and_presets[] = {
    {Shader::spherical, Preset::exact},  {Shader::spherical, Preset::published},
    {Shader::quadratic, Preset::exact},  {Shader::quadratic, Preset::published},
    {Shader::processors, Preset::exact}, {Shader::processors, Preset::published}};

double outside(std::span<const Fragment> fragments) {
  return static_cast<double>(std::ranges::count_if(
      fragments, [](const Fragment& f) { return f.x >= c_frame.width || f.y >= c_frame.height; }));
}

// Runs setup and golden model without the plan's checks. Returns the number of fragments outside of the
// frame.
double fragments_outside(const Scene& scene, const HardwareKey& key) {
  std::vector<Fragment> fragments;
  make_golden_model(key)->draw(stream_of(*make_setup(scene, c_frame, key, {})).words(), fragments);
  return outside(fragments);
}

// The plan refuses the scene. If it is set up without the plan, it still stays in the frame.
void no_numbers(Trial& trial) {
  const Scene base = base_scene();
  for (const ShaderAndPreset& s : c_shaders_and_presets) {
    const auto plan = plan_scene(base, s.plan());
    trial.require(bool(plan), [&] { return plan.error().message; });
    if (!plan) continue;
    with_each_number(trial, c_no_numbers, [&](const Scene& scene, const std::string& name) {
      const auto where = [&] { return fmt::format("{}: {}", s.name(), name); };
      const auto refused = plan_scene(scene, s.plan());
      const bool well = !refused && refused.error().code == ExitCode::bad_input &&
                        refused.error().message.starts_with("stage: ");
      trial.check(well, where);
      trial.ours(fragments_outside(scene, plan->key), 0, where);
    });
  }
}

std::uint64_t left_out(const ProjectionCounts& c) {
  return c.back_facing + c.behind_near + c.outside + c.degenerate + c.unrepresentable;
}

// The scene is refused, or left out and counted, or drawn like the illumination model. Radiance above white
// is clamped and counted; the bound then does not apply.
void extremes(Trial& trial) {
  with_each_number(trial, c_extremes, [&](const Scene& scene, const std::string& name) {
    if (!check_numbers(scene)) {
      trial.check(true, [&] { return name; });
      return;
    }
    const ShaderAndPreset s = c_shaders_and_presets[0];
    const Drawing drawing = trial.draw(scene, {.plan = s.plan(), .frame = c_frame});
    if (drawing.fragments.empty()) {
      trial.check(left_out(drawing.counts.projection) > 0, [&] { return name + ": lost in silence"; });
      return;
    }
    const double bound = promised_steps(scene, drawing.key, 2.0);
    if (drawing.counts.overexposed > 0 || !std::isfinite(bound)) {
      trial.require(drawing.counts.overexposed > 0, [&] { return name + ": past white in silence"; });
      return;
    }
    const Truth truth(scene, c_frame);
    for (const Fragment& f : drawing.fragments)
      trial.ours(colour_error(f, truth.radiance_at(f.triangle, f.x, f.y)), bound,
                 [&] { return fmt::format("{}, pixel {}, {}", name, f.x, f.y); });
  });
}

// The other shaders and presets: accepted scenes stay in the frame, also in the RTL.
void extremes_elsewhere(Trial& trial) {
  int turn = 0;
  for (const ShaderAndPreset& s : std::span(c_shaders_and_presets).subspan(1))
    with_each_number(trial, c_extremes, [&](const Scene& scene, const std::string& name) {
      if (!check_numbers(scene)) return;
      const auto where = [&] { return fmt::format("{}: {}", s.name(), name); };
      const auto plan = plan_scene(scene, s.plan());
      if (!plan) {
        trial.check(plan.error().code == ExitCode::bad_input, where);
        return;
      }
      // Use the RTL in turns. Only the full sweep builds each shader.
      if (s.shader == Shader::spherical ? ++turn % 16 == 0 : !trial.quick() && ++turn % 8 == 0) {
        trial.ours(outside(trial.draw(scene, {.plan = s.plan(), .frame = c_frame}).fragments), 0, where);
        return;
      }
      trial.ours(fragments_outside(scene, plan->key), 0, where);
    });
}

// The reference picture with shadows; and the tree of its shadow rays, with bins for many triangles, compared
// with a test of every triangle.
void extremes_in_the_reference(Trial& trial) {
  with_each_number(trial, hostile_numbers(), [&](Scene& scene, const std::string& name) {
    scene.shadows = true;
    const auto triangles = Projector(scene, c_frame, {.subpixel_bits = 4}).project_all();
    const ReferenceImage image = render_reference(scene, triangles, {.frame = c_frame});
    std::size_t covered = 0, drawn = 0;
    for (const ScreenTriangle& t : triangles)
      for_each_covered(screen_points(t), 4, c_frame, [&](auto, auto) { ++covered; });
    for (const std::uint8_t there : image.mask) drawn += there;
    trial.check(covered == drawn, [&] { return name; });
  });
  RandomScenes random(32);
  for (const double value : hostile_numbers())
    for (int axis = 0; axis < 3; ++axis) {
      Scene scene;
      random.add_triangles(scene, 60, 0.5, 0.1);
      for (const std::size_t vertex : {0U, 1U, 5U, 60U}) scene.positions_world[vertex][axis] = value;
      for (std::size_t corner = 9; corner < 12; ++corner) scene.positions_world[corner][axis] = value;
      scene.directional.push_back({random.unit(), glm::dvec3(1.0)});
      const ShadowRays rays(scene);
      const LightPoint light = light_of(scene, {LightKind::directional, 0}).point;
      for (int i = 0; i < trial.rounds(10, 1000); ++i) {
        const LightRay ray(2.0 * random.cube(), light);
        const bool blocked = std::ranges::any_of(scene.triangles, [&](const SceneTriangle& t) {
          const CornersWorld corners = corners_world(scene, t);
          return ray.hit(corners, 1e-6).crossing == Crossing::enters;
        });
        trial.check(rays.is_blocked(ray, 1e-6) == blocked,
                    [&] { return fmt::format("a shadow ray among vertices with {:g}", value); });
      }
    }
}

// Every snapped vertex is within the guard band, with its depth in [0, 1] and in front of the eye. Triangles
// that are discarded before are counted.
void snapped(Trial& trial) {
  with_each_number(trial, hostile_numbers(), [&](const Scene& scene, const std::string& name) {
    for (const int bits : {0, 4, c_max_subpixel_bits})
      for (const bool to_frame : {false, true}) {
        ProjectionCounts counts;
        const auto pieces = Projector(scene, c_frame, {.subpixel_bits = bits, .clip_to_frame = to_frame})
                                .project_all(&counts);
        const auto where = [&] { return fmt::format("{}, {} subpixel bits", name, bits); };
        int wrong = counts.visible + left_out(counts) != 1;
        for (const ScreenTriangle& t : pieces)
          for (const ScreenVertex& v : t.vertex) {
            const auto inside = [&](std::int32_t c) {
              return c >= c_guard_begin * (1 << bits) && c <= c_guard_end * (1 << bits);
            };
            wrong += !inside(v.x) || !inside(v.y) || !(v.z >= 0.0 && v.z <= 1.0) || !(v.inverse_w > 0.0) ||
                     !std::isfinite(v.inverse_w);
          }
        trial.ours(wrong, 0, where);
      }
  });
}

// ---- Files

constexpr std::string_view c_words[] = {"nan",    "-nan",   "inf",   "+inf",   "-inf",
                                        "1e308",  "-1e308", "1e999", "-1e999", "1e-310",
                                        "5e-324", "-0.0",   "1e16",  "-1e16",  "1e15"};

constexpr std::string_view c_scene_file = R"(ambient = 0.2
background = [0.1, 0.2, 0.3]
[camera]
eye = [0.0, 0.5, 4.0]
target = [0.0, 0.1, 0.2]
up = [0.0, 1.0, 0.0]
fov = 40.0
near = 1.0
far = 50.0
[[directional]]
to_light = [0.3, 0.2, 1.0]
intensity = [0.4, 0.3, 0.2]
[[positional]]
position = [0.4, -0.3, 2.0]
intensity = 0.4
[[spot]]
position = [-0.5, 0.3, 2.5]
axis = [0.5, -0.2, -2.5]
inner = 10.0
outer = 20.0
[[material]]
name = "m"
colour = [0.9, 0.8, 0.7]
specular_colour = 0.5
k_a = 0.1
k_d = 0.6
k_s = 0.4
exponent = 20.0
roughness = 0.3
reflectance = 0.05
[[mesh]]
kind = "box"
size = [1.0, 1.5, 0.5]
material = "m"
scale = 1.5
rotate = { degrees = 30.0, axis = [0.0, 1.0, 0.3] }
translate = [0.1, 0.2, 0.3]
)";

// Calls f(text, what) for every number of the text, replaced by every word.
template <class F>
void with_each_word(std::string_view text, const std::regex& number, F&& f) {
  const std::string whole(text);
  for (auto it = std::sregex_iterator(whole.begin(), whole.end(), number); it != std::sregex_iterator();
       ++it) {
    const auto at = static_cast<std::size_t>(it->position());
    const auto line = 1 + std::count(whole.begin(), whole.begin() + it->position(), '\n');
    for (const std::string_view word : c_words)
      f(whole.substr(0, at) + std::string(word) + whole.substr(at + static_cast<std::size_t>(it->length())),
        fmt::format("line {}: {} for {}", line, word, it->str()));
  }
}

// The scene of a file is refused with file and line, or it can be drawn.
bool is_refused_or_sound(const std::filesystem::path& path, bool by_line) {
  const auto scene = load_scene(path.string(), path.parent_path());
  if (scene) return bool(check_numbers(*scene));
  const std::string& message = scene.error().message;
  if (scene.error().code != ExitCode::bad_input || message.find(path.string()) == std::string::npos)
    return false;
  if (!by_line) return true;
  static const std::regex c_line(R"(:[1-9]\d*: )");
  return std::regex_search(message, c_line);
}

void files_of(Trial& trial, const std::string& file_name, std::string_view text, const std::regex& number,
              bool by_line) {
  const auto folder = TemporaryFolder::make(trial.source() / "build");
  trial.require(bool(folder), [&] { return folder.error().message; });
  if (!folder) return;
  const std::filesystem::path path = folder->path() / file_name;
  const auto write = [&](const std::string& changed) { std::ofstream(path, std::ios::binary) << changed; };
  write(std::string(text));
  trial.require(bool(load_scene(path.string(), folder->path())),
                [&] { return file_name + ": the file itself is refused"; });
  with_each_word(text, number, [&](const std::string& changed, const std::string& what) {
    write(changed);
    trial.check(is_refused_or_sound(path, by_line), [&] { return file_name + ", " + what; });
  });
}

void scene_files(Trial& trial) {
  files_of(trial, "hostile.toml", c_scene_file, std::regex(R"(-?\d+\.\d+)"), true);
}

constexpr std::string_view c_obj = R"(v -1.0 -1.0 0.5
v 1.0 -1.0 0.5
v 0.0 1.0 0.5
v 0.0 1.5 -0.5
vn 0.0 0.1 1.0
vn 0.2 0.1 1.0
f 1//1 2//2 3//1
f 1//1 3//2 4//1
)";
constexpr std::string_view c_ply = R"(ply
format ascii 1.0
element vertex 4
property double x
property double y
property double z
property double nx
property double ny
property double nz
element face 2
property list uint int vertex_indices
end_header
-1.0 -1.0 0.5 0.0 0.1 1.0
1.0 -1.0 0.5 0.1 0.1 1.0
0.0 1.0 0.5 0.2 0.1 1.0
0.0 1.5 -0.5 0.3 0.1 1.0
3 0 1 2
3 0 2 3
)";
constexpr std::string_view c_stl = R"(solid s
facet normal 0.0 0.0 1.0
outer loop
vertex -1.0 -1.0 0.5
vertex 1.0 -1.0 0.5
vertex 0.0 1.0 0.5
endloop
endfacet
endsolid s
)";

void mesh_files(Trial& trial) {
  const std::regex number(R"(-?\d+\.\d+(?= |\n))");
  files_of(trial, "hostile.obj", c_obj, number, false);
  files_of(trial, "hostile.stl", c_stl, number, false);
  // The version in the header is not a number of the mesh.
  files_of(trial, "hostile.ply", c_ply, std::regex(R"(-?\d+\.\d+(?= |\n(?!element)))"), false);

  // Lengths of lists that exceed every double and every index.
  const auto folder = TemporaryFolder::make(trial.source() / "build");
  if (!folder) return;
  const std::filesystem::path path = folder->path() / "polygon.ply";
  for (const char* length : {"18446744073709551615", "18446744073709551614", "9223372036854775808",
                             "4294967296", "-1", "nan", "1e300", "0", "2"}) {
    std::string text(c_ply);
    text.replace(text.rfind("3 0 2 3"), 1, length);
    std::ofstream(path, std::ios::binary) << text;
    trial.check(is_refused_or_sound(path, false),
                [&] { return fmt::format("a polygon of {} corners", length); });
  }
}

constexpr HardCase c_cases[] = {
    {"sites", "All conversions of reals to integers", "a cast of a value that does not fit is undefined",
     "one function with a list of callers", "no other conversion in the sources", "conversions",
     PublishedForm::silent, sites},
    {"integers", "Any double to an integer", "a cast", "to_integer: clamped, 0 for NaN", "compared with GMP",
     "of 1", PublishedForm::silent, integers},
    {"words", "Fixed-point words of any real", "ldexp above every integer", "clamped, or modulo the word",
     "compared with GMP", "of 1", PublishedForm::silent, words},
    {"channels", "Channels of a picture", "255 v + 0.5", "0 and 255 by comparisons",
     "within half a step of 255 v", "steps", PublishedForm::silent, channels},
    {"snapped", "Snapped vertices", "x/w of any scene",
     "triangles whose coordinates overflow a double are omitted and counted",
     "inside the guard band, or counted", "vertices", PublishedForm::silent, snapped},
    {"no_numbers", "NaN and infinity in a scene", "NaN and infinity in a scene that no loader has checked",
     "the plan refuses the scene and names the field",
     "refused; the set-up without a plan draws only inside the frame", "scenes", PublishedForm::silent,
     no_numbers},
    {"extremes", "Extreme numbers in a scene",
     "±1.8·10³⁰⁸, denormals, −0 in a scene that no loader has checked", "refused, or omitted and counted",
     "otherwise the illumination model, within the threshold and the errors of fit and table", "colour steps",
     PublishedForm::silent, extremes},
    {"extremes_elsewhere", "Extreme numbers, other shaders", "the same", "the same", "inside the frame",
     "fragments", PublishedForm::silent, extremes_elsewhere},
    {"extremes_in_the_reference", "Extreme numbers, the reference picture",
     "NaN and the same: coordinates in the bounding volume hierarchy",
     "triangles with such coordinates are not in the hierarchy",
     "each covered pixel; shadows equal those without the hierarchy", "pictures and rays",
     PublishedForm::silent, extremes_in_the_reference},
    {"scene_files", "Numbers of a scene file", "nan, inf, 1e999, ±1e308 in a file",
     "refused with file and line", "refused, or a valid scene", "scenes", PublishedForm::silent, scene_files},
    {"mesh_files", "Numbers of a mesh file", "the same in OBJ, PLY and STL; polygons of 2⁶⁴ vertices",
     "refused with the file's name", "refused, or a valid scene", "scenes", PublishedForm::silent,
     mesh_files},
};

INSTANTIATE_TEST_SUITE_P(conversions, HardCases, testing::ValuesIn(c_cases), id_of);

}  // namespace

}  // namespace halfway::stability
