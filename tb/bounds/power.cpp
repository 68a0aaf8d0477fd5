// SPDX-License-Identifier: Apache-2.0
// base^m by tables of log2 and 2^-x, for every exponent m; a spot's share.
//
// With t = -log2(base), the hardware's t' = t + a (a within the logarithm's error of that cell), the product
// cut by a unit of 2^-20 (2^-10), 2^-x from its table, shifted and rounded: preset exact's error is bounded
// here for every base and every m by intervals: over each cell of the logarithm and each short range of m,
//   |2^-mt' - 2^-mt| <= 2^-m t_low (2^(m a) - 1),
// t_low the cell's least t; and what comes behind the product by every cell of 2^-x and every shift.
#include "golden/power.hpp"

#include <fmt/format.h>

#include <random>

#include "golden/spot_cone.hpp"
#include "interval.hpp"
#include "registry.hpp"

namespace halfway::bounds {
namespace {

using golden::Exact, golden::Function, golden::Power, golden::Published, golden::SpotCone;

template <class P>
double power_error(std::uint32_t base, std::uint32_t exponent) {
  const long double c = std::ldexp(static_cast<long double>(base), -Power<P>::c_base_fraction),
                    m = std::ldexp(static_cast<long double>(exponent), -P::c_exponent_fraction_bits);
  return static_cast<double>(
      std::ldexp(static_cast<long double>(Power<P>::power(base, exponent)), -P::c_weight_fraction_bits) -
      std::pow(c, m));
}

// The least and greatest of the logarithm's error over one cell: what the golden model has less log2, for
// every mantissa of the cell. Past its lowest bits a mantissa's part of a slope is cut; so all are looked at.
struct Range {
  double low = 0, high = 0;
  void add(double v) { low = std::min(low, v), high = std::max(high, v); }
};
std::vector<Range> logarithm_errors() {
  constexpr int c_base = Power<Exact>::c_base_fraction, c_loss = Power<Exact>::c_loss_fraction;
  constexpr auto& table = golden::c_exact_functions[static_cast<std::size_t>(Function::logarithm)];
  std::vector<Range> errors(std::size_t{1} << table.address_bits);
  // A base from 1/2 to 1, exclusive; its loss is 1 - log2(2 base).
  for (std::uint32_t mantissa = 0; mantissa < 1U << c_base; ++mantissa) {
    const std::uint32_t base = (1U << c_base) + mantissa;  // of twice the scale: leading bit set
    // loss() takes bases of c_base bits of fraction up to 1: halved, they would lose a bit; so as it stands
    // for even ones, and by the table's own values for odd ones.
    const auto cell = static_cast<std::size_t>(mantissa >> (c_base - table.address_bits));
    const std::uint32_t rest = mantissa & ((1U << (c_base - table.address_bits)) - 1);
    const auto part = static_cast<std::uint32_t>(
        (std::uint64_t{table.values[cell + 1] - table.values[cell]} * rest) >> (c_base - table.address_bits));
    const double has = std::ldexp(table.values[cell] + part, -c_loss);
    errors[cell].add(has - std::log2(std::ldexp(base, -c_base)));
  }
  return errors;
}

// 2^-x behind the product, for x in [0, 1): value, shift by nothing, rounding; every word.
Range decay_errors() {
  constexpr int c_fraction = Power<Exact>::c_decay_fraction;
  Range errors;
  for (std::uint64_t x = 1; x < std::uint64_t{1} << c_fraction; ++x)
    errors.add(std::ldexp(static_cast<double>(Power<Exact>::decayed(x)), -Exact::c_weight_fraction_bits) -
               std::exp2(-std::ldexp(static_cast<double>(x), -c_fraction)));
  return errors;
}
// The same for larger x, where less is left and so less is off, but for the rounding.
Range small_decay_errors() {
  constexpr int c_fraction = Power<Exact>::c_decay_fraction;
  Range errors;
  for (std::uint64_t x = std::uint64_t{1} << c_fraction; x < std::uint64_t{20} << c_fraction; x += 7)
    errors.add(std::ldexp(static_cast<double>(Power<Exact>::decayed(x)), -Exact::c_weight_fraction_bits) -
               std::exp2(-std::ldexp(static_cast<double>(x), -c_fraction)));
  return errors;
}

// The greatest ratio of what the error can be to what is stated, over all m and all bases.
double exact_ratio() {
  const std::vector<Range> logarithm = logarithm_errors();
  const Range decay = decay_errors();
  const auto cells = static_cast<double>(logarithm.size());
  const double cut = std::ldexp(1.0, -Power<Exact>::c_decay_fraction);  // the product's
  const double behind = std::max(-decay.low, decay.high) + 1e-12;
  double most = 0;
  constexpr double c_slack = 1 + 1e-9;  // of doubles
  for (double m = 0; m < 8192;) {
    const double next = std::max(m + 1.0 / 16, m * 1.01);
    const double stated = std::ldexp(1.0, -15) + m * std::ldexp(1.0, -23);
    double off = 0;
    for (std::size_t cell = 0; cell < logarithm.size(); ++cell) {
      // The cell's greatest mantissa has the least loss; a lead of zeros more adds 1 to it.
      const double least_loss = 1 - std::log2(1 + (static_cast<double>(cell) + 1) / cells);
      const double a = std::max(logarithm[cell].high, -logarithm[cell].low) + 1e-15;
      // With more zeros before it 2^-mt is smaller still; m's least makes it largest, its greatest the rest.
      const double here = std::exp2(-m * least_loss) * std::expm1(std::numbers::ln2 * (next * a + cut));
      off = std::max(off, here);
    }
    most = std::max(most, (off * c_slack + behind) / stated);
    m = next;
  }
  return most;
}

template <class P>
Finding power(const Context& context, const tables::PresetFormats& preset, const tables::Format& format,
              const tables::Bound& bound) {
  constexpr std::uint32_t c_one = Power<P>::c_one, c_largest = (1U << P::c_exponent_bits) - 1;
  constexpr bool c_exact = std::is_same_v<P, Exact>;
  Finding finding;
  const auto see = [&](std::uint32_t base, std::uint32_t exponent, double stated) {
    const double error = std::fabs(power_error<P>(base, exponent));
    finding.worst = std::max(finding.worst, error);
    if (error / stated <= finding.of_stated) return;
    finding.of_stated = error / stated;
    finding.where = fmt::format("base {} / 2^{}, exponent {}", base, Power<P>::c_base_fraction,
                                std::ldexp(exponent, -P::c_exponent_fraction_bits));
  };
  const auto stated_at = [&](std::uint32_t exponent) {
    return tables::derived(preset, format, bound, std::ldexp(exponent, -P::c_exponent_fraction_bits));
  };
  if constexpr (c_exact) {
    std::mt19937_64 random(8);
    for (int i = 0; i < (context.quick ? 3'000 : 60'000); ++i) {
      const auto exponent = static_cast<std::uint32_t>(1 + random() % c_largest) >> random() % 16;
      const double stated = stated_at(exponent);
      // Where the power still is something.
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
      see(base, exponent, stated);
    }
    const double ratio = exact_ratio();
    finding.proved = ratio * bound.value;
    // Past one whole shift the rounding is all there is.
    const Range small = small_decay_errors(), large = decay_errors();
    if (std::max(-small.low, small.high) > std::max(-large.low, large.high))
      finding.failure = "2^-x is farther off past a shift";
  } else {
    const std::uint32_t base_step = context.quick ? 61 : 1, exponent_step = context.quick ? 13 : 1;
    for (std::uint32_t exponent = 0; exponent <= c_largest; exponent += exponent_step) {
      const double stated = stated_at(exponent);
      for (std::uint32_t base = 0; base <= c_one; base += base_step) see(base, exponent, stated);
    }
    if (!context.quick) finding.proved = finding.of_stated * bound.value;
  }
  return finding;
}

// The share by its cubic, in real numbers.
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
Finding spot(const Context& context, const tables::PresetFormats&, const tables::Format& format,
             const tables::Bound& bound) {
  constexpr int c_slope_bits = 12 + P::c_spot_slope_fraction_bits, c_sum = 2 * P::c_direction_fraction_bits;
  std::mt19937_64 random(2);
  Finding finding;
  for (int i = 0; i < (context.quick ? 60'000 : 2'000'000); ++i) {
    auto slope =
        static_cast<std::uint32_t>(1 + (random() % (1ULL << c_slope_bits) >> random() % c_slope_bits));
    if (i % 2 == 0) slope = (1U << c_slope_bits) - static_cast<std::uint32_t>(random() % 4096);
    const long double s = std::ldexp(static_cast<long double>(slope), -P::c_spot_slope_fraction_bits);
    // Where the share rises most.
    const long double t = 0.5L + (static_cast<long double>(random() % 1'000'000) / 1'000'000 - 0.5L) * 0.3L;
    const auto over = static_cast<std::int64_t>(std::ldexp(std::min(t / s, 2.0L), c_sum));
    const double error = std::fabs(share_error<P>(over, slope));
    if (error <= finding.worst) continue;
    finding.worst = error;
    finding.where = fmt::format("slope word {}, cosine {} / 2^{} above the edge", slope, over, c_sum);
  }
  // t is within [0, 1] or held; beside that the cuts alone, and the rounding.
  const int weight = P::c_weight_fraction_bits, over_bits = std::min(SpotCone<P>::c_over_fraction, c_sum);
  const auto said =
      gappa(context,
            fmt::format("o = fixed<-{},dn>(O); t = fixed<-{},dn>(o * s); T = O * s;\n"
                        "f = fixed<-{},ne>(t * t * (3 - 2 * t)); F = T * T * (3 - 2 * T);\n"
                        "rise = 3 / 2 - 2 * (T - 1 / 2) * (T - 1 / 2) * 3 + (T - t) * (4 * T + 2 * t - 3);\n"
                        "{{ s in [0, 4096] /\\ T in [0, 1] /\\ t in [0, 1] /\\ O in [0, 2]\n"
                        "  -> |f - F| <= {} }}\n"
                        "F - t * t * (3 - 2 * t) -> (T - t) * rise;\n"
                        "T - t -> (O - o) * s + (o * s - t);\n"
                        "f - F -> (f - t * t * (3 - 2 * t)) - (F - t * t * (3 - 2 * t));\n",
                        over_bits, weight, weight, bound.value * (1 + std::ldexp(1.0, -10))));
  if (said && said->empty()) finding.proved = bound.value * (1 + std::ldexp(1.0, -10));
  if (said && !said->empty()) finding.failure = "Gappa cannot show it: " + *said;
  static_cast<void>(format);
  return finding;
}

// A diffuse term's weight is its cosine, rounded: every cosine of preset published, a stride of exact's.
template <class P>
Finding diffuse(const Context&, const tables::PresetFormats&, const tables::Format& format,
                const tables::Bound&) {
  constexpr int c_drop = P::c_direction_fraction_bits - P::c_weight_fraction_bits;
  Finding finding;
  for (std::int64_t cosine = 0; cosine <= std::int64_t{1} << P::c_direction_fraction_bits; ++cosine) {
    const double error =
        std::fabs(static_cast<double>((golden::round_half_up(cosine, c_drop) << c_drop) - cosine)) *
        std::ldexp(1.0, -P::c_direction_fraction_bits);
    if (error <= finding.worst) continue;
    finding.worst = error;
    finding.where = fmt::format("a cosine of {} / 2^{}", cosine, P::c_direction_fraction_bits);
  }
  finding.proved = finding.worst;
  static_cast<void>(format);
  return finding;
}

}  // namespace

std::vector<Check> power_checks() {
  return {
      {"exact", "weight", "power", "intervals over cells and exponents; a search uphill", power<Exact>},
      {"published", "weight", "power", "every base, every exponent", power<Published>},
      {"exact", "weight", "spot", "Gappa; a random search", spot<Exact>},
      {"published", "weight", "spot", "Gappa; a random search", spot<Published>},
      {"exact", "weight", "diffuse", "every cosine", diffuse<Exact>},
      {"published", "weight", "diffuse", "every cosine", diffuse<Published>},
  };
}

}  // namespace halfway::bounds
