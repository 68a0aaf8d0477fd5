// SPDX-License-Identifier: Apache-2.0
// Figure 17 of the spherical paper: timing of its line interpolator, ROM and multiplier, from their delays.
#pragma once

#include "sim/figures/figure.hpp"

namespace halfway::figures {

void draw_figure_17(const Context& context, Drawing& out);

}  // namespace halfway::figures
