// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "golden/shading_pipeline.hpp"
#include "sim/files/vector_file.hpp"
#include "vectors/entities.hpp"
#include "vectors/pipeline.hpp"
#include "vectors/processor_list.hpp"
#include "vectors/random.hpp"
#include "vectors/token_maker.hpp"

namespace halfway::vectors {
namespace {

using golden::Axes, words::Command, words::Exact, words::ProcessorsConfig, words::Published, words::Term;

// More shadow polygons of one column than its count can represent.
constexpr int c_too_many = (1 << (Exact::c_shadow_count_bits - 1)) + 8;

// The clocks in which an unrolled processor takes its tokens at full speed. Clock 0 takes the first one.
class TakeClock {
 public:
  TakeClock(const Processor& processor, int latency) : processor_(processor), latency_(latency) {}

  template <class Token>
  std::int64_t take(const Token& token) {
    const bool own = token.light_number == static_cast<std::uint32_t>(processor_.light);
    // A token that changes the light waits until the stages are empty.
    if (own && (token.is_define() || token.command == Command::remove) && taken_ >= 0)
      next_ = std::max(next_, taken_ + latency_ + 1);
    taken_ = next_++;
    if (!processor_.config.shadows || processor_.term == Term::ambient) return taken_;
    if (own && token.command == Command::shadow) last_ = std::max(last_, token.x);
    if (token.command == Command::new_frame) {
      next_ += last_ + 1;  // the counter clears its columns
      last_ = 0;
    }
    return taken_;
  }

