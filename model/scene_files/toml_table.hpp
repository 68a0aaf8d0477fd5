// SPDX-License-Identifier: Apache-2.0
// Checked values of a TOML table. The first error is kept; after it the values are of no use.
#pragma once

// Without exceptions toml++ is another library than Debian's, so it is compiled here.
#define TOML_EXCEPTIONS 0
#define TOML_HEADER_ONLY 1
#define TOML_ENABLE_FORMATTERS 0

#include <fstream>
#include <istream>
#include <string>

// A function of toml++ opens a file, which nothing here calls. The standard library for a browser has no
// files since libc++ 19: this stream opens none.
#if defined(_LIBCPP_HAS_NO_FILESYSTEM) || (defined(_LIBCPP_HAS_FILESYSTEM) && !_LIBCPP_HAS_FILESYSTEM)
template <>
class std::basic_ifstream<char> : public std::istream {
 public:
  basic_ifstream() : std::istream(nullptr) {}
  void open(const std::string&, std::ios_base::openmode) {}
  bool is_open() const { return false; }
};
#endif
#include <toml++/toml.h>

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "common/result.hpp"
#include "scene_files/add_mesh.hpp"

namespace halfway {

/// The first error of a file. Later ones may only follow from it.
class FirstError {
 public:
  void set(Error error) {
    if (!error_) error_ = std::move(error);
  }
  explicit operator bool() const { return error_.has_value(); }
  const Error& operator*() const { return *error_; }

 private:
  std::optional<Error> error_;
};

/// Allowed range of a number.
struct Limits {
  double low = -c_max_number;
  double high = c_max_number;
  bool low_excluded = false;
  bool high_excluded = false;

  bool hold(double value) const {
    return (low_excluded ? value > low : value >= low) && (high_excluded ? value < high : value <= high);
  }
  std::string text() const;
};

inline constexpr Limits c_any{};
inline constexpr Limits c_not_negative{.low = 0.0};
inline constexpr Limits c_positive{.low = 0.0, .low_excluded = true};
inline constexpr Limits c_at_least_1{.low = 1.0};

/// A table of the scene file. Returns its values checked, and knows their line numbers.
class TomlTable {
 public:
  /// `what` names the table in messages. A key that is not in `known` is an error.
  TomlTable(const toml::table& table, std::string file, std::string what,
            const std::vector<std::string_view>& known, FirstError& error);

  bool has(std::string_view key) const { return table_.contains(key); }

  void fail(std::string_view message) const;
  void fail(std::string_view key, std::string_view message) const;

  /// Null after an error.
  const toml::node* required(std::string_view key) const;

  double number(std::string_view key, double otherwise, const Limits& limits) const;
  std::uint32_t count(std::string_view key, std::uint32_t otherwise, std::uint32_t least) const;
  bool flag(std::string_view key, bool otherwise) const;
  std::string text(std::string_view key) const;
  glm::dvec3 vector(std::string_view key, const Limits& limits = c_any) const;
  glm::dvec3 vector(std::string_view key, const glm::dvec3& otherwise, const Limits& limits = c_any) const;
  glm::dvec3 direction(std::string_view key) const;
  /// Three numbers, or one for all three.
  glm::dvec3 one_or_three(std::string_view key, const glm::dvec3& otherwise,
                          const Limits& limits = c_any) const;
  /// Radiance or reflectance. One number means grey.
  glm::dvec3 colour(std::string_view key, const glm::dvec3& otherwise) const;

  const toml::table& table() const { return table_; }

 private:
  void fail_at(const toml::source_region& where, std::string_view message) const;
  double number_in(std::string_view key, const toml::node& node, const Limits& limits) const;

  const toml::table& table_;
  std::string file_;
  std::string what_;
  FirstError& error_;
};

}  // namespace halfway
