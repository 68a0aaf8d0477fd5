// SPDX-License-Identifier: Apache-2.0
// Rows of evidence in a file, their page, and the faults of stale ones.
#include "evidence/evidence.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>

#include "evidence/inputs.hpp"
#include "sim/system/file.hpp"

namespace halfway::evidence {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr std::string_view c_page = "# Page\n\nText.\n";

class Rows : public ::testing::Test {
 protected:
  void SetUp() override {
    auto folder = TemporaryFolder::make(std::filesystem::temp_directory_path());
    ASSERT_TRUE(folder) << folder.error().message;
    folder_.emplace(std::move(*folder));
    ASSERT_TRUE(make_folders(root()));
    ASSERT_TRUE(write_file(root() / "page.md", c_page));
  }
  // The temporary folder itself is locked.
  std::filesystem::path root() const { return folder_->path() / "root"; }
  Evidence open(std::vector<Today> today) const {
    auto evidence = Evidence::open({.root = root(), .rows = "rows.txt", .page = "page.md"}, std::move(today));
    EXPECT_TRUE(evidence) << evidence.error().message;
    return *evidence;
  }
  std::string page() const { return *read_file(root() / "page.md"); }

 private:
  std::optional<TemporaryFolder> folder_;
};

Today today(const std::string& name, const std::string& hash, const std::string& property = "p") {
  return {.name = name, .section = "Results", .hash = hash, .fields = {{"property", property}}};
}
Row row(const std::string& name, const std::string& hash, const std::string& seconds) {
  Row row = today(name, hash);
  row.fields.emplace_back("seconds", seconds);
  return row;
}

TEST_F(Rows, ComeBackAsTheyWereWritten) {
  const std::vector<Row> rows = {
      {.name = "a b/c",
       .section = "one",
       .hash = "12",
       .details = "x\\n y",
       .fields = {{"a, b", "1 = 2"}, {"c", ""}}},
      {.name = "d", .section = "two", .hash = "", .fields = {{"table", "| a |\n| \\n |\n"}}}};
  ASSERT_TRUE(write_file(root() / "rows.txt", text_of(rows)));
  const auto back = read_rows(root() / "rows.txt");
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(text_of(*back), text_of(rows));
  ASSERT_EQ(back->size(), 2U);
  EXPECT_EQ((*back)[0].details, rows[0].details);
  EXPECT_EQ((*back)[0].fields, rows[0].fields);
  EXPECT_EQ((*back)[1].fields, rows[1].fields);
}

TEST_F(Rows, OfAFileThatIsWrongNameItsLine) {
  ASSERT_TRUE(write_file(root() / "rows.txt", "[a]\nhash = 1\n[a]\n"));
  const auto twice = read_rows(root() / "rows.txt");
  ASSERT_FALSE(twice);
  EXPECT_THAT(twice.error().message, ::testing::HasSubstr("rows.txt:3: a second row"));
  ASSERT_TRUE(write_file(root() / "rows.txt", "hash = 1\n"));
  EXPECT_FALSE(read_rows(root() / "rows.txt"));
}

TEST_F(Rows, AreWrittenInTheOrderOfThePageWithTheirTable) {
  const Evidence evidence = open({today("a", "1"), today("b", "2")});
  ASSERT_TRUE(evidence.put(row("b", "2", "20")));
  ASSERT_TRUE(evidence.put(row("a", "1", "10")));
  EXPECT_EQ(page(), std::string(c_page) +
                        "\n## Results\n\n| property | seconds |\n| --- | --- |\n| p | 10 |\n| p | 20 |\n");
  EXPECT_THAT(open({today("a", "1"), today("b", "2")}).faults(), IsEmpty());
}

TEST_F(Rows, ThatAreStaleMissingOrLeftOverAreFaults) {
  const Evidence before = open({today("a", "1"), today("b", "2"), today("c", "3"), today("d", "4")});
  for (const char* name : {"a", "b", "c", "d"})
    ASSERT_TRUE(before.put(row(name, std::string(1, static_cast<char>(*name - 'a' + '1')), "1")));
  const Evidence after =
      open({today("a", "1"), today("b", "changed"), today("d", "4", "another property"), today("e", "5")});
  EXPECT_FALSE(after.is_stale("a"));
  EXPECT_TRUE(after.is_stale("b"));
  EXPECT_FALSE(after.is_stale("d"));
  EXPECT_TRUE(after.is_stale("e"));
  EXPECT_THAT(after.faults(),
              ElementsAre("rows.txt:9: b: what it depends on has changed; make evidence measures it again",
                          "rows.txt:21: d: its description has changed; make evidence rewrites it",
                          "rows.txt: e: was never measured; make evidence measures it",
                          "rows.txt:15: c: does not exist any more; make evidence removes it"));
  // What needs no measurement is mended.
  ASSERT_TRUE(after.finish());
  const Evidence mended =
      open({today("a", "1"), today("b", "changed"), today("d", "4", "another property"), today("e", "5")});
  EXPECT_EQ(mended.faults().size(), 2U);
  ASSERT_TRUE(mended.put(row("b", "changed", "2")));
  ASSERT_TRUE(mended.remove("b"));
  EXPECT_THAT(open({today("a", "1"), today("d", "4", "another property")}).faults(), IsEmpty());
}

TEST_F(Rows, AndAPageThatIsNotWrittenFromThemAreAFault) {
  ASSERT_TRUE(open({today("a", "1")}).put(row("a", "1", "10")));
  std::string text = page();
  text.replace(text.find("| 10 |"), 6, "| 11 |");
  ASSERT_TRUE(write_file(root() / "page.md", text));
  EXPECT_THAT(open({today("a", "1")}).faults(),
              ElementsAre("page.md: is not written from rows.txt; make evidence writes it"));
}

TEST(BareCpp, HasNoCommentsAndNoWhiteSpace) {
  EXPECT_EQ(bare_cpp("int a = 1;  // one\n/* two */ int b;\n"), "inta=1;intb;");
  EXPECT_EQ(bare_cpp("f( 1'000, ' ', '\\'' ); // \""), "f(1'000,' ','\\'');");
  EXPECT_EQ(bare_cpp("s = \"a // b \\\" c\" ;"), "s=\"a // b \\\" c\";");
  EXPECT_EQ(bare_cpp("s = R\"x(a // \" b)x\" ; // c"), "s=R\"x(a // \" b)x\";");
  EXPECT_NE(bare_cpp("a / b"), bare_cpp("a + b"));
  EXPECT_EQ(bare_cpp("a /* open"), "a");
}

TEST_F(Rows, HashesOfFoldersIgnoreCommentsAndTests) {
  const auto hash = [&](std::string_view source, std::string_view test) {
    EXPECT_TRUE(make_folders(root() / "x"));
    EXPECT_TRUE(write_file(root() / "x/a.cpp", source));
    EXPECT_TRUE(write_file(root() / "x/a_test.cpp", test));
    const auto result = sources_hash(root(), "x");
    return result ? *result : result.error().message;
  };
  const std::string one = hash("int a;\n", "");
  EXPECT_EQ(hash("int  a; // b\n", "int t;"), one);
  EXPECT_NE(hash("int b;\n", ""), one);
  EXPECT_FALSE(sources_hash(root(), "y"));
}

}  // namespace
}  // namespace halfway::evidence
