// SPDX-License-Identifier: Apache-2.0
// Vectors of the chain of object processors and of its parts.
#include <fmt/format.h>

#include <bit>
#include <span>

#include "golden/object_front.hpp"
#include "golden/objects_shader.hpp"
#include "projection/edge.hpp"
#include "sim/files/vector_file.hpp"
#include "vectors/entities.hpp"
#include "vectors/object_scene.hpp"
#include "vectors/pipeline.hpp"
#include "vectors/processor_list.hpp"

namespace halfway::vectors {
namespace {

using words::Command, words::Exact, words::ProcessorsConfig, words::set_bits;

template <class Preset>
std::string stem_of(const ProcessorsConfig& config, int subpixels) {
  return fmt::format("{}_{}", name_of<Preset>(config), subpixels);
}

// An item from its fields. Parts have 64 bits.
template <class Preset>
std::vector<std::uint32_t> item_of(const golden::ObjectWord<Preset>& word, const ProcessorsConfig& config) {
  std::vector<std::uint32_t> item(static_cast<std::size_t>(
      (words::ProcessorsLayout<Preset>(config).token_bits() + golden::c_part_bits) / 32 + 1));
  if (word.kind == golden::ObjectKind::item)
    word.token.encode(config, item);
  else
    set_bits(item, {"", 0, golden::c_part_bits, false, 0}, word.part);
  return item;
}

template <class Preset>
void add_word(VectorFile& file, const golden::ObjectWord<Preset>& word, const ProcessorsConfig& config,
              int subpixels) {
  const int bits = golden::item_bits<Preset>(config);
  Flat all = flat(item_of(word, config), bits);
  all.add(word.mask, subpixels).add(static_cast<std::uint64_t>(word.kind), 2);
  file.words_of(all.words, all.bits);
}

// The files of a chain: the vectors, the words after the source, before and after one processor and after
// the last, and the tokens.
template <class Preset>
class ChainFiles {
 public:
  ChainFiles(const ProcessorsConfig& config, int subpixels, int objects)
      : config_(config),
        subpixels_(subpixels),
        bits_(words::ProcessorsLayout<Preset>(config).init_bits()),
        token_bits_(words::ProcessorsLayout<Preset>(config).token_bits()),
        source_(config, subpixels),
        chain_(static_cast<std::size_t>(objects), golden::ObjectProcessor<Preset>(config, subpixels)),
        output_(config, words::has_filter(subpixels)),
        words_(chain_.size() + 1) {}

  void send(const InitVector& vector) {
    vectors_.words_of(vector, bits_).end_vector();
    source_.take(vector, [&](const Word& word) { pass(0, word); });
  }
  bool busy() const { return source_.busy(); }
  bool source_fault() const { return source_.fault(); }
  bool output_fault() const { return output_.fault(); }

  void write_source(const Folder& folder, const std::string& stem) const {
    vectors_.write(folder / (stem + "_in.txt"));
    words_[0].write(folder / (stem + "_out.txt"));
  }
  void write_processor(const Folder& folder, const std::string& stem) const {
    words_[1].write(folder / (stem + "_in.txt"));
    words_[2].write(folder / (stem + "_out.txt"));
  }
  void write_output(const Folder& folder, const std::string& stem) const {
    words_.back().write(folder / (stem + "_in.txt"));
    tokens_.write(folder / (stem + "_out.txt"));
  }
  void write_lists(const Folder& folder, const std::string& stem) const {
    if (!words::has_filter(subpixels_)) return;
    listed_.write(folder / (stem + "_in.txt"));
    entered_.write(folder / (stem + "_pipeline.txt"));
    filtered_.write(folder / (stem + "_out.txt"));
  }
  void write_front(const Folder& folder, const std::string& stem) const {
    vectors_.write(folder / (stem + "_in.txt"));
    tokens_.write(folder / (stem + "_out.txt"));
  }

 private:
  using Word = golden::ObjectWord<Preset>;
  using Token = golden::ShadingToken<Preset>;

  std::vector<std::uint32_t> words_of(const Token& token) const {
    std::vector<std::uint32_t> words(static_cast<std::size_t>(token_bits_ + 31) / 32);
    token.encode(config_, words);
    return words;
  }

  void pass(std::size_t at, const Word& word) {
    add_word(words_[at], word, config_, subpixels_);
    words_[at].end_vector();
    if (at < chain_.size()) {
      chain_[at].take(word, [&](const Word& next) { pass(at + 1, next); });
      return;
    }
    output_.take(word, [&](const Token& token, std::uint32_t mask, bool ends) {
      tokens_.words_of(words_of(token), token_bits_).word(mask, subpixels_).flag(ends).end_vector();
      if (words::has_filter(subpixels_)) add_to_filter(token, mask, ends);
    });
  }

