// SPDX-License-Identifier: Apache-2.0
// The chain of object processors compared with a model without a chain: for each pixel the coverage by a walk
// of all subpixels, values by a product, then sort and resolve.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdlib>
#include <set>
#include <tuple>

#include "golden/object_front.hpp"
#include "vectors/object_scene.hpp"

namespace halfway::vectors {
namespace {

using words::Command, words::Exact, words::ProcessorsConfig;

// What is compared of a token.
struct Shown {
  Command command;
  std::uint32_t y, x, z, triangle, mask;
  // N, P, 1/w; material; light, opens, normalize. Zero if the token has none.
  std::array<std::int64_t, 20> values{};
  bool operator==(const Shown&) const = default;
};
void PrintTo(const Shown& s, std::ostream* out) {
  *out << static_cast<int>(s.command) << " at " << s.y << ',' << s.x << " z " << s.z << " triangle "
       << s.triangle << " mask " << s.mask;
  for (const std::int64_t value : s.values) *out << ' ' << value;
}

template <class Preset>
Shown shown(const golden::ShadingToken<Preset>& t, std::uint32_t mask) {
  const auto i64 = [](auto value) { return static_cast<std::int64_t>(value); };
  return {t.command,
          t.y,
          t.x,
          t.z,
          t.triangle,
          mask,
          {t.normal[0],        t.normal[1],        t.normal[2],         t.place[0],        t.place[1],
           t.place[2],         t.distance,         i64(t.exponent),     i64(t.ambient[0]), i64(t.ambient[1]),
           i64(t.ambient[2]),  i64(t.diffuse[0]),  i64(t.diffuse[1]),   i64(t.diffuse[2]), i64(t.specular[0]),
           i64(t.specular[1]), i64(t.specular[2]), i64(t.light_number), i64(t.opens),      i64(t.normalize)}};
}

template <class Preset>
std::vector<Shown> tokens_of(const std::vector<InitVector>& vectors, const ProcessorsConfig& config,
                             int subpixels, int objects, bool* fault = nullptr) {
  golden::ObjectFront<Preset> front(config, subpixels, objects);
  std::vector<Shown> tokens;
  for (const InitVector& vector : vectors)
    front.take(vector, [&](const auto& t, std::uint32_t mask, bool ends) {
      if (ends) return;
      tokens.push_back(shown(t, mask));
    });
  EXPECT_FALSE(front.busy());
  if (fault) *fault = front.fault();
  return tokens;
}

// Subpixels (y, x) of a walk.
std::set<std::array<std::int64_t, 2>> covered_by(const InitVector& walk) {
  std::set<std::array<std::int64_t, 2>> covered;
  for (const WalkedLine& line : walk_lines<Exact>(walk))
    for (std::int64_t i = 0; i < line.pixels(); ++i)
      covered.insert({line.y, line.start.value() + (line.backward ? -i : i)});
  return covered;
}

template <class Preset>
class Unordered {
 public:
  Unordered(const ProcessorsConfig& config, const Strip& strip) : config_(config), strip_(strip) {}

  std::vector<Shown> tokens(const std::vector<StripTriangle>& triangles) const {
    for (const StripTriangle& t : triangles) coverage_.push_back(covered_by(header_of(t)));
    std::vector<Shown> all;
    for (std::uint32_t y = 0; y < strip_.lines; ++y) {
      bool line = true;
      for (std::uint32_t x = 0; x < strip_.columns; ++x) {
        const std::vector<Shown> list = resolved(triangles, y, x);
        const bool filtered = strip_.side > 1;
        if (list.empty() && !filtered) continue;
        if (config_.shadows || filtered)
          all.push_back({line ? Command::new_scanline : Command::new_pixel, strip_.y + y, strip_.x + x});
        line = false;
        all.insert(all.end(), list.begin(), list.end());
      }
    }
    return all;
  }

 private:
  using At = Exact::init_header_at;

  static InitVector header_of(const StripTriangle& t) {
    const auto walk = golden::walk_of<Preset>(t.vector);
    return {walk.begin(), walk.end()};
  }

