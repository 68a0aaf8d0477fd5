// SPDX-License-Identifier: Apache-2.0
// Shared by all programs of this project: the folders of the checkout, and how a program ends.
#pragma once

#include <filesystem>
#include <string_view>

#include "common/result.hpp"

// CLI11 is declared, not included: its header takes six seconds to compile.
namespace CLI {
class App;
}

namespace halfway::cli {

/// Folders of the checkout that the program was built from.
struct Folders {
  std::filesystem::path source;
  std::filesystem::path scenes() const { return source / "sim" / "scenes"; }
  std::filesystem::path cache() const { return source / "build" / "cache"; }
};

/// Print the error on stderr and return its exit code.
int report(const Error& error);

/// Print a line on stderr, without control characters.
void say(std::string_view line);

/// Parse the command line, run the command, and return the program's exit code. The command's callback sets
/// `exit_code`, or throws Failure, which is reported here. If writing to stdout failed, report it; a command
/// that succeeded then ends with tool_failed.
int run_program(CLI::App& app, int argc, char** argv, const int& exit_code);

/// The command `tables`.
void add_tables(CLI::App& app, const Folders& folders, int& exit_code);

}  // namespace halfway::cli
