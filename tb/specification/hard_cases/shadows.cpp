// SPDX-License-Identifier: Apache-2.0
// Shadows by counted volumes, compared with rays in long double. Each light has its own colour channel, so a
// pixel's channels show which lights reach it.
#include <fmt/format.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>

#include "projection/project.hpp"
#include "scene/builtin_meshes.hpp"
#include "scene/lights.hpp"
#include "setup/shadow_volume.hpp"
#include "shading/test/random_solids.hpp"
#include "sim/os/must.hpp"
#include "specification/hard_cases/hard_case.hpp"
#include "specification/hard_cases/measure.hpp"
#include "specification/hard_cases/shading_bound.hpp"
#include "specification/hard_cases/trial.hpp"

namespace halfway::stability {
namespace {

constexpr unsigned c_lights = 3;

PlanRequest request_of(ProcessorForm form) {
  return {.shader = Shader::processors, .all_effects = true, .lights = c_lights, .form = form};
}

FrameSize frame_of(const Trial& trial) {
  return trial.quick() ? FrameSize{64, 48} : FrameSize{120, 90};
}

// Traces rays from points to lights. A triangle whose outside faces away from a light casts a shadow and is
// dark itself.
class Rays {
 public:
  // A triangle closer to a point than this part of the way to the light touches it.
  static constexpr long double c_touch = 1e-9L;

  explicit Rays(const Scene& scene)
      : scene_(scene), corners_(all_corners(scene)), lights_(reflected_lights(scene)) {}

  LongVec way_to(std::size_t light, const LongVec& point) const {
    const LightPoint from = light_of(scene_, lights_[light]).point;
    return LongVec(from.xyz_world) - (long double)from.w * point;
  }
  long double grazing(std::size_t light, const LongVec& point, std::uint32_t triangle) const {
    const auto& [a, b, c] = corners_[triangle];
    const LongVec normal = glm::cross(LongVec(b) - LongVec(a), LongVec(c) - LongVec(a));
    return std::abs(glm::dot(glm::normalize(normal), glm::normalize(way_to(light, point))));
  }

  // `least_way`: part of the way to the light from which on a triangle casts a shadow.
  bool reaches(std::size_t light, const LongVec& point, std::uint32_t triangle,
               long double least_way = c_touch) const {
    const LightPoint from = light_of(scene_, lights_[light]).point;
    const LongVec way = way_to(light, point);
    if (slope(triangle, way) < 0.0L) return false;
    for (std::uint32_t t = 0; t < corners_.size(); ++t)
      if (t != triangle && casts(t, point, way, from.w != 0.0, least_way)) return false;
    return true;
  }

 private:
  long double slope(std::uint32_t triangle, const LongVec& way) const {
    const auto& [a, b, c] = corners_[triangle];
    return glm::dot(glm::cross(LongVec(b) - LongVec(a), LongVec(c) - LongVec(a)), way);
  }
  bool casts(std::uint32_t triangle, const LongVec& from, const LongVec& way, bool has_place,
             long double least_way) const {
    const LongVec a(corners_[triangle][0]), ab = LongVec(corners_[triangle][1]) - a,
                                            ac = LongVec(corners_[triangle][2]) - a;
    const LongVec normal = glm::cross(ab, ac);
    const long double s = glm::dot(normal, way);
    if (s >= 0.0L) return false;
    const long double t = glm::dot(a - from, normal) / s;
    if (t <= least_way || (has_place && t >= 1.0L)) return false;
    const LongVec offset = glm::cross(from - a, way);
    const long double u = glm::dot(ac, offset) / -s, v = glm::dot(ab, offset) / s;
    return u >= 0.0L && v >= 0.0L && u + v <= 1.0L;
  }

