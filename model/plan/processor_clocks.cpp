// SPDX-License-Identifier: Apache-2.0
#include "plan/processor_clocks.hpp"

#include <cstdlib>

namespace halfway {
namespace {

bool has_view(const HardwareKey& key) {
  return key.preset == Preset::exact &&
         words::ProcessorsLayout<words::Exact>(processors_config(key)).has_view();
}

bool has(const HardwareKey& key, const ProcessorClocks& row) {
  const ProcessorUnits& p = key.processors;
  if (!row.term) return false;
  switch (*row.term) {
    case words::Term::ambient:
      return row.normalize == p.normalize && row.view == has_view(key);
    case words::Term::diffuse:
      if (!p.diffuse) return false;
      break;
    case words::Term::specular:
      if (!p.specular) return false;
      break;
  }
  switch (*row.light) {
    case LightKind::directional:
      return p.directional > 0;
    case LightKind::positional:
      return p.positional > 0;
    case LightKind::spot:
      return p.spots > 0;
  }
  std::abort();
}

}  // namespace

const ProcessorClocks& slowest_processor(const HardwareKey& key) {
  // Every key has one of the ambient rows.
  const ProcessorClocks* slowest = &c_processor_clocks.front();
  for (const ProcessorClocks& row : c_processor_clocks)
    if (has(key, row) && row.clocks(key.preset) > slowest->clocks(key.preset)) slowest = &row;
  return *slowest;
}

}  // namespace halfway
