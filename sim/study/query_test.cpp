// SPDX-License-Identifier: Apache-2.0
#include "sim/study/query.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "common/test/is_error.hpp"

namespace halfway::study {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr double c_infinity = std::numeric_limits<double>::infinity();

TEST(Demand, ReadsNumbersWithUnits) {
  const auto demand = read_demand("2", "45 dB", "10ms");
  EXPECT_EQ(demand.largest_error, 2.0);
  EXPECT_EQ(demand.psnr_db, 45.0);
  EXPECT_DOUBLE_EQ(*demand.seconds, 0.01);
  EXPECT_EQ(demand.text(), "largest error at most 2/255, PSNR at least 45 dB, a frame in 10 ms");
  EXPECT_DOUBLE_EQ(*read_demand("", "", "0.5s").seconds, 0.5);
  EXPECT_DOUBLE_EQ(*read_demand("", "", "250us").seconds, 250e-6);
  EXPECT_DOUBLE_EQ(*read_demand("", "", "800 ns").seconds, 800e-9);
  EXPECT_EQ(read_demand("0", "", "").largest_error, 0.0);
  EXPECT_FALSE(read_demand("", "", "").any());
}

TEST(Demand, RefusesOtherUnits) {
  const std::string cases[][4] = {
      {"2%", "", "", "--error"},   {"-1", "", "", "--error"},  {"256", "", "", "--error"},
      {"two", "", "", "--error"},  {"", "45db", "", "--psnr"}, {"", "0", "", "--psnr"},
      {"", "inf", "", "--psnr"},   {"", "nan", "", "--psnr"},  {"", "", "10", "--time"},
      {"", "", "10min", "--time"}, {"", "", "0ms", "--time"},  {"", "", "ms", "--time"},
      {"", "", "1e999s", "--time"}};
  for (const auto& [error, psnr, time, option] : cases) {
    EXPECT_TRUE(is_error(caught([&] { return read_demand(error, psnr, time); }), ExitCode::bad_input,
                         option + ": '" + error + psnr + time + "'"));
  }
}

Offer random_offer(std::mt19937& random, bool clocks) {
  const double steps = static_cast<double>(random() % 5);
  Offer offer{.largest_error = steps,
              .psnr_db = steps == 0 ? c_infinity : 60.0 - 5.0 * steps - static_cast<double>(random() % 3),
              .cells = static_cast<double>(100 * (1 + random() % 4)),
              .cycles = static_cast<double>(1000 * (1 + random() % 3)),
              .host = static_cast<double>(10 * (random() % 3))};
  // Leave the clock of some hardware unknown.
  if (clocks && random() % 4 != 0) offer.seconds = offer.cycles / (random() % 2 == 0 ? 1e8 : 5e7);
  return offer;
}

class RandomMarket : public ::testing::TestWithParam<bool> {};

TEST_P(RandomMarket, AnswersAreCorrect) {
  std::mt19937 random(7);
  int met = 0, missed = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    std::vector<Offer> offers(1 + random() % 12);
    for (Offer& offer : offers) offer = random_offer(random, GetParam());
    Demand demand;
    if (random() % 2 == 0) demand.largest_error = static_cast<double>(random() % 4);
    if (random() % 2 == 0) demand.psnr_db = 40.0 + static_cast<double>(random() % 20);
    if (GetParam() && random() % 2 == 0) demand.seconds = 1e-5 * static_cast<double>(1 + random() % 6);
    const auto timely = [&](const Offer& o) {
      return !demand.seconds || (o.seconds && *o.seconds <= *demand.seconds);
    };
    const auto meets = [&](const Offer& o) {
      return (!demand.largest_error || o.largest_error <= *demand.largest_error) &&
             (!demand.psnr_db || o.psnr_db >= *demand.psnr_db) && timely(o);
    };
    const bool by_psnr = demand.psnr_db && !demand.largest_error;
    const auto better = [&](const Offer& a, const Offer& b) {
      return by_psnr ? a.psnr_db > b.psnr_db : a.largest_error < b.largest_error;
    };
    const Answer found = answer(offers, demand);
    // The answer has the fewest cells of the offers that satisfy `is_candidate`, and is on the front.
    const auto expect_fewest_cells = [&](const std::optional<std::size_t>& at, const auto& is_candidate) {
      ASSERT_EQ(at.has_value(), std::ranges::any_of(offers, is_candidate));
      if (!at) return;
      EXPECT_TRUE(is_candidate(offers[*at]));
      EXPECT_THAT(found.front, Contains(*at));
      for (const Offer& o : offers) {
        EXPECT_TRUE(!is_candidate(o) || *o.cells >= *offers[*at].cells);
      }
    };
    expect_fewest_cells(found.cheapest, meets);
    ++(found.cheapest ? met : missed);
    for (const Offer& o : offers) EXPECT_FALSE(better(o, offers[*found.best]));
    if (!found.cheapest) continue;
    const Offer& here = offers[*found.cheapest];
    expect_fewest_cells(found.accurate, [&](const Offer& o) { return timely(o) && better(o, here); });
    if (found.cheaper) {
      const Offer& less = offers[*found.cheaper];
      EXPECT_LE(*less.cells, *here.cells);
      EXPECT_FALSE(meets(less));
      EXPECT_THAT(found.front, Contains(*found.cheaper));
      for (const Offer& o : offers) EXPECT_FALSE(*o.cells < *here.cells && better(o, less));
    }
    // Each step costs more and is more accurate than the previous one. The last is the most accurate of all.
    ASSERT_FALSE(found.steps.empty());
    for (std::size_t i = 1; i < found.steps.size(); ++i) {
      const Offer &before = offers[found.steps[i - 1]], &after = offers[found.steps[i]];
      EXPECT_LE(*before.cells, *after.cells);
      EXPECT_TRUE(better(after, before));
    }
    EXPECT_FALSE(better(offers[*found.best], offers[found.steps.back()]));
  }
  EXPECT_GT(met, 100);
  EXPECT_GT(missed, 100);
}

