// SPDX-License-Identifier: Apache-2.0
// Removes control characters from texts with names from files, before they are printed to a terminal.
#pragma once

#include <string>
#include <string_view>

namespace halfway {

/// The text with '?' for control characters (C1's in UTF-8 included), except line ends and tabs. A name in a
/// file could otherwise move the cursor or change the colours.
inline std::string printable(std::string_view text) {
  std::string shown(text);
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const auto byte = static_cast<unsigned char>(shown[i]);
    const auto next = i + 1 < shown.size() ? static_cast<unsigned char>(shown[i + 1]) : '\0';
    if (byte == 0xc2 && next >= 0x80 && next < 0xa0) shown[i] = shown[i + 1] = '?';
    if ((byte < 0x20 && byte != '\n' && byte != '\t') || byte == 0x7f) shown[i] = '?';
  }
  return shown;
}

}  // namespace halfway
