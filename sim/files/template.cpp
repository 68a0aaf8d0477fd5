// SPDX-License-Identifier: Apache-2.0
#include "sim/files/template.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <kainjow/mustache.hpp>

#include "sim/os/file.hpp"

namespace halfway {
namespace {

using kainjow::mustache::data;

data data_of(const nlohmann::ordered_json& json) {
  if (json.is_null()) return false;
  if (json.is_string()) return json.get<std::string>();
  if (json.is_boolean()) return json.get<bool>();
  if (json.is_array()) {
    kainjow::mustache::list list;
    for (const auto& item : json) list.push_back(data_of(item));
    return list;
  }
  if (!json.is_object()) return json.dump();
  kainjow::mustache::object object;
  for (const auto& [name, value] : json.items()) object.emplace(name, data_of(value));
  return object;
}

// Mustache itself omits names that the data lacks; here they are errors.
class StrictContext : public kainjow::mustache::context<std::string> {
 public:
  using context::context;
  const data* get(const std::string& name) const override {
    const data* const found = context::get(name);
    if (found == nullptr) lacking_ = name;
    return found;
  }
  const std::string& lacking() const { return lacking_; }

 private:
  mutable std::string lacking_;
};

std::string escaped_bars(const std::string& text) {
  std::string cell;
  for (const char c : text) cell += c == '|' ? std::string("\\|") : std::string(1, c);
  return cell;
}

}  // namespace

Result<std::string> filled_template(const std::filesystem::path& file, const nlohmann::ordered_json& json,
                                    Escape escape) {
  const auto text = read_file(file);
  if (!text) return text.error();
  kainjow::mustache::mustache page(*text);
  if (escape == Escape::bars) page.set_custom_escape(escaped_bars);
  const data root = data_of(json);
  StrictContext context(&root);
  std::string filled = page.render(context);
  if (!page.is_valid()) return tool_failed(fmt::format("{}: {}", file.string(), page.error_message()));
  if (!context.lacking().empty())
    return tool_failed(fmt::format("{}: the data has no '{}'", file.string(), context.lacking()));
  return filled;
}

std::string markdown_table(std::span<const std::string> columns,
                           std::span<const std::vector<std::string>> rows) {
  std::string text = fmt::format("| {} |\n|", fmt::join(columns, " | "));
  for (std::size_t i = 0; i < columns.size(); ++i) text += " --- |";
  text += '\n';
  for (const std::vector<std::string>& row : rows) text += fmt::format("| {} |\n", fmt::join(row, " | "));
  return text;
}

}  // namespace halfway
