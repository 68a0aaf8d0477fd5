// SPDX-License-Identifier: Apache-2.0
// Texts that hold names from files, on their way to a terminal.
#pragma once

#include <string>
#include <string_view>

namespace halfway {

/// The text with '?' for control characters, C1's in UTF-8 included, but line ends and tabs: a name in a file
/// could else move the cursor, or paint what we did not say.
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
