// SPDX-License-Identifier: Apache-2.0
// Random strips of triangles and shadow polygons for the chain of object processors, as the host's vectors.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "golden/object_word.hpp"
#include "vectors/triangles.hpp"

namespace halfway::vectors {

/// Calls use(config, subpixels) for the hardware of each testbench of rtl/objects. tb_processors_pkg.vhd has
/// the same list.
template <class Use>
void for_each_object_front(Use&& use) {
  use.template operator()<words::Exact>(words::ProcessorsConfig{3, 1, 1, 0, true, true, true, true}, 16);
  use.template operator()<words::Published>(words::ProcessorsConfig{3, 1, 1, 1, true, true, true, false}, 4);
  use.template operator()<words::Exact>(words::ProcessorsConfig{3, 1, 0, 0, true, true, true, false}, 1);
  use.template operator()<words::Exact>(words::ProcessorsConfig{3, 1, 1, 0, true, true, true, true}, 1);
}

/// A triangle of a strip, and the lines of pixels on which a processor holds it.
struct StripTriangle {
  InitVector vector;
  std::uint32_t first_line, last_line;
};

/// The part of the frame that is scanned. `side`: subpixels per row of a pixel.
struct Strip {
  std::uint32_t y, lines, x, columns, side;

  /// The last column is before the first one. Then `columns` is 0, or a negative number wrapped.
  bool empty() const { return static_cast<std::int32_t>(columns) <= 0; }
};

/// The vectors of one host.
template <class Preset>
class ObjectScene {
 public:
  using Command = words::Command;

  ObjectScene(const words::ProcessorsConfig& config, int subpixels, std::uint64_t seed)
      : config_(config), layout_(config), side_(golden::side_of(subpixels)), random_(seed) {}

  Random& random() { return random_; }
  Strip any_strip() {
    const auto number = [&](std::int64_t low, std::int64_t high) {
      return static_cast<std::uint32_t>(random_.between(low, high));
    };
    return {number(0, 4000), number(1, 9), number(0, 4000), number(1, 12), static_cast<std::uint32_t>(side_)};
  }
  /// To the frame's last line and column, without columns, with a negative number of them, and the widest.
  std::vector<Strip> limit_strips() const {
    const auto side = static_cast<std::uint32_t>(side_);
    const auto widest = static_cast<std::uint32_t>(golden::most_columns<Preset>(side_ * side_));
    return {{4090, 6, 4084, 12, side}, {3, 4, 9, 0, side}, {3, 4, 9, ~2U, side}, {8, 1, 0, widest, side}};
  }
  /// A column more, and a line more, than a strip may have.
  std::vector<Strip> too_large_strips() const {
    const auto side = static_cast<std::uint32_t>(side_);
    return {{8, 1, 0, static_cast<std::uint32_t>(golden::most_columns<Preset>(side_ * side_) + 1), side},
            {0, static_cast<std::uint32_t>(golden::most_lines<Preset>(side_ * side_) + 1), 8, 1, side}};
  }

  InitVector strip_vector(const Strip& strip) {
    InitVector vector = request(Command::new_scanline);
    put(vector, At::y, strip.y);
    put(vector, At::upper_lines, strip.lines);
    put(vector, At::start_x, strip.x);
    put(vector, At::upper_x, strip.x + strip.columns);
    return vector;
  }
  InitVector end_vector() { return strip_vector({0, 0, 0, 1, 1}); }
  InitVector any_load(int most_light) {
    constexpr Command c_loads[] = {Command::define, Command::redefine, Command::remove, Command::new_frame};
    return load_vector(c_loads[random_.between(0, 3)], static_cast<int>(random_.between(0, most_light)));
  }
  InitVector load_vector(Command command, int light) {
    InitVector vector = request(command);
    golden::ShadingToken<Preset> token;
    token.command = command;
    token.light_number = static_cast<std::uint32_t>(light);
    token.light.around_eye = static_cast<int>(random_.between(0, 3) / 3);
    for (auto& place : token.light.place) place = static_cast<std::int64_t>(random_.bits(12));
    for (auto& intensity : token.light.intensity)
      intensity = static_cast<std::uint32_t>(random_.bits(8 + Preset::c_light_intensity_fraction_bits));
    token.encode(config_, vector);
    return vector;
  }

