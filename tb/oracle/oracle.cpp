// SPDX-License-Identifier: Apache-2.0
#include "oracle/oracle.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace halfway::oracle {
namespace {

constexpr Real c_pi = 3.14159265358979323846264338327950288L;
constexpr int c_units = 16;  // of a pixel
constexpr Real c_last_depth = 16777215;

Real power(Real base, Real exponent) {
  return base > 0 ? std::pow(base, exponent) : 0;
}

}  // namespace

// The camera's axes are found by Gram-Schmidt. The slope fills the frame: a point at distance w along the
// viewing axis and h above it is (h/w) (height/2) / tan(fov/2) pixels above the centre of the frame.
Oracle::Oracle(const Scene& scene, unsigned width, unsigned height, Fault fault)
    : scene_(scene), width_(width), height_(height), fault_(fault), eye_(scene.camera.eye_world) {
  for (const auto& l : scene.directional)
    lights_.push_back({Kind::directional, Vector(l.to_light_world), Vector(l.intensity)});
  for (const auto& l : scene.positional)
    lights_.push_back({Kind::positional, Vector(l.position_world), Vector(l.intensity)});
  for (const auto& l : scene.spots)
    lights_.push_back({Kind::spot, Vector(l.position_world), Vector(l.intensity), Vector(l.axis_world),
                       l.cos_inner, l.cos_outer});
  forward_ = normalize(Vector(scene.camera.target_world) - eye_);
  const Vector up(scene.camera.up_world);
  up_ = normalize(up - dot(up, forward_) * forward_);
  right_ = cross(forward_, up_);
  if (has("mirrored")) right_ = -right_;
  if (has("upside_down")) up_ = -up_;
  const Real half_angle = Real(scene.camera.vertical_fov_degrees) * c_pi / 180 / (has("fov_is_half") ? 1 : 2);
  const Real half_side = Real(has("fov_is_horizontal") ? width : height) / 2;
  pixels_per_slope_ = half_side / std::tan(half_angle);

  Vector low = eye_, high = eye_;
  for (std::size_t t = 0; t < scene.triangles.size(); ++t)
    for (int i = 0; i < 3; ++i) low = min(low, position(t, i)), high = max(high, position(t, i));
  radius_ = length(high - low) / 2;
  screen_.resize(scene.triangles.size());
  for (std::size_t i = 0; i < scene.triangles.size(); ++i) project(i);
}

Vector Oracle::position(std::size_t triangle, int corner) const {
  return Vector(scene_.positions_world[scene_.triangles[triangle].position[corner]]);
}

Real Oracle::distance(const Vector& position) const {
  return dot(position - eye_, forward_);
}

// Corners snap to the nearest 1/16 pixel, halves up. Corners are counter-clockwise seen from outside. A
// triangle is visible if they are counter-clockwise on the screen.
void Oracle::project(std::size_t triangle) {
  ScreenTriangle corners;
  for (int i = 0; i < 3; ++i) {
    const Vector from_eye = position(triangle, i) - eye_;
    const Real w = dot(from_eye, forward_);
    if (!(w >= scene_.camera.near && w <= scene_.camera.far)) {
      clipped_ = true;
      return;
    }
    const Real x = Real(width_) / 2 + pixels_per_slope_ * dot(from_eye, right_) / w;
    const Real y = Real(height_) / 2 - pixels_per_slope_ * dot(from_eye, up_) / w;
    const Real half = has("snapped_down") ? 0 : 0.5L;
    const auto snapped = [&](Real pixels) {
      const Real steps = pixels * c_units + half;
      if (std::abs(steps - std::round(steps)) < c_doubt) ++doubtful_corners_;
      return static_cast<std::int64_t>(std::floor(steps));
    };
    corners[i] = {snapped(x), snapped(y), 1 / w};
  }
  const auto& [a, b, c] = corners;
  // Twice the area in a frame with y downwards: negative for counter-clockwise corners.
  const std::int64_t area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  if (area < 0 || (has("back_faces_shown") && area != 0)) screen_[triangle] = corners;
}

