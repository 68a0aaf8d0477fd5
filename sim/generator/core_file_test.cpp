// SPDX-License-Identifier: Apache-2.0
// The form of halfway.core. FuseSoC is no package of Debian 12: the hosted CI runs it.
#include "sim/generator/core_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace halfway::tables {
namespace {

using ::testing::HasSubstr;

// The test `tables` compares the rest with the file of the checkout.
TEST(CoreFile, ListsTheFilesInTheirOrder) {
  const std::string text = core_text("b/x_pkg.vhd\n# comment\n\na/words_to_fragments.vhd\n", "1.2.3");
  EXPECT_THAT(text, HasSubstr("\nname: ::halfway:1.2.3\n"));
  EXPECT_THAT(text,
              HasSubstr("\n    files:\n      - rtl/b/x_pkg.vhd\n      - rtl/a/words_to_fragments.vhd\n\n"));
}

}  // namespace
}  // namespace halfway::tables
