// SPDX-License-Identifier: Apache-2.0
// The units of the folded shading processor, in every processor of the list. A line names the step that a
// unit works for; the testbench takes the step's clock from rtl/illumination/schedule_pkg.vhd.
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <optional>

#include "golden/shading_processor.hpp"
#include "plan/processor_clocks.hpp"
#include "sim/files/vector_file.hpp"
#include "vectors/axes.hpp"
#include "vectors/entities.hpp"
#include "vectors/pipeline.hpp"
#include "vectors/processor_list.hpp"
#include "vectors/random.hpp"
#include "vectors/token_maker.hpp"

namespace halfway::vectors {
namespace {

using golden::Axes, words::Exact, words::Published, words::Term;

constexpr int c_lines = 1000;  // per file

/// What a processor can do, from the definition of its term.
template <class Preset>
struct Abilities {
  static constexpr bool c_exact = words::ProcessorsLayout<Preset>::c_exact;

  Term term;
  bool positional, spots;  ///< what its light can be
  bool first, second;      ///< it normalizes N or L; the view vector or H

  explicit Abilities(const Processor& p)
      : term(p.term),
        positional(p.term != Term::ambient && p.light > p.config.directional),
        spots(p.term != Term::ambient && p.light > p.config.directional + p.config.positional) {
    switch (term) {
      case Term::ambient:
        first = p.config.normalize;
        second = words::ProcessorsLayout<Preset>(p.config).has_view();
        break;
      case Term::diffuse:
        first = positional;
        second = false;
        break;
      case Term::specular:
        first = c_exact ? positional : spots;
        second = c_exact || positional;
        break;
    }
  }
  bool normalizes() const { return first || second; }
  bool of_light() const { return term != Term::ambient; }
};

// Calls write.operator()<Preset>(processor, abilities, random, file) for all processors with the unit, in
// both presets.
template <class Preset, class Has, class Write>
void write_preset(const Folder& folder, const Has& has, const Write& write) {
  for (const Processor& processor : processors()) {
    const Abilities<Preset> can(processor);
    if (!has(can)) continue;
    Random random(words::ProcessorsLayout<Preset>(processor.config).token_bits() * 100 +
                  static_cast<int>(processor.term) * 10 + processor.light);
    VectorFile file;
    write.template operator()<Preset>(processor, can, random, file);
    file.write(folder / (name_of<Preset>(processor) + ".txt"));
  }
}
template <class Has, class Write>
void write_units(const Folder& folder, const Has& has, const Write& write) {
  write_preset<Exact>(folder, has, write);
  write_preset<Published>(folder, has, write);
}

constexpr auto c_all = [](const auto&) { return true; };
constexpr auto c_of_light = [](const auto& can) { return can.of_light(); };
constexpr auto c_normalizing = [](const auto& can) { return can.normalizes(); };

void add(VectorFile& file, const Flat& flat) {
  file.words_of(flat.words, flat.bits);
}
void add(VectorFile& file, const Axes& v, int bits) {
  add(file, flat(v, bits));
}
// --- shading_sequence ---

/// How an object passes a processor: its clocks, from the one that takes it to the one that hands it on;
/// whether the first and second vector are normalized, and the factor of a cone is multiplied.
struct Path {
  unsigned clocks = 0;
  bool first = false, second = false, cone = false;
  bool complete = true;  ///< the term is added: no step of those above is left out at the end
};

struct Object {
  bool object, normalize, defined, positional, spot, lit, above;
};

/// A row of table 4 of an object that the light reaches.
template <class Preset>
unsigned row_clocks(Term term, std::optional<LightKind> light, bool normalize, bool view) {
  for (const ProcessorClocks& row : c_processor_clocks)
    if (row.term == term && row.light == light && row.normalize == normalize && row.view == view)
      return row.clocks(Abilities<Preset>::c_exact ? halfway::Preset::exact : halfway::Preset::published)
          .value();
  std::abort();
}
template <class Preset>
unsigned row_clocks(Term term, LightKind light) {
  return row_clocks<Preset>(term, light, false, false);
}

/// The path of an object that the light reaches.
template <class Preset>
Path lit_path(const Abilities<Preset>& can, const Object& o) {
  if (can.term == Term::ambient) {
    const bool normalize = can.first && o.normalize;
    return {row_clocks<Preset>(can.term, std::nullopt, normalize, can.second), normalize, can.second};
  }
  const bool positional = can.positional && o.positional, spot = can.spots && o.spot;
  // As printed, H does not need L. Only the cone of a spot does, and the row of a spot has both.
  const bool printed_highlight = can.term == Term::specular && !Abilities<Preset>::c_exact;
  const unsigned to_light = row_clocks<Preset>(Term::diffuse, LightKind::positional) -
                            row_clocks<Preset>(Term::diffuse, LightKind::directional);
  Path path;
  path.cone = spot;
  path.first = positional && (spot || !printed_highlight);
  path.second = can.term == Term::specular && (positional || !printed_highlight);
  path.clocks = row_clocks<Preset>(can.term, positional ? LightKind::positional : LightKind::directional);
  if (spot)
    path.clocks += row_clocks<Preset>(can.term, LightKind::spot) -
                   row_clocks<Preset>(can.term, LightKind::positional) -
                   (printed_highlight && !positional ? to_light : 0);
  // N.L is known in the fourth clock of the work on H.
  if (can.term == Term::specular && Abilities<Preset>::c_exact && !o.above) {
    path.clocks = 6 + (positional ? to_light : 0);
    path.complete = false;
  }
  return path;
}

template <class Preset>
Path path_of(const Abilities<Preset>& can, const Object& o) {
  if (!o.object || (can.of_light() && !o.defined)) return {.clocks = 2, .complete = false};
  Path path = lit_path(can, o);
  // A shadow is known in the first clock after the one that takes the object.
  if (!o.lit) {
    path.clocks = 3;
    path.complete = false;
  }
  return path;
}

// --- Words of a light and a token, each as separate fields and flat ---

template <class Preset>
struct Words {
  golden::ShadingToken<Preset> token;
  golden::ShadingLight light;
  Flat token_words, light_words;

