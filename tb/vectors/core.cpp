// SPDX-License-Identifier: Apache-2.0
// Scripts for halfway_core: steps of the host and what must come of them, and all of the memory after each
// frame.
#include <algorithm>
#include <span>

#include "golden/frame_memory.hpp"
#include "plan/plan.hpp"
#include "sim/driver/frame_driver.hpp"
#include "sim/extras/library/halfway_core_registers.h"
#include "sim/files/load_scene.hpp"
#include "sim/files/vector_file.hpp"
#include "vectors/entities.hpp"
#include "vectors/packet_frames.hpp"

namespace halfway::vectors {
namespace {

using golden::FramePlace;
using golden::PixelFormat;

// The memory of the testbench (axi_memory.vhd), and what the host puts where.
constexpr std::uint32_t c_window = 0x7FFC'0000, c_window_bytes = 1 << 17;
constexpr std::uint32_t c_ring = c_window + 0x40;
constexpr std::uint32_t c_packets = c_window + 0x1000, c_buffers = c_window + 0x18000;
constexpr FrameSize c_size{16, 12};

class Script {
 public:
  Script(const PacketHardware& hardware, PixelFormat format)
      : frame_(hardware, c_size), format_(format), bytes_(c_window_bytes), memory_(format, bytes_, c_window) {
    const std::uint32_t row = 64 * pixel_bytes(format);
    for (const PacketWords& packet : frame_.packets())
      packets_.insert(packets_.end(), packet.begin(), packet.end());
    place_ = {.colour_base = c_buffers,
              .colour_stride = row,
              .depth_base = c_buffers + 2 * row * c_size.height,
              .depth_stride = row,
              .width = c_size.width,
              .height = c_size.height,
              .right = c_size.width,
              .bottom = c_size.height};
  }

  void run(bool whole) {
    begin();
    constants();
    draw_frames();
    if (!whole) return;
    refuse_commands();
    refuse_packets();
    break_frames();
    // The third command of a larger ring is not in the place of the first one.
    ring_bits_ = 2;
    begin();
    draw(true, true);
    draw(false, false);
    place_.colour_base = c_buffers;
    draw(true, true);
  }
  void write(const std::filesystem::path& path) const { rows_.write(path); }

 private:
  // The testbench has the same steps.
  enum class Step { set, write, read, wait, compare, reset, pass, memory, any, expect };

  void step(Step step, std::uint32_t a = 0, std::uint32_t b = 0, std::uint32_t c = 0) {
    rows_.word(static_cast<std::uint64_t>(step), 4).word(a, 32).word(b, 32).word(c, 32).end_vector();
  }
  void write_register(std::uint32_t offset, std::uint32_t value, bool error = false) {
    step(Step::write, offset, value, error ? 2 : 0);
  }
  void read_register(std::uint32_t offset, std::uint32_t value, bool error = false) {
    step(Step::read, offset, value, error ? 2 : 0);
  }
  std::uint32_t word_at(std::uint32_t index) const {
    const std::uint8_t* byte = &bytes_[4 * std::size_t{index}];
    return byte[0] | byte[1] << 8 | byte[2] << 16 | std::uint32_t{byte[3]} << 24;
  }
  void set_word(std::uint32_t address, std::uint32_t word) {
    const std::uint32_t index = (address - c_window) / 4;
    if (word_at(index) == word) return;
    step(Step::set, index, word);
    for (std::uint32_t i = 0; i < 4; ++i)
      bytes_[4 * index + i] = expected_[4 * index + i] = static_cast<std::uint8_t>(word >> (8 * i));
  }
  // The words that have changed, and a comparison of all.
  void compare() {
    for (std::uint32_t index = 0; index < c_window_bytes / 4; ++index)
      if (!std::equal(&bytes_[4 * index], &bytes_[4 * index] + 4, &expected_[4 * index]))
        step(Step::expect, index, word_at(index));
    expected_ = bytes_;
    step(Step::compare);
  }
  void set_words(std::uint32_t address, std::span<const std::uint32_t> words) {
    for (const std::uint32_t word : words) set_word(address, word), address += 4;
  }

  // Resets the core and sets it up.
  void begin() {
    step(Step::reset);
    done_ = 0;
    picture_ = 0;
    write_register(HALFWAY_CORE_RING_BASE, c_ring);
    write_register(HALFWAY_CORE_RING_SIZE, ring_bits_);
    write_register(HALFWAY_CORE_INTERRUPT_ENABLE, 3);
    write_register(HALFWAY_CORE_CONTROL, 1);
  }

