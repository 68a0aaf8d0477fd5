// SPDX-License-Identifier: Apache-2.0
// Files for each configuration of the processors shader and set of vectors: init and fragments as in
// shaders.cpp. The clocks are 0; they only keep the format. After a set no light is left.
#include "golden/processors_shader.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "sim/files/vector_file.hpp"
#include "vectors/entities.hpp"
#include "vectors/processor_list.hpp"
#include "vectors/random.hpp"
#include "vectors/triangles.hpp"

namespace halfway::vectors {
namespace {

using words::Command, words::Exact, words::Field, words::Published, words::set_bits;

// tb/rtl/shaders/processors_shader_tb.vhd has the same list.
struct Processors {
  const char* name;
  words::ProcessorsConfig config;
  std::int64_t pixels;
  std::int64_t long_pixels = 0;  // of the set `long`
};

constexpr Processors c_exact_processors[] = {
    {"directional", {3, 1, 0, 0, true, true, true, false}, 112, 2400},
    {"all_kinds", {3, 1, 1, 1, true, true, true, false}, 112},
    {"grey", {1, 2, 0, 0, true, false, false, false}, 112},
    {"no_light", {3, 0, 0, 0, false, false, true, false}, 112},
    {"folded", {3, 0, 1, 0, true, true, true, false}, 64, 800},
};
constexpr Processors c_published_processors[] = {
    {"published", {3, 1, 1, 1, true, true, true, false}, 64, 800},
    {"published_unrolled", {1, 1, 0, 0, true, true, false, false}, 112},
};

template <class Preset>
class Host {
 public:
  using Shader = golden::ProcessorsShader<Preset>;

  explicit Host(const Processors& processors)
      : p_(processors),
        layout_(processors.config),
        twin_(processors.config),
        rasterizer_(processors.config),
        random_(layout_.init_bits()),
        pace_(layout_.token_bits()) {}

  // The elements of a set.
  void define_all() {
    for (int light = 0; light <= p_.config.lights(); ++light) load(Command::define, light);
  }
  void some_load() {
    constexpr Command c_loads[] = {Command::define, Command::redefine, Command::remove, Command::new_frame};
    load(c_loads[random_.between(0, 3)], static_cast<int>(random_.between(0, p_.config.lights())));
  }
  void draw(const InitVector& walk) { send(walk_vector(walk)); }
  void draw_triangles(Mix mix) {
    for (const InitVector& walk :
         random_triangles<Exact>(random_, mix, Exact::c_init_header_bits, p_.pixels)) {
      if (mix == Mix::mixed && random_.one_in(3)) some_load();
      if (mix == Mix::mixed && random_.one_in(4)) draw_pile();
      draw(walk);
    }
  }
  // Objects at one pixel, and at the pixel above.
  void draw_pile() {
    const auto y = static_cast<std::uint32_t>(random_.between(1, 4095));
    const std::int64_t x = random_.between(0, 4095);
    for (const std::uint32_t line : {y, y, y - 1, y - 1, y}) draw(line_walk(line, x, x + 1, 1 << 20, 3));
  }
  // Objects of random words for the parts.
  void any_objects() {
    for (int i = 0; i < 200; ++i) {
      std::vector<std::uint32_t> words = random_vector(random_, layout_.token_bits());
      set_bits(words, Preset::pixel_header_at::command, static_cast<std::uint32_t>(Command::new_object));
      const auto token = golden::ShadingToken<Preset>::decode(p_.config, words);
      objects_.words_of(words, layout_.token_bits()).end_vector();
      add_fragment<Preset>(shaded_, golden::fragment_output(token, p_.config.channels)).end_vector();
    }
  }
  // A load of a light that does not exist, or a command that no vector has.
  void go_wrong(bool load_light) {
    define_all();
    draw(line_walk(5, 3, 4, 1 << 20, 1));
    if (load_light)
      load(Command::define, p_.config.lights() + 1);
    else
      send(request(Command::new_pixel, 0));
  }
  /// `object`: the last vector draws, so that the processors hold the last token of an object.
  void finish(bool object) {
    for (int light = 0; light <= p_.config.lights(); ++light) load(Command::remove, light);
    load(Command::new_frame, 0);
    if (object) draw(line_walk(9, 30, 31, 1 << 20, 5));
  }
  bool fault() const { return twin_.fault(); }

