// SPDX-License-Identifier: Apache-2.0
// Bytes as text of an HTML page, in 1.17 bytes each; base64 would take 1.33.
#pragma once

#include <span>
#include <string>

namespace halfway::live {

/// The bytes' bits, highest first, as UTF-8: seven bits per character, zero bits at the end. The characters
/// that HTML would change or read (NUL, carriage return, <) are replaced by the character 128 higher. The
/// text is for a script element that is not executed; `bytesOfText` of page.js reads it.
std::string text_of_bytes(std::span<const unsigned char> bytes);

}  // namespace halfway::live
