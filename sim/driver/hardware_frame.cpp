// SPDX-License-Identifier: Apache-2.0
#include "sim/driver/hardware_frame.hpp"

#include <algorithm>

#include "sim/driver/limits.hpp"

namespace halfway {

void HardwareFrame::clear() {
  assembler_.clear();
  expected_ = fragments_ = 0;
  fault_.clear();
  alive_ = true;
}

std::uint64_t HardwareFrame::most() const {
  return expected_ - std::min(expected_, fragments_) + c_most_surplus;
}

Status HardwareFrame::ended(const Status& drawn) {
  if (drawn || drawn.error().code != ExitCode::differs) return drawn;
  fault_ = drawn.error().message;
  alive_ = false;
  return Ok{};
}

void HardwareFrame::add(std::span<const Fragment> fragments) {
  fragments_ += fragments.size();
  while (!fragments.empty()) {
    const std::uint64_t before = assembler_.fragments();
    if (assembler_.add(fragments)) break;
    if (fault_.empty()) fault_ = "a fragment lies outside the frame";
    fragments = fragments.subspan(static_cast<std::size_t>(assembler_.fragments() - before));
  }
}

}  // namespace halfway
