// SPDX-License-Identifier: Apache-2.0
#include <cstdint>

#include "golden/shadow_counter.hpp"
#include "vectors/entities.hpp"
#include "vectors/random.hpp"
#include "vectors/vector_file.hpp"

namespace halfway::vectors {

// A line: reset, step, clear, counts, opens, takes, x, clocks until ready; then before the edge: counted,
// count (meant where counted), fault.
Status write_shadow_counter(const std::filesystem::path& folder) {
  using golden::Exact;
  constexpr int c_columns = 1 << Exact::c_pixel_x_bits;
  Random random(9);
  VectorFile file;
  golden::ShadowCounter twin;
  std::uint32_t last = 0;   // counted since the last clear
  std::uint32_t waits = 0;  // until ready
  bool counted = false;     // the last step was one of a column
  int held = 0;             // what that column held
  bool fault = false;       // as seen two clocks after the step
  const auto line = [&](bool reset, bool step, bool clear, bool counts, bool opens, bool takes,
                        std::uint32_t x) {
    const bool stepped = step && !reset;
    file.flag(reset).flag(step).flag(clear).flag(counts).flag(opens).flag(takes);
    file.word(x, Exact::c_pixel_x_bits).word(reset ? 0 : waits, 32);
    if (waits > 0 && !reset) fault = twin.fault();
    file.flag(counted).word(static_cast<std::uint64_t>(held), Exact::c_shadow_count_bits).flag(fault);
    file.end_vector();
    if (!reset) waits = 0;
    fault = twin.fault();
    if (stepped) {
      counted = counts || takes;
      if (clear) {
        twin.clear();
        waits = last + 1;
        last = 0;
      } else if (takes) {
        held = twin.take(x);
      } else if (counts) {
        // The twin shows a count only to the object that takes it.
        held = twin.take(x);
        for (int i = 0; i < (held < 0 ? -held : held); ++i) twin.count(x, held > 0);
        twin.count(x, opens);
        last = x > last ? x : last;
      }
    }
    if (reset) {
      twin = golden::ShadowCounter();
      waits = c_columns;
      last = 0;
      counted = fault = false;
    }
  };
  line(true, false, false, false, false, false, 0);
  line(true, false, false, false, false, false, 0);
  for (std::uint32_t x = 0; x < c_columns; ++x) line(false, true, false, false, false, true, x);
  for (int i = 0; i < 12000; ++i) {
    const int part = i / 1500;
    if (i % 6000 == 5999) {
      line(true, random.one_in(2), false, true, true, false, 0);
      continue;
    }
    // Few columns, so that they come again at once; two that count past either end.
    const auto x = static_cast<std::uint32_t>(random.one_in(8) ? random.between(0, c_columns - 1)
                                                               : random.between(100, 100 + part % 3));
    const bool step = part % 2 == 0 || !random.one_in(3);
    const bool far = part % 4 >= 2;
    const bool opens = far ? (x % 2 == 0) == (random.between(0, 15) != 0) : random.one_in(2);
    const bool clear = !far && random.one_in(400);
    const bool takes = !clear && random.one_in(far ? 3000 : 4);
    line(false, step, clear, !clear && !takes && !random.one_in(10), opens, takes, x);
  }
  for (int i = 0; i < 3; ++i) line(false, false, false, false, false, false, 0);
  return file.write(folder / "columns.txt");
}

}  // namespace halfway::vectors
