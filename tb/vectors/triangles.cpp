// SPDX-License-Identifier: Apache-2.0
#include "vectors/triangles.hpp"

#include <array>

namespace halfway::vectors {
namespace {

using words::Exact, words::Published;

template <class Preset>
InitVector random_words(Random& random, int init_bits) {
  InitVector init = random_vector(random, init_bits);
  for (const words::Field& field : Preset::c_init_header) set_bits(init, field, random.word(field.bits));
  return init;
}

// Random words in the header, but few lines.
void put_garbage_lines(InitVector& init, Random& random) {
  using At = Exact::init_header_at;
  set_bits(init, At::upper_lines, random.between(1, 6));
  set_bits(init, At::lower_lines, random.between(0, 4));
  if (random.one_in(4)) return;
  // Keep spans short, so that many fit: put the stop edge near the start edge.
  const auto start = get_bits(init, At::start_x);
  for (const words::Field* stop : {&At::upper_x, &At::lower_x})
    set_bits(init, *stop, start + static_cast<std::uint64_t>(random.between(-9, 9)));
  const auto quotient = get_bits(init, At::start_quotient);
  for (const words::Field* stop : {&At::upper_quotient, &At::lower_quotient})
    set_bits(init, *stop, quotient + static_cast<std::uint64_t>(random.between(-2, 2)));
}

}  // namespace

InitVector random_vector(Random& random, int bits) {
  InitVector vector(static_cast<std::size_t>(bits + 31) / 32);
  random.fill(vector);
  if (bits % 32 != 0) vector.back() = static_cast<std::uint32_t>(words::low_bits(vector.back(), bits % 32));
  return vector;
}

Walks random_walks(Random& random) {
  constexpr FrameSize c_frames[] = {{64, 48}, {64, 48}, {64, 48}, {9, 700}, {4096, 4096}};
  const FrameSize frame = c_frames[random.between(0, 4)];
  const int level = random.one_in(3) ? static_cast<int>(random.between(1, 5)) : 0;
  const int unit_bits = 4 + level;
  const auto unit = std::int64_t{1} << unit_bits;
  const auto point = [&](std::int64_t x_low, std::int64_t x_high, std::int64_t y_low, std::int64_t y_high) {
    return ScreenPoint{static_cast<std::int32_t>(random.between(x_low * unit, x_high * unit)),
                       static_cast<std::int32_t>(random.between(y_low * unit, y_high * unit))};
  };
  const std::int64_t width = frame.width, height = frame.height;
  // Positions of small triangles: anywhere, or at the frame's last corner.
  const std::int64_t x = random.one_in(3) ? width - 12 : random.between(0, width - 1);
  const std::int64_t y = random.one_in(3) ? height - 12 : random.between(0, height - 1);
  std::array<ScreenPoint, 3> p;
  switch (random.between(0, 6)) {
    case 0:  // approximately one pixel
      for (ScreenPoint& corner : p) corner = point(x, x + 2, y, y + 2);
      break;
    case 1: {  // sliver: the third corner is next to the middle of the other two
      p[0] = point(x, x + 3, y - 30, y);
      p[1] = point(x - 20, x + 40, y, y + 30);
      p[2] = {static_cast<std::int32_t>((p[0].x + p[1].x) / 2 + random.between(-unit, unit)),
              static_cast<std::int32_t>((p[0].y + p[1].y) / 2 + random.between(-unit, unit))};
      break;
    }
    case 2:  // one horizontal side
      for (ScreenPoint& corner : p) corner = point(x - 8, x + 8, y - 8, y + 8);
      p[1].y = p[0].y;
      break;
    case 3:  // cut by the frame
      for (ScreenPoint& corner : p) corner = point(-3 * 64, 3 * 64, -3 * 48, 3 * 48);
      break;
    case 4:  // wide and flat, over the frame's whole width
      for (ScreenPoint& corner : p) corner = point(-width / 2, width + width / 2, y, y + 3);
      break;
    default:
      for (ScreenPoint& corner : p) corner = point(x - 12, x + 12, y - 12, y + 12);
  }
  return plan_walks(p, unit_bits, frame);
}

void put_walk(InitVector& init, const Walk& walk) {
  using At = Exact::init_header_at;
  const auto put = [&](const words::Field& field, std::int64_t value) { set_bits(init, field, value); };
  const auto put_section = [&](const EdgeSection& s, const words::Field* x) {
    // The fields of a section in their order: x, quotient, remainder, divisor, error, carry.
    const std::int64_t values[] = {s.pixel, s.quotient, s.remainder, s.divisor, s.error, s.carry};
    for (std::size_t i = 0; i < std::size(values); ++i) put(x[i], values[i]);
  };
  put(At::y, walk.y);
  put(At::upper_lines, walk.upper_lines);
  put(At::lower_lines, walk.lower_lines);
  put(At::backward, walk.backward);
  put_section(walk.start, &At::start_x);
  put_section(walk.upper, &At::upper_x);
  put_section(walk.lower, &At::lower_x);
}

template <>
InitVector random_triangle<Exact>(Random& random, Mix mix, int init_bits) {
  InitVector init = random_words<Exact>(random, init_bits);
  if (mix == Mix::mixed && random.one_in(8)) {
    put_garbage_lines(init, random);
    return init;
  }
  Walks walks;
  while (walks.empty()) walks = random_walks(random);
  put_walk(init, walks[random.between(0, static_cast<std::int64_t>(walks.size()) - 1)]);
  return init;
}

template <>
InitVector random_triangle<Published>(Random& random, Mix mix, int init_bits) {
  using At = Published::init_header_at;
  InitVector init = random_words<Published>(random, init_bits);
  const auto put = [&](const words::Field& field, std::int64_t value) { set_bits(init, field, value); };
  constexpr std::int64_t c_one = std::int64_t{1} << Published::c_edge_x_fraction_bits;
  put(At::upper_lines, random.between(1, random.one_in(3) ? 20 : 6));
  if (mix == Mix::mixed && random.one_in(8)) return init;
  const std::int64_t start = random.between(0, 4095 * c_one), slope = random.between(-3 * c_one, 3 * c_one);
  put(At::start_x, start);
  put(At::start_slope, slope);
  // The apex above, below, or neither. In some the edges cross, so that lines are empty.
  const std::int64_t wide = random.between(-c_one, 12 * c_one), widening = random.between(-c_one, c_one);
  put(At::upper_x, start + (random.one_in(2) ? 0 : wide));
  put(At::upper_slope, slope + widening);
  return init;
}

}  // namespace halfway::vectors
