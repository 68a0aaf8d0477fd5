// SPDX-License-Identifier: Apache-2.0
// Files that tests write or change. A failure throws, and so ends the test.
#pragma once

#include <filesystem>
#include <string>

#include "sim/os/file.hpp"
#include "sim/os/must.hpp"

namespace halfway {

/// Write an executable file, such as a replacement for a tool.
inline void put_program(const std::filesystem::path& file, const std::string& script) {
  must(write_file(file, script));
  std::filesystem::permissions(file, std::filesystem::perms::all);
}

/// Replace the first `from` that follows `after` in a file, which must contain it.
inline void replace_in(const std::filesystem::path& file, const std::string& from, const std::string& to,
                       const std::string& after = "") {
  std::string text = must(read_file(file));
  const std::size_t at = text.find(from, text.find(after));
  if (at == std::string::npos)
    throw Failure{bad_input(file.string() + ": mend this test, it has no " + from)};
  must(write_file(file, text.replace(at, from.size(), to)));
}

}  // namespace halfway
