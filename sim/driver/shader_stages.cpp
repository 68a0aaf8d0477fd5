// SPDX-License-Identifier: Apache-2.0
#include "sim/driver/shader_stages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <string_view>
#include <type_traits>
#include <utility>

#include "golden_run/shader_model.hpp"
#include "sim/driver/stream_comparator.hpp"

namespace halfway {
namespace {

using words::Exact, golden::SpanXWord;

constexpr const char* c_first_valid = "init_valid";
constexpr const char* c_first_ready = "init_ready";

// The entities on both sides of a register. A wrong value may be caused by either.
std::string within(std::string_view entity, std::string_view around) {
  return fmt::format("{}, or {} around it", entity, around);
}

constexpr WordFormat c_flag{};

// The table of a shader's stages: how to read each word in the golden model and in the RTL.
template <class GoldenShader>
class StagesOf : public ShaderStages {
 public:
  std::vector<GoldenEvent> draw(std::span<const std::uint32_t> init_words) override {
    std::vector<GoldenEvent> events;
    Watch watch{*this, events};
    const auto emit = [&](const Fragment& f) {
      const auto words = fields(f);
      events.push_back({stages_.size() - 1, f.triangle, f.y, f.x, {words.begin(), words.end()}});
    };
    for (auto triangle = take_triangle(shader_, init_words); !triangle.empty();
         triangle = take_triangle(shader_, init_words))
      shader_.draw(triangle, emit, watch);
    return events;
  }

 protected:
  using Golden = std::function<std::uint64_t(const GoldenShader&, SpanXWord)>;

  template <class... Config>
  explicit StagesOf(const Config&... config) : shader_(config...) {}

  void begin_stage(Stage stage) {
    stages_.push_back(std::move(stage));
    golden_.emplace_back();
  }
  void add(std::string name, WordFormat format, std::string entity, Golden golden, Signal signal) {
    stages_.back().words.push_back({std::move(name), format, std::move(entity), std::move(signal)});
    golden_.back().push_back(std::move(golden));
  }

  // Line and span stage of all shaders. The walker has preset Walk. `depth_clocks`: clocks from the walker's
  // strobes to the words of depth.
  template <class Walk>
  void add_line_stage(const std::string& around, int depth_clocks, const std::string& front = {}) {
    constexpr bool c_exact = std::is_same_v<Walk, Exact>;
    const std::string edges = within(c_exact ? "edge_walker" : "slope_walker", "triangle_walker");
    constexpr WordFormat c_x{Walk::c_span_x_bits, 0, true};
    // GHDL's netlist omits signals that are only for traces, but has the ports that drive them.
    const auto line_signal = [&](const char* field) {
      return Signal{.path = fmt::format("{}walker/line_{}", front, field),
                    .netlist_path = fmt::format("{}walker/next_line/line_{}", front, field)};
    };
    begin_stage({"line", "triangle_walker", {front + "span_load"}});
    add(
        "line_y", {Walk::c_pixel_y_bits}, within("triangle_walker", around),
        [](const auto& s, SpanXWord) { return s.walker().y(); }, line_signal("y"));
    add(
        "line_start", c_x, edges, [](const auto& s, SpanXWord) { return s.walker().start().bits(); },
        line_signal("start"));
    add(
        "line_stop", c_x, edges, [](const auto& s, SpanXWord) { return s.walker().stop().bits(); },
        line_signal("stop"));
    if constexpr (c_exact)
      add("line_carry", c_flag, edges, [](const auto& s, SpanXWord) { return s.walker().carry(); },
          {front + "line_carry"});
    add("line_z", c_depth<Walk>, within("z_interpolator", around),
        [](const auto& s, SpanXWord) { return s.depth().edge_value().bits(); },
        {front + "depth/depth/edge_value", 0, depth_clocks, depth_clocks > 0});
  }
  template <class Walk>
  void add_span_stage(const std::string& around, int depth_clocks, const std::string& front = {}) {
    begin_stage({"span", "triangle_walker", {front + "span_step"}});
    add("span_y", {Walk::c_pixel_y_bits}, within("triangle_walker", around),
        [](const auto& s, SpanXWord) { return s.walker().y(); }, {front + "y"});
    add("span_x", {Walk::c_span_x_bits, 0, true}, within("triangle_walker", around),
        [](const auto&, SpanXWord x) { return x.bits(); }, {front + "x"});
    add("span_z", c_depth<Walk>, within("z_interpolator", around),
        [](const auto& s, SpanXWord) { return s.depth().value().bits(); },
        {front + "depth/depth/span_value", 0, depth_clocks, depth_clocks > 0});
  }

