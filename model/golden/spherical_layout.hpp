// SPDX-License-Identifier: Apache-2.0
// Twin of rtl/shaders/spherical_pkg.vhd: where a light's parts lie in a line record.
#pragma once

#include <algorithm>
#include <span>
#include <type_traits>

#include "golden/cosine_tables.hpp"
#include "golden/formats.hpp"

namespace halfway::golden {

/// The spherical shader's generics.
struct SphericalConfig {
  int channels = 3, lights = 1;
  bool diffuse = true, specular = true;
  int highlight_channels = 3;  ///< 1: every highlight is grey, one multiplier a light does for all channels
  unsigned powers = 2;         ///< bit i: the table of cosine to the power 2^i is there
  int address_bits = 0, data_bits = 0;
  std::span<const CosineTable> tables =
      c_cosine_tables;  ///< there is one of this size; they outlive a shader
};

template <class Preset>
class SphericalLayout {
 public:
  static constexpr bool c_exact = std::is_same_v<Preset, Exact>;

  explicit constexpr SphericalLayout(const SphericalConfig& config) : config_(config) {}

  /// The light's diffuse angle is needed: for its cosine, or as the horizon that ends the highlight.
  constexpr bool has_diffuse_part() const { return config_.diffuse || (config_.specular && c_exact); }
  /// Colours that a light's diffuse part has a factor for.
  constexpr int diffuse_channels() const { return config_.diffuse ? config_.channels : 0; }

  constexpr int diffuse_low(int light) const { return light * light_bits(); }
  constexpr int specular_low(int light) const { return diffuse_low(light) + diffuse_bits(); }
  /// 0: no line records follow a triangle's header.
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

}  // namespace halfway::golden