  const Scene& scene_;
  std::vector<CornersWorld> corners_;
  std::vector<LightRef> lights_;
};

// A pixel of the drawn frame.
struct Seen {
  const ScreenTriangle* piece = nullptr;
  std::array<bool, c_lights> drawn{}, wanted{};
  std::array<double, c_lights> distance{1.0, 1.0, 1.0};  ///< distance_to_edge, of what is drawn wrong
  std::array<double, c_lights> steps{};                  ///< that the light would add
  std::array<double, c_lights> grazing{};                ///< sine of the light's angle over the triangle
};

// A distance in pixels, at most one, up to which the rays around a pixel's centre agree with its own. Zero if
// they do not agree 1/16 pixel away: there the rounding of vertices, up to 1/32 pixel in x and in y, may move
// the edge of a shadow and the surface over the pixel's centre. A solid that stands on the surface begins its
// volume there: around a lit pixel, triangles that touch the surface cast a shadow.
double distance_to_edge(const Rays& rays, std::size_t light, const Seen& pixel, const Fragment& f) {
  const Wide sixteenth = Wide{1} << (c_subpixel_bits - 3), x = centre(f.x, c_subpixel_bits),
             y = centre(f.y, c_subpixel_bits);
  const long double least_way = pixel.wanted[light] ? -Rays::c_touch : Rays::c_touch;
  double distance = 0.0;
  for (int sixteenths = 1; sixteenths <= 16; sixteenths *= 2) {
    const Wide way = sixteenths * sixteenth;
    for (const int down : {-1, 0, 1})
      for (const int right : {-1, 0, 1}) {
        const LongVec point = exact_surface(*pixel.piece, x + right * way, y + down * way).position_world;
        if (rays.reaches(light, point, f.triangle, least_way) != pixel.wanted[light]) return distance;
      }
    distance = sixteenths / 16.0;
  }
  return distance;
}

// The drawn frame by pixel.
std::vector<Seen> look(Trial& trial, const Scene& scene, FrameSize frame,
                       const std::vector<Fragment>& fragments, const Pieces& pieces) {
  const ShadingBound bound(scene, frame);
  const Rays rays(scene);
  std::vector<Seen> seen(std::size_t{frame.width} * frame.height);
  for (const Fragment& f : fragments) {
    Seen& pixel = seen[std::size_t{f.y} * frame.width + f.x];
    pixel.piece = pieces.covering(f);
    if (pixel.piece == nullptr) continue;
    const LongVec point = surface(*pixel.piece, c_subpixel_bits, f.x, f.y).position_world;
    const Promise promise = bound.at(*pixel.piece, f.x, f.y);
    const std::array<std::uint8_t, 3> drawn = channels(f);
    for (std::size_t i = 0; i < c_lights; ++i) {
      pixel.wanted[i] = rays.reaches(i, point, f.triangle);
      pixel.steps[i] = static_cast<double>(promise.exact[i]);
      pixel.grazing[i] = static_cast<double>(rays.grazing(i, point, f.triangle));
      const auto lit = static_cast<double>(std::abs(promise.exact[i] - drawn[i]));
      // A light that would add less than one step is not visible.
      const bool hidden = promise.range[i].low < 1.0L;
      pixel.drawn[i] = hidden ? pixel.wanted[i] : lit <= static_cast<double>(promise.bound(i));
      if (pixel.drawn[i] != pixel.wanted[i]) pixel.distance[i] = distance_to_edge(rays, i, pixel, f);
      trial.require(hidden || pixel.drawn[i] || drawn[i] == 0, [&] {
        return fmt::format("pixel ({}, {}): {} of a light's {} steps", f.x, f.y, drawn[i], pixel.steps[i]);
      });
    }
  }
  return seen;
}

struct Sum {
  std::uint64_t pixels = 0, at_edge = 0, differ = 0, dark = 0, bright = 0;
  std::uint64_t off_edge = 0;
  double most = 0.0;  ///< colour steps of a light that is wrong off the edges
};

// Calls wrong() for pixels where a light is drawn differently from the rays, although the rays of the pixel
// and of its neighbours all agree, and those 1/16 pixel around it.
template <class Wrong>
void off_the_edge(const std::vector<Seen>& seen, FrameSize frame, Sum& sum, Wrong&& wrong) {
  for (std::uint32_t y = 0; y < frame.height; ++y)
    for (std::uint32_t x = 0; x < frame.width; ++x) {
      const Seen& pixel = seen[std::size_t{y} * frame.width + x];
      if (pixel.piece == nullptr) continue;
      for (std::size_t light = 0; light < c_lights; ++light) {
        const bool is_wrong = pixel.drawn[light] != pixel.wanted[light];
        bool at_edge = is_wrong && pixel.distance[light] == 0.0;
        for (std::uint32_t v = y > 0 ? y - 1 : 0; v < std::min(y + 2, frame.height); ++v)
          for (std::uint32_t u = x > 0 ? x - 1 : 0; u < std::min(x + 2, frame.width); ++u) {
            const Seen& neighbour = seen[std::size_t{v} * frame.width + u];
            at_edge = at_edge || neighbour.piece == nullptr || neighbour.wanted[light] != pixel.wanted[light];
          }
        ++sum.pixels;
        sum.at_edge += at_edge;
        ++(pixel.wanted[light] ? sum.bright : sum.dark);
        if (!is_wrong) continue;
        ++(at_edge ? sum.differ : sum.off_edge);
        if (at_edge) continue;
        sum.most = std::max(sum.most, pixel.steps[light]);
        wrong(x, y, light, pixel);
      }
    }
}

// The published walk: vertices on whole pixels, lines and spans inclusive at both ends. Pixels that polygons
// share are counted twice.
template <class Pixel>
void for_each_inclusive(const ScreenTriangle& t, FrameSize frame, Pixel&& pixel) {
  std::array<std::int64_t, 3> x, y;
  for (std::size_t i = 0; i < 3; ++i) x[i] = t.vertex[i].x >> 4, y[i] = t.vertex[i].y >> 4;
  const auto [top, bottom] = std::minmax({y[0], y[1], y[2]});
  for (std::int64_t line = std::max<std::int64_t>(top, 0);
       line <= std::min<std::int64_t>(bottom, frame.height - 1); ++line) {
    double left = 1e9, right = -1e9;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t k = (i + 1) % 3;
      if (line < std::min(y[i], y[k]) || line > std::max(y[i], y[k])) continue;
      const auto take = [&](double at) { left = std::min(left, at), right = std::max(right, at); };
      if (y[i] == y[k])
        take(static_cast<double>(x[i])), take(static_cast<double>(x[k]));
      else
        take(static_cast<double>(x[i]) +
             static_cast<double>((x[k] - x[i]) * (line - y[i])) / static_cast<double>(y[k] - y[i]));
    }
    for (auto at = std::max<std::int64_t>(std::llround(left), 0);
         at <= std::min<std::int64_t>(std::llround(right), frame.width - 1); ++at)
      pixel(static_cast<std::uint32_t>(at), static_cast<std::uint32_t>(line));
  }
}

// The same pixels, with counts by the published walk.
std::vector<Seen> counted_as_published(const Scene& scene, FrameSize frame, std::vector<Seen> seen,
                                       const std::vector<Fragment>& fragments) {
  const Projector projector(scene, frame, {});
  const auto lights = reflected_lights(scene);
  const auto volumes = make_shadow_volumes(scene, lights);
  ProjectionCounts counts;
  std::vector<std::array<int, c_lights>> count(seen.size());
  for (auto& c : count)
    for (std::size_t i = 0; i < c_lights; ++i) c[i] = static_cast<int>(volumes[i].around_eye);
  std::vector<std::uint32_t> depth(seen.size());
  for (const Fragment& f : fragments) depth[std::size_t{f.y} * frame.width + f.x] = f.z;
  for (const ShadowPolygon& polygon : shadow_polygons(scene, projector, volumes, counts))
    for_each_inclusive(polygon.triangle, frame, [&](std::uint32_t x, std::uint32_t y) {
      const auto weight = barycentric(screen_points(polygon.triangle), centre(x, 4), centre(y, 4)).real();
      long double z = 0.0L;
      for (std::size_t i = 0; i < 3; ++i) z += weight[i] * (long double)polygon.triangle.vertex[i].z;
      const std::size_t at = std::size_t{y} * frame.width + x;
      if (z * c_depth_steps < depth[at]) count[at][polygon.light] += polygon.opens ? 1 : -1;
    });
  for (std::size_t i = 0; i < seen.size(); ++i)
    for (std::size_t light = 0; light < c_lights; ++light) seen[i].drawn[light] = count[i][light] <= 0;
  return seen;
}

void set_colours(Scene& scene) {
  scene.shadows = true;
  scene.ambient = glm::dvec3(0.0);
  scene.materials = {{.name = "m", .ambient = 0.0, .diffuse = 1.0, .specular = 0.0}};
  scene.directional.at(0).intensity = {1.0, 0.0, 0.0};
  scene.positional.at(0).intensity = {0.0, 1.0, 0.0};
  scene.spots.at(0).intensity = {0.0, 0.0, 1.0};
}

// Off the edges of shadows, light may be wrong where it grazes a triangle. The side of a volume rises from
// the triangle by the light's angle a. On the screen, the vertices of both have errors of up to 1/32 pixel in
// x and in y. Seen under an angle b, their depths at d pixels from the foot of the side differ by d a / cos^2
// b, with an error of tan b sqrt(2) / 16. So the side is behind the triangle if d < sqrt(2) / 16 sin b cos b
// / a, and so a < sqrt(2) / 32 / d. The error of the edge's own position adds the same again. A pixel off an
// edge has d >= 1, unless the shadow or the light between two edges is narrower than a pixel.
double largest_grazing(double distance) {
  return 1.4143 / 16 / distance;
}

// Measures the light's angle over the triangle for pixels that are wrong off the edges of shadows.
void cast(Trial& trial, Scene scene, std::string_view name, Sum& sum, bool with_published = true) {
  set_colours(scene);
  const FrameSize frame = frame_of(trial);
  PlanRequest request = request_of(ProcessorForm::unrolled);
  request.objects = c_golden_objects;
  const Drawing drawing = must(draw_golden(scene, {.plan = request, .frame = frame}));
  trial.require(!drawing.fault, [&] {
    return fmt::format("{}: fault; {} object processors are needed", name, drawing.counts.objects);
  });
  if (drawing.counts.objects <= c_object_processors)
    for (const ProcessorForm form : c_forms) {
      // Unrolled, sixteen object processors take a minute to build.
      if (trial.quick() && form == ProcessorForm::unrolled) continue;
      trial.draw(scene, {.plan = request_of(form), .frame = frame});
    }
  const Pieces pieces(scene, frame);
  const std::vector<Seen> seen = look(trial, scene, frame, drawing.golden, pieces);
  const auto measure = [&](Preset preset, const std::vector<Seen>& counted, Sum& to) {
    trial.measure(preset, 0, largest_grazing(1.0), [&] { return std::string(name); });
    off_the_edge(counted, frame, to,
                 [&](std::uint32_t x, std::uint32_t y, std::size_t light, const Seen& pixel) {
                   trial.measure(preset, pixel.grazing[light], largest_grazing(pixel.distance[light]), [&] {
                     return fmt::format("{}, {} by {}: pixel ({}, {}), light {} of {:.3g} steps", name,
                                        frame.width, frame.height, x, y, light + 1, pixel.steps[light]);
                   });
                 });
  };
  measure(Preset::exact, seen, sum);
  if (!with_published) return;
  Sum published;
  measure(Preset::published, counted_as_published(scene, frame, seen, drawing.golden), published);
}

// A vertex on the screen has an error of up to 1/32 pixel, so an edge moves over at most 1/16 of its pixels.
void finish(Trial& trial, const Sum& sum) {
  trial.require(sum.differ * 16 <= sum.at_edge, [&] {
    return fmt::format("{} pixels differ of {} along edges, {} in all", sum.differ, sum.at_edge, sum.pixels);
  });
  trial.require(sum.dark * 20 > sum.pixels && sum.bright * 20 > sum.pixels, [&] {
    return fmt::format("{} pixels dark and {} bright are no trial", sum.dark, sum.bright);
  });
}

// Casts shadows in scenes that make(random, round) returns.
template <class Make>
Sum cast_all(Trial& trial, unsigned seed, Make&& make, bool with_published = true) {
  RandomSolids random(seed);
  Sum sum;
  for (int i = 0; i < trial.rounds(5, 20); ++i)
    cast(trial, make(random, i), fmt::format("scene {}", i), sum, with_published);
  finish(trial, sum);
  return sum;
}
// The same in scenes with a floor, changed by change(random, scene, round).
template <class Change>
void cast_on_floors(Trial& trial, unsigned seed, Change&& change) {
  cast_all(trial, seed, [&](RandomSolids& random, int i) {
    Scene scene = random.on_a_floor(4);
    change(random, scene, i);
    return scene;
  });
}

// Solids, open meshes, lights inside a solid, and smooth spheres, whose triangles turn away from the light
// one by one.
void volumes(Trial& trial) {
  cast_all(trial, 5, [](RandomSolids& random, int i) { return random.scene(1 + i % 5); });
  cast_on_floors(trial, 10, [](RandomSolids& random, Scene& scene, int) {
    for (int k = 0; k < 20; ++k) scene.triangles.erase(scene.triangles.begin() + random.whole(0, 30));
  });
  cast_on_floors(trial, 11, [](RandomSolids& random, Scene& scene, int) {
    // Put the light just behind the first triangle of the first solid.
    const CornersWorld c = corners_world(scene, scene.triangles[0]);
    scene.positional[0].position_world =
        (c[0] + c[1] + c[2]) / 3.0 -
        random.within(1e-3, 0.1) * glm::normalize(glm::cross(c[1] - c[0], c[2] - c[0]));
  });
  const auto sphere = [](RandomSolids& random, int) {
    Scene scene = random.scene(0);
    add_mesh(scene, make_uv_sphere(random.whole(5, 24), random.whole(4, 16), 1.3));
    const double side = random.within(-0.3, 0.3);
    scene.camera.eye_world = {3.5, 1.0, side};
    scene.directional[0].to_light_world = glm::normalize(glm::dvec3(side, 0.2, 1.0));
    scene.positional[0].position_world = {0.3, 2.0, 2.0};
    scene.spots[0].position_world = {0.5, -2.5, 1.0};
    scene.spots[0].axis_world = glm::normalize(-scene.spots[0].position_world);
    return scene;
  };
  cast_all(trial, 12, sphere, false);
}

// The eye inside of volumes and of solids, and near planes that cut them.
void eye_and_near_plane(Trial& trial) {
  cast_on_floors(trial, 8, [](RandomSolids& random, Scene& scene, int i) {
    const LightPoint light =
        light_of(scene, {i % 2 ? LightKind::directional : LightKind::positional, 0}).point;
    const glm::dvec3 caster = scene.positions_world[i % 4 < 2 ? 0 : 5];
    scene.camera.eye_world = caster - random.within(0.2, 1.0) * glm::normalize(light.way_from(caster)) +
                             random.within(1e-4, 0.3) * random.unit();
    scene.camera.eye_world.y = std::max(scene.camera.eye_world.y, -1.2);
    scene.camera.target_world = random.cube(1.0);
  });
  cast_on_floors(trial, 14, [](RandomSolids& random, Scene& scene, int) {
    const CornersWorld c = corners_world(scene, scene.triangles[0]);
    scene.camera.eye_world =
        (c[0] + c[1] + c[2]) / 3.0 - 0.05 * glm::normalize(glm::cross(c[1] - c[0], c[2] - c[0]));
    scene.camera.target_world = random.cube(2.0);
  });
  cast_on_floors(trial, 9, [](RandomSolids& random, Scene& scene, int) {
    scene.camera.eye_world = 3.0 * random.unit();
    scene.camera.eye_world.y = std::abs(scene.camera.eye_world.y) - 1.0;
    scene.camera.near = random.within(1.0, 3.0);
  });
}

// Plates that touch and lie on each other, with lights almost in their plane.
Scene touching_plates(RandomSolids& random, int) {
  Scene scene = random.scene(0);
  double top = 0.0;
  for (int plate = 0; plate < 6; ++plate) {
    const double thick = random.within(0.002, 0.05);
    Mesh mesh = make_box({random.within(0.6, 2.0), thick, random.within(0.6, 2.0)}, 1);
    transform(mesh, glm::translate(glm::dmat4(1.0), {random.within(-0.3, 0.3), top + thick / 2, 0.0}));
    top += thick;
    add_mesh(scene, mesh);
  }
  Mesh floor = make_box({8.0, 0.5, 8.0}, 2);
  for (glm::dvec3& p : floor.positions) p.y -= 0.25;
  add_mesh(scene, floor);
  scene.camera.up_world = {0.0, 1.0, 0.0};
  scene.camera.eye_world = {random.within(-2.0, 2.0), random.within(0.5, 3.0), 3.5};
  const double over = random.within(0.002, 0.08);
  scene.directional[0].to_light_world = glm::normalize(glm::dvec3(random.within(-1, 1), over, 0.7));
  scene.positional[0].position_world = {3.0, top + 3.0 * over, random.within(-1, 1)};
  scene.spots[0].position_world = {-3.0, top + 3.0 * over, random.within(-1, 1)};
  scene.spots[0].axis_world = glm::normalize(-scene.spots[0].position_world);
  return scene;
}

void plates(Trial& trial) {
  const Sum sum = cast_all(trial, 13, touching_plates);
  trial.remark(fmt::format(
      "light is wrong in {} of {} cases (one light at one pixel), {} of them away from edges, by up to "
      "{:.3g} colour steps",
      sum.differ + sum.off_edge, sum.pixels, sum.off_edge, sum.most));
}

// Adds a wall that casts no shadow.
void add_front(Scene& scene, double z) {
  Mesh wall = make_box({40.0, 40.0, 0.1}, 1);
  for (glm::dvec3& p : wall.positions) p.z += z;
  std::erase_if(wall.triangles, [&](const SceneTriangle& t) {
    return std::ranges::any_of(t.position, [&](std::uint32_t p) { return wall.positions[p].z < z; });
  });
  add_mesh(scene, wall);
}

// Sheets one behind the other in front of a wall, with the sun behind the eye.
Scene sheets(int count) {
  Scene scene;
  scene.directional.resize(1);
  scene.positional = {{{3.0, 3.0, 3.0}, glm::dvec3(1.0)}};
  scene.spots.resize(1);
  for (int i = 0; i < count; ++i) {
    Mesh sheet = make_box({0.5, 0.5, 0.001}, 1);
    for (glm::dvec3& p : sheet.positions) p += glm::dvec3(1.0, 0.2, -0.003 * i);
    add_mesh(scene, sheet);
  }
  add_front(scene, -8.0);
  set_colours(scene);
  scene.positional[0].intensity = scene.spots[0].intensity = glm::dvec3(0.0);
  scene.directional[0] = {glm::normalize(glm::dvec3(0.02, 0.01, 1.0)), glm::dvec3(1.0)};
  scene.camera = {.eye_world = {-3.0, 0.2, 3.0}, .target_world = {0.0, 0.0, -6.0}};
  return scene;
}

void nested_volumes(Trial& trial) {
  const FrameSize frame{24, 18};
  for (const int count : {2, 4, 12, 300}) {
    const Scene scene = sheets(count);
    const Drawing drawing = trial.draw(scene, {.plan = request_of(ProcessorForm::unrolled), .frame = frame});
    const std::uint64_t needed = drawing.counts.objects;
    trial.check(count <= 4 ? needed <= c_object_processors : needed > c_object_processors,
                [&] { return fmt::format("{} sheets need {} object processors", count, needed); });
    trial.check(drawing.fault == (needed > c_object_processors),
                [&] { return fmt::format("{} sheets: fault {}", count, drawing.fault); });
    if (drawing.fault) continue;
    const Pieces pieces(scene, frame);
    const Rays rays(scene);
    for (const Fragment& f : drawing.golden) {
      const ScreenTriangle* piece = pieces.covering(f);
      if (piece == nullptr) continue;
      const bool lit = rays.reaches(0, surface(*piece, 4, f.x, f.y).position_world, f.triangle);
      trial.check((f.red > 0) == lit,
                  [&] { return fmt::format("{} sheets: pixel ({}, {})", count, f.x, f.y); });
    }
  }
}

constexpr HardCase c_cases[] = {{"volumes", volumes},
                                {"eye_and_near_plane", eye_and_near_plane},
                                {"plates", plates},
                                {"nested_volumes", nested_volumes}};
INSTANTIATE_TEST_SUITE_P(shadows, HardCases, testing::ValuesIn(c_cases), id_of);

}  // namespace
}  // namespace halfway::stability
