// SPDX-License-Identifier: Apache-2.0
// Tests a frame of any engine: what is compared, stored and reported, for all fragments and moments.
#include "sim/driver/rtl_frame.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/test/is_error.hpp"
#include "plan/plan.hpp"
#include "sim/driver/frame_driver.hpp"
#include "sim/files/test/built_in_scene.hpp"
#include "sim/files/trace.hpp"
#include "sim/os/test/folder_test.hpp"

namespace halfway {
namespace {

using ::testing::HasSubstr;

Fragment fragment(std::uint16_t x, std::uint8_t red) {
  return {.triangle = 0, .z = 1, .y = 0, .x = x, .red = red, .green = 0, .blue = 0};
}
const std::vector<Fragment> c_golden{fragment(0, 10), fragment(1, 20), fragment(2, 30)};

/// Outputs the given fragments, `late` of them in drain(). If `error` is set, draw() then returns it.
class StandIn final : public Engine {
 public:
  explicit StandIn(std::vector<Fragment> fragments, std::size_t late = 0)
      : fragments_(std::move(fragments)), late_(late) {}
  std::optional<Error> error;
  std::vector<std::uint64_t> limits;

  EngineKind kind() const override { return EngineKind::verilator; }
  Result<std::shared_ptr<Engine>> another() const override { return tool_failed("not needed"); }
  Status draw(std::span<const std::uint32_t>, std::uint64_t most, const OnDrawn& on_drawn) override {
    limits.push_back(most);
    // One fragment at a time.
    for (std::size_t i = 0; i + late_ < fragments_.size(); ++i) on_drawn(std::span(fragments_).subspan(i, 1));
    return error ? Status(*error) : Status(Ok{});
  }
  Status drain(std::uint64_t most, const OnDrawn& on_drawn) override {
    limits.push_back(most);
    on_drawn(std::span(fragments_).last(late_));
    return Ok{};
  }
  std::optional<std::uint64_t> cycles() const override { return 7; }

