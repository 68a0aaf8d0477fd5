// SPDX-License-Identifier: Apache-2.0
#include "sim/engines/ghdl/rtl_hash.hpp"

#include <gtest/gtest.h>

#include "sim/os/test/folder_test.hpp"

namespace halfway {
namespace {

TEST(BareVhdl, HasNoCommentsAndOneSpace) {
  EXPECT_EQ(bare_vhdl("A  <= b; -- c\n\n  d <= \"-- E\";\n"), "a <= b; d <= \"-- E\"; ");
  EXPECT_EQ(bare_vhdl("x; -- \"\ny;"), bare_vhdl("x;\n  y;"));
  EXPECT_EQ(bare_vhdl("a/* b\n -- */<= c;"), "a <= c;");
  EXPECT_NE(bare_vhdl("a <= b;"), bare_vhdl("a <= c;"));
}

TEST(BareVhdl, KeepsLiterals) {
  // A quote as a character begins no string, and no comment is in a literal.
  EXPECT_EQ(bare_vhdl("c = '\"' -- A\nD"), "c = '\"' d");
  EXPECT_NE(bare_vhdl("a = \"--1\";"), bare_vhdl("a = \"--2\";"));
  EXPECT_NE(bare_vhdl("\\a--1\\"), bare_vhdl("\\a--2\\"));
  EXPECT_NE(bare_vhdl("a = 'X';"), bare_vhdl("a = 'x';"));
}

using RtlHash = FolderTest;

TEST_F(RtlHash, ChangesWithTheSourcesAndNotWithComments) {
  write("rtl/files.f", "a.vhd\n");
  const auto hash = [&](std::string_view text) {
    write("rtl/a.vhd", text);
    return must(rtl_hash(here()));
  };
  const std::string one = hash("a <= b;\n");
  EXPECT_EQ(one.size(), 32U) << one;
  EXPECT_EQ(hash("-- comment\na  <= b;\n"), one);
  EXPECT_NE(hash("a <= c;\n"), one);
}

}  // namespace
}  // namespace halfway
