// SPDX-License-Identifier: Apache-2.0
// Which pixels a triangle covers: exact by integers in preset exact, by a stepped real slope as published.
#include <fmt/format.h>

#include <map>

#include "golden/formats.hpp"
#include "setup/half_triangle.hpp"
#include "setup/init_vector.hpp"
#include "setup/random_triangles.hpp"
#include "stability/hard_case.hpp"
#include "stability/specification.hpp"
#include "stability/trial.hpp"

namespace halfway::stability {
namespace {

constexpr int c_unit_bits = 4;
constexpr HardwareKey c_exact{.shader = Shader::quadratic, .preset = Preset::exact, .channels = 1};

std::string name_of(const Points& p) {
  return fmt::format("({}, {}) ({}, {}) ({}, {}) in 1/16 pixel", p[0].x, p[0].y, p[1].x, p[1].y, p[2].x,
                     p[2].y);
}

// Pixels too many and too few.
void cover(Trial& trial, const std::vector<Points>& triangles, FrameSize frame) {
  const unsigned bits = golden::Exact::c_init_header_bits + golden::Exact::c_init_channel_bits;
  std::vector<std::uint32_t> words;
  for (std::size_t i = 0; i < triangles.size(); ++i)
    for (const Walk& walk : plan_walks(triangles[i], c_unit_bits, frame)) {
      InitVector init(words, bits);
      put_header(init, static_cast<std::uint32_t>(i), walk, {});
    }
  std::map<std::tuple<std::uint32_t, std::int64_t, std::int64_t>, int> drawn;
  for (const Fragment& f : trial.draw(c_exact, words)) ++drawn[{f.triangle, f.x, f.y}];
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    for_each_covered(triangles[i], c_unit_bits, frame, [&](std::int64_t x, std::int64_t y) {
      --drawn[{i, x, y}];
    });
  }
  std::map<std::uint32_t, int> wrong;
  for (const auto& [at, count] : drawn) wrong[std::get<0>(at)] += std::abs(count);
  for (std::uint32_t i = 0; i < triangles.size(); ++i)
    trial.ours(wrong[i], 0, [&] { return name_of(triangles[i]); });
}

template <TriangleKind kind>
void random_ones(Trial& trial) {
  RandomTriangles random(1);
  constexpr FrameSize c_frame{97, 61};
  std::vector<Points> triangles;
  for (int i = 0; i < trial.rounds(200, 20'000); ++i)
    triangles.push_back(random.next(kind, c_unit_bits, c_frame));
  cover(trial, triangles, c_frame);
}

constexpr HardCase c_cases[] = {
    {"Vertices on pixel centres", "quadratic, section 5: spans inclusive at both ends",
     "the top-left rule, by integers", "pixels drawn = pixels covered", "pixels", Published::silent,
     random_ones<TriangleKind::on_centres>},
};

}  // namespace

const Family c_edges{"edges", c_cases};

}  // namespace halfway::stability
