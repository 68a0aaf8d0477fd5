// SPDX-License-Identifier: Apache-2.0
// The set-up and the golden model that draw a frame.
#pragma once

#include <functional>
#include <memory>

#include "golden_run/golden_run.hpp"
#include "plan/hardware_key.hpp"
#include "setup/setup.hpp"

namespace halfway {

/// Makers of set-up and golden model for a key. By default those of the program; made_models() gives those of
/// other word lengths.
struct Models {
  std::function<std::unique_ptr<Setup>(const Scene&, FrameSize, const HardwareKey&, const SetupOptions&)>
      setup = make_setup;
  std::function<std::unique_ptr<GoldenModel>(const HardwareKey&)> golden = make_golden_model;
};

}  // namespace halfway
