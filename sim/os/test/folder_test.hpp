// SPDX-License-Identifier: Apache-2.0
// A test with a folder of its own, and files that tests write or change. A failure throws, and so ends the
// test.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <string_view>

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

class FolderTest : public ::testing::Test {
 protected:
  const std::filesystem::path& here() const { return folder_.path(); }
  std::filesystem::path at(const std::filesystem::path& name) const { return here() / name; }
  /// Write a file and the folders above it. Returns its path.
  std::filesystem::path write(const std::filesystem::path& name, std::string_view text) const {
    must(write_file(at(name), text));
    return at(name);
  }
  std::string text_of(const std::filesystem::path& name) const { return must(read_file(at(name))); }

 private:
  const TemporaryFolder folder_ = must(TemporaryFolder::make(std::filesystem::temp_directory_path()));
};

}  // namespace halfway
