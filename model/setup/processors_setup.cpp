// SPDX-License-Identifier: Apache-2.0
#include "setup/processors_setup.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <optional>

#include "common/to_integer.hpp"
#include "projection/unit_vector.hpp"
#include "scene/lights.hpp"
#include "setup/object_strips.hpp"
#include "setup/quadratic_fit.hpp"
#include "setup/shadow_volume.hpp"
#include "setup/walk.hpp"
#include "setup/walk_header.hpp"
#include "shading/effects.hpp"
#include "shading/shade.hpp"
#include "words/object_limits.hpp"
#include "words/processors_layout.hpp"

namespace halfway {
namespace {

using words::Command, words::Exact, words::Published, words::c_axes;

// A light farther away than this multiple of the surfaces' extent would leave no bits for their positions.
// Preset published treats it as directional.
constexpr double c_farthest_light = 4096.0;

constexpr double c_white = 255.0;  // colour steps

constexpr int c_subpixel_bits = 4;  // of screen coordinates

// A cone is reported in a note if the angle between its axis and its edge is less than this many errors of a
// cosine.
constexpr double c_least_cone = 32.0;

// A number format outside any block.
constexpr words::Field word(int bits, int fraction_bits, bool is_signed = false) {
  return {"", 0, bits, is_signed, fraction_bits};
}

std::int64_t largest(const words::Field& f) {
  return (std::int64_t{1} << (f.bits - (f.is_signed ? 1 : 0))) - 1;
}
double largest_value(const words::Field& f) {
  return std::ldexp(static_cast<double>(largest(f)), -f.fraction_bits);
}

// Rounds and clamps to the format.
std::int64_t clamped(double value, const words::Field& f) {
  const double most = static_cast<double>(largest(f)), least = f.is_signed ? -most - 1.0 : 0.0;
  const double rounded = std::floor(std::ldexp(value, f.fraction_bits) + 0.5);
  return to_integer<std::int64_t>(std::clamp(rounded, least, most));
}
bool holds(double value, const words::Field& f) {
  return std::floor(std::ldexp(value, f.fraction_bits) + 0.5) <= static_cast<double>(largest(f));
}

// The exponent e for which v = m * 2^e with m in [1/2, 1). 0 if there is none.
int exponent_of(double v) {
  int e = 0;
  if (std::isfinite(v)) std::frexp(v, &e);
  return e;
}

class ViewSpace {
 public:
  explicit ViewSpace(const Camera& camera) : eye_world_(camera.eye_world), basis_(view_basis(camera)) {}
  glm::dvec3 direction(glm::dvec3 direction_world) const {
    return {glm::dot(basis_.right_world, direction_world), glm::dot(basis_.up_world, direction_world),
            glm::dot(basis_.backward_world, direction_world)};
  }
  glm::dvec3 point(glm::dvec3 point_world) const { return direction(point_world - eye_world_); }

 private:
  glm::dvec3 eye_world_;
  ViewBasis basis_;
};

constexpr glm::dvec3 c_to_eye_view(0.0, 0.0, 1.0);  // published: the same at all points

// One value per vertex, in units of plane_sum.
using PlaneValues = std::array<std::int64_t, 3>;
constexpr std::size_t c_most_planes = 2 * c_axes + 1;

struct Surface {
  bool normalize;
  std::array<PlaneValues, c_most_planes> planes;  // the layout's number of planes is used
};

// A shadow polygon. Its depth is constant if it lies in front of the near plane.
struct Shadow {
  ShadowPolygon polygon;
  bool before_near;
};

template <class P>
class ProcessorsSetup final : public Setup {
 public:
  ProcessorsSetup(const Scene& scene, FrameSize frame, const HardwareKey& key,
                  const ProcessorsSetupOptions& options)
      : scene_(scene),
        frame_(frame),
        config_(processors_config(key)),
        layout_(config_),
        chain_(chain_of(key)),
        view_(scene.camera),
        projector_(scene, frame, {.subpixel_bits = c_subpixel_bits, .clip_to_frame = false}),
        lights_(reflected_lights(scene)),
        has_places_(
            std::any_of(lights_.begin(), lights_.end(), [&](LightRef light) { return has_place(light); })),
        normalizes_(has_places_ || options.normalize) {
    set_scales();
    set_ambient();
    for (const Material& m : scene.materials) materials_.push_back(material_words(m));
    note_clamped_values();
    assert(has_strips() || !config_.shadows);
    if (has_strips()) index_strips();
  }

