// SPDX-License-Identifier: Apache-2.0
#include "run/scene_stream.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>

#include "run/golden_run.hpp"

namespace halfway {
namespace {

constexpr std::uint32_t c_batch_triangles = 8192;
constexpr std::uint32_t c_chunk_triangles = 256;

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

SceneStream::SceneStream(const Scene& scene, const QuadraticSetup& setup, const HardwareKey& key,
                         unsigned threads)
    : scene_(scene), setup_(setup), key_(key), threads_(std::max(1U, threads)) {
  prefetch();
}

SceneStream::~SceneStream() {
  if (ahead_.valid()) ahead_.wait();
}

void SceneStream::prefetch() {
  const auto total = static_cast<std::uint32_t>(scene_.triangles.size());
  if (next_triangle_ >= total) return;
  const std::uint32_t begin = next_triangle_, end = std::min(total, begin + c_batch_triangles);
  next_triangle_ = end;
  ahead_ = std::async(std::launch::async, [this, begin, end] { return make(begin, end); });
}

bool SceneStream::next(Batch& batch) {
  if (!ahead_.valid()) return false;
  Work work = ahead_.get();
  prefetch();
  counts_ += work.counts;
  setup_seconds_ += work.setup_seconds;
  golden_seconds_ += work.golden_seconds;
  batch = std::move(work.batch);
  return true;
}

SceneStream::Work SceneStream::make(std::uint32_t begin, std::uint32_t end) const {
  const std::size_t chunks = (end - begin + c_chunk_triangles - 1) / c_chunk_triangles;
  std::vector<Work> parts(chunks);
  std::atomic<std::size_t> next_chunk = 0;
  const auto work = [&] {
    const std::unique_ptr<GoldenModel> golden = make_golden_model(key_);
    for (std::size_t i = next_chunk++; i < chunks; i = next_chunk++) {
      Work& part = parts[i];
      const auto first = static_cast<std::uint32_t>(begin + i * c_chunk_triangles);
      const auto setup_start = std::chrono::steady_clock::now();
      for (std::uint32_t t = first; t < std::min(end, first + c_chunk_triangles); ++t)
        setup_.append(t, part.batch.init_words, part.counts);
      part.setup_seconds = seconds_since(setup_start);
      const auto golden_start = std::chrono::steady_clock::now();
      golden->draw(part.batch.init_words, part.batch.golden);
      part.golden_seconds = seconds_since(golden_start);
    }
  };
  {
    std::vector<std::jthread> pool;
    for (unsigned i = 1; i < std::min<std::size_t>(threads_, chunks); ++i) pool.emplace_back(work);
    work();
  }
  Work all = std::move(parts[0]);
  for (std::size_t i = 1; i < chunks; ++i) {
    Work& part = parts[i];
    all.batch.init_words.insert(all.batch.init_words.end(), part.batch.init_words.begin(),
                                part.batch.init_words.end());
    all.batch.golden.insert(all.batch.golden.end(), part.batch.golden.begin(), part.batch.golden.end());
    part.batch = {};
    all.counts += part.counts;
    all.setup_seconds += part.setup_seconds;
    all.golden_seconds += part.golden_seconds;
  }
  all.batch.triangles_done = end;
  return all;
}

}  // namespace halfway
