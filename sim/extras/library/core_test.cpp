// SPDX-License-Identifier: Apache-2.0
// The driver of halfway_core against a small model of the core: registers, and commands that are drawn by the
// golden model. Numbers of registers and bits are those of docs/rtl/core.md.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <functional>
#include <map>
#include <memory>
#include <vector>

#include "golden/frame_memory.hpp"
#include "golden_run/golden_run.hpp"
#include "sim/extras/library/halfway_core.h"
#include "sim/extras/library/objects.hpp"

namespace halfway {
namespace {

using golden::FrameMemory;
using golden::FramePlace;
using golden::PixelFormat;
using ::testing::HasSubstr;

constexpr std::uint32_t c_width = 61, c_height = 35, c_packet_words = 200'000;
constexpr std::uint32_t c_shader = 0x08, c_lights = 0x0C, c_objects = 0x10, c_memory = 0x14, c_control = 0x18,
                        c_status = 0x1C, c_faults = 0x20, c_interrupt_enable = 0x24, c_interrupts = 0x28,
                        c_ring_base = 0x2C, c_ring_size = 0x30, c_ring_head = 0x34, c_ring_tail = 0x38,
                        c_picture = 0x3C;

template <class Object>
using Owned = std::unique_ptr<Object, void (*)(Object*)>;
using Core = Owned<halfway_core>;

/// A core for the vectors of a key.
class FakeCore {
 public:
  FakeCore(const HardwareKey& key, PixelFormat format) : key_(key), format_(format) {
    const bool true_colour = format == PixelFormat::xrgb8888;
    const ProcessorUnits& p = key.processors;
    const SphericalUnits& s = key.spherical;
    const bool diffuse = key.shader == Shader::processors ? p.diffuse : s.diffuse;
    const bool specular = key.shader == Shader::processors ? p.specular : s.specular;
    registers[0x00] = 0x48414C46;
    registers[0x04] = 0x0000FFFF;  // of the same major version
    registers[c_shader] = static_cast<unsigned>(key.shader) | (key.preset == Preset::exact) << 2 |
                          key.channels << 4 | diffuse << 8 | specular << 9 | key.degree << 10 |
                          s.highlight_channels << 12 | p.normalize << 16 | p.shadows << 17 |
                          s.tables.address_bits << 20 | s.tables.data_bits << 24;
    registers[c_lights] = s.lights | p.directional << 8 | p.positional << 16 | p.spots << 24;
    registers[c_objects] = p.objects | p.subpixels << 16 | s.powers << 24;
    registers[c_memory] = true_colour | 6U << 4 | 3U << 8 | 64U << 16;
    registers[c_ring_tail] = registers[c_ring_head] = 0xFFFF'FFFE;  // what another program left
    registers[c_faults] = 0xFF;
    memory_.resize(1 << 22, 0xA5);
  }

  halfway_core_access access() {
    return {[](void* self, uint32_t offset) { return static_cast<FakeCore*>(self)->read(offset); },
            [](void* self, uint32_t offset, uint32_t value) {
              static_cast<FakeCore*>(self)->write(offset, value);
            },
            nullptr, this};
  }
  halfway_core_memory memory() { return {memory_.data(), c_origin, memory_.size()}; }
  std::vector<std::uint8_t>& bytes() { return memory_; }

