// SPDX-License-Identifier: Apache-2.0
#include "sim/study/sealed.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "sim/system/file.hpp"
#include "sim/system/must.hpp"

namespace halfway::study {
namespace {

TEST(Sealed, IsReadBackUnlessAByteChanged) {
  const nlohmann::ordered_json object = {
      {"name", "grey ± \"7\""}, {"none", nullptr}, {"rms", 0.1}, {"figures", {{"cycles", 121826}}}};
  const std::string text = sealed(object);
  ASSERT_EQ(unsealed(text), object);
  for (std::size_t at = 0; at < text.size(); ++at)
    for (const int bit : {1, 2, 4, 8, 16, 32, 64, 128}) {
      std::string damaged = text;
      damaged[at] = static_cast<char>(damaged[at] ^ bit);
      EXPECT_FALSE(unsealed(damaged)) << damaged;
    }
  for (const char* other : {"", "{}", "[]", "7", "{\"checksum\": \"\"}\n"})
    EXPECT_FALSE(unsealed(other)) << other;
}

// Expected values are computed by xxhash's own programs.
TEST(Sealed, ChecksumIsXxh64) {
  auto folder = must(TemporaryFolder::make(std::filesystem::temp_directory_path()));
  const auto path = folder.path() / "file";
  EXPECT_FALSE(checksum_of(path));
  for (const auto& [bytes, checksum] :
       {std::pair{"", "ef46db3751d8e999"}, {"a", "d24ec4f1a98c6e5b"}, {"abc", "44bc2cf5ad770999"}}) {
    ASSERT_TRUE(write_file(path, bytes));
    EXPECT_EQ(*checksum_of(path), checksum);
  }
}

}  // namespace
}  // namespace halfway::study
