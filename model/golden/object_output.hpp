// SPDX-License-Identifier: Apache-2.0
// Golden model of rtl/objects/object_output.vhd: converts sorted lists to tokens of the shading processors.
#pragma once

#include <cstdint>

#include "golden/object_word.hpp"

namespace halfway::golden {

template <class Preset>
class ObjectOutput {
 public:
  using Word = ObjectWord<Preset>;
  using Token = ShadingToken<Preset>;

  /// `filtered`: for the filter, each head is a token, and the end of a strip is one.
  ObjectOutput(const ProcessorsConfig& config, bool filtered) : config_(config), filtered_(filtered) {}

  /// Takes a word, and calls emit(token, mask, ends) for each token. ends: the strip has ended.
  template <class Emit>
  void take(const Word& in, Emit&& emit) {
    if (in.kind == ObjectKind::part) fault_ = true;
    if (in.kind == ObjectKind::strip_end && filtered_) {
      Token end;
      end.command = Command::new_frame;
      emit(end, 0U, true);
    }
    if (in.kind != ObjectKind::item) return;
    if (in.is_head()) {
      pixel_ = true;
      line_ = line_ || in.is_item(Command::new_scanline);
      y_ = in.token.y;
      x_ = in.token.x;
      if (filtered_) emit(in.token, 0U, false);
      return;
    }
    Token token = in.token;
    if (in.is_element()) {
      if (pixel_ && config_.shadows && !filtered_) {
        Token head;
        head.command = line_ ? Command::new_scanline : Command::new_pixel;
        head.y = y_;
        head.x = x_;
        emit(head, 0U, false);
        pixel_ = line_ = false;
      }
      token.y = y_;
      token.x = x_;
    }
    emit(token, in.mask, false);
  }

  bool fault() const { return fault_; }

 private:
  ProcessorsConfig config_;
  bool filtered_;
  bool pixel_ = false;  ///< no token of this pixel was output
  bool line_ = false;   ///< no token of this line was output
  bool fault_ = false;
  std::uint32_t y_ = 0, x_ = 0;
};

}  // namespace halfway::golden
