// SPDX-License-Identifier: Apache-2.0
// Which folder includes which. Arrows point one way: tb -> sim -> model, and no folders form a cycle.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace halfway::structure {

/// C++ files of a checkout: their paths, such as model/setup/edge.hpp, and their text.
using Sources = std::map<std::string, std::string>;

/// Every include line that breaks a rule, as `file:line: what, and what to do`, then every cycle of folders:
/// - model/ includes nothing of sim/ or tb/, and sim/ nothing of tb/.
/// - Outside tests, no folder reaches itself through the folders that it includes.
/// - Helpers in folders named test are included by tests and by tb/ alone.
/// - No source file (.cpp) is included.
std::vector<std::string> wrong_arrows(const Sources& sources);

}  // namespace halfway::structure
