// SPDX-License-Identifier: Apache-2.0
// A trace of parts of signals as 32-bit words, as a hardware module records it.
#pragma once

#include <cstdint>
#include <set>
#include <vector>

#include "sim/driver/shader_stages.hpp"

namespace halfway {

/// `words`: edge by edge, the words of each part in their order, the least significant first.
SignalTrace word_trace(const std::set<TracedPart>& parts, std::vector<std::uint32_t> words);

}  // namespace halfway