  void add_fragment_stage(std::string_view colours) {
    constexpr std::array<const char*, 7> c_ports = {"triangle", "y", "x", "z", "red", "green", "blue"};
    constexpr std::array<int, 7> c_bits = {
        Exact::c_triangle_bits, Exact::c_pixel_y_bits, Exact::c_pixel_x_bits, Exact::c_depth_bits,
        Exact::c_colour_bits,   Exact::c_colour_bits,  Exact::c_colour_bits};
    begin_stage({"fragment", "the shader's output", {"fragment_valid", "fragment_ready"}});
    for (std::size_t i = 0; i < c_ports.size(); ++i)
      add(std::string(c_fragment_fields[i]), {c_bits[i]},
          i < 4 ? "the register after the shader" : fmt::format("{}, or the register after it", colours), {},
          {fmt::format("fragment_{}", c_ports[i])});
  }

 private:
  template <class Walk>
  static constexpr WordFormat c_depth{Walk::c_depth_sum_bits, Walk::c_depth_sum_fraction_bits, true};

  struct Watch {
    StagesOf& table;
    std::vector<GoldenEvent>& events;
    void line(const GoldenShader& shader) { add(shader, 0, shader.walker().start()); }
    // The registers of all stages that the pixel passes. Each shading processor reports separately.
    void span(const GoldenShader& shader, SpanXWord x) {
      constexpr bool c_alone = requires { shader.token(); };
      const std::size_t end = c_alone ? 2 : table.stages_.size() - 1;
      for (std::size_t stage = 1; stage < end; ++stage) add(shader, stage, x);
    }
    void processor(const GoldenShader& shader, SpanXWord x, int number) {
      add(shader, 2 + static_cast<std::size_t>(number), x);
    }

   private:
    void add(const GoldenShader& shader, std::size_t stage, SpanXWord x) {
      GoldenEvent event{stage,
                        shader.walker().triangle(),
                        shader.walker().y(),
                        static_cast<std::uint32_t>(words::low_bits(x.bits(), Exact::c_pixel_x_bits)),
                        {}};
      for (const Golden& word : table.golden_[stage]) event.words.push_back(word(shader, x));
      events.push_back(std::move(event));
    }
  };

  GoldenShader shader_;
  std::vector<std::vector<Golden>> golden_;  // in the order of the stages' words
};

// The walker's strobes reach the interpolators through registers. An interpolator's words are skewed: the
// lower half follows one clock after the strobe, the upper half one clock later.
template <class P, int Channels, int Degree>
class QuadraticStages final : public StagesOf<golden::QuadraticShader<P, Channels, Degree>> {
  using Shader = golden::QuadraticShader<P, Channels, Degree>;

 public:
  QuadraticStages() {
    const std::string shader = "quadratic_shader";
    this->template add_line_stage<P>(shader, 1);
    add_channels({{"edge_value", "edge_value", &Channel::edge_value}});
    if constexpr (Degree == 2)
      add_channels({{"edge_dx", "edge_dx", &Channel::edge_dx}, {"edge_de0", "edge_de0", &Channel::edge_de0}});
    if constexpr (Degree == 2 && std::is_same_v<P, Exact>)
      add_channels({{"edge_de1", "edge_de1", &Channel::edge_de1}});
    this->template add_span_stage<P>(shader, 1);
    add_channels({{"span_value", "span_value", &Channel::value}, {"span_dx", "span_dx", &Channel::dx}});
    this->add_fragment_stage("saturate");
  }