  unsigned init_bits() const override { return static_cast<unsigned>(layout_.init_bits()); }
  bool units_are_strips() const override { return has_strips(); }
  std::uint32_t units() const override {
    return static_cast<std::uint32_t>(has_strips() ? strips_.size() : scene_.triangles.size());
  }
  Tile reach(std::uint32_t unit) const override {
    return has_strips() ? strips_[unit].area : projector_.reach(unit);
  }
  std::vector<std::string> notes() const override { return notes_; }

  void append_prologue(std::vector<std::uint32_t>& words, SetupCounts& counts) const override {
    counts += whole_frame_;
    InitVector frame = request(words, Command::new_frame, counts);
    if (chain_.filtered()) put_colour(frame, as_drawn(scene_.background));
    InitVector ambient = request(words, Command::define, counts);
    put_colour(ambient, ambient_);
    for (std::size_t i = 0; i < lights_.size(); ++i) {
      InitVector light = request(words, Command::define, counts, static_cast<int>(i) + 1);
      put_light(light, i);
      put_colour(light, light_of(scene_, lights_[i]).intensity);
    }
  }

  std::unique_ptr<SetupWorker> worker() const override { return std::make_unique<Worker>(*this); }

 private:
  class Worker final : public SetupWorker {
   public:
    explicit Worker(const ProcessorsSetup& setup) : setup_(setup), mesh_(setup.projector_) {}

    void append(std::uint32_t unit, std::vector<std::uint32_t>& words, SetupCounts& counts) override {
      if (setup_.has_strips()) {
        setup_.append_strip(setup_.strips_[unit], words, counts);
        return;
      }
      for (const ScreenTriangle& t : mesh_.project(unit, counts.projection)) {
        ++counts.triangles;
        setup_.append_triangle(t, words, counts);
      }
    }

   private:
    const ProcessorsSetup& setup_;
    MeshProjector mesh_;
  };

  void append_triangle(const ScreenTriangle& t, std::vector<std::uint32_t>& words,
                       SetupCounts& counts) const {
    const Walks walks = plan_walks(screen_points(t), c_subpixel_bits, frame_);
    if (walks.empty()) return;
    ++counts.leaves;
    const PlaneFit fit = plane_fit(t);
    const Surface surface = surface_of(t);
    for (const Walk& walk : walks) draw(t, fit, surface, difference_start(walk), walk, words, counts);
  }

  using Request = typename P::request_header_at;
  using Axes = typename P::light_axes_header_at;
  using Axis = typename P::light_axes_channel_at;
  using Plane = typename P::plane_header_at;

  static constexpr bool c_exact = words::ProcessorsLayout<P>::c_exact;
  static constexpr words::Field c_direction = word(P::c_direction_bits, P::c_direction_fraction_bits, true);
  static constexpr words::Field c_exponent = word(P::c_exponent_bits, P::c_exponent_fraction_bits);
  static constexpr words::Field c_coefficient = word(P::c_coefficient_bits, P::c_coefficient_fraction_bits);
  static constexpr words::Field c_reflected = word(P::c_reflected_bits, P::c_reflected_fraction_bits);
  static constexpr words::Field c_intensity = P::light_colour_channel_at::intensity;
  // Error of a unit vector's length, and so of a cosine close to 1: see reciprocal_root.vhd.
  static constexpr double c_cosine_error = c_exact ? 0x1p-19 : 0x1p-7;
  // Half a step of `vector`: the hardware truncates the planes to that format.
  static constexpr std::int64_t c_half_vector =
      half(P::c_plane_sum_fraction_bits - P::c_vector_fraction_bits);

