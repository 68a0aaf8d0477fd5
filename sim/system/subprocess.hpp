// SPDX-License-Identifier: Apache-2.0
// Runs another program, without a shell, and tells how it ended.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/result.hpp"

namespace halfway {

struct Command {
  std::vector<std::string> arguments;      ///< the program first, looked up in PATH
  std::filesystem::path working_folder{};  ///< empty: this process's own
  std::filesystem::path
      standard_output{};  ///< a file for it; empty: into ProcessEnd::output with standard error
  /// A descriptor for its standard input, closed here once it has started, or could not; -1: nothing to read.
  int standard_input = -1;
  std::vector<std::pair<std::string, std::string>> environment{};  ///< added to this process's own
  std::optional<std::chrono::milliseconds> timeout{};
  std::function<void()> on_poll{};  ///< called about every `poll_interval` while it runs
  std::chrono::milliseconds poll_interval{200};
};

struct ProcessEnd {
  int exit_status = 0;     ///< of a program that ended by itself
  int signal = 0;          ///< that killed it, else 0
  bool timed_out = false;  ///< killed by us, with all that it started
  std::string output;      ///< standard error and output; the middle is left out where it is very long
  bool succeeded() const { return exit_status == 0 && signal == 0 && !timed_out; }
  /// How it ended, for messages: "exit status 2", "killed by signal 11 (Segmentation fault)".
  std::string how() const;
};

/// Runs the command to its end. An error (exit code tool_failed) only where it could not be started;
/// `install` is the command that brings a missing program, for the message.
Result<ProcessEnd> run_process(const Command& command, const std::string& install);

/// The word in quotes, as a shell takes it for itself.
std::string shell_word(std::string_view word);

/// Where PATH finds the program; empty where it does not.
std::filesystem::path find_program(const std::string& name);

/// The command as a shell would take it, to show in messages.
std::string to_string(const Command& command);

}  // namespace halfway
