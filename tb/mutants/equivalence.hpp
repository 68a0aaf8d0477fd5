// SPDX-License-Identifier: Apache-2.0
// Whether a change of the RTL changes the hardware at all.
#pragma once

#include "judge.hpp"

namespace halfway::mutants {

/// True only where it is proved that the hardware does the same in every clock, from any state on.
Result<bool> proved_equivalent(const Judge& judge, const Exchanged& exchanged);

}  // namespace halfway::mutants
