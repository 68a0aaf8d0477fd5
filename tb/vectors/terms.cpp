// SPDX-License-Identifier: Apache-2.0
// The steps of a term of the shading processors.
#include <fmt/format.h>

#include "golden/cosine_power.hpp"
#include "golden/half_vector.hpp"
#include "golden/light_vector.hpp"
#include "golden/light_weight.hpp"
#include "golden/radiance_sum.hpp"
#include "golden/reflected_term.hpp"
#include "vectors/axes.hpp"
#include "vectors/entities.hpp"
#include "vectors/pipeline.hpp"
#include "vectors/random.hpp"

namespace halfway::vectors {
namespace {

using golden::Axes, words::Exact, words::Published;

// Number of points for which a light is constant; number of lights.
constexpr int c_points = 100, c_term_lights = 40;

// add(first of a light)
template <class Add>
void run_lights(const Add& add) {
  for (int light = 0; light < c_term_lights; ++light)
    for (int point = 0; point < c_points; ++point) add(point == 0);
}

template <class Preset>
constexpr int c_unit_latency = Preset::c_light_shift_bits > 0 ? 15 : 7;
template <class Preset>
constexpr int c_shift_bits = std::max(1, Preset::c_light_shift_bits);

std::uint32_t unsigned_word(Random& random, int bits) {
  return static_cast<std::uint32_t>(random.word(bits));
}

// Inputs: positional, place, shift, point, distance. `can`: the light may be positional.
template <class Preset>
void write_light_vector_of(const Folder& folder, bool can) {
  constexpr bool c_exact = Preset::c_light_shift_bits > 0;
  Random random(Preset::c_light_place_bits + can);
  Pipeline pipeline(can ? 1 + 2 * c_exact + c_unit_latency<Preset> : 0);
  bool positional = false;
  Axes place{};
  std::uint32_t shift = 0;
  run_lights([&](bool first) {
    if (first) {
      positional = random.one_in(2);
      place = random_axes(random, Preset::c_light_place_bits);
      if (c_exact) shift = random.one_in(2) ? 0 : static_cast<std::uint32_t>(random.bits(5));
      pipeline.restart();
    }
    const Axes point = random_axes(random, Preset::c_vector_bits);
    // Often 0: L is then as short as P, and the lowest bits of P count.
    const std::int64_t distance =
        c_exact && !random.one_in(4) ? static_cast<std::int64_t>(random.word(Preset::c_vector_bits - 1)) : 0;
    pipeline.clock({{positional, 1},
                    flat(place, Preset::c_light_place_bits),
                    {shift, c_shift_bits<Preset>},
                    flat(point, Preset::c_vector_bits),
                    {static_cast<std::uint64_t>(distance), Preset::c_vector_bits}},
                   flat(golden::light_vector<Preset>(can && positional, place, shift, point, distance),
                        Preset::c_direction_bits));
  });
  pipeline.write(folder / fmt::format("{}_{:d}.txt", Preset::c_name, can));
}

// Inputs: positional, to_light, to_eye. `depends`: H depends on the point.
template <class Preset>
void write_half_vector_of(const Folder& folder, bool depends) {
  constexpr bool c_exact = Preset::c_light_shift_bits > 0;
  constexpr int c_light_bits = c_exact ? Preset::c_direction_bits : Preset::c_offset_bits;
  Random random(c_light_bits + depends);
  Pipeline pipeline(depends ? 1 + c_unit_latency<Preset> : 0);
  bool positional = false;
  Axes to_eye{};
  run_lights([&](bool first) {
    auto [a, b] = random_directions<Preset>(random);
    if (first || c_exact) to_eye = b;
    if (first) {
      positional = random.one_in(2);
      pipeline.restart();
    }
    if (!c_exact) a = random_axes(random, c_light_bits);
    const bool sum = depends && (c_exact || positional);
    pipeline.clock({{positional, 1}, flat(a, c_light_bits), flat(to_eye, Preset::c_direction_bits)},
                   flat(sum ? golden::half_vector<Preset>(a, to_eye) : to_eye, Preset::c_direction_bits));
  });
  pipeline.write(folder / fmt::format("{}_{:d}.txt", Preset::c_name, depends));
}

// Inputs: normal, direction, exponent.
template <class Preset>
void write_cosine_power_of(const Folder& folder, bool highlight) {
  constexpr bool c_exact = Preset::c_light_shift_bits > 0;
  Random random(Preset::c_exponent_bits + highlight);
  Pipeline pipeline((c_exact ? 3 : 2) + (!highlight ? 1 : c_exact ? 11 : 7));
  run(random, [&](bool) {
    const auto [normal, direction] = random_directions<Preset>(random);
    const std::uint32_t exponent = unsigned_word(random, Preset::c_exponent_bits);
    const std::uint32_t result = highlight ? golden::cosine_power<Preset>(normal, direction, exponent)
                                           : golden::cosine_weight<Preset>(normal, direction);
    pipeline.clock({flat(normal, Preset::c_direction_bits),
                    flat(direction, Preset::c_direction_bits),
                    {exponent, Preset::c_exponent_bits}},
                   {result, Preset::c_weight_bits});
  });
  pipeline.write(folder / fmt::format("{}_{:d}.txt", Preset::c_name, highlight));
}

// Inputs: spot, axis, outer, slope, to_light, cosine. The cosine follows to_light after `lead` clocks.
template <class Preset>
void write_light_weight_of(const Folder& folder, int lead) {
  Random random(Preset::c_spot_slope_bits + lead);
  Pipeline pipeline(std::max(Preset::c_light_shift_bits > 0 ? 11 : 10, lead) + 1);
  bool spot = false;
  Axes axis{};
  std::int64_t outer = 0;
  std::uint32_t slope = 0;
  run_lights([&](bool first) {
    auto [to_light, from_light] = random_directions<Preset>(random);
    if (first) {
      spot = !random.one_in(4);
      axis = from_light;
      for (std::int64_t& component : axis) component = ~component;
      outer = static_cast<std::int64_t>(random.bits(Preset::c_direction_fraction_bits));
      slope = static_cast<std::uint32_t>(random.bits(10));
      pipeline.restart();
    }
    // Mostly points within the cone.
    if (!random.one_in(3))
      for (std::size_t i = 0; i < axis.size(); ++i)
        to_light[i] = std::clamp(
            ~axis[i] + random.between(-1, 1) * (std::int64_t{1} << (Preset::c_direction_fraction_bits - 3)),
            -(std::int64_t{1} << (Preset::c_direction_bits - 1)),
            (std::int64_t{1} << (Preset::c_direction_bits - 1)) - 1);
    const auto cosine =
        static_cast<std::uint32_t>(random.between(0, std::int64_t{1} << Preset::c_weight_fraction_bits));
    const std::uint32_t weight =
        spot ? golden::light_weight<Preset>(cosine, to_light, axis, outer, slope) : cosine;
    pipeline.clock({{spot, 1},
                    flat(axis, Preset::c_direction_bits),
                    {static_cast<std::uint64_t>(outer), Preset::c_direction_bits},
                    {slope, Preset::c_spot_slope_bits},
                    flat(to_light, Preset::c_direction_bits),
                    {cosine, Preset::c_weight_bits}},
                   {weight, Preset::c_weight_bits});
  });
  pipeline.write(folder / fmt::format("{}_{}.txt", Preset::c_name, lead));
}

// Inputs: coefficients, intensities, weight. The weight follows when k I is rounded.
template <class Preset>
void write_reflected_term_of(const Folder& folder, int channels, bool weighted) {
  constexpr int c_multiply = Preset::c_light_shift_bits > 0 ? 2 : 1;
  Random random(Preset::c_coefficient_bits + channels);
  Pipeline pipeline(c_multiply + 1 + weighted * c_multiply);
  golden::Axes intensities{};
  run_lights([&](bool first) {
    if (first) {
      for (std::int64_t& intensity : intensities)
        intensity = unsigned_word(random, Preset::c_light_intensity_bits);
      pipeline.restart();
    }
    const auto weight =
        weighted
            ? static_cast<std::uint32_t>(random.between(0, std::int64_t{1} << Preset::c_weight_fraction_bits))
            : golden::c_full_weight<Preset>;
    Flat k, i, terms;
    for (int c = 0; c < channels; ++c) {
      const std::uint32_t coefficient = unsigned_word(random, Preset::c_coefficient_bits);
      const auto intensity = static_cast<std::uint32_t>(intensities[c]);
      k.add(coefficient, Preset::c_coefficient_bits);
      i.add(intensity, Preset::c_light_intensity_bits);
      terms.add(golden::reflected_term<Preset>(coefficient, intensity, weight),
                Preset::c_reflected_bits + Preset::c_weight_bits);
    }
    pipeline.clock({k, i, {weight, Preset::c_weight_bits}}, terms);
  });
  pipeline.write(folder / fmt::format("{}_{}_{:d}.txt", Preset::c_name, channels, weighted));
}

// Inputs: add, radiance, terms.
template <class Preset>
void write_radiance_sum_of(const Folder& folder, int channels) {
  constexpr int c_term_bits = Preset::c_reflected_bits + Preset::c_weight_bits;
  Random random(Preset::c_radiance_bits + channels);
  Pipeline pipeline(1);
  run(random, [&](bool enable) {
    const bool add = !random.one_in(4);
    Flat radiance, terms, result;
    for (int c = 0; c < channels; ++c) {
      const std::uint32_t before = unsigned_word(random, Preset::c_radiance_bits);
      const std::uint64_t term = random.word(c_term_bits) >> (random.one_in(2) ? 4 : 0);
      radiance.add(before, Preset::c_radiance_bits);
      terms.add(term, c_term_bits);
      result.add(add ? golden::radiance_sum<Preset>(before, term) : before, Preset::c_radiance_bits);
    }
    pipeline.clock(enable, {{add, 1}, radiance, terms}, result);
  });
  pipeline.write(folder / fmt::format("{}_{}.txt", Preset::c_name, channels));
}

}  // namespace

std::vector<Entity> terms_entities() {
  return {
      {"light_vector", in_both_presets([]<class P>(const Folder& f) {
         for (const bool can : {false, true}) write_light_vector_of<P>(f, can);
       })},
      {"half_vector", in_both_presets([]<class P>(const Folder& f) {
         for (const bool depends : {false, true}) write_half_vector_of<P>(f, depends);
       })},
      {"cosine_power", in_both_presets([]<class P>(const Folder& f) {
         for (const bool highlight : {false, true}) write_cosine_power_of<P>(f, highlight);
       })},
      // Diffuse, where the factor of the cone is ready last, and specular.
      {"light_weight", in_both_presets([]<class P>(const Folder& f) {
         for (const int lead : {2, 16}) write_light_weight_of<P>(f, lead);
       })},
      {"reflected_term", in_both_presets([]<class P>(const Folder& f) {
         for (const bool weighted : {false, true})
           for (const int channels : {1, 3}) write_reflected_term_of<P>(f, channels, weighted);
       })},
      {"radiance_sum", in_both_presets([]<class P>(const Folder& f) {
         for (const int channels : {1, 3}) write_radiance_sum_of<P>(f, channels);
       })},
  };
}

}  // namespace halfway::vectors
