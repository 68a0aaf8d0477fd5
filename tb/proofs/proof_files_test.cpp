// SPDX-License-Identifier: Apache-2.0
#include "proof_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "prover.hpp"
#include "sim/os/file.hpp"
#include "sim/os/must.hpp"
#include "words/cosine_tables.hpp"

namespace halfway::proofs {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

// A complete proof; tests add keys or replace them.
constexpr const char* c_proof =
    "entity = \"box\"\n"
    "[[proof]]\n"
    "property = \"It holds\"\n"
    "method = \"induction\"\n"
    "clocks = 3\n"
    "quick = true\n"
    "faults = [{ old = \"a\", new = \"b\" }]\n";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

class ProofFiles : public ::testing::Test {
 protected:
  ProofFiles() {
    write("rtl/raster/box.vhd", "");
    write("tb/rtl/raster/box.psl", "");
  }

  void write(const std::string& name, const std::string& text) const {
    must(write_file(folder_.path() / name, text));
  }

  std::vector<Proof> read(const std::string& toml) const {
    write("tb/rtl/raster/box.toml", toml);
    return read_proofs(folder_.path());
  }

  std::string error(const std::string& toml) const {
    const auto proofs = caught([&] { return read(toml); });
    return proofs ? "no error" : proofs.error().message;
  }

