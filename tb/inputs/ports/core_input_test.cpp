// SPDX-License-Identifier: Apache-2.0
// Bad input at the ports of halfway_core in Verilator: accesses to registers, random packets, error responses
// of the memory. Each command must end within a bounded number of clocks, with the bits of its faults. Then
// the next frame must be golden, in every byte of the memory, without a reset in between. Bad commands,
// aborts and resets: tb/vectors/core.cpp.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <random>
#include <string>
#include <vector>

#include "golden/frame_memory.hpp"
#include "golden_run/packets.hpp"
#include "inputs/ports/bad_packets.hpp"
#include "plan/plan.hpp"
#include "setup/setup.hpp"
#include "sim/driver/frame_driver.hpp"
#include "sim/extras/core/core_simulator.hpp"
#include "sim/extras/library/halfway_core_registers.h"
#include "sim/files/load_scene.hpp"
#include "sim/os/must.hpp"

namespace halfway::core {
namespace {

using Command = std::array<std::uint32_t, HALFWAY_CORE_COMMAND_WORDS>;

constexpr FrameSize c_frame{16, 12};
// Places in memory. The buffers have gaps around them, which must stay as they are.
constexpr std::uint32_t c_origin = 0x2000'0000, c_bytes = 1 << 18, c_ring = c_origin + 0x100;
constexpr std::uint32_t c_colour = c_origin + 0x1000, c_depth = c_origin + 0x4000;
constexpr std::uint32_t c_stride = 0x200, c_packets = c_origin + 0x8000;
constexpr std::uint32_t c_ring_bits = 1;
/// A limit of the shader that ends a bad frame soon: at least twice the clocks of a triangle of the scene.
constexpr unsigned c_limit_bits = 12;
/// More than any command here takes.
constexpr std::uint64_t c_most_clocks = 200'000;
constexpr int c_random_frames = 100;
constexpr std::uint8_t c_slave_error = 2;  // of AXI4-Lite

const SimulatorFolders c_folders{HALFWAY_SOURCE_DIR, HALFWAY_CACHE_DIR};

std::vector<std::uint8_t> random_bytes() {
  std::mt19937 random(1);
  std::vector<std::uint8_t> bytes(c_bytes);
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
  return bytes;
}

class CoreInput : public testing::Test {
 protected:
  CoreInput() {
    core_.memory().connect(bytes_, c_origin);
    const FrameStream stream = must(whole_stream(scene_, c_frame, key_.shader));
    PacketWriter(key_.shader).append(good_, stream.words);
    put_words(c_packets, good_);
    golden_ = stream.golden;
    // Set the registers, as a driver does.
    write(HALFWAY_CORE_RING_BASE, c_ring);
    write(HALFWAY_CORE_RING_SIZE, c_ring_bits);
    write(HALFWAY_CORE_INTERRUPT_ENABLE,
          HALFWAY_CORE_INTERRUPT_ENABLE_FRAME_MASK | HALFWAY_CORE_INTERRUPT_ENABLE_FAULT_MASK);
    write(HALFWAY_CORE_CONTROL, HALFWAY_CORE_CONTROL_ENABLE_MASK);
  }

  std::uint32_t read(std::uint32_t address) {
    const auto answer = core_.read(address);
    EXPECT_EQ(answer.response, 0) << address;
    return answer.value;
  }
  void write(std::uint32_t address, std::uint32_t value) {
    EXPECT_EQ(core_.write(address, value), 0) << address;
  }
  void put_words(std::uint32_t address, std::span<const std::uint32_t> words) {
    for (std::uint32_t word : words)
      for (int i = 0; i < 4; ++i, word >>= 8) bytes_[address++ - c_origin] = static_cast<std::uint8_t>(word);
  }

  /// Draws the frame and makes it the picture.
  Command good_command() const {
    return {c_packets,
            static_cast<std::uint32_t>(good_.size()),
            c_colour,
            c_depth,
            c_stride << 16 | c_stride,
            c_frame.height << 16 | c_frame.width,
            c_frame.width << 16,
            c_frame.height << 16,
            1U << HALFWAY_CORE_COMMAND_KIND_SHIFT | HALFWAY_CORE_COMMAND_CLEAR_MASK |
                HALFWAY_CORE_COMMAND_SWAP_MASK | 0x203040};
  }
  /// Puts the command into the ring and waits for its end. Returns its faults and clears them.
  std::uint32_t faults_of(const Command& command) {
    put_words(c_ring + head_ % (1 << c_ring_bits) * 4 * HALFWAY_CORE_COMMAND_WORDS, command);
    write(HALFWAY_CORE_RING_HEAD, ++head_);
    core_.wait(c_most_clocks);
    const std::uint32_t faults = read(HALFWAY_CORE_FAULTS), interrupts = read(HALFWAY_CORE_INTERRUPTS);
    EXPECT_EQ(read(HALFWAY_CORE_RING_TAIL), head_);
    EXPECT_EQ(interrupts,
              HALFWAY_CORE_INTERRUPTS_FRAME_MASK | (faults != 0 ? HALFWAY_CORE_INTERRUPTS_FAULT_MASK : 0));
    write(HALFWAY_CORE_FAULTS, faults);
    write(HALFWAY_CORE_INTERRUPTS, interrupts);
    for (int i = 0; i < 4; ++i) core_.clock();
    EXPECT_FALSE(core_.interrupt());
    return faults;
  }
  std::uint32_t faults_of(const std::vector<std::uint32_t>& packets) {
    put_words(c_packets, packets);
    Command command = good_command();
    command[HALFWAY_CORE_COMMAND_PACKET_WORDS_WORD] = static_cast<std::uint32_t>(packets.size() / 2 * 2);
    return faults_of(command);
  }

