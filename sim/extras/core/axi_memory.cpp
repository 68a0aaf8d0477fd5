// SPDX-License-Identifier: Apache-2.0
#include "sim/extras/core/axi_memory.hpp"

#include <fmt/format.h>

#include "sim/os/must.hpp"

namespace halfway::core {
namespace {

constexpr std::uint8_t c_okay = 0, c_slave_error = 2;
constexpr std::uint32_t c_page_bytes = 4096;

[[noreturn]] void fail(const char* what, std::uint32_t address) {
  throw Failure{{ExitCode::differs, fmt::format("AXI4: {}, address {:08x}", what, address)}};
}

}  // namespace

bool AxiMemory::is_refused(std::uint32_t address) const {
  return address - origin_ >= bytes_.size() || address - refused_first_ < refused_count_;
}

bool AxiMemory::pauses() {  // xorshift32 (Marsaglia 2003)
  random_ ^= random_ << 13;
  random_ ^= random_ >> 17;
  random_ ^= random_ << 5;
  return (random_ & 1U) != 0;  // never without a seed
}

void AxiMemory::check_waiting(const CoreOutputs& core) const {
  const CoreOutputs& before = core_before_;
  const auto changes = [&](auto... signals) { return ((core.*signals != before.*signals) || ...); };
  using Out = CoreOutputs;
  if (before.m_axi_arvalid > answers_before_.m_axi_arready &&
      changes(&Out::m_axi_arvalid, &Out::m_axi_araddr, &Out::m_axi_arlen))
    fail("a read that changes while it waits", before.m_axi_araddr);
  if (before.m_axi_awvalid > answers_before_.m_axi_awready &&
      changes(&Out::m_axi_awvalid, &Out::m_axi_awaddr, &Out::m_axi_awlen))
    fail("a write that changes while it waits", before.m_axi_awaddr);
  if (before.m_axi_wvalid > answers_before_.m_axi_wready &&
      changes(&Out::m_axi_wvalid, &Out::m_axi_wdata, &Out::m_axi_wstrb, &Out::m_axi_wlast))
    fail("a word that changes while it waits, before the write", before.m_axi_awaddr);
}

AxiMemory::Burst AxiMemory::checked(std::uint32_t address, std::uint8_t length) const {
  const Burst burst{address, length + 1U};
  if (address % bus_bytes_ != 0) fail("a burst of parts of words", address);
  if (address % c_page_bytes + burst.words * bus_bytes_ > c_page_bytes) fail("a burst across 4 KiB", address);
  return burst;
}

void AxiMemory::take_read(const CoreOutputs& core) {
  const Burst burst = checked(core.m_axi_araddr, core.m_axi_arlen);
  for (std::uint32_t i = 0; i < burst.words; ++i) {
    const std::uint32_t address = burst.address + i * bus_bytes_;
    Word word{0, 0, c_slave_error, i + 1 == burst.words, clock_ + timing_.latency - 1};
    if (!is_refused(address)) {
      word.response = c_okay;
      for (unsigned byte = 0; byte < bus_bytes_; ++byte)
        word.data |= std::uint64_t{bytes_[address - origin_ + byte]} << (8 * byte);
    }
    reads_.push_back(word);
  }
}

void AxiMemory::take_word(const CoreOutputs& core) {
  ++words_written_;
  words_.push_back({core.m_axi_wdata, core.m_axi_wstrb, c_okay, core.m_axi_wlast != 0, 0});
  if (core.m_axi_wlast != 0) write_due_.push_back(clock_ + timing_.latency - 1);
}

std::uint8_t AxiMemory::write() {
  const Burst burst = writes_.front();
  writes_.pop_front();
  write_due_.pop_front();
  std::uint8_t response = c_okay;
  for (std::uint32_t i = 0; i < burst.words; ++i) {
    const std::uint32_t address = burst.address + i * bus_bytes_;
    const Word word = words_.front();
    words_.pop_front();
    if (word.last != (i + 1 == burst.words)) fail("a write whose last word is not marked", address);
    if (is_refused(address)) {
      response = c_slave_error;
      continue;
    }
    for (unsigned byte = 0; byte < bus_bytes_; ++byte)
      if ((word.strobes >> byte & 1) != 0)
        bytes_[address - origin_ + byte] = static_cast<std::uint8_t>(word.data >> (8 * byte));
  }
  return response;
}

void AxiMemory::clock(CoreInputs& answers, const CoreOutputs& core) {
  ++clock_;
  check_waiting(core);
  answers_before_ = answers;
  core_before_ = core;
  // Take addresses and words.
  if (core.m_axi_arvalid != 0 && answers.m_axi_arready != 0) take_read(core);
  if (core.m_axi_awvalid != 0 && answers.m_axi_awready != 0)
    writes_.push_back(checked(core.m_axi_awaddr, core.m_axi_awlen));
  if (core.m_axi_wvalid != 0 && answers.m_axi_wready != 0) take_word(core);
  // Give words and responses.
  if (answers.m_axi_rvalid == 0 || core.m_axi_rready != 0) {
    answers.m_axi_rvalid = !reads_.empty() && clock_ >= reads_.front().due && !pauses();
    if (answers.m_axi_rvalid != 0) {
      ++words_read_;
      answers.m_axi_rdata = reads_.front().data;
      answers.m_axi_rresp = reads_.front().response;
      answers.m_axi_rlast = reads_.front().last;
      reads_.pop_front();
    }
  }
  if (answers.m_axi_bvalid == 0 || core.m_axi_bready != 0) {
    answers.m_axi_bvalid =
        !writes_.empty() && !write_due_.empty() && clock_ >= write_due_.front() && !pauses();
    if (answers.m_axi_bvalid != 0) answers.m_axi_bresp = write();
  }
  answers.m_axi_arready = !pauses();
  answers.m_axi_awready = !pauses();
  answers.m_axi_wready = !pauses();
}

}  // namespace halfway::core
