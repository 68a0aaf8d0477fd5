// SPDX-License-Identifier: Apache-2.0
#include "setup/check_counts.hpp"

#include <fmt/format.h>

namespace halfway {

Status check_shadow_counts(const Scene& scene, const SetupCounts& counts, bool fault) {
  if (const std::uint64_t deepest = counts.deepest_shadow; deepest > c_most_shadows)
    return bad_input(
        fmt::format("{}: {} shadow volumes of one light begin or end before one another at a pixel, and the "
                    "processors count up "
                    "to {}; leave out casters in others' shadow, or the shadows",
                    scene.name, deepest, c_most_shadows));
  if (fault)
    return tool_failed(
        fmt::format("{}: a count of shadow volumes left its format; please report it", scene.name));
  return Ok{};
}

Status check_projection(const Scene& scene, const SetupCounts& counts) {
  if (const std::uint64_t lost = counts.projection.unrepresentable; lost != 0)
    return bad_input(
        fmt::format("{}: {} triangles project to no finite point; bring the scene nearer to the origin, or "
                    "the camera away from them",
                    scene.name, lost));
  return Ok{};
}

}  // namespace halfway
