// SPDX-License-Identifier: Apache-2.0
#include "sim/study/frame_time.hpp"

#include <fmt/format.h>

#include <utility>

#include "sim/os/csv.hpp"
#include "sim/study/front.hpp"

namespace halfway::study {
namespace {

constexpr double c_ms = 1e-6;  // ns to ms

// A line's values with the names of their columns.
using TimeLine = std::vector<std::pair<const char*, std::string>>;

TimeLine line_of(const Provenance& provenance, const Record& record, const FrameTime& time) {
  const auto& [p, m] = record;
  const bool has_hardware = time.hardware_ns.has_value();
  const auto of_hardware = [&](const auto& value) {
    return has_hardware ? fmt::format("{}", value) : std::string();
  };
  return {{"scene", provenance.scene},
          {"scene_hash", provenance.scene_hash},
          {"point", p.name()},
          {"design", p.design()},
          {"method", to_string(p.method)},
          {"preset", in_hardware(p.method) ? to_string(p.preset) : ""},
          {"form", text_of("form", p)},
          {"tessellation", fmt::format("{:g}", p.tessellation)},
          {"exponent", p.exponent ? fmt::format("{:g}", *p.exponent) : ""},
          {"width", fmt::format("{}", p.size.width)},
          {"height", fmt::format("{}", p.size.height)},
          {"hardware", m.hardware},
          {"triangles", fmt::format("{}", m.triangles)},
          {"host_ns", fmt::format("{:.6g}", time.host_ns)},
          {"host_instructions", m.host_instructions ? fmt::format("{}", *m.host_instructions) : ""},
          {"words", of_hardware(m.host_time->words)},
          {"cycles", of_hardware(m.cycles)},
          {"hardware_ns", has_hardware ? fmt::format("{:.6g}", *time.hardware_ns) : ""},
          {"overlapped_ns", fmt::format("{:.6g}", time.overlapped_ns())},
          {"sequential_ns", fmt::format("{:.6g}", time.sequential_ns())},
          {"bound", time.bound()},
          {"rms", fmt::format("{}", m.picture.rms)},
          {"largest_error", fmt::format("{}", m.picture.max_lsb)},
          {"perceived_pixels", fmt::format("{}", m.perceived)},
          {"clock_mhz", time.mhz ? fmt::format("{:.1f}", *time.mhz) : ""},
          {"highlight_test", text_of("highlight_test", p)},
          {"span_ends", text_of("span_ends", p)},
          {"device", time.device},
          {"subpixels", text_of("subpixels", p)}};
}

constexpr const char* c_line = "  {:>10} {:>11} {:>9} {:>9}  {:<8} {:>9} {:>8}  {}\n";

std::string line_text(const FrameTime& time, const Record& record) {
  const auto ms = [](double ns) { return fmt::format("{:.4g}", c_ms * ns); };
  const Measurement& measured = record.measured;
  return fmt::format(c_line, ms(time.overlapped_ns()), ms(time.sequential_ns()), ms(time.host_ns),
                     time.hardware_ns ? ms(*time.hardware_ns) : "-", time.bound(),
                     fmt::format("{:.3g}", measured.picture.rms), measured.picture.max_lsb,
                     record.point.design());
}

}  // namespace

std::vector<PictureTimes> frame_times_of(std::span<const Record> records, const HardwareTable& hardware,
                                         Clock clock) {
  std::vector<PictureTimes> pictures;
  for (std::size_t at = 0; at < records.size(); ++at) {
    const auto& [point, measured] = records[at];
    if (!measured.host_time) continue;
    const std::string name = point.picture();
    auto picture = std::ranges::find(pictures, name, &PictureTimes::picture);
    if (picture == pictures.end()) picture = pictures.insert(picture, PictureTimes{name, {}});
    FrameTime time{.record = at, .host_ns = measured.host_time->ns};
    if (in_hardware(point.method)) {
      time.mhz = mhz_of(measured.hardware, hardware, clock);
      if (const auto found = hardware.find(measured.hardware); found != hardware.end())
        time.device = found->second.device;
      if (!time.mhz) {
        ++picture->without_clock;
        continue;
      }
      time.hardware_ns = 1e3 * static_cast<double>(measured.cycles) / *time.mhz;
    }
    picture->times.push_back(time);
  }
  return pictures;
}

std::vector<std::size_t> quickest_of(const PictureTimes& picture, std::span<const Record> records) {
  std::vector<Costs> costs;
  for (const FrameTime& time : picture.times)
    costs.push_back({time.overlapped_ns(), records[time.record].measured.picture.rms});
  return ordered_front_of(costs);
}

std::string to_text(const PictureTimes& picture, std::span<const Record> records) {
  std::string text = fmt::format(
      "{}: time of a frame in ms, host (one core) and hardware\n  the front of {} points in overlapped time "
      "and rms error{}\n",
      picture.picture, picture.times.size(),
      picture.without_clock == 0
          ? ""
          : fmt::format("; {} of hardware without a clock are left out (--clock)", picture.without_clock));
  text += fmt::format(c_line, "overlapped", "in sequence", "host", "hardware", "bound", "rms/255", "largest",
                      "design");
  for (const std::size_t at : quickest_of(picture, records))
    text += line_text(picture.times[at], records[picture.times[at].record]);
  return text;
}

std::string times_csv(const Provenance& provenance, std::span<const Record> records,
                      std::span<const PictureTimes> pictures) {
  Table table;
  for (const PictureTimes& picture : pictures)
    for (const FrameTime& time : picture.times) {
      const TimeLine line = line_of(provenance, records[time.record], time);
      if (table.columns.empty())
        for (const auto& [column, value] : line) table.columns.emplace_back(column);
      std::vector<std::string>& row = table.rows.emplace_back();
      for (const auto& [column, value] : line) row.push_back(value);
    }
  return to_csv(table);
}

}  // namespace halfway::study
