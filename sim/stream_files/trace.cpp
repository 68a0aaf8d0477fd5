// SPDX-License-Identifier: Apache-2.0
#include "sim/stream_files/trace.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>

#include "sim/stream_files/text_fields.hpp"

namespace halfway {
namespace {

constexpr std::string_view c_trace_magic = "halfway-trace";
constexpr std::size_t c_longest_line = 256;
constexpr std::size_t c_longest_fragment = 10 + 2 * 5 + 10 + 3 * 3 + 7;

constexpr std::array<std::uint64_t, 7> c_largest = {0xffffffff, 0xfff, 0xfff, 0xffffff, 0xff, 0xff, 0xff};
constexpr std::array<std::string_view, 7> c_names = {"triangle", "y", "x", "z", "red", "green", "blue"};

}  // namespace

Result<TraceWriter> TraceWriter::open(const std::filesystem::path& path, std::string_view key_name) {
  auto writer = LineWriter::open(path);
  if (!writer) return writer.error();
  writer->append(fmt::format("{} 1 {}\n", c_trace_magic, key_name));
  return TraceWriter(std::move(*writer));
}

void TraceWriter::write(std::span<const Fragment> fragments) {
  for (const Fragment& f : fragments) {
    char* to = writer_.reserve(c_longest_fragment);
    char* const end = to + c_longest_fragment;
    for (const std::uint32_t value : {f.triangle, std::uint32_t{f.y}, std::uint32_t{f.x}, f.z,
                                      std::uint32_t{f.red}, std::uint32_t{f.green}, std::uint32_t{f.blue}}) {
      to = std::to_chars(to, end, value).ptr;
      *to++ = ' ';
    }
    to[-1] = '\n';
    writer_.advance(to);
  }
  count_ += fragments.size();
}

Status TraceWriter::commit(std::optional<std::uint64_t> cycles) {
  if (cycles) writer_.append(fmt::format("cycles {}\n", *cycles));
  writer_.append(fmt::format("end {}\n", count_));
  return writer_.commit();
}

Result<TraceReader> TraceReader::open(const std::filesystem::path& path, std::string_view key_name) {
  auto reader = LineReader::open(path, c_longest_line);
  if (!reader) return reader.error();
  std::string_view line;
  switch (reader->next(line)) {
    case LineReader::Next::failed:
      return reader->error();
    case LineReader::Next::end_of_file:
      return bad_input(fmt::format("{}:1: the file is empty; run the simulation again", path.string()));
    case LineReader::Next::line:
      break;
  }
  const bool spaced = ends_in_space(line);
  if (take_field(line) != c_trace_magic)
    return reader->at("no trace; the first line must begin with halfway-trace");
  if (take_field(line) != "1") return reader->at("a trace of another version; run the simulation again");
  const std::string found_key(take_field(line));
  if (found_key.empty() || !line.empty() || spaced) {
    return reader->at("a broken header; it must read: halfway-trace 1 <key name>");
  }
  if (!key_name.empty() && found_key != key_name) {
    return reader->at(fmt::format("the trace of the hardware {}, wanted is {}", found_key, key_name));
  }
  return TraceReader(std::move(*reader), found_key);
}

Status TraceReader::read_trailer(std::string_view line) {
  if (line.substr(0, 7) == "cycles ") {
    cycles_ = to_number(line.substr(7), UINT64_MAX);
    if (!cycles_) return reader_.at("a broken line; it must read: cycles <n>");
    switch (reader_.next(line)) {
      case LineReader::Next::failed:
        return reader_.error();
      case LineReader::Next::end_of_file:
        return reader_.at("the trace ends here without its last line, end <count>; it was not written whole");
      case LineReader::Next::line:
        break;
    }
  }
  if (line.substr(0, 4) != "end " || to_number(line.substr(4), UINT64_MAX) != count_) {
    return reader_.at(fmt::format("the last line must read: end {}", count_));
  }
  ended_ = true;
  switch (reader_.next(line)) {
    case LineReader::Next::failed:
      return reader_.error();
    case LineReader::Next::line:
      return reader_.at("something follows the line end <count>");
    case LineReader::Next::end_of_file:
      return Ok{};
  }
  return Ok{};
}

Result<std::size_t> TraceReader::read(std::vector<Fragment>& fragments, std::size_t limit) {
  std::size_t got = 0;
  std::string_view line;
  while (got < limit && !ended_) {
    switch (reader_.next(line)) {
      case LineReader::Next::failed:
        return reader_.error();
      case LineReader::Next::end_of_file:
        return reader_.at("the trace ends here without its last line, end <count>; it was not written whole");
      case LineReader::Next::line:
        break;
    }
    if (!line.empty() && (line.front() == 'c' || line.front() == 'e')) {
      if (auto trailer = read_trailer(line); !trailer) return trailer.error();
      break;
    }
    if (ends_in_space(line)) return reader_.at("a space at the line's end");
    std::array<std::uint32_t, 7> values{};
    for (std::size_t i = 0; i < values.size(); ++i) {
      const auto value = to_number(take_field(line), c_largest[i]);
      if (!value)
        return reader_.at(fmt::format("{} must be a number from 0 to {}", c_names[i], c_largest[i]));
      values[i] = static_cast<std::uint32_t>(*value);
    }
    if (!line.empty()) return reader_.at("more than seven fields");
    fragments.push_back({.triangle = values[0],
                         .z = values[3],
                         .y = static_cast<std::uint16_t>(values[1]),
                         .x = static_cast<std::uint16_t>(values[2]),
                         .red = static_cast<std::uint8_t>(values[4]),
                         .green = static_cast<std::uint8_t>(values[5]),
                         .blue = static_cast<std::uint8_t>(values[6])});
    ++got;
    ++count_;
  }
  return got;
}

Status write_trace(const std::filesystem::path& path, std::string_view key_name, const Trace& trace) {
  auto writer = TraceWriter::open(path, key_name);
  if (!writer) return writer.error();
  writer->write(trace.fragments);
  return writer->commit(trace.cycles);
}

Result<Trace> read_trace(const std::filesystem::path& path, std::string_view key_name) {
  auto reader = TraceReader::open(path, key_name);
  if (!reader) return reader.error();
  Trace trace;
  while (true) {
    const auto got = reader->read(trace.fragments, 1U << 20);
    if (!got) return got.error();
    if (*got == 0) {
      trace.cycles = reader->cycles();
      return trace;
    }
  }
}

}  // namespace halfway
