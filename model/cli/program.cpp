// SPDX-License-Identifier: Apache-2.0
#include "cli/program.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <new>

namespace halfway::cli {

int report(const Error& error) {
  fmt::print(stderr, "{}\n", error.message);
  return static_cast<int>(error.code);
}

int run_program(CLI::App& app, int argc, char** argv, const int& exit_code) {
  const std::string name = app.get_name();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // help and version, on stdout
    fmt::print(stderr, "{0}: {1}; see {0} --help\n", name, error.what());
    return static_cast<int>(ExitCode::bad_input);
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "{}: out of memory; a smaller frame or mesh, or fewer threads, may fit\n", name);
    return static_cast<int>(ExitCode::tool_failed);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}: {}; this should not happen, please report it\n", name, error.what());
    return static_cast<int>(ExitCode::tool_failed);
  }
  return exit_code;
}

}  // namespace halfway::cli
