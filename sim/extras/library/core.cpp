// SPDX-License-Identifier: Apache-2.0
// The driver of halfway_core.
#include <fmt/format.h>

#include <array>
#include <atomic>
#include <bit>
#include <cstring>
#include <span>
#include <string_view>

#include "golden_run/packets.hpp"
#include "sim/extras/library/halfway_core.h"
#include "sim/extras/library/halfway_core_registers.h"
#include "sim/extras/library/objects.hpp"

namespace halfway::library {
namespace {

// A command and its packets have one of two places, a picture one of two, too.
constexpr std::uint32_t c_commands_log2 = 1, c_commands = 1U << c_commands_log2, c_pictures = 2;
constexpr std::size_t c_command_bytes = std::size_t{4} * HALFWAY_CORE_COMMAND_WORDS;
constexpr std::uint32_t c_default_polls = 100'000'000;

constexpr std::uint32_t field(std::uint32_t word, std::uint32_t mask) {
  return (word & mask) >> std::countr_zero(mask);
}

constexpr std::size_t rounded_up(std::size_t size, std::size_t unit) {
  return (size + unit - 1) / unit * unit;
}

/// The parts of the memory. Offsets are relative to an address that is a multiple of `alignment`.
struct Places {
  bool true_colour;
  std::uint32_t stride;
  std::size_t alignment;
  std::array<std::size_t, c_commands> packets;
  std::array<std::size_t, c_pictures> pictures;
  std::size_t depth, size;
};

Places places_of(std::uint32_t memory_register, const halfway_core_layout& layout) {
  Places places{};
  places.true_colour = (memory_register & HALFWAY_CORE_MEMORY_TRUE_COLOUR_MASK) != 0;
  const std::size_t pixel_bytes = places.true_colour ? 4 : 2;
  const std::size_t block = pixel_bytes << field(memory_register, HALFWAY_CORE_MEMORY_BLOCK_BITS_MASK);
  places.alignment = std::max(block, c_command_bytes);
  places.stride = static_cast<std::uint32_t>(rounded_up(layout.width * pixel_bytes, block));
  std::size_t end = c_commands * c_command_bytes;
  const auto next = [&](std::size_t bytes) {
    const std::size_t start = rounded_up(end, places.alignment);
    end = start + bytes;
    return start;
  };
  for (std::size_t& packets : places.packets) packets = next(4 * layout.packet_words);
  const std::size_t buffer = std::size_t{places.stride} * layout.height;
  for (std::size_t& picture : places.pictures) picture = next(buffer);
  places.depth = next(buffer);
  places.size = end;
  return places;
}

std::uint32_t read(const halfway_core_access& access, std::uint32_t offset) {
  return access.read(access.context, offset);
}

void write(const halfway_core_access& access, std::uint32_t offset, std::uint32_t value) {
  access.write(access.context, offset, value);
}

Status check_layout(const halfway_core_access& access, const halfway_core_layout& layout) {
  if (Status status = check_frame(layout.width, layout.height); !status) return status.error();
  if (layout.packet_words > UINT32_MAX / 16)
    return bad_input(fmt::format("core: {} packet words are too many", layout.packet_words));
  const std::uint32_t identity = read(access, HALFWAY_CORE_IDENTITY);
  if (identity != HALFWAY_CORE_IDENTITY_VALUE)
    return bad_input(fmt::format("core: the register identity is {:08X}, not {:08X}: no halfway_core is here",
                                 identity, HALFWAY_CORE_IDENTITY_VALUE));
  const auto major = [](std::uint32_t version) { return field(version, HALFWAY_CORE_VERSION_MAJOR_MASK); };
  const std::uint32_t version = read(access, HALFWAY_CORE_VERSION);
  if (major(version) != major(HALFWAY_CORE_VERSION_VALUE))
    return bad_input(fmt::format("core: has version {}, but this driver is for version {}", major(version),
                                 major(HALFWAY_CORE_VERSION_VALUE)));
  return Ok{};
}

std::uint32_t polls_of(const halfway_core_layout& layout) {
  return layout.polls == 0 ? c_default_polls : layout.polls;
}

/// Read until no command is worked on.
bool becomes_idle(const halfway_core_access& access, std::uint32_t polls) {
  for (; polls > 0; --polls)
    if ((read(access, HALFWAY_CORE_STATUS) & HALFWAY_CORE_STATUS_BUSY_MASK) == 0) return true;
  return false;
}

/// Take no more commands, and end the one that is worked on.
bool stop(const halfway_core_access& access, std::uint32_t polls) {
  write(access, HALFWAY_CORE_CONTROL, 0);
  if (becomes_idle(access, 1)) return true;
  write(access, HALFWAY_CORE_CONTROL, HALFWAY_CORE_CONTROL_ABORT_MASK);
  return becomes_idle(access, polls);
}

/// A field that the core must have for the vectors of a key.
struct Need {
  const char* name;
  std::uint32_t offset, mask, value;
};

std::vector<Need> needs_of(const HardwareKey& key) {
  static_assert(static_cast<int>(Shader::quadratic) == HALFWAY_CORE_SHADER_KIND_QUADRATIC);
  static_assert(static_cast<int>(Shader::spherical) == HALFWAY_CORE_SHADER_KIND_SPHERICAL);
  static_assert(static_cast<int>(Shader::processors) == HALFWAY_CORE_SHADER_KIND_PROCESSORS);
  std::vector<Need> needs;
  const auto need = [&](const char* name, std::uint32_t offset, std::uint32_t mask, auto value) {
    needs.push_back({name, offset, mask, static_cast<std::uint32_t>(value)});
  };
  need("shader.kind", HALFWAY_CORE_SHADER, HALFWAY_CORE_SHADER_KIND_MASK, key.shader);
  need("shader.exact", HALFWAY_CORE_SHADER, HALFWAY_CORE_SHADER_EXACT_MASK, key.preset == Preset::exact);
  need("shader.channels", HALFWAY_CORE_SHADER, HALFWAY_CORE_SHADER_CHANNELS_MASK, key.channels);
  if (key.shader == Shader::quadratic)
    need("shader.degree", HALFWAY_CORE_SHADER, HALFWAY_CORE_SHADER_DEGREE_MASK, key.degree);
  const auto need_effects = [&](bool diffuse, bool specular) {
    need("shader.diffuse", HALFWAY_CORE_SHADER, HALFWAY_CORE_SHADER_DIFFUSE_MASK, diffuse);
    need("shader.specular", HALFWAY_CORE_SHADER, HALFWAY_CORE_SHADER_SPECULAR_MASK, specular);
  };
  if (key.shader == Shader::spherical) {
    const SphericalUnits& s = key.spherical;
    need_effects(s.diffuse, s.specular);
    need("lights.lights", HALFWAY_CORE_LIGHTS, HALFWAY_CORE_LIGHTS_LIGHTS_MASK, s.lights);
    if (s.specular) {
      need("shader.highlight_channels", HALFWAY_CORE_SHADER, HALFWAY_CORE_SHADER_HIGHLIGHT_CHANNELS_MASK,
           s.highlight_channels);
      need("objects.powers", HALFWAY_CORE_OBJECTS, HALFWAY_CORE_OBJECTS_POWERS_MASK, s.powers);
    }
    if (s.records()) {
      need("shader.table_address_bits", HALFWAY_CORE_SHADER, HALFWAY_CORE_SHADER_TABLE_ADDRESS_BITS_MASK,
           s.tables.address_bits);
      need("shader.table_data_bits", HALFWAY_CORE_SHADER, HALFWAY_CORE_SHADER_TABLE_DATA_BITS_MASK,
           s.tables.data_bits);
    }
  }
  if (key.shader == Shader::processors) {
    const ProcessorUnits& p = key.processors;
    need_effects(p.diffuse, p.specular);
    need("lights.directional", HALFWAY_CORE_LIGHTS, HALFWAY_CORE_LIGHTS_DIRECTIONAL_MASK, p.directional);
    need("lights.positional", HALFWAY_CORE_LIGHTS, HALFWAY_CORE_LIGHTS_POSITIONAL_MASK, p.positional);
    need("lights.spots", HALFWAY_CORE_LIGHTS, HALFWAY_CORE_LIGHTS_SPOTS_MASK, p.spots);
    need("shader.normalize", HALFWAY_CORE_SHADER, HALFWAY_CORE_SHADER_NORMALIZE_MASK, p.normalize);
    need("shader.shadows", HALFWAY_CORE_SHADER, HALFWAY_CORE_SHADER_SHADOWS_MASK, p.shadows);
    need("objects.objects", HALFWAY_CORE_OBJECTS, HALFWAY_CORE_OBJECTS_OBJECTS_MASK, p.objects);
    need("objects.subpixels", HALFWAY_CORE_OBJECTS, HALFWAY_CORE_OBJECTS_SUBPIXELS_MASK, p.subpixels);
  }
  return needs;
}

std::vector<std::uint32_t> packets_of(const halfway_vectors& vectors) {
  std::vector<std::uint32_t> packets;
  PacketWriter(vectors.key).append(packets, vectors.words);
  return packets;
}

std::string names_of_faults(std::uint32_t faults) {
  struct Fault {
    std::uint32_t mask;
    const char* name;
  };
  constexpr Fault c_faults[] = {{HALFWAY_CORE_FAULTS_WRONG_KIND_MASK, "wrong_kind"},
                                {HALFWAY_CORE_FAULTS_WRONG_LENGTH_MASK, "wrong_length"},
                                {HALFWAY_CORE_FAULTS_SHADER_MASK, "shader"},
                                {HALFWAY_CORE_FAULTS_LIMIT_MASK, "limit"},
                                {HALFWAY_CORE_FAULTS_MEMORY_MASK, "memory"},
                                {HALFWAY_CORE_FAULTS_READ_MASK, "read"},
                                {HALFWAY_CORE_FAULTS_COMMAND_MASK, "command"},
                                {HALFWAY_CORE_FAULTS_ABORTED_MASK, "aborted"}};
  std::string names;
  for (const Fault& fault : c_faults)
    if ((faults & fault.mask) != 0) names += (names.empty() ? "" : ", ") + std::string(fault.name);
  return names;
}

}  // namespace
}  // namespace halfway::library

