// SPDX-License-Identifier: Apache-2.0
// Runs the program as a user does, in the test's own folder.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "sim/os/subprocess.hpp"
#include "sim/os/test/folder_test.hpp"
#include "sim/os/test/source_folder.hpp"

namespace halfway {

/// Matches an outcome with this exit code and with matching output.
MATCHER_P2(Ends, code, output, "") {
  *result_listener << "exit code " << arg.exit_code << ", output:\n" << arg.output;
  return arg.exit_code == code && ::testing::ExplainMatchResult(output, arg.output, result_listener);
}

class CommandTest : public FolderTest {
 protected:
  using Environment = std::vector<std::pair<std::string, std::string>>;

  struct Outcome {
    int exit_code;       ///< -1: not started; -2: ended by a signal, or timed out
    std::string output;  ///< standard output and standard error
  };

  /// Copy the checkout, so that a test may change it. The caches are shared, because their entries are named
  /// by content.
  std::filesystem::path copy_checkout() const {
    namespace fs = std::filesystem;
    const fs::path copy = at("source");
    fs::create_directories(copy / "build");
    for (const char* part : {"rtl", "tb", "sim"})
      fs::copy(c_source_folder / part, copy / part, fs::copy_options::recursive);
    fs::create_directories(c_source_folder / "build" / "cache");
    fs::create_directory_symlink(c_source_folder / "build" / "cache", copy / "build" / "cache");
    return copy;
  }

  Outcome run_as(std::vector<std::string> arguments, Environment environment = {},
                 std::chrono::milliseconds timeout = std::chrono::minutes(60)) const {
    Command command;
    command.arguments = std::move(arguments);
    command.working_folder = here();
    command.environment = std::move(environment);
    command.timeout = timeout;
    const auto end = run_process(command, "");
    if (!end) return {-1, end.error().message};
    if (end->signal != 0 || end->timed_out) return {-2, end->how() + "\n" + end->output};
    return {end->exit_status, end->output};
  }
  Outcome run(std::vector<std::string> arguments, Environment environment = {}) const {
    arguments.insert(arguments.begin(), HALFWAY_PROGRAM);
    return run_as(std::move(arguments), std::move(environment));
  }

  /// PATH with a replacement for a program.
  Environment path_with(const std::string& program, const std::string& script) const {
    put_program(at("bin") / program, script);
    return {{"PATH", at("bin").string() + ":" + std::getenv("PATH")}};
  }
  /// PATH with a replacement for ffmpeg.
  Environment path_with_ffmpeg(const std::string& script) const {
    return path_with("ffmpeg", "#!/bin/sh\n" + script);
  }

  /// A triangle that is seen from behind, except in frame 2 of 4.
  void write_averted() const {
    write("one.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    write("averted.toml",
          "ambient = 0.5\n[camera]\neye = [0.3, 0.3, -3]\ntarget = [0.3, 0.3, 0]\n[[directional]]\n"
          "to_light = [0.4, 0.3, 1]\n[[material]]\nname = \"m\"\n[[mesh]]\nfile = \"one.obj\"\n"
          "material = \"m\"\ncull = \"back\"\n");
  }
  /// A replacement for ffmpeg that keeps its arguments and its input.
  static inline const std::string c_copy = "for last; do :; done; echo \"$@\" >arguments; cat >\"$last\"\n";
};

}  // namespace halfway
