// SPDX-License-Identifier: Apache-2.0
// Tables 4 and 5 of the processors paper: clocks of the folded shading processor, as measured in the RTL, and
// the number of shading processors needed for a frame rate.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "plan/hardware_key.hpp"
#include "shading/effects.hpp"
#include "words/processors_layout.hpp"

namespace halfway {

/// A row of the table: clocks from the acceptance of one token to the acceptance of the next while the output
/// is not stalled, measured in the RTL by tb/rtl/illumination/table4_tb.vhd. For an object that the light
/// reaches. In preset exact it takes fewer clocks if the highlight is below the horizon.
struct ProcessorClocks {
  const char* what;
  std::optional<words::Term> term;  ///< empty: no term to compute
  std::optional<LightKind> light;   ///< empty: ambient
  bool normalize, view;             ///< the ambient processor normalizes N; it computes the view vector
  std::optional<unsigned> paper;    ///< as printed
  unsigned exact;
  std::optional<unsigned> published;  ///< empty: this preset has no such operation

  std::optional<unsigned> clocks(Preset preset) const { return preset == Preset::exact ? exact : published; }
};

inline constexpr std::array<ProcessorClocks, 11> c_processor_clocks = {{
    {"load, shadow polygon, unlit", std::nullopt, std::nullopt, false, false, 2, 2, 2},
    {"ambient", words::Term::ambient, std::nullopt, false, false, 4, 5, 4},
    {"ambient, N normalized", words::Term::ambient, std::nullopt, true, false, 6, 15, 6},
    {"ambient, view vector", words::Term::ambient, std::nullopt, false, true, std::nullopt, 16, std::nullopt},
    {"ambient, N normalized, view vector", words::Term::ambient, std::nullopt, true, true, std::nullopt, 26,
     std::nullopt},
    {"directional diffuse", words::Term::diffuse, LightKind::directional, false, false, 6, 9, 6},
    {"directional specular", words::Term::specular, LightKind::directional, false, false, 7, 34, 7},
    {"positional diffuse", words::Term::diffuse, LightKind::positional, false, false, 12, 26, 12},
    {"positional specular", words::Term::specular, LightKind::positional, false, false, 13, 51, 13},
    {"spot diffuse", words::Term::diffuse, LightKind::spot, false, false, std::nullopt, 37, 22},
    {"spot specular", words::Term::specular, LightKind::spot, false, false, std::nullopt, 54, 28},
}};

/// The slowest operation in the pipeline of a processors shader's key. It determines the throughput.
const ProcessorClocks& slowest_processor(const HardwareKey& key);

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
  /// Per pixel, all terms one after another: the table's second row, whose label the scan lost. As printed,
  /// both terms of a light cost as much as the slower one.
  std::uint64_t single_ns;
  /// The same with the paper's rounding: the time per pixel is truncated to whole nanoseconds, for example
  /// 33.3 to 33. Empty if the result is zero.
  std::optional<std::uint64_t> published_due_ns, published_pipelines;
};

/// Positional lights are ignored for version one, which has none. `load`: see count_pipelines.
ProcessorCount count_processors(ProcessorVersion version, const ShadingLoad& load);

}  // namespace halfway
