// SPDX-License-Identifier: Apache-2.0
// For tests: tables of studies.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "sim/os/csv.hpp"
#include "sim/os/subprocess.hpp"
#include "sim/os/test/folder_test.hpp"

namespace halfway::report {

class TableTest : public FolderTest {
 protected:
  void SetUp() override {
    ASSERT_FALSE(find_program("gnuplot").empty()) << "no gnuplot here: apt-get install gnuplot-nox";
  }
  Table read(const std::string& text) const { return must(read_csv(write("t.csv", text))); }
};

}  // namespace halfway::report
