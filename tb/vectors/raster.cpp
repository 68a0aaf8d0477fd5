// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "golden/edge_pair.hpp"
#include "golden/edge_walker.hpp"
#include "golden/line_counter.hpp"
#include "golden/slope_walker.hpp"
#include "sim/files/vector_file.hpp"
#include "vectors/entities.hpp"
#include "vectors/random.hpp"
#include "vectors/triangles.hpp"

namespace halfway::vectors {
namespace {

using golden::EdgeStart, words::Exact, words::Published, golden::SpanXWord;

EdgeStart edge_start(const EdgeSection& s) {
  return {SpanXWord::from_bits(s.pixel),           SpanXWord::from_bits(s.quotient),
          static_cast<std::uint32_t>(s.remainder), static_cast<std::uint32_t>(s.divisor),
          static_cast<std::uint32_t>(s.error),     s.carry};
}

EdgeStart garbage_edge(Random& random) {
  const auto error = [&] { return static_cast<std::uint32_t>(random.word(Exact::c_edge_error_bits)); };
  return {random.word<Exact::c_span_x_bits>(),
          random.word<Exact::c_span_x_bits>(),
          error(),
          error(),
          error(),
          random.one_in(2)};
}

// The files of a set of triangles. lines: empty, last, carry. fragments: triangle, y, x, and
// the clock in which the fragment is output at full speed.
struct WalkFiles {
  VectorFile inits, lines, fragments;

