// SPDX-License-Identifier: Apache-2.0
// All proofs together: each stream, each fault and each table.
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <set>
#include <string>

#include "proof_files.hpp"
#include "prover.hpp"
#include "sim/os/file.hpp"
#include "sim/os/must.hpp"
#include "sim/os/test/source_folder.hpp"
#include "words/cosine_tables.hpp"

namespace halfway::proofs {
namespace {

std::string without_comments(const std::string& vhdl) {
  return std::regex_replace(vhdl, std::regex("--[^\n]*"), "");
}

struct StreamPort {
  std::string name;
  bool out;
};

// Ports of a valid/ready stream, also of AXI4-Stream's names. Every declaration is on its own line.
std::vector<StreamPort> stream_ports(const std::string& vhdl) {
  std::vector<StreamPort> ports;
  const std::string text = without_comments(vhdl);
  const std::size_t begin = text.find("\nentity "), end = text.find("end entity", begin);
  if (begin == std::string::npos) return ports;
  const std::string entity = text.substr(begin, end - begin);
  const std::regex port(R"((\w+_t?(?:valid|ready)) *: (in|out) )");
  for (std::sregex_iterator at(entity.begin(), entity.end(), port), last; at != last; ++at)
    ports.push_back({(*at)[1], (*at)[2] == "out"});
  return ports;
}

bool has_word(const std::string& text, const std::string& word) {
  return std::regex_search(text, std::regex("\\b" + word + "\\b"));
}

// Only the statements that assert.
std::string assertions(const std::string& unit) {
  std::string result;
  const std::regex assertion(": assert [^;]*;");
  for (std::sregex_iterator at(unit.begin(), unit.end(), assertion), last; at != last; ++at)
    result += at->str();
  return result;
}

class ProofList : public ::testing::Test {
 protected:
  // The units of an entity, without comments.
  std::string units_of(const std::string& entity) const {
    std::set<std::string> names;
    for (const Proof& proof : proofs_)
      if (proof.entity == entity) names.insert(proof.unit);
    std::string units;
    for (const std::string& name : names)
      units += without_comments(must(read_file(c_source_folder / "tb/rtl" / name)));
    return units;
  }

  const std::vector<VhdlSource> rtl_ = must(read_rtl_sources(c_source_folder));
  const std::vector<Proof> proofs_ = read_proofs(c_source_folder);
};

// A port that is connected to a port of the same name, of one of these entities, is asserted in that entity's
// proof.
bool is_connected_to_proved(const std::string& architecture, const std::string& port) {
  for (const char* proved : {"axi_adapter", "block_source", "block_collector"}) {
    const auto inside = architecture.find(fmt::format("entity work.{}\n", proved));
    if (inside != std::string::npos &&
        std::regex_search(architecture.substr(inside), std::regex("\\b" + port + "\\s*=> " + port + "\\b")))
      return true;
  }
  return false;
}

TEST_F(ProofList, AssertsEveryPortOfEveryStream) {
  int ports = 0;
  for (const VhdlSource& source : rtl_) {
    const std::string entity =
        std::filesystem::path(source.name).lexically_relative("rtl").replace_extension().string();
    const std::string units = units_of(entity);
    for (const StreamPort& port : stream_ports(source.content)) {
      ++ports;
      if (is_connected_to_proved(source.content, port.name)) continue;
      EXPECT_TRUE(has_word(port.out ? assertions(units) : units, port.name))
          << entity << ": no proof of it names " << port.name;
    }
  }
  EXPECT_GE(ports, 37);  // in nine entities
}

TEST(StreamPorts, AreFoundInTheEntity) {
  const auto ports = stream_ports(
      "\nentity e is\n  port (\n    a_valid   : in  std_logic; -- b_valid : in x\n    a_ready : out "
      "std_logic;\n"
      "    other : in std_logic\n  );\nend entity;\n signal c_valid : in x");
  ASSERT_EQ(ports.size(), 2U);
  EXPECT_EQ(ports[0].name, "a_valid");
  EXPECT_FALSE(ports[0].out);
  EXPECT_EQ(ports[1].name, "a_ready");
  EXPECT_TRUE(ports[1].out);
}

// Signals, constants and values of types.
std::set<std::string> declared_names(const std::string& vhdl) {
  const std::regex lists(R"(\b(?:(?:signal|constant) ([\w, ]+) *:|type \w+ is \(([\w,\s]+)\);))"),
      word(R"(\w+)");
  std::set<std::string> names;
  for (std::sregex_iterator at(vhdl.begin(), vhdl.end(), lists), last; at != last; ++at) {
    const std::string list = (*at)[1].str() + (*at)[2].str();
    for (std::sregex_iterator name(list.begin(), list.end(), word); name != last; ++name)
      names.insert(name->str());
  }
  return names;
}

// GHDL 5 refuses a property with the name of a signal; GHDL 2 does not.
TEST_F(ProofList, NamesNoPropertyAsTheRtl) {
  const std::regex label(R"((\w+) *: (?:assert|assume|cover|restrict) )");
  int labels = 0;
  for (const VhdlSource& source : rtl_) {
    const std::string entity =
        std::filesystem::path(source.name).lexically_relative("rtl").replace_extension().string();
    const std::string units = units_of(entity);
    if (units.find("vunit ") == std::string::npos) continue;
    const std::set<std::string> declared = declared_names(without_comments(source.content));
    for (std::sregex_iterator at(units.begin(), units.end(), label), last; at != last; ++at, ++labels)
      EXPECT_FALSE(declared.contains((*at)[1])) << entity << ": " << (*at)[1];
  }
  EXPECT_GT(labels, 100);
}

TEST_F(ProofList, HasFaultsThatOccurInTheRtl) {
  for (const Proof& proof : proofs_) {
    const auto rtl = read_sources({.source = c_source_folder, .scratch = {}}, proof);
    for (const Fault& fault : proof.faults) EXPECT_NO_THROW(text_with_fault(rtl, fault)) << fault.where;
  }
}

TEST_F(ProofList, ComparesEveryTableWithTheGoldenModel) {
  std::set<std::vector<std::uint64_t>> cosines;
  std::set<std::string> functions;
  for (const Proof& proof : proofs_) {
    if (proof.entity == "tables/cosine_rom") cosines.insert(proof.table);
    if (proof.entity == "tables/function_rom" && !proof.table.empty())
      functions.insert(fmt::format("{}", fmt::join(proof.generics, " ")));
  }
  for (const words::CosineTable& table : words::c_cosine_tables)
    EXPECT_TRUE(cosines.contains({table.entries.begin(), table.entries.end()}))
        << "power " << table.power << ", " << to_string(table.size)
        << ": tb/rtl/tables/cosine_rom.toml has no proof of it; add one";
  EXPECT_EQ(functions.size(), 6U);  // three functions in two presets
}

}  // namespace
}  // namespace halfway::proofs
