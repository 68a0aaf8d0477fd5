// SPDX-License-Identifier: Apache-2.0
// Lanes on the small RTL of both simulators: they must give the expected fragments, and detect each fault.
#include "sim/extras/lanes/lane_simulator.hpp"
#include "sim/run/simulators_test.hpp"

namespace halfway {
namespace {

class SmallRtlInLanes : public Simulators {
 protected:
  Result<std::vector<Fragment>> lanes(std::size_t most = 1U << 20, LaneOptions options = {}) {
    options.fast = false;
    auto simulator = LaneSimulator::open(key_, folders_, options);
    if (!simulator) return simulator.error();
    std::vector<Fragment> fragments;
    if (auto run = simulator->run(init_.words, fragments, most); !run) return run.error();
    return fragments;
  }
};

TEST_F(SmallRtlInLanes, DetectHangsFaultsAndSuperfluousFragments) {
  const std::size_t limit = expected_.size() - 1;
  EXPECT_TRUE(is_error(lanes(limit), ExitCode::differs));
  for (const unsigned threads : {1U, 3U})
    EXPECT_EQ(must(lanes(limit + 1, {.threads = threads})), expected_) << threads;
  write_rtl({.fault = "if r.left = 9 then v := r; end if;", .valid = "'0' when r.left = 9 else r.valid"});
  EXPECT_TRUE(is_error(lanes(1U << 20, {.idle_limit = 500}), ExitCode::differs, "hang"));
  for (const char* delay : {"0", "4"}) {
    write_rtl(
        {.alarm = "(r.valid and fragment_ready and r.triangle(3) and not r.triangle(31))", .delay = delay});
    EXPECT_TRUE(is_error(lanes(1U << 20, {.idle_limit = 500}), ExitCode::differs, "fault"));
  }
}

}  // namespace
}  // namespace halfway
