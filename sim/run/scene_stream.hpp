// SPDX-License-Identifier: Apache-2.0
// A scene as a stream of batches: init vectors and the golden model's fragments for them, in the scene's
// order.
#pragma once

#include <cstdint>
#include <future>
#include <vector>

#include "common/result.hpp"
#include "frame/fragment.hpp"
#include "plan/hardware_key.hpp"
#include "setup/setup.hpp"

namespace halfway {

struct Batch {
  std::vector<std::uint32_t> init_words;
  std::vector<Fragment> golden;
  double done = 0.0;  ///< part of the stream, this batch included: 0 to 1
};

class MadeFormats;

struct SceneStreamOptions {
  bool golden = true;  ///< else batches hold no fragments
  /// Else a batch is made when it is asked for: better where other threads have work of their own.
  bool ahead = true;
  /// Makes the golden models of a key with other word lengths; null: the program's own. It must outlive the
  /// stream.
  const MadeFormats* formats = nullptr;
};

/// Setup and golden model on `threads` threads, one batch ahead of who takes them. The stream does not depend
/// on the number of threads. The first batch begins with setup's prologue, which every thread's golden model
/// is given first. Memory is bounded by a batch, not by the mesh: a thread ends its part of a batch, before
/// the golden model draws it, with the unit that takes it past 8 MB of vectors and fragments, and begins none
/// once all of them hold so much. So a batch holds 8 MB and a unit for each thread at most; a unit may be
/// larger than that: a triangle that covers 2^19 pixels, or a crowded line.
class SceneStream {
 public:
  /// The setup must outlive the stream.
  SceneStream(const Setup& setup, const HardwareKey& key, unsigned threads,
              const SceneStreamOptions& options = {});
  ~SceneStream();

  /// The next batch; false after the last, and none. What the batch before lay in is used again.
  bool next(Batch& batch);
  /// Of all batches taken so far.
  const SetupCounts& counts() const { return counts_; }
  /// The golden model's in one of them: fragments are worth nothing.
  bool fault() const { return fault_; }
  /// Processor seconds that setup took, and the golden model.
  double setup_seconds() const { return setup_seconds_; }
  double golden_seconds() const { return golden_seconds_; }

 private:
  struct Work {
    Batch batch;
    std::uint32_t end = 0;  ///< the first unit behind it; 0 of a part that was not begun
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
  std::uint32_t next_unit_ = 0, batch_units_;  ///< the batch ahead begins there
  std::future<Work> ahead_;
  SetupCounts counts_;
  bool fault_ = false;
  double setup_seconds_ = 0, golden_seconds_ = 0;
};

/// Whether, in all batches taken so far, each pixel's shadow volumes could be counted; bad input where there
/// are too many. `fault`: of a golden model that draws the batches elsewhere.
Status check_shadow_counts(const Scene& scene, const SceneStream& stream, bool fault = false);
/// Whether, in all batches taken so far, each triangle projects to finite points; bad input where one does
/// not.
Status check_projection(const Scene& scene, const SceneStream& stream);

}  // namespace halfway
