// SPDX-License-Identifier: Apache-2.0
#include "mesh_files/notes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace halfway {
namespace {

TEST(Notes, KindsBeyondTheMostAreOneNote) {
  Notes notes;
  for (int kind = 0; kind < 100; ++kind) notes.add("file:1", "kind " + std::to_string(kind));
  for (int i = 0; i < 3; ++i) notes.add("file:2", "kind 7");
  notes.add("file:3", "another kind");
  notes.add("file:4", "a third kind");
  const std::vector<std::string> list = notes.list();
  EXPECT_EQ(list.size(), 101u);
  EXPECT_EQ(std::count(list.begin(), list.end(), "file:1: kind 7 (4 times)"), 1);
  EXPECT_EQ(std::count(list.begin(), list.end(), "file:3: more is left out (2 times)"), 1);
}

}  // namespace
}  // namespace halfway