  void constants() {
    read_register(HALFWAY_CORE_IDENTITY, HALFWAY_CORE_IDENTITY_VALUE);
    read_register(HALFWAY_CORE_VERSION, HALFWAY_CORE_VERSION_VALUE);
    read_register(HALFWAY_CORE_STATUS, 0);
    read_register(HALFWAY_CORE_RING_TAIL, 0);
    read_register(0xFC, 0, true);
    write_register(0xFC, 1, true);
    write_register(HALFWAY_CORE_RING_TAIL, 7, true);
    read_register(HALFWAY_CORE_RING_TAIL, 0);
  }

  std::vector<std::uint32_t> command(bool clear, bool swap) const {
    return {c_packets,
            static_cast<std::uint32_t>(packets_.size()),
            place_.colour_base,
            place_.depth_base,
            place_.colour_stride | place_.depth_stride << 16,
            place_.width | place_.height << 16,
            place_.left | place_.right << 16,
            place_.top | place_.bottom << 16,
            0x12'34'56U | (clear ? HALFWAY_CORE_COMMAND_CLEAR_MASK : 0) |
                (swap ? HALFWAY_CORE_COMMAND_SWAP_MASK : 0) |
                HALFWAY_CORE_COMMAND_KIND_DRAW << HALFWAY_CORE_COMMAND_KIND_SHIFT,
            0,
            0,
            0,
            0,
            0,
            0,
            0};
  }
  // Puts a command into the ring: the core may begin.
  void put(std::span<const std::uint32_t> command, std::uint32_t ahead = 0) {
    set_words(c_ring + 64 * ((done_ + ahead) % (1U << ring_bits_)), command);
    write_register(HALFWAY_CORE_RING_HEAD, done_ + ahead + 1);
  }
  // Waits for the end of `commands` commands, the last of them with these faults.
  void wait_end(std::uint32_t faults, std::uint32_t commands = 1) {
    done_ += commands;
    step(Step::wait, done_);
    read_register(HALFWAY_CORE_FAULTS, faults);
    read_register(HALFWAY_CORE_INTERRUPTS, faults == 0 ? 1 : 3);
    write_register(HALFWAY_CORE_FAULTS, faults);
    write_register(HALFWAY_CORE_INTERRUPTS, 3);
    read_register(HALFWAY_CORE_FAULTS, 0);
    read_register(HALFWAY_CORE_INTERRUPTS, 0);
    read_register(HALFWAY_CORE_PICTURE, picture_);
  }
  // What the frame leaves in memory.
  void expect_frame(bool clear, bool swap) {
    if (clear) memory_.clear(place_, 0x12, 0x34, 0x56);
    for (const Fragment& fragment : frame_.golden()) pixels_ += memory_.draw(place_, fragment) ? 1 : 0;
    fragments_ += static_cast<std::uint32_t>(frame_.golden().size());
    if (swap) picture_ = place_.colour_base;
  }
  void draw(bool clear, bool swap) {
    set_words(c_packets, packets_);
    put(command(clear, swap));
    expect_frame(clear, swap);
    wait_end(0);
    compare();
  }

  void draw_frames() {
    draw(true, true);
    read_register(HALFWAY_CORE_FRAGMENTS, fragments_);
    read_register(HALFWAY_CORE_PIXELS, pixels_);
    // Into the second picture, inside a scissor, at a memory that waits.
    step(Step::memory, 30, 1);
    place_.colour_base += place_.colour_stride * place_.height;
    place_.left = 3, place_.right = 11, place_.top = 2, place_.bottom = 40;
    draw(true, false);
    draw(false, true);
    place_.left = 0, place_.right = c_size.width, place_.top = 0;
    // Two commands at once, and nothing but a clear.
    put(command(true, true));
    put(command(false, false), 1);
    expect_frame(true, true);
    expect_frame(false, false);
    wait_end(0, 2);
    compare();
    std::vector<std::uint32_t> only_clear = command(true, true);
    only_clear[1] = 0;
    put(only_clear);
    memory_.clear(place_, 0x12, 0x34, 0x56);
    wait_end(0);
    compare();
    step(Step::memory, 1, 0);
  }