using namespace halfway;
using namespace halfway::library;

struct halfway_core {
  halfway_core_access access;
  halfway_core_layout layout;
  Places places;
  std::uint8_t* bytes = nullptr;  ///< at the aligned address
  std::uint32_t address = 0;      ///< the same as the core sees it
  std::uint32_t head = 0;         ///< number of commands that were queued
  std::size_t picture = 0;        ///< in which the last queued frame is drawn
  bool queued = false;            ///< a frame was queued

  std::uint32_t at(std::size_t offset) const { return address + static_cast<std::uint32_t>(offset); }

  /// Wait until at most `count` commands are not done. Return their number.
  Result<std::uint32_t> wait_for(std::uint32_t count) const {
    std::uint32_t last = head, polls = 0;
    for (;;) {
      // Clear the interrupt first: a command that ends after the read of its number sets it again.
      if (access.wait) write(access, HALFWAY_CORE_INTERRUPTS, HALFWAY_CORE_INTERRUPTS_FRAME_MASK);
      const std::uint32_t tail = read(access, HALFWAY_CORE_RING_TAIL);
      if (head - tail <= count) {
        std::atomic_thread_fence(std::memory_order_seq_cst);
        return head - tail;
      }
      if (tail != last) polls = 0;
      last = tail;
      if (polls++ == polls_of(layout))
        return tool_failed(fmt::format("core: command {} does not end; status is {:X}", tail,
                                       read(access, HALFWAY_CORE_STATUS)));
      if (access.wait) access.wait(access.context);
    }
  }

