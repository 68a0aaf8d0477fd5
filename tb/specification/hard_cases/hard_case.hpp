// SPDX-License-Identifier: Apache-2.0
// Hard cases: where a published formula breaks, how the hardware avoids it, and the property that then holds
// (cases.toml). Each family is a file that lists its sweeps and instantiates the tests HardCases with them.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <ostream>
#include <string>
#include <string_view>

#include "specification/hard_cases/trial.hpp"

namespace halfway::stability {

struct HardCase {
  std::string_view id;  ///< the test's name, and the case's in cases.toml
  /// Adds every figure and its bound to the trial, and draws the scenes that reach the hardware.
  void (*sweep)(Trial&);

  friend void PrintTo(const HardCase& c, std::ostream* out) { *out << c.id; }
};

/// Two tests for each case: `Quick` takes part of a second, `Full` up to minutes. Both record the case's row
/// of the page. The cases of a family share simulators.
class HardCases : public testing::TestWithParam<HardCase> {
 protected:
  static void SetUpTestSuite() { s_simulators = std::make_unique<Simulators>(); }
  static void TearDownTestSuite() { s_simulators.reset(); }
  void sweep(bool quick);

 private:
  static std::unique_ptr<Simulators> s_simulators;
};

inline std::string id_of(const testing::TestParamInfo<HardCase>& info) {
  return std::string(info.param.id);
}

}  // namespace halfway::stability
