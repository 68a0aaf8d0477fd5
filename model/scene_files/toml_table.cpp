// SPDX-License-Identifier: Apache-2.0
#include "scene_files/toml_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace halfway {

std::string Limits::text() const {
  const std::string above =
      low <= -c_max_number ? "" : fmt::format("{} {:g}", low_excluded ? "greater than" : "at least", low);
  const std::string below = fmt::format("{} {:g}", high_excluded ? "less than" : "at most", high);
  return above.empty() ? below : above + " and " + below;
}

TomlTable::TomlTable(const toml::table& table, std::string file, std::string what,
                     const std::vector<std::string_view>& known, FirstError& error)
    : table_(table), file_(std::move(file)), what_(std::move(what)), error_(error) {
  for (const auto& [key, value] : table_) {
    if (std::find(known.begin(), known.end(), key.str()) != known.end()) continue;
    fail_at(key.source(),
            fmt::format("unknown key '{}' in {}; it may have: {}", key.str(), what_, fmt::join(known, ", ")));
  }
}

void TomlTable::fail(std::string_view message) const {
  fail_at(table_.source(), message);
}

void TomlTable::fail(std::string_view key, std::string_view message) const {
  const toml::node* node = table_.get(key);
  fail_at(node != nullptr ? node->source() : table_.source(),
          fmt::format("{} of {} {}", key, what_, message));
}

void TomlTable::fail_at(const toml::source_region& where, std::string_view message) const {
  error_.set(bad_input(fmt::format("{}:{}: {}", file_, where.begin.line, message)));
}

const toml::node* TomlTable::required(std::string_view key) const {
  const toml::node* node = table_.get(key);
  if (node == nullptr) fail(fmt::format("{} has no '{}'; give it one", what_, key));
  return node;
}

double TomlTable::number(std::string_view key, double otherwise, const Limits& limits) const {
  return has(key) ? number_in(key, *table_.get(key), limits) : otherwise;
}

double TomlTable::number_in(std::string_view key, const toml::node& node, const Limits& limits) const {
  if (!node.is_number()) {
    fail(key, "must be a number");
    return 0.0;
  }
  const double value =
      node.is_integer() ? static_cast<double>(node.as_integer()->get()) : node.as_floating_point()->get();
  const auto complain = [&](std::string_view message) {
    fail_at(node.source(), fmt::format("{} of {} {}", key, what_, message));
  };
  if (!std::isfinite(value)) complain("is not finite; give it a number");
  if (!limits.hold(value)) complain(fmt::format("is {}, but must be {}", value, limits.text()));
  return value;
}

std::uint32_t TomlTable::count(std::string_view key, std::uint32_t otherwise, std::uint32_t least) const {
  const toml::node* node = table_.get(key);
  if (node == nullptr) return otherwise;
  const std::optional<std::int64_t> value = node->value_exact<std::int64_t>();
  if (!value.has_value()) {
    fail(key, "must be a whole number");
    return otherwise;
  }
  if (*value < least || *value > c_max_triangles) {
    fail(key, fmt::format("is {}, but must be from {} to {}", *value, least, c_max_triangles));
    return otherwise;
  }
  return static_cast<std::uint32_t>(*value);
}

bool TomlTable::flag(std::string_view key, bool otherwise) const {
  const toml::node* node = table_.get(key);
  if (node == nullptr) return otherwise;
  const std::optional<bool> value = node->value_exact<bool>();
  if (!value.has_value()) fail(key, "must be true or false");
  return value.value_or(otherwise);
}

std::string TomlTable::text(std::string_view key) const {
  const toml::node* node = required(key);
  if (node == nullptr) return {};
  const std::optional<std::string> value = node->value_exact<std::string>();
  if (!value.has_value())
    fail(key, "must be a text in quotes");
  else if (value->empty())
    fail(key, "is empty");
  return value.value_or(std::string());
}

glm::dvec3 TomlTable::vector(std::string_view key, const Limits& limits) const {
  const toml::node* node = required(key);
  if (node == nullptr) return glm::dvec3(0.0);
  const toml::array* array = node->as_array();
  if (array == nullptr || array->size() != 3) {
    fail(key, "must be three numbers, as [1.0, 0.5, 0.0]");
    return glm::dvec3(0.0);
  }
  glm::dvec3 result;
  for (int i = 0; i < 3; ++i) result[i] = number_in(key, (*array)[static_cast<std::size_t>(i)], limits);
  return result;
}

glm::dvec3 TomlTable::vector(std::string_view key, const glm::dvec3& otherwise, const Limits& limits) const {
  return has(key) ? vector(key, limits) : otherwise;
}

glm::dvec3 TomlTable::direction(std::string_view key) const {
  const glm::dvec3 result = vector(key);
  const double length = glm::length(result);
  if (length > 1e-100) return result / length;
  fail(key, "has no direction: it is zero; give it one");
  return result;
}

glm::dvec3 TomlTable::one_or_three(std::string_view key, const glm::dvec3& otherwise,
                                   const Limits& limits) const {
  if (!has(key)) return otherwise;
  if (table_.get(key)->is_number()) return glm::dvec3(number(key, 0.0, limits));
  return vector(key, limits);
}

glm::dvec3 TomlTable::colour(std::string_view key, const glm::dvec3& otherwise) const {
  return one_or_three(key, otherwise, c_not_negative);
}

}  // namespace halfway
