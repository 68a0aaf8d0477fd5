// SPDX-License-Identifier: Apache-2.0
// The names of what the page and the core exchange, in the order of their arrays: the numbers of
// live_settings and live_figures, and the pictures of live_pixels.
#pragma once

#include <array>

namespace halfway::live {

inline constexpr std::array c_setting_names = {"width",        "height",         "azimuth",
                                               "elevation",    "distance",       "exponent",
                                               "lightAzimuth", "lightElevation", "threshold"};
inline constexpr std::array c_figure_names = {
    "fragments", "mismatches", "triangles", "leaves", "vectors",  "words",   "clocks",   "rms",
    "largest",   "covered",    "setup",     "golden", "hardware", "compare", "assemble", "unresolved"};
inline constexpr std::array c_picture_names = {"hardware", "golden", "reference", "difference", "triangles"};

}  // namespace halfway::live
