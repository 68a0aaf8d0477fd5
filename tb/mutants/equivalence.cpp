// SPDX-License-Identifier: Apache-2.0
#include "equivalence.hpp"

namespace halfway::mutants {

Result<bool> proved_equivalent(const Judge&, const Exchanged&) { return false; }

}  // namespace halfway::mutants
