// SPDX-License-Identifier: Apache-2.0
// Table 5 of the processors paper: the number of shading processors needed for a frame rate.
#pragma once

#include <cstdint>
#include <optional>

namespace halfway {

/// One: without normalization and positional lights. Two: with both.
enum class ProcessorVersion { one, two };

/// The load of a scene.
struct ShadingLoad {
  std::uint64_t pixels = 0;       ///< M, per frame
  std::uint64_t frames = 30;      ///< per second
  std::uint64_t objects = 1;      ///< O, per pixel
  std::uint64_t directional = 0;  ///< R
  std::uint64_t positional = 0;   ///< P, including spot lights
};

inline constexpr std::uint64_t c_processor_cycle_ns = 50;

/// Clocks per pixel and object in the slowest processor of a pipeline, the specular one (table 4).
constexpr std::uint64_t pipeline_clocks(ProcessorVersion version) {
  return version == ProcessorVersion::one ? 7 : 13;
}

/// Clocks of all terms, one after another: the table's second row, whose label the scan lost. As printed,
/// both terms of a light cost as much as the slower one.
constexpr std::uint64_t single_clocks(ProcessorVersion version, std::uint64_t directional,
                                      std::uint64_t positional) {
  return version == ProcessorVersion::one ? 14 * directional + 4 : 14 * directional + 26 * positional + 6;
}

/// The number of parallel pipelines for a load.
struct PipelineCount {
  std::uint64_t pipeline_ns;   ///< per pixel, in a pipeline
  double pipelines_needed;     ///< not rounded
  std::uint64_t per_pipeline;  ///< processors
  std::uint64_t pipelines;     ///< rounded up

  std::uint64_t processors() const { return pipelines * per_pipeline; }
};

/// For pipelines of `per_pipeline` processors that accept one object per `clocks`. All fields of `load`
/// except the lights must be at least 1, and the busy nanoseconds of a second must fit into 64 bits.
PipelineCount count_pipelines(std::uint64_t clocks, std::uint64_t per_pipeline, const ShadingLoad& load);

/// As defined by the paper's formulas.
struct ProcessorCount : PipelineCount {
  std::uint64_t single_ns;  ///< per pixel, all terms one after another
  /// The same with the paper's rounding: the time per pixel is truncated to whole nanoseconds, for example
  /// 33.3 to 33. Empty if the result is zero.
  std::optional<std::uint64_t> published_due_ns, published_pipelines;
};

/// Positional lights are ignored for version one, which has none. `load`: see count_pipelines.
ProcessorCount count_processors(ProcessorVersion version, const ShadingLoad& load);

}  // namespace halfway
