// SPDX-License-Identifier: Apache-2.0
// Speed-up by several threads, compared with work that shares nothing.
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <span>
#include <thread>

#include "sim/bench/program/bench.hpp"
#include "sim/bench/yardstick.hpp"
#include "sim/compare/stream_comparator.hpp"
#include "sim/run/open_engine.hpp"
#include "sim/system/seconds.hpp"
#include "sim/system/threads.hpp"

namespace halfway {
namespace {

/// Times of pieces of work. Each thread takes the next piece when it has finished one.
struct Shared {
  double seconds, processor;  ///< elapsed time; processor time of all threads
};
Shared share(unsigned threads, std::size_t pieces, const std::function<void(unsigned, std::size_t)>& work) {
  std::atomic<std::size_t> next = 0;
  std::atomic<unsigned> thread = 0;
  const double processor_start = process_seconds();
  const auto start = std::chrono::steady_clock::now();
  work_on_threads(threads, [&] {
    const unsigned own = thread++;
    for (std::size_t i; (i = next++) < pieces;) work(own, i);
  });
  return {seconds_since(start), process_seconds() - processor_start};
}

// A stream in about five parts of whole batches.
std::vector<std::span<const std::uint32_t>> fifths_of(const InitBatches& s) {
  const std::size_t each = (s.batches.size() + 4) / 5;
  std::vector<std::span<const std::uint32_t>> parts;
  for (std::size_t at = 0, i = 0; i < s.batches.size();) {
    std::size_t vectors = 0;
    for (const std::size_t end = std::min(i + each, s.batches.size()); i < end; ++i) vectors += s.batches[i];
    parts.push_back(std::span(s.words).subspan(at * s.words_per_vector(), vectors * s.words_per_vector()));
    at += vectors;
  }
  return parts;
}

}  // namespace

// Golden model, lanes and comparison of fifths of frames, which the threads take one after another. After
// each measurement the yardstick runs on the same number of threads.
void measure_cores(const char* shader, const InitBatches& s, Json& rows) {
  constexpr std::size_t c_frames = 12;
  constexpr int c_repetitions = 15;
  constexpr std::uint32_t c_yardstick_rounds = 1'000'000;  // about as long as a fifth of a frame
  const unsigned most = std::min(4U, std::thread::hardware_concurrency());
  const auto parts = fifths_of(s);
  std::vector<std::shared_ptr<Engine>> engines;
  std::vector<std::unique_ptr<GoldenModel>> goldens;
  for (unsigned i = 0; i < most; ++i) {
    engines.push_back(must(open_engine(EngineKind::lanes, s.key, c_folders)));
    goldens.push_back(make_golden_model(s.key));
  }
  // The speed of a core changes with time, so compare several threads with one thread of the same repetition.
  // The best time of one thread over all repetitions would be a moment in which all cores were fast.
  struct Ratios {
    std::vector<double> speed, processor, yardstick, speed_over_yardstick;
  };
  std::vector<Ratios> all(most);
  const std::size_t pieces = c_frames * parts.size();
  for (int repetition = 0; repetition < c_repetitions; ++repetition) {
    Shared one{}, yard{};
    for (unsigned threads = 1; threads <= most; ++threads) {
      std::atomic<std::uint64_t> mismatches = 0, fragments = 0;
      const Shared took = share(threads, pieces, [&](unsigned own, std::size_t piece) {
        StreamComparator comparator;
        std::uint64_t drawn_here = 0;
        auto words = parts[piece % parts.size()];
        must(engines[own]->draw(words, SIZE_MAX, [&](std::span<const Fragment> drawn) {
          comparator.add(goldens[own]->draw_next(words, drawn.size()), drawn);
          drawn_here += drawn.size();
        }));
        comparator.finish();
        mismatches += comparator.mismatches();
        fragments += drawn_here;
      });
      if (mismatches != 0 || fragments != c_frames * s.golden.size())
        throw Failure{{ExitCode::differs, "cores: the RTL differs"}};
      const Shared took_yard = share(threads, pieces, [](unsigned, std::size_t) {
        benchmark::DoNotOptimize(sum_in_registers(c_yardstick_rounds));
      });
      if (threads == 1) one = took, yard = took_yard;
      const double speed = one.seconds / took.seconds, yardstick = yard.seconds / took_yard.seconds;
      Ratios& ratios = all[threads - 1];
      ratios.speed.push_back(speed);
      ratios.processor.push_back(took.processor / one.processor);
      ratios.yardstick.push_back(yardstick);
      ratios.speed_over_yardstick.push_back(speed / yardstick);
    }
  }
  for (unsigned threads = 1; threads <= most; ++threads) {
    const Ratios& of = all[threads - 1];
    const double speed = median(of.speed);
    rows.push_back({shader, std::to_string(threads), fmt::format("{:.2f}", speed), percent(speed / threads),
                    fmt::format("{:.2f}", median(of.processor)), percent(median(of.yardstick) / threads),
                    percent(median(of.speed_over_yardstick))});
  }
}

}  // namespace halfway
