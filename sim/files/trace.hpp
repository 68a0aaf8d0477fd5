// SPDX-License-Identifier: Apache-2.0
// A trace: the fragments in the order of their output, as a text file that diff can compare.
//   halfway-trace 1 <key name>
//   <triangle> <y> <x> <z> <red> <green> <blue>      one fragment per line, decimal
//   cycles <n>                                       only if a simulator wrote the trace
//   end <count>
// Cycles count from the rising edge that takes the first init vector to the edge that moves the last vector
// or fragment, both included; without a vector the count is 0. A file without its last line is incomplete.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/result.hpp"
#include "frame/fragment.hpp"
#include "sim/files/stream_reader.hpp"
#include "sim/os/file.hpp"

namespace halfway {

struct Trace {
  std::vector<Fragment> fragments;
  std::optional<std::uint64_t> cycles;
};

class TraceWriter {
 public:
  static Result<TraceWriter> open(const std::filesystem::path& path, std::string_view key_name);
  void write(std::span<const Fragment> fragments);
  /// Write the last line and rename the file to its final name. Returns the first error of any write.
  Status commit(std::optional<std::uint64_t> cycles = std::nullopt);

 private:
  explicit TraceWriter(LineWriter writer) : writer_(std::move(writer)) {}
  LineWriter writer_;
  std::uint64_t count_ = 0;
};

class TraceReader {
 public:
  /// Read the header. A trace of another hardware key is an error. An empty `key_name` accepts any key.
  static Result<TraceReader> open(const std::filesystem::path& path, std::string_view key_name);
  const std::string& key_name() const { return reader_.key_name(); }
  /// Append up to `limit` fragments and return their number. 0: end of a complete file.
  Result<std::size_t> read(std::vector<Fragment>& fragments, std::size_t limit);
  /// Known after `read` has returned 0.
  std::optional<std::uint64_t> cycles() const { return cycles_; }

 private:
  explicit TraceReader(StreamReader reader) : reader_(std::move(reader)) {}
  StreamReader reader_;
  std::optional<std::uint64_t> cycles_;
  std::uint64_t count_ = 0;
};

/// Gives the fragments of a trace, at most `most` with each call, none at its end. The file is opened with
/// the first call.
std::function<Result<std::span<const Fragment>>(std::size_t most)> stored_fragments(
    const std::filesystem::path& path);

/// Gives the fragments of both traces to `each`, chunk by chunk, to the ends of both.
Status read_side_by_side(
    TraceReader& golden, TraceReader& rtl,
    const std::function<void(std::span<const Fragment> golden, std::span<const Fragment> rtl)>& each);

Status write_trace(const std::filesystem::path& path, std::string_view key_name, const Trace& trace);
Result<Trace> read_trace(const std::filesystem::path& path, std::string_view key_name);

}  // namespace halfway