  // Files of the testbenches of the shader's parts.
  void write_rasterizer(const Folder& folder) {
    const std::string stem = name_of<Preset>(p_.config);
    write_rasterizer(folder, stem);
    vectors_ = {};
    tokens_ = {};
    define_all();
    send(request(Command::new_pixel, 0));
    define_all();
    write_rasterizer(folder, stem + "_refused");
  }
  void write_output(const Folder& folder) const {
    objects_.write(folder / (name_of<Preset>(p_.config) + "_in.txt"));
    shaded_.write(folder / (name_of<Preset>(p_.config) + "_out.txt"));
  }
  void write(const Folder& folder, const char* set) {
    const std::string stem = fmt::format("{}_{}", p_.name, set);
    if (fragments_.size() == 0) throw Failure{tool_failed(stem + ": no fragment")};
    inits_.write(folder / (stem + "_init.txt"));
    return fragments_.write(folder / (stem + "_fragments.txt"));
  }

 private:
  void write_rasterizer(const Folder& folder, const std::string& stem) const {
    vectors_.write(folder / (stem + "_in.txt"));
    tokens_.write(folder / (stem + "_out.txt"));
  }
  std::vector<std::uint32_t> words_of(const golden::ShadingToken<Preset>& token) const {
    std::vector<std::uint32_t> words(static_cast<std::size_t>(layout_.token_bits() + 31) / 32);
    token.encode(p_.config, words);
    return words;
  }
  int load_bits() const {
    using Layout = words::ProcessorsLayout<Preset>;
    return Layout::light_colour_low(p_.config.channels);
  }
  // The expected tokens of the rasterizer for the vector.
  void send_to_rasterizer(const InitVector& vector) {
    const Command command = words::command_of<Preset>(vector);
    vectors_.words_of(vector, layout_.init_bits()).end_vector();
    if (words::is_load(command)) {
      std::vector<std::uint32_t> words(static_cast<std::size_t>(layout_.token_bits() + 31) / 32);
      for (int low = 0; low < load_bits(); low += 8) {
        const Field field{"", low, std::min(8, load_bits() - low), false, 0};
        set_bits(words, field, words::get_bits(vector, field));
      }
      tokens_.words_of(words, layout_.token_bits()).end_vector();
    }
    if (command != Command::new_object) return;
    rasterizer_.draw(
        vector, [] {},
        [&](golden::SpanXWord) {
          tokens_.words_of(words_of(rasterizer_.token()), layout_.token_bits()).end_vector();
        });
  }
  void send(const InitVector& vector) {
    send_to_rasterizer(vector);
    inits_.words_of(vector, layout_.init_bits()).word(0, 32).end_vector();
    twin_.draw(vector, [&](const Fragment& f) {
      objects_.words_of(words_of(twin_.token()), layout_.token_bits()).end_vector();
      add_fragment<Preset>(shaded_, f).end_vector();
      add_fragment<Preset>(fragments_, f).word(0, 32).end_vector();
    });
  }

  InitVector request(Command command, int light) {
    using At = typename Preset::request_header_at;
    InitVector vector = random_vector(random_, layout_.init_bits());
    set_bits(vector, At::command, static_cast<std::uint32_t>(command));
    set_bits(vector, At::light, static_cast<std::uint32_t>(light));
    return vector;
  }