  /// Triangles in the order of their first lines, of which no line has more than `most`.
  std::vector<StripTriangle> triangles(const Strip& strip, int count, int most) {
    std::vector<StripTriangle> all;
    std::map<std::uint32_t, int> on_line;
    for (int i = 0; i < count; ++i) {
      std::optional<StripTriangle> triangle = any_triangle(strip);
      if (!triangle) continue;
      bool fits = true;
      for (std::uint32_t y = triangle->first_line; y <= triangle->last_line; ++y)
        fits = fits && on_line[y] < most;
      if (!fits) continue;
      for (std::uint32_t y = triangle->first_line; y <= triangle->last_line; ++y) ++on_line[y];
      all.push_back(*std::move(triangle));
    }
    std::stable_sort(all.begin(), all.end(), [](const StripTriangle& a, const StripTriangle& b) {
      return a.first_line < b.first_line;
    });
    return all;
  }

 private:
  using At = words::Exact::init_header_at;

  void put(InitVector& vector, const words::Field& field, std::uint64_t value) {
    set_bits(vector, field, value, layout_.walk_low());
  }
  InitVector request(Command command) {
    InitVector vector(static_cast<std::size_t>(layout_.init_bits() + 31) / 32);
    set_bits(vector, Preset::request_header_at::command, static_cast<std::uint32_t>(command));
    return vector;
  }

  std::optional<StripTriangle> any_triangle(const Strip& strip) {
    const std::int64_t width = 16 * strip.columns, height = 16 * strip.lines;
    std::array<ScreenPoint, 3> corners;
    for (ScreenPoint& p : corners)
      p = {static_cast<std::int32_t>(random_.between(-width / 2, width * 3 / 2)),
           static_cast<std::int32_t>(random_.between(-height / 3, height * 4 / 3))};
    if (random_.one_in(3)) {  // about the size of a pixel
      corners[1] = {corners[0].x + static_cast<std::int32_t>(random_.between(-20, 20)),
                    corners[0].y + static_cast<std::int32_t>(random_.between(-20, 20))};
      corners[2] = {corners[0].x + 17, corners[0].y - 9};
    }
    const std::uint32_t side = strip.side;
    const int unit_bits = side == 4 ? 2 : side == 2 ? 3 : 4;
    // Some have lines below the strip.
    const Walks walks =
        plan_walks(corners, unit_bits, FrameSize{strip.columns * side, (strip.lines + 2) * side});
    if (walks.empty()) return std::nullopt;
    auto one = triangle(walks[random_.between(0, static_cast<std::int64_t>(walks.size()) - 1)], side);
    if (one.first_line >= strip.lines) return std::nullopt;
    one.last_line = std::min(one.last_line, strip.lines - 1);
    return one;
  }

  StripTriangle triangle(const Walk& walk, std::uint32_t side) {
    using Request = typename Preset::request_header_at;
    InitVector vector = random_vector(random_, layout_.init_bits());
    const bool shadow = config_.shadows && random_.one_in(2);
    const auto command = shadow ? Command::shadow : Command::new_object;
    set_bits(vector, Request::command, static_cast<std::uint32_t>(command));
    if (shadow)
      set_bits(vector, Request::light, static_cast<std::uint64_t>(random_.between(1, config_.lights())));
    InitVector header(words::Exact::c_init_header_bits / 32);
    put_walk(header, walk);
    // Depths that cross, and many that are equal; some with all bits.
    const bool fine = random_.one_in(3);
    std::uint64_t z = static_cast<std::uint64_t>(random_.between(1, 6)) << 30;
    if (fine) z |= random_.bits(30);
    set_bits(header, At::z, z);
    std::uint64_t upper = 0;
    for (const words::Field* change : {&At::z_de0, &At::z_dx}) {
      std::int64_t value = 0;
      if (fine)
        value = random_.between(-(1 << 27), 1 << 27);
      else if (random_.one_in(2))
        value = random_.between(-1, 1) * (1 << 27);
      set_bits(header, *change, static_cast<std::uint64_t>(value));
      upper = upper << 3 | (value < 0 ? 7 : 0);
    }
    set_bits(header, At::z_de1, upper);
    set_bits(header, At::triangle, next_triangle_++);
    for (std::size_t i = 0; i < header.size(); ++i)
      words::set_bits(vector, {"", 32 * static_cast<int>(i), 32, false, 0}, header[i], layout_.walk_low());
    const auto first = static_cast<std::uint32_t>(walk.y);
    const auto last = static_cast<std::uint32_t>(walk.y + walk.upper_lines + walk.lower_lines - 1);
    return {std::move(vector), first / side, last / side};
  }

  words::ProcessorsConfig config_;
  words::ProcessorsLayout<Preset> layout_;
  int side_;
  Random random_;
  std::uint32_t next_triangle_ = 1;
};

}  // namespace halfway::vectors
