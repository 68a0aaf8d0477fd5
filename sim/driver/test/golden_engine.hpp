// SPDX-License-Identifier: Apache-2.0
// An engine for tests that gives the golden model's fragments, changed on request, and keeps the vectors.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "golden_run/golden_run.hpp"
#include "sim/driver/engine.hpp"

namespace halfway {

class GoldenEngine final : public Engine {
 public:
  explicit GoldenEngine(const HardwareKey& key) : golden_(make_golden_model(key)) {}

  EngineKind kind() const override { return EngineKind::lanes; }
  Result<std::shared_ptr<Engine>> another() const override { return tool_failed("one engine only"); }
  Status draw(std::span<const std::uint32_t> init_words, std::uint64_t, const OnDrawn& on_drawn) override {
    words.insert(words.end(), init_words.begin(), init_words.end());
    ++batches;
    const auto drawn = golden_->draw(init_words);
    std::vector<Fragment> own(drawn.begin(), drawn.end());
    fragments.insert(fragments.end(), own.begin(), own.end());
    change(own);
    on_drawn(own);
    return end ? Status(*end) : Status(Ok{});
  }
  Status drain(std::uint64_t, const OnDrawn&) override { return Ok{}; }
  std::optional<std::uint64_t> cycles() const override { return std::nullopt; }

  std::function<void(std::vector<Fragment>&)> change = [](std::vector<Fragment>&) {};
  std::optional<Error> end;  ///< how every drawing ends
  std::vector<std::uint32_t> words;
  std::vector<Fragment> fragments;  ///< before the change
  std::size_t batches = 0;

 private:
  std::unique_ptr<GoldenModel> golden_;
};

}  // namespace halfway