  void load(Command command, int light) {
    InitVector vector = request(command, light);
    if (command == Command::define || command == Command::redefine) {
      golden::ShadingLight l;
      l.positional = random_.one_in(2);
      l.spot = random_.one_in(2);
      l.shift = Preset::c_light_shift_bits > 0 ? static_cast<std::uint32_t>(random_.between(0, 4)) : 0;
      l.outer = fixed(uniform(-1, 0.5), Preset::c_direction_fraction_bits);
      l.slope = static_cast<std::uint32_t>(random_.word(Preset::c_spot_slope_bits));
      l.around_eye = static_cast<int>(random_.between(0, 3) / 3);
      const auto to_light = direction(), axis = direction(), half = direction();
      for (std::size_t i = 0; i < 3; ++i) {
        l.place[i] = fixed(to_light[i], Preset::c_light_place_fraction_bits);
        l.axis[i] = fixed(axis[i], Preset::c_direction_fraction_bits);
        l.half[i] = fixed(half[i], Preset::c_direction_fraction_bits);
        l.intensity[i] = static_cast<std::uint32_t>(
            random_.bits(8 + Preset::c_light_intensity_fraction_bits - (random_.one_in(3) ? 0 : 1)));
      }
      golden::ShadingToken<Preset>::encode_light(p_.config, l, vector);
    }
    send(vector);
  }

  InitVector walk_vector(const InitVector& walk) {
    InitVector vector = request(Command::new_object, static_cast<int>(random_.bits(5)));
    for (int low = 0; low < Exact::c_init_header_bits; low += 32)
      set_bits(vector, {"", low, 32, false, 0}, walk[static_cast<std::size_t>(low) / 32], layout_.walk_low());
    put_planes(vector);
    put_material(vector);
    return vector;
  }
  // Vectors that change slowly. One plane in twelve keeps random words.
  void put_planes(InitVector& vector) {
    using At = typename Preset::plane_header_at;
    const auto normal = direction(), place = direction();
    for (int plane = 0; plane < layout_.planes(); ++plane) {
      if (random_.one_in(12)) continue;
      const auto axis = static_cast<std::size_t>(plane % 3);
      const double value = plane < 3 ? normal[axis] : plane < 6 ? place[axis] : uniform(0.1, 1);
      for (const Field* field : {&At::value, &At::dx, &At::de0, &At::de1})
        set_bits(vector, *field,
                 fixed(field == &At::value ? value : uniform(-0.03, 0.03), Preset::c_plane_sum_fraction_bits),
                 layout_.plane_low(plane));
    }
  }
  void put_material(InitVector& vector) {
    const int low = layout_.init_material_low();
    if (p_.config.specular)
      set_bits(vector, {"", low + layout_.exponent_low(), Preset::c_exponent_bits, false, 0},
               random_.between(1, 80) << Preset::c_exponent_fraction_bits);
    const int first = low + layout_.ambient_low(0);
    for (int at = first; at < low + layout_.material_bits(); at += Preset::c_coefficient_bits)
      set_bits(vector, {"", at, Preset::c_coefficient_bits, false, 0},
               random_.bits(Preset::c_coefficient_fraction_bits - (random_.one_in(3) ? 0 : 1)));
  }

  InitVector line_walk(std::uint32_t y, std::int64_t from, std::int64_t to, std::int64_t z,
                       std::uint32_t triangle) {
    using At = Exact::init_header_at;
    InitVector walk(static_cast<std::size_t>(Exact::c_init_header_bits / 32));
    set_bits(walk, At::triangle, triangle);
    set_bits(walk, At::y, y);
    set_bits(walk, At::upper_lines, 1);
    const bool backward = random_.one_in(2);
    set_bits(walk, At::backward, backward);
    set_bits(walk, At::start_x, backward ? to - 1 : from);
    set_bits(walk, At::upper_x, backward ? from - 1 : to);
    put_depth(walk, z);
    return walk;
  }
  static void put_depth(InitVector& walk, std::int64_t z) {
    set_bits(walk, Exact::init_header_at::z,
             static_cast<std::uint64_t>(z) << Exact::c_depth_sum_fraction_bits);
  }

  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(random_.bits(32)) * 0x1p-32;
  }
  std::array<double, 3> direction() {
    std::array<double, 3> v{uniform(-0.6, 0.6), uniform(-0.6, 0.6), uniform(0.1, 1)};
    const double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (double& component : v) component /= length;
    return v;
  }
  static std::int64_t fixed(double value, int fraction_bits) {
    return std::llround(std::ldexp(value, fraction_bits));
  }

