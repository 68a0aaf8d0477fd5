// SPDX-License-Identifier: Apache-2.0
// The way of one pixel through the stages of the hardware, golden model next to RTL, and the first difference
// between them. PixelSearch chooses the triangles; PixelWay draws them in the golden model and compares the
// events of a simulation with it.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "golden_run/golden_run.hpp"
#include "plan/hardware_key.hpp"
#include "sim/driver/shader_stages.hpp"
#include "sim/driver/vectors_around.hpp"
#include "words/formats.hpp"

namespace halfway {

/// A field of a flat vector that golden model and RTL get, with the position of its block.
struct PlacedField {
  std::string name;
  words::Field field;
  int block_low;
};

struct GivenFields {
  std::vector<PlacedField> init;    ///< of a triangle's first vector
  std::vector<PlacedField> record;  ///< of a line's record; empty without line records
};

struct FramePixel {
  std::uint32_t x, y;
};

/// A register or port in golden model and RTL.
struct StageValue {
  std::string name;
  std::uint64_t golden = 0;
  std::optional<std::uint64_t> rtl;  ///< std::nullopt if a bit is neither 0 nor 1
  WordFormat format{};
};

/// A word of this value in hexadecimal, and the number that it represents: "0c80 = 0.781250".
std::string text_of(std::uint64_t word, const StageValue& value);

/// The values of a stage for the pixel.
struct StageState {
  std::string stage;                   ///< "line", "span", spherical: "sample", "product"; "fragment"
  std::optional<std::uint64_t> cycle;  ///< of the simulation; std::nullopt if the RTL has no such event
  std::vector<StageValue> values;
};

/// One triangle's fragment at the pixel.
struct PixelStory {
  std::uint64_t vector;  ///< number of the init vector in the stream
  std::uint32_t triangle;
  std::vector<StageValue> init;    ///< golden == rtl: both have the same input
  std::vector<StageValue> record;  ///< of the pixel's line; empty without line records
  std::vector<StageState> stages;
};

/// The first difference between RTL and golden model in the simulation.
struct FirstDifference {
  std::string stage, entity, value;
  std::uint64_t cycle;
  std::uint32_t triangle, y, x;
  std::string golden, rtl;

  /// "line stage (edge_walker, or triangle_walker around it), cycle 7: triangle 3, line 10, pixel 7:
  /// line_start: golden 000a (10), RTL 000b (11)"
  std::string text() const;
};

/// Chooses the triangles of a frame that cover a pixel, and the one with a given fragment.
class PixelSearch {
 public:
  /// `fragment`: number in the golden model's frame; UINT64_MAX: none.
  PixelSearch(const HardwareKey& key, FramePixel pixel, std::uint64_t fragment);

  /// Adds the next vectors of the frame: whole triangles.
  void add(std::span<const std::uint32_t> init_words);
  const VectorsAround& found() const { return kept_; }

 private:
  std::unique_ptr<GoldenModel> golden_;
  VectorsAround kept_;
  FramePixel pixel_;
  std::uint64_t fragment_, drawn_ = 0;
};

class PixelWay {
 public:
  PixelWay(const HardwareKey& key, FramePixel pixel);

  /// Draws the triangles in the golden model.
  void draw_golden(const VectorsAround& triangles);
  /// Number of fragments of the golden model.
  std::uint64_t fragments() const { return expected_.back().size(); }
  const ShaderStages& stages() const { return *stages_; }
  /// Compares the events of a simulation of the same triangles.
  void compare(const std::vector<std::vector<RtlEvent>>& events);

  /// In drawing order; empty if no triangle covers the pixel.
  const std::vector<PixelStory>& stories() const { return stories_; }
  const std::optional<FirstDifference>& first() const { return first_; }

 private:
  // An event of the golden model, and the number of the story of its pixel.
  struct Expected {
    GoldenEvent event;
    std::optional<std::size_t> story;
  };

  void draw_golden(const VectorsAround::Triangle& triangle);
  PixelStory begin_story(const VectorsAround::Triangle& triangle, const GoldenEvent& fragment) const;
  void show_golden(const GoldenEvent& event, StageState& state) const;
  void check(std::size_t stage, const std::vector<RtlEvent>& rtl);
  void compare(const Expected& golden, const RtlEvent& rtl);
  void differ(FirstDifference difference);

  FramePixel pixel_;
  std::unique_ptr<ShaderStages> stages_;
  std::size_t vector_words_;
  GivenFields given_;
  std::vector<std::vector<Expected>> expected_;  // by stage
  std::vector<PixelStory> stories_;
  std::optional<FirstDifference> first_;
};

}  // namespace halfway
