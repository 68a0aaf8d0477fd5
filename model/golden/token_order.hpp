// SPDX-License-Identifier: Apache-2.0
// Golden model of rtl/shaders/token_order.vhd: an object's command gives its position relative to the last.
#pragma once

#include <cstdint>
#include <optional>

#include "golden/words.hpp"
#include "words/processors_layout.hpp"

namespace halfway::golden {

class TokenOrder {
 public:
  void new_frame() { previous_.reset(); }
  /// The command of the next object.
  Command place(std::uint32_t y, std::uint32_t x) {
    const Command command = !previous_ || previous_->y != y ? Command::new_scanline
                            : previous_->x == x             ? Command::new_object
                                                            : Command::new_pixel;
    previous_ = {y, x};
    return command;
  }

 private:
  struct Pixel {
    std::uint32_t y, x;
  };
  std::optional<Pixel> previous_;  ///< of the last object, in this frame
};

}  // namespace halfway::golden
