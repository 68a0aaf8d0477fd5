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
#include "sim/os/test/test_files.hpp"

namespace halfway {

/// Matches an outcome with this exit code and with matching output.
MATCHER_P2(Ends, code, output, "") {
  *result_listener << "exit code " << arg.exit_code << ", output:\n" << arg.output;
  return arg.exit_code == code && ::testing::ExplainMatchResult(output, arg.output, result_listener);
}

class CommandTest : public ::testing::Test {
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
    const fs::path source = HALFWAY_SOURCE_DIR, copy = folder_.path() / "source";
    for (const char* part : {"rtl", "tb", "sim"}) {
      fs::create_directories(copy);
      fs::copy(source / part, copy / part, fs::copy_options::recursive);
    }
    fs::create_directories(source / "build" / "cache");
    fs::create_directories(copy / "build");
    fs::create_directory_symlink(source / "build" / "cache", copy / "build" / "cache");
    return copy;
  }

  Outcome run_as(std::vector<std::string> arguments, Environment environment = {},
                 std::chrono::milliseconds timeout = std::chrono::minutes(60)) const {
    Command command;
    command.arguments = std::move(arguments);
    command.working_folder = folder_.path();
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

  std::filesystem::path at(const std::string& name) const { return folder_.path() / name; }

  /// PATH with a replacement for ffmpeg.
  Environment path_with_ffmpeg(const std::string& script) const {
    const auto bin = folder_.path() / "bin";
    put_program(bin / "ffmpeg", "#!/bin/sh\n" + script);
    return {{"PATH", bin.string() + ":" + std::getenv("PATH")}};
  }

  /// A triangle that is seen from behind, except in frame 2 of 4.
  void write_averted() const {
    ASSERT_TRUE(write_file(at("one.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"));
    ASSERT_TRUE(
        write_file(at("averted.toml"),
                   "ambient = 0.5\n[camera]\neye = [0.3, 0.3, -3]\ntarget = [0.3, 0.3, 0]\n[[directional]]\n"
                   "to_light = [0.4, 0.3, 1]\n[[material]]\nname = \"m\"\n[[mesh]]\nfile = \"one.obj\"\n"
                   "material = \"m\"\ncull = \"back\"\n"));
  }
  /// A replacement for ffmpeg that keeps its arguments and its input.
  static inline const std::string c_copy = "for last; do :; done; echo \"$@\" >arguments; cat >\"$last\"\n";

  const TemporaryFolder folder_ = must(TemporaryFolder::make(std::filesystem::temp_directory_path()));
};

}  // namespace halfway
