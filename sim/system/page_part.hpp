// SPDX-License-Identifier: Apache-2.0
// Parts of a page that a command writes, between two comments on lines of their own that a reader does not
// see.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "common/result.hpp"

namespace halfway {

/// What stands between `<!-- NAME: ... -->` and `<!-- end of NAME -->`, blank lines at both ends left out.
Result<std::string> page_part(std::string_view page, std::string_view name);

/// The page with that part's text in place of what stands there.
Result<std::string> with_page_part(std::string_view page, std::string_view name, std::string_view text);

/// Writes what `rewritten` makes of the file's page over it; an error of either names the file.
Status rewrite_page(const std::filesystem::path& path,
                    const std::function<Result<std::string>(const std::string& page)>& rewritten);

}  // namespace halfway
