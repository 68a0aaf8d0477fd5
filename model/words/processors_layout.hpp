// SPDX-License-Identifier: Apache-2.0
// Golden model of rtl/shaders/processors_pkg.vhd: the configuration of the shading processors, and the
// positions of the blocks in their flat vectors.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <type_traits>

#include "words/formats.hpp"
#include "words/word.hpp"

namespace halfway::words {

/// The processors shader's generics.
struct ProcessorsConfig {
  int channels = 3;
  /// Number of lights of each kind. Numbering: 1 to directional, then positional lights, then spots.
  int directional = 0, positional = 0, spots = 0;
  bool diffuse = true, specular = true;  ///< each light has a processor for it
  bool normalize = true;                 ///< the ambient processor can normalize N
  bool shadows = false;

  constexpr int lights() const { return directional + positional + spots; }
  /// Number of processors in the pipeline: ambient, and for each light a diffuse and a specular one.
  constexpr int processors() const { return 1 + lights() * ((diffuse ? 1 : 0) + (specular ? 1 : 0)); }
};

/// Commands of the host's vectors and of tokens (docs/rtl/processors.md has their effects).
enum class Command : std::uint32_t {
  new_pixel = 0,
  new_object = 1,
  new_scanline = 2,
  new_frame = 3,
  define = 4,
  redefine = 5,
  remove = 6,  ///< delete
  shadow = 7,
};

/// Only the processors use such a vector.
constexpr bool is_load(Command command) {
  return command == Command::new_frame || command == Command::define || command == Command::redefine ||
         command == Command::remove;
}
/// The start of a pixel.
constexpr bool is_head(Command command) {
  return command == Command::new_pixel || command == Command::new_scanline;
}

template <class Preset>
Command command_of(std::span<const std::uint32_t> vector) {
  return static_cast<Command>(get_bits(vector, Preset::request_header_at::command));
}

/// The term that a processor adds.
enum class Term { ambient = 0, diffuse = 1, specular = 2 };

inline constexpr int c_axes = 3;

template <class Preset>
class ProcessorsLayout {
 public:
  static constexpr bool c_exact = std::is_same_v<Preset, Exact>;

  explicit constexpr ProcessorsLayout(const ProcessorsConfig& config) : c_(config) {}

  /// True if P is interpolated: the surface point (published), or the view ray through the pixel (exact).
  constexpr bool has_place() const { return c_.positional + c_.spots > 0 || has_view(); }
  /// True if 1/w is interpolated. It scales the view ray to a point.
  constexpr bool has_distance() const { return c_exact && c_.positional + c_.spots > 0; }
  /// True if the ambient processor computes the unit vector to the eye.
  constexpr bool has_view() const { return c_exact && c_.specular && c_.lights() > 0; }
  /// Number of planes in a vector that draws.
  constexpr int planes() const { return c_axes * (has_place() ? 2 : 1) + (has_distance() ? 1 : 0); }

  // Lowest bits of the blocks of a host's vector. Both presets use the walk of preset exact.
  static constexpr int walk_low() { return Preset::c_request_header_bits; }
  static constexpr int plane_low(int plane) {
    return walk_low() + Exact::c_init_header_bits + plane * Preset::c_plane_header_bits;
  }
  constexpr int init_material_low() const { return plane_low(planes()); }
  // After the request, in the host's vector and in a token.
  static constexpr int light_axes_low() { return Preset::c_request_header_bits; }
  static constexpr int light_axis_low(int axis) {
    return light_axes_low() + Preset::c_light_axes_header_bits + axis * Preset::c_light_axes_channel_bits;
  }
  static constexpr int light_colour_low(int channel = 0) {
    return light_axis_low(c_axes) + channel * Preset::c_light_colour_channel_bits;
  }
  constexpr int init_bits() const {
    return std::max(light_colour_low(c_.channels), init_material_low() + material_bits());
  }

  // Positions within a material.
  static constexpr int exponent_low() { return 0; }
  constexpr int ambient_low(int channel) const {
    return (c_.specular ? Preset::c_exponent_bits : 0) + channel * Preset::c_coefficient_bits;
  }
  constexpr int diffuse_low(int channel) const { return ambient_low(c_.channels + channel); }
  constexpr int specular_low(int channel) const {
    return diffuse_low((c_.diffuse ? c_.channels : 0) + channel);
  }
  constexpr int material_bits() const { return specular_low(c_.specular ? c_.channels : 0); }

  // Lowest bits of the blocks of a token. Before the ambient processor N is a vector, after it a direction
  // (sign extended).
  static constexpr int normal_low(int axis) {
    return Preset::c_pixel_header_bits + axis * Preset::c_vector_bits;
  }
  static constexpr int place_low(int axis) { return normal_low(c_axes + axis); }
  constexpr int distance_low() const { return place_low(has_place() ? c_axes : 0); }
  constexpr int view_low(int axis) const {
    return distance_low() + (has_distance() ? Preset::c_vector_bits : 0) + axis * Preset::c_direction_bits;
  }
  constexpr int material_low() const { return view_low(has_view() ? c_axes : 0); }
  constexpr int radiance_low(int channel) const {
    return material_low() + material_bits() + channel * Preset::c_radiance_bits;
  }
  constexpr int token_bits() const {
    return std::max(light_colour_low(c_.channels), radiance_low(c_.channels));
  }

 private:
  ProcessorsConfig c_;
};

}  // namespace halfway::words
