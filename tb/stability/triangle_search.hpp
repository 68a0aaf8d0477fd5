// SPDX-License-Identifier: Apache-2.0
// The search over triangles on the screen: coverage, colour and depth of the quadratic shader.
#pragma once

#include <memory>

#include "stability/search.hpp"

namespace halfway::stability {

std::unique_ptr<Search> make_triangle_search();

}  // namespace halfway::stability
