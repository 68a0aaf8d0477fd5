// SPDX-License-Identifier: Apache-2.0
// halfway_proofs: its exit codes and its page, with the proof of a small entity.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>

#include "prover.hpp"
#include "sim/os/file.hpp"
#include "sim/os/must.hpp"
#include "sim/os/subprocess.hpp"
#include "sim/os/test/source_folder.hpp"

namespace halfway::proofs {
namespace {

using testing::HasSubstr;

class ProofProgram : public ::testing::Test {
 protected:
  void SetUp() override {
    find_tools();
    std::filesystem::create_directories(source() / "tb");
    constexpr auto c_all = std::filesystem::copy_options::recursive;
    std::filesystem::copy(c_source_folder / "rtl", source() / "rtl", c_all);
    std::filesystem::copy(c_source_folder / "tb/rtl", source() / "tb/rtl", c_all);
    std::filesystem::create_directories(source() / "docs/results");
    std::filesystem::copy(c_source_folder / "docs/results/proofs.md", page());
  }
  std::filesystem::path source() const { return folder_.path() / "source"; }

  std::string page() const { return source() / "docs/results/proofs.md"; }

  void replace(const std::string& file, const std::string& from, const std::string& to) const {
    std::string text = must(read_file(source() / file));
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    must(write_file(source() / file, text.replace(at, from.size(), to)));
  }

  // Removes the units and descriptions of all other proofs.
  void keep_only(const std::set<std::string>& proofs) const {
    for (const auto& file : must(files_below(source() / "tb/rtl")))
      if (file.has_parent_path() && !proofs.contains(file.stem()))
        std::filesystem::remove(source() / "tb/rtl" / file);
  }

  void commit() const {
    const auto git = [&](std::vector<std::string> arguments) {
      arguments.insert(arguments.begin(), {"git", "-c", "user.name=n", "-c", "user.email=e"});
      const auto end = must(run_process({.arguments = arguments, .working_folder = source()}, ""));
      ASSERT_TRUE(end.succeeded()) << end.output;
    };
    must(write_file(source() / ".gitignore", "build\n"));
    git({"init"});
    git({"add", "."});
    git({"commit", "-m", "x"});
  }

  struct Outcome {
    int exit_code;
    std::string output;
  };
  Outcome run(const std::vector<std::string>& options, const std::string& name = "",
              std::vector<std::pair<std::string, std::string>> environment = {}) const {
    Command command;
    command.arguments = {HALFWAY_PROOFS};
    command.arguments.insert(command.arguments.end(), options.begin(), options.end());
    command.arguments.insert(command.arguments.end(),
                             {source().string(), (folder_.path() / "scratch").string()});
    if (!name.empty()) command.arguments.push_back(name);
    command.working_folder = folder_.path();
    command.environment = std::move(environment);
    command.timeout = std::chrono::minutes(60);
    const auto end = must(run_process(command, ""));
    return {end.exit_status, end.output};
  }

  const TemporaryFolder folder_ = must(TemporaryFolder::make(std::filesystem::temp_directory_path()));
};

TEST_F(ProofProgram, EndsWithOneWhenAPropertyIsFalse) {
  EXPECT_EQ(run({}, "parameter_register").exit_code, 0);
  replace("rtl/stream/parameter_register.vhd", "value <= start;", "value <= not start;");
  const Outcome outcome = run({"--no-faults"}, "parameter_register");
  EXPECT_EQ(outcome.exit_code, 1) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("NOT PROVED: "));
}

TEST_F(ProofProgram, EndsWithOneWhenAFaultIsNotRefuted) {
  replace("tb/rtl/stream/parameter_register.psl", "value = ghost_word", "value = value");
  const Outcome outcome = run({}, "parameter_register");
  EXPECT_EQ(outcome.exit_code, 1) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("does NOT refute"));
}

TEST_F(ProofProgram, EndsWithThreeWhenAUnitDoesNotCompile) {
  replace("tb/rtl/stream/parameter_register.psl", "value = ghost_word", "value = ghost_words");
  EXPECT_EQ(run({"--no-faults"}, "parameter_register").exit_code, 3);
}

TEST_F(ProofProgram, EndsWithThreeWhenAToolIsMissing) {
  const std::vector<std::pair<std::string, std::string>> nowhere = {{"PATH", source().string()}};
  for (const std::vector<std::string>& options : {std::vector<std::string>{}, {"--quick"}}) {
    const Outcome outcome = run(options, "parameter_register", nowhere);
    EXPECT_EQ(outcome.exit_code, 3) << outcome.output;
    EXPECT_THAT(outcome.output, HasSubstr("install it with"));
  }
}

TEST_F(ProofProgram, EndsWithTwoOnBadUsage) {
  EXPECT_EQ(run({}, "no_such_entity").exit_code, 2);
  EXPECT_EQ(run({"--no-such-option"}, "parameter_register").exit_code, 2);
  // A row is of all faults.
  EXPECT_EQ(run({"--evidence", "--quick"}).exit_code, 2);
  // A page is of a commit.
  EXPECT_EQ(run({"--evidence"}).exit_code, 2);
}

TEST_F(ProofProgram, EndsWithTwoWhenTheRtlHasNotTheTextOfAFault) {
  replace("tb/rtl/stream/parameter_register.toml", "if load = '1' then", "if load = '2' then");
  const Outcome outcome = run({}, "parameter_register");
  EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("parameter_register.toml:11: `if load = '2' then` occurs 0 times"));
}

TEST_F(ProofProgram, WritesItsPage) {
  keep_only({"parameter_register"});
  commit();
  const Outcome outcome = run({"--evidence"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  const std::string text = must(read_file(page()));
  EXPECT_THAT(text, HasSubstr("\nMeasured by `make evidence PAGE=proofs` at commit `"));
  EXPECT_THAT(text, testing::MatchesRegex("# Proofs: results\n.*\n\\| property .*\n\\| --- .*\n"
                                          "\\| [^\n]* \\| `stream/parameter_register` \\| induction \\| 1 "
                                          "\\| [0-9.]+ \\| 2 of 2 \\|\n"));
  // A proof that fails has no row, and the page stays.
  replace("rtl/stream/parameter_register.vhd", "value <= start;", "value <= not start;");
  commit();
  EXPECT_EQ(run({"--evidence"}).exit_code, 1);
  EXPECT_EQ(must(read_file(page())), text);
}

}  // namespace
}  // namespace halfway::proofs
