// SPDX-License-Identifier: Apache-2.0
// The hardware key: the hardware to elaborate. Each key has one build of the RTL per simulator.
#pragma once

#include <array>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "words/generator/word_lengths.hpp"
#include "words/processors_layout.hpp"
#include "words/spherical_layout.hpp"

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

/// Units of the spherical shader.
struct SphericalUnits {
  unsigned lights = 0;  ///< 0 to 16
  bool diffuse = false, specular = false;
  unsigned highlight_channels = 1;  ///< 1 if all highlights are white: one multiplier for all channels
  unsigned powers = 0;              ///< bit i: a table of cosine to the power 2^i for highlights
  words::CosineSize tables;
  /// Empty: the tables built into the program. They must outlive the key and all objects that draw with it.
  std::span<const words::CosineTable> made_tables{};
  /// Exponents of the own tables, of which made_tables then consists; empty: none (plan/own_bells.hpp).
  std::vector<double> own{};
  /// True if lines have records, that is, if some light has an effect.
  bool records() const { return lights > 0 && (diffuse || specular); }
};

/// The two forms of a shading processor: the same fragments at different costs.
enum class ProcessorForm {
  folded,    ///< as published: one datapath, several cycles per token
  unrolled,  ///< one token per clock
};
inline const char* to_string(ProcessorForm form) {
  return form == ProcessorForm::folded ? "folded" : "unrolled";
}

/// Units of the pipeline of shading processors.
struct ProcessorUnits {
  unsigned directional = 0, positional = 0, spots = 0;  ///< at most 16 in total
  bool diffuse = false, specular = false;               ///< false without lights
  bool normalize = false;                               ///< the ambient processor can normalize N
  bool shadows = false;                                 ///< shadow counters; only with object processors
  ProcessorForm form = ProcessorForm::unrolled;
  unsigned objects = 0;    ///< object processors; 0: the rasterizer
  unsigned subpixels = 1;  ///< of a pixel, with object processors: 1, 4 or 16. Above 1 pixels are filtered
  unsigned lights() const { return directional + positional + spots; }
};

/// Entity in rtl/axi: a shader with AXI4-Stream ports.
inline constexpr const char* c_stream_top = "words_to_fragments";
/// Entity in rtl/core, which contains c_stream_top and has its generics: from commands to a picture in
/// memory.
inline constexpr const char* c_core_top = "halfway_core";

struct HardwareKey {
  Shader shader = Shader::quadratic;
  Preset preset = Preset::exact;
  unsigned channels = 3;      ///< 1 if every colour of the scene is grey
  int degree = 2;             ///< of the quadratic shader; 1: planes, as in Gouraud's shading
  SphericalUnits spherical;   ///< of the spherical shader
  ProcessorUnits processors;  ///< of the shading processors
  /// Word lengths that replace the preset's. Setup and golden model of such a key are compiled for it. Those
  /// in this library have the preset's word lengths.
  tables::WordLengths words{};

  /// Top entity in rtl/shaders.
  std::string entity() const;
  /// Generics of the top entity, in the form of the option `-g`, in a fixed order.
  std::vector<std::pair<std::string, std::string>> generics() const;
  /// Those of c_stream_top, which contains the top entity.
  std::vector<std::pair<std::string, std::string>> stream_generics() const;
  /// Those of c_core_top, with pixels of XRGB8888 or RGB565.
  std::vector<std::pair<std::string, std::string>> core_generics(bool true_colour, unsigned bus_bits) const;
  /// The width of the top's port init_data, as a VHDL expression of its generics.
  std::string vhdl_init_bits() const;
  /// For example quadratic_shader-exact-c3. Also the name of the cached build.
  std::string name() const;
};

/// The configuration of the spherical shader's golden model.
words::SphericalConfig golden_config(const HardwareKey& key);
/// The configuration of the processors shader's golden model.
words::ProcessorsConfig processors_config(const HardwareKey& key);

}  // namespace halfway
