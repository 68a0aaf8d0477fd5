// SPDX-License-Identifier: Apache-2.0
#include "sim/live/module_text.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace halfway::live {
namespace {

// The lower seven bits of each character, as `bytesOfText` of page.js.
std::vector<unsigned char> bytes_of_text(const std::string& text) {
  std::vector<bool> bits;
  for (const unsigned char c : text)
    if (c != 0xc2)
      for (int bit = 6; bit >= 0; --bit) bits.push_back((c >> bit & 1) != 0);
  std::vector<unsigned char> bytes(bits.size() / 8);
  for (std::size_t i = 0; i < 8 * bytes.size(); ++i)
    if (bits[i]) bytes[i / 8] |= static_cast<unsigned char>(0x80 >> i % 8);
  return bytes;
}

TEST(ModuleText, KeepsTheBytes) {
  std::mt19937 random(1);
  for (std::size_t size = 0; size < 300; ++size) {
    std::vector<unsigned char> bytes(size);
    for (unsigned char& byte : bytes) byte = static_cast<unsigned char>(random());
    EXPECT_EQ(bytes_of_text(text_of_bytes(bytes)), bytes) << size << " bytes";
  }
}

TEST(ModuleText, HasNoCharacterThatHtmlChanges) {
  std::mt19937 random(2);
  std::vector<unsigned char> bytes(70'000);
  for (unsigned char& byte : bytes) byte = static_cast<unsigned char>(random());
  const std::string text = text_of_bytes(bytes);
  EXPECT_EQ(text.find_first_of(std::string("\0\r<", 3)), std::string::npos);
  EXPECT_LT(text.size(), bytes.size() * 118 / 100);
  // U+0080, U+008D and U+00BC stand for them.
  EXPECT_EQ(text_of_bytes(std::vector<unsigned char>(7, 0)).substr(0, 4), "\xc2\x80\xc2\x80");
}

}  // namespace
}  // namespace halfway::live
