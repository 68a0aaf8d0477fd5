// SPDX-License-Identifier: Apache-2.0
// Replacements for Yosys and nextpnr in a folder of their own, for tests. GHDL is the real one.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "sim/ghdl/ghdl_library.hpp"
#include "sim/system/file.hpp"
#include "sim/system/must.hpp"
#include "sim/system/subprocess.hpp"

namespace halfway::synth {

class StandInTools : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_FALSE(find_program("ghdl").empty()) << "no ghdl: " << c_install_ghdl;
    ASSERT_TRUE(make_folders(bin()));
  }

  std::filesystem::path root() const { return folder_.path(); }
  std::filesystem::path bin() const { return root() / "bin"; }
  /// PATH with the replacements first.
  std::string path_before(const std::string& path) const { return bin().string() + ":" + path; }
  void put(const char* name, const std::string& text) const {
    ASSERT_TRUE(write_file(bin() / name, text));
    std::filesystem::permissions(bin() / name, std::filesystem::perms::all);
  }

 private:
  const TemporaryFolder folder_ = must(TemporaryFolder::make(std::filesystem::temp_directory_path()));
};

}  // namespace halfway::synth
