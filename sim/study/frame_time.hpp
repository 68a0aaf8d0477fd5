// SPDX-License-Identifier: Apache-2.0
// Time of a whole frame: the host's set-up and the hardware's clocks, next to the error of the picture.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sim/study/query.hpp"
#include "sim/study/record.hpp"

namespace halfway::study {

/// A point whose times are known. In software the host draws the picture, and there is no hardware.
struct FrameTime {
  std::size_t record = 0;             ///< index of the record
  double host_ns = 0;                 ///< one core of the machine that measured it
  std::optional<double> hardware_ns;  ///< the frame's cycles at the hardware's clock; std::nullopt: software
  std::string device{};               ///< Cost::device
  std::optional<double> mhz{};        ///< the hardware's clock
  /// The host prepares one frame while the hardware draws another, as in the papers.
  double overlapped_ns() const { return std::max(host_ns, hardware_ns.value_or(0.0)); }
  /// The hardware starts when the host has finished.
  double sequential_ns() const { return host_ns + hardware_ns.value_or(0.0); }
  /// The side that limits overlapped frames.
  const char* bound() const { return host_ns < hardware_ns.value_or(0.0) ? "hardware" : "host"; }
};

/// The points with known times of one picture, in the order of the records.
struct PictureTimes {
  std::string picture;
  std::vector<FrameTime> times;
  std::size_t without_clock = 0;  ///< points of hardware without a known clock
};
std::vector<PictureTimes> frame_times_of(std::span<const Record> records, const HardwareTable& hardware,
                                         Clock clock);

/// Indices of the times that no other time beats in overlapped time and rms error, from the quickest.
std::vector<std::size_t> quickest_of(const PictureTimes& picture, std::span<const Record> records);

/// The front as a table for people.
std::string to_text(const PictureTimes& picture, std::span<const Record> records);

}  // namespace halfway::study