  // What leads past the pipeline, which changes nothing here. Rows of token, then ends and mask; what enters
  // the pipeline; and what leaves to the filter: token, then background and weight.
  void add_to_filter(const Token& token, std::uint32_t mask, bool ends) {
    const bool object = token.command == Command::new_object, frame = token.command == Command::new_frame;
    const bool head = words::is_head(token.command);
    Flat in = flat(words_of(token), token_bits_);
    in.add(mask, subpixels_).add(ends, 1);
    listed_.words_of(in.words, in.bits).end_vector();
    if (!ends && (!head || config_.shadows)) entered_.words_of(words_of(token), token_bits_).end_vector();
    if (!object && !frame && !head) return;
    Token left;
    left.command = token.command;
    if (head) {
      left.y = token.y;
      left.x = token.x;
    }
    const auto weight = static_cast<std::uint64_t>(std::popcount(mask));
    Flat out = flat(words_of(object ? token : left), token_bits_);
    out.add(weight, std::bit_width(static_cast<unsigned>(subpixels_))).add(background_, 24);
    filtered_.words_of(out.words, out.bits).end_vector();
    if (frame && !ends) {
      const golden::Background next = golden::background_of(token, config_.channels);
      background_ = next[0] | std::uint64_t{next[1]} << 8 | std::uint64_t{next[2]} << 16;
    }
  }

  ProcessorsConfig config_;
  int subpixels_, bits_, token_bits_;
  golden::ObjectSource<Preset> source_;
  std::vector<golden::ObjectProcessor<Preset>> chain_;
  golden::ObjectOutput<Preset> output_;
  VectorFile vectors_, tokens_;
  VectorFile listed_, entered_, filtered_;
  std::uint64_t background_ = 0;
  std::vector<VectorFile> words_;
};

constexpr int c_objects = 4;  // processors, as in rows.toml

// Strips of triangles, those at the limits and `more` first, with loads between. The last strip is ended.
template <class Preset>
ChainFiles<Preset> strips_of(const ProcessorsConfig& config, int subpixels,
                             std::span<const Strip> more = {}) {
  ObjectScene<Preset> scene(config, subpixels, static_cast<std::uint64_t>(subpixels));
  ChainFiles<Preset> files(config, subpixels, c_objects);
  std::vector<Strip> strips = scene.limit_strips();
  strips.insert(strips.end(), more.begin(), more.end());
  for (int i = 0; i < 24; ++i) strips.push_back(scene.any_strip());
  for (const Strip& strip : strips) {
    while (!files.busy() && scene.random().one_in(2)) files.send(scene.any_load(15));
    files.send(scene.strip_vector(strip));
    if (!strip.empty())
      for (const StripTriangle& t : scene.triangles(strip, 30, c_objects)) files.send(t.vector);
    if (!scene.random().one_in(3)) files.send(scene.end_vector());
  }
  files.send(scene.end_vector());
  if (files.source_fault() || files.output_fault())
    throw Failure{tool_failed("object_front: a fault, but the triangles fit")};
  return files;
}

// The same with vectors that are refused. `crowded`: more triangles on a line than processors.
template <class Preset>
ChainFiles<Preset> wrong_strips_of(const ProcessorsConfig& config, int subpixels, bool crowded) {
  ObjectScene<Preset> scene(config, subpixels, 3);
  ChainFiles<Preset> files(config, subpixels, c_objects);
  const Strip strip{7, 6, 9, 5, static_cast<std::uint32_t>(golden::side_of(subpixels))};
  auto triangles = scene.triangles(strip, 30, crowded ? c_objects + 2 : 2);
  if (!crowded) {
    files.send(triangles.front().vector);  // before any strip
    std::reverse(triangles.begin(), triangles.end());
  }
  files.send(scene.strip_vector(strip));
  for (const StripTriangle& t : triangles) files.send(t.vector);
  if (!crowded) {
    InitVector unknown = scene.any_load(15);
    set_bits(unknown, Preset::request_header_at::command, static_cast<std::uint32_t>(Command::new_pixel));
    files.send(unknown);
    files.send(scene.any_load(15));  // in the strip
    Strip lower = strip;
    lower.lines = 1;
    files.send(scene.strip_vector(lower));
    for (const StripTriangle& t : scene.triangles(strip, 6, 9)) files.send(t.vector);  // below the strip
    for (const Strip& large : scene.too_large_strips()) files.send(scene.strip_vector(large));
  }
  files.send(scene.end_vector());
  if (files.source_fault() == crowded || files.output_fault() != crowded)
    throw Failure{tool_failed("object_front: the wrong fault")};
  return files;
}

// tb/rtl/shaders/processors_shader_tb.vhd has the same list.
struct Shaders {
  const char* name;
  ProcessorsConfig config;
  int subpixels;
};
constexpr Shaders c_exact_shaders[] = {{"objects", {3, 1, 0, 0, true, true, true, false}, 1},
                                       {"shadows", {3, 1, 1, 0, true, true, true, true}, 1},
                                       {"filtered", {3, 1, 1, 0, true, true, true, true}, 16}};
constexpr Shaders c_published_shaders[] = {{"published_shadows", {3, 0, 1, 0, false, true, true, true}, 4}};

// Init vectors and fragments as in shaders.cpp, without clocks. After a set no light is left.
template <class Preset>
class ShaderFiles {
 public:
  explicit ShaderFiles(const Shaders& s)
      : s_(s), scene_(s.config, s.subpixels, 5), twin_(s.config, s.subpixels, c_objects) {}