  // value + columns * dx + lines * dy, in eighths of a pixel.
  static std::uint64_t at(std::uint64_t value, std::int64_t dx, std::int64_t dy, std::int64_t columns,
                          std::int64_t lines) {
    return (8 * value + static_cast<std::uint64_t>(columns * dx) + static_cast<std::uint64_t>(lines * dy)) >>
           3;
  }
  // de1 has the upper bits of the changes, which have three more than the value.
  template <int W>
  static std::uint64_t at(std::span<const std::uint32_t> vector, int low, const words::Field& value,
                          const words::Field& dx, const words::Field& de0, const words::Field& de1,
                          std::int64_t columns, std::int64_t lines) {
    const auto change = [&](const words::Field& field, int upper_low) {
      const std::uint64_t upper = get_bits(vector, de1, low) >> upper_low & 7;
      return words::Word<W + 3>::from_bits(get_bits(vector, field, low) | upper << W).value();
    };
    return at(get_bits(vector, value, low), change(dx, 0), change(de0, 3), columns, lines);
  }

  Shown element(const StripTriangle& t, std::size_t number, std::uint32_t y, std::uint32_t x) const {
    using Plane = typename Preset::plane_header_at;
    constexpr int c_walk = words::ProcessorsLayout<Preset>::walk_low();
    const std::uint32_t side = strip_.side;
    std::uint32_t mask = 0;
    for (std::uint32_t i = 0; i < side * side; ++i)
      mask |= static_cast<std::uint32_t>(coverage_[number].count({side * y + i / side, side * x + i % side}))
              << i;
    golden::ShadingToken<Preset> e;
    e.y = strip_.y + y;
    e.x = strip_.x + x;
    if (mask == 0) return shown(e, mask);
    // Eighths from the strip's first pixel to the point.
    std::int64_t columns = 8 * x, lines = 8 * y - 8 * (static_cast<std::uint32_t>(t.first_line));
    bool centre = true;
    for (std::uint32_t row = (side - 1) / 2; row <= side / 2; ++row)
      for (std::uint32_t column = (side - 1) / 2; column <= side / 2; ++column)
        centre = centre && (mask >> (side * row + column) & 1) != 0;
    if (!centre) {
      const int first = std::countr_zero(mask), n = static_cast<int>(side);
      columns += (2 * (first % n) + 1 - n) * 4 / n;
      lines += (2 * (first / n) + 1 - n) * 4 / n;
    }
    const std::uint64_t z =
        at<Exact::c_depth_sum_bits>(t.vector, c_walk, At::z, At::z_dx, At::z_de0, At::z_de1, columns, lines);
    e.z = static_cast<std::uint32_t>(words::low_bits(z >> Exact::c_depth_sum_fraction_bits, 24));
    e.triangle = static_cast<std::uint32_t>(get_bits(t.vector, At::triangle, c_walk));
    e.decode_request(t.vector);
    if (e.command == Command::shadow) return shown(e, mask);
    e.decode_material(config_, t.vector);
    const words::ProcessorsLayout<Preset> layout(config_);
    for (int p = 0; p < layout.planes(); ++p) {
      const std::uint64_t sum = at<Preset::c_plane_sum_bits>(
          t.vector, layout.plane_low(p), Plane::value, Plane::dx, Plane::de0, Plane::de1, columns, lines);
      auto& value = p < 3 ? e.normal[p] : p < 6 ? e.place[p - 3] : e.distance;
      value = words::Word<Preset::c_plane_sum_bits>::from_bits(sum).value() >>
              (Preset::c_plane_sum_bits - Preset::c_vector_bits);
    }
    return shown(e, mask);
  }

  std::vector<Shown> resolved(const std::vector<StripTriangle>& triangles, std::uint32_t y,
                              std::uint32_t x) const {
    const std::uint32_t side = strip_.side, full = (1U << (side * side)) - 1;
    const std::uint32_t right_below_centre = 1U << (side * (side / 2) + side / 2);
    std::vector<Shown> all;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      Shown e = element(triangles[i], i, y, x);
      if (e.command == Command::shadow) {
        if ((e.mask & right_below_centre) == 0) continue;
        e.mask = 0;
        all.push_back(e);
      } else if (e.mask != 0) {
        all.push_back(e);
      }
    }
    std::sort(all.begin(), all.end(), [](const Shown& a, const Shown& b) {
      return std::tuple(a.z, a.command == Command::shadow, a.triangle) <
             std::tuple(b.z, b.command == Command::shadow, b.triangle);
    });
    std::uint32_t before = 0;
    std::vector<Shown> left;
    for (Shown e : all) {
      const std::uint32_t mask = e.mask;
      e.mask &= ~before;
      if (e.command == Command::shadow ? before != full : e.mask != 0) left.push_back(e);
      before |= mask;
    }
    return left;
  }

