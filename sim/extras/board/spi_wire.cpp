// SPDX-License-Identifier: Apache-2.0
#include "sim/extras/board/spi_wire.hpp"

namespace halfway::board {
namespace {

// In system clocks.
constexpr std::uint32_t c_select_to_clock = 6, c_half_period = 2, c_clock_to_select = 2,
                        c_between_packets = 6;

}  // namespace

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

}  // namespace halfway::board
