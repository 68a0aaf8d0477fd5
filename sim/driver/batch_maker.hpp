// SPDX-License-Identifier: Apache-2.0
// A frame's stream of init vectors in batches, with the golden model's fragments for them.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "common/host.hpp"
#include "frame/fragment.hpp"
#include "golden_run/golden_run.hpp"
#include "setup/setup.hpp"

namespace halfway {

struct Batch {
  std::vector<std::uint32_t> init_words;
  std::vector<Fragment> golden;  ///< of these vectors, if a golden model draws
  double done = 0.0;             ///< share of the stream up to and including this batch, 0 to 1
};

/// Set-up and golden model of one batch at a time, by any number of threads. The stream does not depend on
/// their number. The first batch starts with the set-up's prologue, which is also given to the golden model
/// of every thread. Memory is limited by the size of a batch, not by the mesh. A thread ends its part of a
/// batch with the unit that exceeds 8 MB of vectors and fragments; no part is started if all parts together
/// contain 8 MB. A batch therefore contains at most 8 MB plus one unit per thread. A unit may be larger than
/// 8 MB: a triangle that covers 2^19 pixels, or a crowded line.
class BatchMaker {
 public:
  using MakeGolden = std::function<std::unique_ptr<GoldenModel>()>;

  /// Without `golden` the batches contain no fragments. The set-up and the clocks must outlive the object.
  BatchMaker(const Setup& setup, MakeGolden golden, unsigned threads, const Clocks& clocks);

  /// Begins the next batch, in the memory of `room`. Returns false if the stream has ended.
  bool begin(Batch room);
  /// Makes parts of the batch until none is left. Several threads may call it at the same time.
  void work();
  /// The batch, after all calls of work(). Its counts, fault and times are added to those below.
  Batch end();

  const SetupCounts& counts() const { return counts_; }
  /// True after a fault of the golden model: the fragments are invalid.
  bool fault() const { return fault_; }
  double setup_seconds() const { return setup_seconds_; }  ///< of processor time
  double golden_seconds() const { return golden_seconds_; }

 private:
  struct Part {
    Batch batch;
    std::uint32_t end = 0;  ///< the first unit after it; 0 if the part was not started
    SetupCounts counts;
    double setup_seconds = 0.0, golden_seconds = 0.0;
    bool fault = false;
  };
  void make(Part& part, std::size_t chunk, SetupWorker& setup, GoldenModel* golden);

  const Setup& setup_;
  MakeGolden make_golden_;
  unsigned threads_;
  const Clocks& clocks_;
  std::vector<std::uint32_t> prologue_;
  std::uint32_t batch_units_;  ///< of the next batch, at most

  // Of the batch that is being made.
  std::uint32_t begin_ = 0, end_ = 0, chunk_units_ = 1;
  std::size_t chunks_ = 0;
  std::vector<Part> parts_;  ///< one for each chunk; for one thread a single one
  std::atomic<std::size_t> taken_ = 0, held_ = 0;
  std::atomic<bool> full_ = false;

  std::uint32_t next_unit_ = 0;
  SetupCounts counts_;
  bool fault_ = false;
  double setup_seconds_ = 0.0, golden_seconds_ = 0.0;
};

}  // namespace halfway
