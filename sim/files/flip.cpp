// SPDX-License-Identifier: Apache-2.0
#include "sim/files/flip.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>
#include <numbers>
#include <numeric>

#include "common/to_integer.hpp"
#include "frame/tile.hpp"

namespace halfway {
namespace {

using std::numbers::pi;

// ---- Colour spaces

// Columns: XYZ of linear red, green and blue of sRGB. Their sum is the white of D65.
const glm::dmat3 c_xyz_from_rgb{0.41238656, 0.21263682, 0.01933062, 0.35759149, 0.71518298,
                                0.11919716, 0.18045049, 0.07218020, 0.95037259};
const glm::dvec3 c_white = c_xyz_from_rgb * glm::dvec3(1.0);

double linear_from_srgb(double channel) {
  return channel <= 0.04045 ? channel / 12.92 : std::pow((channel + 0.055) / 1.055, 2.4);
}

glm::dvec3 linear_rgb(glm::dvec3 srgb_255) {
  return {linear_from_srgb(srgb_255.r / 255), linear_from_srgb(srgb_255.g / 255),
          linear_from_srgb(srgb_255.b / 255)};
}

// The linearized CIELAB of the paper's spatial filters: achromatic, red-green, blue-yellow.
glm::dvec3 opponent_from_rgb(glm::dvec3 rgb) {
  const glm::dvec3 xyz = c_xyz_from_rgb * rgb / c_white;
  return {116 * xyz.y - 16, 500 * (xyz.x - xyz.y), 200 * (xyz.y - xyz.z)};
}

glm::dvec3 rgb_from_opponent(glm::dvec3 opponent) {
  static const glm::dmat3 c_rgb_from_xyz = glm::inverse(c_xyz_from_rgb);
  const double y = (opponent[0] + 16) / 116;
  return c_rgb_from_xyz * (glm::dvec3(y + opponent[1] / 500, y, y - opponent[2] / 200) * c_white);
}

double lab_curve(double ratio) {
  constexpr double c_delta = 6.0 / 29.0;
  return ratio > c_delta * c_delta * c_delta ? std::cbrt(ratio)
                                             : ratio / (3 * c_delta * c_delta) + 4.0 / 29.0;
}

// CIELAB with the Hunt effect: chroma is less visible in the dark.
glm::dvec3 hunt_lab_from_rgb(glm::dvec3 rgb) {
  const glm::dvec3 xyz = c_xyz_from_rgb * rgb / c_white;
  const double fy = lab_curve(xyz.y), lightness = 116 * fy - 16;
  return {lightness, 0.01 * lightness * 500 * (lab_curve(xyz.x) - fy),
          0.01 * lightness * 200 * (fy - lab_curve(xyz.z))};
}

double hyab_distance(glm::dvec3 a, glm::dvec3 b) {
  return std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]);
}

// ---- Filters

// One line of samples, the same number on both sides of the centre.
using Kernel = std::vector<double>;

template <class Function>
Kernel sampled_kernel(int radius, const Function& f) {
  Kernel kernel;
  for (int x = -radius; x <= radius; ++x) kernel.push_back(f(static_cast<double>(x)));
  return kernel;
}

using Plane = std::vector<double>;

// Filter each line. Outside the picture its nearest pixel counts.
Plane filtered_across(const Plane& in, FrameSize size, const Kernel& kernel) {
  const std::size_t width = size.width, radius = kernel.size() / 2;
  Plane out(in.size()), line(width + 2 * radius);
  for (std::size_t start = 0; start < in.size(); start += width) {
    std::fill_n(line.begin(), radius, in[start]);
    std::copy_n(&in[start], width, &line[radius]);
    std::fill_n(&line[radius + width], radius, in[start + width - 1]);
    for (std::size_t tap = 0; tap < kernel.size(); ++tap)
      for (std::size_t x = 0; x < width; ++x) out[start + x] += kernel[tap] * line[x + tap];
  }
  return out;
}

