// SPDX-License-Identifier: Apache-2.0
// Figure 15 of the spherical paper: rings around highlights caused by small tables.
#pragma once

#include "frame/frame.hpp"

namespace halfway::figures {

/// Measured in discs around the highlights of the scene `highlights`, inside every bell, where wrapping
/// angles cause no ghost highlights.
struct Rings {
  int largest_step = 0;    ///< between neighbouring pixels of a line, in steps of 1/255
  double rms_error = 0.0;  ///< against the same interpolation without tables
};

/// Two frames of the scene `highlights` with c_rings_frame: with tables and without.
Rings measure_rings(const Frame& frame, const Frame& without_tables);
inline constexpr FrameSize c_rings_frame{640, 480};

}  // namespace halfway::figures
