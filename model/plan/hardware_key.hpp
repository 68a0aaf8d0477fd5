// SPDX-License-Identifier: Apache-2.0
// The hardware key: what is elaborated. One key, one build of the RTL for each simulator.
#pragma once

#include <array>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "golden/processors_layout.hpp"
#include "golden/spherical_layout.hpp"
#include "tables/word_lengths.hpp"

namespace halfway {

enum class Shader { quadratic, spherical, processors };
inline constexpr std::array c_shaders = {Shader::quadratic, Shader::spherical, Shader::processors};
inline const char* to_string(Shader shader) {
  switch (shader) {
    case Shader::quadratic:
      return "quadratic";
    case Shader::spherical:
      return "spherical";
    case Shader::processors:
      break;
  }
  return "processors";
}

enum class Preset { exact, published };
inline const char* to_string(Preset preset) {
  return preset == Preset::exact ? "exact" : "published";
}

/// Address and data bits of the cosine tables.
struct TableSize {
  int address_bits = 0, data_bits = 0;
  friend bool operator==(TableSize, TableSize) = default;
};

/// What the spherical shader has for a scene's lights.
struct SphericalUnits {
  unsigned lights = 0;  ///< 0 to 16
  bool diffuse = false, specular = false;
  unsigned highlight_channels = 1;  ///< 1 where every highlight is white: one multiplier for all channels
  unsigned powers = 0;              ///< bit i: there is a table of cosine to the power 2^i for highlights
  TableSize tables;
  /// Empty: those that the program was built with. They must outlive the key and what draws by it.
  std::span<const golden::CosineTable> made_tables{};
  /// Whether lines have records: some light has an effect.
  bool records() const { return lights > 0 && (diffuse || specular); }
};

/// The two forms of a shading processor: the same fragments, at other costs.
enum class ProcessorForm {
  folded,    ///< as published: one datapath, several cycles a token
  unrolled,  ///< a token a clock
};
inline const char* to_string(ProcessorForm form) {
  return form == ProcessorForm::folded ? "folded" : "unrolled";
}

/// What the pipeline of shading processors has for a scene's lights.
struct ProcessorUnits {
  unsigned directional = 0, positional = 0, spots = 0;  ///< 16 in all at most
  bool diffuse = false, specular = false;               ///< false where there is no light
  bool normalize = false;                               ///< the ambient processor can normalize N
  bool shadows = false;                                 ///< object stage and shadow counters
  ProcessorForm form = ProcessorForm::unrolled;
  unsigned lights() const { return directional + positional + spots; }
};

struct HardwareKey {
  Shader shader = Shader::quadratic;
  Preset preset = Preset::exact;
  unsigned channels = 3;      ///< 1 where every colour of the scene is grey
  SphericalUnits spherical;   ///< of the spherical shader
  ProcessorUnits processors;  ///< of the shading processors
  /// Other word lengths than the preset's. Setup and golden model of such a key are compiled for it: the
  /// ones in this library have the preset's.
  tables::WordLengths words{};

  /// Top entity in rtl/shaders.
  std::string entity() const;
  /// Generics of the top entity, as `-g` takes them, in a fixed order.
  std::vector<std::pair<std::string, std::string>> generics() const;
  /// The width of the top's port init_data, as a VHDL expression of its generics.
  std::string vhdl_init_bits() const;
  /// Such as quadratic_shader-exact-c3; names the cached build.
  std::string name() const;
};

/// The spherical shader's generics for its golden twin.
golden::SphericalConfig golden_config(const HardwareKey& key);
/// The processors shader's.
golden::ProcessorsConfig processors_config(const HardwareKey& key);

}  // namespace halfway
