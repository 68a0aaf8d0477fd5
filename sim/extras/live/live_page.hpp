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

#include "sim/cost/families.hpp"
#include "sim/engines/ghdl/ghdl_library.hpp"

namespace halfway::live {

struct LiveSettings {
  std::filesystem::path page;       ///< output file
  std::vector<std::string> scenes;  ///< names of the built-in scenes
  bool meshes = true;               ///< with the hardware of mesh files
  SimulatorFolders folders;
  const synth::Family* family = &synth::c_default_family;  ///< whose clocks the page shows
  unsigned threads = 1;
  std::function<void(const std::string& what)> on_progress = [](const std::string&) {};
};

struct LivePage {
  std::size_t bytes = 0;     ///< of the file
  std::size_t hardware = 0;  ///< number of keys
};

/// Build the modules, which takes minutes if the cache has none, and write the page atomically. The page has
/// the hardware of the scenes, and of a mesh file, grey or coloured, by all shaders in both presets. Throws
/// Failure.
LivePage write_live(const LiveSettings& settings);

}  // namespace halfway::live
