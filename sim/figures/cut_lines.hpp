// SPDX-License-Identifier: Apache-2.0
// The published spherical hardware with a host that cuts lines where a bell ends. The paper sets the bell to
// zero outside of +-pi/2a and has an angle register of 12 bits. Preset published lets the register wrap. This
// is the other reading: the register never leaves the bell, because the host sends another record where the
// bell ends.
#pragma once

#include "sim/figures/figure_pictures.hpp"

namespace halfway::figures {

struct CutLines {
  Frame frame;
  std::uint64_t vectors = 0, records = 0;  ///< that the host sends
};

/// Draw by the golden model of preset published. A line on which a highlight's angle leaves its bell is sent
/// in pieces; outside of the bell the factor of the highlight is zero. Each piece is a triangle of one line:
/// an init vector and a record. The angle at its start is the one that the uncut line's register has there.
CutLines draw_with_cut_lines(const Scene& scene, FrameSize size);

}  // namespace halfway::figures
