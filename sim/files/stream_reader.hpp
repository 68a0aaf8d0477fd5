// SPDX-License-Identifier: Apache-2.0
// What init files and traces have in common: the first line is `<kind> 1 <key name>...`, the last one
// `end <count>`. Reading is strict. Exactly one space separates fields. Decimal numbers have no sign, space
// or leading zero. Every content therefore has exactly one spelling.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "common/result.hpp"
#include "sim/os/file.hpp"

namespace halfway {

/// Remove the next field and the space after it from the front of `line`. In an invalid line a field may be
/// empty.
std::string_view take_field(std::string_view& line);
std::optional<std::uint64_t> to_number(std::string_view field, std::uint64_t largest);

class StreamReader {
 public:
  struct Kind {
    std::string_view word;    ///< the first one of the file
    std::string_view name;    ///< for messages: "an init file"
    std::string_view again;   ///< what to do about a broken file
    std::string_view fields;  ///< of the first line after the key's name, each after a space
  };
  /// Read the first line. A file for another hardware key is an error. An empty `key_name` accepts any key.
  static Result<StreamReader> open(const std::filesystem::path& path, const Kind& kind,
                                   std::string_view key_name, std::size_t longest_line);
  const std::string& key_name() const { return key_name_; }
  const std::string& fields() const { return fields_; }
  Error broken_header() const;

  /// Read the next line; false after the last one, which must say that `count` items precede it.
  Result<bool> next(std::string_view& line, std::uint64_t count);
  Error wrong_end(std::uint64_t count) const;
  Error at(std::string_view what) const { return lines_.at(what); }

 private:
  StreamReader(LineReader lines, const Kind& kind) : lines_(std::move(lines)), kind_(kind) {}
  LineReader lines_;
  Kind kind_;
  std::string key_name_, fields_;
  bool ended_ = false;
};

}  // namespace halfway
