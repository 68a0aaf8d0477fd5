// SPDX-License-Identifier: Apache-2.0
// Drift of an angle along a span: start and slope are rounded, and the slope's rounding error accumulates.
#include <fmt/format.h>

#include <random>

#include "golden/line_interpolator.hpp"
#include "registry.hpp"
#include "words/init_vector.hpp"

namespace halfway::bounds {
namespace {

using words::Exact, words::Published;

// The largest difference between a golden interpolator and start + k slope over `steps` steps, for real
// starts and slopes that are rounded as in setup. Angles that wrap are compared modulo the word.
template <int Bits>
Finding drift(int fraction, std::int64_t steps, int tries) {
  std::mt19937_64 random(2);
  Finding finding;
  const long double wrap = std::ldexp(1.0L, Bits - fraction);
  for (int i = 0; i < tries; ++i) {
    // From -1 to 1 over the span, like a bell.
    const auto real = [&] { return std::ldexp(static_cast<long double>(random()), -63) - 1.0L; };
    long double start = real(), slope = (real() - start) / static_cast<long double>(steps);
    if (i == 0) {
      // Both are rounded up by almost half a unit.
      start = std::ldexp(-0.4999L, -fraction);
      slope = std::ldexp(-0.4999L, -fraction);
    }
    using Word = words::Word<Bits>;
    const auto word = [&](long double v) {
      return Word::from_bits(static_cast<std::uint64_t>(wrapped_word(v, fraction, Bits)));
    };
    golden::LineInterpolator<Bits> angle;
    angle.load(word(start));
    const Word step = word(slope);
    for (std::int64_t k = 0; k <= steps; ++k) {
      const long double away = std::ldexp(static_cast<long double>(angle.value().value()), -fraction) -
                               (start + static_cast<long double>(k) * slope);
      const auto error = static_cast<double>(std::fabs(std::remainder(away, wrap)));
      if (error > finding.worst) {
        finding.worst = error;
        finding.where = fmt::format("pixel {} of start {:.9f}, slope {:.12f}", k, static_cast<double>(start),
                                    static_cast<double>(slope));
      }
      angle.step(step);
    }
  }
  return finding;
}

template <class P>
Finding angle(const Context& context, const Stated& stated) {
  constexpr std::int64_t c_steps = 4095;
  Finding finding = drift<P::c_angle_bits>(P::c_angle_fraction_bits, c_steps, context.quick ? 20 : 2000);
  prove(context,
        fmt::format("@fx = fixed<-{},ne>;\na = fx(A); s = fx(S);\n"
                    "{{ K in [0, {}] -> |(a + K * s) - (A + K * S)| <= {} }}\n"
                    "(a + K * s) - (A + K * S) -> (a - A) + K * (s - S);\n",
                    stated.format.fraction_bits, c_steps, stated.bound.value),
        stated.bound.value, finding);
  return finding;
}

}  // namespace

std::vector<Check> angle_checks() {
  return {{"both", "angle", "", "Gappa; angles along a span by the golden adder",
           of_preset(angle<Exact>, angle<Published>)}};
}

}  // namespace halfway::bounds
