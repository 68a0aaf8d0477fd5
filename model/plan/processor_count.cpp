// SPDX-License-Identifier: Apache-2.0
#include "plan/processor_count.hpp"

namespace halfway {
namespace {

constexpr std::uint64_t c_second_ns = 1'000'000'000;

constexpr std::uint64_t divide_up(std::uint64_t a, std::uint64_t b) {
  return (a + b - 1) / b;
}

}  // namespace

ProcessorCount count_processors(ProcessorVersion version, const ShadingLoad& load) {
  const std::uint64_t positional = version == ProcessorVersion::one ? 0 : load.positional;
  const std::uint64_t object_ns = load.objects * c_processor_cycle_ns;
  ProcessorCount count{};
  count.pipeline_ns = pipeline_clocks(version) * object_ns;
  count.single_ns = single_clocks(version, load.directional, positional) * object_ns;
  // Two processors a light, and one for ambient light.
  count.per_pipeline = 2 * (load.directional + positional) + 1;
  const std::uint64_t busy_ns = load.frames * load.pixels * count.pipeline_ns;  // in a second
  count.pipelines_needed = static_cast<double>(busy_ns) / static_cast<double>(c_second_ns);
  count.pipelines = divide_up(busy_ns, c_second_ns);
  if (const std::uint64_t due_ns = c_second_ns / (load.frames * load.pixels); due_ns > 0) {
    count.published_due_ns = due_ns;
    count.published_pipelines = divide_up(count.pipeline_ns, due_ns);
  }
  return count;
}

}  // namespace halfway
