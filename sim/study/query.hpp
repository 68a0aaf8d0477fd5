// SPDX-License-Identifier: Apache-2.0
// What a designer asks of a study: the cheapest hardware that is good enough, and what better would cost.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/result.hpp"
#include "sim/study/front.hpp"
#include "sim/study/hardware.hpp"
#include "sim/study/record.hpp"

namespace halfway::study {

struct Demand {
  std::optional<double> largest_error;  ///< at most, in steps of 1/255
  std::optional<double> psnr_db;        ///< at least
  std::optional<double> seconds;        ///< a frame, at most
  bool accuracy() const { return largest_error || psnr_db; }
  bool any() const { return accuracy() || seconds; }
  /// Such as `largest error at most 2/255, a frame in 10 ms`.
  std::string text() const;
};

/// From what --error (`2`, steps), --psnr (`45` or `45dB`) and --time (`10ms`; s, ms, us or ns) say; empty:
/// nothing asked.
Result<Demand> read_demand(const std::string& error, const std::string& psnr, const std::string& time);

/// A point of hardware as what it gives and what it takes.
struct Offer {
  std::size_t record = 0;    ///< its number
  double largest_error = 0;  ///< steps of 1/255
  double psnr_db = 0;        ///< infinity where nothing differs
  std::optional<double> cells;
  double cycles = 0;              ///< for the frame
  std::optional<double> seconds;  ///< the same at the hardware's clock
  bool fits = true;               ///< else the device that clocks are of has no room for it
  /// Instructions of the host for each triangle of the scene; none where nothing counted them.
  std::optional<double> host{};
};

/// The offers of one picture. Software is none.
struct Market {
  std::string picture;
  std::vector<Offer> offers;
};

/// What hardware is taken to run at where its own clock is not known; none: its time is not known either.
struct Clock {
  std::optional<double> mhz;
};

/// One a picture, in the records' order.
std::vector<Market> markets_of(std::span<const Record> records, const HardwareTable& hardware, Clock clock);

/// Largest error, PSNR, cells, time and host, as costs. Cells count where they are known of all. Time is in
/// seconds where they are known of all that fit the device, and what does not is slower than that, among its
/// like by cycles; else it is in cycles for all, and in seconds besides for those of which they are known.
/// The host counts where its instructions are known of all.
std::vector<Costs> costs_of(std::span<const Offer> offers);

/// Numbers of offers. All but `fastest`, `fewest_cycles`, `best` and `best_met` are on the front.
struct Answer {
  std::vector<std::size_t> front;       ///< from the cheapest to the dearest
  std::vector<std::size_t> steps;       ///< those of the front that are more accurate than all before them
  std::optional<std::size_t> cheapest;  ///< that meets the demand
  std::optional<std::size_t> best_met;  ///< the most accurate that meets it
  std::optional<std::size_t> cheaper;   ///< the most accurate of those that are cheaper
  std::optional<std::size_t> accurate;  ///< the cheapest of those that are more accurate, and in time
  std::size_t unknown = 0;              ///< how many might meet the demand, if their time were known
  std::size_t no_room = 0;              ///< and how many that never have one
  std::optional<std::size_t> best;      ///< the most accurate of all
  std::optional<std::size_t> fastest;   ///< of those whose time is known, if it is of any
  std::optional<std::size_t> fewest_cycles;
};

/// Cheaper is what has fewer cells; where they are equal or not known, what is faster; then what asks less of
/// the host. More accurate is what has the smaller largest error, or where PSNR alone is demanded, the higher
/// PSNR.
Answer answer(std::span<const Offer> offers, const Demand& demand);

/// In words; every figure is the offers'. Where nothing is demanded: the front alone.
std::string to_text(const Market& market, const Answer& answer, const Demand& demand,
                    std::span<const Record> records);

}  // namespace halfway::study
