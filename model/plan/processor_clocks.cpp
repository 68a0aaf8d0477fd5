// SPDX-License-Identifier: Apache-2.0
#include "plan/processor_clocks.hpp"

#include <cstdlib>

namespace halfway {
namespace {

constexpr std::uint64_t c_second_ns = 1'000'000'000;

constexpr std::uint64_t divide_up(std::uint64_t a, std::uint64_t b) {
  return (a + b - 1) / b;
}

bool has_light(const ProcessorUnits& units, LightKind kind) {
  switch (kind) {
    case LightKind::directional:
      return units.directional > 0;
    case LightKind::positional:
      return units.positional > 0;
    case LightKind::spot:
      return units.spots > 0;
  }
  std::abort();
}

bool has(const HardwareKey& key, const ProcessorClocks& row) {
  const ProcessorUnits& p = key.processors;
  if (!row.term) return false;
  if (*row.term == words::Term::ambient) {
    const words::ProcessorsLayout<words::Exact> layout(processors_config(key));
    return row.normalize == p.normalize && row.view == (key.preset == Preset::exact && layout.has_view());
  }
  return (*row.term == words::Term::diffuse ? p.diffuse : p.specular) && has_light(p, *row.light);
}

}  // namespace

const ProcessorClocks& slowest_processor(const HardwareKey& key) {
  // Every key has one of the ambient rows.
  const ProcessorClocks* slowest = &c_processor_clocks.front();
  for (const ProcessorClocks& row : c_processor_clocks)
    if (has(key, row) && row.clocks(key.preset) > slowest->clocks(key.preset)) slowest = &row;
  return *slowest;
}

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
  const bool one = version == ProcessorVersion::one;
  const std::uint64_t positional = one ? 0 : load.positional;
  // Two processors per light, and one for ambient light.
  ProcessorCount count{
      count_pipelines(pipeline_clocks(version), 2 * (load.directional + positional) + 1, load)};
  const std::uint64_t single_clocks = 14 * load.directional + 26 * positional + (one ? 4 : 6);
  count.single_ns = single_clocks * load.objects * c_processor_cycle_ns;
  if (const std::uint64_t due_ns = c_second_ns / (load.frames * load.pixels); due_ns > 0) {
    count.published_due_ns = due_ns;
    count.published_pipelines = divide_up(count.pipeline_ns, due_ns);
  }
  return count;
}

}  // namespace halfway
