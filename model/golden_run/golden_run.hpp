// SPDX-License-Identifier: Apache-2.0
// The golden model of whatever a hardware key names.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "frame/fragment.hpp"
#include "frame/tile.hpp"
#include "plan/hardware_key.hpp"

namespace halfway {

class GoldenModel {
 public:
  virtual ~GoldenModel() = default;
  /// How many vectors make a triangle, which begins with this one: itself, and its line records.
  virtual std::size_t group(std::span<const std::uint32_t> init_words) const = 0;
  /// Whether a triangle's vectors, which begin with this one, cover a pixel of the tile. They must be of a
  /// setup's units, not of its prologue.
  virtual bool touches(std::span<const std::uint32_t> init_words, const Tile& tile) const = 0;
  /// How many they cover.
  virtual std::uint64_t pixels(std::span<const std::uint32_t> init_words) const = 0;
  /// The same of any number of whole triangles.
  std::uint64_t all_pixels(std::span<const std::uint32_t> init_words) const;
  /// Appends the fragments of whole triangles' vectors.
  virtual void draw(std::span<const std::uint32_t> init_words, std::vector<Fragment>& fragments) = 0;
  /// The same fragments in a vector of the model, valid until the next call.
  std::span<const Fragment> draw(std::span<const std::uint32_t> init_words) {
    drawn_.clear();
    draw(init_words, drawn_);
    return drawn_;
  }
  /// The same of whole triangles that it takes off the front of `init_words`, until they have `count`
  /// fragments or none is left.
  std::span<const Fragment> draw_next(std::span<const std::uint32_t>& init_words, std::size_t count);
  /// A shadow counter of the processors shader has left its range, and the fragments are worth nothing.
  virtual bool fault() const = 0;
  virtual unsigned init_bits() const = 0;

 private:
  /// Takes a triangle's vectors off the front.
  std::span<const std::uint32_t> take_group(std::span<const std::uint32_t>& init_words) const;

  std::vector<Fragment> drawn_;
};

std::unique_ptr<GoldenModel> make_golden_model(const HardwareKey& key);

}  // namespace halfway