  ProcessorsConfig config_;
  Strip strip_;
  mutable std::vector<std::set<std::array<std::int64_t, 2>>> coverage_;
};

template <class Preset>
void compare_strips(const ProcessorsConfig& config, int subpixels) {
  ObjectScene<Preset> scene(config, subpixels, 77);
  std::size_t compared = 0;
  std::vector<Strip> strips = scene.limit_strips();
  for (int i = 0; i < 60; ++i) strips.push_back(scene.any_strip());
  for (std::size_t i = 0; i < strips.size(); ++i) {
    const Strip& strip = strips[i];
    if (strip.empty()) continue;
    const int most = 1 + static_cast<int>(i) % 12;
    std::vector<StripTriangle> triangles = scene.triangles(strip, 40, most);
    const auto vectors = [&] {
      std::vector<InitVector> all{scene.strip_vector(strip)};
      for (const StripTriangle& t : triangles) all.push_back(t.vector);
      all.push_back(scene.end_vector());
      return all;
    };
    bool fault = true;
    const std::vector<Shown> tokens = tokens_of<Preset>(vectors(), config, subpixels, most, &fault);
    EXPECT_FALSE(fault);
    ASSERT_EQ(tokens, Unordered<Preset>(config, strip).tokens(triangles)) << "strip " << i;
    compared += tokens.size();
    // More processors, and another order of the triangles that start on one line.
    std::reverse(triangles.begin(), triangles.end());
    std::stable_sort(triangles.begin(), triangles.end(),
                     [](const auto& a, const auto& b) { return a.first_line < b.first_line; });
    for (const int objects : {most, most + 1, 40})
      ASSERT_EQ(tokens_of<Preset>(vectors(), config, subpixels, objects), tokens) << "strip " << i;
  }
  EXPECT_GT(compared, 1000U);
}

TEST(Objects, TheChainSortsAndResolves) {
  for_each_object_front([]<class Preset>(const ProcessorsConfig& config, int subpixels) {
    compare_strips<Preset>(config, subpixels);
  });
}

// Exact values in 1/8192 units: the true start, dx and dy are multiples of 1/1024 and are rounded to units.
TEST(Objects, InterpolatedValuesKeepTheirBound) {
  constexpr std::int64_t c_unit = 1024, c_eighths = 8;
  using Interpolator = golden::RasterInterpolator<30>;
  Random random(9);
  std::int64_t centre_worst = 0, subpixel_worst = 0;
  for (int i = 0; i < 200000; ++i) {
    // Often just below a half.
    const auto any = [&] {
      return random.between(-100, 100) * c_unit +
             (random.one_in(2) ? c_unit / 2 - 1 : random.between(0, c_unit - 1));
    };
    const std::int64_t start = any(), dx = any(), dy = any();
    const auto rounded = [](std::int64_t value) {
      return static_cast<std::uint64_t>((value + c_unit / 2) >> 10);
    };
    using Change = Interpolator::Change;
    Interpolator interpolator;
    interpolator.load(Interpolator::Value::from_bits(rounded(start)), Change::from_bits(rounded(dx)),
                      Change::from_bits(rounded(dy)));
    const std::int64_t lines = random.between(0, 3), pixels = random.between(0, 3);
    for (std::int64_t line = 0; line <= lines; ++line) interpolator.line_step();
    for (std::int64_t pixel = 0; pixel < pixels; ++pixel) interpolator.pixel_step();
    const auto excess = [&](std::int64_t value, std::int64_t columns, std::int64_t rows) {
      const std::int64_t exact =
          c_eighths * start + (c_eighths * pixels + columns) * dx + (c_eighths * lines + rows) * dy;
      return std::abs(c_eighths * c_unit * value - exact) - c_eighths * c_unit * (1 + lines + pixels) / 2;
    };
    centre_worst = std::max(centre_worst, excess(interpolator.value().value(), 0, 0));
    const int side = random.one_in(2) ? 2 : 4;
    const auto row = static_cast<int>(random.between(0, side - 1)),
               column = static_cast<int>(random.between(0, side - 1));
    const auto eighths = [&](int index) { return (2 * index + 1 - side) * 4 / side; };
    subpixel_worst = std::max(
        subpixel_worst, excess(interpolator.value(side, row, column).value(), eighths(column), eighths(row)));
  }
  EXPECT_EQ(centre_worst, 0);
  EXPECT_LE(subpixel_worst, c_eighths * c_unit * 5 / 4);
  EXPECT_GT(subpixel_worst, c_eighths * c_unit * 6 / 5);
}

TEST(Objects, ReachTheLastColumnOfTheWidestStrip) {
  for_each_object_front([]<class Preset>(const ProcessorsConfig& config, int subpixels) {
    ObjectScene<Preset> scene(config, subpixels, 1);
    const Strip strip = scene.limit_strips().back();
    ASSERT_EQ(strip.columns, static_cast<std::uint32_t>(golden::most_columns<Preset>(subpixels)));
    const std::vector<StripTriangle> triangles = scene.triangles(strip, 200, 40);
    std::vector<InitVector> vectors{scene.strip_vector(strip)};
    for (const StripTriangle& t : triangles) vectors.push_back(t.vector);
    vectors.push_back(scene.end_vector());
    const std::vector<Shown> tokens = tokens_of<Preset>(vectors, config, subpixels, 40);
    EXPECT_EQ(tokens, Unordered<Preset>(config, strip).tokens(triangles));
    ASSERT_FALSE(tokens.empty());
    EXPECT_EQ(tokens.back().x, strip.columns - 1);
  });
}

TEST(Objects, LargerStripsAreRefused) {
  for_each_object_front([]<class Preset>(const ProcessorsConfig& config, int subpixels) {
    ObjectScene<Preset> scene(config, subpixels, 1);
    const auto faulty = [&](const Strip& strip) {
      bool fault = false;
      tokens_of<Preset>({scene.strip_vector(strip), scene.end_vector()}, config, subpixels, 1, &fault);
      return fault;
    };
    for (Strip strip : scene.too_large_strips()) {
      EXPECT_TRUE(faulty(strip));
      (strip.lines == 1 ? strip.columns : strip.lines) -= 1;
      EXPECT_FALSE(faulty(strip));
    }
  });
}

TEST(Objects, LoadsInAStripAreRefused) {
  for_each_object_front([]<class Preset>(const ProcessorsConfig& config, int subpixels) {
    ObjectScene<Preset> scene(config, subpixels, 1);
    const InitVector strip = scene.strip_vector(scene.any_strip()), end = scene.end_vector();
    for (const Command command : {Command::define, Command::redefine, Command::remove, Command::new_frame}) {
      const InitVector load = scene.load_vector(command, 0);
      bool fault = true;
      const auto tokens = tokens_of<Preset>({load, strip, end}, config, subpixels, 1, &fault);
      EXPECT_FALSE(fault);
      EXPECT_EQ(tokens.front().command, command);
      // The strip ends as it does without the load.
      EXPECT_EQ(tokens_of<Preset>({strip, load, end}, config, subpixels, 1, &fault),
                std::vector(tokens.begin() + 1, tokens.end()));
      EXPECT_TRUE(fault);
    }
  });
}

// The masks are the coverage of a frame four times as wide and high.
TEST(Objects, MasksAreTheCoverageOfALargerFrame) {
  constexpr std::uint32_t c_columns = 9, c_lines = 7, c_side = 4;
  Random random(5);
  std::size_t covered = 0;
  for (int i = 0; i < 300; ++i) {
    std::array<ScreenPoint, 3> corners, larger;
    for (std::size_t k = 0; k < 3; ++k) {
      corners[k] = {static_cast<std::int32_t>(random.between(-80, 220)),
                    static_cast<std::int32_t>(random.between(-40, 160))};
      larger[k] = {corners[k].x * 4, corners[k].y * 4};
    }
    const FrameSize frame{c_columns * c_side, c_lines * c_side};
    std::set<std::array<std::int64_t, 2>> expected, got;
    for (const Walk& walk : plan_walks(larger, 4, frame)) {
      InitVector header(Exact::c_init_header_bits / 32);
      put_walk(header, walk);
      expected.merge(covered_by(header));
    }
    for (const Walk& walk : plan_walks(corners, 2, frame)) {
      InitVector header(Exact::c_init_header_bits / 32);
      put_walk(header, walk);
      golden::ObjectEdges edges(c_side);
      edges.load(header);
      for (std::int64_t y = walk.y / c_side; edges.more(); ++y) {
        edges.line_step();
        for (std::uint32_t x = 0; x < c_columns; ++x, edges.pixel_step())
          for (std::uint32_t bit = 0; bit < c_side * c_side; ++bit)
            if ((edges.mask() >> bit & 1) != 0)
              got.insert({c_side * y + bit / c_side, c_side * x + bit % c_side});
      }
    }
    ASSERT_EQ(got, expected) << "triangle " << i;
    covered += got.size();
  }
  EXPECT_GT(covered, 10000U);
}

}  // namespace
}  // namespace halfway::vectors