  void add_line(const WalkedLine& line) {
    lines.flag(line.pixels() == 0).flag(line.last).flag(line.carry).end_vector();
  }
  // The first fragment is output in clock `first`.
  template <class Preset>
  void add_fragments(const WalkedLine& line, std::int64_t first) {
    for (std::int64_t i = 0; i < line.pixels(); ++i) {
      const std::int64_t x = line.start.value() + (line.backward ? -i : i);
      fragments.word(line.triangle, Preset::c_triangle_bits).word(line.y, Preset::c_pixel_y_bits);
      fragments.word(x, Preset::c_span_x_bits);
      fragments.word(first + i, 32).end_vector();
    }
  }
  void write(const Folder& folder, const std::string& stem) const {
    inits.write(folder / (stem + "_init.txt"));
    lines.write(folder / (stem + "_lines.txt"));
    fragments.write(folder / (stem + "_fragments.txt"));
  }
};

template <class Preset>
std::vector<InitVector> walker_triangles(Random& random, Mix mix) {
  using At = typename Preset::init_header_at;
  auto set = random_triangles<Preset>(random, mix, Preset::c_init_header_bits, 8000);
  if (mix != Mix::mixed) return set;
  // A count of 0 upper lines means as many lines as the counter can count; here these lines are empty.
  std::vector<InitVector> more{set.front(), set.front()};
  set_bits(more[0], At::upper_lines, 0);
  if constexpr (std::is_same_v<Preset, Exact>) {
    Walk walk;
    walk.start.pixel = walk.upper.pixel = 9;
    put_walk(more[0], walk);
    // The longest span.
    constexpr std::int64_t c_half = std::int64_t{1} << (Preset::c_span_x_bits - 1);
    walk.upper_lines = 1;
    walk.start.pixel = -c_half;
    walk.upper.pixel = c_half - 1;
    put_walk(more[1], walk);
  } else {
    constexpr std::int64_t c_one = std::int64_t{1} << Published::c_edge_x_fraction_bits;
    set_bits(more[0], At::start_x, 9 * c_one);
    set_bits(more[0], At::upper_x, 2 * c_one);
    set_bits(more[0], At::start_slope, 0);
    set_bits(more[0], At::upper_slope, 0);
    // So many narrow lines at so many fractions of a pixel that the lowest bits of the slopes count.
    constexpr std::int64_t c_slope = c_one * 610 / 1597;
    set_bits(more[1], At::upper_lines, 2045);
    set_bits(more[1], At::start_x, 2000 * c_one);
    set_bits(more[1], At::start_slope, c_slope);
    set_bits(more[1], At::upper_x, 2001 * c_one);
    set_bits(more[1], At::upper_slope, c_slope + 1);
  }
  set.insert(set.begin() + static_cast<std::ptrdiff_t>(set.size() / 2), more.begin(), more.end());
  return set;
}

// init: the header, and the clock in which it is accepted at full speed. Clocks count from the first accepted
// init vector, one clock before its triangle starts.
template <class Preset>
void write_walker(const Folder& folder) {
  Random random(Preset::c_init_header_bits);
  for (const auto& [mix, name] : {std::pair{Mix::dense, "dense"}, {Mix::mixed, "mixed"}}) {
    WalkFiles files;
    WalkerClock clock;
    LostClocks losses;
    std::int64_t pixels_before = 0;
    for (const InitVector& init : walker_triangles<Preset>(random, mix)) {
      clock.take_init();
      files.inits.words_of(init, Preset::c_init_header_bits);
      files.inits.word(clock.read() + 1, 32).end_vector();
      std::int64_t first_clock = -1, pixels = 0;
      for (const WalkedLine& line : walk_lines<Preset>(init)) {
        files.add_line(line);
        const std::int64_t first = clock.take_line(line.pixels()) + 2;
        if (pixels == 0) first_clock = first;
        pixels += line.pixels();
        files.add_fragments<Preset>(line, first);
      }
      // Check the promise in the header of triangle_walker.vhd: a triangle takes at least two clocks.
      if (const std::int64_t lost = losses.triangle(first_clock, pixels);
          mix == Mix::dense && (lost < 0 || lost > (pixels_before == 1 ? 1 : 0)))
        throw Failure{
            tool_failed(fmt::format("triangle_walker: {} clocks lost before clock {}", lost, first_clock))};
      pixels_before = pixels;
    }
    files.write(folder, std::string(Preset::c_name) + '_' + name);
  }
}

// A line: reset, init_valid, init, advance; init_ready, step, load, section_change, valid, first, triangle,
// y, before the clock's edge.
template <class Preset>
void write_counter(const Folder& folder) {
  Random random(61);
  VectorFile file;
  for (const Mix mix : {Mix::dense, Mix::mixed}) {
    golden::LineCounter<Preset> twin;
    bool valid = false, first = false, offered = false;
    std::vector<InitVector> triangles = walker_triangles<Preset>(random, mix);
    if constexpr (std::is_same_v<Preset, Exact>) {
      // Nearly as many lower lines as can be counted. An even number: a fault that inverts a bit of each
      // count inverts it an odd number of times.
      InitVector long_section = triangles.front();
      set_bits(long_section, Exact::init_header_at::upper_lines, 1);
      set_bits(long_section, Exact::init_header_at::lower_lines, ~1U);
      if (mix == Mix::mixed) triangles.push_back(long_section);
    }
    std::size_t taken = 0;
    for (int clock = 0; taken < triangles.size() || valid; ++clock) {
      const bool full_speed = clock / 500 % 2 == 0;
      // In the mixed set, a triangle of 2**bits lines is counted to its end.
      const bool reset = mix == Mix::dense && random.one_in(200);
      const bool advance = full_speed || random.one_in(2);
      offered = taken < triangles.size() && (offered || full_speed || random.one_in(3));
      const bool step = advance || !valid, load = !valid || twin.last();
      const bool take = offered && step && load && !(valid && first);
      file.flag(reset).flag(offered);
      file.words_of(offered ? triangles[taken] : random_vector(random, Preset::c_init_header_bits),
                    Preset::c_init_header_bits);
      file.flag(advance).flag(take).flag(step).flag(load).flag(twin.section_last()).flag(valid).flag(first);
      file.word(twin.triangle(), Preset::c_triangle_bits).word(twin.y(), Preset::c_pixel_y_bits);
      file.end_vector();
      if (take) {
        twin.load(triangles[taken++]);
        offered = false;
      } else if (step && !load) {
        twin.step();
      }
      if (step) valid = take || !load;
      if (step) first = take;
      if (reset) valid = first = false;
    }
  }
  file.write(folder / (std::string(Preset::c_name) + ".txt"));
}

// A line: checked, load, init, section_change, step; empty, start, stop, remaining, backward, carry, before
// the clock's edge. While load or section_change waits for its step, init may differ from the init vector
// that is loaded.
template <class Preset>
void write_pair(const Folder& folder) {
  Random random(62);
  VectorFile file;
  golden::EdgePair<Preset> twin;
  bool checked = false;
  const auto clock = [&](bool load, const InitVector& init, bool section_change, bool step) {
    file.flag(checked).flag(load).words_of(init, Preset::c_init_header_bits).flag(section_change).flag(step);
    file.flag(twin.empty()).word(twin.start()).word(twin.stop());
    file.word(twin.pixels() - 1, Preset::c_span_x_bits).flag(twin.backward()).flag(twin.carry()).end_vector();
  };
  const auto garbage = [&] { return random_vector(random, Preset::c_init_header_bits); };
  std::vector<InitVector> triangles;
  for (const Mix mix : {Mix::dense, Mix::mixed})
    std::ranges::move(walker_triangles<Preset>(random, mix), std::back_inserter(triangles));
  // Spans of any length.
  for (int i = 0; i < 300; ++i) triangles.push_back(garbage());
  for (const InitVector& init : triangles) {
    while (random.one_in(3)) clock(true, garbage(), random.one_in(2), false);
    clock(true, init, random.one_in(2), true);
    twin.load(init);
    checked = true;
    golden::LineCounter<Preset> lines;
    lines.load(init);
    // Walk only the first lines of the largest triangles.
    for (int line = 0; !lines.last() && line < 40; ++line) {
      const bool section_change = lines.section_last();
      while (random.one_in(4)) clock(false, garbage(), section_change, false);
      clock(false, garbage(), section_change, true);
      twin.step(section_change);
      lines.step();
    }
  }
  file.write(folder / (std::string(Preset::c_name) + ".txt"));
}

// A line record as in line_pkg, with random words.
struct LineRecord {
  std::uint64_t triangle, y, start, stop, remaining;
  bool empty, backward, carry;

