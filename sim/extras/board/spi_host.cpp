// SPDX-License-Identifier: Apache-2.0
#include "sim/extras/board/spi_host.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace halfway::board {
namespace {

// In system clocks.
constexpr std::uint32_t c_select_to_clock = 6, c_half_period = 2, c_clock_to_select = 2,
                        c_between_packets = 6;

std::vector<std::uint8_t> with_crc(std::vector<std::uint8_t> bytes) {
  const std::uint16_t crc = crc16(bytes);
  bytes.push_back(static_cast<std::uint8_t>(crc >> 8));
  bytes.push_back(static_cast<std::uint8_t>(crc));
  return bytes;
}

}  // namespace

std::uint16_t crc16(std::span<const std::uint8_t> bytes) {
  constexpr std::uint32_t c_polynomial = 0x1021;
  std::uint32_t crc = 0xffff;
  for (const std::uint8_t byte : bytes) {
    crc ^= std::uint32_t{byte} << 8;
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 0x8000) != 0 ? (crc << 1) ^ c_polynomial : crc << 1;
    crc &= 0xffff;
  }
  return static_cast<std::uint16_t>(crc);
}

std::vector<std::uint8_t> draw_packet(std::span<const std::uint32_t> words, unsigned init_bits) {
  std::vector<std::uint8_t> bytes = {c_draw};
  for (std::size_t byte = (init_bits + 7) / 8; byte-- > 0;)
    bytes.push_back(static_cast<std::uint8_t>(words[byte / 4] >> (8 * (byte % 4))));
  return with_crc(std::move(bytes));
}

std::vector<std::uint8_t> end_packet(std::uint16_t background) {
  return with_crc(
      {c_end_frame, static_cast<std::uint8_t>(background >> 8), static_cast<std::uint8_t>(background)});
}

std::uint32_t SpiWire::pause(std::uint32_t one_in, std::uint32_t most) {
  if (random_ == 0) return 0;
  random_ ^= random_ << 13;  // xorshift32 (Marsaglia 2003)
  random_ ^= random_ >> 17;
  random_ ^= random_ << 5;
  return random_ % one_in == 0 ? (random_ >> 8) % most : 0;
}

void SpiWire::send(std::span<const std::uint8_t> bytes, std::uint32_t bits, std::uint32_t hold) {
  const SpiPins idle_pins, selected{.select_n = false};
  received_.clear();
  bits_ = 0;
  steps_.push_back({idle_pins, c_between_packets + pause(4, 3000)});
  steps_.push_back({selected, c_select_to_clock - c_half_period + pause(4, 50)});
  for (std::uint32_t bit = 0; bit < bits; ++bit) {
    const bool data = (bytes[bit / 8] >> (7 - bit % 8) & 1) != 0, starts_byte = bit % 8 == 0;
    const std::uint32_t low = c_half_period + (starts_byte ? pause(4, 400) : pause(64, 40));
    steps_.push_back({{false, false, data}, low});
    steps_.push_back({{false, true, data}, c_half_period, true});
  }
  steps_.push_back({selected, c_clock_to_select + hold});
}

void SpiWire::idle(std::uint32_t clocks) {
  if (clocks > 0) steps_.push_back({SpiPins(), clocks});
}

void SpiWire::sample(bool device_data) {
  byte_ = static_cast<std::uint8_t>(byte_ << 1 | (device_data ? 1 : 0));
  if (++bits_ % 8 == 0) received_.push_back(byte_);
}

SpiPins SpiWire::clock(bool device_data) {
  if (steps_.empty()) return {};
  Step& step = steps_.front();
  const SpiPins pins = step.pins;
  if (step.samples) sample(device_data);
  step.samples = false;
  if (--step.clocks == 0) steps_.pop_front();
  return pins;
}

std::string script_text(const std::vector<HostAction>& script) {
  std::string text;
  for (const HostAction& action : script) {
    switch (action.kind) {
      case HostAction::Kind::packet:
        text += fmt::format("packet {} {} {}\n{:02x}\n", action.bytes.size(), action.bits, action.clocks,
                            fmt::join(action.bytes, ""));
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
