// SPDX-License-Identifier: Apache-2.0
// Numbers of a scene that setup rounds to words. Random scenes: each word is compared with its number. Each
// number is rounded once, by at most half a unit.
#include <fmt/format.h>

#include "golden/shading_token.hpp"
#include "plan/plan.hpp"
#include "registry.hpp"
#include "scene/test/random_scenes.hpp"
#include "setup/processors_setup.hpp"
#include "setup/spherical_setup.hpp"
#include "words/init_vector.hpp"

namespace halfway::bounds {
namespace {

using words::Exact, words::Published;

constexpr FrameSize c_small{64, 64};

// Four lights of each kind and one triangle. The eye is at (0, 0, 5), so that view space is world space with
// another origin.
Scene random_scene(int seed) {
  RandomScenes random(static_cast<unsigned>(seed));
  Scene scene;
  scene.ambient = random.colour(false);
  scene.materials = {random.material(false, false)};
  scene.materials[0].brdf = Brdf::blinn;
  for (const auto kind : {RandomScenes::directional, RandomScenes::positional, RandomScenes::spots})
    random.add_lights(scene, 4, kind, 1.0, false);
  scene.positions_world = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
  scene.normals_world = {{0, 0, 1}};
  scene.triangles = {{{0, 1, 2}, {0, 0, 0}, 0}};
  return scene;
}

// Compares words of `fraction` fraction bits with their numbers and keeps the worst.
struct Seen {
  Finding& finding;
  int fraction;
  void word(std::int64_t is, double number, std::string_view what) const {
    const double error = std::fabs(std::ldexp(static_cast<double>(is), -fraction) - number);
    keep_worst(finding, error, [&] { return fmt::format("{} of {:.12g}", what, number); });
  }
};

// The lights and words that setup makes from a scene for the processors.
template <class P>
struct SetupWords {
  std::vector<golden::ShadingLight> lights;  // 0: ambient
  words::ProcessorsConfig config;
  std::vector<std::uint32_t> draw;
};
template <class P>
SetupWords<P> setup_words(const Scene& scene) {
  constexpr Preset c_preset = std::is_same_v<P, Exact> ? Preset::exact : Preset::published;
  SetupWords<P> out;
  const auto plan = plan_scene(scene, {.shader = Shader::processors, .preset = c_preset});
  if (!plan) return out;
  out.config = processors_config(plan->key);
  const auto setup = make_processors_setup(scene, c_small, plan->key);
  const std::size_t words = (setup->init_bits() + 31) / 32;
  std::vector<std::uint32_t> prologue;
  SetupCounts counts;
  setup->append_prologue(prologue, counts);
  for (std::size_t at = words; at + words <= prologue.size(); at += words)  // after new_frame
    out.lights.push_back(
        golden::ShadingToken<P>::decode_light(out.config, std::span(prologue).subspan(at, words)));
  setup->append(0, out.draw, counts);
  return out;
}

template <class P, class See>
Finding over_scenes(const Context& context, const Stated& stated, See&& see) {
  Finding finding;
  const Seen seen{finding, stated.format.fraction_bits};
  for (int i = 0; i < (context.quick ? 40 : 2000); ++i) {
    const Scene scene = random_scene(i);
    const SetupWords<P> words = setup_words<P>(scene);
    if (words.lights.size() != 13) {
      finding.failure = "the set-up did not output the lights of the scene";
      return finding;
    }
    see(seen, scene, words);
  }
  finding.proved = stated.format.unit() / 2;  // one rounding
  return finding;
}

// Lights are in the order directional, positional, spots.
template <class P>
Finding light_intensity(const Context& context, const Stated& stated) {
  return over_scenes<P>(
      context, stated, [](const Seen& seen, const Scene& scene, const SetupWords<P>& words) {
        for (int c = 0; c < 3; ++c) {
          const auto channel = static_cast<std::size_t>(c);
          seen.word(words.lights[0].intensity[channel], 255 * scene.ambient[c], "an ambient light");
          for (std::size_t i = 0; i < 4; ++i)
            seen.word(words.lights[1 + i].intensity[channel], 255 * scene.directional[i].intensity[c],
                      "a light");
        }
      });
}

template <class P>
Finding light_place(const Context& context, const Stated& stated) {
  return over_scenes<P>(
      context, stated, [&](const Seen& seen, const Scene& scene, const SetupWords<P>& words) {
        for (std::size_t i = 0; i < 4; ++i) {
          const glm::dvec3 place = scene.positional[i].position_world - scene.camera.eye_world;
          // Setup chooses the power of two by which the largest component has the most bits.
          const golden::Axes& axes = words.lights[5 + i].place;
          int largest = 0;
          for (int axis = 1; axis < 3; ++axis)
            if (std::fabs(place[axis]) > std::fabs(place[largest])) largest = axis;
          const double word = std::ldexp(static_cast<double>(axes[static_cast<std::size_t>(largest)]),
                                         -stated.format.fraction_bits);
          const double scale = std::exp2(std::round(std::log2(word / place[largest])));
          for (int axis = 0; axis < 3; ++axis)
            seen.word(axes[static_cast<std::size_t>(axis)], scale * place[axis], "a light's place");
        }
      });
}

template <class P>
Finding spot_slope(const Context& context, const Stated& stated) {
  const bool share = stated.bound.of == "share";
  Finding finding =
      over_scenes<P>(context, stated, [&](const Seen& seen, const Scene& scene, const SetupWords<P>& words) {
        for (std::size_t i = 0; i < 4; ++i) {
          const double slope = 1 / (scene.spots[i].cos_inner - scene.spots[i].cos_outer);
          if (!share) {
            seen.word(words.lights[9 + i].slope, slope, "a slope");
            continue;
          }
          // The cubic at two thirds of the cone's edge, by the word and by the number.
          const auto cubic = [](double t) { return t * t * (3 - 2 * t); };
          const double is = std::ldexp(words.lights[9 + i].slope, -stated.format.fraction_bits), t = 2.0 / 3;
          keep_worst(seen.finding, std::fabs(cubic(std::min(1.0, t * is / slope)) - cubic(t)),
                     [&] { return fmt::format("a slope of {:.9f}, two thirds into its edge", slope); });
        }
      });
  if (share) {
    // The smallest slopes, next to the middle between two words.
    for (int word = 32; word < 40; ++word) {
      const double slope = (word + 0.5 - 1e-9) * stated.format.unit(), is = word * stated.format.unit(),
                   t = 2.0 / 3;
      const auto cubic = [](double x) { return x * x * (3 - 2 * x); };
      const double error = std::fabs(cubic(t * is / slope) - cubic(t));
      keep_worst(finding, error,
                 [&] { return fmt::format("a slope of {:.9f}, two thirds into its edge", slope); });
    }
    finding.proved = 0;
  }
  return finding;
}

template <class P>
Finding coefficient(const Context& context, const Stated& stated) {
  return over_scenes<P>(
      context, stated, [](const Seen& seen, const Scene& scene, const SetupWords<P>& words) {
        const words::ProcessorsLayout<P> layout(words.config);
        const Material& m = scene.materials[0];
        const auto word = [&](int low) {
          return static_cast<std::int64_t>(words::get_bits(
              words.draw, {"", 0, P::c_coefficient_bits, false, 0}, layout.init_material_low() + low));
        };
        for (int c = 0; c < 3; ++c) {
          seen.word(word(layout.ambient_low(c)), m.ambient * m.colour[c], "a k_a");
          seen.word(word(layout.diffuse_low(c)), m.diffuse * m.colour[c], "a k_d");
          seen.word(word(layout.specular_low(c)), m.specular * m.specular_colour[c], "a k_s");
        }
      });
}

template <class P>
Finding exponent(const Context& context, const Stated& stated) {
  if (stated.bound.of == "highlight") {
    // The slope of x^n is steepest at x = 1/e^(1/n). Start at the smallest exponent, next to the middle
    // between two words.
    Finding finding;
    for (double n = 1; n < 4; n += stated.format.unit()) {
      const double word = n, real = n + stated.format.unit() / 2 - 1e-9, x = std::exp(-1 / real);
      const double error = std::fabs(std::pow(x, word) - std::pow(x, real));
      keep_worst(finding, error,
                 [&] { return fmt::format("an exponent of {:.9f} at a cosine of {:.6f}", real, x); });
    }
    return finding;
  }
  return over_scenes<P>(
      context, stated, [](const Seen& seen, const Scene& scene, const SetupWords<P>& words) {
        const words::ProcessorsLayout<P> layout(words.config);
        const auto word =
            static_cast<std::int64_t>(words::get_bits(words.draw, {"", 0, P::c_exponent_bits, false, 0},
                                                      layout.init_material_low() + layout.exponent_low()));
        seen.word(word, scene.materials[0].exponent, "an exponent");
      });
}

// The value of a plane plus half a step of vector, cut to a vector, as in processors_shader.
template <class P>
Finding vector(const Context&, const Stated& stated) {
  constexpr int c_drop = P::c_plane_sum_fraction_bits - P::c_vector_fraction_bits;
  Finding finding;
  const Seen seen{finding, stated.format.fraction_bits};
  for (std::int64_t value = -(std::int64_t{1} << c_drop); value <= std::int64_t{1} << c_drop; ++value)
    seen.word((value + half(c_drop)) >> c_drop,
              std::ldexp(static_cast<double>(value), -P::c_plane_sum_fraction_bits), "a plane's value");
  finding.proved = finding.worst;
  return finding;
}

template <class P>
Finding factor(const Context& context, const Stated& stated) {
  constexpr Preset c_preset = std::is_same_v<P, Exact> ? Preset::exact : Preset::published;
  Finding finding;
  const Seen seen{finding, stated.format.fraction_bits};
  for (int i = 0; i < (context.quick ? 40 : 300); ++i) {
    const Scene scene = random_scene(i);
    const auto plan = plan_scene(scene, {.shader = Shader::spherical, .preset = c_preset});
    if (!plan) {
      finding.failure = plan.error().message;
      return finding;
    }
    const SphericalSetup setup(scene, c_small, plan->key, {});
    std::vector<std::uint32_t> words;
    SetupCounts counts;
    setup.append(0, words, counts);
    const words::SphericalLayout<P> layout(golden_config(plan->key));
    const Material& m = scene.materials[0];
    for (int c = 0; c < 3; ++c)
      seen.word(static_cast<std::int64_t>(
                    words::get_bits(words, P::ambient_channel_at::ambient, layout.ambient_low(c))),
                255 * scene.ambient[c] * m.ambient * m.colour[c] + 0.5, "an ambient factor");
  }
  finding.proved = stated.format.unit() / 2;
  return finding;
}

}  // namespace

std::vector<Check> setup_checks() {
  constexpr std::string_view c_scenes = "random scenes through setup; a rounding leaves half a unit";
  return {
      {"both", "light_intensity", "", c_scenes,
       of_preset(light_intensity<Exact>, light_intensity<Published>)},
      {"both", "light_place", "", c_scenes, of_preset(light_place<Exact>, light_place<Published>)},
      {"both", "spot_slope", "", c_scenes, of_preset(spot_slope<Exact>, spot_slope<Published>)},
      {"both", "spot_slope", "share", "derivation; the least slopes",
       of_preset(spot_slope<Exact>, spot_slope<Published>)},
      {"both", "coefficient", "", c_scenes, of_preset(coefficient<Exact>, coefficient<Published>)},
      {"both", "exponent", "", c_scenes, of_preset(exponent<Exact>, exponent<Published>)},
      {"both", "exponent", "highlight", "derivation; the least exponents",
       of_preset(exponent<Exact>, exponent<Published>)},
      {"both", "vector", "", "every fraction that is cut", of_preset(vector<Exact>, vector<Published>)},
      {"both", "factor", "", c_scenes, of_preset(factor<Exact>, factor<Published>)},
  };
}

}  // namespace halfway::bounds