  Words(TokenMaker<Preset>& maker, const Processor& p) {
    light = maker.load(words::Command::define, static_cast<std::uint32_t>(p.light)).light;
    light_words = vectors::light_words(maker, p.config, light);
    token = maker.object();
    if (p.term != Term::ambient) token = maker.behind_ambient(token);
    const int bits = words::ProcessorsLayout<Preset>(p.config).token_bits();
    token_words = flat(maker.words(token, bits), bits);
    // What the hardware lacks reads as 0.
    token = golden::ShadingToken<Preset>::decode(p.config, token_words.words);
  }
};

/// k I of the channels, not rounded.
template <class Preset>
Axes reflections(const Processor& p, const Words<Preset>& w) {
  const golden::Channels& k = p.term == Term::ambient   ? w.token.ambient
                              : p.term == Term::diffuse ? w.token.diffuse
                                                        : w.token.specular;
  Axes products{};
  for (std::size_t c = 0; c < static_cast<std::size_t>(p.config.channels); ++c)
    products[c] = std::int64_t{k[c]} * w.light.intensity[c];
  return products;
}

/// Bits of a component of what is normalized.
template <class Preset>
constexpr int normalized_bits(const Abilities<Preset>& can) {
  if (can.term == Term::ambient) return Preset::c_vector_bits;
  return Abilities<Preset>::c_exact && !can.positional ? Preset::c_direction_bits + 1 : Preset::c_offset_bits;
}

/// Components of a vector of `bits` bits as vector_shift gives them.
template <class Preset>
Axes shifted_of(const Axes& v, int bits) {
  constexpr int c_result = Preset::c_direction_bits;
  if (bits == Preset::c_vector_bits) return golden::vector_shift<Preset::c_vector_bits, c_result>(v);
  if (bits == Preset::c_offset_bits) return golden::vector_shift<Preset::c_offset_bits, c_result>(v);
  return golden::vector_shift<c_result + 1, c_result>(v);
}

template <class Preset>
std::uint32_t square_of(std::int64_t dot) {
  return static_cast<std::uint32_t>(words::low_bits(
      dot >> (2 * (Preset::c_direction_bits - 1) - Preset::c_square_fraction_bits), Preset::c_square_bits));
}

Axes wrapped(const Axes& v, int bits) {
  Axes result = v;
  for (std::int64_t& component : result)
    component =
        static_cast<std::int64_t>(static_cast<std::uint64_t>(component) << (64 - bits)) >> (64 - bits);
  return result;
}

// A line: object, normalize, defined, positional, spot, lit, above; clocks, first, second, cone, complete.
// All combinations; those of an ambient processor are lit.
void write_shading_sequence(const Folder& folder) {
  write_units(
      folder, c_all,
      []<class Preset>(const Processor&, const Abilities<Preset>& can, Random&, VectorFile& file) {
        for (unsigned i = 0; i < 128; ++i) {
          const auto bit = [&](unsigned at) { return (i >> at & 1) != 0; };
          const Object o{bit(0), bit(1), bit(2), bit(3), bit(4), bit(5), bit(6)};
          if (!can.of_light() && !o.lit) continue;
          const Path path = path_of(can, o);
          for (unsigned at = 0; at < 7; ++at) file.flag(bit(at));
          file.word(path.clocks, 32).flag(path.first).flag(path.second).flag(path.cone).flag(path.complete);
          file.end_vector();
        }
      });
}

// A line: object, defined, token, unit vectors 1 and 2, products; the token in the next clock, and at the
// end.
void write_token_register(const Folder& folder) {
  write_units(
      folder, c_all,
      []<class Preset>(const Processor& p, const Abilities<Preset>& can, Random& random, VectorFile& file) {
        TokenMaker<Preset> maker(p.config, random.bits(32));
        const golden::AmbientTerm<Preset> ambient(p.config);
        for (int i = 0; i < c_lines; ++i) {
          Words<Preset> w(maker, p);
          const bool object = !random.one_in(8), defined = !random.one_in(4);
          auto taken = w.token, last = w.token;
          if (object && p.term == Term::ambient) {
            ambient.ready_vectors(last);
            if (!can.first || !taken.normalize) taken.normal = last.normal;
            taken.radiance.fill(golden::ShadingToken<Preset>::c_first_radiance);
            last.radiance = taken.radiance;
          }
          // The unit vectors are those of N and the view vector, or any.
          Axes units[] = {last.normal, last.view};
          if (!object || !can.first || !last.normalize)
            units[0] = random_axes(random, Preset::c_direction_bits);
          if (!object || !can.second) units[1] = random_axes(random, Preset::c_direction_bits);
          Axes products{};
          for (std::size_t c = 0; c < static_cast<std::size_t>(p.config.channels); ++c) {
            std::uint64_t term = random.word(Preset::c_reflected_bits + Preset::c_weight_bits);
            products[c] = static_cast<std::int64_t>(term);
            if (p.term == Term::ambient) {
              products[c] = reflections(p, w)[c];
              term = golden::reflected_term<Preset>(w.token.ambient[c], w.light.intensity[c],
                                                    golden::c_full_weight<Preset>);
            }
            if (object && defined) last.radiance[c] = golden::radiance_sum<Preset>(last.radiance[c], term);
          }
          file.flag(object).flag(defined);
          add(file, w.token_words);
          for (const Axes& unit : units) add(file, unit, Preset::c_direction_bits);
          add(file, products, Preset::c_reflected_bits + Preset::c_weight_bits);
          for (const auto& token : {taken, last}) {
            auto words = w.token_words;
            token.encode(p.config, words.words);
            add(file, words);
          }
          file.end_vector();
        }
      });
}

// A line: step (0 none, 1 and 2 a sum, 3 and 4 a unit vector), positional, token, light, products, unit
// vector; of sum, L and H, before the edge, whether each is known, and each.
void write_shared_adder(const Folder& folder) {
  write_units(
      folder, c_of_light,
      []<class Preset>(const Processor& p, const Abilities<Preset>& can, Random& random, VectorFile& file) {
        constexpr bool c_exact = Abilities<Preset>::c_exact;
        constexpr int c_place_bits = Preset::c_light_place_bits + Preset::c_vector_bits;
        TokenMaker<Preset> maker(p.config, random.bits(32));
        std::optional<Axes> sum, units[2];
        for (int i = 0; i < c_lines; ++i) {
          const Words<Preset> w(maker, p);
          const auto& light = w.light;
          const bool positional = random.one_in(2);
          const auto step = random.between(0, 4);
          const Axes unit = random_axes(random, Preset::c_direction_bits);
          // L and H of this clock
          std::optional<Axes> to_light = golden::light_vector<Preset>(false, light.place, 0, {}, 0);
          if (can.first && positional) to_light = units[0];
          std::optional<Axes> half;
          if (can.second && (c_exact || positional))
            half = units[1];
          else if (can.term == Term::specular)
            half = light.half;
          const std::int64_t distance =
              random.one_in(4) ? signed_word(random, Preset::c_vector_bits) : w.token.distance;
          const Axes products = golden::vector_multiply(light.place, distance);
          const bool works =
              step == 0 || (step % 2 == 1 ? can.first : can.second && (step == 4 || !c_exact || to_light));
          file.word(works ? static_cast<std::uint64_t>(step) : 0, 32).flag(positional);
          add(file, w.token_words);
          add(file, w.light_words);
          add(file, products, c_place_bits);
          add(file, unit, Preset::c_direction_bits);
          const auto known = [&](const std::optional<Axes>& v, int bits) {
            file.flag(v.has_value());
            add(file, v.value_or(Axes{}), bits);
          };
          known(sum, normalized_bits(can));
          known(to_light, Preset::c_direction_bits);
          known(half, Preset::c_direction_bits);
          file.end_vector();
          // Registers after the edge
          if (!works || step == 0) continue;
          if (step >= 3) {
            units[step - 3] = unit;
            continue;
          }
          const Axes way = golden::light_offset<Preset>(light.place, light.shift, w.token.place, distance);
          sum = way;
          if (step == 2)
            for (std::size_t axis = 0; axis < way.size(); ++axis)
              (*sum)[axis] = c_exact ? (*to_light)[axis] + w.token.view[axis] : way[axis] + light.half[axis];
          sum = wrapped(*sum, normalized_bits(can));
        }
      });
}

// A line: product (0 k I, 1 and 2 vector times 1/sqrt, 3 place times distance, 4 weight times factor, 5 k I
// times weight; dot products: 6 N and A, 7 and 8 the shifted vector, 9 L and the axis, 10 N and L), token,
// light, shifted vector, N, L, H, 1/sqrt, weight, factor; the number of known components of the product that
// is due, and its components in 64 bits; whether the dot product that is due is known, and this product.
void write_shared_multiplier(const Folder& folder) {
  write_units(
      folder, c_all,
      []<class Preset>(const Processor& p, const Abilities<Preset>& can, Random& random, VectorFile& file) {
        TokenMaker<Preset> maker(p.config, random.bits(32));
        struct Product {
          std::int64_t step = -1;
          Axes components{};
          int known = 0;  // components
          std::optional<Words<Preset>> words{};
        };
        golden::DelayLine<Product> products(Abilities<Preset>::c_exact ? 2 : 1);
        golden::DelayLine<std::optional<std::int64_t>> dots(Abilities<Preset>::c_exact ? 3 : 1);
        for (int i = 0; i < c_lines; ++i) {
          const Words<Preset> w(maker, p);
          const Axes shifted = random_axes(random, Preset::c_direction_bits);
          const auto [normal, to_light] = random_directions<Preset>(random);
          const Axes half = random_axes(random, Preset::c_direction_bits);
          const auto root = static_cast<std::int64_t>(random.word(Preset::c_root_bits + 1));
          const auto weight = static_cast<std::uint32_t>(random.word(Preset::c_weight_bits));
          const auto factor = static_cast<std::uint32_t>(random.word(Preset::c_weight_bits));
          const Product due = products.full() ? products.delayed() : Product{};
          const bool can_do[] = {true,
                                 can.first,
                                 can.second,
                                 can.positional && Abilities<Preset>::c_exact,
                                 can.spots,
                                 can.of_light() && due.step == 0,
                                 can.of_light(),
                                 can.first,
                                 can.second,
                                 can.spots,
                                 can.term == Term::specular && Abilities<Preset>::c_exact};
          auto step = random.between(0, 10);
          while (!can_do[step]) step = random.between(0, 10);
          file.word(step, 32);
          // In the clock of a cone's axis, the light is no spot.
          if (step == 9 && !w.light.spot) step = 0;
          add(file, w.token_words);
          add(file, w.light_words);
          for (const Axes& v : {shifted, normal, to_light, half}) add(file, v, Preset::c_direction_bits);
          file.word(root, Preset::c_root_bits + 1);
          file.word(weight, Preset::c_weight_bits).word(factor, Preset::c_weight_bits);
          file.word(due.known, 32);
          for (const std::int64_t component : due.components) file.word(component, 64);
          const bool known = dots.full() && dots.delayed();
          file.flag(known).word(known ? *dots.delayed() : 0, 2 * Preset::c_direction_bits + 1).end_vector();
          const bool colour = step == 0 || step == 5;
          Product now{step, {}, colour ? p.config.channels : step == 4 ? 1 : 3, w};
          std::optional<std::int64_t> sum;
          const auto multiply = [&](const Axes& a, const Axes& b) {
            for (std::size_t axis = 0; axis < a.size(); ++axis) now.components[axis] = a[axis] * b[axis];
            sum = golden::dot_product(a, b);
          };
          switch (step) {
            case 1:
            case 2:
              now.components = golden::vector_multiply(shifted, root);
              break;
            case 3:
              now.components = golden::vector_multiply(w.light.place, w.token.distance);
              break;
            case 4:
              now.components = {std::int64_t{weight} * factor, 0, 0};
              break;
            case 5:
              for (std::size_t c = 0; c < static_cast<std::size_t>(now.known); ++c) {
                const auto& k =
                    p.term == Term::diffuse ? due.words->token.diffuse : due.words->token.specular;
                now.components[c] = static_cast<std::int64_t>(
                    golden::reflected_term<Preset>(k[c], due.words->light.intensity[c], weight));
              }
              break;
            case 6:
              multiply(normal, can.term == Term::specular ? half : to_light);
              break;
            case 7:
            case 8:
              multiply(shifted, shifted);
              break;
            case 9:
              multiply(to_light, w.light.axis);
              break;
            case 10:
              multiply(normal, to_light);
              break;
            default:
              now.components = reflections(p, w);
          }
          products.step(now);
          dots.step(sum);
        }
      });
}

// A line: step (0 none, 1 and 2 shift), vector, dot product, products; whether the shifted vector is known,
// and the shifted vector; the same of 1/sqrt; the unit vector.
void write_shared_normalizer(const Folder& folder) {
  write_units(
      folder, c_normalizing,
      []<class Preset>(const Processor&, const Abilities<Preset>& can, Random& random, VectorFile& file) {
        constexpr int c_scaled_bits = Preset::c_direction_bits + Preset::c_root_bits + 2;
        const int bits = normalized_bits(can);
        std::optional<Axes> shifted;
        golden::DelayLine<std::uint32_t> roots(Abilities<Preset>::c_exact ? 7 : 1);
        for (int i = 0; i < c_lines; ++i) {
          const auto step = random.one_in(2) ? 0 : can.first && (!can.second || random.one_in(2)) ? 1 : 2;
          const Axes vector = random_axes(random, bits);
          // A dot product and products as they come of other vectors
          const Axes u = shifted_of<Preset>(random_axes(random, bits), bits);
          const std::int64_t dot = golden::dot_product(u, u);
          const std::uint32_t root = golden::ReciprocalRoot<Preset>::reciprocal(square_of<Preset>(dot));
          const Axes products = golden::vector_multiply(u, root);
          Axes unit = products;
          for (std::int64_t& component : unit)
            component =
                golden::round_half_up(component, Preset::c_direction_bits - 1 + Preset::c_root_fraction_bits -
                                                     Preset::c_direction_fraction_bits);
          file.word(step, 32);
          add(file, vector, bits);
          file.word(dot, 2 * Preset::c_direction_bits + 1);
          add(file, products, c_scaled_bits);
          file.flag(shifted.has_value());
          add(file, shifted.value_or(Axes{}), Preset::c_direction_bits);
          file.flag(roots.full()).word(roots.full() ? roots.delayed() : 0, Preset::c_root_bits + 1);
          add(file, unit, Preset::c_direction_bits);
          file.end_vector();
          if (step != 0) shifted = shifted_of<Preset>(vector, bits);
          roots.step(root);
        }
      });
}

// A line: spot, outer, slope, exponent, the dot products of N and A and of L and the axis, weight times
// factor; weight of the cosine, factor, weight of the term.
void write_shared_weight(const Folder& folder) {
  write_units(
      folder, c_of_light,
      []<class Preset>(const Processor&, const Abilities<Preset>& can, Random& random, VectorFile& file) {
        constexpr int c_dot_bits = 2 * Preset::c_direction_bits + 1;
        for (int i = 0; i < c_lines; ++i) {
          const auto [normal, a] = random_directions<Preset>(random);
          auto [to_light, axis] = random_directions<Preset>(random);
          if (!random.one_in(4))
            for (std::int64_t& component : axis) component = ~component;
          const bool spot = can.spots && !random.one_in(3);
          const auto outer = static_cast<std::int64_t>(random.bits(Preset::c_direction_fraction_bits));
          const auto slope = static_cast<std::uint32_t>(
              random.one_in(2) ? random.bits(10) : random.word(Preset::c_spot_slope_bits));
          const auto exponent =
              static_cast<std::uint32_t>(random.one_in(3) ? random.word(Preset::c_exponent_bits)
                                                          : static_cast<std::uint64_t>(random.between(1, 100))
                                                                << Preset::c_exponent_fraction_bits);
          const std::uint32_t raised = can.term == Term::diffuse
                                           ? golden::cosine_weight<Preset>(normal, a)
                                           : golden::cosine_power<Preset>(normal, a, exponent);
          const std::int64_t axis_sum = golden::dot_product(to_light, axis);
          const std::uint32_t factor = golden::SpotCone<Preset>::factor(axis_sum, outer, slope);
          file.flag(spot).word(outer, Preset::c_direction_bits);
          file.word(slope, Preset::c_spot_slope_bits).word(exponent, Preset::c_exponent_bits);
          file.word(golden::dot_product(normal, a), c_dot_bits);
          file.word(axis_sum, c_dot_bits);
          file.word(std::uint64_t{raised} * factor, 2 * Preset::c_weight_bits);
          file.word(raised, Preset::c_weight_bits).word(factor, Preset::c_weight_bits);
          file.word(spot ? golden::light_weight<Preset>(raised, to_light, axis, outer, slope) : raised,
                    Preset::c_weight_bits);
          file.end_vector();
        }
      });
}

}  // namespace

std::vector<Entity> folded_entities() {
  return {
      {"shading_sequence", write_shading_sequence},   {"token_register", write_token_register},
      {"shared_adder", write_shared_adder},           {"shared_multiplier", write_shared_multiplier},
      {"shared_normalizer", write_shared_normalizer}, {"shared_weight", write_shared_weight},
  };
}

}  // namespace halfway::vectors
