// SPDX-License-Identifier: Apache-2.0
// Pages from templates: Mustache files filled with JSON data, and Markdown tables.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "common/result.hpp"

namespace halfway {

/// Characters that `{{name}}` escapes: vertical bars, which would end a cell of a Markdown table, or HTML's
/// characters. `{{{name}}}` is never escaped.
enum class Escape { bars, html };

/// Fill the template with `data`: texts, numbers, true and false, lists and objects; null is false. A name in
/// the template that the data lacks is an error.
Result<std::string> filled_template(const std::filesystem::path& file, const nlohmann::ordered_json& data,
                                    Escape escape = Escape::bars);

/// A Markdown table. Cells are not escaped.
std::string markdown_table(std::span<const std::string> columns,
                           std::span<const std::vector<std::string>> rows);

}  // namespace halfway
