// SPDX-License-Identifier: Apache-2.0
// What every program of this project shares: where its checkout lies, and how it ends.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string_view>

#include "common/result.hpp"

namespace halfway::cli {

/// Of the checkout that the program was built from.
struct Folders {
  std::filesystem::path source;
  std::filesystem::path rtl() const { return source / "rtl"; }
  std::filesystem::path scenes() const { return source / "sim" / "scenes"; }
  std::filesystem::path cache() const { return source / "build" / "cache"; }
};

/// Prints the error on stderr and gives its exit code.
int report(const Error& error);

/// Prints a line on stderr, without control characters.
void say(std::string_view line);

/// Parses, and so runs, what was asked for: the program's exit code. The command's callback sets `exit_code`.
/// What could not be written to stdout is told, and ends with tool_failed what ended well.
int run_program(CLI::App& app, int argc, char** argv, const int& exit_code);

/// The command `tables`.
void add_tables(CLI::App& app, const Folders& folders, int& exit_code);

}  // namespace halfway::cli
