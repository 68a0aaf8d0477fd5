// SPDX-License-Identifier: Apache-2.0
// The registry of hard cases: where a published formula breaks, what is done about it, and what then holds.
#pragma once

#include <span>
#include <string_view>

namespace halfway::stability {

class Trial;

/// What the published form does in the case.
enum class Published {
  breaks,  ///< it must be seen past the bound
  holds,   ///< it must stay within it
  silent   ///< no paper has such a form: there is no figure
};

/// A line of the registry. `run` sweeps the case: it hands every figure and its bound to the trial, and draws
/// what reaches the hardware.
struct HardCase {
  std::string_view name;
  std::string_view breaks;  ///< the formula, and where it stands
  std::string_view remedy;
  std::string_view holds;  ///< the property that the figures measure
  std::string_view unit;   ///< of figures and bounds
  Published published;
  void (*run)(Trial&);
};

/// One file each, which holds its cases in one array.
struct Family {
  std::string_view name;
  std::span<const HardCase> cases;
};

extern const Family c_edges;
extern const Family c_quadratic;
extern const Family c_spherical;
extern const Family c_processors;
extern const Family c_illumination;
extern const Family c_conversions;
extern const Family c_shadows;
extern const Family c_arithmetic;

}  // namespace halfway::stability
