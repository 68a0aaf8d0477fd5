// SPDX-License-Identifier: Apache-2.0
#include "sim/study/frame_time.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/engines/ghdl/test/checkout.hpp"
#include "sim/os/csv.hpp"
#include "sim/os/test/folder_test.hpp"
#include "sim/study/host_setup.hpp"
#include "sim/study/table.hpp"

namespace halfway::study {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

class FrameTimes : public FolderTest {
 protected:
  // `host_ns` 0: not measured.
  void add(Method method, const std::string& hardware, double host_ns, std::uint64_t cycles, double rms) {
    Record record{{.method = method}, {}};
    record.measured.hardware = hardware;
    record.measured.cycles = cycles;
    record.measured.picture.rms = rms;
    if (host_ns > 0) record.measured.host_time = HostTime{.ns = host_ns, .words = 7};
    records_.push_back(record);
  }
  std::vector<Record> records_;
  HardwareTable hardware_ = {{"q", {.mhz = 100.0}}, {"s", {}}, {"p", {.mhz = {}, .fits = false}}};
};

TEST_F(FrameTimes, AddAndOverlapHostAndHardware) {
  add(Method::quadratic, "q", 3e5, 20'000, 2);  // 20 000 clocks of 10 ns
  add(Method::gouraud, "", 4e5, 0, 5);
  const auto pictures = frame_times_of(records_, hardware_, {});
  ASSERT_EQ(pictures.size(), 1U);
  const FrameTime &time = pictures[0].times.at(0), &software = pictures[0].times.at(1);
  EXPECT_DOUBLE_EQ(*time.hardware_ns, 2e5);
  EXPECT_DOUBLE_EQ(time.overlapped_ns(), 3e5);
  EXPECT_DOUBLE_EQ(time.sequential_ns(), 5e5);
  EXPECT_FALSE(software.hardware_ns);
  EXPECT_DOUBLE_EQ(software.overlapped_ns(), 4e5);
  EXPECT_DOUBLE_EQ(software.sequential_ns(), 4e5);
  for (const FrameTime& each : {time, software}) EXPECT_STREQ(each.bound(), "host");
}

TEST_F(FrameTimes, HardwareWithoutAClockHasNoTime) {
  add(Method::quadratic, "q", 1e5, 100'000, 2);
  add(Method::spherical, "s", 1e5, 100'000, 1);     // its clock is not known
  add(Method::processors_2, "p", 1e5, 100'000, 0);  // does not fit
  add(Method::adaptive, "q", 0, 100'000, 1);        // its host's time is not known
  EXPECT_EQ(frame_times_of(records_, hardware_, {})[0].times.size(), 1U);
  EXPECT_EQ(frame_times_of(records_, hardware_, {})[0].without_clock, 2U);
  // A clock can be assumed, but not for hardware that does not fit.
  const auto assumed = frame_times_of(records_, hardware_, 50.0);
  ASSERT_EQ(assumed[0].times.size(), 2U);
  EXPECT_DOUBLE_EQ(*assumed[0].times[1].hardware_ns, 2e6);
  EXPECT_THAT(to_text(assumed[0], records_), HasSubstr("1 of hardware without a clock are left out"));
}

TEST_F(FrameTimes, FrontIsByOverlappedTimeAndError) {
  add(Method::quadratic, "q", 1e5, 20'000, 4);  // 0.2 ms, 0.3 in sequence
  add(Method::adaptive, "q", 2e5, 20'000, 2);   // 0.2 ms, 0.4 in sequence: beats the first
  add(Method::spherical, "q", 9e5, 20'000, 3);  // 0.9 ms: beaten
  add(Method::phong, "", 5e6, 0, 0);
  const auto pictures = frame_times_of(records_, hardware_, {});
  EXPECT_THAT(quickest_of(pictures[0], records_), ElementsAre(1U, 3U));
  const std::string text = to_text(pictures[0], records_);
  EXPECT_THAT(
      text,
      AllOf(HasSubstr("       0.2         0.4       0.2       0.2  host             2        0  "
                      "adaptive exact, threshold 2\n"),
            HasSubstr("         5           5         5         -  host             0        0  phong\n"),
            Not(HasSubstr("spherical"))));
}

TEST_F(FrameTimes, TableHasEveryKnownTime) {
  for (auto& [name, cost] : hardware_) cost.device = "FPGA 1";
  add(Method::quadratic, "q", 1e5, 20'000, 4);
  add(Method::phong, "", 5e6, 0, 0);
  add(Method::processors_2, "p", 1e5, 20'000, 0);
  const auto table =
      must(read_csv(write("times.csv", times_csv({}, records_, frame_times_of(records_, hardware_, {})))));
  ASSERT_EQ(table.rows.size(), 2U);  // the processors do not fit
  const std::array<const char*, 3> values[] = {{"device", "FPGA 1", ""},
                                               {"clock_mhz", "100.0", ""},
                                               {"design", "quadratic exact", "phong"},
                                               {"bound", "hardware", "host"},
                                               {"words", "7", ""}};
  for (const auto& [column, hardware, software] : values) {
    EXPECT_EQ(table.text(0, column), hardware);
    EXPECT_EQ(table.text(1, column), software);
  }
  for (const auto& [column, ns] :
       {std::pair{"host_ns", 1e5}, {"hardware_ns", 2e5}, {"overlapped_ns", 2e5}, {"sequential_ns", 3e5}})
    EXPECT_EQ(table.number(0, column), ns);
  EXPECT_EQ(table.text(1, "hardware_ns"), "");
}

// The time grows with the work, and the words are those of the stream.
TEST(HostTimes, AreMeasuredForHardwareAndSoftware) {
  const std::string name = c_source_folder / "sim/study/spaces/sphere.toml";
  const auto time_of = [&](const DesignPoint& point) { return host_time(point, name, c_checkout); };
  const HostTime coarse = time_of({.method = Method::quadratic, .tessellation = 0.5});
  const HostTime fine = time_of({.method = Method::quadratic, .tessellation = 3});
  EXPECT_GT(coarse.ns, 0);
  EXPECT_GT(fine.ns, 4 * coarse.ns);  // 36 times the triangles
  EXPECT_GT(fine.words, 8 * coarse.words);
  const HostTime phong = time_of({.method = Method::phong, .size = {64, 48}});
  EXPECT_GT(phong.ns, 0);
  EXPECT_EQ(phong.words, 0U);
  EXPECT_GT(time_of({.method = Method::phong, .size = {640, 480}}).ns, 8 * phong.ns);  // 100 times the pixels
  EXPECT_GT(time_of({.method = Method::gouraud, .size = {64, 48}}).ns, 0);
}

}  // namespace
}  // namespace halfway::study
