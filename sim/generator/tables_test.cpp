// SPDX-License-Identifier: Apache-2.0
// Tests of the command `halfway tables`: files written, messages, and changes found.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>

#include "sim/cli/command_test.hpp"
#include "sim/generator/generated_files.hpp"
#include "words/processors_layout.hpp"

namespace halfway {
namespace {

using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

class TablesCommand : public CommandTest {
 protected:
  Outcome run(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {HALFWAY_PROGRAM, "--source", source(), "tables"});
    return run_as(std::move(arguments));
  }
  std::filesystem::path source() const { return at("source"); }
};

// Also a register's offset that is changed, and a page without the marks of its parts.
TEST_F(TablesCommand, WritesWhatIsCommittedAndThenFindsItAsGenerated) {
  const std::vector<std::string> of_registers = {"rtl/core/core_registers_pkg.vhd", "docs/rtl/core.md"};
  std::vector<std::string> files = {"rtl/tables/formats_pkg.vhd", "rtl/tables/cosine_pkg.vhd",
                                    "rtl/tables/function_pkg.vhd", "halfway.core",
                                    "docs/rtl/init-vectors.md"};
  files.insert(files.end(), of_registers.begin(), of_registers.end());
  for (const char* file :
       {"rtl/files.f", "rtl/core/core_registers.toml", "docs/rtl/core.md", "docs/rtl/init-vectors.md"})
    write(source() / file, text_of(c_source_folder / file));
  replace_in(source() / "docs/rtl/init-vectors.md", "| 43:32 |", "| 44:33 |");
  replace_in(source() / "docs/rtl/core.md", "| 00 |", "| 01 |");
  const Outcome lacking = run({"--check"});
  EXPECT_FALSE(std::filesystem::exists(source() / "rtl/tables"));
  const Outcome written = run({});
  const Outcome checked = run({"--check"});
  EXPECT_THAT((std::vector{lacking.exit_code, written.exit_code, checked.exit_code}), ElementsAre(1, 0, 0));
  for (const std::string& file : files) {
    EXPECT_THAT(lacking.output, ContainsRegex(file + ":[0-9]+: not what the generator writes"));
    EXPECT_THAT(written.output, HasSubstr(file + ": written\n"));
    EXPECT_THAT(checked.output, HasSubstr(file + ": as generated\n"));
    EXPECT_TRUE(text_of(source() / file) == text_of(c_source_folder / file)) << file << ": run `make tables`";
  }
  replace_in(source() / "rtl/core/core_registers.toml", "offset = 0x30", "offset = 0xFC");
  const Outcome stale = run({"--check"});
  for (const std::string& file : of_registers)
    EXPECT_THAT(stale.output, ContainsRegex(file + ":[0-9]+: .*edit rtl/core/core_registers.toml"));
  write(source() / "docs/rtl/core.md", "no parts\n");
  EXPECT_THAT(run({"--check"}), Ends(2, HasSubstr("docs/rtl/core.md: wants one part")));
}

TEST(InitVectorsPage, HasTheNumbersOfCommands) {
  using words::Command;
  const std::string page = must(read_file(c_source_folder / "docs/rtl/init-vectors.md"));
  for (const auto& [name, command] :
       {std::pair{"new_object", Command::new_object}, std::pair{"new_scanline", Command::new_scanline},
        std::pair{"new_frame", Command::new_frame}, std::pair{"define", Command::define},
        std::pair{"redefine", Command::redefine}, std::pair{"delete", Command::remove},
        std::pair{"shadow", Command::shadow}})
    EXPECT_THAT(page, HasSubstr(fmt::format("\n| {} | {} |", name, static_cast<unsigned>(command))));
}

TEST_F(TablesCommand, PrintsTheCostOfEachTable) {
  for (const auto& arguments : {std::vector<std::string>{}, {"--check"}}) {
    const std::string output = run(arguments).output;
    EXPECT_THAT(
        output,
        AllOf(ContainsRegex("exact +cos\\^1 +9x8 +address x data bits +4096 bits +largest error +0.88/255"),
              ContainsRegex("exact +cos\\^2 +9x8 .* 4096 bits +largest error +0.88/255 \\(0.00346\\)"),
              ContainsRegex("exact +cos\\^4 +9x8 .* 4096 bits"),
              ContainsRegex("exact +cos\\^8 +9x8 .* 4096 bits"),
              ContainsRegex("exact +cos\\^16 +9x8 .* 4096 bits"),
              ContainsRegex("published +cos\\^1 +6x6 .* 384 bits"),
              ContainsRegex("published +cos\\^2 +6x6 .* 384 bits +largest error +6.68/255"),
              ContainsRegex("published +cos\\^1 +4x4 .* 64 bits"),
              ContainsRegex("published +cos\\^2 +4x4 .* 64 bits +largest error +27.71/255")));
  }
}

// A preset has exactly one requested size. Tables of an earlier run are removed, with a message.
TEST_F(TablesCommand, TakesASizeForOnePresetAndNamesTheRemovedTables) {
  const std::vector<std::string> size = {"--preset", "published", "--cosine", "5x6"};
  std::vector<std::string> check = size;
  check.emplace_back("--check");
  for (int again = 0; again < 2; ++again) EXPECT_THAT(run({}), Ends(0, Not(HasSubstr(" go; "))));
  EXPECT_THAT(run(check), Ends(1, AllOf(HasSubstr("rtl/tables/cosine_pkg.vhd:"), Not(HasSubstr(" go; ")))));
  EXPECT_THAT(
      run(size),
      Ends(0, AllOf(ContainsRegex("published +cos\\^2 +5x6 .* 192 bits"),
                    ContainsRegex("published +cos\\^2 +4x4 "), ContainsRegex("exact +cos\\^2 +9x8 "),
                    Not(ContainsRegex("published +cos\\^2 +6x6 ")),
                    HasSubstr("preset published: the tables of 6x6 address x data bits go; for them again: "
                              "make tables PRESET=published COSINE=6x6\n"),
                    Not(HasSubstr("4x4 address x data bits go")), Not(HasSubstr("exact: the tables")))));
  EXPECT_EQ(run(check).exit_code, 0);
  EXPECT_EQ(run({"--check"}).exit_code, 1);
  // The C++ headers have the sizes of the checkout's VHDL.
  const auto headers = tables::cpp_headers(tables::sizes_of(source()));
  EXPECT_THAT(headers.at(1).text,
              AllOf(HasSubstr("c_published_cosine_size{5, 6};"), HasSubstr("c_exact_cosine_size{9, 8};")));
  EXPECT_THAT(text_of("source/rtl/tables/cosine_pkg.vhd"),
              HasSubstr("default_cosine (exact : boolean) return cosine_t is\n  begin\n    if exact then\n"
                        "      return rom9x8;\n    end if;\n    return rom5x6;"));
  const std::string again = run({"--preset", "published", "--cosine", "4x4"}).output;
  const std::regex line("published +cos\\^2 +4x4 ");
  EXPECT_EQ(std::distance(std::sregex_iterator(again.begin(), again.end(), line), {}), 1) << again;
}

TEST_F(TablesCommand, RefusesInvalidSizesAndWritesNothing) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
      {{"--cosine", "2x8"}, "--cosine: '2x8' is not ADDRESSxDATA bits"},
      {{"--cosine", "13x8"}, "3x2 to 12x12"},
      {{"--cosine", "nine"}, "'nine' is not"},
      {{"--cosine", "9"}, "'9' is not"},
      {{"--cosine", "9.5x8"}, "is not"},
      {{"--cosine=-9x8"}, "is not"},
      {{"--cosine", "9x99999999999"}, "is not"},
      {{"--cosine", "9x1"}, "is not"},
      {{"--cosine", "9x13"}, "is not"},
      {{"--preset", "best"}, "--preset: best not in {exact,published}"},
      {{"--check", "--cosine", "x"}, "3x2 to 12x12"},
      {{"--errors", "--check"}, "excludes"},
      {{"--errors", "--cosine", "9x8"}, "excludes"},
  };
  for (const auto& [arguments, expected] : cases) {
    EXPECT_THAT(run(arguments), Ends(2, HasSubstr(expected)));
    EXPECT_FALSE(std::filesystem::exists(source())) << expected;
  }
}

