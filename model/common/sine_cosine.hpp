// SPDX-License-Identifier: Apache-2.0
// Sine and cosine that are equal on all machines and in a browser, whose libraries round differently. Meshes
// need them: a symmetric mesh has values halfway between two words, which the last bit of a sine decides.
#pragma once

namespace halfway {

struct SineCosine {
  double sine, cosine;
};

/// Of an angle of at most 2^16 radians. Computed with about 100 bits and then rounded.
SineCosine sine_cosine(double radians);

}  // namespace halfway