// Filter each column.
Plane filtered_down(const Plane& in, FrameSize size, const Kernel& kernel) {
  const std::size_t width = size.width;
  const int height = static_cast<int>(size.height), radius = static_cast<int>(kernel.size() / 2);
  Plane out(in.size());
  for (int y = 0; y < height; ++y)
    for (std::size_t tap = 0; tap < kernel.size(); ++tap) {
      const int from_y = std::clamp(y + static_cast<int>(tap) - radius, 0, height - 1);
      const double* from = &in[static_cast<std::size_t>(from_y) * width];
      double* to = &out[static_cast<std::size_t>(y) * width];
      for (std::size_t x = 0; x < width; ++x) to[x] += kernel[tap] * from[x];
    }
  return out;
}

Plane filtered(const Plane& in, FrameSize size, const Kernel& across, const Kernel& down) {
  return filtered_down(filtered_across(in, size, across), size, down);
}

// A contrast sensitivity function: a sum of Gaussians (a, b) in cycles per degree, table 1 of the paper.
struct Gaussian {
  double a, b;
};
using Sensitivity = std::vector<Gaussian>;
const std::array<Sensitivity, 3> c_sensitivities = {
    {{{1.0, 0.0047}}, {{1.0, 0.0053}}, {{34.1, 0.04}, {13.5, 0.025}}}};

// Filter by the transform of the sensitivity, with a sum of 1.
Plane seen_plane(const Plane& in, FrameSize size, const Sensitivity& sensitivity) {
  const int radius = to_integer<int>(std::ceil(3 * std::sqrt(0.04 / (2 * pi * pi)) * c_pixels_per_degree));
  Plane out(in.size());
  double whole = 0;
  for (const auto& [a, b] : sensitivity) {
    const Kernel kernel = sampled_kernel(radius, [b = b](double x) {
      const double degrees = x / c_pixels_per_degree;
      return std::exp(-pi * pi * degrees * degrees / b);
    });
    const double weight = a * std::sqrt(pi / b), sum = std::accumulate(kernel.begin(), kernel.end(), 0.0);
    whole += weight * sum * sum;
    const Plane part = filtered(in, size, kernel, kernel);
    for (std::size_t i = 0; i < out.size(); ++i) out[i] += weight * part[i];
  }
  for (double& value : out) value /= whole;
  return out;
}

// Kernels of the feature detectors: a Gaussian, its first and its second derivative. The Gaussian's sum is 1;
// the positive values of a derivative have the sum 1, the negative -1.
struct FeatureKernels {
  Kernel smooth, edge, point;
};

Kernel balanced(Kernel kernel) {
  double positive = 0, negative = 0;
  for (const double tap : kernel) (tap > 0 ? positive : negative) += tap;
  for (double& tap : kernel) tap /= tap > 0 ? positive : -negative;
  return kernel;
}

FeatureKernels feature_kernels() {
  constexpr double c_width = 0.082;  // of an edge, in degrees
  const double deviation = 0.5 * c_width * c_pixels_per_degree, variance = deviation * deviation;
  const int radius = to_integer<int>(std::ceil(3 * deviation));
  const auto gaussian = [variance](double x) { return std::exp(-x * x / (2 * variance)); };
  FeatureKernels kernels{
      sampled_kernel(radius, gaussian),
      balanced(sampled_kernel(radius, [&](double x) { return -x * gaussian(x); })),
      balanced(sampled_kernel(radius, [&](double x) { return (x * x / variance - 1) * gaussian(x); }))};
  const double sum = std::accumulate(kernels.smooth.begin(), kernels.smooth.end(), 0.0);
  for (double& tap : kernels.smooth) tap /= sum;
  return kernels;
}

// The magnitude of one derivative.
Plane feature(const Plane& achromatic, FrameSize size, const Kernel& derivative, const Kernel& smooth) {
  const Plane dx = filtered(achromatic, size, derivative, smooth),
              dy = filtered(achromatic, size, smooth, derivative);
  Plane magnitude(dx.size());
  for (std::size_t i = 0; i < dx.size(); ++i) magnitude[i] = std::hypot(dx[i], dy[i]);
  return magnitude;
}

// ---- The two parts of the error

constexpr std::uint32_t c_band = 128;  // lines
constexpr std::uint32_t c_reach = 10;  // lines that a filter reads above and below a pixel