INSTANTIATE_TEST_SUITE_P(Clocks, RandomMarket, ::testing::Bool());

// A study of three hardware points and one software point, with two pictures.
class QueryTest : public ::testing::Test {
 protected:
  QueryTest() {
    add({.method = Method::gouraud}, "", 66, 0, std::nullopt);
    add({.method = Method::quadratic}, "quadratic", 42, 1000, 63600);
    add({.method = Method::adaptive}, "quadratic", 2, 1010, 182080);
    add({.method = Method::processors_2}, "processors", 1, 1005, 50000);
    add({.method = Method::processors_2, .exponent = 5.0}, "processors", 1, 1005, 50000);
    hardware_["quadratic"].cells = Cells{.luts = 1500, .flip_flops = 500};
    hardware_["processors"].cells = Cells{
        .luts = 1000, .flip_flops = 800, .multipliers = 10, .memory_bits = 3200, .multiplier_luts = 8000};
  }
  void add(const DesignPoint& point, const std::string& hardware, unsigned error, std::uint64_t cycles,
           std::optional<std::uint64_t> instructions) {
    Record record{point, {}};
    record.measured.hardware = hardware;
    record.measured.picture.max_lsb = error;
    record.measured.picture.psnr_db = 60.0 - error / 2.0;
    record.measured.cycles = cycles;
    record.measured.triangles = 10;
    record.measured.host_instructions = instructions;
    records_.push_back(record);
  }
  std::string ask(const Demand& demand, Clock clock = {}) const {
    const auto markets = markets_of(records_, hardware_, clock);
    return to_text(markets.at(0), answer(markets[0].offers, demand), demand, records_);
  }
  std::vector<Record> records_;
  HardwareTable hardware_;
};

TEST_F(QueryTest, HasOneMarketPerPictureWithoutSoftware) {
  const auto markets = markets_of(records_, hardware_, {});
  ASSERT_EQ(markets.size(), 2U);
  EXPECT_EQ(markets[1].picture, "320x240, exponent 5");
  EXPECT_EQ(markets[1].offers.size(), 1U);
  EXPECT_EQ(markets[0].offers.at(2).cells, 10000.0);
  EXPECT_FALSE(markets[0].offers.at(2).seconds);
}