  /// What a bad command has written outside of the frame is found here, too.
  void expect_a_golden_frame() {
    put_words(c_packets, good_);
    EXPECT_EQ(faults_of(good_command()), 0U);
    EXPECT_EQ(core_.picture(), c_colour);
    std::vector<std::uint8_t> expected = before_;
    const auto keep = [&](std::uint32_t address, std::size_t count) {
      std::copy_n(bytes_.begin() + (address - c_origin), count, expected.begin() + (address - c_origin));
    };
    keep(c_ring, 4 * HALFWAY_CORE_COMMAND_WORDS << c_ring_bits);
    keep(c_packets, 4 * (good_.size() + 2));
    const golden::FramePlace place{.colour_base = c_colour,
                                   .colour_stride = c_stride,
                                   .depth_base = c_depth,
                                   .depth_stride = c_stride,
                                   .width = c_frame.width,
                                   .height = c_frame.height,
                                   .right = c_frame.width,
                                   .bottom = c_frame.height};
    golden::FrameMemory memory(key_.format, expected, c_origin);
    memory.clear(place, 0x20, 0x30, 0x40);
    for (const Fragment& fragment : golden_) memory.draw(place, fragment);
    EXPECT_EQ(bytes_, expected);
  }

  const Scene scene_ =
      must(load_scene(HALFWAY_SOURCE_DIR "/sim/report/timing.toml", c_folders.source / "sim/scenes"));
  const CoreKey key_{.shader = must(plan_scene(scene_, {})).key, .bus_bits = 32, .limit_bits = c_limit_bits};
  std::vector<std::uint8_t> bytes_ = random_bytes(), before_ = bytes_;
  std::vector<std::uint32_t> good_;  ///< packets
  std::vector<Fragment> golden_;
  std::uint32_t head_ = 0;  ///< number of commands since the reset
  CoreSimulator core_{key_, {}, c_folders};
};

TEST_F(CoreInput, RegistersRefuseWhatTheyAreNot) {
  constexpr std::uint32_t c_read_only[] = {
      HALFWAY_CORE_IDENTITY,    HALFWAY_CORE_VERSION,       HALFWAY_CORE_SHADER,    HALFWAY_CORE_LIGHTS,
      HALFWAY_CORE_OBJECTS,     HALFWAY_CORE_MEMORY,        HALFWAY_CORE_STATUS,    HALFWAY_CORE_RING_TAIL,
      HALFWAY_CORE_PICTURE,     HALFWAY_CORE_PIXELS,        HALFWAY_CORE_TRIANGLES, HALFWAY_CORE_FRAGMENTS,
      HALFWAY_CORE_BUSY_CLOCKS, HALFWAY_CORE_STALLED_CLOCKS};
  for (const std::uint32_t address : c_read_only) {
    const std::uint32_t value = read(address);
    EXPECT_EQ(core_.write(address, ~value), c_slave_error) << address;
    EXPECT_EQ(read(address), value) << address;
  }
  for (std::uint32_t address = HALFWAY_CORE_STALLED_CLOCKS + 4; address < 256; address += 4) {
    EXPECT_EQ(core_.write(address, ~0U), c_slave_error) << address;
    const auto answer = core_.read(address);
    EXPECT_EQ(answer.response, c_slave_error) << address;
    EXPECT_EQ(answer.value, 0U) << address;
  }
  // Only the bytes with a strobe are written. The core takes no command meanwhile.
  write(HALFWAY_CORE_CONTROL, 0);
  write(HALFWAY_CORE_RING_HEAD, 0x11223344);
  for (unsigned strobes = 0; strobes < 16; ++strobes) {
    std::uint32_t expected = 0x11223344;
    for (unsigned byte = 0; byte < 4; ++byte)
      if ((strobes >> byte & 1) != 0) expected |= 0xffU << (8 * byte);
    EXPECT_EQ(core_.write(HALFWAY_CORE_RING_HEAD, ~0U, strobes), 0);
    EXPECT_EQ(read(HALFWAY_CORE_RING_HEAD), expected);
    write(HALFWAY_CORE_RING_HEAD, 0x11223344);
  }
  write(HALFWAY_CORE_RING_HEAD, head_);
  write(HALFWAY_CORE_CONTROL, HALFWAY_CORE_CONTROL_ENABLE_MASK);
  expect_a_golden_frame();
}

TEST_F(CoreInput, RandomPacketsEnd) {
  std::mt19937_64 random(1);
  int faults = 0;
  for (int i = 0; i < c_random_frames; ++i) {
    faults += faults_of(bad_packets(good_, random)) != 0 ? 1 : 0;
    expect_a_golden_frame();
    if (HasFailure()) FAIL() << "bad frame " << i;
  }
  // Some bad frames are faulty, others only draw wrong fragments.
  EXPECT_GT(faults, 0);
  EXPECT_LT(faults, c_random_frames);
}

TEST_F(CoreInput, ErrorResponsesAreFaults) {
  constexpr std::uint32_t c_read = HALFWAY_CORE_FAULTS_READ_MASK, c_memory = HALFWAY_CORE_FAULTS_MEMORY_MASK;
  for (const auto& [address, fault] : {std::pair(c_ring, c_read),
                                       {c_packets, c_read},
                                       {c_packets + 4 * static_cast<std::uint32_t>(good_.size()) - 8, c_read},
                                       {c_depth + 5 * c_stride, c_memory},
                                       {c_colour + 6 * c_stride, c_memory}}) {
    core_.memory().refuse(address, 2 * 4 * HALFWAY_CORE_COMMAND_WORDS);
    EXPECT_EQ(faults_of(good_command()) & fault, fault) << address;
    core_.memory().refuse(0, 0);
    expect_a_golden_frame();
  }
}

}  // namespace
}  // namespace halfway::core
