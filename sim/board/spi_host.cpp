// SPDX-License-Identifier: Apache-2.0
#include "sim/board/spi_host.hpp"

#include <fmt/format.h>

#include <utility>

#include "sim/board/spi_packet.hpp"

namespace halfway::board {
namespace {

// The shortest times of docs/board.md, in system clocks.
constexpr std::uint32_t c_select_to_clock = 6, c_half_period = 2, c_clock_to_select = 2,
                        c_between_packets = 6;

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
        text += fmt::format("packet {} {} 0\n{}\n", action.bytes.size(), 8 * action.bytes.size(),
                            hex(action.bytes));
        break;
      case HostAction::Kind::part:
        text += fmt::format("part   {} {} {}\n{}\n", action.bytes.size(), action.bits, action.clocks,
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

SpiHost::SpiHost(std::vector<HostAction> script, std::uint32_t seed)
    : script_(std::move(script)), random_(seed) {}

std::uint32_t SpiHost::pause(std::uint32_t one_in, std::uint32_t most) {
  if (random_ == 0) return 0;
  random_ ^= random_ << 13;  // xorshift32 (Marsaglia 2003)
  random_ ^= random_ >> 17;
  random_ ^= random_ << 5;
  return random_ % one_in == 0 ? (random_ >> 8) % most : 0;
}

/// Plan the first `bits` bits of a packet; then hold select for `hold` clocks.
void SpiHost::plan_packet(const std::vector<std::uint8_t>& bytes, std::uint32_t bits, std::uint32_t hold) {
  const SpiPins idle, selected{.select_n = false};
  steps_.push_back({idle, c_between_packets + pause(4, 3000)});
  steps_.push_back({selected, c_select_to_clock - c_half_period + pause(4, 50)});
  for (std::uint32_t bit = 0; bit < bits; ++bit) {
    const bool data = (bytes[bit / 8] >> (7 - bit % 8) & 1) != 0, starts_byte = bit % 8 == 0;
    const std::uint32_t low = c_half_period + (starts_byte ? pause(4, 400) : pause(64, 40));
    steps_.push_back({{false, false, data}, low});
    steps_.push_back({{false, true, data}, c_half_period, bit < 8, bit == 7});
  }
  steps_.push_back({selected, c_clock_to_select + hold});
  ++report_.packets;
  polls_ = bytes[0] == c_read_status;
  knows_status_ = false;
}

/// Take the device's bit of the status byte.
void SpiHost::sample(const Step& step, bool device_data) {
  received_ = static_cast<std::uint8_t>(received_ << 1 | (device_data ? 1 : 0));
  if (!step.ends_status) return;
  ++report_.status_bytes;
  if ((received_ & c_error) != 0) ++report_.errors;
  if ((received_ & c_fault) != 0) ++report_.faults;
  report_.frames = received_ & c_frames;
  knows_status_ = polls_;
}

bool SpiHost::can_take(const HostAction& action) const {
  if (action.kind == HostAction::Kind::pause) return true;
  if (!knows_status_ || (received_ & c_ending) != 0) return false;
  const bool draws = !action.bytes.empty() && action.bytes[0] == c_draw;
  return !draws || (received_ & c_room) != 0;
}

void SpiHost::plan_next() {
  if (next_ == script_.size()) return;
  const HostAction& action = script_[next_];
  if (!can_take(action)) {
    plan_packet({c_read_status}, 8, 0);
    return;
  }
  ++next_;
  switch (action.kind) {
    case HostAction::Kind::packet:
      plan_packet(action.bytes, static_cast<std::uint32_t>(8 * action.bytes.size()), 0);
      break;
    case HostAction::Kind::part:
      plan_packet(action.bytes, action.bits, action.clocks);
      break;
    case HostAction::Kind::pause:
      steps_.push_back({SpiPins(), action.clocks});
      break;
    case HostAction::Kind::wait:
      break;
  }
}

SpiPins SpiHost::clock(bool device_data) {
  if (steps_.empty()) plan_next();
  if (steps_.empty()) return {};
  Step& step = steps_.front();
  const SpiPins pins = step.pins;
  if (step.sample) sample(step, device_data);
  step.sample = false;
  if (--step.clocks == 0) steps_.pop_front();
  return pins;
}

}  // namespace halfway::board
