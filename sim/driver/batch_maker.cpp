// SPDX-License-Identifier: Apache-2.0
#include "sim/driver/batch_maker.hpp"

#include <algorithm>
#include <span>
#include <utility>

namespace halfway {
namespace {

constexpr std::uint32_t c_least_batch = 8, c_first_batch = 64, c_largest_batch = 8192;  // triangles
constexpr std::uint32_t c_least_strips = 1, c_first_strips = 32;
constexpr std::uint32_t c_most_chunk = 256;                  // units
constexpr std::size_t c_batch_bytes = std::size_t{8} << 20;  // approximate size of a batch

std::size_t bytes(const Batch& batch) {
  return batch.init_words.size() * sizeof(batch.init_words[0]) +
         batch.golden.size() * sizeof(batch.golden[0]);
}

template <class Element>
void append(std::vector<Element>& to, const std::vector<Element>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

}  // namespace

BatchMaker::BatchMaker(const Setup& setup, MakeGolden golden, unsigned threads, const Clocks& clocks)
    : setup_(setup),
      make_golden_(std::move(golden)),
      threads_(std::max(1U, threads)),
      clocks_(clocks),
      // Without fragments a batch is small enough, and one thread discards nothing when a batch ends early:
      // start with the largest number of units.
      batch_units_(!make_golden_ || threads_ == 1 ? c_largest_batch
                   : setup.units_are_strips()     ? c_first_strips
                                                  : c_first_batch) {
  setup_.append_prologue(prologue_, counts_);
}

bool BatchMaker::begin(Batch room) {
  begin_ = next_unit_;
  end_ = std::min(setup_.units(), begin_ + batch_units_);
  if (begin_ >= end_) return false;
  // Chunks are small enough for all threads to get some, and for a batch to end early.
  chunk_units_ = std::clamp((end_ - begin_) / (4 * threads_), 1U, c_most_chunk);
  chunks_ = (end_ - begin_ + chunk_units_ - 1) / chunk_units_;
  parts_ = std::vector<Part>(threads_ == 1 ? 1 : chunks_);
  room.init_words.clear();
  room.golden.clear();
  parts_[0].batch = std::move(room);
  taken_ = held_ = 0;
  full_ = false;
  return true;
}

void BatchMaker::work() {
  if (full_ || taken_ >= chunks_) return;
  const std::unique_ptr<GoldenModel> golden = make_golden_ ? make_golden_() : nullptr;
  if (golden) golden->draw(prologue_);
  const std::unique_ptr<SetupWorker> setup = setup_.worker();
  while (!full_) {
    const std::size_t chunk = taken_++;
    if (chunk >= chunks_) return;
    make(parts_[threads_ == 1 ? 0 : chunk], chunk, *setup, golden.get());
  }
}

void BatchMaker::make(Part& part, std::size_t chunk, SetupWorker& setup, GoldenModel* golden) {
  std::vector<std::uint32_t>& words = part.batch.init_words;
  const std::size_t before = bytes(part.batch);
  const auto first = static_cast<std::uint32_t>(begin_ + chunk * chunk_units_);
  const std::uint32_t last = std::min(end_, first + chunk_units_);
  const double setup_start = clocks_.processor();
  if (first == 0) words = prologue_;
  const std::size_t drawn = words.size();
  std::size_t holds = held_;
  for (part.end = first; part.end < last && holds <= c_batch_bytes; ++part.end) {
    const std::size_t begins = words.size();
    setup.append(part.end, words, part.counts);
    const auto of_unit = std::span<const std::uint32_t>(words).subspan(begins);
    holds += of_unit.size_bytes();
    if (golden) holds += static_cast<std::size_t>(golden->all_pixels(of_unit)) * sizeof(Fragment);
  }
  const double golden_start = clocks_.processor();
  part.setup_seconds += golden_start - setup_start;
  if (golden) {
    golden->draw(std::span<const std::uint32_t>(words).subspan(drawn), part.batch.golden);
    part.fault = golden->fault();
    part.golden_seconds += clocks_.processor() - golden_start;
  }
  const std::size_t own = bytes(part.batch) - before;
  if ((held_ += own) > c_batch_bytes || part.end < last) full_ = true;
}

Batch BatchMaker::end() {
  // A part that ended early is the last one. Discard the parts after it; they will be made again.
  Part& all = parts_[0];
  std::size_t joined = 1, words = all.batch.init_words.size(), fragments = all.batch.golden.size();
  for (; joined < parts_.size() && all.end == begin_ + joined * chunk_units_; ++joined) {
    if (parts_[joined].end == 0) break;
    all.end = parts_[joined].end;
    words += parts_[joined].batch.init_words.size();
    fragments += parts_[joined].batch.golden.size();
  }
  all.batch.init_words.reserve(words);
  all.batch.golden.reserve(fragments);
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    Part& part = parts_[i];
    setup_seconds_ += part.setup_seconds;
    golden_seconds_ += part.golden_seconds;
    if (i >= joined) continue;
    counts_ += part.counts;
    fault_ = fault_ || part.fault;
    if (i == 0) continue;
    append(all.batch.init_words, part.batch.init_words);
    append(all.batch.golden, part.batch.golden);
    part.batch = {};
  }
  next_unit_ = all.end;
  if (bytes(all.batch) > c_batch_bytes)
    batch_units_ = std::max(setup_.units_are_strips() ? c_least_strips : c_least_batch, batch_units_ / 2);
  else if (bytes(all.batch) < c_batch_bytes / 4)
    batch_units_ = std::min(c_largest_batch, batch_units_ * 4);
  all.batch.done = static_cast<double>(all.end) / setup_.units();
  return std::move(all.batch);
}

}  // namespace halfway
