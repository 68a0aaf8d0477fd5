// SPDX-License-Identifier: Apache-2.0
// A shader's RTL in GHDL. GHDL works through files and is one thread: it draws when the last vector has come,
// a long stream in several parts side by side.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "common/result.hpp"
#include "golden_run/golden_run.hpp"
#include "plan/hardware_key.hpp"
#include "sim/engine/engine.hpp"
#include "sim/ghdl/ghdl_runner.hpp"
#include "sim/stream_files/init_file.hpp"
#include "sim/system/file.hpp"

namespace halfway {

/// Where a stream of init vectors may be cut: before a triangle, some way behind the last place.
class Cuts {
 public:
  explicit Cuts(const HardwareKey& key);
  /// The stream's next vectors, whole triangles.
  void add(std::span<const std::uint32_t> init_words);
  /// The first vectors of the parts to draw in, by the frame alone and not by the machine; the first one's is
  /// 0. Parts of many clocks first, an eighth of all, then of fewer, so that whoever takes them by turns ends
  /// together. One part where triangles hang on those before (the shading processors: lights, shadow
  /// counters), or where there is little to draw.
  std::vector<std::uint64_t> parts() const;

 private:
  struct Place {
    std::uint64_t vectors, clocks;  ///< before
  };
  std::unique_ptr<GoldenModel> golden_;  ///< none where there is no place to cut
  std::vector<Place> places_{{0, 0}};
  Place end_{0, 0};
};

/// Runs `runner` on each part of `init_file`, up to `threads` at a time, each from the reset on, and then
/// hands on their fragments in order: the same as of one run. Where a part ends with a fault, none are handed
/// on. Gives the sum of the parts' cycles: a few more for each, in which the hardware fills and drains.
/// Leaves the parts' files next to `init_file`.
Result<std::uint64_t> run_in_parts(const GhdlRunner& runner, const HardwareKey& key,
                                   const std::filesystem::path& init_file,
                                   std::span<const std::uint64_t> first_vectors,
                                   const GhdlRunOptions& options, unsigned threads,
                                   const Engine::OnDrawn& on_drawn);

class GhdlEngine final : public Engine {
 public:
  /// The number of fragments is limited by drain().
  static Result<GhdlEngine> open(const HardwareKey& key, const SimulatorFolders& folders, unsigned threads,
                                 const GhdlRunOptions& options);

  EngineKind kind() const override { return EngineKind::ghdl; }
  Result<std::shared_ptr<Engine>> another() const override;
  Status draw(std::span<const std::uint32_t> init_words, std::uint64_t most,
              const OnDrawn& on_drawn) override;
  Status drain(std::uint64_t most, const OnDrawn& on_drawn) override;
  std::optional<std::uint64_t> cycles() const override { return cycles_; }
  std::uint64_t parts() const override { return parts_; }
  bool draws_late() const override { return true; }

 private:
  GhdlEngine(const HardwareKey& key, const GhdlRunner& runner, const std::filesystem::path& cache,
             unsigned threads, const GhdlRunOptions& options)
      : key_(key), runner_(runner), cache_(cache), threads_(threads), options_(options), cuts_(key) {}
  std::filesystem::path init_file() const { return folder_->path() / "init"; }
  Status begin();

  HardwareKey key_;
  GhdlRunner runner_;
  std::filesystem::path cache_;
  unsigned threads_;
  GhdlRunOptions options_;
  std::optional<TemporaryFolder> folder_;  ///< of a frame's files
  std::optional<InitFileWriter> init_;     ///< none before a frame's first vector
  Cuts cuts_;
  std::optional<std::uint64_t> cycles_;
  std::uint64_t parts_ = 1;
};

}  // namespace halfway
