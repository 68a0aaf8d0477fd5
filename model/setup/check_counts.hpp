// SPDX-License-Identifier: Apache-2.0
// Checks of the counts of a set-up, while a frame is drawn and at its end.
#pragma once

#include "common/result.hpp"
#include "scene/scene.hpp"
#include "setup/setup.hpp"

namespace halfway {

/// Returns bad input if a pixel has more objects than the key has object processors. `fault`: that of the
/// golden model that draws the vectors.
Status check_pixels(const Scene& scene, const HardwareKey& key, const SetupCounts& counts, bool fault);
/// The first of these checks before anything is drawn or built.
Status check_objects(const Scene& scene, FrameSize frame, const HardwareKey& key,
                     const SetupOptions& options);
/// Returns bad input if a triangle does not project to finite points on the screen.
Status check_projection(const Scene& scene, const SetupCounts& counts);

}  // namespace halfway
