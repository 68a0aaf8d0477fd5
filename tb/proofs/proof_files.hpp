// SPDX-License-Identifier: Apache-2.0
// Reads the descriptions of the proofs: files x.toml, each for the unit x.psl or x.gappa next to it,
// or for the one that it names.
#pragma once

#include <filesystem>
#include <vector>

#include "proof.hpp"

namespace halfway::proofs {

/// The proofs of every file below tb/rtl of the project at `source`, by path. An unknown key, a value of
/// the wrong kind, a file without a unit and a unit that no file describes throw Failure.
std::vector<Proof> read_proofs(const std::filesystem::path& source);

}  // namespace halfway::proofs