// A point is inside if it is on the inner side of each edge, or on a top edge (horizontal, the triangle below
// it) or a left edge (the triangle to its right).
bool Oracle::covers(std::size_t triangle, int x, int y) const {
  if (!screen_[triangle]) return false;
  ScreenTriangle t = *screen_[triangle];
  const int centre = has("pixel_corners") ? 0 : c_units / 2;
  const std::int64_t px = std::int64_t{c_units} * x + centre, py = std::int64_t{c_units} * y + centre;
  const auto side = [](const ScreenCorner& a, const ScreenCorner& b, std::int64_t qx, std::int64_t qy) {
    return (b.x - a.x) * (qy - a.y) - (b.y - a.y) * (qx - a.x);
  };
  if (side(t[0], t[1], t[2].x, t[2].y) < 0) std::swap(t[1], t[2]);
  for (int i = 0; i < 3; ++i) {
    const ScreenCorner &a = t[i], &b = t[(i + 1) % 3];
    const std::int64_t inside = side(a, b, px, py);
    if (inside < 0) return false;
    if (inside > 0 || has("closed_edges")) continue;
    const bool top = a.y == b.y && b.x > a.x, left = b.y < a.y;
    if ((top || left) == has("bottom_right_rule")) return false;
  }
  return true;
}

// Barycentric weights by areas, as rational numbers.
std::array<mpq_class, 3> Oracle::weights(const ScreenTriangle& t, int x, int y) const {
  const auto number = [](std::int64_t v) { return mpz_class(static_cast<long>(v)); };
  const mpz_class px = number(std::int64_t{c_units} * x + c_units / 2),
                  py = number(std::int64_t{c_units} * y + c_units / 2);
  const auto area = [&](const ScreenCorner& a, const ScreenCorner& b) -> mpz_class {
    return (number(a.x) - px) * (number(b.y) - py) - (number(a.y) - py) * (number(b.x) - px);
  };
  const mpz_class parts[3] = {area(t[1], t[2]), area(t[2], t[0]), area(t[0], t[1])};
  const mpz_class whole = parts[0] + parts[1] + parts[2];
  std::array<mpq_class, 3> weight;
  for (int i = 0; i < 3; ++i) {
    weight[i] = mpq_class(parts[i], whole);
    weight[i].canonicalize();
  }
  return weight;
}

namespace {

Real real(const mpq_class& q) {
  return Real(q.get_num().get_si()) / Real(q.get_den().get_si());
}

}  // namespace

// 1/w is linear on the screen, and so is depth = far/(far - near) (1 - near/w). Depth is 0 at the near plane
// and 1 at the far plane.
Real Oracle::depth_of(const Vector& position) const {
  const Real w = distance(position), near = scene_.camera.near, far = scene_.camera.far;
  if (has("depth_of_distance")) return (w - near) / (far - near);
  return far / (far - near) * (1 - near / w);
}

Real Oracle::depth_steps(std::size_t triangle, int x, int y) const {
  const auto weight = weights(*screen_[triangle], x, y);
  Real depth = 0;
  for (int i = 0; i < 3; ++i) depth += real(weight[i]) * depth_of(position(triangle, i));
  return depth * c_last_depth + (has("depth_one_step_deeper") ? 1 : 0);
}

// An attribute that is linear on the surface is linear on the screen after division by w. The weights on the
// surface are those on the screen times 1/w, scaled to the sum 1.
Oracle::Surface Oracle::surface(std::size_t triangle, int x, int y) const {
  const ScreenTriangle& t = *screen_[triangle];
  const auto weight = weights(t, x, y);
  std::array<Real, 3> share;
  Real sum = 0;
  for (int i = 0; i < 3; ++i) {
    share[i] = real(weight[i]) * (has("linear_on_screen") ? 1 : t[i].inverse_w);
    sum += share[i];
  }
  const auto normal = [&](int corner) {
    return Vector(scene_.normals_world[scene_.triangles[triangle].normal[corner]]);
  };
  Surface s;
  for (int i = 0; i < 3; ++i) {
    s.position += (share[i] / sum) * position(triangle, i);
    s.normal += (share[i] / sum) * normal(i);
  }
  if (has("flat_normal")) s.normal = normal(0);
  if (!has("normal_not_unit")) s.normal = normalize(s.normal);
  return s;
}