  void add_strips(int count, bool mixed) {
    define_all();
    for (int i = 0; i < count; ++i) {
      const Strip strip = scene_.any_strip();
      if (mixed && scene_.random().one_in(2)) send(scene_.any_load(s_.config.lights()));
      send(scene_.strip_vector(strip));
      if (!mixed || !scene_.random().one_in(6))
        for (const StripTriangle& t : scene_.triangles(strip, mixed ? 12 : 5, c_objects)) send(t.vector);
      send(scene_.end_vector());
    }
    for (int light = 0; light <= s_.config.lights(); ++light)
      send(scene_.load_vector(Command::remove, light));
    if (twin_.fault()) throw Failure{tool_failed("processors_shader: a fault, but the triangles fit")};
  }
  void add_crowd() {
    define_all();
    const Strip strip{7, 6, 9, 5, static_cast<std::uint32_t>(golden::side_of(s_.subpixels))};
    send(scene_.strip_vector(strip));
    for (const StripTriangle& t : scene_.triangles(strip, 40, c_objects + 2)) send(t.vector);
    send(scene_.end_vector());
    if (!twin_.fault()) throw Failure{tool_failed("processors_shader: no fault")};
  }
  // A light that does not exist.
  void add_wrong_load() {
    add_strips(1, false);
    send(scene_.load_vector(Command::define, s_.config.lights() + 1));
    if (!twin_.fault()) throw Failure{tool_failed("processors_shader: no fault")};
  }
  void write(const Folder& folder, const char* set) const {
    const std::string stem = fmt::format("{}_{}", s_.name, set);
    if (fragments_.size() == 0) throw Failure{tool_failed(stem + ": no fragment")};
    inits_.write(folder / (stem + "_init.txt"));
    fragments_.write(folder / (stem + "_fragments.txt"));
  }

 private:
  void define_all() {
    send(scene_.load_vector(Command::new_frame, 0));
    for (int light = 0; light <= s_.config.lights(); ++light)
      send(scene_.load_vector(Command::define, light));
  }
  void send(const InitVector& vector) {
    inits_.words_of(vector, twin_.init_bits()).word(0, 32).end_vector();
    twin_.draw(vector,
               [&](const Fragment& f) { add_fragment<Preset>(fragments_, f).word(0, 32).end_vector(); });
  }

