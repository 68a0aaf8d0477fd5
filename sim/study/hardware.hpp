// SPDX-License-Identifier: Apache-2.0
// Hardware of a study's points and its cost. Costs belong to a hardware key, not to a point.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "plan/hardware_key.hpp"
#include "scene/scene.hpp"
#include "sim/cost/cost.hpp"
#include "sim/engines/ghdl/ghdl_library.hpp"
#include "sim/generator/word_lengths/made_formats.hpp"
#include "sim/generator/word_lengths/made_tables.hpp"
#include "sim/study/design_point.hpp"
#include "sim/study/record.hpp"

namespace halfway::study {

/// The hardware for a point.
struct PointHardware {
  HardwareKey key;
  std::shared_ptr<const tables::MadeTables> tables;  ///< for the key, if not compiled into the program
  Models models{};                                   ///< for the key
};
/// `point.method` must be hardware. Throws bad input if the hardware cannot draw the scene. Points whose word
/// lengths differ from the preset's need `drawing_hardware_of` to draw.
PointHardware hardware_of(const DesignPoint& point, const Scene& scene);
/// Same as hardware_of, but with formats that are not compiled into the program: compile them unless the
/// cache has them.
PointHardware drawing_hardware_of(const DesignPoint& point, const Scene& scene,
                                  const SimulatorFolders& folders);

/// Sources of the RTL with which the point draws the scene: `folders`, or a copy in the cache if its tables
/// or word lengths are not compiled into the program.
SimulatorFolders rtl_of(const DesignPoint& point, const Scene& scene, const SimulatorFolders& folders);

/// By the key's name.
using HardwareTable = std::map<std::string, synth::Cost>;

struct FiguresOptions {
  unsigned threads = 1;
  /// Synthesize and place hardware without a stored clock (minutes each). false: such clocks stay unknown.
  bool place = false;
  const synth::Family* family = &synth::c_default_family;  ///< whose device is placed
  std::function<void(const std::string&)> on_progress = [](const std::string&) {};
};

/// Each hardware of the points once, in their order. Points that cannot draw the scene have none.
std::vector<synth::Design> hardware_of_space(const std::string& scene, std::span<const DesignPoint> points,
                                             const SimulatorFolders& folders);

/// The costs of all hardware that the records name.
HardwareTable hardware_figures(const std::string& scene, std::span<const Record> records,
                               const SimulatorFolders& folders, const FiguresOptions& options);

/// The longest step of hardware_figures with `place`, in independent pieces: a placement of each hardware
/// with each seed. Results are stored in the cache with a mark for each finished piece. If the hardware does
/// not fit the device, the mark is the only result.
class Placements {
 public:
  /// `points`: one for each hardware. `rtl`: the hash of all RTL. If a tool is missing, the error names the
  /// package to install.
  Placements(const std::string& scene, std::span<const DesignPoint> points, const SimulatorFolders& folders,
             const std::string& rtl, const synth::Family& family);

  std::size_t count() const { return hardware_.size() * synth::c_seeds; }
  bool is_done(std::size_t number) const;
  /// Make one placement. For hardware with a stored clock, or that does not fit, only write the mark.
  void make(std::size_t number) const;
  /// The hardware's name and the seed, for messages.
  std::string name(std::size_t number) const;

 private:
  static unsigned seed_of(std::size_t number) { return static_cast<unsigned>(1 + number % synth::c_seeds); }
  const synth::Design& design_of(std::size_t number) const { return hardware_[number / synth::c_seeds]; }
  std::filesystem::path mark(std::size_t number) const;

  std::vector<synth::Design> hardware_;
  synth::Costing costing_;
  synth::Synthesizer synthesizer_;
  std::filesystem::path marks_;
  std::string made_by_;  ///< hash of all that a placement depends on, except the hardware's name and the seed
};

}  // namespace halfway::study