 private:
  using Channel = typename Shader::Channel;
  // The class that has the functions of the golden model's words.
  using Words = std::conditional_t<Degree == 1, golden::PlaneInterpolator<P::c_intensity_bits>, Channel>;
  struct Shown {
    const char *name, *signal;
    typename Words::Value (Words::*golden)() const;
  };
  void add_channels(const std::vector<Shown>& words) {
    for (int c = 0; c < Channels; ++c)
      for (const Shown& word : words)
        this->add(
            fmt::format("{} {}", channel_name(static_cast<unsigned>(c), Channels), word.name),
            {P::c_intensity_bits, P::c_intensity_fraction_bits, true},
            within(Degree == 1 ? "plane_interpolator" : "quadratic_interpolator", "quadratic_shader"),
            [c, golden = word.golden](const Shader& s, SpanXWord) { return (s.channel(c).*golden)().bits(); },
            {fmt::format("channels({})/colour/interpolator/{}", c, word.signal), 0, 1, true});
  }
};

// The slices use the walker's strobes directly. Each stage after the span has a fixed delay.
template <class P>
class SphericalStages final : public StagesOf<golden::SphericalShader<P>> {
  using Shader = golden::SphericalShader<P>;

 public:
  explicit SphericalStages(const words::SphericalConfig& config)
      : StagesOf<Shader>(config), config_(config), layout_(config) {
    const std::string shader = "spherical_shader";
    this->template add_line_stage<P>(shader, 1);
    this->template add_span_stage<P>(shader, 1);
    for_each_slice([&](const Slice& slice, auto golden) {
      this->add(slice.name + " angle", {P::c_angle_bits, P::c_angle_fraction_bits, true},
                within("line_interpolator", slice.entity),
                [golden](const Shader& s, SpanXWord) { return golden(s).angle().bits(); },
                {slice.path + "angle"});
    });
    this->begin_stage({"sample", "triangle_walker", {"span_step"}, 1});
    for_each_slice([&](const Slice& slice, auto golden) {
      this->add(slice.name + " in_range", c_flag, within("angle_address", slice.entity),
                [golden, light = slice.light](const Shader& s, SpanXWord) {
                  if constexpr (requires { golden(s).lit(); })
                    return golden(s).lit();
                  else
                    return golden(s).in_range(s.lit(light));
                },
                {slice.path + "in_range"});
      if (slice.channels > 0)
        this->add(slice.name + " sample", {config_.size.data_bits}, within("cosine_rom", slice.entity),
                  [golden](const Shader& s, SpanXWord) { return golden(s).sample(); },
                  {slice.path + slice.sample});
    });
    this->begin_stage({"product", "triangle_walker", {"span_step"}, 4});
    const int bits = P::c_factor_bits + config_.size.data_bits;
    for_each_slice([&](const Slice& slice, auto golden) {
      for (int c = 0; c < slice.channels; ++c)
        this->add(fmt::format("{} {}product", slice.name,
                              slice.channels == 1 ? "" : channel_name(static_cast<unsigned>(c), 3) + " "),
                  {bits, P::c_factor_fraction_bits + config_.size.data_bits},
                  within("multiplier", slice.entity),
                  [golden, c, light = slice.light](const Shader& s, SpanXWord) {
                    if constexpr (requires { golden(s).lit(); })
                      return golden(s).product(c);
                    else
                      return golden(s).product(c, s.lit(light));
                  },
                  {slice.path + "products", c * bits});
    });
    this->add_fragment_stage("saturating_sum");
  }

 private:
  struct Slice {
    std::string name, entity, path, sample;
    std::size_t light;
    int channels;
  };
  // Call use(slice, golden) for every light's slices. golden(shader) is the golden model of the slice.
  template <class Use>
  void for_each_slice(Use&& use) {
    for (int l = 0; l < config_.lights; ++l) {
      const auto light = static_cast<std::size_t>(l);
      if (layout_.has_diffuse_part())
        use(Slice{fmt::format("light {} diffuse", l + 1), "diffuse_slice",
                  fmt::format("lights({})/light/diffuse/slice/", l), "cosines/sample", light,
                  layout_.diffuse_channels()},
            [light](const Shader& s) -> const auto& { return s.diffuse(light); });
      if (config_.specular)
        use(Slice{fmt::format("light {} specular", l + 1), "specular_slice",
                  fmt::format("lights({})/light/specular/slice/", l), "sample", light,
                  config_.highlight_channels},
            [light](const Shader& s) -> const auto& { return s.specular(light); });
    }
  }

