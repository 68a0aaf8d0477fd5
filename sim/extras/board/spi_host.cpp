// SPDX-License-Identifier: Apache-2.0
#include "sim/extras/board/spi_host.hpp"

#include <fmt/format.h>

#include "sim/extras/board/spi_packet.hpp"

namespace halfway::board {
namespace {

std::string hex(const std::vector<std::uint8_t>& bytes) {
  std::string text;
  for (const std::uint8_t byte : bytes) text += fmt::format("{:02x}", byte);
  return text;
}

}  // namespace

std::string script_text(const std::vector<HostAction>& script) {
  std::string text;
  for (const HostAction& action : script) {
    switch (action.kind) {
      case HostAction::Kind::packet:
        text += fmt::format("packet {} {} {}\n{}\n", action.bytes.size(), action.bits, action.clocks,
                            hex(action.bytes));
        break;
      case HostAction::Kind::pause:
        text += fmt::format("pause  0 0 {}\n", action.clocks);
        break;
      case HostAction::Kind::wait:
        text += "wait   0 0 0\n";
        break;
    }
  }
  return text;
}

/// Count what the status byte of the last packet reports.
void SpiHost::take_status() {
  status_.reset();
  if (sent_ != Sent::nothing && !wire_.received().empty()) {
    const std::uint8_t status = wire_.received()[0];
    ++report_.status_bytes;
    if ((status & c_error) != 0) ++report_.errors;
    if ((status & c_fault) != 0) ++report_.faults;
    report_.frames = status & c_frames;
    // A packet other than a poll changes the status.
    if (sent_ == Sent::poll) status_ = status;
  }
  sent_ = Sent::nothing;
}

bool SpiHost::can_take(const HostAction& action) const {
  if (action.kind == HostAction::Kind::pause) return true;
  if (!status_ || (*status_ & c_ending) != 0) return false;
  const bool draws = !action.bytes.empty() && action.bytes[0] == c_draw;
  return !draws || (*status_ & c_room) != 0;
}

void SpiHost::plan_next() {
  if (next_ == script_.size()) return;
  const HostAction& action = script_[next_];
  if (!can_take(action)) {
    const std::uint8_t poll[] = {c_read_status};
    wire_.send(poll);
    sent_ = Sent::poll;
    ++report_.packets;
    return;
  }
  ++next_;
  switch (action.kind) {
    case HostAction::Kind::packet:
      wire_.send(action.bytes, action.bits, action.clocks);
      sent_ = Sent::packet;
      ++report_.packets;
      break;
    case HostAction::Kind::pause:
      wire_.idle(action.clocks);
      break;
    case HostAction::Kind::wait:
      break;
  }
}

SpiPins SpiHost::clock(bool device_data) {
  if (!wire_.busy()) {
    take_status();
    plan_next();
  }
  return wire_.clock(device_data);
}

}  // namespace halfway::board