// The factor of k_s. N.L > 0 is known.
Real Oracle::highlight(const Material& m, const Vector& n, const Vector& l, const Vector& v) const {
  const Real nl = dot(n, l), exponent = Real(m.exponent) + (has("exponent_plus_one") ? 1 : 0);
  // R = 2 (N.L) N - L; (R.V)^n.
  if (m.brdf == Brdf::phong) return power(dot(has("phong_by_light") ? l : 2 * nl * n - l, v), exponent);
  // H = (L + V)/|L + V|; (N.H)^n.
  const Vector sum = (has("halfway_of_normal") ? n : l) + v;
  const Vector h = has("halfway_not_unit") ? 0.5L * sum : normalize(sum);
  const Real nh = dot(n, h);
  if (m.brdf == Brdf::blinn) return power(nh, exponent);
  // P F G / (4 (N.L)(N.V)), times N.L for the irradiance.
  const Real nv = dot(n, v), vh = dot(v, h), lh = dot(l, h);
  if (!(nv > 0) || !(nh > 0)) return 0;
  // P = exp(-tan^2/m^2) / (pi m^2 cos^4).
  const Real cos2 = nh * nh, slope2 = Real(m.roughness) * m.roughness;
  const Real density =
      std::exp(-(1 - cos2) / cos2 / slope2) /
      ((has("beckmann_without_pi") ? 1 : c_pi) * slope2 * cos2 * (has("beckmann_squared_cosine") ? 1 : cos2));
  // F = F0 + (1 - F0)(1 - L.H)^5.
  const Real fresnel =
      m.reflectance + (1 - m.reflectance) * power(1 - lh, has("fresnel_of_fourth_power") ? 4 : 5);
  // G = min{1, 2 (N.H)(N.V)/(V.H), 2 (N.H)(N.L)/(L.H)}.
  const Real masking = has("masking_missing") ? 1 : std::min({Real(1), 2 * nh * nv / vh, 2 * nh * nl / lh});
  return density * fresnel * masking / (4 * nl * nv) * nl;
}

// A light reaches a point if the point's triangle faces the light and no triangle that is averted from the
// light lies between.
bool Oracle::is_shadowed(std::size_t triangle, const Vector& from, const Light& light, bool* doubtful) const {
  const bool far = light.kind == Kind::directional;
  const auto doubt = [&](Real margin) {
    if (std::abs(margin) < c_doubt && doubtful != nullptr) *doubtful = true;
  };
  // Sine of the angle by which the outside faces the light.
  const auto facing = [&](std::size_t t) {
    const Vector a = position(t, 0), normal = cross(position(t, 1) - a, position(t, 2) - a);
    const Vector way = far ? light.place : light.place - a;
    return dot(normal, way) / (length(normal) * length(way));
  };
  const Real own = facing(triangle);
  doubt(own);
  if (own < 0 && !has("averted_faces_lit")) return true;

  // The ray from + s way, with s from 0 to 1, or without an upper limit.
  const Vector way = far ? light.place : light.place - from;
  bool shadowed = false;
  for (std::size_t t = 0; t < scene_.triangles.size(); ++t) {
    if (t == triangle || (facing(t) < 0) == has("lit_faces_cast")) continue;
    const Vector a = position(t, 0), e1 = position(t, 1) - a, e2 = position(t, 2) - a;
    const Vector p = cross(way, e2);
    const Real determinant = dot(e1, p);
    if (determinant == 0) continue;
    const Vector to = from - a;
    const Vector q = cross(to, e1);
    const Real u = dot(to, p) / determinant, v = dot(way, q) / determinant, s = dot(e2, q) / determinant;
    // The margin by which the ray passes inside (above 0) or outside.
    const Real least = s * length(way) / radius_, most = far || has("shadows_beyond_light") ? 1 : 1 - s;
    const Real margin = std::min({u, v, 1 - u - v, least - c_doubt, most});
    // If two triangles share an edge, the start may lie on the other one. Such touching triangles do not
    // count.
    doubt(std::min({u, v, 1 - u - v, most}) > -c_doubt && std::abs(least) < 100 * c_doubt ? 0 : margin);
    shadowed |= margin > 0;
  }
  return shadowed;
}

