// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace halfway {

/// In pixels.
struct FrameSize {
  std::uint32_t width = 0, height = 0;
  friend bool operator==(const FrameSize&, const FrameSize&) = default;
};

/// Parses WIDTHxHEIGHT. Empty if the text has another form. The numbers' range is not checked.
std::optional<FrameSize> parse_frame_size(std::string_view text);
std::string to_string(FrameSize size);

}  // namespace halfway
