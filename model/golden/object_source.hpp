// SPDX-License-Identifier: Apache-2.0
// Golden model of rtl/objects/object_source.vhd: scans strips, and lets objects and loads enter the chain.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "golden/object_word.hpp"

namespace halfway::golden {

template <class Preset>
class ObjectSource {
 public:
  using Word = ObjectWord<Preset>;

  ObjectSource(const ProcessorsConfig& config, int subpixels) : config_(config), subpixels_(subpixels) {}

  /// Takes a vector, and calls out(word) for each word that it causes.
  template <class Out>
  void take(std::span<const std::uint32_t> vector, Out&& out) {
    const Command command = command_of<Preset>(vector);
    if (command == Command::new_object || (command == Command::shadow && config_.shadows)) {
      const auto side = static_cast<std::uint32_t>(side_of(subpixels_));
      const auto first_line = static_cast<std::uint32_t>(of_walk(vector, At::y)) / side;
      while (strip_ && remaining_ != 0 && line_number_ < first_line) scan_line(out);
      if (!strip_ || remaining_ == 0 || line_number_ > first_line)
        fault_ = true;
      else
        send_parts(vector, command == Command::shadow, out);
      return;
    }
    if (command == Command::new_scanline) {
      if (strip_) end_strip(out);
      open_strip(vector);
    } else if (words::is_load(command) && !strip_) {
      Word load;
      load.token = ShadingToken<Preset>::decode(config_, vector);
      out(load);
    } else {
      fault_ = true;
    }
  }

  /// A strip is not scanned to its end.
  bool busy() const { return strip_; }
  bool fault() const { return fault_; }

 private:
  using At = Exact::init_header_at;

  static std::uint64_t of_walk(std::span<const std::uint32_t> vector, const Field& field) {
    return get_bits(vector, field, ProcessorsLayout<Preset>::walk_low());
  }

  void open_strip(std::span<const std::uint32_t> vector) {
    const auto column = [&](const Field& field) {
      return words::Word<Exact::c_span_x_bits>::from_bits(of_walk(vector, field)).value();
    };
    const std::int64_t first = column(At::start_x), end = column(At::upper_x);
    const auto lines = static_cast<std::uint32_t>(of_walk(vector, At::upper_lines));
    const bool too_large = end - first > most_columns<Preset>(subpixels_) ||
                           static_cast<int>(lines) > most_lines<Preset>(subpixels_);
    if (too_large) fault_ = true;
    strip_ = !too_large && lines != 0 && first < end;
    line_number_ = 0;
    remaining_ = lines;
    y_ = static_cast<std::uint32_t>(of_walk(vector, At::y));
    first_x_ = wrapped(first);
    columns_ = static_cast<std::uint32_t>(end - first);
  }

  static std::uint32_t wrapped(std::int64_t x) {
    return static_cast<std::uint32_t>(low_bits(static_cast<std::uint64_t>(x), Preset::c_pixel_x_bits));
  }

  template <class Out>
  void end_strip(Out& out) {
    while (remaining_ != 0) scan_line(out);
    Word end;
    end.kind = ObjectKind::strip_end;
    out(end);
    strip_ = false;
  }

  template <class Out>
  void scan_line(Out& out) {
    Word head;
    head.token.command = Command::new_scanline;
    head.token.y = y_;
    for (std::uint32_t i = 0; i < columns_; ++i) {
      head.token.x = wrapped(std::int64_t{first_x_} + i);
      out(head);
      head.token.command = Command::new_pixel;
    }
    y_ = static_cast<std::uint32_t>(low_bits(y_ + 1, Preset::c_pixel_y_bits));
    ++line_number_;
    --remaining_;
  }

  template <class Out>
  void send_parts(std::span<const std::uint32_t> vector, bool shadow, Out& out) {
    const int parts = parts_of<Preset>(config_, shadow);
    const int bits = ProcessorsLayout<Preset>(config_).init_bits();
    Word part;
    for (int i = 0; i < parts; ++i) {
      part.kind = i + 1 < parts ? ObjectKind::part : ObjectKind::last_part;
      const int low = i * c_part_bits;
      part.part = get_bits(vector, {"", low, std::min(c_part_bits, bits - low), false, 0});
      out(part);
    }
  }

  ProcessorsConfig config_;
  int subpixels_;
  bool strip_ = false, fault_ = false;
  std::uint32_t line_number_ = 0;  ///< of the next line, from the strip's first
  std::uint32_t remaining_ = 0;    ///< lines that are not scanned
  std::uint32_t y_ = 0, first_x_ = 0, columns_ = 0;
};

}  // namespace halfway::golden
