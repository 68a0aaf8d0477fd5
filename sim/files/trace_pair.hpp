// SPDX-License-Identifier: Apache-2.0
// Two traces, read in parallel in bounded memory.
#pragma once

#include <span>
#include <vector>

#include "sim/files/trace.hpp"

namespace halfway {

/// Read both traces in turn, chunk by chunk, to their ends. `rtl` may be null: no such trace.
template <class OnGolden, class OnRtl>
Status read_side_by_side(TraceReader& golden, TraceReader* rtl, OnGolden&& on_golden, OnRtl&& on_rtl) {
  constexpr std::size_t c_chunk = 1 << 16;  // fragments
  std::vector<Fragment> chunk;
  const auto pass_on = [&](TraceReader& reader, bool& more, auto& sink) -> Status {
    if (!more) return Ok{};
    chunk.clear();
    const auto count = reader.read(chunk, c_chunk);
    if (!count) return count.error();
    more = *count != 0;
    sink(std::span<const Fragment>(chunk));
    return Ok{};
  };
  for (bool more_golden = true, more_rtl = rtl != nullptr; more_golden || more_rtl;) {
    if (Status status = pass_on(golden, more_golden, on_golden); !status) return status;
    if (more_rtl)
      if (Status status = pass_on(*rtl, more_rtl, on_rtl); !status) return status;
  }
  return Ok{};
}

}  // namespace halfway
