// SPDX-License-Identifier: Apache-2.0
// What a page says of the machine that its figures are of.
#pragma once

#include <string>

namespace halfway {

/// As in "4 cores of AMD EPYC, 15 GiB".
std::string machine();

/// As in "Debian GNU/Linux 12 (bookworm)".
std::string operating_system();

}  // namespace halfway
