// SPDX-License-Identifier: Apache-2.0
// The golden model computes on words: it uses their names without qualification.
#pragma once

#include "words/formats.hpp"
#include "words/word.hpp"

namespace halfway::golden {
using namespace words;
}  // namespace halfway::golden
