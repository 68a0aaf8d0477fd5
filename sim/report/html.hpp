// SPDX-License-Identifier: Apache-2.0
// Pieces of HTML: files as data, Markdown, SVG.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "common/result.hpp"

namespace halfway::report {

/// The file as a `data:` URI.
Result<std::string> data_uri(const std::filesystem::path& file, std::string_view media_type);

/// JSON as it may stand in a `script`: nothing in it can end that element.
std::string script_safe(std::string json);

/// The page's HTML (GitHub's Markdown, by cmark-gfm): headings two levels down, tables in boxes that scroll,
/// called `name`; links to the project's own files as plain text, and no HTML of the page's own.
std::string from_markdown(std::string_view markdown, std::string_view name);

/// An SVG file as an element: without declaration and doctype, with `role` and a label, its ids and what
/// refers to them beginning with `prefix`, so that several go into one page. Black becomes the page's ink,
/// white its paper.
Result<std::string> inline_svg(const std::string& svg, const std::string& prefix, const std::string& label,
                               const char* role = "img");

}  // namespace halfway::report
