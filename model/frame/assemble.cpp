// SPDX-License-Identifier: Apache-2.0
#include "frame/assemble.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace halfway {
namespace {

constexpr std::uint32_t c_greatest_z = (1u << 24) - 1;
constexpr std::uint32_t c_empty = std::numeric_limits<std::uint32_t>::max();

Error refusal(const Fragment& f, std::uint64_t number, const std::string& why) {
  return {ExitCode::differs,
          fmt::format("fragments:{}: fragment of triangle {} at pixel {},{} with z {}: {}; the source "
                      "of the stream is wrong",
                      number, f.triangle, f.x, f.y, f.z, why)};
}

}  // namespace

FrameAssembler::FrameAssembler(FrameSize size, const Tile& tile, glm::dvec3 background)
    : size_(size),
      tile_(tile),
      background_{to_byte(background.r), to_byte(background.g), to_byte(background.b)},
      frame_(tile.size),
      z_(frame_.pixels()) {
  clear();
}

void FrameAssembler::clear() {
  const auto background = background_;  // a copy that no write to the frame can change
  // Write the first line pixel by pixel. Copy it to the other lines, which takes half the time.
  const auto first = frame_.rgb.begin();
  const std::size_t line = 3 * std::size_t{frame_.size.width};
  for (auto pixel = first; pixel != first + static_cast<std::ptrdiff_t>(line);)
    pixel = std::copy(background.begin(), background.end(), pixel);
  for (std::size_t other = line; other < frame_.rgb.size(); other += line)
    std::copy_n(first, line, first + static_cast<std::ptrdiff_t>(other));
  std::fill(z_.begin(), z_.end(), c_empty);
  fragments_ = outside_ = covered_pixels_ = 0;
}

Status FrameAssembler::add(std::span<const Fragment> fragments) {
  for (const Fragment& f : fragments) {
    ++fragments_;
    const bool inside = tile_.holds(f.x, f.y);
    if (!inside && (f.x >= size_.width || f.y >= size_.height))
      return refusal(f, fragments_, "it lies outside the frame of " + to_string(size_));
    if (f.z > c_greatest_z) return refusal(f, fragments_, "z has more than 24 bits");
    if (!inside) {
      ++outside_;
      continue;
    }
    const std::size_t rgb = frame_.offset(f.x - tile_.x, f.y - tile_.y);
    std::uint32_t& z = z_[rgb / 3];
    if (f.z >= z) continue;
    if (z == c_empty) ++covered_pixels_;
    z = f.z;
    frame_.rgb[rgb] = f.red;
    frame_.rgb[rgb + 1] = f.green;
    frame_.rgb[rgb + 2] = f.blue;
  }
  return Ok{};
}

std::optional<std::uint32_t> FrameAssembler::depth(std::uint32_t x, std::uint32_t y) const {
  const std::uint32_t z = z_[frame_.offset(x, y) / 3];
  if (z == c_empty) return std::nullopt;
  return z;
}

std::vector<std::uint8_t> FrameAssembler::mask() const {
  std::vector<std::uint8_t> mask(z_.size());
  for (std::size_t i = 0; i < z_.size(); ++i) mask[i] = z_[i] != c_empty;
  return mask;
}

}  // namespace halfway
