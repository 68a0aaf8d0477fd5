// SPDX-License-Identifier: Apache-2.0
// The host's work for a frame: its instructions, counted by Callgrind, and its time.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "plan/hardware_key.hpp"
#include "scene/scene.hpp"
#include "setup/setup.hpp"
#include "sim/driver/models.hpp"
#include "sim/engines/ghdl/ghdl_library.hpp"
#include "sim/study/design_point.hpp"
#include "sim/study/measure.hpp"

namespace halfway::study {

inline constexpr const char* c_install_valgrind = "apt-get install valgrind";

struct HostWork {
  SetupCounts counts;
  std::uint64_t words = 0;  ///< 32-bit words of init vectors and line records
};

/// Compute the init vectors of one frame from the scene. Callgrind counts this function, found by its name.
[[gnu::noinline]] HostWork set_up_frame(const Scene& scene, FrameSize size, const HardwareKey& key,
                                        const SetupOptions& options, const Models& models);

/// The options of the point, with what a host computes once per scene: the bells of the spherical shader.
SetupOptions frame_setup(const DesignPoint& point, const Scene& scene);

/// The host's time for one frame of the point on one core of this machine: processor time of the thread,
/// the quickest of several runs. In hardware: set_up_frame. In software: from the scene to the picture.
/// `scene` as for load_scene.
HostTime host_time(const DesignPoint& point, const std::string& scene, const SimulatorFolders& folders);

/// For each line of the file, a name: call `each` in a new process, then print the process id and the name on
/// standard output. All processes start with the same heap, for any names, because the allocator's
/// instructions depend on its history.
void in_processes(const std::filesystem::path& names, const std::function<void(const std::string&)>& each);

/// Instructions of set_up_frame for each of the points, given by name. `worker` is a command that calls
/// in_processes; the names are passed to it with `--set-up`. std::nullopt without Valgrind.
std::optional<std::vector<std::uint64_t>> host_instructions(std::vector<std::string> worker,
                                                            const std::vector<std::string>& names,
                                                            const std::filesystem::path& scratch);

}  // namespace halfway::study
