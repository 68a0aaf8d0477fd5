// SPDX-License-Identifier: Apache-2.0
// The golden model of the hardware that a key names.
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
  /// Number of vectors from this one on that the hardware draws independently of those before, except for
  /// loads: a triangle, its header and its line records; object processors: a strip with its triangles.
  virtual std::size_t group(std::span<const std::uint32_t> init_words) const = 0;
  /// True if the vector changes the state of the hardware for all later triangles, such as a light.
  virtual bool is_load(std::span<const std::uint32_t> init_words) const = 0;
  /// True if the triangle that starts with this vector covers a pixel of the tile. The vectors must come from
  /// a unit of the setup, not from its prologue.
  virtual bool touches(std::span<const std::uint32_t> init_words, const Tile& tile) const = 0;
  /// Number of pixels that the triangle covers, or that a strip has.
  virtual std::uint64_t pixels(std::span<const std::uint32_t> init_words) const = 0;
  /// The same for any number of whole triangles.
  std::uint64_t all_pixels(std::span<const std::uint32_t> init_words) const;
  /// Appends the fragments of these vectors of whole triangles.
  virtual void draw(std::span<const std::uint32_t> init_words, std::vector<Fragment>& fragments) = 0;
  /// Returns the same fragments in a buffer of the model, valid until the next call.
  std::span<const Fragment> draw(std::span<const std::uint32_t> init_words) {
    drawn_.clear();
    draw(init_words, drawn_);
    return drawn_;
  }
  /// Draws triangles from the start of `init_words` and removes their vectors, until at least `count`
  /// fragments are drawn or no triangle is left.
  std::span<const Fragment> draw_next(std::span<const std::uint32_t>& init_words, std::size_t count);
  /// True if the hardware has refused a vector: the fragments are then invalid.
  virtual bool fault() const = 0;
  virtual unsigned init_bits() const = 0;

 private:
  /// Removes the first triangle's vectors and returns them.
  std::span<const std::uint32_t> take_group(std::span<const std::uint32_t>& init_words) const;

  std::vector<Fragment> drawn_;
};

std::unique_ptr<GoldenModel> make_golden_model(const HardwareKey& key);

/// The objects that object processors send to the shading processors for these vectors of whole strips. The
/// key must have object processors.
std::uint64_t count_objects(const HardwareKey& key, std::span<const std::uint32_t> init_words);

}  // namespace halfway
