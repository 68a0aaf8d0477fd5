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

/// Stages whose registers a probe shows. Of the processors shader: line, span, then one a processor.
enum class Stage { line, span, sample, product, first_processor = sample };
inline Stage processor_stage(int number) {
  return static_cast<Stage>(static_cast<int>(Stage::first_processor) + number);
}

/// A stage's registers when it took a line or drew a pixel, laid out as the RTL's `probe` port.
struct ProbeEvent {
  Stage stage;
  std::uint32_t triangle, y, x;  ///< x: the pixel; the line's first for Stage::line
  std::vector<std::uint32_t> words;
  std::size_t fragment;  ///< how many fragments were drawn before
};

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
  /// Appends the fragments of whole triangles' vectors.
  virtual void draw(std::span<const std::uint32_t> init_words, std::vector<Fragment>& fragments) = 0;
  /// The same fragments in a vector of the model, valid until the next call.
  std::span<const Fragment> draw(std::span<const std::uint32_t> init_words) {
    drawn_.clear();
    draw(init_words, drawn_);
    return drawn_;
  }
  /// The same, and the stages' registers.
  virtual void draw_probed(std::span<const std::uint32_t> init_words, std::vector<Fragment>& fragments,
                           std::vector<ProbeEvent>& events) = 0;
  /// A shadow counter of the processors shader has left its range, and the fragments are worth nothing.
  virtual bool fault() const = 0;
  virtual unsigned init_bits() const = 0;
  virtual unsigned probe_bits() const = 0;

 private:
  std::vector<Fragment> drawn_;
};

std::unique_ptr<GoldenModel> make_golden_model(const HardwareKey& key);

}  // namespace halfway
