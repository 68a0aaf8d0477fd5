// SPDX-License-Identifier: Apache-2.0
// Names of the machine and its operating system, for pages with measured times.
#pragma once

#include <string>

namespace halfway {

/// For example "4 cores of AMD EPYC, AVX2, 15 GiB".
std::string machine();

/// For example "Debian GNU/Linux 12 (bookworm)".
std::string operating_system();

}  // namespace halfway
