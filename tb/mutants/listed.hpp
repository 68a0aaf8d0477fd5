// SPDX-License-Identifier: Apache-2.0
// Faults that somebody thought of, where generated ones would not come to it.
#pragma once

#include <span>
#include <string_view>

namespace halfway::mutants {

struct Listed {
  const char* file;       ///< in rtl/
  std::string_view from;  ///< occurs once
  std::string_view to;
  const char* tested = file;  ///< in rtl/: the entity whose testbench has to find the fault
};

std::span<const Listed> listed_mutants();

}  // namespace halfway::mutants
