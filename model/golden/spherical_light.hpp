// SPDX-License-Identifier: Apache-2.0
// Golden model of rtl/shaders/spherical_light.vhd: the terms of the current angles' pixel.
#pragma once

#include <cassert>
#include <cstddef>
#include <span>

#include "golden/colour_sum.hpp"
#include "golden/diffuse_slice.hpp"
#include "golden/specular_slice.hpp"
#include "golden/words.hpp"
#include "words/spherical_layout.hpp"

namespace halfway::golden {

template <class Preset>
class SphericalLight {
 public:
  explicit SphericalLight(const SphericalConfig& config) : config_(config), layout_(config) {
    assert(config.diffuse || config.specular);
    assert(config.highlight_channels == 1 || config.highlight_channels == config.channels);
    if (layout_.has_diffuse_part())
      diffuse_ = DiffuseSlice<Preset>(layout_.diffuse_channels(), config.size, config.tables);
    if (config.specular)
      specular_ = SpecularSlice<Preset>(config.highlight_channels, config.powers, config.size, config.tables);
  }

  /// `light`: number of the light in the line record.
  void span_load(std::span<const std::uint32_t> record, int light) {
    if (layout_.has_diffuse_part()) diffuse_.span_load(record, layout_.diffuse_low(light));
    if (config_.specular) specular_.span_load(record, layout_.specular_low(light));
  }
  void span_step() {
    if (layout_.has_diffuse_part()) diffuse_.span_step();
    if (config_.specular) specular_.span_step();
  }

  /// Adds the terms of the pixel: add(terms) for diffuse light, then for the highlight, if they exist.
  template <class Add>
  void add_terms(Add&& add) const {
    if (config_.diffuse) add(diffuse_terms());
    if (config_.specular) add(highlight_terms());
  }

  /// The slices. They must exist.
  const DiffuseSlice<Preset>& diffuse() const { return diffuse_; }
  const SpecularSlice<Preset>& specular() const { return specular_; }
  /// True if the light is above the pixel's horizon, or there is none.
  bool lit() const { return !layout_.has_diffuse_part() || diffuse_.lit(); }

 private:
  ColourTerms diffuse_terms() const {
    const std::uint32_t sample = diffuse_.gated_sample();
    return {diffuse_.product(0, sample), diffuse_.product(1, sample), diffuse_.product(2, sample)};
  }
  // A grey highlight is added to every channel.
  ColourTerms highlight_terms() const {
    const std::uint32_t sample = specular_.gated_sample(lit());
    const std::uint64_t first = specular_.product(0, sample);
    if (config_.highlight_channels == 1) return {first, first, first};
    return {first, specular_.product(1, sample), specular_.product(2, sample)};
  }

  SphericalConfig config_;
  SphericalLayout<Preset> layout_;
  DiffuseSlice<Preset> diffuse_;
  SpecularSlice<Preset> specular_;
};

}  // namespace halfway::golden