  bool is_finished(std::size_t number) const {
    return read(access, HALFWAY_CORE_PICTURE) == at(places.pictures[number]);
  }

  /// Refuse a key whose vectors are not those of the core.
  Status check(const HardwareKey& key) const {
    for (const Need& need : needs_of(key))
      if (const std::uint32_t value = field(read(access, need.offset), need.mask); value != need.value)
        return bad_input(fmt::format("core: its {} is {}, but the vectors of {} need {}", need.name, value,
                                     key.name(), need.value));
    return Ok{};
  }

  /// The words of the next command.
  std::array<std::uint32_t, HALFWAY_CORE_COMMAND_WORDS> command(std::size_t packet_words,
                                                                const halfway_core_frame& frame) const {
    const bool whole = frame.width == 0 || frame.height == 0;
    std::array<std::uint32_t, HALFWAY_CORE_COMMAND_WORDS> words{};
    const auto put = [&](std::uint32_t word, std::uint32_t shift, std::size_t value) {
      words[word] |= static_cast<std::uint32_t>(value) << shift;
    };
#define HALFWAY_PUT(FIELD, VALUE) \
  put(HALFWAY_CORE_COMMAND_##FIELD##_WORD, HALFWAY_CORE_COMMAND_##FIELD##_SHIFT, VALUE)
    HALFWAY_PUT(PACKETS, at(places.packets[head % c_commands]));
    HALFWAY_PUT(PACKET_WORDS, packet_words);
    HALFWAY_PUT(COLOUR_BASE, at(places.pictures[picture]));
    HALFWAY_PUT(DEPTH_BASE, at(places.depth));
    HALFWAY_PUT(COLOUR_STRIDE, places.stride);
    HALFWAY_PUT(DEPTH_STRIDE, places.stride);
    HALFWAY_PUT(WIDTH, layout.width);
    HALFWAY_PUT(HEIGHT, layout.height);
    HALFWAY_PUT(LEFT, whole ? 0 : frame.left);
    HALFWAY_PUT(RIGHT, whole ? layout.width : frame.left + frame.width);
    HALFWAY_PUT(TOP, whole ? 0 : frame.top);
    HALFWAY_PUT(BOTTOM, whole ? layout.height : frame.top + frame.height);
    HALFWAY_PUT(RED, frame.clear_colour[0]);
    HALFWAY_PUT(GREEN, frame.clear_colour[1]);
    HALFWAY_PUT(BLUE, frame.clear_colour[2]);
    HALFWAY_PUT(CLEAR, frame.keep == 0);
    HALFWAY_PUT(SWAP, 1);
    HALFWAY_PUT(KIND, HALFWAY_CORE_COMMAND_KIND_DRAW);
#undef HALFWAY_PUT
    return words;
  }

  Status queue(const halfway_vectors& vectors, const halfway_core_frame& frame) {
    if (Status status = check(vectors.key); !status) return status;
    if (frame.left > layout.width || frame.width > layout.width - frame.left || frame.top > layout.height ||
        frame.height > layout.height - frame.top)
      return bad_input(fmt::format("core: {}x{} pixels at {}, {} are not inside the frame, {}x{}",
                                   frame.width, frame.height, frame.left, frame.top, layout.width,
                                   layout.height));
    if (frame.keep != 0 && !queued) return bad_input("core: no frame was queued that this one could keep");
    const std::vector<std::uint32_t> packets = packets_of(vectors);
    if (packets.size() > layout.packet_words)
      return bad_input(fmt::format("core: the frame has {} packet words, but the layout has {}",
                                   packets.size(), layout.packet_words));
    const Result<std::uint32_t> waiting = wait_for(c_commands - 1);
    if (!waiting) return waiting.error();
    // Not the picture of the last frame; if that had a fault, the one that it was drawn into again.
    if (frame.keep == 0 && (*waiting > 0 || is_finished(picture))) picture = (picture + 1) % c_pictures;
    const auto words = command(packets.size(), frame);
    if (!packets.empty())
      std::memcpy(bytes + places.packets[head % c_commands], packets.data(), 4 * packets.size());
    std::memcpy(bytes + c_command_bytes * (head % c_commands), words.data(), sizeof words);
    // The core sees command and packets before it sees their number.
    std::atomic_thread_fence(std::memory_order_seq_cst);
    write(access, HALFWAY_CORE_RING_HEAD, ++head);
    queued = true;
    return Ok{};
  }

  Status wait_all() const {
    if (const auto waiting = wait_for(0); !waiting) return waiting.error();
    const std::uint32_t faults = read(access, HALFWAY_CORE_FAULTS);
    if (faults == 0) return Ok{};
    write(access, HALFWAY_CORE_FAULTS, faults);
    return Error{ExitCode::differs, "core: faults: " + names_of_faults(faults)};
  }

  Status read_picture(std::uint8_t* rgb) const {
    for (std::size_t number = 0; number < c_pictures; ++number) {
      if (!is_finished(number)) continue;
      std::atomic_thread_fence(std::memory_order_seq_cst);
      for (std::size_t y = 0; y < layout.height; ++y)
        rgb = read_row(bytes + places.pictures[number] + y * places.stride, rgb);
      return Ok{};
    }
    return bad_input("core: no frame has been finished");
  }

  /// Write the pixels of a row as bytes. Channels of 5 and 6 bits repeat their upper bits.
  std::uint8_t* read_row(const std::uint8_t* row, std::uint8_t* rgb) const {
    const auto wide = [](unsigned value, unsigned bits) {
      return static_cast<std::uint8_t>(value << (8 - bits) | value >> (2 * bits - 8));
    };
    for (std::uint32_t x = 0; x < layout.width; ++x) {
      if (places.true_colour) {
        for (const int channel : {2, 1, 0}) *rgb++ = row[4 * x + channel];
      } else {
        const unsigned pixel = row[2 * x] | static_cast<unsigned>(row[2 * x + 1]) << 8;
        *rgb++ = wide(pixel >> 11, 5);
        *rgb++ = wide(pixel >> 5 & 63, 6);
        *rgb++ = wide(pixel & 31, 5);
      }
    }
    return rgb;
  }
};

uint32_t halfway_mapped_read(void* registers, uint32_t offset) {
  return static_cast<volatile std::uint32_t*>(registers)[offset / 4];
}

void halfway_mapped_write(void* registers, uint32_t offset, uint32_t value) {
  static_cast<volatile std::uint32_t*>(registers)[offset / 4] = value;
}

size_t halfway_packet_words(const halfway_vectors* vectors) {
  return packets_of(*vectors).size();
}

size_t halfway_core_bytes(const halfway_core_access* access, const halfway_core_layout* layout,
                          halfway_error* error) {
  size_t bytes = 0;
  done(error, [&]() -> Status {
    if (Status status = check_layout(*access, *layout); !status) return status;
    const Places places = places_of(read(*access, HALFWAY_CORE_MEMORY), *layout);
    bytes = places.size + places.alignment;
    return Ok{};
  });
  return bytes;
}

halfway_core* halfway_open_core(const halfway_core_access* access, const halfway_core_memory* memory,
                                const halfway_core_layout* layout, halfway_error* error) {
  return made<halfway_core>(error, [&]() -> Result<halfway_core> {
    static_assert(std::endian::native == std::endian::little, "the core's memory is little-endian");
    if (Status status = check_layout(*access, *layout); !status) return status.error();
    halfway_core core{*access, *layout, places_of(read(*access, HALFWAY_CORE_MEMORY), *layout)};
    const std::size_t before = rounded_up(memory->address, core.places.alignment) - memory->address;
    const std::uint64_t end = std::uint64_t{memory->address} + before + core.places.size;
    if (before + core.places.size > memory->size || end > std::uint64_t{1} << 32)
      return bad_input(fmt::format("core: the memory has {} bytes at {:X}, but {} are needed below 100000000",
                                   memory->size, memory->address, before + core.places.size));
    core.bytes = static_cast<std::uint8_t*>(memory->bytes) + before;
    core.address = memory->address + static_cast<std::uint32_t>(before);
    if (!stop(*access, polls_of(*layout)))
      return tool_failed("core: a command of another program does not end");
    core.head = read(*access, HALFWAY_CORE_RING_TAIL);
    write(*access, HALFWAY_CORE_RING_BASE, core.address);
    write(*access, HALFWAY_CORE_RING_SIZE, c_commands_log2);
    write(*access, HALFWAY_CORE_RING_HEAD, core.head);
    write(*access, HALFWAY_CORE_FAULTS, ~0U);
    write(*access, HALFWAY_CORE_INTERRUPTS, ~0U);
    write(*access, HALFWAY_CORE_INTERRUPT_ENABLE,
          access->wait ? HALFWAY_CORE_INTERRUPT_ENABLE_FRAME_MASK : 0);
    write(*access, HALFWAY_CORE_CONTROL, HALFWAY_CORE_CONTROL_ENABLE_MASK);
    return core;
  });
}

void halfway_close_core(halfway_core* core) {
  if (!core) return;
  stop(core->access, polls_of(core->layout));
  delete core;
}

int halfway_check_core(const halfway_core* core, const halfway_hardware* hardware, halfway_error* error) {
  return done(error, [&] { return core->check(hardware->key); });
}

int halfway_queue_frame(halfway_core* core, const halfway_vectors* vectors, const halfway_core_frame* frame,
                        halfway_error* error) {
  return done(error, [&] { return core->queue(*vectors, frame ? *frame : halfway_core_frame{}); });
}

int halfway_wait_core(halfway_core* core, halfway_error* error) {
  return done(error, [&] { return core->wait_all(); });
}

int halfway_read_picture(halfway_core* core, uint8_t* rgb, halfway_error* error) {
  return done(error, [&] { return core->read_picture(rgb); });
}
