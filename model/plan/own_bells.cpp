// SPDX-License-Identifier: Apache-2.0
#include "plan/own_bells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <set>

#include "shading/effects.hpp"
#include "words/generator/cosine.hpp"

namespace halfway {
namespace {

double clamped(double exponent) {
  return std::min(exponent, c_largest_exponent);
}

}  // namespace

Result<std::vector<double>> own_exponents(const Scene& scene) {
  std::set<double> own;
  const std::vector<bool> used = used_materials(scene);
  for (std::size_t i = 0; i < used.size(); ++i)
    if (used[i] && has_specular(scene.materials[i])) own.insert(clamped(scene.materials[i].exponent));
  if (own.size() > tables::c_most_own_tables)
    return bad_input(fmt::format("{}: {} different exponents, and hardware has at most {} own tables",
                                 scene.name, own.size(), tables::c_most_own_tables));
  return std::vector<double>(own.begin(), own.end());
}

Bell own_bell(std::span<const double> own, double exponent) {
  const auto found = std::find(own.begin(), own.end(), clamped(exponent));
  if (found == own.end()) return {1, 1.0, 1.0};
  return {2 << (found - own.begin()), std::numbers::pi / 2 / tables::own_reach(*found), 1.0};
}

unsigned own_powers(std::span<const double> own) {
  return (2U << own.size()) - 2;
}

}  // namespace halfway