TEST_F(QueryTest, PrintsTheCheapestItsNeighboursAndTheirCost) {
  EXPECT_EQ(
      ask({.largest_error = 2.0}),
      "320x240: largest error at most 2/255\n"
      "  cheapest       adaptive exact, threshold 2: largest error 2/255, PSNR 59.00 dB, 2000 cells, "
      "1010 cycles, 18208 host instructions per triangle\n"
      "  cheaper        quadratic exact: largest error 42/255, PSNR 39.00 dB, 2000 cells, 1000 cycles, "
      "6360 host instructions per triangle; -10 cycles (-0.99 %), -11848 host instructions per triangle "
      "(-65.1 %)\n"
      "  more accurate  processors-2 exact: largest error 1/255, PSNR 59.50 dB, 10000 cells, "
      "1005 cycles, 5000 host instructions per triangle; +8000 cells (+400 %), -5 cycles (-0.495 %), "
      "-13208 host instructions per triangle (-72.5 %)\n"
      "  looked at      3 points of hardware; varied: method; not varied: preset, newton, fraction_bits, "
      "seed_bits, form, highlight_test, objects, threshold\n"
      "  front          3 of 3 points of hardware, time in cycles, the host's work in instructions per "
      "triangle\n"
      "  its steps, each more accurate (by largest error) than all cheaper points:\n"
      "  error/255 PSNR, dB     cells    cycles       time host/triangle  design\n"
      "         42    39.00      2000      1000          -          6360  quadratic exact\n"
      "          2    59.00      2000      1010          -         18208  adaptive exact, threshold 2\n"
      "          1    59.50     10000      1005          -          5000  processors-2 exact\n");
}

TEST_F(QueryTest, TimeNeedsAClock) {
  // 1010 cycles are 10.1 us at 100 MHz.
  EXPECT_THAT(ask({.largest_error = 2.0, .seconds = 10.05e-6}, {100.0}),
              HasSubstr("cheapest       processors-2 exact: largest error 1/255, PSNR 59.50 dB, 10000 cells, "
                        "1005 cycles (10.05 us)"));
  const std::string unknown = ask({.largest_error = 2.0, .seconds = 1.0});
  EXPECT_THAT(unknown, HasSubstr("none of 3 points of hardware meets it"));
  EXPECT_THAT(unknown,
              HasSubstr("2 points: accurate enough, but the clock is not known (--place, or --clock)"));
  EXPECT_THAT(ask({.largest_error = 1.0, .seconds = 1.0}), HasSubstr("1 point: accurate enough, but the"));
}

TEST_F(QueryTest, TheHardwaresOwnClockHasPriority) {
  hardware_["quadratic"].mhz = 50.0;
  const std::string mixed = ask({.largest_error = 2.0, .seconds = 20.3e-6}, {100.0});
  EXPECT_THAT(mixed, HasSubstr("1010 cycles (20.2 us)"));
  EXPECT_THAT(mixed, HasSubstr("1005 cycles (10.05 us)"));
  EXPECT_THAT(mixed, HasSubstr("-10.15 us (-50.2 %)"));
  EXPECT_THAT(mixed, HasSubstr("time in nanoseconds, the"));
  // The clock of one of the three is unknown.
  EXPECT_THAT(ask({.largest_error = 2.0}), HasSubstr("time in cycles, and in nanoseconds where"));
  // Does not fit: the offer ranks after those that fit, for any number of cycles, and not as unknown.
  hardware_["processors"].fits = false;
  const std::string fitting = ask({.seconds = 1.0});
  EXPECT_THAT(fitting, HasSubstr("time in nanoseconds, the"));
  EXPECT_THAT(fitting, Not(HasSubstr("is not known")));
  EXPECT_THAT(fitting, HasSubstr("  1 point: too large for the device\n"));
  hardware_["quadratic"].fits = false;
  EXPECT_THAT(ask({.largest_error = 2.0, .seconds = 1.0}),
              HasSubstr("2 points: accurate enough, but too large for the device\n"));
}

TEST_F(QueryTest, HardwareThatDoesNotFitIsSlowerThanHardwareThatFits) {
  const std::vector<Offer> offers = {{.cells = 1.0, .cycles = 10.0, .seconds = 1.0},
                                     {.cells = 1.0, .cycles = 5.0, .seconds = 2.0},
                                     {.cells = 1.0, .cycles = 1.0, .fits = false},
                                     {.cells = 0.5, .cycles = 2.0, .fits = false},
                                     {.cells = 0.5, .cycles = 3.0, .fits = false}};
  const Answer found = answer(offers, {});
  EXPECT_THAT(found.front, ::testing::UnorderedElementsAre(0U, 3U));
  EXPECT_EQ(found.fastest, 0U);
}

