// SPDX-License-Identifier: Apache-2.0
// The search over triangles on the screen: coverage, colour and depth of the quadratic shader.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "golden_run/golden_run.hpp"
#include "projection/project.hpp"
#include "setup/quadratic_setup.hpp"
#include "setup/test/random_triangles.hpp"
#include "specification/hard_cases/screen_drawing.hpp"
#include "specification/hard_cases/search.hpp"
#include "words/formats.hpp"
#include "words/init_vector.hpp"

namespace halfway::stability {
namespace {

using words::Exact;

constexpr int c_sample_bits = Exact::c_intensity_fraction_bits;
constexpr int c_depth_bits = Exact::c_depth_sum_fraction_bits;
constexpr std::int64_t c_greatest_sample = std::int64_t{1023} << c_sample_bits;
constexpr std::int64_t c_least_depth = std::int64_t{1} << c_depth_bits,
                       c_greatest_depth = std::int64_t{(1 << 24) - 3} << c_depth_bits;
constexpr std::int64_t c_least_place = c_guard_begin * 16, c_greatest_place = c_guard_end * 16;

HardwareKey key_of(unsigned channels) {
  return {.shader = Shader::quadratic, .preset = Preset::exact, .channels = channels};
}

// An input in the units of the setup.
struct Subject {
  FrameSize frame;
  unsigned channels;
  int unit_bits;
  Points whole, piece;  ///< in 1/2^unit_bits pixels
  std::array<std::int64_t, 3> depth;
  ChannelSamples sample;
};

std::int64_t wide(RandomTriangles& random, std::int64_t least, std::int64_t greatest) {
  const std::int64_t any =
      std::int64_t{random.within(0, (1 << 24) - 1)} << 24 | random.within(0, (1 << 24) - 1);
  return least + any % (greatest - least + 1);
}
// All sizes, but mostly small frames, so that many triangles fit into a minute.
FrameSize random_frame(RandomTriangles& random) {
  const auto side = [&](int most) { return static_cast<std::uint32_t>(random.within(1, most)); };
  const int draw = random.within(0, 99'999);
  if (draw < 10) return {4096, 4096};
  if (draw < 500) return {4096, side(12)};
  if (draw < 1'000) return {side(12), 4096};
  if (draw < 9'000) return {side(320), side(240)};
  return {side(64), side(64)};
}
// Moves the triangle so that a point of its piece lies in the frame, within the limits of the guard band.
void bring_into_frame(RandomTriangles& random, FrameSize frame, const Points& piece, int level,
                      Points& corners) {
  const int share = random.within(0, 64), other = random.within(0, 64 - share);
  const auto move = [&](std::int32_t ScreenPoint::* axis, std::uint32_t side) {
    const auto at = [&](std::size_t n) { return std::int64_t{piece[n].*axis} >> level; };
    const auto [least, greatest] = std::minmax({corners[0].*axis, corners[1].*axis, corners[2].*axis});
    const std::int64_t place = (share * at(0) + other * at(1) + (64 - share - other) * at(2)) / 64,
                       to = random.within(0, static_cast<int>(side) * 16);
    const std::int64_t by = std::clamp(to - place, c_least_place - least, c_greatest_place - greatest);
    for (ScreenPoint& p : corners) p.*axis += static_cast<std::int32_t>(by);
  };
  move(&ScreenPoint::x, frame.width);
  move(&ScreenPoint::y, frame.height);
}

// The quarter of each of `level` splits is two bits of `path`.
Points piece_of(Points whole, int level, int path) {
  for (int i = 0; i < level; ++i) whole = quarters(whole)[static_cast<std::size_t>(path >> (2 * i) & 3)];
  return whole;
}

Subject subject_of(std::uint32_t seed) {
  RandomTriangles random(seed);
  Subject s;
  s.frame = random_frame(random);
  s.channels = random.within(0, 3) == 0 ? 3 : 1;
  const int level = std::max(0, random.within(-5, 5)), path = random.within(0, (1 << (2 * level)) - 1);
  s.unit_bits = c_subpixel_bits + level;
  const TriangleKind kind =
      c_triangle_kinds[static_cast<std::size_t>(random.within(0, c_triangle_kinds.size() - 1))];
  s.whole = random.next(kind, c_subpixel_bits, s.frame);
  const auto clamped = [](std::int32_t at) {
    return static_cast<std::int32_t>(std::clamp<std::int64_t>(at, c_least_place, c_greatest_place));
  };
  for (ScreenPoint& p : s.whole) p = {clamped(p.x), clamped(p.y)};
  if (random.within(0, 3) > 0)
    bring_into_frame(random, s.frame, piece_of(s.whole, level, path), level, s.whole);
  s.piece = piece_of(s.whole, level, path);
  for (ScreenPoint& p : s.whole) p = {p.x << level, p.y << level};
  const int deep = random.within(0, 2);
  for (std::int64_t& depth : s.depth)
    depth = deep == 0 ? (random.within(0, 1) == 0 ? c_least_depth : c_greatest_depth)
                      : wide(random, c_least_depth, c_greatest_depth);
  const int bright = random.within(0, 3);
  for (auto& channel : s.sample)
    for (double& sample : channel) {
      const std::int64_t any = wide(random, 0, c_greatest_sample);
      sample = std::ldexp(double(bright == 0   ? (any & 1) * any                        // 0 or odd
                                 : bright == 1 ? (any & 1) * c_greatest_sample          // an end of the range
                                 : bright == 2 ? any >> c_sample_bits << c_sample_bits  // an integer
                                               : any / 4),  // within the range that a frame stores
                          -c_sample_bits);
    }
  return s;
}

void append(const Subject& s, std::uint32_t triangle, std::vector<std::uint32_t>& words) {
  const Walks walks = plan_walks(s.piece, s.unit_bits, s.frame);
  if (walks.empty()) return;
  halfway::append_exact(
      {words, static_cast<int>(s.channels)},
      {triangle, s.piece, s.unit_bits, walks, DepthFit(s.whole, s.unit_bits, s.depth), s.sample});
}

class TriangleSearch final : public Search {
 public:
  explicit TriangleSearch(SimulatorFolders folders)
      : folders_(std::move(folders)), golden_{make_golden_model(key_of(1)), make_golden_model(key_of(3))} {}

  std::string check(std::uint32_t seed, Tally& tally) override {
    const Subject s = subject_of(seed);
    ++tally.inputs;
    words_.clear();
    if (fragments_.capacity() > c_most_kept)
      fragments_ = {};
    else
      fragments_.clear();
    append(s, c_tag, words_);
    golden_[s.channels == 3]->draw(words_, fragments_);
    tally.fragments += fragments_.size();
    const auto place_of = [](const Fragment& f) { return std::tuple(f.y, f.x); };
    if (!std::ranges::is_sorted(fragments_, {}, place_of)) std::ranges::sort(fragments_, {}, place_of);
    std::string wrong;
    std::uint64_t pixels = 0;  // too many or too few
    const auto uncovered = [&](const Fragment& f) {
      if (pixels++ == 0) wrong = fmt::format("pixel {},{} is not covered, or is drawn twice", f.x, f.y);
    };
    std::size_t at = 0;
    std::int64_t first_y = -1;
    Worst colour, z;
    for_each_covered_span(s.piece, s.unit_bits, s.frame,
                          [&](std::int64_t y, std::int64_t begin, std::int64_t end) {
                            if (first_y < 0) first_y = y;
                            const auto before = [&](std::int64_t x) {
                              return at < fragments_.size() &&
                                     std::tuple(fragments_[at].y, fragments_[at].x) < std::tuple(y, x);
                            };
                            // Lines, one carry each, and the line's pixels from either end.
                            const auto steps = static_cast<long double>(2 * (y - first_y) + end - begin - 1);
                            for (std::int64_t x = begin; x < end; ++x) {
                              while (before(x)) uncovered(fragments_[at++]);
                              if (at == fragments_.size() || fragments_[at].y != y || fragments_[at].x != x) {
                                if (pixels++ == 0)
                                  wrong = fmt::format("pixel {},{} is covered but not drawn", x, y);
                              } else {
                                compare(s, fragments_[at++], steps, colour, z);
                              }
                            }
                          });
    while (at < fragments_.size()) uncovered(fragments_[at++]);

    Worst coverage;
    coverage.add(static_cast<double>(pixels), 0, [&] { return wrong; });
    std::string failure =
        tally.add("coverage", coverage) + tally.add("colour", colour) + tally.add("depth", z);
    if (std::ranges::any_of(fragments_, [](const Fragment& f) { return f.triangle != c_tag; }))
      failure += "a fragment has another triangle's number";
    return failure;
  }

  Result<std::string> check_rtl(std::span<const std::uint32_t> seeds, Tally& tally) override {
    for (const unsigned channels : {1u, 3u}) {
      words_.clear();
      std::uint64_t count = 0;
      for (std::size_t i = 0; i < seeds.size(); ++i) {
        const Subject s = subject_of(seeds[i]);
        if (s.channels != channels) continue;
        append(s, static_cast<std::uint32_t>(i), words_);
        ++count;
      }
      Trial trial(folders_, rtl_, true);
      trial.draw(key_of(channels), words_);
      auto failure = rtl_failure(trial, count, tally);
      if (!failure || !failure->empty()) return failure;
    }
    return std::string();
  }

 private:
  static constexpr std::uint32_t c_tag = 0xA5C3'0F96;
  // A largest frame has 256 MB of fragments; limit the number of threads that hold so many.
  static constexpr std::size_t c_most_kept = 1 << 20;

  // Measures the error beyond the half step of rounding, after `steps` steps to the pixel. Each word is
  // rounded to half its last place (formats: intensity, depth_sum). Samples and depths are exact here. The
  // last term of a bound is the error of long double.
  static void compare(const Subject& s, const Fragment& f, long double steps, Worst& colour, Worst& z) {
    const auto at = [&](const Points& points) {
      return barycentric(points, centre(f.x, s.unit_bits), centre(f.y, s.unit_bits)).real();
    };
    const auto add = [&](Worst& worst, long double off, long double bound) {
      worst.add(static_cast<double>(std::max(off - 0.5L, 0.0L)), static_cast<double>(bound),
                [&] { return fmt::format("pixel {},{}, steps above its rounding", f.x, f.y); });
    };
    const auto colour_bound = std::ldexp(1 + steps + steps * (steps - 1) / 2, -c_sample_bits - 1) + 0x1p-48L;
    const std::array<long double, 3> p = at(s.piece);
    for (std::size_t c = 0; c < 3; ++c) {
      std::array<long double, 6> sample;
      std::ranges::copy(s.sample[s.channels == 3 ? c : 0], sample.begin());
      add(colour, std::abs(channels(f)[c] - std::clamp(quadratic(p, sample), 0.0L, 255.0L)), colour_bound);
    }
    std::array<long double, 3> depth;
    std::ranges::copy(s.depth, depth.begin());
    add(z, std::abs(f.z - std::ldexp(linear(at(s.whole), depth), -c_depth_bits)),
        std::ldexp(1 + steps, -c_depth_bits - 1) + 0x1p-34L);
  }

  SimulatorFolders folders_;
  std::array<std::unique_ptr<GoldenModel>, 2> golden_;
  Simulators rtl_;
  std::vector<std::uint32_t> words_;
  std::vector<Fragment> fragments_;
};

}  // namespace

std::unique_ptr<Search> make_triangle_search(const SimulatorFolders& folders) {
  return std::make_unique<TriangleSearch>(folders);
}

}  // namespace halfway::stability
