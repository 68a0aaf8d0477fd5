// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "mutants/design.hpp"
#include "mutants/netlist_faults.hpp"
#include "mutants/source_faults.hpp"
#include "sim/system/file.hpp"

namespace halfway::mutants {
namespace {

const std::filesystem::path c_source = HALFWAY_SOURCE_DIR;

TEST(SourceFaults, OldTextsOccurExactlyOnce) {
  const auto faults = read_source_faults(c_source / "tb/mutants/source_faults.toml");
  ASSERT_TRUE(faults) << faults.error().message;
  EXPECT_GE(faults->size(), 40U);
  for (const SourceFault& fault : *faults) {
    if (fault.in_vectors) continue;
    const auto text = read_file(c_source / fault.file);
    ASSERT_TRUE(text) << text.error().message;
    const auto changed = with_fault(fault, *text);
    ASSERT_TRUE(changed) << changed.error().message;
    EXPECT_NE(*changed, *text) << fault.file;
  }
}

TEST(SourceFaults, TextThatIsAbsentOrThereTwiceIsAnError) {
  const SourceFault fault{.file = "x.vhd", .old_text = "a", .new_text = "b", .test = "x"};
  EXPECT_FALSE(with_fault(fault, "c"));
  EXPECT_FALSE(with_fault(fault, "a a"));
  EXPECT_EQ(*with_fault(fault, "c a"), "c b");
}

TEST(SourceFaults, InvertsTheLowestBitOfAWord) {
  SourceFault fault{.file = "x.txt", .line = 2, .word = 2, .in_vectors = true, .test = "x"};
  const std::string text = "1 2F\n3 4E\nend 2\n";
  EXPECT_EQ(*with_fault(fault, text), "1 2F\n3 4F\nend 2\n");
  fault.word = 1;
  EXPECT_EQ(*with_fault(fault, text), "1 2F\n2 4E\nend 2\n");
  fault.line = 9;
  EXPECT_FALSE(with_fault(fault, text));
}

TEST(SourceFaults, FileEndsEarly) {
  const SourceFault fault{.file = "x.txt", .in_vectors = true, .test = "x"};
  EXPECT_EQ(*with_fault(fault, "1\n2\n3\n4\nend 4\n"), "1\n2\n3\n4\n");
}

TEST(VhdlPlaces, AreThoseOfTheCommentBeforeTheStatement) {
  EXPECT_THAT(
      vhdl_places("module m\n  (input a);\n  wire b;\n  /* rtl/x.vhd:12:3  */\n  assign b = a;\n"
                  "  assign c = a; // (signal)\n\n  /* rtl/x.vhd:14:5  */\n  always @(posedge clk)\n"
                  "    if (a)\n      q <= b;\nendmodule\n"),
      testing::ElementsAre("", "", "", "x.vhd:12", "", "x.vhd:14", "x.vhd:14", "x.vhd:14", "x.vhd:14"));
}

TEST(Designs, NameEveryStreamOrColumns) {
  const auto designs = read_designs(c_source / "tb/mutants/designs.toml");
  ASSERT_TRUE(designs) << designs.error().message;
  EXPECT_GE(designs->size(), 40U);
  for (const Design& design : *designs) {
    EXPECT_NE(design.rows.empty(), design.input.port.empty()) << design.name;
    EXPECT_FALSE(design.sets.empty()) << design.name;
  }
}

TEST(Survivors, NameLinesOfTheSources) {
  const auto survivors = read_survivors(c_source / "tb/mutants/survivors.toml");
  ASSERT_TRUE(survivors) << survivors.error().message;
  EXPECT_FALSE(survivors->empty());
  for (const Survivor& survivor : *survivors) {
    const auto text = read_file(c_source / "rtl" / survivor.file);
    ASSERT_TRUE(text) << text.error().message;
    EXPECT_THAT(*text, testing::HasSubstr(survivor.text)) << survivor.file;
    EXPECT_FALSE(survivor.text.empty()) << survivor.file;
    EXPECT_FALSE(survivor.reason.empty()) << survivor.file;
  }
}

}  // namespace
}  // namespace halfway::mutants
