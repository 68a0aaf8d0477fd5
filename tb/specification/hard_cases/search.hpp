// SPDX-License-Identifier: Apache-2.0
// Randomized search. Inputs are made from seeds. The golden model is compared with the specification, and the
// RTL with the golden model, until an input fails. Its seed and number make it again.
//
// A search is a class (triangle_search.cpp, scene_search.cpp) and an entry of c_searches in search_main.cpp.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "common/result.hpp"
#include "sim/engines/ghdl/ghdl_library.hpp"
#include "specification/hard_cases/trial.hpp"

namespace halfway::stability {

/// Results so far.
struct Tally {
  std::uint64_t inputs = 0, fragments = 0, rtl_inputs = 0, rtl_fragments = 0;
  std::map<std::string, Worst> worst{};  ///< worst figure of each quantity; one figure per input
  void add(const Tally& other);
  /// Adds the worst figure of an input. Returns what exceeds its bound; empty if it does not.
  std::string add(const char* quantity, const Worst& of_input);
};

/// Checks the inputs of one thread. It may keep models and simulators between inputs. The same seed always
/// gives the same input.
class Search {
 public:
  virtual ~Search() = default;
  /// Compares the golden model with the specification. Returns what fails; empty if nothing does.
  virtual std::string check(std::uint32_t seed, Tally& tally) = 0;
  /// Compares the RTL with the golden model, one input after the other in the same hardware. Fails if a tool
  /// is missing or broke.
  virtual Result<std::string> check_rtl(std::span<const std::uint32_t> seeds, Tally& tally) = 0;
};

/// Adds `inputs` inputs, drawn by the trial, to the tally. Returns how RTL and golden model differ.
Result<std::string> rtl_failure(const Trial& trial, std::uint64_t inputs, Tally& tally);

std::unique_ptr<Search> make_triangle_search(const SimulatorFolders& folders);
/// With `quick`, the search leaves out hardware that takes minutes to build.
std::unique_ptr<Search> make_scene_search(Shader shader, const SimulatorFolders& folders, bool quick);

}  // namespace halfway::stability