  const TemporaryFolder folder_ = must(TemporaryFolder::make(std::filesystem::temp_directory_path()));
};

TEST_F(ProofFiles, ReadsEveryKey) {
  write("tb/rtl/raster/any.psl", "");
  const auto proofs = read(
      "entity = \"box\"\n[[proof]]\nproperty = \"It holds\"\nmethod = \"bounded\"\nclocks = 3\nfault_clocks "
      "= 5\n"
      "quick = true\ngenerics = { g_bits = 4, g_exact = true }\nformats = { depth = [4, 2] }\nany_products = "
      "true\n"
      "contracts = [\"raster/any.psl\"]\n"
      "faults = [\n{ old = \"a\", new = \"b\" },\n{ file = \"x/y.vhd\", occurs = 2, old = \"c\", new = \"d\" "
      "}]\n");
  ASSERT_EQ(proofs.size(), 1U);
  const Proof& proof = proofs.front();
  EXPECT_EQ(proof.entity, "raster/box");
  EXPECT_EQ(proof.unit, "raster/box.psl");
  EXPECT_EQ(proof.property, "It holds");
  EXPECT_EQ(proof.method, Method::bounded);
  EXPECT_EQ(proof.clocks, 3);
  EXPECT_EQ(proof.fault_clocks, 5);
  EXPECT_TRUE(proof.quick && proof.any_products);
  EXPECT_THAT(proof.generics, testing::ElementsAre(std::pair("g_bits", "4"), std::pair("g_exact", "true")));
  for (const auto& formats : {proof.formats, proof.fault_formats}) {
    ASSERT_EQ(formats.size(), 1U);
    EXPECT_EQ(formats[0].name, "depth");
    EXPECT_EQ(formats[0].integer_bits, 4);
    EXPECT_EQ(formats[0].fraction_bits, 2);
  }
  EXPECT_THAT(proof.contracts, testing::ElementsAre("raster/any.psl"));
  ASSERT_EQ(proof.faults.size(), 2U);
  EXPECT_EQ(proof.faults[0].file, "raster/box.vhd");
  EXPECT_EQ(proof.faults[0].old_text, "a");
  EXPECT_EQ(proof.faults[0].new_text, "b");
  EXPECT_EQ(proof.faults[0].occurrences, 1);
  EXPECT_EQ(proof.faults[1].file, "x/y.vhd");
  EXPECT_EQ(proof.faults[1].occurrences, 2);
  EXPECT_EQ(proof.faults[1].where, "tb/rtl/raster/box.toml:14");
}

TEST_F(ProofFiles, TakesValuesOfTheFileUnlessAProofHasItsOwn) {
  const auto proofs = read(
      "entity = \"box\"\nmethod = \"pdr\"\nquick = false\nfaults = [\"both\"]\n"
      "[shared_faults]\nboth = [{ old = \"a\", new = \"b\" }]\n"
      "[[proof]]\nproperty = \"One\"\n"
      "[[proof]]\nproperty = \"Two\"\nquick = true\nfaults = [{ old = \"c\", new = \"d\" }, \"both\"]\n");
  ASSERT_EQ(proofs.size(), 2U);
  EXPECT_FALSE(proofs[0].quick);
  EXPECT_TRUE(proofs[1].quick);
  EXPECT_EQ(proofs[1].method, Method::pdr);
  ASSERT_EQ(proofs[0].faults.size(), 1U);
  EXPECT_EQ(proofs[0].faults[0].old_text, "a");
  ASSERT_EQ(proofs[1].faults.size(), 2U);
  EXPECT_EQ(proofs[1].faults[0].old_text, "c");
  EXPECT_EQ(proofs[1].faults[1].old_text, "a");
}

TEST_F(ProofFiles, LooksForFaultsInTenClocksOrAllOfTheProof) {
  const auto few = read(c_proof);
  EXPECT_EQ(few.front().fault_clocks, 10);
  const auto many = read(replaced(c_proof, "clocks = 3", "clocks = 30"));
  EXPECT_EQ(many.front().fault_clocks, 30);
}

TEST_F(ProofFiles, NarrowsFormatsForFaultsAlone) {
  const auto proofs = read(std::string(c_proof) + "fault_formats = { depth = [4, 2] }\n");
  EXPECT_TRUE(proofs.front().formats.empty());
  EXPECT_EQ(proofs.front().fault_formats.size(), 1U);
}

TEST_F(ProofFiles, NamesFileAndLineOfABadKeyOrValue) {
  const std::string proof = c_proof;
  const std::string file = "tb/rtl/raster/box.toml";
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"a = 1\nb = ]\n", file + ":2: "},
      {"depth = 3\n" + proof, file + ":1: unknown key 'depth'; the keys here are entity, "},
      {proof + "depth = 3\n", file + ":8: unknown key 'depth'; the keys here are property, "},
      {replaced(proof, "new", "from"), file + ":7: unknown key 'from'; the keys here are file, "},
      {replaced(proof, ", new = \"b\"", ""), file + ":7: a fault has no 'new'; "},
      {replaced(proof, "\"b\"", "\"a\""), file + ":7: old and new are equal; "},
      {replaced(proof, "\"b\"", "1"), file + ":7: new must be a text in quotes"},
      {replaced(proof, "new", "occurs = 1, new"), file + ":7: occurs must be a whole number from 2 to "},
      {replaced(proof, "[{ old = \"a\", new = \"b\" }]", "[]"),
       file + ":7: faults must be a list with one element"},
      {replaced(proof, "{ old = \"a\", new = \"b\" }", "\"x\""),
       file + ":7: [shared_faults] has no list 'x'"},
      {proof + "[shared_faults]\nx = [{ old = \"a\", new = \"b\" }]\n", file + ":8: no proof refutes 'x'; "},
      {replaced(proof, "entity = \"box\"", ""), file + ": has no entity; "},
      {replaced(proof, "box", "bax"), file + ":1: rtl/raster/bax.vhd does not exist; "},
      {"entity = \"box\"\n", file + ": has no proof; "},
      {"entity = \"box\"\nproof = 1\n", file + ":2: proof must be a list"},
      {replaced(proof, "property = \"It holds\"", ""), file + ":2: a proof has no 'property'; "},
      {"property = \"It holds\"\n" + proof, file + ":1: unknown key 'property'"},
      {replaced(proof, "induction", "bmc"), file + ":4: method is 'bmc', but must be one of induction, "},
      {replaced(proof, "induction", "gappa"), file + ":4: method 'gappa' does not fit raster/box.psl; "},
      {replaced(proof, "induction", "pdr"), file + ":5: this method takes no clocks; "},
      {replaced(proof, "clocks = 3\n", ""), file + ":2: a proof has no 'clocks'; "},
      {replaced(proof, "clocks = 3", "clocks = 0"), file + ":5: clocks must be a whole number from 1 to "},
      {proof + "fault_clocks = 2\n", file + ":8: fault_clocks must be a whole number from 3 to "},
      {replaced(proof, "quick = true", "quick = 1"), file + ":6: quick must be true or false"},
      {proof + "generics = { g_name = 0.5 }\n", file + ":8: g_name must be a whole number from 0 to "},
      {proof + "formats = { dept = [1, 2] }\n", file + ":8: formats_pkg has no format 'dept'"},
      {proof + "formats = { depth = [1] }\n", file + ":8: depth must be two numbers: "},
      {proof + "formats = { depth = [1, 2] }\nfault_formats = { depth = [1, 2] }\n",
       file + ":9: formats hold with the faults, too; "},
      {proof + "contracts = [\"raster/none.psl\"]\n", file + ":8: tb/rtl/raster/none.psl does not exist"},
      {proof + "golden_table = \"sine\"\n", file + ":8: golden_table: 'sine' is no ROM; "},
      {proof + "golden_table = \"cosine\"\n", file + ":8: golden_table: no cosine table "},
      {proof + "golden_table = \"function\"\n", file + ":8: golden_table: no function table "},
  };
  for (const auto& [text, message] : cases) EXPECT_THAT(error(text), StartsWith(message)) << text;
}

