// SPDX-License-Identifier: Apache-2.0
// The hardware of a study's points, and what it costs: figures of a hardware key, not of a point.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/result.hpp"
#include "plan/hardware_key.hpp"
#include "scene/scene.hpp"
#include "sim/costs/cells.hpp"
#include "sim/formats/made_formats.hpp"
#include "sim/formats/made_tables.hpp"
#include "sim/ghdl/ghdl_library.hpp"
#include "sim/study/design_point.hpp"
#include "sim/study/record.hpp"
#include "sim/synth/pinned.hpp"
#include "sim/synth/synthesis.hpp"

namespace halfway::study {

/// The hardware that draws a point.
struct PointHardware {
  HardwareKey key;
  std::shared_ptr<const tables::MadeTables> tables;  ///< the key's, where the program was not built with them
  std::shared_ptr<const MadeFormats> formats{};      ///< likewise
};
/// The point must be hardware's; bad input where it cannot draw the scene. With other word lengths than the
/// preset's it can be drawn by `drawing_hardware_of` alone.
Result<PointHardware> hardware_of(const DesignPoint& point, const Scene& scene);
/// The same with formats that the program was not built with: compiled, where the cache does not have them.
Result<PointHardware> drawing_hardware_of(const DesignPoint& point, const Scene& scene,
                                          const SimulatorFolders& folders);

/// What the point's RTL is made from: `folders`, or where it has tables or word lengths that the program was
/// not built with, a copy in the cache.
Result<SimulatorFolders> rtl_of(const DesignPoint& point, const SimulatorFolders& folders);

/// Hardware with what it is synthesized from.
struct HardwareSource {
  PointHardware hardware;
  SimulatorFolders folders;  ///< rtl_of the point
  synth::Design design() const;
};

inline constexpr const char* c_not_placed = "not placed";

struct HardwareFigures {
  std::optional<Cells> cells;  ///< of no FPGA family; none without Yosys
  /// On an iCE40 HX8K with registered ports, the median of synth::kSeeds placements.
  std::optional<double> mhz;
  /// Where that is from, `pinned` or `placed`; or why there is none.
  std::string clock = c_not_placed;
  /// Of hardware that was placed, then or when that was pinned: by itself, without the registers around it.
  std::optional<synth::Ice40Cells> ice40;
  /// The device has no room for it: it never has a clock there.
  bool fits = true;
  /// Versions of what all that is by, such as `pinned with nextpnr-ice40 0.4, cells by Yosys 0.23`.
  std::string tools{};
  std::string netlist{};  ///< synth::netlist_hash of it
};
/// By the key's name.
using HardwareTable = std::map<std::string, HardwareFigures>;

/// LUTs and flip-flops, tables and multipliers as LUTs among them; memory that is written as LUTs of 16 bits.
double cell_count(const Cells& cells);

struct PinnedClock {
  synth::Pin pin;
  std::string tools;  ///< that it was placed with
};
/// By the hash of the netlist that each is of.
using PinnedClocks = std::map<std::string, PinnedClock>;

struct FiguresOptions {
  unsigned threads = 1;
  bool cells = true;  ///< else by Yosys no more than `place` takes
  /// Synthesizes and places what has no pinned clock, minutes each; else such a clock is not known.
  bool place = false;
  std::function<void(const std::string&)> on_progress = [](const std::string&) {};
};

/// The cells and clocks of all hardware that the records name, each from the cache where it is there. Without
/// Yosys there is a table without cells; a clock is pinned in synth::kPins or synth::kStudyPins by the hash
/// of the netlist that it is of.
Result<HardwareTable> hardware_figures(const std::string& scene, std::span<const Record> records,
                                       const SimulatorFolders& folders, const FiguresOptions& options);

/// Pins in synth::kStudyPins what a table made with `place` tells and synth::kPins does not, and leaves there
/// what other hardware has of the same flow; how many are pinned then.
Result<std::size_t> pin_clocks(const HardwareTable& table, const SimulatorFolders& folders);

/// What takes longest of that with `place`, in pieces that may be done by anyone, in any order: a placement
/// of each hardware by each seed. Each is left in the cache, with a mark that it is done: what the device has
/// no room for leaves nothing else.
class Placements {
 public:
  /// `points`: one of each hardware. `rtl`: the hash of all RTL. An error names what installs a missing tool.
  static Result<Placements> open(const std::string& scene, std::span<const DesignPoint> points,
                                 const SimulatorFolders& folders, const std::string& rtl);

  std::size_t count() const { return hardware_.size() * synth::kSeeds; }
  bool is_done(std::size_t number) const;
  /// Of hardware whose clock is pinned, or that does not fit, no more than the mark.
  Status make(std::size_t number) const;
  /// The hardware's name and the seed, for messages.
  std::string name(std::size_t number) const;

 private:
  Placements() = default;
  static unsigned seed_of(std::size_t number) { return static_cast<unsigned>(1 + number % synth::kSeeds); }
  const HardwareSource& source_of(std::size_t number) const { return hardware_[number / synth::kSeeds]; }
  std::filesystem::path mark(std::size_t number) const;

  std::vector<HardwareSource> hardware_;
  PinnedClocks pinned_;
  std::filesystem::path marks_;
  std::string made_by_;  ///< hash of what a placement hangs on beside the hardware's name and the seed
};

}  // namespace halfway::study
