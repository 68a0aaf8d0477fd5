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

constexpr const char* c_files[] = {"rtl/tables/formats_pkg.vhd", "rtl/tables/cosine_pkg.vhd",
                                   "rtl/tables/function_pkg.vhd", "docs/rtl/init-vectors.md"};

TEST_F(TablesCommand, WritesWhatIsCommittedAndThenFindsItAsGenerated) {
  const Outcome lacking = run({"--check"});
  EXPECT_EQ(lacking.exit_code, 1) << lacking.output;
  EXPECT_FALSE(std::filesystem::exists(source()));
  const Outcome written = run({});
  EXPECT_EQ(written.exit_code, 0) << written.output;
  const Outcome checked = run({"--check"});
  EXPECT_EQ(checked.exit_code, 0) << checked.output;
  for (const char* file : c_files) {
    EXPECT_THAT(lacking.output, HasSubstr(std::string(file) + ":1: not what the generator writes"));
    EXPECT_THAT(written.output, HasSubstr(std::string(file) + ": written\n"));
    EXPECT_THAT(checked.output, HasSubstr(std::string(file) + ": as generated\n"));
    EXPECT_TRUE(text_of(source() / file) == text_of(c_source_folder / file)) << file << ": run `make tables`";
  }
}

// The page of the init vectors has the numbers of the host's commands.
TEST_F(TablesCommand, WritesTheNumbersOfCommands) {
  using words::Command;
  ASSERT_EQ(run({}).exit_code, 0);
  const std::string page = text_of("source/docs/rtl/init-vectors.md");
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

TEST_F(TablesCommand, TakesASize) {
  const std::vector<std::string> size = {"--preset", "published", "--cosine", "5x6"};
  std::vector<std::string> check = size;
  check.push_back("--check");
  ASSERT_EQ(run({}).exit_code, 0);
  EXPECT_THAT(run(check), Ends(1, HasSubstr("rtl/tables/cosine_pkg.vhd:")));

  const Outcome written = run(size);
  EXPECT_EQ(written.exit_code, 0) << written.output;
  EXPECT_THAT(
      written.output,
      AllOf(ContainsRegex("published +cos\\^2 +5x6 .* 192 bits"), ContainsRegex("published +cos\\^2 +4x4 "),
            ContainsRegex("exact +cos\\^2 +9x8 "), Not(ContainsRegex("published +cos\\^2 +6x6 "))));
  EXPECT_EQ(run(check).exit_code, 0);
  const Outcome stale = run({"--check"});
  EXPECT_EQ(stale.exit_code, 1) << stale.output;
  // The C++ headers have the sizes of the checkout's VHDL.
  const auto headers = tables::cpp_headers(tables::sizes_of(source()));
  EXPECT_THAT(headers.at(1).text,
              AllOf(HasSubstr("c_published_cosine_size{5, 6};"), HasSubstr("c_exact_cosine_size{9, 8};")));
  EXPECT_THAT(text_of("source/rtl/tables/cosine_pkg.vhd"),
              HasSubstr("default_cosine (exact : boolean) return cosine_t is\n  begin\n    if exact then\n"
                        "      return rom9x8;\n    end if;\n    return rom5x6;"));

  ASSERT_EQ(run({}).exit_code, 0);
  EXPECT_EQ(run({"--check"}).exit_code, 0);
}

TEST_F(TablesCommand, ASizeIsForOnePresetAndUnique) {
  EXPECT_THAT(run({"--cosine", "12x8"}),
              Ends(0, AllOf(ContainsRegex("exact +cos\\^16 +12x8 .* 32768 bits"), Not(HasSubstr(" 9x8 ")),
                            ContainsRegex("published +cos\\^2 +6x6 "))));
  const Outcome again = run({"--preset", "published", "--cosine", "4x4"});
  EXPECT_EQ(again.exit_code, 0) << again.output;
  const std::regex line("published +cos\\^2 +4x4 ");
  EXPECT_EQ(std::distance(std::sregex_iterator(again.output.begin(), again.output.end(), line), {}), 1)
      << again.output;
}

// A preset has exactly one explicitly requested size. Tables of an earlier run are removed, with a message.
TEST_F(TablesCommand, PrintsTheRemovedTables) {
  EXPECT_THAT(run({}).output, Not(HasSubstr(" go; "))) << "there were none";
  EXPECT_THAT(run({}).output, Not(HasSubstr(" go; ")));
  EXPECT_THAT(run({"--cosine", "12x8"}).output,
              AllOf(HasSubstr("preset exact: the tables of 9x8 address x data bits go; for them again: make "
                              "tables PRESET=exact COSINE=9x8\n"),
                    Not(HasSubstr("preset published: the tables"))));
  const std::vector<std::string> other = {"--preset", "published", "--cosine", "5x6"};
  std::vector<std::string> check = other;
  check.emplace_back("--check");
  EXPECT_THAT(run(check).output, Not(HasSubstr(" go; "))) << "--check changes nothing";
  EXPECT_THAT(run(other).output,
              AllOf(HasSubstr("preset exact: the tables of 12x8 address x data bits go; for them again: make "
                              "tables PRESET=exact COSINE=12x8\n"),
                    HasSubstr("preset published: the tables of 6x6 address x data bits go"),
                    Not(HasSubstr("4x4 address x data bits go"))));
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
      {{"--preset", "best"}, "--preset: 'best' is not a preset; take exact or published"},
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
