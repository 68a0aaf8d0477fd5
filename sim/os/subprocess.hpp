// SPDX-License-Identifier: Apache-2.0
// Run another program without a shell and report how it ended.
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
  std::vector<std::string> arguments;      ///< program first, looked up in PATH
  std::filesystem::path working_folder{};  ///< empty: the current folder
  std::filesystem::path
      standard_output{};  ///< output file; empty: ProcessEnd::output, together with standard error
  /// Descriptor for standard input. It is closed here after the start, also if the start fails. -1: no input.
  int standard_input = -1;
  std::vector<std::pair<std::string, std::string>> environment{};  ///< added to this process's environment
  std::optional<std::chrono::milliseconds> timeout{};
  std::function<void()> on_poll{};  ///< called about every `poll_interval` while it runs
  std::chrono::milliseconds poll_interval{200};
};

struct ProcessEnd {
  int exit_status = 0;     ///< of a program that was not killed
  int signal = 0;          ///< the signal that killed it, otherwise 0
  bool timed_out = false;  ///< killed here with all its children
  std::string output;      ///< standard error and output; the middle of long output is omitted
  bool succeeded() const { return exit_status == 0 && signal == 0 && !timed_out; }
  /// How the program ended, for messages: "exit status 2", "killed by signal 11 (Segmentation fault)".
  std::string how() const;
};

/// Run the command to its end. Returns an error (exit code tool_failed) only if the program does not start.
/// `install` is the command that installs a missing program; the message contains it.
Result<ProcessEnd> run_process(const Command& command, const std::string& install);

/// The word with shell quotes, so that a shell takes it literally.
std::string shell_word(std::string_view word);

/// The path of the program in PATH; empty if not found.
std::filesystem::path find_program(const std::string& name);

/// The command in shell syntax, for messages.
std::string to_string(const Command& command);
/// The message for a command that failed while `doing`.
std::string failed_text(const std::string& doing, const Command& command, const ProcessEnd& end);

}  // namespace halfway
