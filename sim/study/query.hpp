// SPDX-License-Identifier: Apache-2.0
// Queries to a study: the cheapest hardware that meets a demand, and the cost of better hardware.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sim/study/front.hpp"
#include "sim/study/hardware.hpp"
#include "sim/study/record.hpp"

namespace halfway::study {

struct Demand {
  std::optional<double> largest_error;  ///< upper limit, in steps of 1/255
  std::optional<double> psnr_db;        ///< lower limit
  std::optional<double> seconds;        ///< upper limit, per frame, host included
  bool accuracy() const { return largest_error || psnr_db; }
  bool any() const { return accuracy() || seconds; }
  /// Such as `largest error at most 2/255, a frame in 10 ms`.
  std::string text() const;
};

/// Parse --error (`2`, in steps), --psnr (`45` or `45dB`) and --time (`10ms`; s, ms, us or ns). Empty: no
/// demand.
Demand read_demand(const std::string& error, const std::string& psnr, const std::string& time);

/// A point of hardware with its accuracy and its cost.
struct Offer {
  std::size_t record = 0;    ///< index of the record
  double largest_error = 0;  ///< steps of 1/255
  double psnr_db = 0;        ///< infinity if the pictures are equal
  std::optional<double> cells;
  double cycles = 0;              ///< for the frame
  std::optional<double> seconds;  ///< `cycles` at the hardware's clock
  /// Of a frame, when host and hardware overlap: the longer of both. std::nullopt if one of them is not
  /// known.
  std::optional<double> frame_seconds{};
  bool fits = true;  ///< false: the device used for clocks is too small
  /// Host instructions per triangle of the scene; std::nullopt if not counted.
  std::optional<double> host{};
};

/// The offers of one picture. Software points are no offers.
struct Market {
  std::string picture;
  std::vector<Offer> offers;
};

/// Assumed clock in MHz of hardware whose own clock is unknown. std::nullopt: its time is unknown too.
using Clock = std::optional<double>;

/// Clock of the hardware: its own, or the assumed one. std::nullopt if it is unknown, or if the hardware does
/// not fit the device.
std::optional<double> mhz_of(const std::string& hardware, const HardwareTable& table, Clock assumed);

/// One market per picture, in the order of the records.
std::vector<Market> markets_of(std::span<const Record> records, const HardwareTable& hardware, Clock clock);

/// Largest error, PSNR, cells, time and host work as costs. Cells count only if they are known for all
/// offers. If the seconds of all offers that fit the device are known, time is in seconds; offers that do not
/// fit rank after these, by cycles. Otherwise time is in cycles for all offers, and also in seconds for those
/// whose seconds are known. Host instructions count only if they are known for all offers.
std::vector<Costs> costs_of(std::span<const Offer> offers);

/// Indices of offers. All except `fastest`, `fewest_cycles`, `best` and `best_met` are on the front.
struct Answer {
  std::vector<std::size_t> front;  ///< from the cheapest to the most expensive
  std::vector<std::size_t> steps;  ///< members of the front that are more accurate than all cheaper members
  std::optional<std::size_t> cheapest;  ///< among those that meet the demand
  std::optional<std::size_t> quickest;  ///< by frame_seconds, among those that meet the demand
  std::optional<std::size_t> best_met;  ///< the most accurate that meets the demand
  std::optional<std::size_t> cheaper;   ///< the most accurate of the cheaper ones
  std::optional<std::size_t> accurate;  ///< the cheapest of the more accurate ones that meet the time limit
  std::size_t unknown = 0;  ///< number of accurate enough offers whose time is unknown, if a time is demanded
  std::size_t no_room = 0;  ///< number of accurate enough offers that do not fit the device
  std::optional<std::size_t> best;     ///< the most accurate of all
  std::optional<std::size_t> fastest;  ///< among those with a known time, if any
  std::optional<std::size_t> fewest_cycles;
};

/// Cheaper means fewer cells; if these are equal or unknown, less time; then less host work. More accurate
/// means a smaller largest error, or a higher PSNR if only PSNR is demanded.
Answer answer(std::span<const Offer> offers, const Demand& demand);

/// The answer as text. Every figure is taken from the offers. Without a demand, print the front only.
std::string to_text(const Market& market, const Answer& answer, const Demand& demand,
                    std::span<const Record> records);

}  // namespace halfway::study
