// SPDX-License-Identifier: Apache-2.0
// Parts of HTML: files as data URIs, Markdown, SVG.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace halfway::report {

/// The file's bytes in base64.
std::string base64_of(const std::filesystem::path& file);

/// The file as a `data:` URI.
std::string data_uri(const std::filesystem::path& file, std::string_view media_type);

/// The commit of a checkout; null if unknown, for example without Git.
nlohmann::ordered_json commit_of(const std::filesystem::path& source);

/// JSON that can be placed in a `script` element: no text in it ends the element.
std::string script_safe(const std::string& json);

/// HTML of a Markdown page (GitHub's dialect, by cmark-gfm). Headings move down two levels. Tables are in
/// scrolling boxes named `name`. Links to the project's own files become plain text. HTML in the page is
/// removed.
std::string from_markdown(std::string_view markdown, std::string_view name);

/// An SVG file as an HTML element, without declaration and doctype, with `role` and a label. All ids and
/// their references are prefixed with `prefix`, so that a page can contain several. Black becomes the page's
/// text colour, white its background.
std::string inline_svg(const std::string& svg, const std::string& prefix, const std::string& label,
                       const char* role = "img");

}  // namespace halfway::report
