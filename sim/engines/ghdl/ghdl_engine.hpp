// SPDX-License-Identifier: Apache-2.0
// A shader's RTL in GHDL. GHDL works on files and uses one thread, so it draws when all vectors are known,
// and draws a long stream as several parts in parallel.
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
#include "sim/driver/engine.hpp"
#include "sim/engines/ghdl/ghdl_runner.hpp"
#include "sim/files/init_file.hpp"
#include "sim/os/file.hpp"

namespace halfway {

/// Finds places where a stream of init vectors may be cut: before a triangle, at minimum distances.
class Cuts {
 public:
  explicit Cuts(const HardwareKey& key);
  /// Adds the stream's next vectors, which must be whole triangles.
  void add(std::span<const std::uint32_t> init_words);
  /// Returns the number of the first vector of each part; that of the first part is 0. It depends on the
  /// frame only, not on the machine. The first part has an eighth of all clocks, later parts have fewer, so
  /// that threads that take part after part end together. The result is a single part if triangles depend on
  /// earlier vectors (shading processors: lights), or if the frame is small.
  std::vector<std::uint64_t> parts() const;

 private:
  struct Place {
    std::uint64_t vectors, clocks;  ///< before the place
  };
  std::unique_ptr<GoldenModel> golden_;  ///< null if the stream cannot be cut
  std::vector<Place> places_{{0, 0}};
  Place end_{0, 0};
};

/// Runs `runner` on each part of `init_file`, at most `threads` at a time, each after a reset. Then outputs
/// the fragments in the order of a single run, or none if a part ends with a fault. Returns the sum of the
/// parts' cycles. This is more than the cycles of a single run, because each part fills and drains the
/// pipeline. The parts' files stay next to `init_file`. Throws Failure.
std::uint64_t run_in_parts(const GhdlRunner& runner, const HardwareKey& key,
                           const std::filesystem::path& init_file,
                           std::span<const std::uint64_t> first_vectors, const GhdlRunOptions& options,
                           unsigned threads, const Engine::OnDrawn& on_drawn);

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
  void begin();

  HardwareKey key_;
  GhdlRunner runner_;
  std::filesystem::path cache_;
  unsigned threads_;
  GhdlRunOptions options_;
  std::optional<TemporaryFolder> folder_;  ///< for the files of a frame
  std::optional<InitFileWriter> init_;     ///< std::nullopt before a frame's first vector
  Cuts cuts_;
  std::optional<std::uint64_t> cycles_;
  std::uint64_t parts_ = 1;
};

}  // namespace halfway
