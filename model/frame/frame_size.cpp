// SPDX-License-Identifier: Apache-2.0
#include "frame/frame_size.hpp"

#include <fmt/format.h>

#include <charconv>

namespace halfway {

std::optional<FrameSize> parse_frame_size(std::string_view text) {
  FrameSize size;
  const char* const end = text.data() + text.size();
  const auto [x, width_error] = std::from_chars(text.data(), end, size.width);
  if (width_error != std::errc{} || x == end || *x != 'x') return std::nullopt;
  const auto [rest, height_error] = std::from_chars(x + 1, end, size.height);
  if (height_error != std::errc{} || rest != end) return std::nullopt;
  return size;
}

std::string to_string(FrameSize size) {
  return fmt::format("{}x{}", size.width, size.height);
}

}  // namespace halfway
