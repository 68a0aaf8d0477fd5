// SPDX-License-Identifier: Apache-2.0
// words_to_fragments in Verilator as a shared library: exported by axi_harness.cpp, called by
// bad_input_test.cpp.
#pragma once

#include <cstddef>
#include <cstdint>

extern "C" {

/// Same layout as halfway::Fragment.
struct AxiFragment {
  std::uint32_t triangle, z;
  std::uint16_t y, x;
  std::uint8_t red, green, blue, reserved;
};

struct AxiFrame {
  const std::uint32_t* words;  ///< of packets; the last two are the frame's end
  std::size_t count_words;
  std::uint32_t stall_seed;  ///< 0: full speed
  std::uint64_t
      most_wait;  ///< clocks without a transfer, and without a stall of the receiver, that count as a hang
  AxiFragment* fragments;
  std::size_t capacity;
  std::size_t count;  ///< number of fragments, also of those beyond `capacity`
  std::uint64_t longest_wait;
  std::uint8_t cause;  ///< of a fault, in the frame's last transfer
  std::size_t ends;    ///< frames that ended: wrong words may be the end of a frame
};

/// Draws one frame. Null: it ended; otherwise what is wrong.
const char* halfway_axi_draw(void* model, AxiFrame* frame);
/// Starts the model with a reset.
void* halfway_axi_create();
void halfway_axi_destroy(void* model);
}