  words::SphericalConfig config_;
  words::SphericalLayout<P> layout_;
};

template <class P>
std::vector<std::string> names_of(const words::ProcessorsLayout<P>& layout) {
  std::vector<std::string> names;
  const auto add_axes = [&](const char* what) {
    for (const char* axis : {"x", "y", "z"}) names.push_back(fmt::format("{} {}", what, axis));
  };
  add_axes("N");
  if (layout.has_place()) add_axes(std::is_same_v<P, Exact> ? "view ray" : "P");
  if (layout.has_distance()) names.emplace_back("1/w");
  return names;
}

// No word is skewed. A token is read at the output of a processor.
template <class P>
class ProcessorsStages final : public StagesOf<golden::ProcessorsShader<P>> {
  using Shader = golden::ProcessorsShader<P>;

 public:
  ProcessorsStages(const words::ProcessorsConfig& config, bool folded)
      : StagesOf<Shader>(config), config_(config), folded_(folded) {
    const std::string around = "token_rasterizer", front = "in_front/rasterizer/";
    this->template add_line_stage<Exact>(around, 0, front);
    this->template add_span_stage<Exact>(around, 0, front);
    const words::ProcessorsLayout<P> layout(config);
    const std::vector<std::string> planes = names_of(layout);
    for (int p = 0; p < layout.planes(); ++p)
      this->add(planes[static_cast<std::size_t>(p)], {P::c_vector_bits, P::c_vector_fraction_bits, true},
                "plane_interpolator",
                [p](const Shader& s, SpanXWord) {
                  return words::low_bits(static_cast<std::uint64_t>(s.plane_value(p)), P::c_vector_bits);
                },
                {front + "vectors", p * P::c_vector_bits});
    add_processor("ambient");
    for (int light = 1; light <= config.lights(); ++light) {
      if (config.diffuse) add_processor(fmt::format("diffuse {}", light));
      if (config.specular) add_processor(fmt::format("specular {}", light));
    }
    this->add_fragment_stage("saturate");
  }

 private:
  void add_processor(std::string name) {
    using At = typename P::pixel_header_at;
    const std::string entity = folded_ ? "shading_processor" : "unrolled_shading_processor";
    const std::string path =
        fmt::format("pipeline/chain({})/form/{}/", this->stages_.size() - 2, folded_ ? "folded" : "unrolled");
    const Signal command{path + "out_token", At::command.low};
    this->begin_stage({std::move(name), entity, {path + "out_valid", path + "out_ready"}, 0, {}, command});
    this->add(
        "command", {At::command.bits}, "token_rasterizer",
        [](const Shader& s, SpanXWord) { return static_cast<std::uint64_t>(s.token().command); }, command);
    const words::ProcessorsLayout<P> layout(config_);
    for (int c = 0; c < config_.channels; ++c)
      this->add(channel_name(static_cast<unsigned>(c), static_cast<unsigned>(config_.channels)) + " so far",
                {P::c_radiance_bits, P::c_radiance_fraction_bits}, entity,
                [c](const Shader& s, SpanXWord) { return s.token().radiance[static_cast<std::size_t>(c)]; },
                {path + "out_token", layout.radiance_low(c)});
  }

