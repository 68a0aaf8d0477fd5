// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <string>

#include "golden/frame_memory.hpp"
#include "sim/files/vector_file.hpp"
#include "vectors/entities.hpp"
#include "vectors/packet_frames.hpp"
#include "vectors/random.hpp"

namespace halfway::vectors {
namespace {

using golden::FramePlace;
using golden::PixelFormat;

// The memory of the testbench (tb_memory_pkg.vhd), and the pixels of a block.
constexpr std::uint32_t c_origin = 0x7FFC'0000, c_bytes = 1 << 17, c_block_pixels = 64;

// The words that the memory has at first: xorshift32, as next_random of tb_pkg.vhd.
std::vector<std::uint8_t> first_bytes() {
  std::vector<std::uint8_t> bytes;
  for (std::uint32_t x = 7; bytes.size() < c_bytes;) {
    x ^= x << 13, x ^= x >> 17, x ^= x << 5;
    for (const int low : {0, 8, 16, 24}) bytes.push_back(static_cast<std::uint8_t>(x >> low));
  }
  return bytes;
}

/// Fragments of a frame: spans, single pixels, pixels again and again, pixels outside.
class Drawing {
 public:
  Drawing(Random& random, const FramePlace& place) : random_(random), place_(place) {}

  std::vector<Fragment> draw(int spans) {
    for (int i = 0; i < spans; ++i) {
      // Half of the spans go on where one before was.
      if (i == 0 || random_.one_in(2)) {
        x_ = random_.between(-2, place_.width + 2);
        y_ = random_.between(0, place_.height);
      }
      const std::int64_t length = random_.one_in(3) ? 1 : random_.between(1, random_.one_in(3) ? 200 : 20);
      const std::int64_t step = random_.one_in(8) ? 0 : random_.one_in(3) ? -1 : 1;
      for (std::int64_t pixel = 0; pixel < length && pixel < (step == 0 ? 3 : length); ++pixel)
        add(x_ + pixel * step, y_);
      if (random_.one_in(3)) ++y_;
    }
    return fragments_;
  }

 private:
  void add(std::int64_t x, std::int64_t y) {
    // Few upper halves, so that equal ones occur; and depths that are nearly the farthest.
    const std::uint64_t upper = random_.one_in(30) ? 0xFFFF : random_.bits(random_.one_in(2) ? 3 : 16);
    fragments_.push_back({.triangle = static_cast<std::uint32_t>(random_.bits(32)),
                          .z = static_cast<std::uint32_t>(upper << 8 | random_.bits(8)),
                          .y = static_cast<std::uint16_t>(y & 4095),
                          .x = static_cast<std::uint16_t>(x & 4095),
                          .red = static_cast<std::uint8_t>(random_.bits(8)),
                          .green = static_cast<std::uint8_t>(random_.bits(8)),
                          .blue = static_cast<std::uint8_t>(random_.bits(8))});
  }

