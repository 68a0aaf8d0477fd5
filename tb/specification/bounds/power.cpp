// SPDX-License-Identifier: Apache-2.0
// base^m by tables of log2 and 2^-x, for every exponent m; and the factor of a spot's cone.
//
// With t = -log2(base) the hardware computes t + a, with an error a of its table. It multiplies by m, cuts
// the product to units of 2^-20, and looks up 2^-x in its table, shifted and rounded. The error of preset
// exact is bounded for every base and every m, over parts of the logarithm, with the least and greatest a of
// each part, and over short ranges of m. The power decreases by at most
//  2^-mt (1 - 2^-ma),
// and increases likewise. The error of the steps after the product is known for every x.
#include "golden/power.hpp"

#include <fmt/format.h>

#include <random>

#include "golden/spot_cone.hpp"
#include "registry.hpp"

namespace halfway::bounds {
namespace {

using words::Exact, golden::Power, words::Published, golden::SpotCone;

template <class P>
double power_error(std::uint32_t base, std::uint32_t exponent) {
  const long double c = std::ldexp(static_cast<long double>(base), -Power<P>::c_base_fraction),
                    m = std::ldexp(static_cast<long double>(exponent), -P::c_exponent_fraction_bits);
  return static_cast<double>(
      std::ldexp(static_cast<long double>(Power<P>::power(base, exponent)), -P::c_weight_fraction_bits) -
      std::pow(c, m));
}

struct Range {
  double low = 0, high = 0;
  void add(double v) { low = std::min(low, v), high = std::max(high, v); }
  double most() const { return std::max(-low, high); }
};

// Error of the golden model's -log2 for every base from 1/2 to 1, by equal parts. Bases with more leading
// zeros have the same mantissas, or fewer.
constexpr int c_group_bits = 15;
std::vector<Range> logarithm_errors() {
  constexpr std::uint32_t c_half = Power<Exact>::c_one / 2;
  std::vector<Range> errors(std::size_t{1} << c_group_bits);
  for (std::uint32_t i = 0; i < c_half; ++i)
    errors[i >> (Power<Exact>::c_base_fraction - 1 - c_group_bits)].add(
        std::ldexp(Power<Exact>::loss(c_half + i), -Power<Exact>::c_loss_fraction) +
        std::log2(std::ldexp(c_half + i, -Power<Exact>::c_base_fraction)));
  return errors;
}

// Error of the golden model's 2^-x for all arguments from x on: for every word of [0, 1), by equal parts; and
// above 1, where the value and so the error is smaller, except for rounding.
constexpr int c_decay_part_bits = 10;
struct DecayErrors {
  std::vector<Range> from;  // for all x from the start of the part on
  Range from_one;
};
DecayErrors decay_errors(std::uint64_t stride_past_one) {
  constexpr int c_fraction = Power<Exact>::c_decay_fraction;
  const auto error = [](std::uint64_t x) {
    return std::ldexp(Power<Exact>::decayed(x), -Exact::c_weight_fraction_bits) -
           std::exp2(-std::ldexp(static_cast<double>(x), -c_fraction));
  };
  DecayErrors errors{std::vector<Range>(std::size_t{1} << c_decay_part_bits), {}};
  // From 20 on, the value is below an eighth of a weight's unit.
  for (std::uint64_t x = std::uint64_t{1} << c_fraction; x < std::uint64_t{20} << c_fraction;
       x += stride_past_one)
    errors.from_one.add(error(x));
  for (std::uint64_t x = 0; x < std::uint64_t{1} << c_fraction; ++x)
    errors.from[x >> (c_fraction - c_decay_part_bits)].add(error(x));
  Range so_far = errors.from_one;
  for (std::size_t part = errors.from.size(); part-- > 0;) {
    so_far.add(errors.from[part].low);
    so_far.add(errors.from[part].high);
    errors.from[part] = so_far;
  }
  return errors;
}

// The greatest ratio of the possible error to the stated error, over all m and all bases.
double exact_ratio(bool quick) {
  const std::vector<Range> logarithm = logarithm_errors();
  const DecayErrors decay = decay_errors(quick ? 101 : 1);
  const auto parts = static_cast<double>(logarithm.size());
  const double cut = std::ldexp(1.0, -Power<Exact>::c_decay_fraction);  // of the product
  double most = 0;
  constexpr double c_slack = 1e-13, c_ln2 = std::numbers::ln2;  // of doubles
  for (double m = 0; m < 8192;) {
    const double next = std::max(m + 1.0 / 16, m * 1.005);
    const double stated = std::ldexp(1.0, -15) + m * std::ldexp(1.0, -23);
    for (std::size_t part = logarithm.size(); part-- > 0;) {
      // Use the greatest base of the part: it has the least loss. A base with more leading zeros has a
      // greater loss and a smaller power.
      const double least_loss = 1 - std::log2(1 + (static_cast<double>(part) + 1) / parts);
      const double peak = std::exp2(-m * least_loss);
      // A greater loss gives a smaller power; the cut of the product increases it again.
      const double down = peak * -std::expm1(-c_ln2 * next * logarithm[part].high),
                   up = peak * std::expm1(c_ln2 * (next * -logarithm[part].low + cut));
      const double x = std::max(0.0, m * (least_loss + logarithm[part].low) - cut);
      const Range behind =
          x < 1 ? decay.from[static_cast<std::size_t>(std::ldexp(x, c_decay_part_bits))] : decay.from_one;
      most = std::max(most, (std::max(up + behind.high, down - behind.low) + c_slack) / stated);
      if (x > 24) break;
    }
    m = next;
  }
  return most;
}

template <class P>
Finding power(const Context& context, const Stated& stated) {
  constexpr std::uint32_t c_one = Power<P>::c_one, c_largest = (1U << P::c_exponent_bits) - 1;
  constexpr bool c_exact = std::is_same_v<P, Exact>;
  Finding finding;
  const auto see = [&](std::uint32_t base, std::uint32_t exponent, double allowed) {
    const double error = std::fabs(power_error<P>(base, exponent));
    finding.worst = std::max(finding.worst, error);
    if (error / allowed <= finding.of_stated) return;
    finding.of_stated = error / allowed;
    finding.where = fmt::format("base {} / 2^{}, exponent {}", base, Power<P>::c_base_fraction,
                                std::ldexp(exponent, -P::c_exponent_fraction_bits));
  };
  const auto allowed_at = [&](std::uint32_t exponent) {
    return tables::derived(stated.preset, stated.format, stated.bound,
                           std::ldexp(exponent, -P::c_exponent_fraction_bits));
  };
  if constexpr (c_exact) {
    std::mt19937_64 random(8);
    for (int i = 0; i < (context.quick ? 3'000 : 60'000); ++i) {
      const auto exponent = static_cast<std::uint32_t>(1 + random() % c_largest) >> random() % 16;
      const double allowed = allowed_at(exponent);
      // Choose bases whose power is not almost 0.
      const auto width = std::max<std::uint64_t>(1, c_one / (1 + (exponent >> P::c_exponent_fraction_bits)));
      std::uint32_t base =
          c_one - static_cast<std::uint32_t>(random() % std::min<std::uint64_t>(c_one, 8 * width));
      double best = std::fabs(power_error<P>(base, exponent));
      for (int step = 0; step < 40; ++step) {
        const auto move =
            static_cast<std::int64_t>(random() % (2 * width + 1)) - static_cast<std::int64_t>(width);
        const auto next = static_cast<std::uint32_t>(
            std::clamp<std::int64_t>(std::int64_t{base} + (move >> random() % 16), 1, c_one));
        if (const double error = std::fabs(power_error<P>(next, exponent)); error > best)
          best = error, base = next;
      }
      see(base, exponent, allowed);
    }
    finding.proved = exact_ratio(context.quick) * stated.bound.value;
  } else {
    const std::uint32_t base_step = context.quick ? 61 : 1, exponent_step = context.quick ? 13 : 1;
    for (std::uint32_t exponent = 1; exponent <= c_largest; exponent += exponent_step) {
      const double allowed = allowed_at(exponent);
      for (std::uint32_t base = 0; base <= c_one; base += base_step) see(base, exponent, allowed);
    }
    if (!context.quick) finding.proved = finding.of_stated * stated.bound.value;
  }
  return finding;
}

// The cone's factor by its cubic, in real numbers.
template <class P>
double share_error(std::int64_t over, std::uint32_t slope) {
  constexpr int c_fraction = P::c_direction_fraction_bits;
  const long double t =
      std::clamp(std::ldexp(static_cast<long double>(over), -2 * c_fraction) *
                     std::ldexp(static_cast<long double>(slope), -P::c_spot_slope_fraction_bits),
                 0.0L, 1.0L);
  return static_cast<double>(
      std::ldexp(static_cast<long double>(SpotCone<P>::factor(-over, 0, slope)), -P::c_weight_fraction_bits) -
      t * t * (3 - 2 * t));
}

template <class P>
Finding spot(const Context& context, const Stated& stated) {
  constexpr int c_slope_bits = 12 + P::c_spot_slope_fraction_bits, c_sum = 2 * P::c_direction_fraction_bits;
  std::mt19937_64 random(2);
  Finding finding;
  for (int i = 0; i < (context.quick ? 60'000 : 2'000'000); ++i) {
    auto slope =
        static_cast<std::uint32_t>(1 + (random() % (1ULL << c_slope_bits) >> random() % c_slope_bits));
    if (i % 2 == 0) slope = (1U << c_slope_bits) - static_cast<std::uint32_t>(random() % 4096);
    const long double s = std::ldexp(static_cast<long double>(slope), -P::c_spot_slope_fraction_bits);
    // Choose arguments where the factor rises most.
    const long double t = 0.5L + (static_cast<long double>(random() % 1'000'000) / 1'000'000 - 0.5L) * 0.3L;
    const auto over = static_cast<std::int64_t>(std::ldexp(std::min(t / s, 2.0L), c_sum));
    const double error = std::fabs(share_error<P>(over, slope));
    keep_worst(finding, error, [&] {
      return fmt::format("slope word {}, cosine {} / 2^{} above the edge", slope, over, c_sum);
    });
  }
  // t is within [0, 1] or clamped. The other errors are the cuts and the rounding.
  const int weight = P::c_weight_fraction_bits;
  // The cubic's rise between t and T is bounded by its greatest slope between them.
  prove(context,
        fmt::format("O = fixed<-{},dn>(R); o = fixed<-{},dn>(O); t = fixed<-{},dn>(o * s); T = O * s;\n"
                    "d = T - t; c = (T + t) / 2; rise = 1.5 - 6 * ((c - 0.5) * (c - 0.5)) - 0.5 * (d * d);\n"
                    "g = t * t * (3 - 2 * t); f = fixed<-{},ne>(g); F = T * T * (3 - 2 * T);\n"
                    "{{ s in [0, 4096] /\\ T in [0, 1] /\\ t in [0, 1] -> |f - F| <= {} }}\n"
                    "F - g -> d * rise;\nd -> (O - o) * s + (o * s - t);\nf - F -> (f - g) - (F - g);\n",
                    c_sum, SpotCone<P>::c_over_fraction, weight, weight, stated.bound.value),
        stated.bound.value, finding);
  return finding;
}

// The weight of a diffuse term is its rounded cosine. All cosines of preset published, a stride of preset
// exact's.
template <class P>
Finding diffuse(const Context&, const Stated&) {
  constexpr int c_drop = P::c_direction_fraction_bits - P::c_weight_fraction_bits;
  Finding finding;
  for (std::int64_t cosine = 0; cosine <= std::int64_t{1} << P::c_direction_fraction_bits; ++cosine) {
    const double error =
        std::fabs(static_cast<double>((golden::round_half_up(cosine, c_drop) << c_drop) - cosine)) *
        std::ldexp(1.0, -P::c_direction_fraction_bits);
    keep_worst(finding, error,
               [&] { return fmt::format("a cosine of {} / 2^{}", cosine, P::c_direction_fraction_bits); });
  }
  finding.proved = finding.worst;
  return finding;
}

}  // namespace

std::vector<Check> power_checks() {
  return {
      {"exact", "weight", "power", "intervals over cells and exponents; hill climbing", power<Exact>},
      {"published", "weight", "power", "every base, every exponent", power<Published>},
      {"both", "weight", "spot", "Gappa; a random search", of_preset(spot<Exact>, spot<Published>)},
      {"both", "weight", "diffuse", "every cosine", of_preset(diffuse<Exact>, diffuse<Published>)},
  };
}

}  // namespace halfway::bounds
