// SPDX-License-Identifier: Apache-2.0
// A point of the design space: what draws, at which word lengths, and what it draws.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/result.hpp"
#include "frame/frame_size.hpp"
#include "frame/tile.hpp"
#include "plan/plan.hpp"
#include "setup/setup.hpp"
#include "tables/word_lengths.hpp"

namespace halfway::study {

/// In the order of their names below.
enum class Method {
  phong,      ///< per pixel, in software: the yardstick
  gouraud,    ///< in software
  quadratic,  ///< in hardware from here on; never split
  adaptive,   ///< quadratic; split where it errs by more than `threshold`
  spherical,
  processors_1,  ///< the paper's version I: no normalization, lights without a place alone
  processors_2,  ///< version II
};
inline constexpr std::array c_method_names = {"phong",     "gouraud",      "quadratic",   "adaptive",
                                              "spherical", "processors-1", "processors-2"};
inline const char* to_string(Method method) {
  return c_method_names[static_cast<std::size_t>(method)];
}
constexpr bool in_hardware(Method method) {
  return method >= Method::quadratic;
}
/// Other than the yardstick, which is its own picture.
constexpr bool is_drawn(Method method) {
  return method != Method::phong;
}

struct DesignPoint {
  Method method = Method::quadratic;
  Preset preset = Preset::exact;                 ///< of hardware
  std::optional<TableSize> tables;               ///< of spherical; none: the preset's
  tables::WordLengths words{};                   ///< of what the method has; none: the preset's
  ProcessorForm form = ProcessorForm::unrolled;  ///< of the processors
  double threshold = 2.0;                        ///< colour steps; of adaptive, and of spherical in exact
  double tessellation = 1.0;                     ///< of the scene's own meshes, as load_scene takes it
  std::optional<double> exponent;                ///< of every material; none: the scene's
  FrameSize size{320, 240};
  FrameSize tile{1280, 960};  ///< a larger frame is drawn in tiles of this size

  /// Such as `spherical exact 9x8, exponent 50, tessellation 0.5, 320x240`: equal names, equal points.
  std::string name() const;
  /// The same without what is drawn.
  std::string design() const;
  /// The scene and what is drawn of it, without what draws: points of equal pictures share their reference.
  std::string picture() const;
  bool in_tiles() const { return size.width > tile.width || size.height > tile.height; }
  /// One: the frame.
  std::vector<Tile> tiles() const { return tiles_of(size, tile); }
  bool has_threshold() const;
  PlanRequest plan() const;
  SetupOptions setup() const;
};

/// Without those that differ in nothing from one before; those of one picture together, as its reference is
/// made once.
std::vector<DesignPoint> ordered(std::vector<DesignPoint> points);

/// A tile's least side.
inline constexpr std::uint32_t c_least_tile = 16;

/// The sweeps of a space, each the product of its lists, without the points that differ in nothing. A space
/// is a TOML file, see sim/studies/README.md; errors name file and line.
Result<std::vector<DesignPoint>> read_space(const std::filesystem::path& path);

}  // namespace halfway::study
