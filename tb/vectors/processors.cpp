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
    return taken_ = next_++;
  }

 private:
  Processor processor_;
  int latency_;
  std::int64_t taken_ = -1, next_ = 0;
};

// A line of _in: token, the clock in which an unrolled processor takes it. A line of _out: the output token.
template <class Preset>
void write_processor(const Folder& folder, const Processor& processor, int tokens, const char* suffix = "",
                     int latency = 0) {
  const auto& [config, term, light] = processor;
  const int bits = words::ProcessorsLayout<Preset>(config).token_bits();
  TokenMaker<Preset> maker(config, bits * 8 + static_cast<int>(term) * 3 + light);
  golden::ShadingProcessor<Preset> twin(config, term, light);
  TakeClock clock(processor, latency);
  VectorFile in, out;
  for (int done = 0; done < tokens; ++done) {
    // No light is valid at first. Later the light is defined, and defined again after it was deleted.
    const bool defines = done == 20 || (done > 20 && done % 25 == 0);
    auto token =
        defines ? maker.load(Command::define, static_cast<std::uint32_t>(light)) : maker.token(light);
    if (term != Term::ambient) token = maker.behind_ambient(token);
    auto words = maker.words(token, bits);
    in.words_of(words, bits);
    if (latency > 0) in.word(clock.take(token), 32);
    in.end_vector();
    twin.process(words);
    out.words_of(words, bits).end_vector();
  }
  in.write(folder / (name_of<Preset>(processor) + suffix + "_in.txt"));
  out.write(folder / (name_of<Preset>(processor) + suffix + "_out.txt"));
}

