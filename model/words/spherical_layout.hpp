// SPDX-License-Identifier: Apache-2.0
// Golden model of rtl/shaders/spherical_pkg.vhd: positions of a light's parts in a line record.
#pragma once

#include <algorithm>
#include <span>
#include <type_traits>

#include "words/cosine_tables.hpp"
#include "words/formats.hpp"

namespace halfway::words {

/// The spherical shader's generics.
struct SphericalConfig {
  int channels = 3, lights = 1;
  bool diffuse = true, specular = true;
  int highlight_channels = 3;  ///< 1: every highlight is grey; one multiplier per light serves all channels
  unsigned powers = 2;         ///< bit i: the table of cosine to the power 2^i exists
  CosineSize size;             ///< of the tables
  std::span<const CosineTable> tables =
      c_cosine_tables;  ///< must contain tables of this size and outlive the shader
};

template <class Preset>
class SphericalLayout {
 public:
  static constexpr bool c_exact = std::is_same_v<Preset, Exact>;

  explicit constexpr SphericalLayout(const SphericalConfig& config) : config_(config) {}

  /// True if the light's diffuse angle is needed: for its cosine, or for the horizon at which the highlight
  /// ends.
  constexpr bool has_diffuse_part() const { return config_.diffuse || (config_.specular && c_exact); }
  /// Number of colours with a diffuse factor.
  constexpr int diffuse_channels() const { return config_.diffuse ? config_.channels : 0; }

  constexpr int diffuse_low(int light) const { return light * light_bits(); }
  constexpr int specular_low(int light) const { return diffuse_low(light) + diffuse_bits(); }
  /// If 0, no line records follow a triangle's header.
  constexpr int record_bits() const { return config_.lights * light_bits(); }

  constexpr int ambient_low(int channel) const {
    return Preset::c_init_header_bits + channel * Preset::c_ambient_channel_bits;
  }
  constexpr int init_bits() const { return std::max(ambient_low(config_.channels), record_bits()); }

 private:
  constexpr int diffuse_bits() const {
    if (!has_diffuse_part()) return 0;
    return Preset::c_diffuse_header_bits + diffuse_channels() * Preset::c_diffuse_channel_bits;
  }
  constexpr int specular_bits() const {
    if (!config_.specular) return 0;
    return Preset::c_specular_header_bits + config_.highlight_channels * Preset::c_specular_channel_bits;
  }
  constexpr int light_bits() const { return diffuse_bits() + specular_bits(); }

  SphericalConfig config_;
};

}  // namespace halfway::words
