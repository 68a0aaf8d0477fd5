// SPDX-License-Identifier: Apache-2.0
// Citations of the three papers: each cited section, figure, table and equation must exist, a figure, table
// or equation that is cited within a section must be in it, and what is cited must be there.
#pragma once

#include <string>
#include <vector>

namespace halfway::structure {

/// Every wrong citation of a text, as `file:line: the fault, and how to mend it`. Citations are
/// `spherical paper, section 4 and figure 12`, `quadratic, equation 4` or `table 4 of the processors paper`;
/// they may continue in the next line of a comment or of a string.
std::vector<std::string> wrong_citations(const std::string& file, const std::string& text);

/// Number of citations of the text.
std::size_t count_citations(const std::string& text);

}  // namespace halfway::structure