  struct MaterialWords {
    std::int64_t exponent;
    std::array<std::int64_t, 3> ambient, diffuse, specular;
  };

  // I_a of the frame. A processor multiplies it by k_a, so it is raised until each emission has a k_a in
  // range, to a whole number of colour steps, which both presets hold.
  void set_ambient() {
    const std::vector<bool> used = used_materials(scene_);
    for (std::size_t i = 0; i < used.size(); ++i) {
      if (!used[i]) continue;
      const Material& m = scene_.materials[i];
      const glm::dvec3 radiance = ambient_radiance(scene_, m);
      for (int c = 0; c < 3; ++c) {
        if (m.emission[c] == 0.0) continue;
        const double steps = std::min(radiance[c] * c_white, largest_value(c_reflected));
        const double least = std::ceil(steps / largest_value(c_coefficient)) / c_white;
        ambient_[c] = std::max(ambient_[c], least);
      }
    }
  }

  // k_a times colour, or what draws the same radiance with the frame's I_a.
  glm::dvec3 ambient_coefficient(const Material& m) const {
    const glm::dvec3 radiance = ambient_radiance(scene_, m);
    glm::dvec3 k = m.ambient * m.colour;
    for (int c = 0; c < 3; ++c)
      if (m.emission[c] > 0.0 || ambient_[c] != scene_.ambient[c]) k[c] = radiance[c] / ambient_[c];
    return k;
  }

  void set_scales() {
    const DepthRange& range = projector_.range();
    double nearest = range.far, extent = 0.0;
    for (const SceneTriangle& t : scene_.triangles)
      for (const std::uint32_t corner : t.position) {
        const glm::dvec3 p_view = view_.point(scene_.positions_world[corner]);
        nearest = std::min(nearest, -p_view.z);
        extent = std::max(extent, largest_component(p_view));
      }
    if constexpr (c_exact) {
      const double height = std::tan(0.5 * glm::radians(scene_.camera.vertical_fov_degrees));
      const double width = height * frame_.width / frame_.height;
      ray_exponent_ = -exponent_of(std::max({1.0, height, width}));
      distance_exponent_ = -exponent_of(1.0 / std::max(nearest, range.near));
      return;
    }
    double farthest = extent;
    for (const LightRef light : lights_) {
      if (!has_place(light)) continue;
      const double distance = largest_component(place_view(light));
      if (distance <= c_farthest_light * extent) farthest = std::max(farthest, distance);
    }
    scale_exponent_ = exponent_of(farthest);
    farthest_ = c_farthest_light * extent;
  }

  bool has_place(LightRef light) const { return light_of(scene_, light).point.w != 0.0; }
  glm::dvec3 place_view(LightRef light) const { return view_.point(light_of(scene_, light).point.xyz_world); }

  // The exponent of the power of two that scales the place below 1. Empty if the format has none, or if the
  // light is too far away.
  std::optional<int> light_shift(glm::dvec3 place_view) const {
    const double distance = largest_component(place_view);
    if (distance == 0.0) return 0;
    if constexpr (c_exact) {
      const int shift = std::max(0, exponent_of(distance) + ray_exponent_ - distance_exponent_);
      if (!std::isfinite(distance) || shift >= 1 << P::c_light_shift_bits) return std::nullopt;
      return shift;
    } else {
      if (!(distance <= farthest_)) return std::nullopt;
      return 0;
    }
  }

  InitVector request(std::vector<std::uint32_t>& words, Command command, SetupCounts& counts,
                     int light = 0) const {
    ++counts.vectors;
    InitVector init(words, init_bits());
    init.put(Request::command, static_cast<std::int64_t>(command));
    init.put(Request::light, light);
    return init;
  }

  void put_colour(InitVector& init, glm::dvec3 light_intensity) const {
    for (int c = 0; c < config_.channels; ++c)
      init.put(P::light_colour_channel_at::intensity, clamped(light_intensity[c] * c_white, c_intensity),
               layout_.light_colour_low(c));
  }