  // Commands with one bad field are skipped: nothing is drawn.
  void refuse_commands() {
    const std::vector<std::uint32_t> good = command(true, true);
    for (const auto& [word, bits] :
         std::initializer_list<std::pair<std::size_t, std::uint32_t>>{{8, 1U << 28},
                                                                      {8, 1U << 29},
                                                                      {0, 4},
                                                                      {1, 1},
                                                                      {1, 1U << 30},
                                                                      {2, 64},
                                                                      {3, 8},
                                                                      {4, 4},
                                                                      {4, 1U << 20}}) {
      std::vector<std::uint32_t> bad = good;
      bad[word] ^= bits;
      put(bad);
      wait_end(HALFWAY_CORE_FAULTS_COMMAND_MASK);
      compare();
    }
    for (const std::uint32_t sides : {1U << 16, 1U << 16 | 4097, 1U, 4097U << 16 | 1, 8191U << 16 | 1}) {
      std::vector<std::uint32_t> bad = good;
      bad[5] = sides;
      put(bad);
      wait_end(HALFWAY_CORE_FAULTS_COMMAND_MASK);
    }
    draw(true, true);
  }

  // A frame with a bad packet ends with its cause; the next one is drawn.
  void refuse_packets() {
    const PacketWords good = packets_;
    const std::size_t at = frame_.packets().front().size();
    packets_[at] ^= 8U;
    fail(HALFWAY_CORE_FAULTS_WRONG_KIND_MASK);
    packets_ = good;
    packets_.resize(packets_.size() - 2);
    fail(HALFWAY_CORE_FAULTS_WRONG_LENGTH_MASK);
    packets_ = good;
    draw(true, true);
    // A packet of kind 0 ends the frame: what follows is not drawn.
    PacketWriter::append_end(packets_);
    packets_.insert(packets_.end(), good.begin(), good.end());
    draw(true, true);
    packets_ = good;
    draw(true, true);
  }
  // Draws a frame that ends with these faults. Its pixels are not compared.
  void fail(std::uint32_t faults) {
    set_words(c_packets, packets_);
    put(command(true, true));
    wait_end(faults);
  }

  // An abort, error responses of the memory, and a reset in the middle of a frame.
  void break_frames() {
    step(Step::memory, 30, 0);
    for (const std::uint32_t clocks : {1U, 40U, 120U, 300U}) {
      put(command(true, true));
      step(Step::pass, clocks);
      write_register(HALFWAY_CORE_CONTROL, 3);
      wait_end(HALFWAY_CORE_FAULTS_ABORTED_MASK);
      draw(true, true);
    }
    for (const std::uint32_t clocks : {20U, 100U, 300U}) {
      put(command(true, true));
      step(Step::pass, clocks);
      begin();
      draw(true, true);
    }
    for (std::uint32_t errors = 1; errors < 6; ++errors) {
      step(Step::memory, 1, 0, errors);
      put(command(true, true));
      step(Step::wait, ++done_);
      step(Step::memory, 1, 0);
      step(Step::any, HALFWAY_CORE_FAULTS, HALFWAY_CORE_FAULTS_MEMORY_MASK | HALFWAY_CORE_FAULTS_READ_MASK);
      write_register(HALFWAY_CORE_FAULTS, 0xFF);
      write_register(HALFWAY_CORE_INTERRUPTS, 3);
      draw(true, true);
    }
  }

  PacketFrame frame_;
  PixelFormat format_;
  std::vector<std::uint8_t> bytes_, expected_ = bytes_;  ///< memory, and what the testbench expects of it
  golden::FrameMemory memory_;
  FramePlace place_;
  PacketWords packets_;
  VectorFile rows_;
  std::uint32_t ring_bits_ = 1, done_ = 0, picture_ = 0, fragments_ = 0, pixels_ = 0;
};

// In the stimulus of `make test` the first three hardwares have the whole script: both formats and both
// widths of the bus. The others only draw.
template <bool is_short>
void write_core(const Folder& folder) {
  constexpr int c_whole = 3;
  int number = 0;
  for (const PacketHardware& hardware : packet_hardware()) {
    // As in tb/rtl/core/halfway_core_tb.vhd.
    Script script(hardware, number % 4 < 2 ? PixelFormat::rgb565 : PixelFormat::xrgb8888);
    script.run(!is_short || number < c_whole);
    ++number;
    script.write(folder / (std::string(hardware.name) + ".txt"));
  }
}

}  // namespace

std::vector<Entity> core_entities() {
  return {{"halfway_core", write_core<false>}, {"short/halfway_core", write_core<true>}};
}

}  // namespace halfway::vectors
