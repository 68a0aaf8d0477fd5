// SPDX-License-Identifier: Apache-2.0
#include "setup/setup.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "plan/plan.hpp"
#include "setup/processors_setup.hpp"
#include "setup/quadratic_setup.hpp"
#include "setup/spherical_setup.hpp"

namespace halfway {

SetupCounts& SetupCounts::operator+=(const SetupCounts& o) {
  projection += o.projection;
  triangles += o.triangles;
  subdivided += o.subdivided;
  leaves += o.leaves;
  vectors += o.vectors;
  records += o.records;
  shaded += o.shaded;
  overexposed += o.overexposed;
  unresolved += o.unresolved;
  shadows += o.shadows;
  objects = std::max(objects, o.objects);
  return *this;
}

void Setup::append_all(std::vector<std::uint32_t>& words, SetupCounts& counts) const {
  const std::unique_ptr<SetupWorker> one = worker();
  for (std::uint32_t unit = 0; unit < units(); ++unit) one->append(unit, words, counts);
}

std::unique_ptr<Setup> make_setup(const Scene& scene, FrameSize frame, const HardwareKey& key,
                                  const SetupOptions& options) {
  if (key.shader == Shader::spherical)
    return std::make_unique<SphericalSetup>(scene, frame, key, options.spherical);
  if (key.shader == Shader::processors) return make_processors_setup(scene, frame, key, options.processors);
  return std::make_unique<QuadraticSetup>(scene, frame, key, options.quadratic);
}

Status check_pixels(const Scene& scene, const HardwareKey& key, const SetupCounts& counts, bool fault) {
  if (const unsigned objects = key.processors.objects; counts.objects > objects && objects > 0)
    return bad_input(fmt::format(
        "{}: {} pieces of triangles{} lie on one line of {}, and the hardware has {} object "
        "processors; give more by --objects (make: OBJECTS; a space: objects), up to {}, or leave "
        "{} out",
        scene.name, counts.objects, key.processors.shadows ? " and shadow polygons" : "",
        key.processors.subpixels > 1 ? "two neighbouring columns" : "one column", objects,
        c_most_object_processors, key.processors.shadows ? "the shadows" : "them"));
  if (fault)
    return tool_failed(fmt::format("{}: the hardware refused a vector; please report it", scene.name));
  return Ok{};
}

Status check_objects(const Scene& scene, FrameSize frame, const HardwareKey& key,
                     const SetupOptions& options) {
  if (key.processors.objects == 0) return Ok{};
  std::vector<std::uint32_t> words;
  SetupCounts counts;
  make_setup(scene, frame, key, options)->append_prologue(words, counts);
  return check_pixels(scene, key, counts, false);
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