  words::ProcessorsConfig config_;
  bool folded_;
};

class NoStages final : public ShaderStages {
 public:
  std::vector<GoldenEvent> draw(std::span<const std::uint32_t>) override { return {}; }
};

template <class P, int Degree>
std::unique_ptr<ShaderStages> make_quadratic(unsigned channels) {
  if (channels == 1) return std::make_unique<QuadraticStages<P, 1, Degree>>();
  return std::make_unique<QuadraticStages<P, 3, Degree>>();
}

template <class P>
std::unique_ptr<ShaderStages> make(const HardwareKey& key) {
  switch (key.shader) {
    case Shader::quadratic:
      if (key.degree == 1) return make_quadratic<P, 1>(key.channels);
      return make_quadratic<P, 2>(key.channels);
    case Shader::spherical:
      return std::make_unique<SphericalStages<P>>(golden_config(key));
    case Shader::processors:
      if (key.processors.objects > 0) return std::make_unique<NoStages>();
      return std::make_unique<ProcessorsStages<P>>(processors_config(key),
                                                   key.processors.form == ProcessorForm::folded);
  }
  return nullptr;
}

bool is_object(std::uint64_t command) {
  return command == static_cast<std::uint64_t>(words::Command::new_object);
}

}  // namespace

std::vector<std::string> plane_names(const HardwareKey& key) {
  const words::ProcessorsConfig config = processors_config(key);
  if (key.preset == Preset::exact) return names_of(words::ProcessorsLayout<Exact>(config));
  return names_of(words::ProcessorsLayout<words::Published>(config));
}

std::string channel_name(unsigned channel, unsigned channels) {
  static constexpr const char* c_colours[] = {"red", "green", "blue"};
  return channels == 1 ? "grey" : c_colours[channel];
}

std::set<TracedPart> ShaderStages::parts() const {
  std::set<TracedPart> parts;
  const auto add = [&](const Signal& signal, int bits) {
    parts.insert(
        {signal.path, signal.netlist_path.empty() ? signal.path : signal.netlist_path, signal.low, bits});
  };
  add({c_first_valid}, 1);
  add({c_first_ready}, 1);
  for (const Stage& stage : stages_) {
    for (const std::string& strobe : stage.strobes) add({strobe}, 1);
    for (const StageWord& word : stage.words) add(word.signal, word.format.bits);
    if (stage.command) add(*stage.command, stage.words.front().format.bits);
  }
  return parts;
}

std::vector<std::vector<RtlEvent>> ShaderStages::read(const SignalTrace& trace) const {
  const std::size_t edges = trace.edges;
  const auto is_one = [&](const std::string& path, std::size_t edge) {
    return trace.part(path, edge, 0, 1) == 1U;
  };
  const auto part = [&](const Signal& signal, std::size_t edge, int low, int bits) {
    return edge < edges ? trace.part(signal.path, edge, low, bits) : std::nullopt;
  };
  const auto word_at = [&](const Signal& signal, int bits, std::size_t edge) -> std::optional<std::uint64_t> {
    if (!signal.skewed) return part(signal, edge, signal.low, bits);
    const auto lower = part(signal, edge, 0, bits / 2),
               upper = part(signal, edge + 1, bits / 2, bits - bits / 2);
    if (!lower || !upper) return std::nullopt;
    return *upper << bits / 2 | *lower;
  };

  std::size_t first = 0;
  while (first < edges && !(is_one(c_first_valid, first) && is_one(c_first_ready, first))) ++first;
  std::vector<std::vector<RtlEvent>> events(stages_.size());
  for (std::size_t s = 0; s < stages_.size(); ++s) {
    const Stage& stage = stages_[s];
    for (std::size_t edge = first; edge < edges; ++edge) {
      if (!std::all_of(stage.strobes.begin(), stage.strobes.end(),
                       [&](const auto& path) { return is_one(path, edge); }))
        continue;
      const std::size_t held = edge + static_cast<std::size_t>(stage.clocks);
      if (stage.command) {
        const auto command = word_at(*stage.command, stage.words.front().format.bits, held);
        if (command && !is_object(*command)) continue;
      }
      RtlEvent event{held - first, {}};
      for (const StageWord& word : stage.words)
        event.words.push_back(
            word_at(word.signal, word.format.bits, held + static_cast<std::size_t>(word.signal.clocks)));
      events[s].push_back(std::move(event));
    }
  }
  return events;
}

std::unique_ptr<ShaderStages> make_stages(const HardwareKey& key) {
  return key.preset == Preset::exact ? make<Exact>(key) : make<words::Published>(key);
}

SignalTrace word_trace(const std::set<TracedPart>& parts, std::vector<std::uint32_t> words) {
  struct Place {
    int low, bits;
    std::size_t word;
  };
  std::map<std::string, std::vector<Place>> places;  // by path
  std::size_t per_edge = 0;
  for (const TracedPart& part : parts) {
    places[part.path].push_back({part.low, part.bits, per_edge});
    per_edge += static_cast<std::size_t>(part.bits + 31) / 32;
  }
  const std::size_t edges = per_edge == 0 ? 0 : words.size() / per_edge;
  return {edges,
          [=, words = std::move(words)](const std::string& path, std::size_t edge, int low,
                                        int bits) -> std::optional<std::uint64_t> {
            const auto found = places.find(path);
            if (found == places.end() || edge >= edges) return std::nullopt;
            for (const Place& place : found->second) {
              if (low < place.low || low + bits > place.low + place.bits) continue;
              const std::uint32_t* const from = &words[edge * per_edge + place.word];
              std::uint64_t word = 0;
              for (int i = low - place.low + bits - 1; i >= low - place.low; --i)
                word = word << 1 | (from[i / 32] >> (i % 32) & 1);
              return word;
            }
            return std::nullopt;
          }};
}

}  // namespace halfway
