// SPDX-License-Identifier: Apache-2.0
// What scene.hpp says of a scene's numbers, for scenes that no loader has seen.
#pragma once

#include "common/result.hpp"
#include "scene/scene.hpp"

namespace halfway {

/// An error that names the first number that is not finite or not in the range that scene.hpp gives it, the
/// first direction that is not unit, the first index past its list. A normal may be zero (1e-8 at most): then
/// the triangle's own stands for it.
Status check_numbers(const Scene& scene);

}  // namespace halfway
