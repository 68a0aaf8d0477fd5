// SPDX-License-Identifier: Apache-2.0
// The searches over scenes: the spherical shader and the shading processors.
#pragma once

#include <memory>

#include "stability/search.hpp"

namespace halfway::stability {

std::unique_ptr<Search> make_spherical_search();
std::unique_ptr<Search> make_processors_search();

}  // namespace halfway::stability
