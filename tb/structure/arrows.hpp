// SPDX-License-Identifier: Apache-2.0
// Which folder includes which. Dependencies go one way, tb -> sim -> model, and folders form no cycle.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace halfway::structure {

/// C++ files of a checkout: their text by path, such as model/setup/edge.hpp.
using Sources = std::map<std::string, std::string>;

/// Every include line that breaks a rule, as `file:line: the fault, and how to mend it`, then every cycle of
/// folders:
/// - model/ includes nothing of sim/ or tb/, and sim/ nothing of tb/.
/// - Outside tests, no folder depends on itself through the folders that it includes.
/// - Only tests and tb/ include the files of folders named test.
/// - No source file (.cpp) is included.
std::vector<std::string> wrong_arrows(const Sources& sources);

}  // namespace halfway::structure
