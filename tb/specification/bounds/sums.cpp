// SPDX-License-Identifier: Apache-2.0
// Sums of terms and stored results. Products are exact. Each term of the processors is cut once. Output
// colour and depth are rounded once.
#include <fmt/format.h>

#include <random>

#include "golden/saturate.hpp"
#include "golden/saturating_sum.hpp"
#include "golden/shading_processor.hpp"
#include "registry.hpp"

namespace halfway::bounds {
namespace {

using words::Exact, words::Published;

Finding colour_range(const Context&, const Stated&) {
  golden::SaturatingSum sum;
  for (int i = 0; i < 33; ++i) sum.add(~std::uint64_t{0} >> 8);
  using Value = words::Word<Exact::c_intensity_bits>;
  const std::uint32_t most = std::max(
      sum.result(16, Exact::c_colour_bits),
      golden::saturate<Exact::c_intensity_bits, Exact::c_intensity_fraction_bits, Exact::c_colour_bits>(
          Value::from_bits(~std::uint64_t{0} >> (65 - Exact::c_intensity_bits))));
  return {.worst = double(most),
          .where = "the largest sum and the largest value, clamped",
          .proved = double(most)};
}

// The half step that setup adds to the value, and the cut of the result: every fraction of preset published;
// in preset exact the fractions next to both halves.
Finding colour_rounded(const Context&, const Stated&) {
  constexpr int c_bits = Published::c_intensity_bits, c_fraction = Published::c_intensity_fraction_bits;
  Finding finding;
  for (std::int64_t value = 0; value <= std::int64_t{2} << c_fraction; ++value) {
    const std::int64_t with_half = value + (std::int64_t{1} << (c_fraction - 1));
    const double error =
        std::fabs(double(golden::saturate<c_bits, c_fraction, Published::c_colour_bits>(
                      words::Word<c_bits>::from_bits(static_cast<std::uint64_t>(with_half)))) -
                  std::ldexp(static_cast<double>(value), -c_fraction));
    keep_worst(finding, error, [&] {
      return fmt::format("a value of {:.7f}", std::ldexp(static_cast<double>(value), -c_fraction));
    });
  }
  finding.proved = finding.worst;
  return finding;
}

// Setup keeps depths one step away from both ends, so that depth plus half a step stays in the format.
Finding depth_range(const Context&, const Stated& stated) {
  const double most = std::ldexp(1.0, stated.format.integer_bits) - 1;
  return {.worst = most - 1,
          .where = "the far plane, clamped to one step below the end, plus half a step and an error of 0.19",
          .proved = most};
}

Finding depth_rounded(const Context&, const Stated&) {
  constexpr int c_fraction = Exact::c_depth_sum_fraction_bits;
  Finding finding;
  for (std::int64_t value = 0; value <= std::int64_t{2} << c_fraction; ++value) {
    const std::int64_t whole = (value + (std::int64_t{1} << (c_fraction - 1))) >> c_fraction;
    const double error = std::fabs(double(whole) - std::ldexp(double(value), -c_fraction));
    keep_worst(finding, error,
               [&] { return fmt::format("a depth of {:.6f}", std::ldexp(double(value), -c_fraction)); });
  }
  finding.proved = finding.worst;
  return finding;
}

// k I with the processor's own rounding: an ambient term, with weight 1, over random k and I. All bits of the
// term are visible, since radiance has at least as many fraction bits.
template <class P>
Finding reflected(const Context&, const Stated& stated) {
  static_assert(P::c_radiance_fraction_bits >= P::c_reflected_fraction_bits);
  const words::ProcessorsConfig config{
      .channels = 1, .diffuse = false, .specular = false, .normalize = false};
  golden::ShadingProcessor<P> processor(config, words::Term::ambient, 0);
  std::mt19937_64 random(9);
  Finding finding;
  for (int i = 0; i < 300'000; ++i) {
    golden::ShadingToken<P> light;
    light.command = words::Command::define;
    light.light.intensity[0] =
        static_cast<std::uint32_t>(random() % (255ULL << P::c_light_intensity_fraction_bits));
    processor.process(light);
    golden::ShadingToken<P> token;
    token.ambient[0] =
        static_cast<std::uint32_t>(random() % (std::uint64_t{1} << P::c_coefficient_fraction_bits));
    processor.process(token);
    const double exact = std::ldexp(double(light.light.intensity[0]) * double(token.ambient[0]),
                                    -P::c_light_intensity_fraction_bits - P::c_coefficient_fraction_bits);
    const double term = double(token.radiance[0]) - double(token.c_first_radiance);
    const double error = std::fabs(std::ldexp(term, -P::c_radiance_fraction_bits) - exact);
    keep_worst(finding, error, [&] {
      return fmt::format("k {}, I {} in units", token.ambient[0], light.light.intensity[0]);
    });
  }
  finding.proved = stated.format.unit() / 2;
  return finding;
}

// Each term's product is cut, except the ambient one's, with weight 1. Uses sixteen lights with the greatest
// cut of the diffuse and specular terms: odd weights w, and reflected lights r with r w = -1 modulo a unit.
template <class P>
Finding radiance(const Context&, const Stated& stated) {
  constexpr int c_cut =
      P::c_reflected_fraction_bits + P::c_weight_fraction_bits - P::c_radiance_fraction_bits;
  constexpr int c_fraction = P::c_direction_fraction_bits, c_lights = 16;
  constexpr std::uint32_t c_exponent = 1U << P::c_exponent_fraction_bits;
  const golden::Axes normal = {std::int64_t{1} << c_fraction, 0, 0};
  const auto inverse = [](std::uint32_t w) {
    std::uint32_t r = 1;
    while (((std::uint64_t{r} * w + 1) & ((1ULL << c_cut) - 1)) != 0) ++r;
    return r;
  };
  // L = V, so that H = L = V. Chooses the angle with the least light, to stay far from the clamp.
  struct Chosen {
    golden::Axes to_light{};
    std::uint32_t diffuse = 0, specular = 0;                    // weights
    std::uint32_t diffuse_light = 4096, specular_light = 4096;  // r
  } best;
  for (int i = 1; i < 4000; ++i) {
    const double c = 1 - i / 8000.0;
    const golden::Axes to_light = {std::llround(std::ldexp(c, c_fraction)),
                                   std::llround(std::ldexp(std::sqrt(1 - c * c), c_fraction)), 0};
    golden::Axes half = to_light;
    if constexpr (std::is_same_v<P, Exact>) {
      for (std::int64_t& component : half) component *= 2;
      half = golden::normalized<P, P::c_direction_bits + 1>(half);
    }
    Chosen next{to_light};
    next.diffuse = static_cast<std::uint32_t>(
        golden::round_half_up(golden::cosine<P>(golden::dot_product(normal, to_light)),
                              P::c_direction_fraction_bits - P::c_weight_fraction_bits));
    next.specular = golden::Power<P>::power(golden::cosine<P>(golden::dot_product(normal, half)), c_exponent);
    if (next.diffuse % 2 == 0 || next.specular % 2 == 0) continue;
    next.diffuse_light = inverse(next.diffuse);
    next.specular_light = inverse(next.specular);
    if (next.diffuse_light + next.specular_light < best.diffuse_light + best.specular_light) best = next;
  }
  // k I: in preset exact I is one colour step, in preset published k is 1.
  constexpr int c_product =
      P::c_coefficient_fraction_bits + P::c_light_intensity_fraction_bits - P::c_reflected_fraction_bits;
  constexpr bool c_exact = std::is_same_v<P, Exact>;
  const auto k_of = [](std::uint32_t r) {
    return c_exact ? r << (c_product - P::c_light_intensity_fraction_bits) : 1U << c_product;
  };
  const words::ProcessorsConfig config{.channels = 1, .directional = c_lights, .normalize = false};
  double exact = 0;
  golden::ShadingToken<P> token;
  token.normal = {std::int64_t{1} << P::c_vector_fraction_bits, 0, 0};
  token.exponent = c_exponent;
  golden::ShadingProcessor<P>(config, words::Term::ambient, 0).process(token);
  token.view = best.to_light;
  token.radiance = {};
  for (int light = 1; light <= c_lights; ++light)
    for (const bool diffuse : {true, false}) {
      const std::uint32_t r = diffuse ? best.diffuse_light : best.specular_light;
      golden::ShadingProcessor<P> processor(config, diffuse ? words::Term::diffuse : words::Term::specular,
                                            light);
      golden::ShadingToken<P> load;
      load.command = words::Command::define;
      load.light_number = static_cast<std::uint32_t>(light);
      load.light.intensity[0] = c_exact ? 1U << P::c_light_intensity_fraction_bits : r;
      for (std::size_t axis = 0; axis < 3; ++axis)
        load.light.place[axis] = best.to_light[axis] << (P::c_light_place_fraction_bits - c_fraction);
      load.light.half = best.to_light;
      processor.process(load);
      token.diffuse[0] = token.specular[0] = k_of(r);
      processor.process(token);
      exact += std::ldexp(double(r) * (diffuse ? best.diffuse : best.specular),
                          -P::c_reflected_fraction_bits - P::c_weight_fraction_bits);
    }
  Finding finding;
  finding.worst = exact - std::ldexp(double(token.radiance[0]), -P::c_radiance_fraction_bits);
  finding.where = fmt::format("16 lights at a cosine of {} units, k I {} and {} units", best.to_light[0],
                              best.diffuse_light, best.specular_light);
  finding.proved = 2 * c_lights * stated.format.unit();
  return finding;
}

}  // namespace

std::vector<Check> sum_checks() {
  return {
      {"both", "colour", "", "the golden sums, clamped", colour_range},
      {"both", "colour", "rounded", "every fraction of preset published", colour_rounded},
      {"both", "depth", "", "the program's own limits", depth_range},
      {"both", "depth", "rounded", "every fraction", depth_rounded},
      {"both", "reflected", "", "random k and I by the golden processor",
       of_preset(reflected<Exact>, reflected<Published>)},
      {"both", "radiance", "", "16 lights by the golden processors",
       of_preset(radiance<Exact>, radiance<Published>)},
  };
}

}  // namespace halfway::bounds