  void draw_next() {
    if (registers[c_ring_head] == registers[c_ring_tail] || (registers[c_control] & 1) == 0) return;
    const std::uint32_t slot = registers[c_ring_tail] & ((1U << registers[c_ring_size]) - 1);
    std::vector<std::uint32_t> command = words_at(registers[c_ring_base] + 64 * slot, 16);
    const auto bits = [&](std::size_t word, int high, int low) {
      return command[word] >> low & (0xFFFF'FFFFU >> (31 - high + low));
    };
    const FramePlace place{.colour_base = command[2],
                           .colour_stride = bits(4, 15, 0),
                           .depth_base = command[3],
                           .depth_stride = bits(4, 31, 16),
                           .width = bits(5, 12, 0),
                           .height = bits(5, 28, 16),
                           .left = bits(6, 12, 0),
                           .right = bits(6, 28, 16),
                           .top = bits(7, 12, 0),
                           .bottom = bits(7, 28, 16)};
    const std::uint32_t block = format_ == PixelFormat::rgb565 ? 128 : 256;
    EXPECT_EQ(registers[c_ring_base] % 64, 0U);
    EXPECT_EQ(command[0] % 8, 0U);
    EXPECT_EQ(command[1] % 2, 0U);
    for (const std::uint32_t number :
         {place.colour_base, place.depth_base, place.colour_stride, place.depth_stride})
      EXPECT_EQ(number % block, 0U);
    EXPECT_EQ(bits(8, 31, 28), 1U);
    for (std::size_t word = 9; word < 16; ++word) EXPECT_EQ(command[word], 0U);
    FrameMemory frame(format_, memory_, c_origin);
    if (bits(8, 24, 24))
      frame.clear(place, static_cast<std::uint8_t>(bits(8, 23, 16)),
                  static_cast<std::uint8_t>(bits(8, 15, 8)), static_cast<std::uint8_t>(bits(8, 7, 0)));
    draw_packets(frame, place, words_at(command[0], command[1]));
    if (next_faults == 0 && bits(8, 25, 25)) registers[c_picture] = place.colour_base;
    registers[c_faults] |= next_faults;
    registers[c_interrupts] |= next_faults == 0 ? 1 : 3;
    next_faults = 0;
    ++registers[c_ring_tail];
  }

  std::map<std::uint32_t, std::uint32_t> registers;
  std::uint32_t next_faults = 0;  ///< of the next command
  int reads_per_command = 3;      ///< of ring_tail; -1: none is drawn
  int tail_reads = 0;

 private:
  static constexpr std::uint32_t c_origin = 0x4000'0108;

  std::uint32_t read(std::uint32_t offset) {
    EXPECT_TRUE(offset % 4 == 0 && offset <= 0x50) << offset;
    if (offset == c_ring_tail && ++tail_reads % reads_per_command == 0) draw_next();
    if (offset == c_status && registers[c_status] != 0 && aborted_) registers[c_status] = 0;
    return registers[offset];
  }

  void write(std::uint32_t offset, std::uint32_t value) {
    switch (offset) {
      case c_control:
        aborted_ = (value & 2) != 0;
        registers[offset] = value & 1;
        break;
      case c_interrupt_enable:
      case c_ring_base:
      case c_ring_size:
      case c_ring_head:
        registers[offset] = value;
        break;
      case c_faults:
      case c_interrupts:
        registers[offset] &= ~value;
        break;
      default:
        ADD_FAILURE() << "a write to " << offset;
    }
  }

  std::vector<std::uint32_t> words_at(std::uint32_t address, std::size_t count) const {
    std::vector<std::uint32_t> words(count);
    std::memcpy(words.data(), memory_.data() + (address - c_origin), 4 * count);
    return words;
  }

  void draw_packets(FrameMemory& frame, const FramePlace& place,
                    const std::vector<std::uint32_t>& packets) const {
    const std::unique_ptr<GoldenModel> golden = make_golden_model(key_);
    std::vector<std::uint32_t> vectors;
    for (std::size_t i = 0; i < packets.size();) {
      const std::size_t count = packets[i] >> 16;
      const auto first = packets.begin() + static_cast<std::ptrdiff_t>(i) + 1;
      vectors.insert(vectors.end(), first, first + static_cast<std::ptrdiff_t>(count));
      vectors.resize(vectors.size() + (golden->init_bits() + 31) / 32 - count);
      i += 1 + count + (count % 2 == 0 ? 1 : 0);
    }
    for (const Fragment& fragment : golden->draw(vectors)) frame.draw(place, fragment);
  }

  HardwareKey key_;
  PixelFormat format_;
  std::vector<std::uint8_t> memory_;
  bool aborted_ = false;
};

Owned<halfway_vectors> vectors_of(const char* scene_name, int shader, double azimuth = 0.0) {
  halfway_error error;
  const Owned<halfway_scene> scene(halfway_load_scene(scene_name, HALFWAY_SOURCE_DIR "/sim/scenes", &error),
                                   halfway_free_scene);
  EXPECT_TRUE(scene) << error.text;
  EXPECT_EQ(halfway_orbit_camera(scene.get(), azimuth, 0.0, 1.0, &error), HALFWAY_OK);
  const halfway_request request = {shader, HALFWAY_EXACT, 0, 0};
  const Owned<halfway_hardware> hardware(halfway_plan(scene.get(), &request, &error), halfway_free_hardware);
  EXPECT_TRUE(hardware) << error.text;
  Owned<halfway_vectors> vectors(
      halfway_scene_vectors(scene.get(), hardware.get(), c_width, c_height, nullptr, &error),
      halfway_free_vectors);
  EXPECT_TRUE(vectors) << error.text;
  return vectors;
}

Core opened(FakeCore& fake, halfway_error* error, std::uint32_t polls = 10, bool waits = false) {
  halfway_core_access access = fake.access();
  if (waits) access.wait = [](void* self) { static_cast<FakeCore*>(self)->draw_next(); };
  const halfway_core_memory memory = fake.memory();
  const halfway_core_layout layout = {c_width, c_height, c_packet_words, polls};
  return {halfway_open_core(&access, &memory, &layout, error), halfway_close_core};
}

/// What the picture must be: frames one after the other in one buffer.
class Expected {
 public:
  explicit Expected(PixelFormat format) : format_(format), memory_(format, bytes_, 0) {
    place.colour_stride = place.depth_stride = golden::pixel_bytes(format) * c_width;
  }

