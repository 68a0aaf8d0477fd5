// SPDX-License-Identifier: Apache-2.0
// The quadratic through six samples of a triangle, and the plane through three depths, as exact rationals.
// The start words of the forward differences are derived from them; each is rounded once.
#pragma once

#include <array>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <utility>
#include <vector>

#include "common/exact_division.hpp"
#include "projection/edge.hpp"

namespace halfway {

/// Samples of one channel in units of 2^-28 colour steps, or in the caller's unit: at the three vertices, and
/// at the midpoints of the edges 1-2, 1-3, 2-3.
struct SixSamples {
  std::array<std::int64_t, 3> vertex;
  std::int64_t edge12, edge13, edge23;
};

/// Start of the forward differences, and the step along the edge: pixel (x, y), e0 = (quotient, 1).
struct DifferenceStart {
  std::int64_t x, y, quotient;
  bool backward;
};

/// Words of an init vector's channel block, before wrapping; see
/// rtl/interpolation/quadratic_interpolator.vhd.
struct QuadraticWords {
  Int128 value, dx, de0, de1, dxx, dxe0, dxe1, de0e0, de0e1, de1e1;
};

/// Barycentric coordinates times D, twice the triangle's area: of a point, or their change along a step.
using Barycentric = std::array<std::int64_t, 3>;

/// Where the forward differences of a walk start, and their two steps, in a triangle's coordinates.
struct BarycentricStart {
  Barycentric at, right, e0;
  bool backward;
};

/// The triangle's own coordinates. Points are within 2^13 pixels at unit_bits 4. Each level of subdivision
/// doubles the units and halves the triangle. No coordinate exceeds 2^37 in magnitude.
class TriangleCoordinates {
 public:
  TriangleCoordinates(const std::array<ScreenPoint, 3>& points, int unit_bits);
  BarycentricStart start(const DifferenceStart& start) const;
  std::int64_t twice_area() const { return x2_ * y3_ - y2_ * x3_; }

 private:
  /// (u, v) is relative to vertex 1. The coordinates of a point and of a step differ in vertex 1 alone.
  Barycentric step(std::int64_t u, std::int64_t v) const;

  ScreenPoint origin_;
  int unit_bits_;
  std::int64_t x2_, y2_, x3_, y3_;
};

/// The words of any channel at one start: weighted sums of its samples.
class QuadraticStart {
 public:
  QuadraticStart(const BarycentricStart& start, std::int64_t d);

  /// `half` is added to the value: 0.5 in the unit of the samples, for rounding. Samples are below 2^39 in
  /// magnitude. No sum here then exceeds 2^118.
  QuadraticWords words(const SixSamples& samples, std::int64_t half) const;

  /// Weights times D^2 of all samples but the first. The first has the rest: all weights of a value sum up to
  /// D^2, those of a difference to 0.
  using Weights = std::array<Int128, 5>;

 private:
  template <class Integer>
  QuadraticWords words_by(const SixSamples& samples, std::int64_t half) const;

  Weights value_, x_, e0_, xx_, xe0_, e0e0_;
  bool narrow_;  ///< the weights fit 64 bits
  bool backward_;
  ExactDivider divider_;
};

/// The quadratic through six samples of a triangle (quadratic paper, equation 4). With barycentric
/// coordinates l, the weight of the sample at vertex i is l_i (2 l_i - 1), at the midpoint of edge i-j it is
/// 4 l_i l_j. D^2 is the only divisor of the words.
class QuadraticFit {
 public:
  /// D must not be zero.
  QuadraticFit(const std::array<ScreenPoint, 3>& points, int unit_bits) : coordinates_(points, unit_bits) {}

  QuadraticStart at(const DifferenceStart& start) const {
    return QuadraticStart(coordinates_.start(start), coordinates_.twice_area());
  }

 private:
  TriangleCoordinates coordinates_;
};

/// The plane through the colours at the pixels of a small triangle. It is exact: on the grid of pixels its
/// differences are differences of colours, so no word is rounded, and the words of a quadratic that a plane
/// does not need are 0.
class PixelFit {
 public:
  /// At least one and at most three pixels of a block of 2x2, line by line, each line from left to right:
  /// what a triangle of at most 2 pixels in width and height covers (`covered_pixels`).
  explicit PixelFit(std::vector<Pixel> pixels) : pixels_(std::move(pixels)) {}

  /// The words for the colours of one channel at these pixels, in their order, in the unit of the words. A
  /// colour is off by its rounding to this unit only. `half` as in QuadraticFit.
  QuadraticWords words(std::span<const std::int64_t> colours, const DifferenceStart& start,
                       std::int64_t half) const;

 private:
  std::vector<Pixel> pixels_;
};

struct DepthWords {
  Int128 value, dx, de0, de1;
};

/// Planes through three values at three points, such as the depths or the samples of a channel.
class PlaneFit {
 public:
  /// Twice the triangle's area must not be zero.
  PlaneFit(const std::array<ScreenPoint, 3>& points, int unit_bits)
      : coordinates_(points, unit_bits), divider_(std::abs(coordinates_.twice_area())) {}

  BarycentricStart at(const DifferenceStart& start) const { return coordinates_.start(start); }
  /// Values are below 2^53 in magnitude. `half` is added to the value, for rounding.
  DepthWords words(const std::array<std::int64_t, 3>& values, const BarycentricStart& start,
                   std::int64_t half) const;

 private:
  TriangleCoordinates coordinates_;
  ExactDivider divider_;
};

/// The plane through three depths.
class DepthFit {
 public:
  DepthFit(const std::array<ScreenPoint, 3>& points, int unit_bits, const std::array<std::int64_t, 3>& depths)
      : plane_(points, unit_bits), depths_(depths) {}
  DepthWords words(const DifferenceStart& start, std::int64_t half) const {
    return plane_.words(depths_, plane_.at(start), half);
  }

 private:
  PlaneFit plane_;
  std::array<std::int64_t, 3> depths_;
};

}  // namespace halfway