TEST_F(ProofFiles, RefusesAFileWithoutAUnitAndAUnitWithoutAFile) {
  EXPECT_EQ(error(c_proof), "no error");
  write("tb/rtl/raster/lost.psl", "");
  EXPECT_THAT(error(c_proof), StartsWith("tb/rtl/raster/lost.psl: no proof uses it; "));
  EXPECT_EQ(error(std::string(c_proof) + "contracts = [\"raster/lost.psl\"]\n"), "no error");
  std::filesystem::rename(folder_.path() / "tb/rtl/raster/lost.psl",
                          folder_.path() / "tb/rtl/raster/box.gappa");
  EXPECT_THAT(error(c_proof), HasSubstr("box.toml: two units next to it; "));
  std::filesystem::remove(folder_.path() / "tb/rtl/raster/box.gappa");
  std::filesystem::remove(folder_.path() / "tb/rtl/raster/box.psl");
  EXPECT_THAT(error(c_proof), HasSubstr("box.toml: no unit next to it; "));
}

TEST_F(ProofFiles, TakesTheUnitThatItNames) {
  write("tb/rtl/raster/both.psl", "");
  EXPECT_THAT(error(c_proof), HasSubstr("both.psl: no proof uses it"));
  write("tb/rtl/raster/bax.toml", std::string("unit = \"box.psl\"\n") + c_proof);
  EXPECT_EQ(read(std::string("unit = \"both.psl\"\n") + c_proof).back().unit, "raster/both.psl");
  EXPECT_THAT(error(std::string("unit = \"none.psl\"\n") + c_proof),
              StartsWith("tb/rtl/raster/box.toml:1: tb/rtl/raster/none.psl does not exist"));
}

TEST_F(ProofFiles, GivesTheEntriesOfAGoldenTable) {
  const auto proofs = read(std::string(c_proof) +
                           "golden_table = \"cosine\"\n"
                           "generics = { g_exact = false, g_power = 2, g_cosine = \"rom6x6\" }\n");
  const auto& entries = words::c_published_cosine_2_6x6;
  EXPECT_THAT(proofs.front().table, testing::ElementsAreArray(entries.begin(), entries.end()));
  EXPECT_EQ(proofs.front().table_bits, 6);
}

TEST(TextWithFault, ReplacesATextThatOccursAsOftenAsStated) {
  const std::vector<VhdlSource> rtl = {{"rtl/raster/box.vhd", "one two one"}};
  EXPECT_EQ(text_with_fault(rtl, {"raster/box.vhd", "two", "three"}), "one three one");
  EXPECT_EQ(text_with_fault(rtl, {"raster/box.vhd", "one", "four", 2}), "four two one");
}

TEST(TextWithFault, RefusesAnyOther) {
  const std::vector<VhdlSource> rtl = {{"rtl/raster/box.vhd", "one two one"}};
  const auto error = [&](const Fault& fault) {
    const auto text = caught([&] { return text_with_fault(rtl, fault); });
    return text ? *text : text.error().message;
  };
  EXPECT_THAT(error({"raster/box.vhd", "one", "four", 1, "f.toml:3"}),
              StartsWith("f.toml:3: `one` occurs 2 times in rtl/raster/box.vhd, but must occur once; "));
  EXPECT_THAT(error({"raster/box.vhd", "two", "four", 2, "f.toml:3"}), HasSubstr("but must occur 2 times; "));
  EXPECT_THAT(error({"raster/box.vhd", "six", "four", 1, "f.toml:3"}), HasSubstr("`six` occurs 0 times"));
  EXPECT_THAT(error({"raster/bax.vhd", "one", "four", 1, "f.toml:3"}),
              StartsWith("f.toml:3: rtl/raster/bax.vhd is not in rtl/files.f; "));
}

}  // namespace
}  // namespace halfway::proofs
