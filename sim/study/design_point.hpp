// SPDX-License-Identifier: Apache-2.0
// A point of the design space: method, word lengths and picture.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "frame/frame_size.hpp"
#include "frame/tile.hpp"
#include "plan/plan.hpp"
#include "setup/setup.hpp"
#include "words/generator/word_lengths.hpp"
#include "words/object_limits.hpp"

namespace halfway::study {

/// In the order of c_method_names.
enum class Method {
  phong,       ///< per pixel, in software: the reference method
  gouraud,     ///< in software
  phong_mesa,  ///< in software: per pixel by OpenGL on Mesa's llvmpipe
  planes,      ///< this and the following methods are hardware: Gouraud's shading, quadratic of degree 1
  quadratic,   ///< never split
  adaptive,    ///< quadratic; triangles with an error above `threshold`, by the test `test`, are split
  spherical,
  processors_1,  ///< the paper's version I: no normalization, only directional lights
  processors_2,  ///< the paper's version II
};
inline constexpr std::array c_method_names = {"phong",     "gouraud",      "phong-mesa",
                                              "planes",    "quadratic",    "adaptive",
                                              "spherical", "processors-1", "processors-2"};
inline const char* to_string(Method method) {
  return c_method_names[static_cast<std::size_t>(method)];
}
constexpr bool in_hardware(Method method) {
  return method >= Method::planes;
}
/// False for phong only: its picture is the reference itself.
constexpr bool is_drawn(Method method) {
  return method != Method::phong;
}

struct DesignPoint {
  Method method = Method::quadratic;
  Preset preset = Preset::exact;  ///< of hardware methods
  /// The knobs of draw_knobs(); plan() and setup() add what method and preset decide.
  PlanRequest hardware{};
  SetupOptions host{};
  bool own_tables = false;         ///< of spherical in preset exact; then hardware.tables has a value
  tables::WordLengths words{};     ///< of the method; std::nullopt: the preset's lengths
  double tessellation = 1.0;       ///< relative to the scene's own meshes, as for load_scene
  std::optional<double> exponent;  ///< of every material; std::nullopt: the scene's exponents
  FrameSize size{320, 240};
  FrameSize tile{1280, 960};  ///< a larger frame is drawn in tiles of this size

  /// Such as `spherical exact 9x8, exponent 50, tessellation 0.5, 320x240`. Points are equal if their names
  /// are equal.
  std::string name() const;
  /// The part of the name that describes method and word lengths.
  std::string design() const;
  /// The part of the name that describes scene and picture. Points with equal pictures share their reference.
  std::string picture() const;
  /// Such as name(), without what the host's work does not depend on: the form of the processors, and the
  /// size of cosine tables that are not the scene's own, which changes constants only (measured: 14 of a
  /// million instructions).
  std::string host_work() const;
  /// The picture and its reference are filtered.
  bool filtered() const { return words::has_filter(static_cast<int>(hardware.subpixels)); }
  bool in_tiles() const { return size.width > tile.width || size.height > tile.height; }
  /// The tiles of the frame; one tile if the frame is not larger than a tile.
  std::vector<Tile> tiles() const { return tiles_of(size, tile); }
  bool has_ends() const { return method == Method::spherical && preset == Preset::exact; }
  PlanRequest plan() const;
  SetupOptions setup() const;
};

class SpaceValue;  // of a space file, with its place

/// A parameter of a point: a key of spaces, a column of study.csv, a name in answers to queries.
struct Knob {
  const char* name;
  bool is_picture;  ///< changes scene or picture, not the design
  std::function<bool(const DesignPoint& point)> applies;
  /// Sets the parameter. Throws Failure with file and line if the value is not one of its values.
  std::function<void(const SpaceValue& value, DesignPoint& point)> read;
  /// Text of its value; empty: the default of the method.
  std::function<std::string(const DesignPoint& point)> text;
};
/// All parameters, in the order in which spaces multiply them.
std::span<const Knob> knobs();
/// The value of a parameter; empty if it does not apply to the point, or is the default.
std::string text_of(const Knob& knob, const DesignPoint& point);
std::string text_of(std::string_view knob, const DesignPoint& point);

/// Remove duplicates and put points of the same picture next to each other, because they share one reference.
std::vector<DesignPoint> ordered(std::vector<DesignPoint> points);

/// Smallest side of a tile.
inline constexpr std::uint32_t c_least_tile = 16;

/// Read the points of a space: all sweeps, each the product of its lists, without duplicates. A space is a
/// TOML file, see sim/study/spaces/README.md. Throws Failure with file and line.
std::vector<DesignPoint> read_space(const std::filesystem::path& path);

}  // namespace halfway::study
