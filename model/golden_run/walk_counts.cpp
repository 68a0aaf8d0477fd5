// SPDX-License-Identifier: Apache-2.0
#include "golden_run/walk_counts.hpp"

#include <algorithm>
#include <array>

#include "words/processors_layout.hpp"

namespace halfway {

bool has_walk_clocks(const HardwareKey& key) {
  if (key.preset != Preset::exact) return false;
  return key.shader != Shader::processors ||
         (key.processors.objects == 0 && key.processors.form == ProcessorForm::unrolled);
}

WalkCounter::WalkCounter(const HardwareKey& key)
    : golden_(make_golden_model(key)),
      processors_(key.shader == Shader::processors),
      clock_(key.shader == Shader::spherical) {}

void WalkCounter::add(std::span<const std::uint32_t> init_words) {
  const std::size_t words_per_vector = (golden_->init_bits() + 31) / 32;
  while (!init_words.empty()) {
    const auto vector = init_words;
    init_words = init_words.subspan(golden_->group(init_words) * words_per_vector);
    if (processors_ && words::get_bits(vector, words::Exact::request_header_at::command) !=
                           static_cast<std::uint64_t>(words::Command::new_object))
      continue;  // the vector defines a light
    std::array<std::uint32_t, (words::Exact::c_init_header_bits + 31) / 32> header;
    for (std::size_t i = 0; i < header.size(); ++i)
      header[i] = static_cast<std::uint32_t>(
          words::get_bits(vector, {"", 32 * static_cast<int>(i), 32, false, 0},
                          processors_ ? words::ProcessorsLayout<words::Exact>::walk_low() : 0));
    walker_.line_load(header);
    ++counts_.headers;
    clock_.take_init();
    walker_.walk([&] {
      ++counts_.lines;
      ++lines_;
      if (walker_.line_empty()) {
        ++counts_.empty_lines;
        clock_.take_line(0);
        return;
      }
      const std::uint64_t pixels = walker_.pixels();
      ++counts_.spans;
      counts_.pixels += pixels;
      clock_.take_line(static_cast<std::int64_t>(pixels));
      counts_.lost_to_lines += std::max(span_, lines_) - span_;
      span_ = pixels;
      lines_ = 0;
    });
  }
}

WalkCounts WalkCounter::counts() const {
  WalkCounts counts = counts_;
  counts.lost_to_headers =
      static_cast<std::uint64_t>(clock_.last_pixel()) - counts.pixels - counts.lost_to_lines;
  return counts;
}

}  // namespace halfway
