// SPDX-License-Identifier: Apache-2.0
#include "plan/processor_count.hpp"

namespace halfway {
namespace {

constexpr std::uint64_t c_second_ns = 1'000'000'000;

constexpr std::uint64_t divide_up(std::uint64_t a, std::uint64_t b) {
  return (a + b - 1) / b;
}

}  // namespace

PipelineCount count_pipelines(std::uint64_t clocks, std::uint64_t per_pipeline, const ShadingLoad& load) {
  PipelineCount count{};
  count.pipeline_ns = clocks * load.objects * c_processor_cycle_ns;
  count.per_pipeline = per_pipeline;
  const std::uint64_t busy_ns = load.frames * load.pixels * count.pipeline_ns;  // per second
  count.pipelines_needed = static_cast<double>(busy_ns) / static_cast<double>(c_second_ns);
  count.pipelines = divide_up(busy_ns, c_second_ns);
  return count;
}

ProcessorCount count_processors(ProcessorVersion version, const ShadingLoad& load) {
  const std::uint64_t positional = version == ProcessorVersion::one ? 0 : load.positional;
  // Two processors per light, and one for ambient light.
  ProcessorCount count{
      count_pipelines(pipeline_clocks(version), 2 * (load.directional + positional) + 1, load)};
  count.single_ns =
      single_clocks(version, load.directional, positional) * load.objects * c_processor_cycle_ns;
  if (const std::uint64_t due_ns = c_second_ns / (load.frames * load.pixels); due_ns > 0) {
    count.published_due_ns = due_ns;
    count.published_pipelines = divide_up(count.pipeline_ns, due_ns);
  }
  return count;
}

}  // namespace halfway