  // Rounded as in a frame.
  static glm::dvec3 as_drawn(glm::dvec3 radiance) {
    return glm::dvec3(to_byte(radiance.r), to_byte(radiance.g), to_byte(radiance.b)) / c_white;
  }

  void put_axis_vector(InitVector& init, const words::Field& field, glm::dvec3 v) const {
    for (int axis = 0; axis < c_axes; ++axis)
      init.put(field, clamped(v[axis], field), layout_.light_axis_low(axis));
  }

  // Writes a unit vector into the field of the place.
  void put_towards(InitVector& init, glm::dvec3 to_light_view) const {
    constexpr int c_below = P::c_light_place_fraction_bits - P::c_direction_fraction_bits;
    for (int axis = 0; axis < c_axes; ++axis)
      init.put(Axis::place, clamped(to_light_view[axis], c_direction) * (std::int64_t{1} << c_below),
               layout_.light_axis_low(axis));
  }

  void put_light(InitVector& init, std::size_t number) const {
    const Light light = light_of(scene_, lights_[number]);
    const int low = layout_.light_axes_low();
    if (config_.shadows && number < volumes_.size())
      init.put(Axes::around_eye,
               std::min<std::int64_t>(volumes_[number].around_eye, largest(Axes::around_eye)), low);
    glm::dvec3 to_light_view(0.0);
    std::optional<int> shift;
    if (light.point.w == 0.0) {
      to_light_view = view_.direction(light.point.xyz_world);
    } else {
      const glm::dvec3 place = view_.point(light.point.xyz_world);
      shift = light_shift(place);
      if (shift)
        put_place(init, place, *shift);
      else
        to_light_view = unit_or_zero(place);
    }
    init.put(Axes::positional, shift.has_value(), low);
    if (!shift) put_towards(init, to_light_view);
    if constexpr (!c_exact)
      put_axis_vector(init, Axis::half,
                      shift ? std::ldexp(1.0, -scale_exponent_) * c_to_eye_view
                            : unit_or_zero(c_to_eye_view + to_light_view));
    if (!light.cone) return;
    init.put(Axes::spot, 1, low);
    put_axis_vector(init, Axis::axis, view_.direction(light.cone->axis_world));
    init.put(Axes::outer, clamped(light.cone->cos_outer, Axes::outer), low);
    const double width = light.cone->cos_inner - light.cone->cos_outer;
    init.put(Axes::slope, width > 0.0 ? clamped(1.0 / width, Axes::slope) : largest(Axes::slope), low);
  }

  void put_place(InitVector& init, glm::dvec3 place, int shift) const {
    const int exponent = c_exact ? ray_exponent_ - distance_exponent_ - shift : -scale_exponent_;
    if constexpr (c_exact) init.put(Axes::shift, shift, layout_.light_axes_low());
    put_axis_vector(
        init, Axis::place,
        {std::ldexp(place.x, exponent), std::ldexp(place.y, exponent), std::ldexp(place.z, exponent)});
  }

  MaterialWords material_words(const Material& m) const {
    MaterialWords w{.exponent = clamped(m.exponent, c_exponent)};
    const glm::dvec3 ambient = ambient_coefficient(m);
    for (int c = 0; c < 3; ++c) {
      const auto i = static_cast<std::size_t>(c);
      w.ambient[i] = clamped(ambient[c], c_coefficient);
      w.diffuse[i] = clamped(m.diffuse * m.colour[c], c_coefficient);
      w.specular[i] = clamped(m.specular * m.specular_colour[c], c_coefficient);
    }
    return w;
  }

  void put_material(InitVector& init, const MaterialWords& w) const {
    const int low = layout_.init_material_low();
    if (config_.specular) init.put(c_exponent, w.exponent, low + layout_.exponent_low());
    for (int c = 0; c < config_.channels; ++c) {
      const auto i = static_cast<std::size_t>(c);
      init.put(c_coefficient, w.ambient[i], low + layout_.ambient_low(c));
      if (config_.diffuse) init.put(c_coefficient, w.diffuse[i], low + layout_.diffuse_low(c));
      if (config_.specular) init.put(c_coefficient, w.specular[i], low + layout_.specular_low(c));
    }
  }

