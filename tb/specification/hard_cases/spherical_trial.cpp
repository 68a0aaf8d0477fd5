// SPDX-License-Identifier: Apache-2.0
#include "specification/hard_cases/spherical_trial.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>
#include <vector>

#include "specification/hard_cases/specification.hpp"

namespace halfway::stability {
SurfacePoint surface_at(const Scene& scene, FrameSize frame, std::int64_t x, std::int64_t y) {
  const ScreenTriangle t = Pieces(scene, frame).all().at(0);
  return surface_point(t,
                       barycentric_screen(t, (2 * x + 1) << c_subpixel_bits, (2 * y + 1) << c_subpixel_bits));
}

Truth::Truth(const Scene& scene, FrameSize frame) : scene_(scene), pieces_(scene, frame) {}

LongVec Truth::radiance_at(std::uint32_t source, std::int64_t x, std::int64_t y) const {
  const ScreenTriangle& t = pieces_.nearest(source, x, y);
  const ExactSurface s = surface(t, c_subpixel_bits, x, y);
  Material material = scene_.materials[t.material];
  material.exponent = std::min(material.exponent, c_largest_exponent);
  return radiance(scene_, material, s.position_world, unit_normal(t, s));
}

LongVec Truth::normal_at(std::uint32_t source, std::int64_t x, std::int64_t y) const {
  const ScreenTriangle& t = pieces_.nearest(source, x, y);
  return unit_normal(t, surface(t, c_subpixel_bits, x, y));
}

Shown show(Trial& trial, const Scene& scene, const std::string& name, const ShowOptions& options) {
  DrawOptions draw{.plan = {.shader = Shader::spherical, .all_effects = true, .lights = 3},
                   .frame = options.frame};
  const Drawing exact = trial.draw(scene, draw);
  trial.require(!exact.golden.empty(), [&] { return name + ": nothing is drawn"; });
  const double bound = promised_steps(scene, exact.key, draw.setup.spherical.threshold);
  const Truth truth(scene, options.frame);

  Shown shown{.fragments = exact.golden.size(), .counts = exact.counts};
  std::map<std::tuple<std::uint32_t, int, int>, LongVec> there;
  const auto where = [&](const Fragment& f) { return fmt::format("{}, pixel {}, {}", name, f.x, f.y); };
  for (const Fragment& f : exact.golden) {
    const LongVec radiance = there[{f.triangle, f.x, f.y}] = truth.radiance_at(f.triangle, f.x, f.y);
    trial.ours(colour_error(f, radiance), bound, [&] { return where(f); });
    shown.brightest = std::max(shown.brightest, int{f.red});
  }

  trial.require(shown.brightest >= options.least_red, [&] { return name + ": too dark"; });

  draw.setup.spherical.ends = SpanEnds::slerped_along_edges;
  const Drawing slerped = trial.draw(scene, draw);
  trial.require(slerped.golden.size() == exact.golden.size(),
                [&] { return name + ": ends by slerp cover other pixels"; });

  draw.plan.preset = Preset::published;
  draw.plan.tables = options.published_tables;
  const Drawing published = trial.draw(scene, draw);
  for (const Fragment& f : published.golden) {
    trial.require(f.x < options.frame.width && f.y < options.frame.height,
                  [&] { return where(f) + ": preset published draws outside the frame"; });
    shown.published_brightest = std::max(shown.published_brightest, int{f.red});
    // Vertices on whole pixels: along the edges the pixels differ from the exact ones.
    const auto found = there.find({f.triangle, f.x, f.y});
    if (found != there.end())
      trial.published(colour_error(f, found->second), bound, [&] { return where(f); });
  }
  return shown;
}

}  // namespace halfway::stability
