// SPDX-License-Identifier: Apache-2.0
// FLIP, the visible difference between two pictures (Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström
// and Fairchild, *FLIP: A Difference Evaluator for Alternating Images*, 2020), for pictures of 8 bits.
#pragma once

#include <cstdint>
#include <vector>

#include "common/result.hpp"
#include "frame/frame.hpp"

namespace halfway {

/// Pixels per degree of view: the paper's display, 0.7 m wide with 3840 pixels, seen from 0.7 m.
inline constexpr double c_pixels_per_degree = 67.020643276582255;

/// The error of each pixel, from 0 (equal) to 1. Channels are sRGB. The frames must have the same size.
Result<std::vector<double>> flip_errors(const Frame& reference, const Frame& test);

/// The error of two flat pictures of sRGB colours (0 to 255), in closed form: the filters do not change a
/// constant, and a constant has no features.
double flat_flip_error(const double (&reference)[3], const double (&test)[3]);

/// The error of two flat pictures whose distance in CIELAB is `distance` (section 4.1.4 of the paper).
double flip_error_of_distance(double distance);

/// Number of pixels with a visible difference: their error is above 0.0575, that of flat patches one unit of
/// CIELAB's lightness apart, two to three steps of 1/255 of a grey. The frames must have the same size.
Result<std::uint64_t> perceived_pixels(const Frame& a, const Frame& b);

}  // namespace halfway
