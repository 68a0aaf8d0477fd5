// SPDX-License-Identifier: Apache-2.0
// The error of the spherical shader's highlight in preset exact, split by cause.
#pragma once

#include "plan/hardware_key.hpp"

namespace halfway::study {

/// Largest difference between a highlight of full range and 255 cos^n, in colour steps, for an exponent n.
/// Cutting by `threshold` is not included.
struct HighlightError {
  double exponent = 0;
  double fit = 0;    ///< between bell and cos^n; 0 with own tables
  double table = 0;  ///< of an entry over its cell
  double angle = 0;  ///< drift of the angle over 4096 pixels; with own tables its rounding is centred
  double factor = 0x1p-9, colour = 0.5;  ///< their rounding
  double total() const { return fit + table + angle + factor + colour; }
};

/// That of one exponent from 2 to 1000.
HighlightError highlight_error(double exponent, TableSize size, bool own_tables, int angle_fraction_bits);

/// The largest over exponents from 2 to 1000, found on a grid (steps of 0.1 % below 3, then of 3 %).
HighlightError worst_highlight_error(TableSize size, bool own_tables, int angle_fraction_bits);

}  // namespace halfway::study
