// SPDX-License-Identifier: Apache-2.0
// The common part of all software pictures: exact coverage, the nearest triangle at each pixel, several
// threads.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <span>

#include "projection/screen_triangle.hpp"
#include "reference/renderer.hpp"
#include "scene/scene.hpp"

namespace halfway {

/// Radiance at pixel (x, y), where triangles[index] is the nearest.
using PixelShader = std::function<glm::dvec3(std::uint32_t index, std::uint32_t x, std::uint32_t y)>;

/// Calls `make_shader` for each band of the frame or tile, on any thread. The shader is then called for the
/// band's covered pixels, line by line from left to right, and may keep data from one call to the next.
ReferenceImage render_visible(const Scene& scene, std::span<const ScreenTriangle> triangles,
                              const RenderOptions& options, const std::function<PixelShader()>& make_shader);

}  // namespace halfway
