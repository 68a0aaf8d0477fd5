// SPDX-License-Identifier: Apache-2.0
// Rows of core_registers, by a model of its contract.
#include <array>
#include <cstdint>

#include "sim/extras/library/halfway_core_registers.h"
#include "sim/files/vector_file.hpp"
#include "vectors/entities.hpp"
#include "vectors/random.hpp"

namespace halfway::vectors {
namespace {

/// What a write changes, or clears where it has a 1.
struct Writable {
  std::uint32_t offset, mask;
  bool clears = false;
};
constexpr Writable c_writable[] = {{HALFWAY_CORE_CONTROL, 3},
                                   {HALFWAY_CORE_FAULTS, 0xFF, true},
                                   {HALFWAY_CORE_INTERRUPT_ENABLE, 3},
                                   {HALFWAY_CORE_INTERRUPTS, 3, true},
                                   {HALFWAY_CORE_RING_BASE, 0xFFFF'FFC0},
                                   {HALFWAY_CORE_RING_SIZE, 0xF},
                                   {HALFWAY_CORE_RING_HEAD, 0xFFFF'FFFF}};

constexpr std::array c_counters = {HALFWAY_CORE_TRIANGLES, HALFWAY_CORE_FRAGMENTS, HALFWAY_CORE_PIXELS,
                                   HALFWAY_CORE_BUSY_CLOCKS, HALFWAY_CORE_STALLED_CLOCKS};

Writable writable(std::uint32_t offset) {
  for (const Writable& each : c_writable)
    if (each.offset == offset) return each;
  return {offset, 0};
}

class RegisterRows {
 public:
  /// Two passes over all words with all strobes, the second one backward. Bits of faults and interrupts are
  /// cleared between, because all would soon be 1.
  void write_all() {
    for (std::uint32_t i = 0; i < 128; ++i)
      for (std::uint32_t strobes = 0; strobes < 16; ++strobes) {
        clock(true, 4 * (i < 64 ? i : 127 - i), strobes);
        while (random_.one_in(2)) clock(false, some_offset(), some_word());
        clock(true, HALFWAY_CORE_FAULTS, 1);
        clock(true, HALFWAY_CORE_INTERRUPTS, 1);
      }
  }
  void write(const std::filesystem::path& path) const { file_.write(path); }

 private:
  /// A row: checked, inputs; outputs before the edge. A command is done in few clocks, so that cleared bits
  /// are seen.
  void clock(bool write, std::uint32_t offset, std::uint32_t strobes) {
    const bool reset = file_.size() == 0 || random_.one_in(1000);
    const bool done = random_.one_in(32), swap = random_.one_in(32);
    const std::uint32_t data = some_word(), picture_base = some_word(),
                        faults = some_word() & some_word() & 0xFF;
    const std::uint32_t read = random_.one_in(2) ? offset : some_offset();
    const bool triangle = random_.one_in(2), fragment = random_.one_in(2), busy = random_.one_in(2),
               stalled = random_.one_in(2);
    const auto pixels = static_cast<std::uint32_t>(random_.bits(3));
    file_.flag(file_.size() > 0).flag(reset).flag(write).word(offset / 4, 6).word(data, 32).word(strobes, 4);
    file_.word(read / 4, 6).flag(busy).flag(done).word(faults, 8).flag(swap).word(picture_base, 32);
    file_.flag(triangle).flag(fragment).word(pixels, 3).flag(stalled);
    put_outputs(offset, read);
    if (reset) {
      reset_words();
      return;
    }

    aborts_ = false;
    if (write) write_word(offset, data, strobes);
    if (done) {
      at(HALFWAY_CORE_INTERRUPTS) |= faults != 0 ? 3 : 1;
      at(HALFWAY_CORE_FAULTS) |= faults;
      ++at(HALFWAY_CORE_RING_TAIL);
    }
    if (swap) at(HALFWAY_CORE_PICTURE) = picture_base;
    for (std::size_t i = 0; i < counts_.size(); ++i) at(c_counters[i]) += counts_[i];
    counts_ = {triangle, fragment, pixels, busy, stalled};
    at(HALFWAY_CORE_STATUS) = busy;
  }

  void put_outputs(std::uint32_t write_offset, std::uint32_t read_offset) {
    file_.flag(writable(write_offset).mask == 0).word(at(read_offset), 32);
    file_.flag(read_offset > HALFWAY_CORE_STALLED_CLOCKS).flag(at(HALFWAY_CORE_CONTROL) != 0).flag(aborts_);
    file_.word(at(HALFWAY_CORE_RING_BASE), 32).word(at(HALFWAY_CORE_RING_SIZE), 4);
    file_.word(at(HALFWAY_CORE_RING_HEAD), 32).word(at(HALFWAY_CORE_RING_TAIL), 32);
    file_.word(at(HALFWAY_CORE_PICTURE), 32);
    file_.flag((at(HALFWAY_CORE_INTERRUPTS) & at(HALFWAY_CORE_INTERRUPT_ENABLE)) != 0).end_vector();
  }

  void write_word(std::uint32_t offset, std::uint32_t data, std::uint32_t strobes) {
    auto [_, mask, clears] = writable(offset);
    for (int byte = 0; byte < 4; ++byte)
      if ((strobes >> byte & 1) == 0) mask &= ~(0xFFU << (8 * byte));
    at(offset) = clears ? at(offset) & ~(mask & data) : (at(offset) & ~mask) | (mask & data);
    aborts_ = (at(HALFWAY_CORE_CONTROL) & HALFWAY_CORE_CONTROL_ABORT_MASK) != 0;
    at(HALFWAY_CORE_CONTROL) &= HALFWAY_CORE_CONTROL_ENABLE_MASK;
  }

  /// The generics are those of tb/vectors/rows.toml.
  void reset_words() {
    words_ = {HALFWAY_CORE_IDENTITY_VALUE,
              HALFWAY_CORE_VERSION_VALUE,
              0x12345678,
              0x9ABCDEF0,
              0x0F1E2D3C,
              0x4B5A6978};
    counts_ = {};
    aborts_ = false;
  }

  std::uint32_t& at(std::uint32_t offset) { return words_[offset / 4]; }
  std::uint32_t some_word() { return static_cast<std::uint32_t>(random_.word(32)); }
  std::uint32_t some_offset() { return static_cast<std::uint32_t>(4 * random_.bits(6)); }

  Random random_{1};
  VectorFile file_;
  std::array<std::uint32_t, 64> words_{};
  std::array<std::uint32_t, c_counters.size()> counts_{};  ///< of the clock before
  bool aborts_ = false;
};

}  // namespace

std::vector<Entity> core_registers_entities() {
  return {{"core_registers", [](const Folder& folder) {
             RegisterRows rows;
             rows.write_all();
             rows.write(folder / "registers.txt");
           }}};
}

}  // namespace halfway::vectors
