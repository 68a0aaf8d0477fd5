// SPDX-License-Identifier: Apache-2.0
#include "sim/run/ghdl_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <mutex>
#include <numeric>
#include <optional>
#include <utility>

#include "sim/stream_files/init_file.hpp"
#include "sim/stream_files/trace.hpp"
#include "sim/system/file.hpp"
#include "sim/system/seconds.hpp"
#include "sim/system/threads.hpp"

namespace halfway {
namespace {

// A part's clocks: this share of all that is left, so more than eight cores gain nothing, but not so few that
// GHDL's start counts.
constexpr std::uint64_t c_share = 8, c_least_part = 2048;
constexpr std::uint64_t c_between_places = 256;  // clocks
constexpr std::size_t c_block = 4096;            // vectors or fragments at a time

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

Status read_trace_of(const std::filesystem::path& file, const std::string& key_name, const OnJoined& sink) {
  auto reader = TraceReader::open(file, key_name);
  if (!reader) return reader.error();
  for (std::vector<Fragment> fragments;; fragments.clear()) {
    const auto count = reader->read(fragments, c_block);
    if (!count) return count.error();
    if (*count == 0) return Ok{};
    if (Status status = sink(fragments); !status) return status;
  }
}

// Puts the traces of parts together in order while others are drawn.
class Joiner {
 public:
  Joiner(TraceWriter writer, std::string key_name, const std::vector<std::filesystem::path>& part_files,
         const OnJoined& on_joined)
      : writer_(std::move(writer)),
        key_name_(std::move(key_name)),
        part_files_(part_files),
        on_joined_(on_joined),
        ended_(part_files.size(), false) {}

  /// A part has ended: it is joined, and those that waited for it, unless another thread is at that.
  Status add(std::size_t part) {
    {
      const std::scoped_lock lock(mutex_);
      ended_[part] = true;
      if (busy_) return Ok{};
      busy_ = true;
    }
    while (const auto next = take()) {
      const Status joined =
          read_trace_of(part_files_[*next], key_name_, [&](std::span<const Fragment> fragments) -> Status {
            writer_.write(fragments);
            return on_joined_ ? on_joined_(fragments) : Status(Ok{});
          });
      if (!joined) return joined;  // still busy: nobody goes on
    }
    return Ok{};
  }
  Status commit(std::uint64_t cycles) { return writer_.commit(cycles); }

 private:
  std::optional<std::size_t> take() {
    const std::scoped_lock lock(mutex_);
    busy_ = next_ < ended_.size() && ended_[next_];
    return busy_ ? std::optional(next_++) : std::nullopt;
  }

  TraceWriter writer_;
  std::string key_name_;
  const std::vector<std::filesystem::path>& part_files_;
  const OnJoined& on_joined_;
  std::mutex mutex_;
  std::vector<bool> ended_;
  std::size_t next_ = 0;
  bool busy_ = false;
};

}  // namespace

Cuts::Cuts(const HardwareKey& key)
    : golden_(key.shader == Shader::processors ? nullptr : make_golden_model(key)) {}

void Cuts::add(std::span<const std::uint32_t> init_words) {
  if (!golden_) return;
  const std::size_t words_per_vector = (golden_->init_bits() + 31) / 32;
  while (!init_words.empty()) {
    if (end_.clocks >= places_.back().clocks + c_between_places) places_.push_back(end_);
    const std::size_t group = golden_->group(init_words);
    end_.vectors += group;
    end_.clocks += golden_->pixels(init_words) + group;
    init_words = init_words.subspan(std::min(init_words.size(), group * words_per_vector));
  }
}

std::vector<std::uint64_t> Cuts::parts() const {
  std::vector<std::uint64_t> firsts{0};
  for (Place part{0, 0};;) {
    const std::uint64_t wanted = std::max(c_least_part, (end_.clocks - part.clocks) / c_share);
    const auto next = std::ranges::lower_bound(places_, part.clocks + wanted, {}, &Place::clocks);
    if (next == places_.end() || end_.clocks - next->clocks < c_least_part / 2) return firsts;
    part = *next;
    firsts.push_back(part.vectors);
  }
}

Result<GhdlRun> run_in_parts(const GhdlRunner& runner, const HardwareKey& key,
                             const std::filesystem::path& init_file,
                             std::span<const std::uint64_t> first_vectors,
                             const std::filesystem::path& trace_file, const GhdlRunOptions& options,
                             unsigned threads, const OnJoined& on_joined) {
  const std::size_t parts = first_vectors.size();
  if (parts < 2) {
    auto run = runner.run(init_file, trace_file, options);
    if (run && on_joined)
      if (Status status = read_trace_of(trace_file, key.name(), on_joined); !status) return status.error();
    return run;
  }
  const auto start = std::chrono::steady_clock::now();
  const auto scratch = TemporaryFolder::make(std::filesystem::absolute(trace_file).parent_path());
  if (!scratch) return scratch.error();
  std::vector<std::filesystem::path> inits, traces;
  for (std::size_t part = 0; part < parts; ++part) {
    inits.push_back(scratch->path() / fmt::format("init-{}", part));
    traces.push_back(scratch->path() / fmt::format("trace-{}", part));
  }
  if (Status status = split(init_file, key.name(), first_vectors, inits); !status) return status.error();

  auto writer = TraceWriter::open(trace_file, key.name());
  if (!writer) return writer.error();
  Joiner joiner(std::move(*writer), key.name(), traces, on_joined);
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
    {
      const std::scoped_lock lock(mutex);
      sum.fragments += run->fragments;
      sum.cycles += run->cycles;
    }
    return joiner.add(part);
  });
  if (!all) return all.error();
  if (Status status = joiner.commit(sum.cycles); !status) return status.error();
  sum.seconds = seconds_since(start);
  return sum;
}

}  // namespace halfway
