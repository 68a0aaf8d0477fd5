// SPDX-License-Identifier: Apache-2.0
// Compares two fragment streams field by field while they arrive.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "frame/fragment.hpp"

namespace halfway {

struct Mismatch {
  std::uint64_t index;                  ///< position in the stream
  std::optional<Fragment> golden, rtl;  ///< std::nullopt if that stream has ended
};

inline constexpr std::array<std::string_view, 7> c_fragment_fields = {"triangle", "line",  "pixel", "depth",
                                                                      "red",      "green", "blue"};

/// The fields of a fragment in the order of c_fragment_fields.
std::array<std::uint32_t, 7> fields(const Fragment& fragment);

class StreamComparator {
 public:
  /// Append fragments of both streams. Those whose counterparts are there are not copied.
  void add(std::span<const Fragment> golden, std::span<const Fragment> rtl);
  /// End both streams. Fragments without a counterpart count as mismatches.
  void finish();

  std::uint64_t mismatches() const { return mismatches_; }  ///< fragments that differ in any field
  std::uint64_t golden_count() const { return compared_ + pending_golden_.size(); }
  /// The first c_kept mismatches.
  const std::vector<Mismatch>& first() const { return first_; }
  static constexpr std::size_t c_kept = 10;

  /// "triangle 3, line 10, pixel 7, red: golden 200, RTL 201": one line per differing field, at most c_kept
  /// lines, then counts.
  std::string describe(std::string_view rtl_name) const;

 private:
  void compare(const Fragment* golden, const Fragment* rtl, std::size_t count);
  void note(const std::optional<Fragment>& golden, const std::optional<Fragment>& rtl);

  std::vector<Fragment> pending_golden_, pending_rtl_;  ///< one of them is empty
  std::uint64_t compared_ = 0, mismatches_ = 0;
  std::uint64_t only_golden_ = 0, only_rtl_ = 0;
  std::array<std::uint64_t, 7> field_mismatches_{};
  std::vector<Mismatch> first_;
};

}  // namespace halfway
