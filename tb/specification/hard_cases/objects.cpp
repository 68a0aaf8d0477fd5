// SPDX-License-Identifier: Apache-2.0
// The object processors with 16 subpixels. An object of a pixel has one depth and one colour, of one point:
// the pixel's centre if the four subpixels around it are covered, otherwise the first covered subpixel. Both
// are measured at the subpixels that show the object.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <map>
#include <utility>

#include "golden/fragment_output.hpp"
#include "golden/object_front.hpp"
#include "golden/shading_pipeline.hpp"
#include "scene/test/random_scenes.hpp"
#include "specification/hard_cases/hard_case.hpp"
#include "specification/hard_cases/measure.hpp"
#include "specification/hard_cases/shading_bound.hpp"
#include "specification/hard_cases/trial.hpp"

namespace halfway::stability {
namespace {

constexpr unsigned c_objects = 4;  // processors, and triangles of a scene
constexpr int c_side = 4;
constexpr FrameSize c_frame{6, 4};
// From the first covered subpixel to another one: a pixel less one subpixel, in x and in y.
constexpr long double c_farthest = 0.75L;

// Slivers and small triangles that cover each other within a pixel, in the light of a lamp close to them and
// of a sun that grazes them.
Scene scene_of(RandomScenes& random) {
  Scene scene;
  scene.materials = {{.name = "m", .colour = {0.9, 0.6, 0.3}, .diffuse = 0.5, .specular = 0.5}};
  scene.materials[0].exponent = random.log_within(1.0, 300.0);
  random.add_triangles(scene, c_objects, random.log_within(0.3, 2.0), 0.6);
  auto& p = scene.positions_world;
  for (std::size_t i = 0; i < p.size(); i += 3)
    p[i + 2] = glm::mix(glm::mix(p[i], p[i + 1], random.within(0, 1)), p[i + 2], random.log_within(0.03, 1));
  scene.directional = {{glm::normalize(random.cube() + glm::dvec3(1, 0, -0.5)), glm::dvec3(0.8)}};
  scene.positional = {{random.cube() + glm::dvec3(0, 0, 1), {0.7, 0.8, 0.9}}};
  return scene;
}

struct Element {
  Fragment fragment;  ///< with the object's own colour, before the filter
  std::uint32_t shown;
};

std::vector<Element> elements_of(const Drawing& drawing) {
  const words::ProcessorsConfig config = processors_config(drawing.key);
  golden::ObjectFront<words::Exact> front(config, c_side * c_side, c_objects);
  golden::ShadingPipeline<words::Exact> pipeline(config);
  std::vector<Element> elements;
  for (std::span<const std::uint32_t> rest = drawing.words; !rest.empty();
       rest = rest.subspan(drawing.vector_words()))
    front.take(rest, [&](auto token, std::uint32_t mask, bool) {
      if (!words::is_head(token.command) && pipeline.process(token))
        elements.push_back({golden::fragment_output(token, config.channels), mask});
    });
  return elements;
}

// The subpixels are the pixels of a larger frame.
HalfUnits subpixel(int number, int x, int y) {
  return {centre(c_side * x + number % c_side, c_subpixel_bits - 2),
          centre(c_side * y + number / c_side, c_subpixel_bits - 2)};
}
std::uint32_t covered(const ScreenTriangle& t, int x, int y) {
  std::uint32_t mask = 0;
  for (int i = 0; i < c_side * c_side; ++i)
    if (covers(screen_points(t), c_subpixel_bits - 2, c_side * x + i % c_side, c_side * y + i / c_side))
      mask |= 1U << i;
  return mask;
}

// An object of a pixel.
struct Object {
  const ScreenTriangle& triangle;
  const Fragment& fragment;
  HalfUnits computed;            ///< where its depth and colour are computed
  std::vector<HalfUnits> shown;  ///< subpixels
  const std::vector<ScreenTriangle>& all;
  const ShadingBound& bound;
  std::string where;
};

template <class Each>
void for_each_object(Trial& trial, Each&& each) {
  RandomScenes random(16);
  for (int i = 0; i < trial.rounds(100, 4000); ++i) {
    const Scene scene = scene_of(random);
    const Drawing drawing = trial.draw(
        scene, {.plan = {.shader = Shader::processors, .objects = c_objects, .subpixels = c_side * c_side},
                .frame = c_frame});
    const Pieces pieces(scene, c_frame);
    const ShadingBound bound(scene, c_frame);
    std::map<std::pair<int, int>, std::uint32_t> missing;
    for (int y = 0; y < int(c_frame.height); ++y)
      for (int x = 0; x < int(c_frame.width); ++x)
        for (const ScreenTriangle& t : pieces.all()) missing[{x, y}] |= covered(t, x, y);
    for (const auto& [f, shown] : elements_of(drawing)) {
      const std::string where = fmt::format("scene {}, pixel ({}, {}), triangle {}", i, f.x, f.y, f.triangle);
      const auto t = std::ranges::find(pieces.all(), f.triangle, &ScreenTriangle::source);
      const std::uint32_t mask = t == pieces.all().end() ? 0 : covered(*t, f.x, f.y);
      trial.require((shown & ~mask) == 0, [&] { return where + " is shown where it is not"; });
      if ((shown & ~mask) != 0) continue;
      missing[{f.x, f.y}] &= ~shown;
      const HalfUnits middle{centre(f.x, c_subpixel_bits), centre(f.y, c_subpixel_bits)};
      Object object{*t,
                    f,
                    (mask & 0x0660) == 0x0660 ? middle : subpixel(std::countr_zero(mask), f.x, f.y),
                    {},
                    pieces.all(),
                    bound,
                    where};
      for (int s = 0; s < c_side * c_side; ++s)
        if ((shown >> s & 1) != 0) object.shown.push_back(subpixel(s, f.x, f.y));
      each(object);
    }
    for (const auto& pixel : missing)
      trial.require(pixel.second == 0, [&] {
        return fmt::format("scene {}: subpixels {:#x} of pixel ({}, {}) show nothing", i, pixel.second,
                           pixel.first.first, pixel.first.second);
      });
  }
}

long double pixels(Wide half_units) {
  return std::ldexp((long double)half_units, -c_subpixel_bits - 1);
}

void distances(Trial& trial) {
  for_each_object(trial, [&](const Object& o) {
    for (const HalfUnits& at : o.shown)
      trial.ours(std::hypot(pixels(at.x - o.computed.x), pixels(at.y - o.computed.y)),
                 std::hypot(c_farthest, c_farthest), [&] { return o.where; });
  });
}

// N, L and V change from the computed point to the subpixel: this bounds the change of the colour.
void colours(Trial& trial) {
  const auto lit = [](std::size_t) { return true; };
  double most = 0.0;
  int objects = 0, changed = 0;
  for_each_object(trial, [&](const Object& o) {
    double change = 0.0;
    const auto measure = [&](const HalfUnits& at, auto&& add) {
      const Promise promise = o.bound.between(o.triangle, at, o.computed, lit);
      for (std::size_t c = 0; c < 3; ++c)
        add(std::abs(promise.exact[c] - channels(o.fragment)[c]), promise.bound(c));
    };
    measure(o.computed, [&](long double error, long double bound) {
      trial.require(error <= bound,
                    [&] { return fmt::format("{}: {} of {} steps at its point", o.where, error, bound); });
    });
    for (const HalfUnits& at : o.shown)
      if (at != o.computed)
        measure(at, [&](long double error, long double bound) {
          trial.ours(error, bound, [&] { return o.where; });
          change = std::max(change, double(error));
        });
    most = std::max(most, change);
    ++objects;
    changed += change > 1.0;
  });
  trial.remark(fmt::format("{} of {} objects of a pixel differ by more than one step, by up to {:.3g}",
                           changed, objects, most));
}

long double depth_at(const ScreenTriangle& t, HalfUnits at) {
  std::array<long double, 3> z;
  for (std::size_t i = 0; i < 3; ++i) z[i] = depth_steps(t.vertex[i].z);
  return linear(barycentric(screen_points(t), at.x, at.y).real(), z);
}
// The largest change of a triangle's depth from its computed point to another subpixel, and the error at the
// point: of a vertex, of raster_interpolator, and of rounding.
long double depth_change(const ScreenTriangle& t) {
  const Wide pixel = Wide{1} << (c_subpixel_bits + 1);
  const long double z = depth_at(t, {0, 0});
  return c_farthest * (std::abs(depth_at(t, {pixel, 0}) - z) + std::abs(depth_at(t, {0, pixel}) - z));
}
constexpr long double c_depth_error = 0.5L + (0.5L + (1 + c_frame.height + c_frame.width) / 2.0L + 1.25L) /
                                                 (1 << words::Exact::c_depth_sum_fraction_bits);

void depths(Trial& trial) {
  int subpixels = 0, behind = 0;
  long double most = 0.0L;
  for_each_object(trial, [&](const Object& o) {
    const long double error = std::abs(o.fragment.z - depth_at(o.triangle, o.computed));
    trial.require(error <= c_depth_error,
                  [&] { return fmt::format("{}: {} depth steps at its point", o.where, error); });
    for (const HalfUnits& at : o.shown) {
      ++subpixels;
      const long double depth = depth_at(o.triangle, at), own = depth_change(o.triangle) + c_depth_error;
      if (at != o.computed) trial.ours(std::abs(o.fragment.z - depth), own, [&] { return o.where; });
      long double farther = 0.0L;
      for (const ScreenTriangle& other : o.all) {
        const auto weight = barycentric(screen_points(other), at.x, at.y);
        if (std::ranges::min(weight.weight) <= 0 || depth <= depth_at(other, at)) continue;
        farther = std::max(farther, depth - depth_at(other, at));
        trial.ours(depth - depth_at(other, at), own + depth_change(other) + c_depth_error,
                   [&] { return o.where; });
      }
      behind += farther > 0.0L;
      most = std::max(most, farther);
    }
  });
  trial.remark(fmt::format("{} of {} subpixels show an object that is not the nearest there, by up to {:.3g}",
                           behind, subpixels, most));
}

constexpr HardCase c_cases[] = {{"distances", distances}, {"colours", colours}, {"depths", depths}};
INSTANTIATE_TEST_SUITE_P(objects, HardCases, testing::ValuesIn(c_cases), id_of);

}  // namespace
}  // namespace halfway::stability