  static LineRecord any(Random& random) {
    const auto x = [&] { return random.word(Exact::c_span_x_bits); };
    return {random.word(Exact::c_triangle_bits),
            random.word(Exact::c_pixel_y_bits),
            x(),
            x(),
            x(),
            random.one_in(3),
            random.one_in(2),
            random.one_in(2)};
  }
  void add_to(VectorFile& file) const {
    file.word(triangle, Exact::c_triangle_bits).word(y, Exact::c_pixel_y_bits);
    for (const std::uint64_t word : {start, stop, remaining}) file.word(word, Exact::c_span_x_bits);
    file.flag(empty).flag(backward).flag(carry);
  }
};

// A line: checked, load, x, quotient, remainder, divisor, error, carry, step; x, carry, before the edge.
void write_edge_walker(const Folder& folder) {
  Random random(14);
  VectorFile file;
  golden::EdgeWalker twin;
  std::vector<EdgeStart> edges;
  bool waits = false;  // a load waits for its step
  for (int i = 0; i < 6000; ++i) {
    while (edges.empty()) {
      for (const Walk& walk : random_walks(random))
        for (const EdgeSection* section : {&walk.start, &walk.upper, &walk.lower}) {
          edges.push_back(edge_start(*section));
          edges.push_back(garbage_edge(random));
        }
    }
    const EdgeStart& e = edges.back();
    const bool load = i == 0 || waits || random.one_in(16), step = i == 0 || !random.one_in(5);
    waits = load && !step;
    file.flag(i > 0).flag(load).word(e.x).word(e.quotient);
    for (const std::uint32_t word : {e.remainder, e.divisor, e.error})
      file.word(word, Exact::c_edge_error_bits);
    file.flag(e.carry).flag(step).word(twin.x()).flag(twin.carry()).end_vector();
    if (load && step) {
      twin.load(e);
      edges.pop_back();
    } else if (step) {
      twin.step();
    }
  }
  file.write(folder / "edges.txt");
}

// A line: checked, load, x, slope, step; x, before the edge. Random words, so that sums wrap.
void write_slope_walker(const Folder& folder) {
  using EdgeX = golden::SlopeWalker::EdgeX;
  Random random(15);
  VectorFile file;
  golden::SlopeWalker twin;
  bool waits = false;  // a load waits for its step
  bool taken = false;
  EdgeX x, slope;
  for (int i = 0; i < 12000; ++i) {
    if (!waits) {
      x = EdgeX::from_bits(random.word(Published::c_edge_x_bits));
      slope = EdgeX::from_bits(random.word(Published::c_edge_x_bits));
    }
    // In most of the file edges have so many lines that the lowest bits count.
    const bool load = !taken || waits || random.one_in(i < 3000 ? 12 : 2000);
    const bool step = !taken || !random.one_in(5);
    waits = load && !step;
    file.flag(taken).flag(load).word(x).word(slope).flag(step).word(twin.x()).end_vector();
    if (load && step) {
      twin.load(x, slope);
      taken = true;
    } else if (step) {
      twin.step();
    }
  }
  file.write(folder / "edges.txt");
}

// A line: reset, enable, in_valid, in_line, line_ready, span_last_next; advance, step, span_load, valid,
// line, before the clock's edge.
void write_line_stage(const Folder& folder) {
  Random random(63);
  VectorFile file;
  bool valid = false, span_last = true;
  LineRecord line{};
  for (int clock = 0; clock < 4000; ++clock) {
    const bool full_speed = clock / 500 % 2 == 0;
    const auto often = [&] { return full_speed || !random.one_in(3); };
    const bool reset = random.one_in(100), enable = often(), in_valid = often(), line_ready = often();
    const bool span_last_next = random.one_in(2);
    const LineRecord in_line = LineRecord::any(random);
    const bool step = valid && enable && line_ready && (span_last || line.empty);
    const bool advance = enable && (step || !valid);
    file.flag(reset).flag(enable).flag(in_valid);
    in_line.add_to(file);
    file.flag(line_ready).flag(span_last_next);
    file.flag(advance).flag(step).flag(step && !line.empty).flag(valid);
    LineRecord held = line;
    held.empty = !valid || line.empty;
    held.add_to(file);
    file.end_vector();
    if (advance) {
      valid = in_valid;
      line = in_line;
    }
    if (reset) valid = false;
    span_last = span_last_next;
  }
  file.write(folder / "lines.txt");
}

// A line: reset, enable, load, line; last_next, valid, triangle, y, x, before the clock's edge. Spans of up
// to six pixels, and a few of any length.
void write_span_stage(const Folder& folder) {
  Random random(64);
  VectorFile file;
  LineRecord line{};
  std::uint64_t drawn = 0;  // pixels of the previous line
  bool valid = false;
  const auto last = [&] { return !valid || drawn == line.remaining; };
  for (int clock = 0; clock < 20000; ++clock) {
    const bool full_speed = clock / 500 % 2 == 0;
    const bool reset = random.one_in(200), enable = full_speed || random.one_in(2);
    LineRecord next = LineRecord::any(random);
    next.empty = false;
    if (!random.one_in(50)) next.remaining = static_cast<std::uint64_t>(random.between(0, 5));
    const bool load = enable && last() && (full_speed || random.one_in(2));
    const LineRecord shown = line;
    const std::uint64_t x = line.backward ? line.start - drawn : line.start + drawn;
    const bool shown_valid = valid;
    if (enable) {
      valid = !last();
      ++drawn;
    }
    if (load) {
      valid = true;
      line = next;
      drawn = 0;
    }
    if (reset) valid = false;
    file.flag(reset).flag(enable).flag(load);
    next.add_to(file);
    file.flag(last()).flag(shown_valid).word(shown.triangle, Exact::c_triangle_bits);
    file.word(shown.y, Exact::c_pixel_y_bits).word(x, Exact::c_span_x_bits).end_vector();
  }
  file.write(folder / "spans.txt");
}

}  // namespace

std::vector<Entity> raster_entities() {
  return {
      {"edge_walker", write_edge_walker},
      {"slope_walker", write_slope_walker},
      {"line_counter", in_both_presets([]<class P>(const Folder& f) { write_counter<P>(f); })},
      {"edge_pair", in_both_presets([]<class P>(const Folder& f) { write_pair<P>(f); })},
      {"line_stage", write_line_stage},
      {"span_stage", write_span_stage},
      {"triangle_walker", in_both_presets([]<class P>(const Folder& f) { write_walker<P>(f); })},
  };
}

}  // namespace halfway::vectors
