// SPDX-License-Identifier: Apache-2.0
#include "specification/hard_cases/measure.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "setup/walk_header.hpp"
#include "specification/hard_cases/shading_bound.hpp"

namespace halfway::stability {

long double colour_error(const Fragment& f, const LongVec& radiance) {
  const LongVec off =
      glm::abs(LongVec(f.red, f.green, f.blue) - 255.0L * glm::clamp(radiance, LongVec(0), LongVec(1)));
  return std::max({off.x, off.y, off.z});
}

Scene scaled(Scene scene, double by) {
  for (glm::dvec3& p : scene.positions_world) p *= by;
  for (PositionalLight& l : scene.positional) l.position_world *= by;
  for (SpotLight& l : scene.spots) l.position_world *= by;
  scene.camera.eye_world *= by;
  return scene;
}

Pieces::Pieces(const Scene& scene, FrameSize frame)
    : pieces_(Projector(scene, frame, {.subpixel_bits = c_subpixel_bits}).project_all()) {
  std::ranges::stable_sort(pieces_, {}, &ScreenTriangle::source);
}

std::span<const ScreenTriangle> Pieces::pieces_of(std::uint32_t source) const {
  return {std::ranges::lower_bound(pieces_, source, {}, &ScreenTriangle::source),
          std::ranges::upper_bound(pieces_, source, {}, &ScreenTriangle::source)};
}

const ScreenTriangle* Pieces::covering(std::uint32_t source, std::int64_t x, std::int64_t y) const {
  for (const ScreenTriangle& t : pieces_of(source))
    if (covers(screen_points(t), c_subpixel_bits, x, y)) return &t;
  return nullptr;
}

const ScreenTriangle& Pieces::nearest(std::uint32_t source, std::int64_t x, std::int64_t y) const {
  const auto least = [&](const ScreenTriangle& t) {
    return std::ranges::min(
        barycentric(screen_points(t), centre(x, c_subpixel_bits), centre(y, c_subpixel_bits)).real());
  };
  const auto pieces = pieces_of(source);
  return *std::max_element(
      pieces.begin(), pieces.end(),
      [&](const ScreenTriangle& a, const ScreenTriangle& b) { return least(a) < least(b); });
}

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

void for_each_error(const Scene& scene, const Pieces& pieces, std::span<const Fragment> fragments,
                    const std::function<void(double, const Fragment&)>& add) {
  for (const Fragment& f : fragments) {
    const ScreenTriangle& t = pieces.nearest(f.triangle, f.x, f.y);
    const ExactSurface s = surface(t, c_subpixel_bits, f.x, f.y);
    bool doubtful = false;
    const LongVec exact = oracle::radiance(scene, scene.materials[t.material], s.position_world,
                                           unit_normal(t, s), oracle::c_no_shadows, {}, doubtful);
    if (!doubtful) add(static_cast<double>(colour_error(f, exact)), f);
  }
}

void measure_shading(Trial& trial, Preset preset, const Scene& scene, FrameSize frame,
                     std::span<const Fragment> fragments, std::string_view name) {
  const ShadingBound bound(scene, frame);
  const Pieces pieces(scene, frame);
  for (const Fragment& f : fragments) {
    const auto where = [&] {
      return fmt::format("{}, {} by {}: pixel ({}, {}), triangle {}", name, frame.width, frame.height, f.x,
                         f.y, f.triangle);
    };
    const ScreenTriangle* piece = pieces.covering(f);
    trial.require(piece != nullptr, [&] { return where() + " is not covered"; });
    if (piece == nullptr) continue;
    const Promise promise = bound.at(*piece, f.x, f.y);
    for (std::size_t c = 0; c < 3; ++c)
      trial.measure(preset, std::abs(promise.exact[c] - channels(f)[c]), promise.bound(c), where);
  }
}

}  // namespace halfway::stability