  static PlaneFit plane_fit(const ScreenTriangle& t) { return PlaneFit(screen_points(t), c_subpixel_bits); }

  // Where the words of a vector's planes are computed, and the pixels from there to the vector's start.
  struct PlaneStart {
    BarycentricStart computed;
    std::int64_t columns = 0, lines = 0;
  };
  // In strips the words are computed at the triangle's origin: where a strip begins then makes no difference.
  PlaneStart plane_start(const PlaneFit& fit, const ScreenTriangle& t, const DifferenceStart& first) const {
    if (!has_strips()) return {fit.at(first)};
    const DifferenceStart origin = origin_of(t);
    return {fit.at(origin), first.x - origin.x, first.y - origin.y};
  }
  // Words of a plane of `bits` bits. The rounded changes move the value to the vector's start.
  DepthWords plane_words(const PlaneFit& fit, const std::array<std::int64_t, 3>& values,
                         const PlaneStart& start, std::int64_t half, int bits) const {
    DepthWords words = fit.words(values, start.computed, half);
    words.value += start.columns * words.dx + start.lines * words.de0;
    // With subpixels, which need eighths of a change, de1 has the three bits above those of dx and of de0.
    // Object processors do not step by de1.
    if (chain_.filtered()) words.de1 = (words.dx >> bits & 7) | (words.de0 >> bits & 7) << 3;
    return words;
  }

  // The pixel of the frame that is nearest to the leftmost column and the first line of the triangle.
  DifferenceStart origin_of(const ScreenTriangle& t) const {
    const auto& v = t.vertex;
    const auto pixel = [](std::int32_t least, std::uint32_t size) {
      return std::clamp<std::int64_t>(least >> c_subpixel_bits, 0, std::int64_t{size} - 1);
    };
    return {pixel(std::min({v[0].x, v[1].x, v[2].x}), frame_.width),
            pixel(std::min({v[0].y, v[1].y, v[2].y}), frame_.height), 0, false};
  }

  DepthWords depth_words(const PlaneFit& fit, const ScreenTriangle& t, const PlaneStart& start) const {
    return plane_words(fit, fixed_depths(t), start, half(Exact::c_depth_sum_fraction_bits),
                       Exact::c_depth_sum_bits);
  }

  bool has_one_normal(const ScreenTriangle& t) const {
    const auto& n = scene_.triangles[t.source].normal;
    const auto& world = scene_.normals_world;
    return world[n[0]] == world[n[1]] && world[n[0]] == world[n[2]];
  }

  Surface surface_of(const ScreenTriangle& t) const {
    Surface surface;
    std::array<glm::dvec3, 3> normal, place;
    const bool flat = has_one_normal(t);
    if constexpr (c_exact) {
      surface.normalize = !flat && !lights_.empty();
      for (std::size_t i = 0; i < 3; ++i) {
        const ScreenVertex& v = t.vertex[i];
        normal[i] = flat ? surface_point(t, glm::dvec3(1.0 / 3.0)).normal_world
                         : v.inverse_w / t.vertex[0].inverse_w * v.normal_world;
        place[i] = std::ldexp(v.inverse_w, ray_exponent_) * view_.point(v.position_world);
      }
      if (!flat) scale(normal);
    } else {
      surface.normalize = normalizes_;
      for (std::size_t i = 0; i < 3; ++i) {
        normal[i] = surface_point(t, barycentric_at_vertex(i)).normal_world;
        place[i] = std::ldexp(1.0, -scale_exponent_) * view_.point(t.vertex[i].position_world);
      }
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const glm::dvec3 n_view = view_.direction(normal[i]);
      for (int axis = 0; axis < c_axes; ++axis) {
        const auto n = static_cast<std::size_t>(axis);
        surface.planes[n][i] = plane_value(n_view[axis]);
        surface.planes[c_axes + n][i] = plane_value(place[i][axis]);
      }
      surface.planes[2 * c_axes][i] = plane_value(std::ldexp(t.vertex[i].inverse_w, distance_exponent_));
    }
    return surface;
  }