 private:
  std::vector<Fragment> fragments_;
  std::size_t late_;
};

std::shared_ptr<StandIn> stand_in(std::vector<Fragment> fragments, std::size_t late = 0) {
  return std::make_shared<StandIn>(std::move(fragments), late);
}

// The frame of wrong hardware contains all fragments inside it, before and after those outside.
TEST(RtlFrame, KeepsWhatLiesInTheFrame) {
  RtlFrame frame(
      stand_in({fragment(0, 10), fragment(7, 99), fragment(1, 20), fragment(8, 99), fragment(2, 30)}), {3, 1},
      {});
  ASSERT_TRUE(frame.add({}, c_golden));
  ASSERT_TRUE(frame.finish());
  EXPECT_EQ(frame.assembler().frame().rgb, (std::vector<std::uint8_t>{10, 0, 0, 20, 0, 0, 30, 0, 0}));
  const SimulatorRun run = frame.result();
  EXPECT_EQ(run.fragments, 5U);
  EXPECT_EQ(run.fault, "a fragment lies outside the frame");
  EXPECT_TRUE(frame.alive());
}

TEST(RtlFrame, ComparesWheneverFragmentsCome) {
  for (std::size_t late = 0; late <= 3; ++late) {
    const auto engine = stand_in(c_golden, late);
    std::vector<Fragment> seen;
    RtlFrame frame(engine, {3, 1}, {},
                   {.on_drawn = [&](auto part) { seen.insert(seen.end(), part.begin(), part.end()); }});
    for (int again = 0; again < 2; ++again) {
      engine->limits.clear();
      seen.clear();
      frame.clear();
      ASSERT_TRUE(frame.add({}, c_golden));
      ASSERT_TRUE(frame.finish());
      const SimulatorRun run = frame.result();
      EXPECT_TRUE(run.equal()) << run.description;
      EXPECT_EQ(run.fragments, 3U);
      EXPECT_EQ(run.cycles, 7U);
      EXPECT_TRUE(run.seconds);
      EXPECT_EQ(seen, c_golden);
      // The expected fragments that are missing, plus a surplus.
      EXPECT_EQ(engine->limits, (std::vector<std::uint64_t>{10'003, 10'000 + late}));
    }
  }
}

TEST(RtlFrame, ReportsDifferentMissingAndSuperfluousFragments) {
  const std::vector<std::pair<std::vector<Fragment>, std::string>> cases = {
      {{fragment(0, 10), fragment(1, 21), fragment(2, 30)}, "pixel 1, red: golden 20, Verilator 21"},
      {{fragment(0, 10), fragment(1, 20)}, "pixel 2: golden has it, Verilator ended before"},
      {{fragment(0, 10), fragment(1, 20), fragment(2, 30), fragment(2, 30)}, "only Verilator has it"}};
  for (const auto& [drawn, expected] : cases)
    for (std::size_t late = 0; late < 3; ++late) {
      RtlFrame frame(stand_in(drawn, late), {3, 1}, {});
      ASSERT_TRUE(frame.add({}, c_golden));
      ASSERT_TRUE(frame.finish());
      const SimulatorRun run = frame.result();
      EXPECT_EQ(run.mismatches, 1U);
      EXPECT_THAT(run.description, HasSubstr(expected));
      ASSERT_EQ(run.first.size(), 1U);
    }
}

TEST(RtlFrame, AFaultEndsTheDrawingAndOtherErrorsAreTheCallers) {
  const auto engine = stand_in({fragment(0, 10)}, 1);
  RtlFrame frame(engine, {3, 1}, {});
  engine->error = Error{ExitCode::differs, "hang"};
  ASSERT_TRUE(frame.add({}, c_golden));
  EXPECT_FALSE(frame.alive());
  ASSERT_TRUE(frame.add({}, c_golden));
  ASSERT_TRUE(frame.finish());
  EXPECT_EQ(engine->limits.size(), 1U);
  const SimulatorRun run = frame.result();
  EXPECT_EQ(run.fault, "hang");
  EXPECT_EQ(run.fragments, 0U);
  EXPECT_EQ(run.mismatches, 6U) << "golden fragments count after the fault, too";

  engine->error = tool_failed("broken");
  frame.clear();
  EXPECT_TRUE(frame.alive());
  EXPECT_TRUE(is_error(frame.add({}, c_golden), "broken"));
}

using StoredRtlFrame = FolderTest;

TEST_F(StoredRtlFrame, ReadsGoldenFragmentsFromATrace) {
  const auto trace = at("golden.trace");
  const auto finish = [&](std::shared_ptr<StandIn> engine) {
    bool complete = false;
    RtlFrame frame(std::move(engine), {3, 1}, {},
                   {.late_golden = [&complete, stored = stored_fragments(trace)](std::size_t most) {
                     EXPECT_TRUE(complete) << "the trace is read while it is written";
                     return stored(most);
                   }});
    // These fragments are only counted.
    EXPECT_TRUE(frame.add({}, std::vector<Fragment>(3, fragment(2, 99))));
    complete = true;
    const Status ended = frame.finish();
    return ended ? Result<SimulatorRun>(frame.result()) : ended.error();
  };
  EXPECT_FALSE(finish(stand_in(c_golden, 3)));
  ASSERT_TRUE(write_trace(trace, "key", {c_golden, {}}));
  const auto all = must(finish(stand_in(c_golden, 3)));
  EXPECT_TRUE(all.equal()) << all.description;
  const auto few = must(finish(stand_in({c_golden[0]}, 1)));
  EXPECT_EQ(few.mismatches, 2U);
  // A truncated trace.
  write(trace, "halfway-trace 1 key\n0 0 0 1 10 0 0\n");
  EXPECT_FALSE(finish(stand_in(c_golden, 3)));
}

/// A scene's vectors and fragments.
struct Vectors {
  HardwareKey key;
  std::vector<std::uint32_t> words;
  std::vector<Fragment> golden;
};
constexpr FrameSize c_rtl_size{48, 36};

Vectors vectors_of(Shader shader) {
  const Scene scene = built_in_scene("matte");
  const auto plan = plan_scene(scene, {.shader = shader});
  FrameStream stream = must(whole_stream(scene, c_rtl_size, plan->key));
  return {plan->key, std::move(stream.words), std::move(stream.golden)};
}

// With a golden model of its own, the frame stores the golden fragments of one triangle at most.
TEST(RtlFrame, DrawsGoldenFragmentsWhenTheyAreNeeded) {
  for (const Shader shader : c_shaders) {
    const Vectors all = vectors_of(shader);
    ASSERT_GT(all.golden.size(), 200U);
    for (const std::size_t late : {std::size_t{0}, std::size_t{5}, all.golden.size()}) {
      std::vector<Fragment> drawn = all.golden;
      for (const std::uint64_t wrong : {0, 1}) {
        drawn[150].blue ^= static_cast<std::uint8_t>(wrong);
        const auto engine = stand_in(drawn, late);
        for (const bool compare : {true, false}) {
          engine->limits.clear();
          RtlFrame frame(engine, c_rtl_size, {}, {.golden = make_golden_model(all.key), .compare = compare});
          ASSERT_TRUE(frame.add(all.words));
          ASSERT_TRUE(frame.finish());
          const SimulatorRun run = frame.result();
          EXPECT_EQ(run.mismatches, compare ? wrong : 0U) << run.description;
          EXPECT_EQ(run.fragments, all.golden.size());
          EXPECT_EQ(engine->limits, (std::vector<std::uint64_t>{all.golden.size() + 10'000, late + 10'000}));
        }
      }
    }
  }
}

}  // namespace
}  // namespace halfway
