// SPDX-License-Identifier: Apache-2.0
// What the host does for a frame, in instructions: counted by Callgrind.
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

/// Makes the init vectors of one frame, from the scene on: what is counted. `formats` as in
/// make_setup. Callgrind knows it by its name.
[[gnu::noinline]] SetupCounts set_up_frame(const Scene& scene, FrameSize size, const HardwareKey& key,
                                           const SetupOptions& options, const MadeFormats* formats);

/// For each line of the file, a name: calls `each` in a process of its own, then writes the process's number
/// and the name to standard output. The processes begin with the same heap, whatever the names: the number of
/// instructions that the allocator takes depends on what it did before.
Status in_processes(const std::filesystem::path& names,
                    const std::function<Status(const std::string&)>& each);

/// Instructions of set_up_frame for each of the points, by their names. The worker, to which they are added,
/// each behind `--set-up`, sets them up by in_processes. None where there is no Valgrind.
Result<std::optional<std::vector<std::uint64_t>>> host_instructions(std::vector<std::string> worker,
                                                                    const std::vector<std::string>& names,
                                                                    const std::filesystem::path& scratch);

}  // namespace halfway::study