  // Scales so that the largest component in view space is in [1/2, 1].
  void scale(std::array<glm::dvec3, 3>& normal) const {
    double most = 0.0;
    for (const glm::dvec3& n : normal) most = std::max(most, largest_component(view_.direction(n)));
    for (glm::dvec3& n : normal) n = most > 0.0 ? std::ldexp(1.0, -exponent_of(most)) * n : glm::dvec3(0.0);
  }

  // A vertex outside the frame may exceed the drawn range. It is clamped to 2^13 times that range.
  static std::int64_t plane_value(double v) {
    constexpr double c_most = 1 << 15;
    return std::isnan(v) ? 0 : fixed(std::clamp(v, -c_most, c_most), P::c_plane_sum_fraction_bits);
  }

  // Appends the vector that draws a walk. The differences start at `first`.
  void draw(const ScreenTriangle& t, const PlaneFit& fit, const Surface& surface,
            const DifferenceStart& first, const Walk& walk, std::vector<std::uint32_t>& words,
            SetupCounts& counts) const {
    const PlaneStart start = plane_start(fit, t, first);
    InitVector init = request(words, Command::new_object, counts);
    put_header(init, t.source, walk, depth_words(fit, t, start), layout_.walk_low());
    init.put(Request::normalize, surface.normalize);
    for (int plane = 0; plane < layout_.planes(); ++plane) {
      // Without positions the layout has only the planes of N.
      const DepthWords of_plane = plane_words(fit, surface.planes[static_cast<std::size_t>(plane)], start,
                                              c_half_vector, P::c_plane_sum_bits);
      const int low = layout_.plane_low(plane);
      init.put(Plane::value, of_plane.value, low);
      init.put(Plane::dx, of_plane.dx, low);
      init.put(Plane::de0, of_plane.de0, low);
      init.put(Plane::de1, of_plane.de1, low);
    }
    put_material(init, materials_[t.material]);
  }

  // Appends the vector of a shadow polygon.
  void cast(const Shadow& shadow, const DifferenceStart& first, const Walk& walk,
            std::vector<std::uint32_t>& words, SetupCounts& counts) const {
    ++counts.shadows;
    const ScreenTriangle& t = shadow.polygon.triangle;
    InitVector init = request(words, Command::shadow, counts, static_cast<int>(shadow.polygon.light) + 1);
    init.put(Request::opens, shadow.polygon.opens);
    DepthWords depth{0, 0, 0, 0};
    if (!shadow.before_near) {
      const PlaneFit fit = plane_fit(t);
      depth = depth_words(fit, t, plane_start(fit, t, first));
    }
    put_header(init, t.source, walk, depth, layout_.walk_low());
  }

  static ObjectChain chain_of(const HardwareKey& key) {
    const int subpixels = static_cast<int>(key.processors.subpixels);
    return {.processors = key.processors.objects,
            .side = static_cast<std::uint32_t>(words::side_of(subpixels)),
            .most_columns = static_cast<std::uint32_t>(words::most_columns<P>(subpixels)),
            .most_lines = static_cast<std::uint32_t>(words::most_lines<P>(subpixels))};
  }
  bool has_strips() const { return chain_.processors > 0; }

  bool covers_something(const ScreenTriangle& t) const {
    return !strip_walks(screen_points(t), c_subpixel_bits, whole_frame(frame_), chain_.side).empty();
  }

  // Collects all triangles and shadow polygons to draw, and cuts the frame into strips.
  void index_strips() {
    std::vector<ScreenTriangle> on_screen;
    for (std::uint32_t source = 0; source < scene_.triangles.size(); ++source)
      projector_.project(source, on_screen, whole_frame_.projection);
    whole_frame_.triangles = on_screen.size();
    for (const ScreenTriangle& piece : on_screen)
      if (covers_something(piece)) triangles_.push_back(piece);
    whole_frame_.leaves = triangles_.size();
    if (config_.shadows && scene_.shadows) index_shadows();
    std::vector<StripItem> objects, shadows;
    for (const ScreenTriangle& t : triangles_) objects.push_back(screen_points(t));
    for (const Shadow& shadow : shadows_) shadows.push_back(screen_points(shadow.polygon.triangle));
    ObjectStrips cut = cut_strips(objects, shadows, c_subpixel_bits, frame_, chain_);
    strips_ = std::move(cut.strips);
    whole_frame_.objects = cut.processors;
  }

