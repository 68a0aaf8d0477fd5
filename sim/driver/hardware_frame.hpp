// SPDX-License-Identifier: Apache-2.0
// The frame that hardware draws: its fragments counted, limited and assembled, and its fault.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string>

#include "common/result.hpp"
#include "frame/assemble.hpp"

namespace halfway {

class HardwareFrame {
 public:
  HardwareFrame(FrameSize size, const Tile& tile, glm::dvec3 background)
      : assembler_(size, tile, background) {}

  /// Starts another frame in the same memory.
  void clear();

  /// Adds to the number of fragments that the vectors so far must give.
  void expect(std::uint64_t fragments) { expected_ += fragments; }
  /// Upper limit of further fragments: the expected ones and a surplus. More means that the hardware runs
  /// away.
  std::uint64_t most() const;
  /// Takes the result of drawing. A fault of the hardware ends the drawing, but is not an error; other errors
  /// are returned.
  Status ended(const Status& drawn);
  /// Counts fragments and adds them to the picture. Wrong hardware may draw outside the frame: this is a
  /// fault, and the picture contains only the fragments inside.
  void add(std::span<const Fragment> fragments);

  std::uint64_t fragments() const { return fragments_; }
  const std::string& fault() const { return fault_; }  ///< empty: none
  /// False after a fault: later fragments are invalid.
  bool alive() const { return alive_; }
  const FrameAssembler& assembler() const { return assembler_; }

 private:
  FrameAssembler assembler_;
  std::uint64_t expected_ = 0, fragments_ = 0;
  std::string fault_;
  bool alive_ = true;
};

}  // namespace halfway