// I = k_a I_a + sum over lights of I_in (k_d (N.L) + k_s highlight), for N.L > 0. The ambient and diffuse
// parts have the material's colour; highlights have their own.
Vector Oracle::radiance(std::size_t triangle, const Surface& surface, bool* doubtful) const {
  const Material& m = scene_.materials[scene_.triangles[triangle].material];
  const Vector own_colour(m.colour), specular_colour(m.specular_colour);
  const Vector& n = surface.normal;
  const Vector v = has("eye_at_infinity") ? -forward_ : normalize(eye_ - surface.position);
  Vector sum(0);
  if (!has("ambient_missing")) sum = Real(m.ambient) * Vector(scene_.ambient) * own_colour;
  for (std::size_t i = 0; i < lights_.size(); ++i) {
    if (has("second_light_missing") && i == 1) continue;
    const Light& light = lights_[i];
    const bool far = light.kind == Kind::directional;
    const bool by_direction = has("positional_is_directional") && !far;
    const Vector way = far || by_direction ? light.place : light.place - surface.position;
    const Vector l = normalize(way);
    Vector intensity = light.intensity;
    if (has("falls_off_by_distance") && !far) intensity = (1 / dot(way, way)) * intensity;
    if (light.kind == Kind::spot) {
      // 1 within the inner cone, 0 outside the outer cone, 3 t^2 - 2 t^3 of the cosine between.
      const Real cosine = dot(l, light.axis) * (has("spot_backwards") ? 1 : -1);
      const Real width = light.cos_inner - light.cos_outer;
      const Real t = width > 0 ? std::clamp((cosine - light.cos_outer) / width, Real(0), Real(1))
                               : Real(cosine >= light.cos_inner);
      if (!(width > 0) && std::abs(cosine - light.cos_inner) < c_doubt && doubtful != nullptr)
        *doubtful = true;
      const Real share = has("spot_linear")         ? t
                         : has("spot_without_edge") ? Real(t > 0)
                                                    : t * t * (3 - 2 * t);
      if (!(share > 0)) continue;
      intensity = share * intensity;
    }
    const Real nl = dot(n, l);
    // A highlight may be non-zero at the horizon.
    if (std::abs(nl) < c_doubt && doubtful != nullptr) *doubtful = true;
    const bool lit = nl > 0;
    if (lit || has("averted_faces_lit"))
      if (scene_.shadows && !has("shadows_missing") &&
          is_shadowed(triangle, surface.position, light, doubtful))
        continue;
    if (lit || has("diffuse_unclamped")) {
      const Vector colour = has("diffuse_in_all_channels") ? Vector(own_colour.x) : own_colour;
      sum += m.diffuse * nl * intensity * colour;
    }
    if (lit || has("highlight_below_horizon"))
      sum += m.specular * highlight(m, n, l, v) * intensity *
             (has("specular_takes_colour") ? own_colour : specular_colour);
  }
  return sum;
}

// The radiance of the nearest triangle as a byte: 255 times the radiance, rounded, halves up.
Oracle::Pixel Oracle::pixel(int x, int y) const {
  Pixel pixel{.triangle = std::nullopt, .colour = Vector(scene_.background)};
  Real nearest = 0;
  bool doubtful = false;
  for (std::size_t i = 0; i < scene_.triangles.size(); ++i) {
    if (!covers(i, x, y)) continue;
    const Real depth = depth_steps(i, x, y) * (has("last_of_depth") ? -1 : 1);
    if (pixel.triangle && std::abs(depth - nearest) < 1e-3L) doubtful = true;
    if (pixel.triangle && !(depth < nearest)) continue;
    pixel.triangle = i;
    nearest = depth;
  }
  if (pixel.triangle) pixel.colour = radiance(*pixel.triangle, surface(*pixel.triangle, x, y), &doubtful);
  for (int i = 0; i < 3; ++i) {
    const Real steps =
        255 * std::clamp(pixel.colour[i], Real(0), Real(1)) + (has("truncated_to_byte") ? 0 : 0.5L);
    pixel.byte[i] = static_cast<std::uint8_t>(std::floor(steps));
    pixel.doubtful[i] = doubtful || std::abs(steps - std::round(steps)) < c_doubt;
  }
  return pixel;
}

}  // namespace halfway::oracle
