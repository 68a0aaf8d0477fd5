// SPDX-License-Identifier: Apache-2.0
// Compiled in one translation unit with the verilated top (prefix Vshader).
#include "tb/inputs/ports/axi_harness.hpp"

#include <cstring>
#include <memory>

#include "Vshader.h"
#include "verilated.h"

#define HALFWAY_EXPORT extern "C" __attribute__((visibility("default")))

namespace {

// A frame without vectors ends in fewer clocks.
constexpr int c_clocks_of_an_end = 32;

class Model {
 public:
  Model() : top_(std::make_unique<Vshader>(&context_, "top")) {
    top_->aclk = 0;
    top_->aresetn = 0;
    top_->s_axis_tvalid = 0;
    top_->m_axis_tready = 0;
    for (int i = 0; i < 4; ++i) clock();
    top_->aresetn = 1;
  }
  ~Model() { top_->final(); }

  const char* draw(AxiFrame& frame) {
    std::uint32_t random = frame.stall_seed;
    std::uint64_t waits = 0;
    std::size_t sent = 0;
    bool ended = false;
    int after_end = 0;
    bool offered = false, waiting = false;
    Word held{};
    frame.count = 0;
    frame.cause = 0;
    frame.ends = 0;
    frame.longest_wait = 0;
    while (true) {
      random ^= random << 13;
      random ^= random >> 17;
      random ^= random << 5;
      const bool pause = frame.stall_seed != 0;
      const std::size_t left = frame.count_words - sent;
      offered = left > 0 && (offered || !pause || (random & 1U) != 0);
      top_->s_axis_tvalid = offered;
      if (offered) top_->s_axis_tdata = frame.words[sent];
      // Before the frame's end, too: a wrong length must not swallow it.
      top_->s_axis_tlast = left == 1 || left == 3;
      top_->m_axis_tready = !pause || (random & 2U) != 0;
      top_->eval();
      const bool take = offered && top_->s_axis_tready, give = top_->m_axis_tvalid && top_->m_axis_tready;
      const Word now = word();
      if (waiting && (!top_->m_axis_tvalid || std::memcmp(&now, &held, sizeof now) != 0))
        return "a transfer changes while it waits";
      held = now;
      waiting = top_->m_axis_tvalid && !give;
      const bool is_last = give && top_->m_axis_tlast, is_fragment = give && top_->m_axis_tkeep != 0;
      if (is_fragment) {
        if (frame.count < frame.capacity) frame.fragments[frame.count] = now.fragment();
        ++frame.count;
      }
      if (is_last) {
        ++frame.ends;
        frame.cause |= top_->m_axis_tuser;
        ended = left == 0;
      }
      if (take || give)
        waits = 0;
      else if ((offered || left == 0) && !waiting && !ended && ++waits > frame.most_wait)
        return "hangs";
      frame.longest_wait = waits > frame.longest_wait ? waits : frame.longest_wait;
      clock();
      if (take) {
        offered = false;
        ++sent;
      }
      if (ended && ++after_end > c_clocks_of_an_end) return nullptr;
    }
  }

 private:
  // The transfer at the output, as axi_pkg places its fields.
  struct Word {
    std::uint32_t data[4];
    std::uint16_t keep;
    bool last;
    AxiFragment fragment() const {
      return {.triangle = data[2],
              .z = data[1],
              .y = static_cast<std::uint16_t>(data[0] >> 16),
              .x = static_cast<std::uint16_t>(data[0]),
              .red = static_cast<std::uint8_t>(data[3]),
              .green = static_cast<std::uint8_t>(data[3] >> 8),
              .blue = static_cast<std::uint8_t>(data[3] >> 16)};
    }
  };
  Word word() const {
    Word word{};
    for (int i = 0; i < 4; ++i) word.data[i] = top_->m_axis_tdata[i];
    word.keep = top_->m_axis_tkeep;
    word.last = top_->m_axis_tlast;
    return word;
  }
  void clock() {
    top_->aclk = 1;
    top_->eval();
    top_->aclk = 0;
    top_->eval();
  }

  VerilatedContext context_;
  std::unique_ptr<Vshader> top_;
};

}  // namespace

HALFWAY_EXPORT const char* halfway_axi_draw(void* model, AxiFrame* frame) {
  return static_cast<Model*>(model)->draw(*frame);
}
HALFWAY_EXPORT void* halfway_axi_create() {
  return new Model();
}
HALFWAY_EXPORT void halfway_axi_destroy(void* model) {
  delete static_cast<Model*>(model);
}