 private:
  Processor processor_;
  int latency_;
  std::int64_t taken_ = -1, next_ = 0;
  std::uint32_t last_ = 0;  ///< the highest column that was counted
};

// A line: token; the output token, fault afterwards, the clock in which an unrolled processor takes the
// token.
template <class Preset>
void write_processor(const Folder& folder, const Processor& processor, int tokens, bool faults,
                     const char* suffix = "", int latency = 0) {
  const auto& [config, term, light] = processor;
  const int bits = words::ProcessorsLayout<Preset>(config).token_bits();
  TokenMaker<Preset> maker(config, bits * 8 + static_cast<int>(term) * 3 + light);
  golden::ShadingProcessor<Preset> twin(config, term, light);
  TakeClock clock(processor, latency);
  VectorFile file;
  // At the end, with faults: more volumes than the counter can count.
  const int last = tokens + (faults ? c_too_many : 0);
  for (int done = 0; done < last; ++done) {
    // No light is valid at first. Later the light is defined, and defined again after it was deleted.
    const bool defines = done == 20 || (done > 20 && done % 25 == 0);
    auto token = done >= tokens ? maker.opening(static_cast<std::uint32_t>(light))
                 : defines      ? maker.load(Command::define, static_cast<std::uint32_t>(light))
                                : maker.token(light);
    if (term != Term::ambient) token = maker.behind_ambient(token);
    auto words = maker.words(token, bits);
    // The bits of x in a load sometimes name a column with shadow polygons. In a definition they are slope.
    const bool loads = !token.is_object() && token.command != Command::shadow;
    const bool own = token.light_number == static_cast<std::uint32_t>(light);
    if (loads && maker.random().one_in(own && token.is_define() ? 8 : 2))
      words::set_bits(words, Preset::pixel_header_at::x,
                      static_cast<std::uint64_t>(maker.random().between(40, 42)));
    const auto before = words;
    twin.process(words);
    file.words_of(before, bits).words_of(words, bits).flag(twin.fault());
    if (latency > 0) file.word(clock.take(token), 32);
    file.end_vector();
  }
  if (faults && config.shadows && !twin.fault())
    throw Failure{tool_failed(name_of<Preset>(processor) + ": the shadow counter did not overflow")};
  file.write(folder / (name_of<Preset>(processor) + suffix + ".txt"));
}

template <class Preset>
void write_processors(const Folder& folder, int tokens) {
  for (const Processor& processor : processors()) {
    const bool faults = processor.light == 1 && processor.term == Term::diffuse;
    write_processor<Preset>(folder, processor, tokens, faults);
  }
}

// More tokens, for the netlists of tb/mutants/designs.toml: they are quicker than the testbenches.
template <class Preset>
void write_long(const Folder& folder) {
  struct Long {
    std::string_view name;
    int latency;  ///< of the unrolled form
  };
  constexpr Long c_sets[] = {{"exact_31111111_00", 18},
                             {"exact_31111111_13", 35},
                             {"published_30101110_21", 21},
                             {"published_31001100_21", 13}};
  for (const Processor& processor : processors())
    for (const Long& set : c_sets)
      if (name_of<Preset>(processor) == set.name)
        write_processor<Preset>(folder, processor, 8000, false, "_long", set.latency);
}

// Tokens for the parts of a processor: one configuration with several lights.
const ProcessorsConfig& part_config() {
  static const ProcessorsConfig c_config{3, 1, 1, 1, true, true, true, true};
  return c_config;
}
constexpr int c_light_tokens = 60, c_lights = 30;

template <class Preset>
Flat flat_terms(const golden::Terms& terms) {
  Flat all;
  for (const std::uint64_t term : terms) all.add(term, Preset::c_reflected_bits + Preset::c_weight_bits);
  return all;
}

// Inputs: light, token; terms, the unit vector of N, the view vector (published: 0).
template <class Preset>
void write_ambient_term_of(const Folder& folder) {
  constexpr bool c_exact = words::ProcessorsLayout<Preset>::c_exact;
  const int bits = words::ProcessorsLayout<Preset>(part_config()).token_bits();
  TokenMaker<Preset> maker(part_config(), 5);
  const golden::AmbientTerm<Preset> twin(part_config());
  Pipeline pipeline(c_exact ? 15 : 7);
  golden::ShadingLight light;
  Flat light_bits;
  for (int done = 0; done < c_lights * c_light_tokens; ++done) {
    if (done % c_light_tokens == 0) {
      light = maker.load(Command::define, 0).light;
      light_bits = light_words(maker, part_config(), light);
      pipeline.restart();
    }
    auto token = maker.object();
    const auto words = maker.words(token, bits);
    Flat result = flat_terms<Preset>(twin.terms(token, light));
    token.normalize = true;
    twin.ready_vectors(token);
    for (const Axes& v : {token.normal, c_exact ? token.view : Axes{}})
      for (const std::int64_t component : v) result.add(component, Preset::c_direction_bits);
    pipeline.clock({light_bits, flat(words, bits)}, result);
  }
  pipeline.write(folder / fmt::format("{}.txt", Preset::c_name));
}

// Inputs: light, token; above, terms (0 if the light is not above the horizon).
template <class Preset>
void write_light_term_of(const Folder& folder, Term term, int light_number, int latency) {
  const int bits = words::ProcessorsLayout<Preset>(part_config()).token_bits();
  TokenMaker<Preset> maker(part_config(), latency);
  const golden::LightTerm<Preset> twin(part_config(), term, light_number);
  Pipeline pipeline(latency);
  golden::ShadingLight light;
  Flat light_bits;
  for (int done = 0; done < c_lights * c_light_tokens; ++done) {
    if (done % c_light_tokens == 0) {
      light = maker.load(Command::define, 0).light;
      light_bits = light_words(maker, part_config(), light);
      pipeline.restart();
    }
    const auto token = maker.behind_ambient(maker.object());
    const auto words = maker.words(token, bits);
    const auto terms = twin.terms(token, light);
    Flat result(terms.has_value(), 1);
    for (const std::uint64_t t : terms.value_or(golden::Terms{}))
      result.add(t, Preset::c_reflected_bits + Preset::c_weight_bits);
    pipeline.clock({light_bits, flat(words, bits)}, result);
  }
  pipeline.write(folder / fmt::format("{}_{}{}.txt", Preset::c_name, static_cast<int>(term), light_number));
}

// A line: token; object, changes; after the token was accepted: defined, light (valid if defined), lit (valid
// if object and defined), fault.
template <class Preset>
void write_light_state_of(const Folder& folder) {
  constexpr int c_tokens = 1500;
  constexpr std::uint32_t c_light = 2;
  const int bits = words::ProcessorsLayout<Preset>(part_config()).token_bits();
  TokenMaker<Preset> maker(part_config(), 6);
  golden::LightState<Preset> twin(true, c_light);
  VectorFile file;
  for (int done = 0; done < c_tokens + c_too_many; ++done) {
    const auto token = done < c_tokens ? maker.token(static_cast<int>(c_light)) : maker.opening(c_light);
    const auto words = maker.words(token, bits);
    const bool changes =
        token.light_number == c_light && (token.is_define() || token.command == Command::remove);
    bool lit = true;
    if (token.is_object())
      lit = twin.take_object(golden::ShadingToken<Preset>::decode(part_config(), words));
    else
      twin.take(token);
    const Flat light = light_words(maker, part_config(), twin.light());
    file.words_of(words, bits).flag(token.is_object()).flag(changes).flag(twin.defined());
    file.words_of(light.words, light.bits).flag(lit).flag(twin.fault()).end_vector();
  }
  file.write(folder / fmt::format("{}.txt", Preset::c_name));
}

// A line: token, comes; the output object (valid if comes), fault afterwards.
template <class Preset>
void write_pipeline(const Folder& folder, const ProcessorsConfig& config, bool faults, int tokens) {
  const int bits = words::ProcessorsLayout<Preset>(config).token_bits();
  TokenMaker<Preset> maker(config, bits);
  golden::ShadingPipeline<Preset> twin(config);
  VectorFile file;
  const int last = tokens + (faults ? c_too_many : 0);
  for (int done = 0; done < last; ++done) {
    const int light = static_cast<int>(maker.random().between(0, config.lights()));
    // Define all lights first.
    auto token = done >= tokens            ? maker.opening(static_cast<std::uint32_t>(config.lights()))
                 : done <= config.lights() ? maker.load(Command::define, static_cast<std::uint32_t>(done))
                                           : maker.token(light);
    auto words = maker.words(token, bits);
    token = golden::ShadingToken<Preset>::decode(config, words);
    const bool comes = twin.process(token);
    file.words_of(words, bits).flag(comes);
    if (comes) token.encode(config, words);
    file.words_of(words, bits).flag(twin.fault()).end_vector();
  }
  file.write(folder / (name_of<Preset>(config) + ".txt"));
}

template <class Preset>
void write_pipelines(const Folder& folder, int tokens, bool faults) {
  // The list of tb/rtl/shaders/shading_pipeline_tb.vhd.
  const ProcessorsConfig configs[] = {{3, 1, 1, 1, true, true, true, true},
                                      {3, 2, 0, 0, true, true, false, false},
                                      {1, 0, 1, 1, false, true, true, false},
                                      {3, 0, 0, 0, false, false, true, false}};
  for (const ProcessorsConfig& config : configs)
    write_pipeline<Preset>(folder, config, faults && config.shadows, tokens);
}

void write_light_term(const Folder& folder) {
  struct Case {
    Term term;
    int light, exact, published;  // clocks
  };
  // A directional light, a positional light, a spot. The list of tb/vectors/rows.toml.
  constexpr Case c_cases[] = {{Term::diffuse, 1, 6, 4},   {Term::specular, 1, 32, 10},
                              {Term::diffuse, 2, 24, 12}, {Term::specular, 2, 50, 18},
                              {Term::diffuse, 3, 32, 20}, {Term::specular, 3, 51, 20}};
  for (const Case& c : c_cases) {
    write_light_term_of<Exact>(folder, c.term, c.light, c.exact);
    write_light_term_of<Published>(folder, c.term, c.light, c.published);
  }
}

// A line: reset, step, clear, counts, opens, takes, x, around_eye for the previous column, clocks until
// ready; then, before the edge: counted, lit (valid if counted), fault.
void write_shadow_counter(const Folder& folder) {
  constexpr int c_columns = 1 << Exact::c_pixel_x_bits;
  constexpr int c_most = (1 << (Exact::c_shadow_count_bits - 1)) - 1;
  Random random(9);
  VectorFile file;
  golden::ShadowCounter twin;
  std::uint32_t last = 0;   // highest column counted since the last clear
  std::uint32_t waits = 0;  // clocks until ready
  bool counted = false;     // the last step was for a column
  int around_eye = 0;       // constant until the next step
  bool lit = false;
  bool fault = false;  // visible two clocks after the step
  // Choose around_eye for a column with count `held`: often the greatest value with which the object is lit,
  // else one next to it or any.
  const auto choose_light = [&](int held) {
    around_eye = random.one_in(4)
                     ? static_cast<int>(random.between(-c_most - 1, c_most))
                     : std::clamp(static_cast<int>(random.between(-1, 1)) - held, -c_most, c_most);
    if (random.one_in(2)) around_eye = std::clamp(-held, -c_most, c_most);
    lit = held + around_eye <= 0;
  };
  const auto line = [&](bool reset, bool step, bool clear, bool counts, bool opens, bool takes,
                        std::uint32_t x) {
    const bool stepped = step && !reset;
    file.flag(reset).flag(step).flag(clear).flag(counts).flag(opens).flag(takes);
    file.word(x, Exact::c_pixel_x_bits);
    file.word(around_eye, Exact::c_shadow_count_bits).word(reset ? 0 : waits, 32);
    if (waits > 0 && !reset) fault = twin.fault();
    file.flag(counted).flag(lit).flag(fault).end_vector();
    if (!reset) waits = 0;
    fault = twin.fault();
    if (stepped) {
      counted = counts || takes;
      choose_light(twin.held(x));
      if (clear) {
        twin.clear();
        waits = last + 1;
        last = 0;
      } else if (takes) {
        twin.take(x, around_eye);
      } else if (counts) {
        twin.count(x, opens);
        last = x > last ? x : last;
      }
    }
    if (reset) {
      twin = golden::ShadowCounter();
      waits = c_columns;
      last = 0;
      counted = fault = false;
    }
  };
  line(true, false, false, false, false, false, 0);
  line(true, false, false, false, false, false, 0);
  for (std::uint32_t x = 0; x < c_columns; ++x) line(false, true, false, false, false, true, x);
  for (int i = 0; i < 12000; ++i) {
    const int part = i / 1500;
    if (i % 3000 == 2999) {
      line(true, random.one_in(2), false, true, true, false, 0);
      continue;
    }
    // Use few columns, so that they repeat soon. Two of them count beyond each end, each in its own part.
    const int first = part < 4 ? 100 : 101;
    const auto x = static_cast<std::uint32_t>(random.one_in(8) ? random.between(0, c_columns - 1)
                                                               : random.between(first, first + part % 3));
    const bool step = part % 2 == 0 || !random.one_in(3);
    const bool far = part % 4 >= 2;
    const bool opens = far ? (x % 2 == 0) == (random.between(0, 15) != 0) : random.one_in(2);
    const bool clear = !far && random.one_in(400);
    const bool takes = !clear && random.one_in(far ? 3000 : 4);
    line(false, step, clear, !clear && !takes && !random.one_in(10), opens, takes, x);
  }
  // Count one column up to its limit, which is not a fault, and beyond it, with steps around that do not
  // count.
  for (const bool opens : {true, false}) {
    line(true, false, false, false, false, false, 0);
    for (int i = 0; i < (opens ? c_most : c_most + 1); ++i) line(false, true, false, true, opens, false, 100);
    for (const bool counts : {false, false, true, false, false})
      line(false, true, false, counts, opens, false, 100);
  }
  for (int i = 0; i < 3; ++i) line(false, false, false, false, false, false, 0);
  file.write(folder / "columns.txt");
}

template <int divisor>
void write_shading_processor(const Folder& folder) {
  constexpr int c_tokens = 280 / divisor;
  write_processors<Exact>(folder, c_tokens);
  write_processors<Published>(folder, c_tokens);
  if (divisor > 1) return;
  write_long<Exact>(folder);
  write_long<Published>(folder);
}

template <int divisor>
void write_shading_pipeline(const Folder& folder) {
  constexpr int c_tokens = 240 / divisor;
  // A fault needs many tokens. The testbenches of processors have it too.
  constexpr bool c_faults = divisor == 1;
  write_pipelines<Exact>(folder, c_tokens, c_faults);
  write_pipelines<Published>(folder, c_tokens, c_faults);
}

}  // namespace

std::vector<Entity> processors_entities() {
  return {
      {"shadow_counter", write_shadow_counter},
      {"ambient_term", in_both_presets([]<class P>(const Folder& f) { write_ambient_term_of<P>(f); })},
      {"light_term", write_light_term},
      {"light_state", in_both_presets([]<class P>(const Folder& f) { write_light_state_of<P>(f); })},
      {"shading_processor", write_shading_processor<1>},
      {"unrolled_shading_processor", write_shading_processor<1>},
      {"short/unrolled_shading_processor", write_shading_processor<c_short>},
      {"shading_pipeline", write_shading_pipeline<1>},
      {"short/shading_pipeline", write_shading_pipeline<c_short>},
  };
}

}  // namespace halfway::vectors
