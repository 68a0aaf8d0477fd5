// SPDX-License-Identifier: Apache-2.0
// Table 5 of the processors paper: how many shading processors keep up with a frame.
#pragma once

#include <cstdint>
#include <optional>

namespace halfway {

/// Without normalization and positional lights, or with both.
enum class ProcessorVersion { one, two };

/// What there is to draw.
struct ShadingLoad {
  std::uint64_t pixels = 0;       ///< M, of a frame
  std::uint64_t frames = 30;      ///< a second
  std::uint64_t objects = 1;      ///< O, of a pixel
  std::uint64_t directional = 0;  ///< R
  std::uint64_t positional = 0;   ///< P, spot lights among them
};

inline constexpr std::uint64_t c_processor_cycle_ns = 50;

/// Clocks of a pixel and object in the slowest processor of a pipeline: the specular one's (table 4).
constexpr std::uint64_t pipeline_clocks(ProcessorVersion version) {
  return version == ProcessorVersion::one ? 7 : 13;
}

/// Clocks in one processor that does all. As printed, both terms of a light cost what the slower one does.
constexpr std::uint64_t single_clocks(ProcessorVersion version, std::uint64_t directional,
                                      std::uint64_t positional) {
  return version == ProcessorVersion::one ? 14 * directional + 4 : 14 * directional + 26 * positional + 6;
}

/// Pipelines side by side that keep up.
struct PipelineCount {
  std::uint64_t pipeline_ns;   ///< of a pixel in a pipeline
  double pipelines_needed;     ///< not whole
  std::uint64_t per_pipeline;  ///< processors
  std::uint64_t pipelines;     ///< whole ones

  std::uint64_t processors() const { return pipelines * per_pipeline; }
};

/// Of pipelines of so many processors, which take an object each `clocks`. All of `load` but the lights is at
/// least 1, and the busy nanoseconds of a second fit into 64 bits.
PipelineCount count_pipelines(std::uint64_t clocks, std::uint64_t per_pipeline, const ShadingLoad& load);

/// As the paper's formulas have it.
struct ProcessorCount : PipelineCount {
  std::uint64_t single_ns;  ///< of a pixel in one processor that does all
  /// The same as the paper counts, for whom a pixel is due in whole nanoseconds, the rest dropped: 33
  /// of 33.3. None where less than one is left.
  std::optional<std::uint64_t> published_due_ns, published_pipelines;
};

/// Version one has no positional lights: they are left out. `load` as for count_pipelines.
ProcessorCount count_processors(ProcessorVersion version, const ShadingLoad& load);

}  // namespace halfway
