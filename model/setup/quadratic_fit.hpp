// SPDX-License-Identifier: Apache-2.0
// The quadratic through six samples of a triangle, and the plane through three depths, as exact rationals.
// The start words of the forward differences are derived from them; each is rounded once.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "setup/edge.hpp"
#include "setup/exact_division.hpp"

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

/// I(u, v) = I1 + (t2 u + t1 v)/D + (t5 u^2 + t4 uv + t3 v^2)/D^2, (u, v) relative to vertex 1 in
/// 1/2^unit_bits pixels (quadratic paper, equation 4; the paper's T are these values divided by D or D^2).
/// D^2 is the only divisor.
class QuadraticFit {
 public:
  /// D is twice the area and must not be zero. Points are within 2^13 pixels at unit_bits 4. Each level of
  /// subdivision doubles the units and halves the triangle. Samples are below 2^39 in magnitude. No sum here
  /// then exceeds 2^118.
  QuadraticFit(std::array<ScreenPoint, 3> points, int unit_bits);

  /// The words for the samples of one channel. `half` is added to the value: 0.5 in the unit of the samples,
  /// for rounding.
  QuadraticWords words(const SixSamples& samples, const DifferenceStart& start, std::int64_t half) const;

 private:
  std::array<ScreenPoint, 3> points_;
  int unit_bits_;
  std::int64_t x2_, y2_, x3_, y3_;
  Int128 d_;
  ExactDivider divider_;
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

/// The plane z(u, v) through three depths at three points, or through a channel's three samples.
class DepthFit {
 public:
  DepthFit(std::array<ScreenPoint, 3> points, int unit_bits, std::array<std::int64_t, 3> depths);
  DepthWords words(const DifferenceStart& start, std::int64_t half) const;

 private:
  ScreenPoint origin_;
  int unit_bits_;
  std::int64_t depth_;
  Int128 d_, zu_, zv_;
  ExactDivider divider_;
};

}  // namespace halfway
