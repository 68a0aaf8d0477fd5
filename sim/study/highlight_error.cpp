// SPDX-License-Identifier: Apache-2.0
#include "sim/study/highlight_error.hpp"

#include <cmath>
#include <numbers>

#include "common/cosine_power.hpp"
#include "shading/bell.hpp"
#include "tables/cosine.hpp"

namespace halfway::study {
namespace {

constexpr double c_steps = 255.0;

struct TableError {
  double table, slope;  ///< largest error; greatest slope, per half bell
};

TableError power_error(int power, TableSize size) {
  return {tables::table_error(tables::cosine_table(true, power, size.address_bits, size.data_bits)),
          std::numbers::pi / 2 * steepest_slope(power)};
}

TableError own_error(double exponent, TableSize size) {
  return {tables::table_error(tables::own_table(exponent, 2, size.address_bits, size.data_bits)),
          tables::own_reach(exponent) * steepest_slope(exponent)};
}

}  // namespace

HighlightError highlight_error(double exponent, TableSize size, bool own_tables, int angle_fraction_bits) {
  const double steps = own_tables ? 4095.0 / 2 : 4095.0;
  const double drift = (1.0 + steps) * std::ldexp(0.5, -angle_fraction_bits);
  HighlightError error{.exponent = exponent};
  double gain = 1.0;
  TableError table{};
  if (own_tables) {
    table = own_error(exponent, size);
  } else {
    const Bell bell = fitted_bell(exponent);
    gain = bell.gain;
    error.fit = c_steps * fit_error(exponent, bell);
    table = power_error(bell.power, size);
  }
  error.table = c_steps * gain * table.table;
  error.angle = c_steps * gain * table.slope * drift;
  return error;
}

HighlightError worst_highlight_error(TableSize size, bool own_tables, int angle_fraction_bits) {
  HighlightError worst;
  for (double exponent = 2.0; exponent <= 1000.0; exponent *= exponent < 3.0 ? 1.001 : 1.03)
    if (const HighlightError error = highlight_error(exponent, size, own_tables, angle_fraction_bits);
        error.total() > worst.total())
      worst = error;
  return worst;
}

}  // namespace halfway::study
