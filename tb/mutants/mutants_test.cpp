// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <string>

#include "mutants/design.hpp"
#include "mutants/netlist_faults.hpp"
#include "mutants/rows.hpp"
#include "mutants/source_faults.hpp"
#include "sim/os/file.hpp"
#include "sim/os/must.hpp"

namespace halfway::mutants {
namespace {

const std::filesystem::path c_source = HALFWAY_SOURCE_DIR;

TEST(SourceFaults, OldTextsOccurExactlyOnce) {
  const auto faults = read_source_faults(c_source / "tb/mutants/source_faults.toml");
  EXPECT_GE(faults.size(), 40U);
  for (const SourceFault& fault : faults) {
    if (fault.in_vectors) continue;
    const std::string text = must(read_file(c_source / fault.file));
    const std::string changed = with_fault(fault, text);
    EXPECT_NE(changed, text) << fault.file;
  }
}

TEST(SourceFaults, TextThatIsAbsentOrThereTwiceIsAnError) {
  const SourceFault fault{.file = "x.vhd", .old_text = "a", .new_text = "b", .test = "x"};
  EXPECT_THROW(with_fault(fault, "c"), Failure);
  EXPECT_THROW(with_fault(fault, "a a"), Failure);
  EXPECT_EQ(with_fault(fault, "c a"), "c b");
}

TEST(SourceFaults, InvertsTheLowestBitOfAWord) {
  SourceFault fault{.file = "x.txt", .line = 2, .word = 2, .in_vectors = true, .test = "x"};
  const std::string text = "1 2F\n3 4E\nend 2\n";
  EXPECT_EQ(with_fault(fault, text), "1 2F\n3 4F\nend 2\n");
  fault.word = 1;
  EXPECT_EQ(with_fault(fault, text), "1 2F\n2 4E\nend 2\n");
  fault.word = 3;  // not the first word of the next line
  EXPECT_THROW(with_fault(fault, text), Failure);
  fault.line = 9;
  EXPECT_THROW(with_fault(fault, text), Failure);
}

TEST(SourceFaults, FileEndsEarly) {
  const SourceFault fault{.file = "x.txt", .in_vectors = true, .test = "x"};
  EXPECT_EQ(with_fault(fault, "1\n2\n3\n4\nend 4\n"), "1\n2\n3\n4\n");
}

TEST(SelectableFaults, AreThoseOfTheNetlistThatYosysWrites) {
  const std::string mutated =
      "  assign _1_ = mutsel == 16'h0001;\n  assign _2_ = mutsel == 16'h00ff;\n  assign _3_ = a == "
      "16'h0002;\n";
  EXPECT_THAT(selectable_faults(mutated), testing::ElementsAre(1, 255));
}

TEST(ModulesOf, AreThoseOfTheEntitiesAndWhatOnlyTheyContain) {
  const std::string netlist =
      "module half_8\n  adder_8 sum (\nendmodule\n"
      "module power_8\n  rom_8 table (\n  adder_8 sum (\n  shift_8 left (\nendmodule\n"
      "module top\n  half_8 a (\n  power_8 b (\n  shift_8 c (\nendmodule\n";
  EXPECT_THAT(modules_of(netlist, {"power"}), testing::ElementsAre("power_8", "rom_8"));
  EXPECT_THAT(modules_of(netlist, {"power", "half", "pow"}),
              testing::ElementsAre("adder_8", "half_8", "power_8", "rom_8"));
  EXPECT_THAT(modules_of(netlist, {"pow"}), testing::IsEmpty());
  EXPECT_THAT(modules_of(netlist, {}), testing::IsEmpty());
}

TEST(VhdlPlaces, AreThoseOfTheCommentBeforeTheStatement) {
  EXPECT_THAT(
      vhdl_places("module m\n  (input a);\n  wire b;\n  /* rtl/x.vhd:12:3  */\n  assign b = a;\n"
                  "  assign c = a; // (signal)\n\n  /* rtl/x.vhd:14:5  */\n  always @(posedge clk)\n"
                  "    if (a)\n      q <= b;\nendmodule\n"),
      testing::ElementsAre("", "", "", "x.vhd:12", "", "x.vhd:14", "x.vhd:14", "x.vhd:14", "x.vhd:14"));
}

TEST(Designs, NameEveryStreamOrColumns) {
  const auto designs = read_designs(c_source);
  EXPECT_GE(designs.size(), 40U);
  for (const Design& design : designs) {
    EXPECT_NE(design.rows.empty(), design.input.port.empty()) << design.name;
    EXPECT_FALSE(design.sets.empty()) << design.name;
  }
}

// The entities of the RTL, each with the entities that it contains.
std::map<std::string, std::set<std::string>> entities_with_parts() {
  const auto sources = must(read_rtl_sources(c_source));
  const std::regex entity(R"((?:^|\n)entity (\w+) is)"), part(R"(\bentity work\.(\w+))");
  std::map<std::string, std::set<std::string>> entities;
  for (const VhdlSource& source : sources) {
    std::smatch name;
    if (!std::regex_search(source.content, name, entity)) continue;
    std::set<std::string>& parts = entities[name[1]];
    for (std::sregex_iterator at(source.content.begin(), source.content.end(), part), last; at != last; ++at)
      parts.insert((*at)[1]);
  }
  return entities;
}

// True if `outer` contains `inner`, and not only inside one of `closed`.
bool contains(const std::map<std::string, std::set<std::string>>& entities, const std::string& outer,
              const std::string& inner, const std::vector<std::string>& closed) {
  const auto parts = entities.find(outer);
  return parts != entities.end() && std::ranges::any_of(parts->second, [&](const std::string& part) {
           return part == inner || (std::ranges::find(closed, part) == closed.end() &&
                                    contains(entities, part, inner, closed));
         });
}

TEST(Designs, HaveEveryEntityOrTheReason) {
  const auto designs = read_designs(c_source);
  const auto without = read_without(c_source / "tb/mutants/designs.toml");
  const auto entities = entities_with_parts();
  EXPECT_GT(entities.size(), 50U);
  std::set<std::string> listed;
  for (const Design& design : designs) listed.insert(design.entity);
  for (const Without& one : without) {
    EXPECT_TRUE(listed.insert(one.entity).second) << one.entity << " is listed twice";
    EXPECT_NE(one.within.empty(), one.reason.empty()) << one.entity;
    if (one.within.empty()) continue;
    const auto outer = std::ranges::find(designs, one.within, &Design::entity);
    ASSERT_NE(outer, designs.end()) << one.within << " has no netlist";
    EXPECT_TRUE(contains(entities, one.within, one.entity, outer->without_faults))
        << one.entity << " gets no faults in " << one.within;
  }
  for (const auto& [entity, parts] : entities)
    EXPECT_TRUE(listed.contains(entity)) << entity << ": add a netlist, or [[without]] a reason";
  for (const std::string& name : listed) EXPECT_TRUE(entities.contains(name)) << name << " is not in rtl/";
}

// The page of two rows of netlists and one of a testbench.
TEST(Rows, BecomeThePage) {
  const auto netlist = [](const std::string& name, const std::string& details) {
    return page::Row{.name = name,
                     .section = std::string(c_netlist_section),
                     .fields = {{"netlist", name},
                                {"replayed", "all"},
                                {"faults", "10"},
                                {"found", "7"},
                                {"equivalent", "2"},
                                {"survived", "1"},
                                {"seconds", "3"}},
                     .details = details};
  };
  const std::vector<page::Row> rows = {
      netlist("a",
              "kind\tinv\t10\t7\t2\t1\nsurvivor\tstream/count.vhd: if reset = '1' then\t4 inv Y n1[0]\n"),
      netlist("b",
              "kind\tinv\t4\t4\t0\t0\nkind\tconst0\t6\t3\t2\t1\nsurvivor\tx.vhd: y;\t5 const0 A n2[0]\n"),
      {.name = "sources of c",
       .section = std::string(c_source_section),
       .fields = {{"testbench", "c_tb"}, {"faults", "2"}, {"found", "2"}}}};
  const TemporaryFolder folder = must(TemporaryFolder::make(std::filesystem::temp_directory_path()));
  const auto listed = folder.path() / "tb/mutants/survivors.toml";
  must(make_folders(listed.parent_path()));
  must(write_file(listed,
                  "survivor = [{ file = \"stream/count.vhd\", text = \"if reset\", reason = \"starts at "
                  "zero\" }, { file = \"not known\", text = \"c.\", reason = \"constant\" }]\n"));
  const Reasons reasons(folder.path());
  EXPECT_EQ(reasons.of("", "c.wide"), "constant");
  EXPECT_EQ(reasons.of("", "d.wide"), "");
  const auto sections = mutant_sections(rows, reasons);
  ASSERT_EQ(sections.size(), 3U);
  EXPECT_THAT(
      sections[0].body,
      testing::HasSubstr("Of the 16 faults that are not proved equivalent, the vectors find 87.5 %."));
  EXPECT_THAT(sections[0].body, testing::HasSubstr("| **all** |  | 20 | 14 | 4 | 2 |  |"));
  EXPECT_THAT(sections[0].body, testing::HasSubstr("| const0 | 6 | 3 | 2 | 1 |\n| inv | 14 | 11 | 2 | 1 |"));
  EXPECT_THAT(sections[1].body, testing::HasSubstr("| c_tb | 2 | 2 |"));
  EXPECT_THAT(sections[2].body, testing::HasSubstr("| `a` | 1 | `4 inv Y n1[0]` | starts at zero |"));
  EXPECT_THAT(sections[2].body,
              testing::HasSubstr("| `x.vhd: y;` | `b` | 1 | `5 const0 A n2[0]` | not decided |"));
  // Thresholds judge the faults found of those that are not proved equivalent.
  const auto values = mutant_values(rows);
  ASSERT_EQ(values.size(), 3U);
  EXPECT_EQ(values[0].name, "a");
  EXPECT_THAT(values[0].numbers, testing::ElementsAre(87.5));
  EXPECT_EQ(values[2].name, "all netlists");
  EXPECT_THAT(values[2].numbers, testing::ElementsAre(87.5));
}

TEST(Survivors, NameLinesOfTheSources) {
  const auto survivors = read_survivors(c_source / "tb/mutants/survivors.toml");
  for (const Survivor& survivor : survivors) {
    EXPECT_FALSE(survivor.reason.empty()) << survivor.file;
    if (survivor.file == "not known") continue;
    EXPECT_THAT(must(read_file(c_source / "rtl" / survivor.file)), testing::HasSubstr(survivor.text))
        << survivor.file;
    EXPECT_FALSE(survivor.text.empty()) << survivor.file;
  }
}

}  // namespace
}  // namespace halfway::mutants
