// SPDX-License-Identifier: Apache-2.0
// Vectors of an entity with a fixed latency: it takes words in each enabled clock and outputs their result a
// fixed number of enabled clocks later.
#pragma once

#include <initializer_list>
#include <vector>

#include "golden/delay_line.hpp"
#include "golden/vector_shift.hpp"
#include "sim/files/vector_file.hpp"

namespace halfway::vectors {

/// Words next to each other, the first one lowest.
struct Flat {
  std::vector<std::uint32_t> words;
  int bits = 0;

  Flat() = default;
  Flat(std::uint64_t value, int width) { add(value, width); }
  Flat& add(std::uint64_t value, int width) {
    words.resize(static_cast<std::size_t>(bits + width + 31) / 32);
    words::set_bits(words, {"", bits, width, false, 0}, words::low_bits(value, width));
    bits += width;
    return *this;
  }
};

inline Flat flat(const golden::Axes& v, int bits) {
  Flat all;
  for (const std::int64_t component : v) all.add(component, bits);
  return all;
}

inline Flat flat(const std::vector<std::uint32_t>& words, int bits) {
  Flat all;
  all.words = words;
  all.bits = bits;
  return all;
}

/// First line: latency. Then one line per clock: checked, enable if the entity has it, inputs; the result,
/// before the edge.
class Pipeline {
 public:
  explicit Pipeline(int latency) : latency_(latency), due_(latency) { file_.word(latency, 32).end_vector(); }
  void clock(std::initializer_list<Flat> inputs, const Flat& result) {
    file_.flag(due_.full());
    add(inputs, result);
    if (latency_ > 0) due_.step(result);
  }
  void clock(bool enable, std::initializer_list<Flat> inputs, const Flat& result) {
    file_.flag(due_.full()).flag(enable);
    add(inputs, result);
    if (enable && latency_ > 0) due_.step(result);
  }
  /// An input changes that must be stable while words are in the stages: the words in the stages are not
  /// checked.
  void restart() { due_ = golden::DelayLine<Flat>(latency_); }
  void write(const std::filesystem::path& path) const { return file_.write(path); }

 private:
  void add(std::initializer_list<Flat> inputs, const Flat& result) {
    for (const Flat& input : inputs) file_.words_of(input.words, input.bits);
    const Flat& shown = latency_ > 0 && due_.full() ? due_.delayed() : result;
    file_.words_of(shown.words, shown.bits).end_vector();
  }

  VectorFile file_;
  int latency_;
  golden::DelayLine<Flat> due_;
};

}  // namespace halfway::vectors
