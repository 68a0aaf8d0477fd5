// SPDX-License-Identifier: Apache-2.0
// From a loaded scene to pictures, as `halfway sim` and `halfway render` go, at a small size.
#pragma once

#include <string_view>

#include "scene/scene.hpp"

namespace halfway::fuzz {

/// Draws the scene by every shader and in software, and holds it to what load_scene promises of a scene.
/// `choice` picks the frame's size, the preset, and the processors' form.
void draw(const Scene& scene, unsigned choice);

/// What load_scene promises.
void demand_fit(const Scene& scene);

/// A number that every byte of a text has a part in.
unsigned choice_of(std::string_view text);

}  // namespace halfway::fuzz