  const Processors& p_;
  words::ProcessorsLayout<Preset> layout_;
  Shader twin_;
  golden::TokenRasterizer<Preset> rasterizer_;
  Random random_, pace_;
  VectorFile inits_, fragments_;
  VectorFile vectors_, tokens_, objects_, shaded_;
};

template <class Preset>
void draw_set(Host<Preset>& host, Mix mix) {
  host.define_all();
  host.draw_triangles(mix);
  // A dense set has no gap between fragments, as before an object after a load.
  host.finish(mix != Mix::dense);
}

// The parts of the shader with all words of tokens, in both presets. tb/rtl/tb_processors_pkg.vhd has the
// same list.
template <class Write>
void write_parts(const Write& write) {
  const auto write_part = [&]<class Preset>(Host<Preset> host) {
    draw_set(host, Mix::mixed);
    host.any_objects();
    write(host);
  };
  for (const std::size_t i : {std::size_t{0}, std::size_t{1}, std::size_t{2}})
    write_part(Host<Exact>(c_exact_processors[i]));
  write_part(Host<Published>(c_published_processors[0]));
}

template <class Preset>
void write_fault(const Folder& folder, const Processors& processors, bool load_light, const char* set) {
  Host<Preset> host(processors);
  host.go_wrong(load_light);
  if (!host.fault()) throw Failure{tool_failed(fmt::format("{}: nothing went wrong", processors.name))};
  host.write(folder, set);
}

template <class Preset>
void write_set(const Folder& folder, const Processors& processors, const char* set) {
  Host<Preset> host(processors);
  draw_set(host, set == std::string_view("dense") ? Mix::dense : Mix::mixed);
  if (host.fault())
    throw Failure{tool_failed(fmt::format("{}: a fault in the set {}", processors.name, set))};
  return host.write(folder, set);
}

template <class Preset>
void write_all(const Folder& folder, std::span<const Processors> shaders, std::int64_t divisor) {
  for (Processors processors : shaders) {
    processors.pixels /= divisor;
    for (const char* set : {"dense", "mixed"}) write_set<Preset>(folder, processors, set);
    const int lights = processors.config.lights();
    if (lights > 0) write_fault<Preset>(folder, processors, lights == 1, "fault");
  }
}

template <int divisor>
void write_processors_shader(const Folder& folder) {
  write_all<Exact>(folder, c_exact_processors, divisor);
  write_all<Published>(folder, c_published_processors, divisor);
  write_objects_shaders(folder, divisor);
}

// More pixels and both faults, for the netlists of tb/mutants/designs.toml: they are quicker than the
// testbenches.
template <class Preset>
void write_long(const Folder& folder, std::span<const Processors> shaders) {
  for (Processors processors : shaders) {
    processors.pixels = processors.long_pixels;
    if (processors.pixels == 0) continue;
    write_set<Preset>(folder, processors, "long");
    write_fault<Preset>(folder, processors, false, "command_fault");
    write_fault<Preset>(folder, processors, true, "light_fault");
  }
}

}  // namespace

std::vector<Entity> processors_shader_entities() {
  return {
      {"token_rasterizer",
       [](const Folder& f) { write_parts([&](auto& host) { host.write_rasterizer(f); }); }},
      {"fragment_output",
       [](const Folder& f) { write_parts([&](const auto& host) { host.write_output(f); }); }},
      {"processors_shader",
       [](const Folder& f) {
         write_processors_shader<1>(f);
         write_long<Exact>(f, c_exact_processors);
         write_long<Published>(f, c_published_processors);
       }},
      {"short/processors_shader", write_processors_shader<c_short>},
  };
}

}  // namespace halfway::vectors
