// SPDX-License-Identifier: Apache-2.0
// The list of proofs, and what halfway_proofs says by its exit code. Nothing here takes a solver but the
// proofs of a small entity, which are skipped where one is missing.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <optional>
#include <regex>
#include <set>
#include <string>

#include "prover.hpp"
#include "sim/ghdl/ghdl_library.hpp"
#include "sim/system/file.hpp"
#include "sim/system/subprocess.hpp"

namespace halfway::proofs {
namespace {

const std::filesystem::path c_source = HALFWAY_SOURCE_DIR;

std::string without_comments(const std::string& vhdl) {
  return std::regex_replace(vhdl, std::regex("--[^\n]*"), "");
}

struct StreamPort {
  std::string name;
  bool out;
};

// Ports of a valid/ready stream. All declarations stand one a line.
std::vector<StreamPort> stream_ports(const std::string& vhdl) {
  std::vector<StreamPort> ports;
  const std::string text = without_comments(vhdl);
  const std::size_t begin = text.find("\nentity "), end = text.find("end entity", begin);
  if (begin == std::string::npos) return ports;
  const std::string entity = text.substr(begin, end - begin);
  const std::regex port(R"((\w+_(?:valid|ready)) *: (in|out) )");
  for (std::sregex_iterator at(entity.begin(), entity.end(), port), last; at != last; ++at)
    ports.push_back({(*at)[1], (*at)[2] == "out"});
  return ports;
}

bool has_word(const std::string& text, const std::string& word) {
  return std::regex_search(text, std::regex("\\b" + word + "\\b"));
}

// Statements that assert, without the rest.
std::string assertions(const std::string& unit) {
  std::string result;
  const std::regex assertion(": assert [^;]*;");
  for (std::sregex_iterator at(unit.begin(), unit.end(), assertion), last; at != last; ++at)
    result += at->str();
  return result;
}

TEST(ProofList, AssertsEveryPortOfEveryStream) {
  const auto sources = read_rtl_sources(c_source);
  ASSERT_TRUE(sources) << sources.error().message;
  const auto proofs = all_proofs();
  int ports = 0;
  for (const VhdlSource& source : *sources) {
    const auto path = std::filesystem::path(source.name).lexically_relative("rtl").replace_extension();
    std::string units;
    std::set<std::string> seen;
    for (const Proof& proof : proofs) {
      if (path != proof.entity || !seen.insert(proof.unit).second) continue;
      const auto unit = read_file(c_source / "tb/proofs" / proof.unit);
      ASSERT_TRUE(unit) << unit.error().message;
      units += without_comments(*unit);
    }
    for (const StreamPort& port : stream_ports(source.content)) {
      ++ports;
      EXPECT_TRUE(has_word(port.out ? assertions(units) : units, port.name))
          << path << ": no proof of it says anything of " << port.name;
    }
  }
  EXPECT_GE(ports, 37);  // in nine entities
}

TEST(ProofList, FindsThePortsOfAStream) {
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

TEST(ProofList, HasFaultsThatOccurOnce) {
  const auto sources = read_rtl_sources(c_source);
  ASSERT_TRUE(sources) << sources.error().message;
  for (const Proof& proof : all_proofs()) {
    EXPECT_FALSE(proof.faults.empty()) << proof.unit << ": " << proof.property;
    for (const Fault& fault : proof.faults) {
      int found = 0;
      for (const VhdlSource& source : *sources)
        if (source.name == std::string("rtl/") + fault.file)
          for (std::size_t at = 0; (at = source.content.find(fault.from, at)) != std::string::npos; ++at)
            ++found;
      // Of a format that both presets have, preset exact's is meant.
      EXPECT_TRUE(found == 1 || (found > 0 && std::string(fault.file) == "tables/formats_pkg.vhd"))
          << fault.file << ": `" << fault.from << "` occurs " << found << " times";
    }
  }
}

class ProofProgram : public ::testing::Test {
 protected:
  void SetUp() override {
    auto folder = TemporaryFolder::make(std::filesystem::temp_directory_path());
    ASSERT_TRUE(folder) << folder.error().message;
    folder_.emplace(std::move(*folder));
    std::filesystem::create_directories(source() / "tb");
    constexpr auto all = std::filesystem::copy_options::recursive;
    std::filesystem::copy(c_source / "rtl", source() / "rtl", all);
    std::filesystem::copy(c_source / "tb/proofs", source() / "tb/proofs", all);
  }
  std::filesystem::path source() const { return folder_->path() / "source"; }

  void exchange(const std::string& file, const std::string& from, const std::string& to) const {
    auto text = read_file(source() / file);
    ASSERT_TRUE(text) << text.error().message;
    const std::size_t at = text->find(from);
    ASSERT_NE(at, std::string::npos) << from;
    text->replace(at, from.size(), to);
    ASSERT_TRUE(write_file(source() / file, *text));
  }

  struct Outcome {
    int exit_code;
    std::string output;
  };
  Outcome run(std::vector<std::string> options, const std::string& part,
              std::vector<std::pair<std::string, std::string>> environment = {}) const {
    Command command;
    command.arguments = {HALFWAY_PROOFS};
    command.arguments.insert(command.arguments.end(), options.begin(), options.end());
    command.arguments.insert(command.arguments.end(),
                             {source().string(), (folder_->path() / "scratch").string(), part});
    command.working_folder = folder_->path();
    command.environment = std::move(environment);
    command.timeout = std::chrono::minutes(5);
    const auto end = run_process(command, "");
    if (!end) return {-1, end.error().message};
    return {end->exit_status, end->output};
  }

  std::optional<TemporaryFolder> folder_;
};

TEST_F(ProofProgram, EndsWithOneWhereAPropertyIsFalse) {
  ASSERT_TRUE(find_tools()) << find_tools().error().message;
  EXPECT_EQ(run({}, "parameter_register").exit_code, 0);
  exchange("rtl/stream/parameter_register.vhd", "value <= start;", "value <= not start;");
  const Outcome outcome = run({"--no-faults"}, "parameter_register");
  EXPECT_EQ(outcome.exit_code, 1) << outcome.output;
  EXPECT_NE(outcome.output.find("NOT PROVED: "), std::string::npos) << outcome.output;
}

TEST_F(ProofProgram, EndsWithOneWhereAFaultIsNotRefuted) {
  ASSERT_TRUE(find_tools()) << find_tools().error().message;
  exchange("tb/proofs/stream/parameter_register.psl", "value = ghost_word", "value = value");
  const Outcome outcome = run({}, "parameter_register");
  EXPECT_EQ(outcome.exit_code, 1) << outcome.output;
  EXPECT_NE(outcome.output.find("does NOT refute"), std::string::npos) << outcome.output;
}

TEST_F(ProofProgram, EndsWithThreeWhereAUnitDoesNotCompile) {
  ASSERT_TRUE(find_tools()) << find_tools().error().message;
  exchange("tb/proofs/stream/parameter_register.psl", "value = ghost_word", "value = ghost_words");
  EXPECT_EQ(run({"--no-faults"}, "parameter_register").exit_code, 3);
}

TEST_F(ProofProgram, EndsWithThreeWhereAToolIsMissingAndSkipsTheQuickOnes) {
  const std::vector<std::pair<std::string, std::string>> nowhere = {{"PATH", source().string()}};
  const Outcome all = run({}, "parameter_register", nowhere);
  EXPECT_EQ(all.exit_code, 3) << all.output;
  EXPECT_NE(all.output.find("install it with"), std::string::npos) << all.output;
  const Outcome quick = run({"--quick"}, "parameter_register", nowhere);
  EXPECT_EQ(quick.exit_code, 77) << quick.output;
  EXPECT_NE(quick.output.find("skipped: "), std::string::npos) << quick.output;
}

TEST_F(ProofProgram, EndsWithTwoWhereNothingIsMeant) {
  EXPECT_EQ(run({}, "no_such_entity").exit_code, 2);
  EXPECT_EQ(run({"--no-such-option"}, "parameter_register").exit_code, 2);
}

}  // namespace
}  // namespace halfway::proofs
