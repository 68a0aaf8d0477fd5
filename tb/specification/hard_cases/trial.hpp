// SPDX-License-Identifier: Apache-2.0
// Figures and bounds of a hard case, and drawings for which the RTL must equal the golden model.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "common/result.hpp"
#include "plan/plan.hpp"
#include "scene/scene.hpp"
#include "sim/driver/engine.hpp"
#include "sim/driver/frame_driver.hpp"
#include "sim/engines/ghdl/ghdl_library.hpp"

namespace halfway::stability {

/// The figure with the greatest ratio to its bound.
struct Worst {
  double figure = 0.0, bound = 0.0;
  std::string where{};
  std::uint64_t count = 0;  ///< number of figures

  bool within() const { return figure <= bound; }
  /// NaN exceeds every bound.
  void add(double next, double next_bound, const std::function<std::string()>& where_of);
};

/// The reason for which the figures refute the case; empty if they do not. If the published form is silent,
/// no paper has such a form, and it has no figure. Otherwise at least one of its figures must exceed the
/// bound.
std::string refutation(bool is_silent, const Worst& ours, const Worst& published);

struct DrawOptions {
  PlanRequest plan{};
  FrameSize frame{64, 48};
  SetupOptions setup{};
  bool in_rtl = true;  ///< of Trial::draw
};

/// A scene's stream and the golden model's fragments for it.
struct Drawing : FrameStream {
  HardwareKey key{};
};

/// Runs plan, setup and golden model on the scene.
Result<Drawing> draw_golden(const Scene& scene, const DrawOptions& options);

/// Simulators that the cases share; for one thread.
struct Simulators {
  std::map<std::string, std::shared_ptr<Engine>> verilated{};  ///< RTL that runs in this process, by key
  std::set<std::string> through_ghdl{};                        ///< keys for which GHDL has already drawn
};

class Trial {
 public:
  /// A quick sweep takes part of a second, a full one up to a minute. The cases share `rtl`. Figures of our
  /// form with a bound above `conditioned` are ill-conditioned.
  Trial(SimulatorFolders folders, Simulators& rtl, bool quick,
        double conditioned = std::numeric_limits<double>::infinity())
      : folders_(std::move(folders)), rtl_(rtl), quick_(quick), conditioned_(conditioned) {}

  bool quick() const { return quick_; }
  /// Number of rounds of a random sweep.
  int rounds(int quick, int full) const { return quick_ ? quick : full; }

  /// Adds a figure of our form, of the published form, or of the preset's form, and the bound of the
  /// property.
  void ours(long double figure, long double bound, const std::function<std::string()>& where) {
    ours_.add(static_cast<double>(figure), static_cast<double>(bound), where);
    if (!(bound > conditioned_))
      well_conditioned_.add(static_cast<double>(figure), static_cast<double>(bound), where);
  }
  void published(long double figure, long double bound, const std::function<std::string()>& where) {
    published_.add(static_cast<double>(figure), static_cast<double>(bound), where);
  }
  void measure(Preset preset, long double figure, long double bound,
               const std::function<std::string()>& where) {
    preset == Preset::exact ? ours(figure, bound, where) : published(figure, bound, where);
  }
  /// Adds a figure of our form: 0 if the property holds, else 1.
  void check(bool holds, const std::function<std::string()>& where) { ours(holds ? 0 : 1, 0, where); }
  /// Requires a property that has no figure.
  void require(bool holds, const std::function<std::string()>& what) {
    if (!holds && failure_.empty()) failure_ = what();
  }

  /// As draw_golden. The RTL must emit the same fragments, if it is drawn.
  Drawing draw(const Scene& scene, const DrawOptions& options);
  /// Draws hand-made vectors, in whole triangles, on hardware without a prologue.
  std::vector<Fragment> draw(const HardwareKey& key, std::span<const std::uint32_t> words);

  /// Sets a sentence that the page gives with our figures.
  void remark(std::string sentence) { remark_ = std::move(sentence); }

  const Worst& ours() const { return ours_; }
  const std::string& remark() const { return remark_; }
  /// The figures of our form without the ill-conditioned ones.
  const Worst& well_conditioned() const { return well_conditioned_; }
  const Worst& published() const { return published_; }
  /// The reason for which the case failed independently of the figures; empty if it did not.
  const std::string& failure() const { return failure_; }
  /// The error of a tool that is missing or broke.
  const Status& tools() const { return tools_; }
  std::uint64_t golden_fragments() const { return golden_fragments_; }
  std::uint64_t rtl_fragments() const { return rtl_fragments_; }

 private:
  void compare_rtl(const HardwareKey& key, std::span<const std::uint32_t> words,
                   std::span<const Fragment> golden, bool fault);
  Status compare_with(const Result<std::shared_ptr<Engine>>& engine, const HardwareKey& key,
                      std::span<const std::uint32_t> words, std::span<const Fragment> golden, bool fault);
  /// An engine after a reset.
  Result<std::shared_ptr<Engine>> verilated(const HardwareKey& key);

  SimulatorFolders folders_;
  Simulators& rtl_;
  bool quick_;
  double conditioned_;
  Worst ours_, well_conditioned_, published_;
  std::string failure_, remark_;
  Status tools_ = Ok{};
  std::uint64_t golden_fragments_ = 0, rtl_fragments_ = 0;
};

}  // namespace halfway::stability
