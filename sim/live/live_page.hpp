// SPDX-License-Identifier: Apache-2.0
// The page of `make live`: one HTML file that draws scenes by the RTL in a browser. It contains the core
// (set-up, golden model, reference, comparison) and the hardware of every key that the built-in scenes need,
// as WebAssembly.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "common/result.hpp"
#include "plan/hardware_key.hpp"
#include "sim/ghdl/ghdl_library.hpp"

namespace halfway::live {

struct LiveSettings {
  std::filesystem::path page;       ///< output file
  std::vector<std::string> scenes;  ///< names of the built-in scenes
  SimulatorFolders folders;
  unsigned threads = 1;
  std::function<void(const std::string& what)> on_progress = [](const std::string&) {};
};

struct LivePage {
  std::size_t bytes = 0;     ///< of the file
  std::size_t hardware = 0;  ///< number of keys
};

/// The hardware of all built-in scenes and of a mesh file, grey or coloured, by all shaders in both presets.
/// Each key once, sorted by name. A shader that cannot draw a scene has no key for it.
Result<std::vector<HardwareKey>> live_keys(const std::vector<std::string>& scenes,
                                           const std::filesystem::path& scenes_folder);

/// Build the modules, which takes minutes if the cache has none, and write the page atomically.
Result<LivePage> write_live(const LiveSettings& settings);

}  // namespace halfway::live
