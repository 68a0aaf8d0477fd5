// SPDX-License-Identifier: Apache-2.0
// Number of host instructions for a frame, counted by Callgrind.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/result.hpp"
#include "plan/hardware_key.hpp"
#include "scene/scene.hpp"
#include "setup/setup.hpp"
#include "sim/formats/made_formats.hpp"

namespace halfway::study {

inline constexpr const char* c_install_valgrind = "apt-get install valgrind";

/// Compute the init vectors of one frame from the scene. Callgrind counts this function, found by its name.
/// `formats` as in make_setup.
[[gnu::noinline]] SetupCounts set_up_frame(const Scene& scene, FrameSize size, const HardwareKey& key,
                                           const SetupOptions& options, const MadeFormats* formats);

/// For each line of the file, a name: call `each` in a new process, then print the process id and the name on
/// standard output. All processes start with the same heap, for any names, because the allocator's
/// instructions depend on its history.
Status in_processes(const std::filesystem::path& names,
                    const std::function<Status(const std::string&)>& each);

/// Instructions of set_up_frame for each of the points, given by name. `worker` is a command that calls
/// in_processes; the names are passed to it with `--set-up`. std::nullopt without Valgrind.
Result<std::optional<std::vector<std::uint64_t>>> host_instructions(std::vector<std::string> worker,
                                                                    const std::vector<std::string>& names,
                                                                    const std::filesystem::path& scratch);

}  // namespace halfway::study
