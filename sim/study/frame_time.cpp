// SPDX-License-Identifier: Apache-2.0
#include "sim/study/frame_time.hpp"

namespace halfway::study {
namespace {

constexpr double c_ms = 1e-6;  // ns to ms

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

}  // namespace halfway::study
