// SPDX-License-Identifier: Apache-2.0
#include "sim/files/trace.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <memory>
#include <utility>

namespace halfway {
namespace {

constexpr StreamReader::Kind c_trace{"halfway-trace", "a trace", "run the simulation again", ""};
constexpr std::size_t c_longest_line = 256;
constexpr std::size_t c_longest_fragment = 10 + 2 * 5 + 10 + 3 * 3 + 7;

constexpr std::array<std::uint64_t, 7> c_largest = {0xffffffff, 0xfff, 0xfff, 0xffffff, 0xff, 0xff, 0xff};
constexpr std::array<std::string_view, 7> c_names = {"triangle", "y", "x", "z", "red", "green", "blue"};

}  // namespace

Result<TraceWriter> TraceWriter::open(const std::filesystem::path& path, std::string_view key_name) {
  auto writer = LineWriter::open(path);
  if (!writer) return writer.error();
  writer->append(fmt::format("{} 1 {}\n", c_trace.word, key_name));
  return TraceWriter(std::move(*writer));
}

void TraceWriter::write(std::span<const Fragment> fragments) {
  std::array<char, c_longest_fragment> line;
  for (const Fragment& f : fragments) {
    char* to = line.data();
    for (const std::uint32_t value : {f.triangle, std::uint32_t{f.y}, std::uint32_t{f.x}, f.z,
                                      std::uint32_t{f.red}, std::uint32_t{f.green}, std::uint32_t{f.blue}}) {
      to = std::to_chars(to, line.end(), value).ptr;
      *to++ = ' ';
    }
    to[-1] = '\n';
    writer_.append({line.data(), to});
  }
  count_ += fragments.size();
}

Status TraceWriter::commit(std::optional<std::uint64_t> cycles) {
  if (cycles) writer_.append(fmt::format("cycles {}\n", *cycles));
  writer_.append(fmt::format("end {}\n", count_));
  return writer_.commit();
}

Result<TraceReader> TraceReader::open(const std::filesystem::path& path, std::string_view key_name) {
  auto reader = StreamReader::open(path, c_trace, key_name, c_longest_line);
  if (!reader) return reader.error();
  return TraceReader(std::move(*reader));
}

Result<std::size_t> TraceReader::read(std::vector<Fragment>& fragments, std::size_t limit) {
  std::size_t got = 0;
  for (std::string_view line; got < limit;) {
    const auto more = reader_.next(line, count_);
    if (!more) return more.error();
    if (!*more) break;
    if (cycles_) return reader_.wrong_end(count_);
    if (line.starts_with("cycles ")) {
      cycles_ = to_number(line.substr(7), UINT64_MAX);
      if (!cycles_) return reader_.at("a broken line; it must read: cycles <n>");
      continue;
    }
    if (line.ends_with(' ')) return reader_.at("a space at the line's end");
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

std::function<Result<std::span<const Fragment>>(std::size_t most)> stored_fragments(
    const std::filesystem::path& path) {
  return [path, trace = std::shared_ptr<TraceReader>(),
          read = std::vector<Fragment>()](std::size_t most) mutable -> Result<std::span<const Fragment>> {
    if (!trace) {
      auto opened = TraceReader::open(path, "");
      if (!opened) return opened.error();
      trace = std::make_shared<TraceReader>(std::move(*opened));
    }
    read.clear();
    if (const auto count = trace->read(read, most); !count) return count.error();
    return std::span<const Fragment>(read);
  };
}

Status read_side_by_side(
    TraceReader& golden, TraceReader& rtl,
    const std::function<void(std::span<const Fragment> golden, std::span<const Fragment> rtl)>& each) {
  constexpr std::size_t c_chunk = 1 << 16;  // fragments
  std::vector<Fragment> of_golden, of_rtl;
  do {
    of_golden.clear();
    of_rtl.clear();
    if (const auto count = golden.read(of_golden, c_chunk); !count) return count.error();
    if (const auto count = rtl.read(of_rtl, c_chunk); !count) return count.error();
    each(of_golden, of_rtl);
  } while (!of_golden.empty() || !of_rtl.empty());
  return Ok{};
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