template <class Preset>
void write_processors(const Folder& folder, int tokens) {
  for (const Processor& processor : processors()) write_processor<Preset>(folder, processor, tokens);
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
        write_processor<Preset>(folder, processor, 16000, "_long", set.latency);
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
void write_light_term_of(const Folder& folder, Term term, int light_number, int latency, int lights) {
  const int bits = words::ProcessorsLayout<Preset>(part_config()).token_bits();
  TokenMaker<Preset> maker(part_config(), latency);
  const golden::LightTerm<Preset> twin(part_config(), term, light_number);
  Pipeline pipeline(latency);
  golden::ShadingLight light;
  Flat light_bits;
  for (int done = 0; done < lights * c_light_tokens; ++done) {
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

// A line: reset, take, token; object, changes (valid if take), defined, light, lit (valid if defined), before
// the edge.
template <class Preset>
void write_light_state_of(const Folder& folder) {
  constexpr int c_tokens = 1500;
  constexpr int c_most = 300;  // volumes of a long list, at the end
  constexpr int c_pace = 100;  // number of tokens between changes of the pace
  constexpr std::uint32_t c_light = 2;
  const int bits = words::ProcessorsLayout<Preset>(part_config()).token_bits();
  TokenMaker<Preset> maker(part_config(), 6);
  golden::LightState<Preset> twin(true, c_light);
  VectorFile file;
  const auto clock = [&](bool reset, bool take, auto token) {
    const auto words = maker.words(token, bits);
    const bool changes =
        token.light_number == c_light && (token.is_define() || token.command == Command::remove);
    const Flat light = light_words(maker, part_config(), twin.light());
    file.flag(reset).flag(take).words_of(words, bits).flag(token.is_object()).flag(changes);
    file.flag(twin.defined()).words_of(light.words, light.bits).flag(twin.lit()).end_vector();
    if (take) twin.take(token);
    if (reset) twin = golden::LightState<Preset>(true, c_light);
  };
  for (int done = 0; done < c_tokens + 3 * c_most; ++done) {
    auto token = done < c_tokens ? maker.token(static_cast<int>(c_light)) : maker.shadow(c_light);
    if (done == c_tokens) token = maker.load(Command::define, c_light);
    if (done > c_tokens) token.opens = done <= c_tokens + c_most;
    while (done / c_pace % 2 == 1 && !maker.random().one_in(4)) clock(false, false, maker.token(c_light));
    clock(false, true, token);
  }
  clock(true, false, maker.token(c_light));
  clock(false, false, maker.token(c_light));
  file.write(folder / fmt::format("{}.txt", Preset::c_name));
}

// The last token of a pipeline's file.
struct Last {
  Command command;
  std::uint32_t light;
};

// A line of _in: token. A line of _out: object, fault at the end. Before `last` no token is for a light that
// does not exist.
template <class Preset>
void write_pipeline(const Folder& folder, const ProcessorsConfig& config, int tokens, const Last& last,
                    const char* suffix = "") {
  const int bits = words::ProcessorsLayout<Preset>(config).token_bits();
  TokenMaker<Preset> maker(config, bits);
  golden::ShadingPipeline<Preset> twin(config);
  VectorFile in, out;
  const auto lights = static_cast<std::uint32_t>(config.lights());
  for (int done = 0; done <= tokens; ++done) {
    // Define all lights first.
    auto token = static_cast<std::uint32_t>(done) <= lights
                     ? maker.load(Command::define, static_cast<std::uint32_t>(done))
                     : maker.token(static_cast<int>(maker.random().between(0, config.lights())));
    if (token.is_for_light()) token.light_number = std::min(token.light_number, lights);
    if (done == tokens) token = maker.load(last.command, last.light);
    auto words = maker.words(token, bits);
    token = golden::ShadingToken<Preset>::decode(config, words);
    in.words_of(words, bits).end_vector();
    if (!twin.process(token)) continue;
    token.encode(config, words);
    out.words_of(words, bits).flag(last.light > lights).end_vector();
  }
  in.write(folder / (name_of<Preset>(config) + suffix + "_in.txt"));
  out.write(folder / (name_of<Preset>(config) + suffix + "_out.txt"));
}

template <class Preset>
void write_pipelines(const Folder& folder, int tokens) {
  // The list of tb/vectors/rows.toml.
  const ProcessorsConfig configs[] = {{3, 1, 1, 1, true, true, true, true},
                                      {3, 2, 0, 0, true, true, false, false},
                                      {1, 0, 1, 1, false, true, true, false},
                                      {3, 0, 0, 0, false, false, true, false}};
  constexpr Command c_wrong[] = {Command::define, Command::redefine, Command::remove, Command::shadow};
  for (std::size_t i = 0; i < std::size(configs); ++i) {
    const auto lights = static_cast<std::uint32_t>(configs[i].lights());
    write_pipeline<Preset>(folder, configs[i], tokens, {Command::remove, lights});
    write_pipeline<Preset>(folder, configs[i], tokens, {c_wrong[i], lights + 1}, "_fault");
  }
}

// Each token and each bit that cause a fault, for the netlist of tb/mutants/designs.toml.
void write_pipeline_faults(const Folder& folder) {
  constexpr ProcessorsConfig c_config{3, 2, 0, 0, true, true, false, false};
  constexpr int c_tokens = 12;
  write_pipeline<Exact>(folder, c_config, c_tokens, {Command::define, 3}, "_define_fault");
  write_pipeline<Exact>(folder, c_config, c_tokens, {Command::redefine, 4}, "_redefine_fault");
  write_pipeline<Exact>(folder, c_config, c_tokens, {Command::remove, 8}, "_remove_fault");
  write_pipeline<Exact>(folder, c_config, c_tokens, {Command::shadow, 16}, "_shadow_fault");
}

template <int divisor>
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
    write_light_term_of<Exact>(folder, c.term, c.light, c.exact, c_lights / divisor);
    write_light_term_of<Published>(folder, c.term, c.light, c.published, c_lights / divisor);
  }
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
  write_pipelines<Exact>(folder, c_tokens);
  write_pipelines<Published>(folder, c_tokens);
  if (divisor == 1) write_pipeline_faults(folder);
}

}  // namespace

std::vector<Entity> processors_entities() {
  return {
      {"ambient_term", in_both_presets([]<class P>(const Folder& f) { write_ambient_term_of<P>(f); })},
      {"light_term", write_light_term<1>},
      {"short/light_term", write_light_term<c_short>},
      {"light_state", in_both_presets([]<class P>(const Folder& f) { write_light_state_of<P>(f); })},
      {"shading_processor", write_shading_processor<1>},
      {"short/shading_processor", write_shading_processor<c_short>},
      {"unrolled_shading_processor", write_shading_processor<1>},
      {"short/unrolled_shading_processor", write_shading_processor<c_short>},
      {"shading_pipeline", write_shading_pipeline<1>},
      {"short/shading_pipeline", write_shading_pipeline<c_short>},
  };
}

}  // namespace halfway::vectors
