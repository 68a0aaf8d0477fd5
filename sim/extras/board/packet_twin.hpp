// SPDX-License-Identifier: Apache-2.0
// The twin of the board for packets: draws them by the golden model, and gives the pictures that the monitor
// may show.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <span>

#include "golden_run/golden_run.hpp"
#include "sim/extras/board/board_picture.hpp"

namespace halfway::board {

class PacketTwin {
 public:
  PacketTwin();

  /// A packet that the board has received completely, with the status byte that it returned. Packets that the
  /// board drops change nothing.
  void take(std::span<const std::uint8_t> packet, std::uint8_t status);

  /// A picture of the monitor. Returns false if it is neither the one before nor the next frame.
  bool shows(const DotPicture& dots);
  /// Number of ended frames that the monitor has not shown.
  std::size_t pending() const { return ended_.size(); }

 private:
  std::unique_ptr<GoldenModel> golden_;
  BoardPicture back_;
  DotPicture shown_;
  std::deque<DotPicture> ended_;  ///< frames that are not shown yet
};

}  // namespace halfway::board