  void index_shadows() {
    volumes_ = make_shadow_volumes(scene_, lights_);
    ProjectionCounts counts;
    for (const ShadowPolygon& polygon : shadow_polygons(scene_, projector_, volumes_, counts)) {
      if (!covers_something(polygon.triangle)) continue;
      const auto& v = polygon.triangle.vertex;
      const bool before_near = v[0].z == 0.0 && v[1].z == 0.0 && v[2].z == 0.0;
      shadows_.push_back({polygon, before_near});
    }
    whole_frame_.projection.unrepresentable += counts.unrepresentable;
  }

  // A strip with its triangles and shadow polygons, in the order of their first lines, and the vector that
  // ends it. The first vector contains the number of those after it.
  void append_strip(const ObjectStrip& strip, std::vector<std::uint32_t>& words, SetupCounts& counts) const {
    using At = Exact::init_header_at;
    struct Part {
      const ScreenTriangle* triangle;
      const Shadow* shadow;  // empty: an object
      Walk walk;
      std::int64_t first_line;
    };
    std::vector<Part> parts;
    const auto add = [&](const ScreenTriangle& t, const Shadow* shadow) {
      for (const Walk& walk : strip_walks(screen_points(t), c_subpixel_bits, strip.area, chain_.side))
        parts.push_back({&t, shadow, walk, pixel_lines(walk, chain_.side).begin});
    };
    for (const std::uint32_t item : strip.objects) add(triangles_[item], nullptr);
    for (const std::uint32_t item : strip.shadows) add(shadows_[item].polygon.triangle, &shadows_[item]);
    std::stable_sort(parts.begin(), parts.end(),
                     [](const Part& a, const Part& b) { return a.first_line < b.first_line; });
    const auto put_area = [&](const Tile& area, std::size_t vectors_after) {
      InitVector init = request(words, Command::new_scanline, counts);
      init.put(At::triangle, static_cast<std::int64_t>(vectors_after), layout_.walk_low());
      init.put(At::y, area.y, layout_.walk_low());
      init.put(At::upper_lines, area.size.height, layout_.walk_low());
      init.put(At::start_x, area.x, layout_.walk_low());
      init.put(At::upper_x, std::int64_t{area.x} + area.size.width, layout_.walk_low());
    };
    put_area(strip.area, parts.size() + 1);
    for (const Part& part : parts) {
      const DifferenceStart first{strip.area.x, strip.area.y + part.first_line, 0, false};
      if (part.shadow)
        cast(*part.shadow, first, part.walk, words, counts);
      else
        draw(*part.triangle, plane_fit(*part.triangle), surface_of(*part.triangle), first, part.walk, words,
             counts);
    }
    put_area({}, 0);
  }

  void note_clamped_values() {
    const auto note_light = [&](const std::string& name, glm::dvec3 light_intensity) {
      const double most = largest_component(light_intensity);
      if (!holds(most * c_white, c_intensity))
        notes_.push_back(fmt::format("the {} is {:.4g} times white and was clamped to {:.4g}", name, most,
                                     largest_value(c_intensity) / c_white));
    };
    note_light("ambient light", ambient_);
    for (const LightRef light : lights_) note_light(name_of(light), light_of(scene_, light).intensity);
    const std::vector<bool> used = used_materials(scene_);
    for (std::size_t i = 0; i < used.size(); ++i)
      if (used[i]) note_material(scene_.materials[i]);
    for (const LightRef light : lights_) {
      if (!has_place(light)) continue;
      const std::optional<int> shift = light_shift(place_view(light));
      if (!shift)
        notes_.push_back(
            fmt::format("{} is so far away that it was drawn as a directional light", name_of(light)));
      if constexpr (!c_exact)
        if (shift && !holds(std::ldexp(1.0, -scale_exponent_), Axis::half))
          notes_.push_back(
              fmt::format("{}: the scene is so small that the unit vector to the eye, which the published "
                          "highlight adds to the vector to the light, was clamped to {:.4g} times its size",
                          name_of(light), largest_value(Axis::half)));
      if (const auto& cone = light_of(scene_, light).cone) note_cone(light, *cone);
    }
  }

