// SPDX-License-Identifier: Apache-2.0
// A scene as a stream of batches: init vectors and the golden model's fragments for them, in the scene's
// order.
#pragma once

#include <cstdint>
#include <future>
#include <vector>

#include "frame/fragment.hpp"
#include "plan/hardware_key.hpp"
#include "setup/setup.hpp"

namespace halfway {

struct Batch {
  std::vector<std::uint32_t> init_words;
  std::vector<Fragment> golden;
  double done = 0.0;  ///< share of the stream up to and including this batch, 0 to 1
};

class MadeFormats;

struct SceneStreamOptions {
  bool golden = true;  ///< false: batches contain no fragments
  /// False: a batch is made only when requested, which is better if other threads have their own work.
  bool ahead = true;
  /// Makes the golden models of a key with other word lengths; null: use the program's own. It must outlive
  /// the stream.
  const MadeFormats* formats = nullptr;
};

/// Setup and golden model on `threads` threads, one batch ahead of the caller. The stream does not depend on
/// the number of threads. The first batch starts with setup's prologue, which is also given to the golden
/// model of every thread. Memory is limited by the size of a batch, not by the mesh. A thread ends its part
/// of a batch with the unit that exceeds 8 MB of vectors and fragments; no part is started if all parts
/// together contain 8 MB. A batch therefore contains at most 8 MB plus one unit per thread. A unit may be
/// larger than 8 MB: a triangle that covers 2^19 pixels, or a crowded line.
class SceneStream {
 public:
  /// The setup must outlive the stream.
  SceneStream(const Setup& setup, const HardwareKey& key, unsigned threads,
              const SceneStreamOptions& options = {});
  ~SceneStream();

  /// Gets the next batch; returns false after the last one. The memory of `batch` is used again.
  bool next(Batch& batch);
  /// Counts of all batches so far.
  const SetupCounts& counts() const { return counts_; }
  /// True after a fault of the golden model: the fragments are invalid.
  bool fault() const { return fault_; }
  /// Processor seconds of setup and of the golden model.
  double setup_seconds() const { return setup_seconds_; }
  double golden_seconds() const { return golden_seconds_; }

 private:
  struct Work {
    Batch batch;
    std::uint32_t end = 0;  ///< the first unit after it; 0 if the part was not started
    SetupCounts counts;
    double setup_seconds = 0, golden_seconds = 0;
    bool fault = false;
  };
  Work make(std::uint32_t begin, std::uint32_t end, Batch room) const;
  void prefetch(Batch room);

  const Setup& setup_;
  HardwareKey key_;
  unsigned threads_;
  SceneStreamOptions options_;
  std::vector<std::uint32_t> prologue_;
  std::uint32_t next_unit_ = 0, batch_units_;  ///< next_unit_: first unit of the batch ahead
  std::future<Work> ahead_;
  SetupCounts counts_;
  bool fault_ = false;
  double setup_seconds_ = 0, golden_seconds_ = 0;
};

}  // namespace halfway
