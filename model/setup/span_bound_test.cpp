// SPDX-License-Identifier: Apache-2.0
#include "setup/span_bound.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "scene/test/random_scenes.hpp"
#include "shading/arc.hpp"

namespace halfway {
namespace {

SurfacePoint point_of(glm::dvec3 position_world, glm::dvec3 interpolated_normal_world, double inverse_w) {
  const double length = glm::length(interpolated_normal_world);
  return {.position_world = position_world,
          .normal_world = length > 0.0 ? interpolated_normal_world / length : glm::dvec3(0.0, 0.0, 1.0),
          .inverse_w = inverse_w,
          .normal_length = length};
}

struct SurfaceSpan {
  SurfacePoint begin, end;
  glm::dvec3 eye_world;
  Light light;
};

// Ends that differ by 1e-6 to about 1, seen and lit from near and far, with perspective.
SurfaceSpan random_span(RandomScenes& random) {
  const double size = random.log_within(1e-6, 1.0);
  SurfaceSpan span;
  const glm::dvec3 normal = random.log_within(0.3, 1.0) * random.unit();
  span.begin = point_of(random.cube(), normal, random.log_within(0.1, 10.0));
  span.end = point_of(span.begin.position_world + size * random.cube(),
                      normal + random.within(0.0, 1.0) * size * random.cube(),
                      span.begin.inverse_w * (1.0 + size * random.within(-0.5, 0.5)));
  span.eye_world = span.begin.position_world + random.log_within(0.1, 100.0) * random.unit();
  span.light.point =
      random.one_in(2)
          ? LightPoint{random.unit(), 0.0}
          : LightPoint{span.begin.position_world + random.log_within(0.1, 100.0) * random.unit(), 1.0};
  return span;
}

double angle_between(glm::dvec3 a, glm::dvec3 b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

struct Vectors {
  glm::dvec3 normal, to_light, halfway;
};
Vectors vectors_at(const SurfaceSpan& span, double t) {
  const double begin = (1.0 - t) * span.begin.inverse_w, end = t * span.end.inverse_w,
               s = end / (begin + end);
  const glm::dvec3 position = (1.0 - s) * span.begin.position_world + s * span.end.position_world;
  Vectors there;
  there.normal = glm::normalize((1.0 - s) * span.begin.normal_length * span.begin.normal_world +
                                s * span.end.normal_length * span.end.normal_world);
  there.to_light = direction_to(span.light, position);
  there.halfway = glm::normalize(there.to_light + direction(position, span.eye_world));
  return there;
}

// The arcs against the surface at 31 places of random spans.
TEST(SpanBound, HoldsForRandomSpans) {
  RandomScenes random(5);
  double closest_diffuse = 0.0, closest_specular = 0.0;
  int bounded = 0;
  for (int i = 0; i < 400'000; ++i) {
    const SurfaceSpan span = random_span(random);
    const auto bounds = arc_bounds(span.begin, span.end, span.light, span.eye_world);
    if (!bounds) continue;
    ++bounded;
    const Vectors a = vectors_at(span, 0.0), b = vectors_at(span, 1.0);
    const CosineArc diffuse = cosine_arc(a.normal, b.normal, a.to_light, b.to_light),
                    specular = cosine_arc(a.normal, b.normal, a.halfway, b.halfway);
    for (int k = 1; k < 32; ++k) {
      const double t = k / 32.0;
      const Vectors there = vectors_at(span, t);
      // Angles are accurate to 1e-8 close to 0, where only their cosine is known.
      const auto off = [&](glm::dvec3 x, const CosineArc& arc) {
        return std::abs(angle_between(there.normal, x) - std::acos(std::clamp(arc.at(t), -1.0, 1.0))) - 1e-7;
      };
      const double off_diffuse = off(there.to_light, diffuse), off_specular = off(there.halfway, specular);
      ASSERT_LE(off_diffuse, bounds->diffuse) << "span " << i << ", t " << t;
      ASSERT_LE(off_specular, bounds->specular) << "span " << i << ", t " << t;
      closest_diffuse = std::max(closest_diffuse, off_diffuse / bounds->diffuse);
      closest_specular = std::max(closest_specular, off_specular / bounds->specular);
    }
  }
  EXPECT_GT(bounded, 200'000);
  // The bounds are not much larger than what happens.
  EXPECT_GT(closest_diffuse, 0.4);
  EXPECT_GT(closest_specular, 0.4);
  RecordProperty("closest", fmt::format("{:.3f} {:.3f}", closest_diffuse, closest_specular));
}

TEST(SpanBound, IsNotGivenForLargeTurns) {
  const auto end_of = [](glm::dvec3 normal) { return point_of({0.1, 0, 0}, normal, 1); };
  SurfaceSpan span = {point_of({0, 0, 0}, {0, 0, 1}, 1), end_of({0.1, 0, 1}), {0, 0, 5}, {}};
  span.light.point = {{0, 0, 1}, 0.0};
  const auto bounds = [&] { return arc_bounds(span.begin, span.end, span.light, span.eye_world); };
  EXPECT_TRUE(bounds());
  span.end = end_of({1, 0, 1});
  EXPECT_FALSE(bounds()) << "the normal turns too far";
  span.end = end_of({0, 0, 0});
  EXPECT_FALSE(bounds()) << "no normal";
  span.end = end_of({0.1, 0, 1});
  span.light.point = {{0, 0, -1}, 0.0};
  EXPECT_FALSE(bounds()) << "no halfway vector";
  span.light.point = {{0.05, 0, 0.01}, 1.0};
  EXPECT_FALSE(bounds()) << "the light is too close";
  span.light.point = {{0, 0, 1}, 0.0};
  span.eye_world = {0.05, 0, 0.01};
  EXPECT_FALSE(bounds()) << "the eye is too close";
}

}  // namespace
}  // namespace halfway