  void note_cone(LightRef light, const LightCone& cone) {
    const double cos_outer = cone.cos_outer;
    if (1.0 - cos_outer >= c_least_cone * c_cosine_error) return;
    notes_.push_back(fmt::format(
        "{}: its cone of {:.2g} degrees is so narrow that its light is noisy: the error of a cosine is up to "
        "{:.1g}",
        name_of(light), 2.0 * glm::degrees(std::acos(cos_outer)), c_cosine_error));
  }

  void note_material(const Material& m) {
    struct Term {
      const char* name;
      glm::dvec3 k;
    };
    const std::array<Term, 3> terms = {
        {{m.emission == glm::dvec3(0.0) ? "k_a" : "k_a and emission", ambient_coefficient(m)},
         {"k_d", m.diffuse * m.colour},
         {"k_s", m.specular * m.specular_colour}}};
    for (const Term& term : terms) {
      const double most = largest_component(term.k);
      if (most > 0.0 && !holds(most, c_coefficient))
        notes_.push_back(fmt::format("material '{}': its {} of {:.4g} was clamped to {:.4g}", m.name,
                                     term.name, most, largest_value(c_coefficient)));
    }
    if (has_specular(m) && !lights_.empty() && !holds(m.exponent, c_exponent))
      notes_.push_back(fmt::format("material '{}': its exponent {:.6g} was clamped to {:.6g}", m.name,
                                   m.exponent, largest_value(c_exponent)));
    const auto note_reflected = [&](const Term& term, const std::string& light, glm::dvec3 light_intensity) {
      const double most = largest_component(term.k * light_intensity);
      if (!holds(most * c_white, c_reflected))
        notes_.push_back(
            fmt::format("material '{}': its {} times the {} is {:.4g} times white and is clamped to {:.4g}",
                        m.name, term.name, light, most, largest_value(c_reflected) / c_white));
    };
    note_reflected(terms[0], "ambient light", ambient_);
    for (const LightRef light : lights_)
      for (const Term& term : {terms[1], terms[2]})
        note_reflected(term, name_of(light), light_of(scene_, light).intensity);
  }

  const Scene& scene_;
  FrameSize frame_;
  words::ProcessorsConfig config_;
  words::ProcessorsLayout<P> layout_;
  ObjectChain chain_;
  ViewSpace view_;
  Projector projector_;
  glm::dvec3 ambient_ = scene_.ambient;
  std::vector<LightRef> lights_;  // at most the key's number; further lights of the key stay undefined
  bool has_places_;
  bool normalizes_;  // published
  // Exact: b is 2^ray_exponent_, a 2^distance_exponent_. Published: the scale is 2^scale_exponent_.
  int ray_exponent_ = 0, distance_exponent_ = 0, scale_exponent_ = 0;
  double farthest_ = 0.0;  // published: greatest distance of a light's place
  std::vector<MaterialWords> materials_;
  std::vector<std::string> notes_;

  // Used only with object processors.
  std::vector<ScreenTriangle> triangles_;
  std::vector<ShadowVolumes> volumes_;
  std::vector<Shadow> shadows_;
  std::vector<ObjectStrip> strips_;
  SetupCounts whole_frame_;
};

}  // namespace

std::unique_ptr<Setup> make_processors_setup(const Scene& scene, FrameSize frame, const HardwareKey& key,
                                             const ProcessorsSetupOptions& options) {
  if (key.preset == Preset::exact)
    return std::make_unique<ProcessorsSetup<Exact>>(scene, frame, key, options);
  return std::make_unique<ProcessorsSetup<Published>>(scene, frame, key, options);
}

}  // namespace halfway
