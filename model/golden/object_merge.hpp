// SPDX-License-Identifier: Apache-2.0
// Golden model of rtl/objects/object_merge.vhd: inserts an own element into a pixel's list.
#pragma once

#include <cstdint>

#include "golden/object_word.hpp"

namespace halfway::golden {

template <class Preset>
class ObjectMerge {
 public:
  using Word = ObjectWord<Preset>;

  explicit ObjectMerge(int subpixels) : full_((1U << subpixels) - 1) {}

  /// What happens with a word: the own element is output before it, or it is output, or dropped.
  struct Choice {
    bool own, output;
    std::uint32_t mask;  ///< of the output element
  };

  /// `own`: the element of this pixel, or nullptr.
  Choice choose(const Word& in, const Word* own) const {
    if (pending_ && own && !hidden(*own) && (!in.is_element() || own->key() < in.key()))
      return {true, true, own->mask & ~covered_};
    return {false, !(in.is_element() && hidden(in)), in.mask & ~covered_};
  }
  /// The choice was carried out.
  void step(const Word& in, const Choice& choice) {
    if (choice.own || (choice.output && in.is_element())) covered_ |= choice.mask;
    if (choice.own) pending_ = false;
    if (choice.own || in.is_element()) return;
    pending_ = in.is_head();
    covered_ = 0;
  }
  void reset() {
    pending_ = false;
    covered_ = 0;
  }

 private:
  bool hidden(const Word& element) const {
    return element.is_shadow() ? covered_ == full_ : (element.mask & ~covered_) == 0;
  }

  std::uint32_t full_;
  bool pending_ = false;       ///< the own element of this pixel is not output
  std::uint32_t covered_ = 0;  ///< subpixels of the objects that were output
};

}  // namespace halfway::golden