struct Parts {
  std::vector<glm::dvec3> colours;  // filtered, in CIELAB with the Hunt effect
  Plane edges, points;
};

Parts parts_of(const Frame& frame) {
  const std::size_t count = frame.pixels();
  std::array<Plane, 3> opponent;
  for (Plane& plane : opponent) plane.resize(count);
  Plane achromatic(count);
  for (std::size_t i = 0; i < count; ++i) {
    const glm::dvec3 colour =
        opponent_from_rgb(linear_rgb({frame.rgb[3 * i], frame.rgb[3 * i + 1], frame.rgb[3 * i + 2]}));
    for (int k = 0; k < 3; ++k) opponent[static_cast<std::size_t>(k)][i] = colour[k];
    achromatic[i] = (colour[0] + 16) / 116;
  }
  for (std::size_t k = 0; k < 3; ++k) opponent[k] = seen_plane(opponent[k], frame.size, c_sensitivities[k]);
  Parts parts;
  parts.colours.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const glm::dvec3 rgb = rgb_from_opponent({opponent[0][i], opponent[1][i], opponent[2][i]});
    parts.colours.push_back(hunt_lab_from_rgb(glm::clamp(rgb, 0.0, 1.0)));
  }
  const FeatureKernels kernels = feature_kernels();
  parts.edges = feature(achromatic, frame.size, kernels.edge, kernels.smooth);
  parts.points = feature(achromatic, frame.size, kernels.point, kernels.smooth);
  return parts;
}

}  // namespace

double flip_error_of_distance(double distance) {
  constexpr double c_power = 0.7, c_knee = 0.4, c_knee_error = 0.95;
  static const double c_most =
      std::pow(hyab_distance(hunt_lab_from_rgb({0, 1, 0}), hunt_lab_from_rgb({0, 0, 1})), c_power);
  const double raised = std::pow(distance, c_power), knee = c_knee * c_most;
  if (raised < knee) return raised * c_knee_error / knee;
  return c_knee_error + (raised - knee) / (c_most - knee) * (1 - c_knee_error);
}

double flat_flip_error(const double (&reference)[3], const double (&test)[3]) {
  const auto colour = [](const double(&c)[3]) { return hunt_lab_from_rgb(linear_rgb({c[0], c[1], c[2]})); };
  return flip_error_of_distance(hyab_distance(colour(reference), colour(test)));
}

Result<std::vector<double>> flip_errors(const Frame& reference, const Frame& test) {
  if (reference.size.width != test.size.width || reference.size.height != test.size.height)
    return bad_input("the frames have different sizes");
  std::vector<double> errors(reference.pixels());
  const std::uint32_t height = reference.size.height, width = reference.size.width;
  // Compute the picture in bands, so that memory does not grow with it. A band has the lines around it that
  // the filters reach.
  for (std::uint32_t first = 0; first < height; first += c_band) {
    const std::uint32_t last = std::min(height, first + c_band);
    const std::uint32_t top = first - std::min(first, c_reach), bottom = std::min(height, last + c_reach);
    const Tile band{0, top, {width, bottom - top}};
    const Parts a = parts_of(cut_tile(reference, band)), b = parts_of(cut_tile(test, band));
    for (std::size_t i = std::size_t{first - top} * width; i < std::size_t{last - top} * width; ++i) {
      const double colour = flip_error_of_distance(hyab_distance(a.colours[i], b.colours[i]));
      const double change = std::max(std::abs(a.edges[i] - b.edges[i]), std::abs(a.points[i] - b.points[i]));
      const double features = std::min(1.0, std::sqrt(change / std::numbers::sqrt2));
      errors[std::size_t{top} * width + i] = std::pow(colour, 1 - features);
    }
  }
  return errors;
}

Result<std::uint64_t> perceived_pixels(const Frame& a, const Frame& b) {
  const auto errors = flip_errors(a, b);
  if (!errors) return errors.error();
  const double threshold = flip_error_of_distance(1.0);
  return static_cast<std::uint64_t>(
      std::ranges::count_if(*errors, [threshold](double error) { return error > threshold; }));
}

}  // namespace halfway
