// SPDX-License-Identifier: Apache-2.0
// Golden model of rtl/objects/object_front.vhd: triangles to tokens, through the chain of object processors.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "golden/object_output.hpp"
#include "golden/object_processor.hpp"
#include "golden/object_source.hpp"

namespace halfway::golden {

template <class Preset>
class ObjectFront {
 public:
  ObjectFront(const ProcessorsConfig& config, int subpixels, int objects)
      : source_(config, subpixels),
        chain_(static_cast<std::size_t>(objects), ObjectProcessor<Preset>(config, subpixels)),
        output_(config, has_filter(subpixels)) {}

  /// Takes a vector, and calls emit(token, mask, ends) for each token that it causes.
  template <class Emit>
  void take(std::span<const std::uint32_t> vector, Emit&& emit) {
    source_.take(vector, [&](const Word& word) { pass(0, word, emit); });
  }

  bool busy() const { return source_.busy(); }
  /// A triangle found no free processor, or came out of order. All later tokens are then invalid.
  bool fault() const { return source_.fault() || output_.fault(); }

 private:
  using Word = ObjectWord<Preset>;

  template <class Emit>
  void pass(std::size_t processor, const Word& word, Emit& emit) {
    if (processor == chain_.size())
      output_.take(word, emit);
    else
      chain_[processor].take(word, [&](const Word& next) { pass(processor + 1, next, emit); });
  }

  ObjectSource<Preset> source_;
  std::vector<ObjectProcessor<Preset>> chain_;
  ObjectOutput<Preset> output_;
};

}  // namespace halfway::golden
