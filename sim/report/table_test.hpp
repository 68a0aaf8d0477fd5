// SPDX-License-Identifier: Apache-2.0
// For tests: tables of studies.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "sim/os/csv.hpp"
#include "sim/os/file.hpp"
#include "sim/os/must.hpp"
#include "sim/os/subprocess.hpp"

namespace halfway::report {

class TableTest : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_FALSE(find_program("gnuplot").empty()) << "no gnuplot here: apt-get install gnuplot-nox";
  }
  Table read(const std::string& text) const {
    EXPECT_TRUE(write_file(here() / "t.csv", text));
    return must(read_csv(here() / "t.csv"));
  }
  const std::filesystem::path& here() const { return folder_.path(); }
  const TemporaryFolder folder_ = must(TemporaryFolder::make(std::filesystem::temp_directory_path()));
};

}  // namespace halfway::report
