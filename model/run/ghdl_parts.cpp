// SPDX-License-Identifier: Apache-2.0
#include "run/ghdl_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <mutex>
#include <numeric>

#include "common/file.hpp"
#include "common/seconds.hpp"
#include "common/threads.hpp"
#include "frame/init_file.hpp"
#include "frame/trace.hpp"

namespace halfway {
namespace {

constexpr std::uint64_t c_part_fragments = 8192, c_most_parts = 16;
constexpr std::uint64_t c_between_places = 16;  // vectors
constexpr std::size_t c_block = 4096;           // vectors or fragments at a time

Status split(const std::filesystem::path& init_file, const std::string& key_name,
             std::span<const std::uint64_t> first_vectors,
             const std::vector<std::filesystem::path>& part_files) {
  auto reader = InitFileReader::open(init_file, key_name);
  if (!reader) return reader.error();
  std::uint64_t at = 0;
  for (std::size_t part = 0; part < part_files.size(); ++part) {
    const std::uint64_t end =
        part + 1 < first_vectors.size() ? first_vectors[part + 1] : std::numeric_limits<std::uint64_t>::max();
    auto writer = InitFileWriter::open(part_files[part], key_name, reader->bits());
    if (!writer) return writer.error();
    while (at < end) {
      std::vector<std::uint32_t> words;
      const auto count = reader->read(words, std::min<std::uint64_t>(c_block, end - at));
      if (!count) return count.error();
      if (*count == 0) break;
      writer->write(words);
      at += *count;
    }
    if (Status status = writer->commit(); !status) return status;
  }
  return Ok{};
}

Status join(const std::vector<std::filesystem::path>& part_files, const std::string& key_name,
            const std::filesystem::path& trace_file, std::uint64_t cycles) {
  auto writer = TraceWriter::open(trace_file, key_name);
  if (!writer) return writer.error();
  for (const std::filesystem::path& file : part_files) {
    auto reader = TraceReader::open(file, key_name);
    if (!reader) return reader.error();
    while (true) {
      std::vector<Fragment> fragments;
      const auto count = reader->read(fragments, c_block);
      if (!count) return count.error();
      if (*count == 0) break;
      writer->write(fragments);
    }
  }
  return writer->commit(cycles);
}

}  // namespace

Cuts::Cuts(const HardwareKey& key)
    : golden_(key.shader == Shader::processors ? nullptr : make_golden_model(key)) {}

void Cuts::add(std::span<const std::uint32_t> init_words) {
  if (!golden_) return;
  const std::size_t words_per_vector = (golden_->init_bits() + 31) / 32;
  while (!init_words.empty()) {
    if (vectors_ >= places_.back() + c_between_places) places_.push_back(vectors_);
    const std::size_t group = golden_->group(init_words);
    init_words = init_words.subspan(std::min(init_words.size(), group * words_per_vector));
    vectors_ += group;
  }
}

std::vector<std::uint64_t> Cuts::parts(std::uint64_t fragments) const {
  const std::uint64_t wanted =
      std::clamp<std::uint64_t>(fragments / c_part_fragments, 1, std::min(c_most_parts, places_.size()));
  std::vector<std::uint64_t> firsts;
  for (std::uint64_t part = 0; part < wanted; ++part)
    firsts.push_back(places_[static_cast<std::size_t>(part * places_.size() / wanted)]);
  return firsts;
}

Result<GhdlRun> run_in_parts(const GhdlRunner& runner, const HardwareKey& key,
                             const std::filesystem::path& init_file,
                             std::span<const std::uint64_t> first_vectors,
                             const std::filesystem::path& trace_file, const GhdlRunOptions& options,
                             unsigned threads) {
  const std::size_t parts = first_vectors.size();
  if (parts < 2) return runner.run(init_file, trace_file, options);
  const auto start = std::chrono::steady_clock::now();
  const auto scratch = TemporaryFolder::make(std::filesystem::absolute(trace_file).parent_path());
  if (!scratch) return scratch.error();
  std::vector<std::filesystem::path> inits, traces;
  for (std::size_t part = 0; part < parts; ++part) {
    inits.push_back(scratch->path() / fmt::format("init-{}", part));
    traces.push_back(scratch->path() / fmt::format("trace-{}", part));
  }
  if (Status status = split(init_file, key.name(), first_vectors, inits); !status) return status.error();

  std::mutex mutex;
  std::vector<std::uintmax_t> bytes(parts, 0);
  GhdlRun sum;
  Status all = for_each_on_threads(threads, parts, [&](std::size_t part) -> Status {
    GhdlRunOptions of_part = options;
    if (options.on_progress)
      of_part.on_progress = [&, part](std::uintmax_t written) {
        const std::scoped_lock lock(mutex);
        bytes[part] = written;
        options.on_progress(std::accumulate(bytes.begin(), bytes.end(), std::uintmax_t{0}));
      };
    const auto run = runner.run(inits[part], traces[part], of_part);
    if (!run)
      return Error{run.error().code, fmt::format("{}, in part {} of {}, from init vector {} on",
                                                 run.error().message, part + 1, parts, first_vectors[part])};
    const std::scoped_lock lock(mutex);
    sum.fragments += run->fragments;
    sum.cycles += run->cycles;
    return Ok{};
  });
  if (!all) return all.error();
  if (Status status = join(traces, key.name(), trace_file, sum.cycles); !status) return status.error();
  sum.seconds = seconds_since(start);
  return sum;
}

}  // namespace halfway
