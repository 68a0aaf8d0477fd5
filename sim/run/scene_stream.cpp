// SPDX-License-Identifier: Apache-2.0
#include "sim/run/scene_stream.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <mutex>
#include <optional>
#include <span>

#include "golden_run/golden_run.hpp"
#include "sim/generator/word_lengths/made_formats.hpp"
#include "sim/os/seconds.hpp"
#include "sim/os/threads.hpp"

namespace halfway {
namespace {

constexpr std::uint32_t c_least_batch = 8, c_first_batch = 64, c_largest_batch = 8192;  // triangles
constexpr std::uint32_t c_least_lines = 1, c_first_lines = 32;
constexpr std::uint32_t c_most_chunk = 256;                  // units
constexpr std::size_t c_batch_bytes = std::size_t{8} << 20;  // approximate size of a batch

std::size_t bytes(const Batch& batch) {
  return batch.init_words.size() * sizeof(batch.init_words[0]) +
         batch.golden.size() * sizeof(batch.golden[0]);
}

}  // namespace

SceneStream::SceneStream(const Setup& setup, const HardwareKey& key, unsigned threads,
                         const SceneStreamOptions& options)
    : setup_(setup),
      key_(key),
      threads_(std::max(1U, threads)),
      options_(options),
      // Without fragments a batch is small enough, so start with the largest number of units.
      batch_units_(!options.golden           ? c_largest_batch
                   : setup.units_are_lines() ? c_first_lines
                                             : c_first_batch) {
  setup_.append_prologue(prologue_, counts_);
  prefetch({});
}

SceneStream::~SceneStream() {
  if (options_.ahead && ahead_.valid()) ahead_.wait();
}

void SceneStream::prefetch(Batch room) {
  const std::uint32_t total = setup_.units();
  if (next_unit_ >= total) return;
  const std::uint32_t begin = next_unit_, end = std::min(total, begin + batch_units_);
  ahead_ = std::async(
      options_.ahead ? std::launch::async : std::launch::deferred,
      [this, begin, end, room = std::move(room)]() mutable { return make(begin, end, std::move(room)); });
}

bool SceneStream::next(Batch& batch) {
  if (!ahead_.valid()) {
    batch = {};
    return false;
  }
  Work work = ahead_.get();
  next_unit_ = work.end;
  if (bytes(work.batch) > c_batch_bytes)
    batch_units_ = std::max(setup_.units_are_lines() ? c_least_lines : c_least_batch, batch_units_ / 2);
  else if (bytes(work.batch) < c_batch_bytes / 4)
    batch_units_ = std::min(c_largest_batch, batch_units_ * 4);
  prefetch(std::move(batch));
  counts_ += work.counts;
  fault_ = fault_ || work.fault;
  setup_seconds_ += work.setup_seconds;
  golden_seconds_ += work.golden_seconds;
  batch = std::move(work.batch);
  return true;
}

SceneStream::Work SceneStream::make(std::uint32_t begin, std::uint32_t end, Batch room) const {
  // Chunks are small enough for all threads to get some, and for a batch to end early.
  const std::uint32_t chunk_units = std::clamp((end - begin) / (4 * threads_), 1U, c_most_chunk);
  const std::size_t chunks = (end - begin + chunk_units - 1) / chunk_units;
  const bool alone = threads_ == 1;  // one thread has a single part
  std::vector<Work> parts(alone ? 1 : chunks);
  room.init_words.clear();
  room.golden.clear();
  parts[0].batch = std::move(room);
  std::mutex mutex;
  std::size_t taken = 0, held = 0;
  bool full = false;
  struct Chunk {
    std::size_t number, held;
  };
  // Returns std::nullopt after the last chunk, or if the batch is large enough.
  const auto take = [&]() -> std::optional<Chunk> {
    const std::scoped_lock lock(mutex);
    if (taken == chunks || full) return std::nullopt;
    return Chunk{taken++, held};
  };
  const auto work = [&] {
    const std::unique_ptr<GoldenModel> golden =
        options_.golden ? make_golden_model(key_, options_.formats) : nullptr;
    const std::unique_ptr<SetupWorker> setup = setup_.worker();
    std::vector<Fragment> none;
    if (golden) golden->draw(prologue_, none);
    while (const auto chunk = take()) {
      Work& part = parts[alone ? 0 : chunk->number];
      const std::size_t before = bytes(part.batch);
      const auto first = static_cast<std::uint32_t>(begin + chunk->number * chunk_units);
      const std::uint32_t last = std::min(end, first + chunk_units);
      const double setup_start = thread_seconds();
      if (first == 0) part.batch.init_words = prologue_;
      const std::size_t drawn = part.batch.init_words.size();
      std::size_t holds = chunk->held;
      for (part.end = first; part.end < last && holds <= c_batch_bytes; ++part.end) {
        const std::size_t begins = part.batch.init_words.size();
        setup->append(part.end, part.batch.init_words, part.counts);
        const auto words = std::span(part.batch.init_words).subspan(begins);
        holds += words.size_bytes();
        if (golden) holds += static_cast<std::size_t>(golden->all_pixels(words)) * sizeof(Fragment);
      }
      const double golden_start = thread_seconds();
      part.setup_seconds += golden_start - setup_start;
      if (golden) {
        golden->draw(std::span(part.batch.init_words).subspan(drawn), part.batch.golden);
        part.fault = golden->fault();
        part.golden_seconds += thread_seconds() - golden_start;
      }
      const std::scoped_lock lock(mutex);
      held += bytes(part.batch) - before;
      full = full || held > c_batch_bytes || part.end < last;
    }
  };
  work_on_threads(static_cast<unsigned>(std::min<std::size_t>(threads_, chunks)), work);
  Work all = std::move(parts[0]);
  // A part that ended early is the last one. Discard the parts after it; they will be made again.
  std::size_t joined = 1, words = 0, fragments = 0;
  for (; joined < parts.size() && all.end == begin + joined * chunk_units; ++joined) {
    if (parts[joined].end == 0) break;
    all.end = parts[joined].end;
    words += parts[joined].batch.init_words.size();
    fragments += parts[joined].batch.golden.size();
  }
  all.batch.init_words.reserve(all.batch.init_words.size() + words);
  all.batch.golden.reserve(all.batch.golden.size() + fragments);
  for (std::size_t i = 1; i < parts.size(); ++i) {
    Work& part = parts[i];
    all.setup_seconds += part.setup_seconds;
    all.golden_seconds += part.golden_seconds;
    if (i < joined) {
      all.batch.init_words.insert(all.batch.init_words.end(), part.batch.init_words.begin(),
                                  part.batch.init_words.end());
      all.batch.golden.insert(all.batch.golden.end(), part.batch.golden.begin(), part.batch.golden.end());
      all.fault = all.fault || part.fault;
      all.counts += part.counts;
    }
    part.batch = {};
  }
  all.batch.done = static_cast<double>(all.end) / setup_.units();
  return all;
}

}  // namespace halfway
