// SPDX-License-Identifier: Apache-2.0
// Own tables: the spherical shader in preset exact with a table of cos^n itself for each exponent n of the
// scene, instead of bells that are fitted to cos^n.
#pragma once

#include <span>
#include <vector>

#include "common/result.hpp"
#include "scene/scene.hpp"
#include "shading/bell.hpp"

namespace halfway {

/// Larger exponents are clamped to this value, because the bell's angle would exceed its format.
inline constexpr double c_largest_exponent = 1e6;

/// The different exponents of the scene's visible highlights, ascending: those of its own tables. Error if
/// there are more than tables::c_most_own_tables.
Result<std::vector<double>> own_exponents(const Scene& scene);

/// The bell of an exponent with an own table: scale is that of the table's end, gain is 1, and power is the
/// one in whose place the table stands. Exponents without a table, which no visible highlight has, get a
/// cosine.
Bell own_bell(std::span<const double> own, double exponent);

/// The mask SphericalUnits::powers of all own tables.
unsigned own_powers(std::span<const double> own);

}  // namespace halfway
