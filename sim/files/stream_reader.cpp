// SPDX-License-Identifier: Apache-2.0
#include "sim/files/stream_reader.hpp"

#include <fmt/format.h>

#include <charconv>

namespace halfway {

std::string_view take_field(std::string_view& line) {
  const std::size_t space = line.find(' ');
  const std::string_view field = line.substr(0, space);
  line.remove_prefix(space == std::string_view::npos ? line.size() : space + 1);
  return field;
}

std::optional<std::uint64_t> to_number(std::string_view field, std::uint64_t largest) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc() || end != field.data() + field.size()) return std::nullopt;
  if (field.front() == '0' && field.size() > 1) return std::nullopt;
  return value <= largest ? std::optional(value) : std::nullopt;
}

Result<StreamReader> StreamReader::open(const std::filesystem::path& path, const Kind& kind,
                                        std::string_view key_name, std::size_t longest_line) {
  auto lines = LineReader::open(path, longest_line);
  if (!lines) return lines.error();
  StreamReader reader(std::move(*lines), kind);
  std::string_view line;
  const auto more = reader.lines_.next(line);
  if (!more) return more.error();
  if (!*more) return bad_input(fmt::format("{}:1: the file is empty; {}", path.string(), kind.again));
  const bool spaced = line.ends_with(' ');  // take_field ignores a space after the last field
  if (take_field(line) != kind.word)
    return reader.at(fmt::format("not {}; the first line must begin with {}", kind.name, kind.word));
  if (take_field(line) != "1")
    return reader.at(fmt::format("{} of another version; {}", kind.name, kind.again));
  reader.key_name_ = take_field(line);
  reader.fields_ = line;
  if (reader.key_name_.empty() || spaced || line.empty() != kind.fields.empty())
    return reader.broken_header();
  if (!key_name.empty() && reader.key_name_ != key_name)
    return reader.at(
        fmt::format("made for the hardware {}, wanted is {}; {}", reader.key_name_, key_name, kind.again));
  return reader;
}

Error StreamReader::broken_header() const {
  return at(fmt::format("a broken header; it must read: {} 1 <key name>{}", kind_.word, kind_.fields));
}

Error StreamReader::wrong_end(std::uint64_t count) const {
  return at(fmt::format("the last line must read: end {}", count));
}

Result<bool> StreamReader::next(std::string_view& line, std::uint64_t count) {
  if (ended_) return false;
  const auto more = lines_.next(line);
  if (!more) return more;
  if (!*more) return at("the file ends here without its last line, end <count>; it was not written whole");
  if (!line.starts_with("end ")) return true;
  if (to_number(line.substr(4), UINT64_MAX) != count) return wrong_end(count);
  const auto after = lines_.next(line);
  if (!after) return after;
  if (*after) return at("something follows the line end <count>");
  ended_ = true;
  return false;
}

}  // namespace halfway