  Shaders s_;
  ObjectScene<Preset> scene_;
  golden::ObjectsShader<Preset> twin_;
  VectorFile inits_, fragments_;
};

template <class Preset>
void write_shaders_of(const Folder& folder, std::span<const Shaders> all, int divisor) {
  const auto strips = [divisor](int count) { return static_cast<int>(ceil_divide(count, divisor)); };
  for (const Shaders& s : all) {
    ShaderFiles<Preset> dense(s), mixed(s), crowded(s), wrong(s);
    dense.add_strips(strips(2), false);
    dense.write(folder, "dense");
    mixed.add_strips(strips(6), true);
    mixed.write(folder, "mixed");
    crowded.add_crowd();
    crowded.write(folder, "fault");
    wrong.add_wrong_load();
    wrong.write(folder, "light_fault");
  }
}

}  // namespace

void write_objects_shaders(const Folder& folder, int divisor) {
  write_shaders_of<Exact>(folder, c_exact_shaders, divisor);
  write_shaders_of<words::Published>(folder, c_published_shaders, divisor);
}

namespace {

// write(files, folder, stem) for each hardware: strips, and faulty ones.
template <class Write>
auto of_chains(std::vector<std::string_view> faulty, const Write& write) {
  return [faulty, write](const Folder& folder) {
    for_each_object_front([&]<class Preset>(const ProcessorsConfig& config, int subpixels) {
      const std::string stem = stem_of<Preset>(config, subpixels);
      write(strips_of<Preset>(config, subpixels), folder, stem);
      for (const std::string_view set : faulty)
        write(wrong_strips_of<Preset>(config, subpixels, set == "crowded"), folder,
              fmt::format("{}_{}_fault", stem, set));
    });
  };
}

// Large enough for the upper bits of counts and distances, for the netlist of tb/mutants/designs.toml: it is
// quicker than the testbench.
void write_long(const Folder& folder) {
  constexpr ProcessorsConfig c_config{3, 1, 0, 0, true, true, true, false};
  constexpr Strip c_large[] = {{7, 40, 100, 50, 1}, {8, 3, 0, 2500, 1}};
  strips_of<Exact>(c_config, 1, c_large).write_front(folder, stem_of<Exact>(c_config, 1) + "_long");
}

// A line: checked, load, line_step, pixel_step, start, dx, dy, centre, row, column; value, before the edge.
void write_interpolator(const Folder& folder) {
  const auto write = [&]<int W>(int side) {
    Random random(static_cast<std::uint64_t>(W + side));
    VectorFile file;
    golden::RasterInterpolator<W> twin;
    for (int triangle = 0; triangle < 60; ++triangle) {
      const words::Word<W> start = random.word<W>();
      const words::Word<W + 3> dx = random.word<W + 3>(), dy = random.word<W + 3>();
      for (int clock = 0; clock < 30; ++clock) {
        const bool load = clock == 0, line = clock == 1 || (clock > 1 && random.one_in(6));
        const bool pixel = clock > 1 && !line && !random.one_in(5), centre = random.one_in(2);
        const auto row = static_cast<int>(random.between(0, side - 1));
        const auto column = static_cast<int>(random.between(0, side - 1));
        file.flag(clock > 1).flag(load).flag(line).flag(pixel).word(start).word(dx).word(dy).flag(centre);
        file.word(static_cast<std::uint64_t>(row), 2).word(static_cast<std::uint64_t>(column), 2);
        file.word(centre ? twin.value() : twin.value(side, row, column)).end_vector();
        if (load) twin.load(start, dx, dy);
        if (line) twin.line_step();
        if (pixel) twin.pixel_step();
      }
    }
    file.write(folder / fmt::format("{}_{}.txt", W, side));
  };
  write.template operator()<5>(4);
  write.template operator()<Exact::c_depth_sum_bits>(2);
  write.template operator()<Exact::c_plane_sum_bits>(1);
  write.template operator()<Exact::c_plane_sum_bits>(4);
}

// A line: reset, load, line_step, pixel_step, init; ready, more, known, mask, before the edge.
void write_edges(const Folder& folder, int subpixels) {
  const int side = golden::side_of(subpixels);
  Random random(static_cast<std::uint64_t>(subpixels));
  VectorFile file;
  golden::ObjectEdges twin(side);
  int busy = 0;  // clocks until ready
  bool known = false, stepped = false;
  InitVector init(Exact::c_init_header_bits / 32);
  const auto clock = [&](bool reset, bool load, bool line, bool pixel) {
    file.flag(reset).flag(load).flag(line).flag(pixel).words_of(init, Exact::c_init_header_bits);
    file.flag(busy == 0).flag(known && twin.more());
    file.flag(stepped).word(twin.mask(), subpixels).end_vector();
    if (load) twin.load(init);
    if (line) twin.line_step();
    if (pixel) twin.pixel_step();
    if (load || line)
      busy = side;
    else if (busy > 0)
      --busy;
    known = (known || load) && !reset;
    stepped = stepped || line;
    if (reset) busy = 0;
  };
  for (int i = 0; i < 150; ++i) {
    init = random_triangle<Exact>(random, Mix::mixed, Exact::c_init_header_bits);
    clock(false, true, false, false);
    for (int line = 0; line < 12; ++line) {
      while (busy != 0) clock(false, false, false, stepped && random.one_in(2));
      const bool more = twin.more();
      clock(false, false, true, false);
      // Look at the pixels of the strip's first columns only, but sometimes at many.
      for (std::int64_t pixel = random.between(0, random.one_in(30) ? 300 : 20); pixel > 0; --pixel)
        clock(false, false, false, !random.one_in(8));
      if (!more) break;
    }
    // Triangles end before another one is loaded, or are dropped.
    while (busy != 0) clock(false, false, false, false);
    clock(true, false, false, false);
  }
  file.write(folder / fmt::format("{}.txt", subpixels));
}

// A line: reset, in_valid, own, out_ready, in_word, own_word; in_ready, out_valid, out_word.
template <class Preset>
void write_merge(const Folder& folder, const ProcessorsConfig& config, int subpixels) {
  using Word = golden::ObjectWord<Preset>;
  Random random(static_cast<std::uint64_t>(subpixels));
  VectorFile file;
  golden::ObjectMerge<Preset> twin(subpixels);
  const auto any_element = [&] {
    Word word;
    word.token.command = config.shadows && random.one_in(3) ? Command::shadow : Command::new_object;
    word.token.z = static_cast<std::uint32_t>(random.between(0, 3)) << random.between(0, 22);
    word.token.triangle = static_cast<std::uint32_t>(random.bits(2)) << random.between(0, 30);
    word.token.exponent = static_cast<std::uint32_t>(random.bits(8));
    if (!word.is_shadow()) word.mask = static_cast<std::uint32_t>(random.bits(subpixels));
    if (!word.is_shadow() && random.one_in(3)) word.mask = 1U << random.between(0, subpixels - 1);
    return word;
  };
  Word own = any_element();
  bool has_own = false;
  for (int i = 0; i < 4000; ++i) {
    Word in = any_element();
    const bool heads = random.one_in(4);
    if (heads) {
      constexpr Command c_commands[] = {Command::new_pixel, Command::new_scanline, Command::define};
      in = {};
      in.token.command = c_commands[random.between(0, 2)];
    } else if (random.one_in(12)) {
      in = {};
      in.kind = static_cast<golden::ObjectKind>(random.between(1, 3));
      in.part = random.bits(64);
    }
    const auto row = [&](bool reset, bool valid, bool ready) {
      const auto choice = twin.choose(in, has_own ? &own : nullptr);
      Word out = choice.own ? own : in;
      if (out.is_element()) out.mask = choice.mask;
      file.flag(reset).flag(valid).flag(has_own).flag(ready);
      add_word(file, in, config, subpixels);
      add_word(file, own, config, subpixels);
      file.flag(!choice.own && (!choice.output || ready)).flag(valid && (choice.own || choice.output));
      add_word(file, out, config, subpixels);
      file.end_vector();
      if (valid && (ready || !choice.output)) twin.step(in, choice);
      if (reset) twin.reset();
      return valid && (ready || !choice.output) && !choice.own;
    };
    while (random.one_in(3)) row(false, false, random.one_in(2));
    while (!row(false, true, !random.one_in(3))) {
    }
    if (in.is_head()) {
      own = any_element();
      has_own = !random.one_in(3);
    }
    if (random.one_in(300)) row(true, false, true);
  }
  file.write(folder / (stem_of<Preset>(config, subpixels) + ".txt"));
}

}  // namespace

std::vector<Entity> objects_entities() {
  return {
      {"raster_interpolator", write_interpolator},
      {"object_edges", of_sizes(write_edges, {{1}, {4}, {16}})},
      {"object_merge",
       [](const Folder& folder) {
         for_each_object_front([&]<class Preset>(const ProcessorsConfig& config, int subpixels) {
           write_merge<Preset>(folder, config, subpixels);
         });
       }},
      {"object_processor", of_chains({}, [](const auto& files, const Folder& f,
                                            const std::string& s) { files.write_processor(f, s); })},
      {"object_source", of_chains({"refused"}, [](const auto& files, const Folder& f,
                                                  const std::string& s) { files.write_source(f, s); })},
      {"object_output", of_chains({"crowded"}, [](const auto& files, const Folder& f,
                                                  const std::string& s) { files.write_output(f, s); })},
      {"filter_queue", of_chains({}, [](const auto& files, const Folder& f,
                                        const std::string& s) { files.write_lists(f, s); })},
      {"object_front",
       [](const Folder& folder) {
         of_chains({"crowded", "refused"}, [](const auto& files, const Folder& f, const std::string& s) {
           files.write_front(f, s);
         })(folder);
         write_long(folder);
       }},
  };
}

}  // namespace halfway::vectors
