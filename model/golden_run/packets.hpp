// SPDX-License-Identifier: Apache-2.0
// Init vectors as packets of 32-bit words, which rtl/axi/packet_reader.vhd reads. docs/rtl/axi.md describes
// them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "golden_run/golden_run.hpp"

namespace halfway {

/// As in rtl/axi/axi_pkg.vhd.
enum class PacketKind : std::uint32_t {
  end = 0,       ///< of a frame: no vector
  triangle = 1,  ///< a triangle; of the processors new_object
  record = 2,    ///< of the spherical shader: a line
  load = 3,      ///< of the processors: new_frame, define, redefine, delete
  walk = 4,      ///< of the processors: new_scanline, shadow
};

/// Makes the packets of a frame.
class PacketWriter {
 public:
  explicit PacketWriter(const HardwareKey& key);
  /// Appends the packets of vectors, in the order of the set-up. The vectors of a triangle may come in
  /// several calls.
  void append(std::vector<std::uint32_t>& packets, std::span<const std::uint32_t> init_words);
  /// Appends the end of the frame.
  static void append_end(std::vector<std::uint32_t>& packets);

 private:
  PacketKind kind_of(std::span<const std::uint32_t> vector);

  HardwareKey key_;
  std::unique_ptr<GoldenModel> golden_;
  std::array<std::size_t, 5> words_{};  ///< of the vectors of each kind
  std::size_t records_ = 0;             ///< line records that come next
};

}  // namespace halfway
