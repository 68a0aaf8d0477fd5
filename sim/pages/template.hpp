// SPDX-License-Identifier: Apache-2.0
// Pages from templates: Mustache files filled with JSON, and Markdown tables.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "common/result.hpp"

namespace halfway {

/// What `{{name}}` escapes: the bars that would end a cell of a Markdown table, or HTML's characters.
/// `{{{name}}}` is the text as it is.
enum class Escape { bars, html };

/// The template filled with `data`: texts, numbers, true and false, lists and objects; null is false. It is
/// an error if the template names what the data lacks.
Result<std::string> filled_template(const std::filesystem::path& file, const nlohmann::ordered_json& data,
                                    Escape escape = Escape::bars);

/// A Markdown table. All cells are written as they are.
std::string markdown_table(std::span<const std::string> columns,
                           std::span<const std::vector<std::string>> rows);

}  // namespace halfway