  void clear(std::uint8_t red, std::uint8_t green, std::uint8_t blue) {
    memory_.clear(place, red, green, blue);
  }
  void draw(const halfway_vectors& vectors) {
    const std::unique_ptr<GoldenModel> golden = make_golden_model(vectors.key);
    const auto drawn = golden->draw(vectors.words);
    EXPECT_GT(drawn.size(), 300U);
    for (const Fragment& fragment : drawn) memory_.draw(place, fragment);
  }
  std::vector<std::uint8_t> rgb() const {
    std::vector<std::uint8_t> rgb;
    for (std::size_t i = 0; i < c_width * c_height; ++i) {
      if (format_ == PixelFormat::xrgb8888) {
        for (const std::size_t channel : {2, 1, 0}) rgb.push_back(bytes_[4 * i + channel]);
        continue;
      }
      const unsigned pixel = bytes_[2 * i] + 256U * bytes_[2 * i + 1];
      const unsigned red = pixel >> 11, green = pixel >> 5 & 63, blue = pixel & 31;
      for (const unsigned channel : {8 * red + red / 4, 4 * green + green / 16, 8 * blue + blue / 4})
        rgb.push_back(static_cast<std::uint8_t>(channel));
    }
    return rgb;
  }

  FramePlace place{.depth_base = 4 * c_width * c_height,
                   .width = c_width,
                   .height = c_height,
                   .right = c_width,
                   .bottom = c_height};

