// SPDX-License-Identifier: Apache-2.0
#include "sim/driver/stream_comparator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

namespace halfway {

std::array<std::uint32_t, 7> fields(const Fragment& f) {
  return {f.triangle, f.y, f.x, f.z, f.red, f.green, f.blue};
}

void StreamComparator::add(std::span<const Fragment> golden, std::span<const Fragment> rtl) {
  if (pending_golden_.empty() && pending_rtl_.empty()) {
    const std::size_t count = std::min(golden.size(), rtl.size());
    compare(golden.data(), rtl.data(), count);
    golden = golden.subspan(count);
    rtl = rtl.subspan(count);
  }
  pending_golden_.insert(pending_golden_.end(), golden.begin(), golden.end());
  pending_rtl_.insert(pending_rtl_.end(), rtl.begin(), rtl.end());
  const std::size_t count = std::min(pending_golden_.size(), pending_rtl_.size());
  compare(pending_golden_.data(), pending_rtl_.data(), count);
  for (std::vector<Fragment>* pending : {&pending_golden_, &pending_rtl_})
    pending->erase(pending->begin(), pending->begin() + static_cast<std::ptrdiff_t>(count));
}

void StreamComparator::compare(const Fragment* golden, const Fragment* rtl, std::size_t count) {
  constexpr std::size_t c_block = 1024;
  for (std::size_t i = 0; i < count; i += c_block) {
    const std::size_t n = std::min(c_block, count - i);
    // Fragments have no padding, so equal bytes are equal fields.
    if (std::memcmp(golden + i, rtl + i, n * sizeof(Fragment)) == 0) {
      compared_ += n;
      continue;
    }
    for (std::size_t j = i; j < i + n; ++j) {
      if (golden[j] != rtl[j]) note(golden[j], rtl[j]);
      ++compared_;
    }
  }
}

void StreamComparator::finish() {
  for (const Fragment& f : pending_golden_) {
    note(f, std::nullopt);
    ++only_golden_;
    ++compared_;
  }
  for (const Fragment& f : pending_rtl_) {
    note(std::nullopt, f);
    ++only_rtl_;
    ++compared_;
  }
  pending_golden_.clear();
  pending_rtl_.clear();
}

void StreamComparator::note(const std::optional<Fragment>& golden, const std::optional<Fragment>& rtl) {
  ++mismatches_;
  if (first_.size() < c_kept) first_.push_back({compared_, golden, rtl});
  if (!golden || !rtl) return;
  const auto a = fields(*golden), b = fields(*rtl);
  for (std::size_t i = 0; i < a.size(); ++i) field_mismatches_[i] += a[i] != b[i];
}

std::string StreamComparator::describe(std::string_view rtl_name) const {
  std::string text;
  const auto to = std::back_inserter(text);
  std::size_t lines = 0;
  for (const Mismatch& m : first_) {
    if (lines >= c_kept) break;
    const Fragment& at = m.golden ? *m.golden : *m.rtl;
    const std::string where = fmt::format("  triangle {}, line {}, pixel {}", at.triangle, at.y, at.x);
    if (!m.rtl) {
      fmt::format_to(to, "{}: golden has it, {} ended before\n", where, rtl_name);
      ++lines;
    } else if (!m.golden) {
      fmt::format_to(to, "{}: only {} has it, golden ended before\n", where, rtl_name);
      ++lines;
    } else {
      const auto golden = fields(*m.golden), rtl = fields(*m.rtl);
      for (std::size_t i = 0; i < golden.size() && lines < c_kept; ++i) {
        if (golden[i] == rtl[i]) continue;
        fmt::format_to(to, "{}, {}: golden {}, {} {}\n", where, c_fragment_fields[i], golden[i], rtl_name,
                       rtl[i]);
        ++lines;
      }
    }
  }
  fmt::format_to(to, "  {} fragments differ; by field:", mismatches_);
  for (std::size_t i = 0; i < c_fragment_fields.size(); ++i)
    fmt::format_to(to, " {} {}", c_fragment_fields[i], field_mismatches_[i]);
  if (only_golden_ != 0) fmt::format_to(to, "; {} missing at the end", only_golden_);
  if (only_rtl_ != 0) fmt::format_to(to, "; {} too many at the end", only_rtl_);
  text += '\n';
  return text;
}

}  // namespace halfway
