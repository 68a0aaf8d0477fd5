// SPDX-License-Identifier: Apache-2.0
// README's parts that are drawn from the page of `make bench`.
#pragma once

#include <string>

#include "common/result.hpp"

namespace halfway {

struct ReadmeParts {
  std::string view;      ///< part "view": frames a second
  std::string speed;     ///< part "speed": ways to a picture, and how time grows
  std::string sim_line;  ///< part "sim line": what `make sim` prints for a scene
};

/// `page`: sim/bench/README.md. An error where a figure is not in it, as in one of a part of the
/// measurements.
Result<ReadmeParts> readme_parts(const std::string& page);

/// README with these parts in place of what it has.
Result<std::string> with_readme_parts(const std::string& readme, const ReadmeParts& parts);

}  // namespace halfway
