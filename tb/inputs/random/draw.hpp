// SPDX-License-Identifier: Apache-2.0
// Draws a loaded scene at a small size, by the same steps as `halfway sim` and `halfway render`.
#pragma once

#include <string_view>

#include "scene/scene.hpp"

namespace halfway::fuzz {

/// Draws the scene by every shader and in software. Requires everything that load_scene guarantees for a
/// scene. `choice` selects the frame's size, the preset and the processors' form.
void draw(const Scene& scene, unsigned choice);

/// Requires what load_scene guarantees.
void demand_fit(const Scene& scene);

/// A number that depends on every byte of the text.
unsigned choice_of(std::string_view text);

}  // namespace halfway::fuzz
