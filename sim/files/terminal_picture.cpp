// SPDX-License-Identifier: Apache-2.0
#include "sim/files/terminal_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

namespace halfway {
namespace {

using Colour = std::array<std::uint32_t, 3>;

// Source pixels [begin, end) on one axis that one pixel of the smaller axis covers.
struct Range {
  std::uint32_t begin, end;
};
Range range_of(std::uint32_t pixel, std::uint32_t small, std::uint32_t large) {
  const auto at = [&](std::uint64_t i) { return static_cast<std::uint32_t>(i * large / small); };
  return {at(pixel), at(pixel + 1)};
}

Colour mean(const Frame& frame, Range x, Range y) {
  std::array<std::uint64_t, 3> sum{};
  for (std::uint32_t line = y.begin; line < y.end; ++line) {
    const std::uint8_t* rgb = frame.rgb.data() + frame.offset(x.begin, line);
    for (std::uint32_t i = x.begin; i < x.end; ++i)
      for (std::uint64_t& channel : sum) channel += *rgb++;
  }
  const std::uint64_t pixels = std::uint64_t{x.end - x.begin} * (y.end - y.begin);
  Colour colour{};
  for (std::size_t i = 0; i < colour.size(); ++i)
    colour[i] = static_cast<std::uint32_t>((sum[i] + pixels / 2) / pixels);
  return colour;
}

std::uint32_t distance(const Colour& a, const Colour& b) {
  std::uint32_t sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sum;
}

// xterm's colours 16 to 231 are the cube, with red changing slowest. 232 to 255 are the greys 8, 18, ... 238.
std::uint32_t palette_index(const Colour& colour) {
  constexpr std::array<std::uint32_t, 6> c_levels = {0, 95, 135, 175, 215, 255};
  constexpr std::uint32_t c_cube = 16, c_grey = 232, c_greys = 24;
  std::uint32_t index = 0;
  Colour in_cube{};
  for (std::size_t i = 0; i < colour.size(); ++i) {
    const auto apart = [&](std::uint32_t level) {
      return level > colour[i] ? level - colour[i] : colour[i] - level;
    };
    const auto nearest = std::ranges::min_element(c_levels, {}, apart);
    index = 6 * index + static_cast<std::uint32_t>(nearest - c_levels.begin());
    in_cube[i] = *nearest;
  }
  const std::uint32_t lightness = (colour[0] + colour[1] + colour[2]) / 3;
  const std::uint32_t grey = std::min((std::max(lightness, 3U) - 3) / 10, c_greys - 1), level = 8 + 10 * grey;
  return distance(colour, {level, level, level}) < distance(colour, in_cube) ? c_grey + grey : c_cube + index;
}

// The escape sequence that sets a colour: `what` is 38 for the upper half of a block, 48 for the lower one.
std::string colour_code(int what, const Colour& colour, TerminalColours colours) {
  if (colours == TerminalColours::palette) return fmt::format("\033[{};5;{}m", what, palette_index(colour));
  return fmt::format("\033[{};2;{};{};{}m", what, colour[0], colour[1], colour[2]);
}

}  // namespace

FrameSize fitting_size(FrameSize frame, std::uint32_t columns, std::uint32_t lines) {
  const std::uint64_t most_width = std::clamp<std::uint64_t>(columns, 1, frame.width),
                      most_height = std::clamp<std::uint64_t>(2 * std::uint64_t{lines}, 1, frame.height);
  const auto part = [](std::uint64_t a, std::uint64_t b, std::uint64_t of) {
    return static_cast<std::uint32_t>(std::max<std::uint64_t>(a * b / of, 1));
  };
  if (most_width * frame.height <= most_height * frame.width)
    return {static_cast<std::uint32_t>(most_width), part(frame.height, most_width, frame.width)};
  return {part(frame.width, most_height, frame.height), static_cast<std::uint32_t>(most_height)};
}

std::string terminal_picture(const Frame& frame, FrameSize size, TerminalColours colours) {
  std::string text;
  for (std::uint32_t y = 0; y < size.height; y += 2) {
    std::optional<Colour> last_upper, last_lower;
    for (std::uint32_t x = 0; x < size.width; ++x) {
      const Range columns = range_of(x, size.width, frame.size.width);
      const auto pixel = [&](std::uint32_t line) -> std::optional<Colour> {
        if (line >= size.height) return std::nullopt;
        return mean(frame, columns, range_of(line, size.height, frame.size.height));
      };
      const auto upper = pixel(y), lower = pixel(y + 1);
      if (upper != last_upper) text += colour_code(38, *upper, colours);
      if (lower && lower != last_lower) text += colour_code(48, *lower, colours);
      if (!lower && last_lower) text += "\033[49m";
      last_upper = upper;
      last_lower = lower;
      text += "\u2580";
    }
    text += "\033[0m\n";
  }
  return text;
}

}  // namespace halfway