TEST_F(QueryTest, PrintsTheBestIfNothingMeetsTheDemand) {
  const std::string text = ask({.largest_error = 0.0});
  EXPECT_THAT(text,
              HasSubstr("none of 3 points of hardware meets it\n  most accurate  processors-2 exact: "));
  EXPECT_THAT(text, AllOf(HasSubstr("  fewest cycles  quadratic exact: "), Not(HasSubstr("fastest"))));
  // Only offers with a known time compete for `fastest`.
  hardware_["processors"].mhz = 50.0;
  EXPECT_THAT(ask({.largest_error = 0.0}),
              AllOf(HasSubstr("  fastest        processors-2 exact: "),
                    HasSubstr("; among those with a known clock\n  fewest cycles  quadratic exact: ")));
  hardware_["quadratic"].mhz = 60.0;
  EXPECT_THAT(ask({.largest_error = 0.0}),
              AllOf(HasSubstr("  fastest        quadratic exact: "), Not(HasSubstr("fewest cycles"))));
  EXPECT_THAT(ask({.largest_error = 1.0}), HasSubstr("  more accurate  none\n"));
}

// If only a time is demanded, any accuracy suffices. The most accurate offer within that time is printed too.
TEST_F(QueryTest, PrintsTheMostAccurateWithinATime) {
  const std::string text = ask({.seconds = 10.07e-6}, {100.0});
  EXPECT_THAT(text, HasSubstr("  cheapest       quadratic exact: "));
  EXPECT_THAT(text, HasSubstr("  most accurate  processors-2 exact: "));
  EXPECT_THAT(text, HasSubstr("; +8000 cells (+400 %), +5 cycles"));
  EXPECT_THAT(ask({.seconds = 10.02e-6}, {100.0}), HasSubstr("  most accurate  quadratic exact: "));
  EXPECT_THAT(ask({.seconds = 1.0}), HasSubstr("  3 points: the clock is not known"));
}

TEST_F(QueryTest, PrintsTheVariedParameters) {
  const auto more = [&](const DesignPoint& point) { add(point, "quadratic", 3, 1000, 63600); };
  more({.method = Method::spherical});
  more({.method = Method::spherical, .hardware = {.tables = words::CosineSize{6, 8}}});
  more({.method = Method::adaptive, .host = {.quadratic = {.threshold = 4.0}}});
  const auto markets = markets_of(records_, hardware_, {});
  const auto text = ask({.largest_error = 2.0});
  EXPECT_THAT(text, HasSubstr("looked at      6 points of hardware; varied: method, cosine, "
                              "threshold; not varied: preset, "));
}

TEST_F(QueryTest, ComparesCyclesAndHostWithoutCells) {
  hardware_.clear();
  const std::string text = ask({.largest_error = 2.0});
  EXPECT_THAT(text, HasSubstr("cheapest       processors-2 exact"));
  EXPECT_THAT(text, Not(HasSubstr(" cells,")));
}

// Setup evaluations of different shaders are not comparable. Host instructions are compared only if all
// offers have them.
TEST_F(QueryTest, ComparesTheHostIfAllInstructionsAreCounted) {
  // Equal to the quadratic shader except for the host: fewer evaluations, more instructions.
  Record record{{.method = Method::spherical}, records_[1].measured};
  record.measured.counts.shaded = 0;
  record.measured.host_instructions = 90000;
  records_[1].measured.counts.shaded = 6360;
  records_.push_back(record);
  EXPECT_THAT(ask({.largest_error = 50.0}),
              AllOf(HasSubstr("cheapest       quadratic exact"), HasSubstr("front          3 of 4 points"),
                    HasSubstr("the host's work in instructions per triangle\n")));
  records_[3].measured.host_instructions.reset();
  const auto uncounted = markets_of(records_, hardware_, {}).at(0);
  EXPECT_FALSE(uncounted.offers[2].host);
  EXPECT_THAT(ask({.largest_error = 50.0}),
              AllOf(HasSubstr("front          4 of 4 points"), HasSubstr("the host's work not compared")));
}

}  // namespace
}  // namespace halfway::study