 private:
  PixelFormat format_;
  std::vector<std::uint8_t> bytes_ = std::vector<std::uint8_t>(8 * c_width * c_height);
  FrameMemory memory_;
};

std::vector<std::uint8_t> picture_of(halfway_core* core) {
  std::vector<std::uint8_t> rgb(3 * c_width * c_height);
  halfway_error error;
  EXPECT_EQ(halfway_read_picture(core, rgb.data(), &error), HALFWAY_OK) << error.text;
  return rgb;
}

TEST(CoreDriver, DrawsFramesOfEachShaderInBothFormats) {
  for (const PixelFormat format : {PixelFormat::rgb565, PixelFormat::xrgb8888})
    for (const auto& [scene, shader] : {std::pair{"spheres", HALFWAY_QUADRATIC},
                                        {"matte", HALFWAY_SPHERICAL},
                                        {"spheres", HALFWAY_PROCESSORS}}) {
      const auto vectors = vectors_of(scene, shader), turned = vectors_of(scene, shader, 30.0);
      FakeCore fake(vectors->key, format);
      halfway_error error;
      const Core core = opened(fake, &error);
      ASSERT_TRUE(core) << error.text;
      const halfway_core_frame blue = {.keep = 0, .clear_colour = {9, 90, 200}};
      // Five frames, of which at most two are queued; the picture is the last one.
      for (const auto* queued : {&vectors, &turned, &vectors, &vectors, &turned})
        ASSERT_EQ(halfway_queue_frame(core.get(), queued->get(), &blue, &error), HALFWAY_OK) << error.text;
      ASSERT_EQ(halfway_wait_core(core.get(), &error), HALFWAY_OK) << error.text;
      Expected expected(format);
      expected.clear(9, 90, 200);
      expected.draw(*turned);
      EXPECT_EQ(picture_of(core.get()), expected.rgb()) << scene;
      // More onto the same picture, inside a rectangle.
      const halfway_core_frame more = {
          .keep = 1, .clear_colour = {}, .left = 5, .top = 7, .width = 40, .height = 20};
      ASSERT_EQ(halfway_queue_frame(core.get(), vectors.get(), &more, &error), HALFWAY_OK) << error.text;
      ASSERT_EQ(halfway_wait_core(core.get(), &error), HALFWAY_OK) << error.text;
      expected.place.left = 5, expected.place.top = 7, expected.place.right = 45, expected.place.bottom = 27;
      expected.draw(*vectors);
      EXPECT_EQ(picture_of(core.get()), expected.rgb()) << scene;
      EXPECT_EQ(fake.registers[c_ring_tail], 4U);
    }
}

TEST(CoreDriver, WaitsForAPacketBuffer) {
  const auto vectors = vectors_of("spheres", HALFWAY_QUADRATIC);
  FakeCore fake(vectors->key, PixelFormat::rgb565);
  halfway_error error;
  const Core core = opened(fake, &error, 10);
  ASSERT_TRUE(core) << error.text;
  EXPECT_EQ(fake.registers[c_interrupt_enable], 0U);
  std::vector<std::uint8_t> rgb(3 * c_width * c_height);
  EXPECT_EQ(halfway_read_picture(core.get(), rgb.data(), &error), HALFWAY_BAD_INPUT);
  EXPECT_STREQ(error.text, "core: no frame has been finished");
  fake.reads_per_command = 9, fake.tail_reads = 0;
  for (int frame = 0; frame < 2; ++frame)
    ASSERT_EQ(halfway_queue_frame(core.get(), vectors.get(), nullptr, &error), HALFWAY_OK) << error.text;
  EXPECT_EQ(fake.tail_reads, 2);
  ASSERT_EQ(halfway_queue_frame(core.get(), vectors.get(), nullptr, &error), HALFWAY_OK) << error.text;
  EXPECT_EQ(fake.tail_reads, 9) << "the first of two frames is not done before";
  ASSERT_EQ(halfway_wait_core(core.get(), &error), HALFWAY_OK) << error.text;
  EXPECT_EQ(fake.tail_reads, 27);
}

TEST(CoreDriver, WaitsForTheInterrupt) {
  const auto vectors = vectors_of("spheres", HALFWAY_QUADRATIC);
  FakeCore fake(vectors->key, PixelFormat::rgb565);
  fake.reads_per_command = 1'000'000;
  halfway_error error;
  const Core core = opened(fake, &error, 1, true);
  ASSERT_TRUE(core) << error.text;
  EXPECT_EQ(fake.registers[c_interrupt_enable], 1U);
  for (int frame = 0; frame < 3; ++frame)
    ASSERT_EQ(halfway_queue_frame(core.get(), vectors.get(), nullptr, &error), HALFWAY_OK) << error.text;
  fake.registers[c_interrupts] = 1;
  ASSERT_EQ(halfway_wait_core(core.get(), &error), HALFWAY_OK) << error.text;
  EXPECT_EQ(fake.registers[c_ring_tail], 1U);
  EXPECT_EQ(fake.registers[c_interrupts], 0U) << "the interrupt is cleared before the last look";
}

TEST(CoreDriver, ReportsFaultsOnceAndKeepsThePicture) {
  const auto vectors = vectors_of("spheres", HALFWAY_QUADRATIC),
             turned = vectors_of("spheres", HALFWAY_QUADRATIC, 30.0);
  FakeCore fake(vectors->key, PixelFormat::rgb565);
  halfway_error error;
  const Core core = opened(fake, &error);
  ASSERT_TRUE(core) << error.text;
  ASSERT_EQ(halfway_queue_frame(core.get(), vectors.get(), nullptr, &error), HALFWAY_OK);
  ASSERT_EQ(halfway_wait_core(core.get(), &error), HALFWAY_OK) << error.text;
  // A frame with a fault is drawn where the last picture is not, how ever many follow each other.
  const auto before = picture_of(core.get());
  constexpr const char* c_names[] = {"wrong_kind", "wrong_length", "shader",  "limit",
                                     "memory",     "read",         "command", "aborted"};
  for (std::uint32_t bit = 0; bit < 8; ++bit) {
    fake.next_faults = 1U << bit;
    ASSERT_EQ(halfway_queue_frame(core.get(), turned.get(), nullptr, &error), HALFWAY_OK);
    EXPECT_EQ(halfway_wait_core(core.get(), &error), HALFWAY_DIFFERS);
    EXPECT_EQ(error.text, std::string("core: faults: ") + c_names[bit]);
    EXPECT_EQ(halfway_wait_core(core.get(), &error), HALFWAY_OK) << error.text;
    EXPECT_EQ(picture_of(core.get()), before);
  }
  fake.next_faults = 0x21;
  ASSERT_EQ(halfway_queue_frame(core.get(), turned.get(), nullptr, &error), HALFWAY_OK);
  EXPECT_EQ(halfway_wait_core(core.get(), &error), HALFWAY_DIFFERS);
  EXPECT_STREQ(error.text, "core: faults: wrong_kind, read");
}

TEST(CoreDriver, DoesNotHang) {
  const auto vectors = vectors_of("spheres", HALFWAY_QUADRATIC);
  FakeCore fake(vectors->key, PixelFormat::rgb565);
  halfway_error error;
  Core core = opened(fake, &error, 50);
  ASSERT_TRUE(core) << error.text;
  fake.reads_per_command = 1'000'000, fake.tail_reads = 0;
  ASSERT_EQ(halfway_queue_frame(core.get(), vectors.get(), nullptr, &error), HALFWAY_OK);
  fake.registers[c_status] = 1;
  EXPECT_EQ(halfway_wait_core(core.get(), &error), HALFWAY_FAILED);
  EXPECT_STREQ(error.text, "core: command 4294967294 does not end; status is 1");
  EXPECT_EQ(fake.tail_reads, 52);
  core.reset();
  EXPECT_EQ(fake.registers[c_status], 0U) << "the frame is ended";
  EXPECT_EQ(fake.registers[c_control], 0U);
}

TEST(CoreDriver, RefusesOtherCoresAndLayouts) {
  const auto vectors = vectors_of("spheres", HALFWAY_QUADRATIC);
  const auto refused = [&](std::uint32_t offset, std::uint32_t value, const char* text) {
    FakeCore fake(vectors->key, PixelFormat::rgb565);
    fake.registers[offset] = value;
    halfway_error error;
    EXPECT_FALSE(opened(fake, &error));
    EXPECT_EQ(error.code, HALFWAY_BAD_INPUT);
    EXPECT_STREQ(error.text, text);
  };
  refused(0x00, 0x1234, "core: the register identity is 00001234, not 48414C46: no halfway_core is here");
  refused(0x04, 0x2A00'0000, "core: has version 42, but this driver is for version 0");

  FakeCore fake(vectors->key, PixelFormat::xrgb8888);
  const halfway_core_access access = fake.access();
  halfway_core_layout layout = {c_width, c_height, c_packet_words, 0};
  halfway_error error;
  const std::size_t bytes = halfway_core_bytes(&access, &layout, &error);
  EXPECT_EQ(error.code, HALFWAY_OK);
  EXPECT_GE(bytes, 3U * 4 * c_width * c_height + 2U * 4 * c_packet_words);
  halfway_core_memory memory = fake.memory();
  memory.size = bytes;
  halfway_close_core(halfway_open_core(&access, &memory, &layout, &error));
  EXPECT_EQ(error.code, HALFWAY_OK) << error.text;
  memory.size = bytes - 256;
  EXPECT_FALSE(halfway_open_core(&access, &memory, &layout, &error));
  EXPECT_THAT(error.text, HasSubstr("core: the memory has "));
  memory = fake.memory();
  memory.address = 0xFFFF'0000;
  EXPECT_FALSE(halfway_open_core(&access, &memory, &layout, &error));
  EXPECT_THAT(error.text, HasSubstr("needed below 100000000"));
  for (const auto& [width, height] : {std::pair{0U, 1U}, {1U, 0U}, {4097U, 1U}, {1U, 4097U}}) {
    layout.width = width, layout.height = height;
    EXPECT_EQ(halfway_core_bytes(&access, &layout, &error), 0U);
    EXPECT_THAT(error.text, HasSubstr("each side must be 1 to 4096"));
  }
  layout = {1, 1, std::size_t{1} << 40, 0};
  EXPECT_EQ(halfway_core_bytes(&access, &layout, &error), 0U);
  EXPECT_THAT(error.text, HasSubstr("packet words are too many"));
}

TEST(CoreDriver, RefusesFramesThatTheCoreCannotDraw) {
  for (const auto& [scene, shader] : {std::pair{"spheres", HALFWAY_QUADRATIC},
                                      {"lights", HALFWAY_SPHERICAL},
                                      {"lights", HALFWAY_PROCESSORS}}) {
    const auto vectors = vectors_of(scene, shader);
    const halfway_hardware hardware{vectors->key, {}, vectors->key.name(), vectors->init_bits};
    FakeCore fake(vectors->key, PixelFormat::rgb565);
    halfway_error error;
    const Core core = opened(fake, &error);
    ASSERT_TRUE(core) << error.text;
    EXPECT_EQ(halfway_check_core(core.get(), &hardware, &error), HALFWAY_OK) << error.text;
    const std::uint32_t good[] = {fake.registers[c_shader], fake.registers[c_lights],
                                  fake.registers[c_objects]};
    const auto refused = [&](std::uint32_t offset, std::uint32_t flipped, const char* field) {
      fake.registers[offset] ^= flipped;
      EXPECT_EQ(halfway_check_core(core.get(), &hardware, &error), HALFWAY_BAD_INPUT) << field;
      EXPECT_THAT(error.text, HasSubstr(std::string("core: its ") + field + " is "));
      EXPECT_EQ(halfway_queue_frame(core.get(), vectors.get(), nullptr, &error), HALFWAY_BAD_INPUT);
      fake.registers[offset] ^= flipped;
    };
    refused(c_shader, 3, "shader.kind");
    refused(c_shader, 1 << 2, "shader.exact");
    refused(c_shader, 2 << 4, "shader.channels");
    if (shader == HALFWAY_QUADRATIC) refused(c_shader, 3 << 10, "shader.degree");
    if (shader != HALFWAY_QUADRATIC) {
      refused(c_shader, 1 << 8, "shader.diffuse");
      refused(c_shader, 1 << 9, "shader.specular");
    }
    if (shader == HALFWAY_SPHERICAL) {
      refused(c_lights, 1, "lights.lights");
      refused(c_shader, 2 << 12, "shader.highlight_channels");
      refused(c_objects, 1 << 24, "objects.powers");
      refused(c_shader, 1 << 20, "shader.table_address_bits");
      refused(c_shader, 1 << 24, "shader.table_data_bits");
    }
    if (shader == HALFWAY_PROCESSORS) {
      refused(c_lights, 1 << 8, "lights.directional");
      refused(c_lights, 1 << 16, "lights.positional");
      refused(c_lights, 1 << 24, "lights.spots");
      refused(c_shader, 1 << 16, "shader.normalize");
      refused(c_shader, 1 << 17, "shader.shadows");
      refused(c_objects, 1, "objects.objects");
      refused(c_objects, 1 << 16, "objects.subpixels");
    }
    EXPECT_EQ(fake.registers[c_shader], good[0]);
    EXPECT_EQ(fake.registers[c_ring_head], 0xFFFF'FFFE) << "nothing was queued";

    const halfway_core_frame kept = {.keep = 1};
    EXPECT_EQ(halfway_queue_frame(core.get(), vectors.get(), &kept, &error), HALFWAY_BAD_INPUT);
    EXPECT_STREQ(error.text, "core: no frame was queued that this one could keep");
    const halfway_core_frame outside = {.left = 30, .width = c_width - 29, .height = 1};
    EXPECT_EQ(halfway_queue_frame(core.get(), vectors.get(), &outside, &error), HALFWAY_BAD_INPUT);
    EXPECT_THAT(error.text, HasSubstr("are not inside the frame, 61x35"));
  }
  // A frame with more packets than there is room for.
  const auto vectors = vectors_of("spheres", HALFWAY_QUADRATIC);
  FakeCore fake(vectors->key, PixelFormat::rgb565);
  const halfway_core_access access = fake.access();
  const halfway_core_memory memory = fake.memory();
  halfway_error error;
  for (const std::size_t spare : {0, 1}) {
    const halfway_core_layout layout = {c_width, c_height, halfway_packet_words(vectors.get()) - spare, 10};
    const Core core(halfway_open_core(&access, &memory, &layout, &error), halfway_close_core);
    ASSERT_TRUE(core) << error.text;
    EXPECT_EQ(halfway_queue_frame(core.get(), vectors.get(), nullptr, &error),
              spare == 0 ? HALFWAY_OK : HALFWAY_BAD_INPUT)
        << error.text;
    EXPECT_EQ(halfway_wait_core(core.get(), &error), HALFWAY_OK);
  }
}

TEST(MappedRegisters, OffsetsAreInBytes) {
  std::uint32_t registers[4] = {10, 11, 12, 13};
  EXPECT_EQ(halfway_mapped_read(registers, 8), 12U);
  halfway_mapped_write(registers, 4, 0x89AB'CDEF);
  EXPECT_THAT(registers, ::testing::ElementsAre(10, 0x89AB'CDEF, 12, 13));
}

}  // namespace
}  // namespace halfway
