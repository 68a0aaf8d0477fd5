// SPDX-License-Identifier: Apache-2.0
#include "setup/setup.hpp"

#include <algorithm>

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

}  // namespace halfway
