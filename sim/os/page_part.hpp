// SPDX-License-Identifier: Apache-2.0
// Parts of a page that a command writes. Two HTML comments, each on its own line, mark each part.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "common/result.hpp"

namespace halfway {

/// Return the page with the text between `<!-- NAME: ... -->` and `<!-- end of NAME -->` replaced.
Result<std::string> with_page_part(std::string_view page, std::string_view name, std::string_view text);

/// Replace the page in the file by `rewritten(page)`. An error of either names the file.
Status rewrite_page(const std::filesystem::path& path,
                    const std::function<Result<std::string>(const std::string& page)>& rewritten);

}  // namespace halfway