  Random& random_;
  const FramePlace& place_;
  std::int64_t x_ = 0, y_ = 0;
  std::vector<Fragment> fragments_;
};

// Places the buffers in memory, one after the other, with strides of any number of blocks.
FramePlace random_place(Random& random, PixelFormat format, std::uint32_t width, std::uint32_t height) {
  const std::uint32_t block = c_block_pixels * golden::pixel_bytes(format);
  const std::uint32_t least = (width * golden::pixel_bytes(format) + block - 1) / block;
  const auto stride = [&](std::uint32_t bytes) {
    const std::uint32_t most = std::min(bytes / block / height, least + 4);
    return block * static_cast<std::uint32_t>(random.between(least, most));
  };
  FramePlace place{.width = width, .height = height, .right = width, .bottom = height};
  place.colour_stride = stride(c_bytes / 2);
  place.depth_stride = stride(c_bytes / 2);
  const std::uint32_t colours = place.colour_stride * height, depths = place.depth_stride * height;
  const auto gap =
      static_cast<std::uint32_t>(random.between(0, (c_bytes - colours - depths) / block)) * block;
  place.colour_base = c_origin + (random.one_in(2) ? gap : depths + gap);
  place.depth_base = place.colour_base == c_origin + gap ? c_origin + gap + colours : c_origin + gap;
  return place;
}

void put_frame(VectorFile& file, const FramePlace& place, bool clear, std::uint32_t colour) {
  file.word(place.colour_base, 32).word(place.colour_stride, 16);
  file.word(place.depth_base, 32).word(place.depth_stride, 16);
  for (const std::uint32_t side :
       {place.width, place.height, place.left, place.right, place.top, place.bottom})
    file.word(side, 13);
  file.flag(clear).word(colour >> 16, 8).word(colour >> 8, 8).word(colour, 8).end_vector();
}

// Frames. Of each: a line with the numbers of fragments, of those kept, and of changed words; a line with its
// parameters; fragments; changed words of memory: index and word.
void write_frames(const Folder& folder, PixelFormat format, const std::string& name, int random_frames) {
  struct Size {
    std::uint32_t width, height;
    int spans;
  };
  std::vector<Size> sizes{{1, 1, 6}, {4095, 3, 40}, {1, 1, 6}, {640, 8, 40}, {64, 1, 30}, {2, 200, 60}};
  Random random(pixel_bytes(format));
  for (int i = 0; i < random_frames; ++i)
    sizes.push_back({static_cast<std::uint32_t>(random.between(1, 260)),
                     static_cast<std::uint32_t>(random.between(1, 40)),
                     static_cast<int>(random.between(0, 50))});
  VectorFile file;
  std::vector<std::uint8_t> bytes = first_bytes();
  golden::FrameMemory memory(format, bytes, c_origin);
  for (std::size_t frame = 0; frame < sizes.size(); ++frame) {
    const auto [width, height, spans] = sizes[frame];
    FramePlace place = random_place(random, format, width, height);
    const bool clear = frame == 0 || !random.one_in(3);
    const auto colour = static_cast<std::uint32_t>(random.bits(24));
    // A scissor, sometimes an empty one, or larger than the frame.
    if (frame >= 4 && random.one_in(2)) {
      place.left = static_cast<std::uint32_t>(random.between(0, width));
      place.right = static_cast<std::uint32_t>(random.between(place.left, width + 70));
      place.top = static_cast<std::uint32_t>(random.between(0, height / 2));
      place.bottom = static_cast<std::uint32_t>(random.between(place.top, height + 5));
    }
    const std::vector<std::uint8_t> before = bytes;
    const auto fragments = Drawing(random, place).draw(spans);
    if (clear)
      memory.clear(place, static_cast<std::uint8_t>(colour >> 16), static_cast<std::uint8_t>(colour >> 8),
                   static_cast<std::uint8_t>(colour));
    const auto kept = std::ranges::count_if(
        fragments, [&](const Fragment& fragment) { return memory.draw(place, fragment); });
    std::vector<std::uint32_t> changed;
    for (std::uint32_t at = 0; at < c_bytes; at += 4)
      if (!std::equal(&bytes[at], &bytes[at] + 4, &before[at])) changed.push_back(at / 4);
    file.word(fragments.size(), 32)
        .word(static_cast<std::uint64_t>(kept), 32)
        .word(changed.size(), 32)
        .end_vector();
    put_frame(file, place, clear, colour);
    for (const Fragment& fragment : fragments) put_fragment(file, fragment).end_vector();
    for (const std::uint32_t index : changed) {
      const std::uint8_t* byte = &bytes[4 * std::size_t{index}];
      const std::uint32_t word = byte[0] | byte[1] << 8 | byte[2] << 16 | std::uint32_t{byte[3]} << 24;
      file.word(index, 32).word(word, 32).end_vector();
    }
  }
  file.write(folder / (name + ".txt"));
}

template <int divisor>
void write_both_formats(const Folder& folder) {
  constexpr int c_random_frames = 11 / divisor;
  write_frames(folder, PixelFormat::rgb565, "rgb565", c_random_frames);
  write_frames(folder, PixelFormat::xrgb8888, "xrgb8888", c_random_frames);
}

}  // namespace

std::vector<Entity> memory_entities() {
  return {{"fragments_to_memory", write_both_formats<1>},
          {"short/fragments_to_memory", write_both_formats<c_short>}};
}

}  // namespace halfway::vectors
