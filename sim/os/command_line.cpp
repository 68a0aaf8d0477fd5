// SPDX-License-Identifier: Apache-2.0
#include "sim/os/command_line.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>

#include "sim/os/must.hpp"
#include "sim/os/printable.hpp"

namespace halfway::cli {

void say(std::string_view line) {
  fmt::print(stderr, "{}\n", printable(line));
}

int report(const Error& error) {
  say(error.message);
  return static_cast<int>(error.code);
}

namespace {

int parse_and_run(CLI::App& app, int argc, char** argv, const int& exit_code) {
  const std::string name = app.get_name();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // help and version are printed on stdout
    say(fmt::format("{0}: {1}; see {0} --help", name, error.what()));
    return static_cast<int>(ExitCode::bad_input);
  } catch (const Failure& failure) {
    return report(failure.error);
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "{}: out of memory; a smaller frame or mesh, or fewer threads, may fit\n", name);
    return static_cast<int>(ExitCode::tool_failed);
  } catch (const std::exception& error) {
    if (std::ferror(stdout) != 0) return static_cast<int>(ExitCode::tool_failed);  // reported by run_program
    say(fmt::format("{}: {}; this should not happen, please report it", name, error.what()));
    return static_cast<int>(ExitCode::tool_failed);
  }
  return exit_code;
}

}  // namespace

int run_program(CLI::App& app, int argc, char** argv, const int& exit_code) {
  const int code = parse_and_run(app, argc, argv, exit_code);
  errno = 0;  // an earlier flush may have failed without a recorded reason
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return code;
  const std::string why = errno == 0 ? "" : fmt::format(" ({})", std::strerror(errno));
  say(fmt::format("standard output: not all could be written{}; make room, or send it elsewhere", why));
  return code == 0 ? static_cast<int>(ExitCode::tool_failed) : code;
}

}  // namespace halfway::cli
