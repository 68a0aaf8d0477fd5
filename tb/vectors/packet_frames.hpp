// SPDX-License-Identifier: Apache-2.0
// A small frame as packets, for each hardware of the testbenches that take packets.
#pragma once

#include <span>
#include <vector>

#include "frame/fragment.hpp"
#include "golden_run/packets.hpp"
#include "plan/plan.hpp"
#include "sim/files/vector_file.hpp"

namespace halfway::vectors {

using PacketWords = std::vector<std::uint32_t>;

/// Appends a fragment as data of AXI4-Stream: as axi_pkg.vhd places its fields.
VectorFile& put_fragment(VectorFile& file, const Fragment& fragment);

struct PacketHardware {
  const char* name;
  PlanRequest plan;
  bool lights = true, shadows = false;
};

/// As c_packet_hardware of tb/rtl/tb_shaders_pkg.vhd.
std::span<const PacketHardware> packet_hardware();

class PacketFrame {
 public:
  PacketFrame(const PacketHardware& hardware, FrameSize size);

  const HardwareKey& key() const { return key_; }
  /// Without the end of the frame.
  const std::vector<PacketWords>& packets() const { return packets_; }
  const std::vector<Fragment>& golden() const { return golden_; }

 private:
  HardwareKey key_;
  std::vector<PacketWords> packets_;
  std::vector<Fragment> golden_;
};

}  // namespace halfway::vectors
