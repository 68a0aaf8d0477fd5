// SPDX-License-Identifier: Apache-2.0
// Rows of docs/accuracy.md: drawings by the RTL in Verilator, compared with the golden model and with
// per-pixel Phong shading. Functions throw Failure (must.hpp); the test reports it.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "frame/metrics.hpp"
#include "page/page.hpp"
#include "plan/plan.hpp"
#include "scene/scene.hpp"
#include "setup/setup.hpp"
#include "sim/study/design_point.hpp"
#include "sim/study/hardware.hpp"

namespace halfway::accuracy {

const SimulatorFolders& folders();

struct Row {
  std::string id;                         ///< unique in its family
  std::function<page::Fields()> measure;  ///< columns and their values

  friend void PrintTo(const Row& row, std::ostream* out) { *out << row.id; }
};

/// The scene of a file, relative to the project's root.
Scene loaded(const std::string& file);

struct Drawn {
  FrameDistance error;  ///< compared with the reference, over the pixels that either covers
  std::uint64_t cycles = 0;
  SetupCounts setup;
};

/// Hardware that a plan elaborates, with the RTL of the checkout.
study::HardwareSource planned(const Scene& scene, const PlanRequest& request);
Drawn drawn(const Scene& scene, FrameSize size, const PlanRequest& request, const SetupOptions& options = {});
/// Gouraud shading in software.
FrameDistance gouraud_error(const Scene& scene, FrameSize size);

/// A point of a study.
study::HardwareSource point_hardware(const study::DesignPoint& point, const Scene& scene);
Drawn drawn(const study::DesignPoint& point, const Scene& scene);
/// Cells of the point's hardware, and its pinned clock if there is one. `scene` as for loaded().
study::HardwareFigures figures_of(const study::DesignPoint& point, const std::string& scene);

/// 12345 as `12 345`.
std::string grouped(std::uint64_t number);

/// The row `FAMILY/ID`.
class Accuracy : public testing::TestWithParam<Row> {};

inline std::string id_of(const testing::TestParamInfo<Row>& info) {
  return info.param.id;
}

// One function per family of rows, each a part of the page.
std::vector<Row> quadratic_rows();
std::vector<Row> spherical_rows();
std::vector<Row> bright_rows();
std::vector<Row> processors_rows();
std::vector<Row> cosine_rows();
std::vector<Row> one_step_rows();
std::vector<Row> root_rows();

}  // namespace halfway::accuracy
