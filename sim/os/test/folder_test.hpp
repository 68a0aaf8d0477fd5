// SPDX-License-Identifier: Apache-2.0
// A test with a folder of its own. A file that cannot be read or written ends the test by an exception.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <string_view>

#include "sim/os/file.hpp"
#include "sim/os/must.hpp"

namespace halfway {

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
