// SPDX-License-Identifier: Apache-2.0
// The units of the shading processors at the ends of their ranges, at the limits of their tables' cells, and
// one unit in the last place next to them. Inputs that a vector of the host can produce also run through the
// RTL, one pixel each.
#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <optional>
#include <random>

#include "golden/power.hpp"
#include "golden/processors_layout.hpp"
#include "golden/saturate.hpp"
#include "golden/saturating_sum.hpp"
#include "golden/unit_vector.hpp"
#include "golden/word.hpp"
#include "stability/hard_case.hpp"
#include "stability/measure.hpp"
#include "stability/trial.hpp"

namespace halfway::stability {
namespace {

using golden::Axes, golden::Exact;

long double real(std::int64_t value, int fraction_bits) {
  return std::ldexp(static_cast<long double>(value), -fraction_bits);
}

template <class P>
constexpr Preset c_preset = std::is_same_v<P, Exact> ? Preset::exact : Preset::published;

// 1/sqrt(x) by a table, and by a table and a Newton step. The bound is that of reciprocal_root.vhd.
template <class P>
void roots_of(Trial& trial) {
  using Root = golden::ReciprocalRoot<P>;
  constexpr int c_fraction = P::c_square_fraction_bits;
  constexpr std::int64_t c_one = std::int64_t{1} << c_fraction;
  const int bits = golden::function_table<P>(golden::Function::reciprocal_root).address_bits - 1;
  const auto try_at = [&](std::int64_t x) {
    if (x < c_one / 4 || x >= 4 * c_one) return;
    const long double exact = 1.0L / std::sqrt(real(x, c_fraction)),
                      root = real(Root::reciprocal(static_cast<std::uint32_t>(x)), Root::c_fraction_bits);
    trial.measure(c_preset<P>, std::abs(root / exact - 1.0L), 0x1p-19L,
                  [&] { return fmt::format("1/sqrt({})", static_cast<double>(real(x, c_fraction))); });
  };
  // Ends of the cells, from 1/4 to 4, in each octave.
  for (int octave = -2; octave < 2; ++octave)
    for (std::int64_t cell = 0; cell <= 1 << bits; ++cell)
      for (const std::int64_t offset : {-1, 0, 1})
        try_at(octave < 0 ? ((c_one + (cell << (c_fraction - bits))) >> -octave) + offset
                          : ((c_one + (cell << (c_fraction - bits))) << octave) + offset);
  trial.require(Root::reciprocal(0) < (1U << Root::c_bits), [] { return "1/sqrt(0) leaves its format"; });
}
void roots(Trial& trial) {
  roots_of<Exact>(trial);
  roots_of<golden::Published>(trial);
}

// The words of one pixel of a draw.
struct Pixel {
  Axes normal{};              ///< in format vector
  std::int64_t exponent = 0;  ///< in its format
  bool normalize = true;
};

// Draws each entry as a pixel of its own with the given words; `to_light` replaces the light's place.
template <class P>
std::vector<Fragment> draw_pixels(Trial& trial, const Scene& scene, ProcessorForm form,
                                  const std::vector<Pixel>& pixels,
                                  std::optional<Axes> to_light = std::nullopt) {
  using Request = typename P::request_header_at;
  using Plane = typename P::plane_header_at;
  constexpr FrameSize c_frame{1, 1};
  const auto plan = plan_scene(scene, {.shader = Shader::processors, .preset = c_preset<P>, .form = form});
  if (!plan) return {};
  const auto setup = make_setup(scene, c_frame, plan->key, {});
  const golden::ProcessorsConfig config = processors_config(plan->key);
  const golden::ProcessorsLayout<P> layout(config);
  const Stream stream = stream_of(*setup);
  std::vector<std::uint32_t> words = stream.prologue, draw = stream.units;
  // The light's vector follows new_frame and the ambient light.
  const auto light = std::span(words).subspan(2 * stream.vector_words());
  for (int axis = 0; to_light && axis < golden::c_axes; ++axis)
    golden::set_bits(light, P::light_axes_channel_at::place,
                     static_cast<std::uint64_t>((*to_light)[static_cast<std::size_t>(axis)]),
                     golden::ProcessorsLayout<P>::light_axis_low(axis));
  for (const Pixel& pixel : pixels) {
    golden::set_bits(draw, Request::normalize, pixel.normalize);
    for (int axis = 0; axis < golden::c_axes; ++axis) {
      const int low = layout.plane_low(axis);
      golden::set_bits(draw, Plane::value,
                       static_cast<std::uint64_t>(pixel.normal[static_cast<std::size_t>(axis)])
                           << (P::c_plane_sum_fraction_bits - P::c_vector_fraction_bits),
                       low);
      for (const golden::Field* step : {&Plane::dx, &Plane::de0, &Plane::de1})
        golden::set_bits(draw, *step, 0, low);
    }
    if (config.specular)
      golden::set_bits(draw, {"", layout.exponent_low(), P::c_exponent_bits, false, 0},
                       static_cast<std::uint64_t>(pixel.exponent), layout.init_material_low());
    words.insert(words.end(), draw.begin(), draw.end());
  }
  return trial.draw(plan->key, words);
}

// A wall in front of the eye, lit from the eye. Its normals differ, so that they are normalized.
Scene lit_wall(double diffuse, double specular) {
  Scene scene;
  scene.name = "wall";
  scene.ambient = glm::dvec3(0.0);
  scene.materials = {{.name = "m", .ambient = 0.0, .diffuse = diffuse, .specular = specular}};
  scene.directional = {{{0.0, 0.0, 1.0}, glm::dvec3(1.0)}};
  scene.camera.eye_world = {0.0, 0.0, 3.0};
  scene.positions_world = {{-9.0, -9.0, 0.0}, {9.0, -9.0, 0.0}, {0.0, 9.0, 0.0}};
  scene.normals_world = {{0.0, 0.0, 1.0}, {0.6, 0.0, 0.8}, {0.0, 0.6, 0.8}};
  scene.triangles = {{{0, 1, 2}, {0, 1, 2}, 0}};
  return scene;
}

// Components that are powers of two and their neighbours, of both signs, and the least component.
template <int Bits>
std::vector<Axes> hard_vectors(int random_ones) {
  constexpr std::int64_t c_least = -(std::int64_t{1} << (Bits - 1)), c_most = -c_least - 1;
  std::vector<std::int64_t> values = {0, 1, -1, c_least, c_most};
  for (int k = 1; k < Bits - 1; k += 5)
    for (const std::int64_t offset : {-1, 0, 1})
      for (const std::int64_t sign : {-1, 1}) values.push_back(sign * ((std::int64_t{1} << k) + offset));
  std::vector<Axes> vectors = {{1, 0, 0},
                               {0, 0, 1},
                               {-1, -1, -1},
                               {c_least, c_least, c_least},
                               {c_most, c_most, c_most},
                               {c_least, 0, 1},
                               {0, c_least, c_most}};
  std::mt19937_64 random(1);
  const auto any = [&] { return values[random() % values.size()]; };
  for (int i = 0; i < random_ones; ++i) vectors.push_back({any(), any(), any()});
  return vectors;
}

// Length and angle: the bounds of unit_vector.hpp apply to the sum of both errors.
template <class P, int Bits>
void unit_vectors_of(Trial& trial) {
  const std::vector<Axes> vectors = hard_vectors<Bits>(trial.rounds(2'000, 1'000'000));
  for (const Axes& v : vectors) {
    const Axes unit = golden::normalized<P, Bits>(v);
    const LongVec exact(v[0], v[1], v[2]),
        ours(real(unit[0], P::c_direction_fraction_bits), real(unit[1], P::c_direction_fraction_bits),
             real(unit[2], P::c_direction_fraction_bits));
    const long double length = glm::length(exact);
    const auto where = [&] { return fmt::format("({}, {}, {}) of {} bits", v[0], v[1], v[2], Bits); };
    const long double error = length > 0.0L ? glm::length(ours - exact / length) : glm::length(ours);
    trial.measure(c_preset<P>, error, 0x1.6ap-20L + 0x1.26p-21L, where);
  }
}

template <class P>
void draw_unit_vectors(Trial& trial) {
  const Scene scene = lit_wall(1.0, 0.0);
  std::vector<Pixel> pixels;
  for (const Axes& v : hard_vectors<P::c_vector_bits>(300)) pixels.push_back({.normal = v});
  for (const ProcessorForm form : c_forms) {
    const auto fragments = draw_pixels<P>(trial, scene, form, pixels);
    trial.require(fragments.size() == pixels.size(), [] { return "not a fragment a pixel"; });
    if (!std::is_same_v<P, Exact>) continue;
    for (std::size_t i = 0; i < fragments.size(); ++i) {
      const Axes& v = pixels[i].normal;
      const LongVec n(v[0], v[1], v[2]);
      const long double length = glm::length(n),
                        wanted = length > 0.0L ? 255.0L * std::max(n.z / length, 0.0L) : 0.0L;
      // The error of the cosine, in half steps beyond rounding.
      trial.require(std::abs(wanted - fragments[i].red) < 0.5L + 0x1p-10L, [&] {
        return fmt::format("({}, {}, {}): drawn {}", v[0], v[1], v[2], fragments[i].red);
      });
    }
  }
}

void unit_vectors(Trial& trial) {
  unit_vectors_of<Exact, Exact::c_vector_bits>(trial);
  unit_vectors_of<Exact, Exact::c_offset_bits>(trial);
  unit_vectors_of<Exact, Exact::c_direction_bits + 1>(trial);
  unit_vectors_of<golden::Published, golden::Published::c_vector_bits>(trial);
  unit_vectors_of<golden::Published, golden::Published::c_offset_bits>(trial);
  draw_unit_vectors<Exact>(trial);
  draw_unit_vectors<golden::Published>(trial);
}

// The bound of power.vhd, in weights. Exponents are in their own format.
template <class P>
void powers_of(Trial& trial) {
  using Power = golden::Power<P>;
  std::vector<std::int64_t> bases = {
      0, 1, 2, 3, Power::c_one / 2 - 1, Power::c_one / 2, Power::c_one / 2 + 1};
  const int cells = golden::function_table<P>(golden::Function::logarithm).address_bits;
  for (std::int64_t cell = 0; cell <= 1 << cells; ++cell)
    for (const std::int64_t offset : {-1, 0, 1})
      bases.push_back(std::min<std::int64_t>(
          Power::c_one / 2 + (cell << (Power::c_base_fraction - 1 - cells)) + offset, Power::c_one));
  for (int i = 0; i < 40; ++i) bases.push_back(Power::c_one - i);
  const auto clamped = [](std::int64_t m) {
    return std::min<std::int64_t>(m, (std::int64_t{1} << P::c_exponent_bits) - 1);
  };
  std::vector<std::int64_t> exponents = {0, 1};
  const std::int64_t one = std::int64_t{1} << P::c_exponent_fraction_bits;
  for (const std::int64_t m : {1, 2, 3, 5, 20, 63, 64, 65, 1000, 1023, 4096, 8191})
    for (const std::int64_t offset : {-1, 0, 1}) exponents.push_back(clamped(m * one + offset));
  exponents.push_back(clamped(std::numeric_limits<std::int32_t>::max()));
  for (const std::int64_t m : exponents)
    for (const std::int64_t base : bases) {
      const long double exponent = real(m, P::c_exponent_fraction_bits),
                        wanted = base == 0 ? 0.0L : std::pow(real(base, Power::c_base_fraction), exponent),
                        power = real(
                            Power::power(static_cast<std::uint32_t>(base), static_cast<std::uint32_t>(m)),
                            P::c_weight_fraction_bits);
      const auto where = [&] {
        return fmt::format("{} of {} to the {}", base, Power::c_one, static_cast<double>(exponent));
      };
      trial.measure(c_preset<P>, std::abs(power - wanted), 0x1p-15L + exponent * 0x1p-23L, where);
      // For every exponent, the power of 1 is 1 and the power of 0 is 0.
      if (base == Power::c_one) trial.require(power == 1.0L, where);
      if (base == 0) trial.require(power == 0.0L, where);
    }
}

// N.H is the z of N. Values above 1 count as 1.
void powers(Trial& trial) {
  powers_of<Exact>(trial);
  powers_of<golden::Published>(trial);
  const Scene scene = lit_wall(0.0, 1.0);
  const std::int64_t one = std::int64_t{1} << Exact::c_vector_fraction_bits,
                     step = one >> Exact::c_direction_fraction_bits;
  std::vector<Pixel> pixels;
  for (const std::int64_t m : {1, 2, 7, 64, 1000, 8191})
    for (const std::int64_t z :
         {step, one / 2, one - 1000 * step, one - 2 * step, one - step, one, one + step, one + 1000 * step,
          2 * one - step, -one, -2 * one, std::int64_t{0}})
      pixels.push_back({{0, 0, z}, m << Exact::c_exponent_fraction_bits, false});
  for (const ProcessorForm form : c_forms) {
    const auto fragments = draw_pixels<Exact>(trial, scene, form, pixels);
    trial.require(fragments.size() == pixels.size(), [] { return "not a fragment a pixel"; });
    for (std::size_t i = 0; i < fragments.size(); ++i) {
      const long double m = real(pixels[i].exponent, Exact::c_exponent_fraction_bits),
                        cosine =
                            std::clamp(real(pixels[i].normal[2], Exact::c_vector_fraction_bits), 0.0L, 1.0L);
      // The error of H is that of a unit vector.
      const long double wanted = 255.0L * std::pow(cosine, m),
                        least = 255.0L * std::pow(std::max(cosine - 0x1p-18L, 0.0L), m),
                        most = 255.0L * std::pow(std::min(cosine + 0x1p-18L, 1.0L), m),
                        power = 255.0L * (0x1p-15L + m * 0x1p-23L) + 0x1p-4L;
      trial.require(fragments[i].red >= least - power - 0.5L && fragments[i].red <= most + power + 0.5L, [&] {
        return fmt::format("{} to the {}: drawn {} for {}", static_cast<double>(cosine),
                           static_cast<double>(m), fragments[i].red, static_cast<double>(wanted));
      });
    }
  }
}

// N.L and N.H for vectors of length 1 except for rounding, and for any vectors.
void cosines(Trial& trial) {
  constexpr int c_fraction = Exact::c_direction_fraction_bits;
  constexpr std::int64_t c_one = std::int64_t{1} << (2 * c_fraction),
                         c_half = std::int64_t{1} << (c_fraction - 1);
  std::vector<std::int64_t> dots = {std::int64_t{3} << (2 * c_fraction + 2),
                                    -(std::int64_t{3} << (2 * c_fraction + 2))};
  for (const std::int64_t at :
       {std::int64_t{0}, c_half, c_one / 2, c_one - c_half, c_one, c_one + c_half, 3 * c_one})
    for (const std::int64_t offset : {-1, 0, 1})
      for (const std::int64_t sign : {-1, 1}) dots.push_back(sign * (at + offset));
  for (const std::int64_t dot : dots) {
    const long double exact = std::clamp(real(dot, 2 * c_fraction), 0.0L, 1.0L);
    const long double cosine = real(golden::cosine<Exact>(dot), c_fraction);
    const auto where = [&] { return fmt::format("a sum of {}", dot); };
    // The published form has no clamps.
    trial.both(std::ldexp(std::abs(cosine - exact), c_fraction),
               std::ldexp(std::abs(real(dot, 2 * c_fraction) - exact), c_fraction), 0.5, where);
  }
}

// The largest products, and sums of three of them.
template <int Bits>
void products_of(Trial& trial) {
  constexpr std::int64_t c_least = -(std::int64_t{1} << (Bits - 1)), c_most = -c_least - 1;
  for (const std::int64_t a : {c_least, c_most, std::int64_t{-1}, std::int64_t{0}})
    for (const std::int64_t b : {c_least, c_most, std::int64_t{1}})
      for (const std::int64_t c : {c_least, c_most}) {
        const Axes u{a, b, c}, v{c, a, b};
        const Wide exact = Wide{a} * c + Wide{b} * a + Wide{c} * b;
        const Axes products = golden::vector_multiply(u, v);
        const bool right = Wide{golden::dot_product(u, v)} == exact &&
                           Wide{products[0]} + products[1] + products[2] == exact;
        trial.check(right, [&] { return fmt::format("({}, {}, {}) by ({}, {}, {})", a, b, c, c, a, b); });
      }
}
void products(Trial& trial) {
  products_of<Exact::c_direction_bits>(trial);
  products_of<Exact::c_direction_bits + 1>(trial);
  products_of<golden::Published::c_direction_bits>(trial);
  // N.L of the least words, and of their neighbours.
  const Scene scene = lit_wall(1.0, 0.0);
  constexpr std::int64_t c_least_place = -(std::int64_t{1} << (Exact::c_light_place_bits - 1));
  constexpr std::int64_t c_least = -(std::int64_t{1} << (Exact::c_vector_bits - 1));
  std::vector<Pixel> pixels;
  for (const std::int64_t x : {c_least, c_least + 1, -c_least - 1, std::int64_t{0}})
    for (const std::int64_t y : {c_least, -c_least - 1})
      for (const std::int64_t z : {c_least, -c_least - 64, std::int64_t{-1}})
        for (const bool normalize : {false, true}) pixels.push_back({{x, y, z}, 0, normalize});
  for (const ProcessorForm form : c_forms) {
    const auto fragments =
        draw_pixels<Exact>(trial, scene, form, pixels, Axes{c_least_place, c_least_place, c_least_place});
    trial.require(fragments.size() == pixels.size() && !fragments.empty() && fragments[0].red == 255,
                  [] { return "N.L of 12 is not white"; });
  }
}

// Halves of both signs are rounded up.
void ties(Trial& trial) {
  for (int bits = 0; bits <= 40; ++bits)
    for (std::int64_t whole = -3; whole <= 3; ++whole)
      for (const std::int64_t offset : {-1, 0, 1}) {
        const std::int64_t value =
            bits == 0 ? whole : whole * (std::int64_t{1} << bits) + (std::int64_t{1} << (bits - 1)) + offset;
        const long double exact = std::floor(real(value, bits) + 0.5L);
        const auto where = [&] { return fmt::format("{} without {} bits", value, bits); };
        trial.check(static_cast<long double>(golden::round_half_up(value, bits)) == exact, where);
      }
}

// Sums beyond both ends of a colour.
void saturation(Trial& trial) {
  const auto clamped_floor = [](long double v) { return std::clamp(std::floor(v), 0.0L, 255.0L); };
  using Sum = golden::Word<40>;
  for (const std::int64_t whole : {-512, -256, -1, 0, 1, 127, 255, 256, 257, 511, 1023, 2047})
    for (const std::int64_t offset : {-1, 0, 1}) {
      const std::int64_t value = whole * (std::int64_t{1} << 28) + offset;
      const auto word = Sum::from_bits(static_cast<std::uint64_t>(value));
      const long double wanted = clamped_floor(real(word.value(), 28));
      const auto where = [&] { return fmt::format("{} and {} 2^-28", whole, offset); };
      trial.ours(std::abs(golden::saturate<40, 28, 8>(word) - wanted), 0, where);
    }
  for (const std::uint64_t each : {0ULL, 1ULL, 255ULL << 16, (255ULL << 16) / 33, (1ULL << 40) - 1}) {
    golden::SaturatingSum sum;
    for (int i = 0; i < 33; ++i) sum.add(each);
    const long double wanted = clamped_floor(std::ldexp(33.0L * static_cast<long double>(each), -16));
    trial.ours(std::abs(sum.result(16, 8) - wanted), 0,
               [&] { return fmt::format("33 terms of {} 2^-16", each); });
  }
}

// A surface's place shifted right by every shift of a light, with components of both signs. The shift must be
// arithmetic. A logical shift, which GHDL's synthesis makes from shift_right, gives 19 instead of -13 in six
// bits.
void shifts(Trial& trial) {
  for (const ProcessorForm form : c_forms)
    for (int exponent = 0; exponent <= 33; ++exponent) {
      Scene scene;
      scene.name = "shifts";
      scene.materials = {{.name = "m", .specular = 0.4, .exponent = 30.0}};
      scene.camera.eye_world = {0.0, 0.0, 3.0};
      scene.positions_world = {{-9.0, -9.0, 0.0}, {9.0, -9.0, 0.0}, {0.0, 9.0, 0.0}};
      scene.normals_world = {{0.0, 0.0, 1.0}};
      scene.triangles = {{{0, 1, 2}, {0, 0, 0}, 0}};
      const glm::dvec3 way =
          std::ldexp(1.0, exponent) * glm::dvec3(exponent % 2 ? 0.4 : -0.4, exponent % 3 ? -0.3 : 0.3, 0.6);
      scene.positional = {{way, glm::dvec3(1.0)}};
      constexpr FrameSize c_frame{16, 12};
      const Drawing drawing =
          trial.draw(scene, {.plan = {.shader = Shader::processors, .form = form}, .frame = c_frame});
      measure_shading(trial, Preset::exact, scene, c_frame, drawing.fragments,
                      fmt::format("a light 2^{} away", exponent));
    }
}

constexpr HardCase c_cases[] = {
    {"roots", "1/sqrt at the ends of table cells", "processors, section 3.3: a table of 1/sqrt(x)",
     "512 entries and a Newton step", "within 2^-19", "relative error", PublishedForm::breaks, roots},
    {"unit_vectors", "Vectors that differ by one unit, and the smallest vectors",
     "processors, figure 2: N/abs(N) in fixed point", "a block shift before the square",
     "a unit vector within 2^-19", "length of the difference", PublishedForm::breaks, unit_vectors},
    {"powers", "Powers of 0, of 1 and of bases close to 1, exponents up to 8191",
     "processors, section 3.1: the power by a table", "log2 and 2^-x by interpolated tables",
     "within 2^-15 + m 2^-23", "of the peak", PublishedForm::breaks, powers},
    {"cosines", "N.L and N.H outside [0, 1] by rounding",
     "processors, section 2: N.A of vectors whose length is not exactly 1", "clamped to [0, 1], rounded",
     "within half a unit", "2^-22", PublishedForm::breaks, cosines},
    {"products", "−2^k times −2^k", "a product of two words with twice their bits",
     "a sum of products has one more bit", "exact", "products that are wrong", PublishedForm::silent,
     products},
    {"ties", "Rounding of positive and negative halves", "rounding away from zero",
     "halves are rounded up, so adding 1/2 and cutting rounds", "floor(x + 1/2)", "values that are wrong",
     PublishedForm::silent, ties},
    {"saturation", "Sums out of the range of a colour", "takes the lowest eight bits of a sum",
     "only the last step saturates", "between 0 and 255", "colour steps", PublishedForm::silent, saturation},
    {"shifts", "Signed shifts by 0 to 31",
     "shift_right of numeric_std becomes a logical shift in GHDL's netlist", "sign bits are concatenated",
     "the illumination model, within the errors of the units", "colour steps", PublishedForm::silent, shifts},
};

INSTANTIATE_TEST_SUITE_P(arithmetic, HardCases, testing::ValuesIn(c_cases), id_of);

}  // namespace

}  // namespace halfway::stability
