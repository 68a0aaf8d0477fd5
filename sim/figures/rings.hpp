// SPDX-License-Identifier: Apache-2.0
// Figure 15 of the spherical paper: rings that small tables leave around highlights.
#pragma once

#include "frame/frame.hpp"

namespace halfway::figures {

/// What is measured in discs around the highlights of the scene `highlights`, inside every bell: no ghost of
/// the wrapping angle gets there.
struct Rings {
  int largest_step = 0;    ///< between neighbours on a line, of 255
  double rms_error = 0.0;  ///< against the same interpolation without tables
};

/// Both of the scene `highlights`, of c_rings_frame: one by tables, one without.
Rings measure_rings(const Frame& frame, const Frame& without_tables);
inline constexpr FrameSize c_rings_frame{640, 480};

}  // namespace halfway::figures