TEST_F(TablesCommand, ErrorsBySizeAreAReportOnly) {
  EXPECT_THAT(run({"--errors"}),
              Ends(0, AllOf(ContainsRegex("data bits +4 +5 +6 +7 +8 +9 +10\n"),
                            ContainsRegex("\n 9 +8.71 +4.49 +2.39 +1.37 +0.88 +0.63 +0.51\n"))));
  EXPECT_THAT(run({"--errors", "--preset", "published"}), Ends(0, ContainsRegex("\n 6 +13.00 +9.14 +6.68 ")));
  EXPECT_FALSE(std::filesystem::exists(source()));
}

// Change one entry by one at the start, in the middle and at the end of the tables.
TEST_F(TablesCommand, AFlippedEntryIsCaughtAndLocated) {
  const std::string name = "rtl/tables/cosine_pkg.vhd";
  const std::filesystem::path file = source() / name;
  ASSERT_EQ(run({}).exit_code, 0);
  const std::string whole = text_of(file);
  const std::size_t first = whole.find("c_exact_cosine_1_"), last = whole.rfind("15, 14, 12");
  ASSERT_NE(first, std::string::npos);
  ASSERT_NE(last, std::string::npos);
  for (const std::size_t near : {whole.find('\n', first), (first + last) / 2, last}) {
    const std::size_t at = whole.find(',', near) - 1;
    std::string changed = whole;
    changed[at] = whole[at] == '9' ? '8' : static_cast<char>(whole[at] + 1);
    write(file, changed);
    const auto line = 1 + std::count(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(at), '\n');
    EXPECT_THAT(run({"--check"}),
                Ends(1, HasSubstr(name + ":" + std::to_string(line) + ": not what the generator writes")));
    EXPECT_TRUE(text_of(file) == changed) << "--check wrote";
  }
  // Also remove the last character of the file.
  write(file, whole.substr(0, whole.size() - 1));
  EXPECT_EQ(run({"--check"}).exit_code, 1);
}

}  // namespace
}  // namespace halfway
