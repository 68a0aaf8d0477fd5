// SPDX-License-Identifier: Apache-2.0
// What a hard case is tried with: figures against bounds, and drawings whose golden model the RTL must equal.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "common/result.hpp"
#include "frame/fragment.hpp"
#include "frame/frame_size.hpp"
#include "plan/plan.hpp"
#include "scene/scene.hpp"
#include "setup/setup.hpp"
#include "sim/ghdl/ghdl_library.hpp"
#include "sim/verilator/verilator_simulator.hpp"

namespace halfway::stability {

/// The figure that comes nearest to its bound, or is farthest past it.
struct Worst {
  double figure = 0.0, bound = 0.0;
  std::string where{};
  std::uint64_t count = 0;  ///< figures in all

  bool within() const { return figure <= bound; }
  /// A figure that is no number is past every bound.
  void add(double next, double next_bound, const std::function<std::string()>& where_of);
};

/// What the published form does in the case.
enum class PublishedForm {
  breaks,  ///< one of its figures must exceed the bound
  holds,   ///< its figures must stay within the bound
  silent   ///< no paper has such a form, so it has no figure
};

/// Why the figures refute the case; empty: they do not.
std::string refutation(PublishedForm expected, const Worst& ours, const Worst& published);

struct DrawOptions {
  PlanRequest plan{};
  FrameSize frame{64, 48};
  SetupOptions setup{};
};

/// Everything that the setup sends to the hardware for one frame.
struct Stream {
  unsigned init_bits = 0;
  std::vector<std::uint32_t> prologue{}, units{};
  SetupCounts counts{};

  std::size_t vector_words() const { return (init_bits + 31) / 32; }
  std::vector<std::uint32_t> words() const;  ///< prologue and units
};
Stream stream_of(const Setup& setup);

/// A scene's stream and what the golden model makes of it.
struct Drawing {
  HardwareKey key{};
  unsigned init_bits = 0;
  std::vector<std::uint32_t> words{};  ///< prologue and units
  std::vector<Fragment> fragments{};
  SetupCounts counts{};
  std::vector<std::string> notes{};
  bool fault = false;
};

/// The scene through plan, setup and golden model.
Result<Drawing> draw_golden(const Scene& scene, const DrawOptions& options);

/// What goes from one case to the next; for one thread.
struct Simulators {
  std::map<std::string, VerilatorSimulator> verilated{};  ///< RTL that runs in this process, by key
  std::set<std::string> through_ghdl{};                   ///< keys of which GHDL has drawn something
};

class Trial {
 public:
  /// A quick sweep takes part of a second, a full one up to a minute. `rtl` goes from one case to the next.
  Trial(SimulatorFolders folders, Simulators& rtl, bool quick)
      : folders_(std::move(folders)), rtl_(rtl), quick_(quick) {}

  bool quick() const { return quick_; }
  /// The project's root.
  const std::filesystem::path& source() const { return folders_.source; }
  /// Rounds of a random sweep.
  int rounds(int quick, int full) const { return quick_ ? quick : full; }

  /// A figure of our form, of the published form, or of the preset's form, and the bound of the property.
  void ours(long double figure, long double bound, const std::function<std::string()>& where) {
    ours_.add(static_cast<double>(figure), static_cast<double>(bound), where);
  }
  void published(long double figure, long double bound, const std::function<std::string()>& where) {
    published_.add(static_cast<double>(figure), static_cast<double>(bound), where);
  }
  void measure(Preset preset, long double figure, long double bound,
               const std::function<std::string()>& where) {
    preset == Preset::exact ? ours(figure, bound, where) : published(figure, bound, where);
  }
  /// Figures of both forms, which have one bound.
  void both(long double ours_figure, long double published_figure, long double bound,
            const std::function<std::string()>& where) {
    ours(ours_figure, bound, where);
    published(published_figure, bound, where);
  }
  /// A figure of our form that is 0 where the property holds, else 1.
  void check(bool holds, const std::function<std::string()>& where) { ours(holds ? 0 : 1, 0, where); }
  /// A property without a figure.
  void require(bool holds, const std::function<std::string()>& what) {
    if (!holds && failure_.empty()) failure_ = what();
  }

  /// draw_golden; the RTL must emit the same fragments.
  Drawing draw(const Scene& scene, const DrawOptions& options);
  /// Vectors made by hand, whole triangles, of hardware that takes no prologue.
  std::vector<Fragment> draw(const HardwareKey& key, std::span<const std::uint32_t> words);

  const Worst& ours() const { return ours_; }
  const Worst& published() const { return published_; }
  /// Why the case failed whatever the figures say; empty: it did not.
  const std::string& failure() const { return failure_; }
  /// A tool that is missing or broke.
  const Status& tools() const { return tools_; }
  std::uint64_t golden_fragments() const { return golden_fragments_; }
  std::uint64_t rtl_fragments() const { return rtl_fragments_; }

 private:
  void compare_rtl(const HardwareKey& key, unsigned init_bits, std::span<const std::uint32_t> words,
                   std::span<const Fragment> golden, bool fault);
  Status run_verilator(const HardwareKey& key, unsigned init_bits, std::span<const std::uint32_t> words,
                       std::vector<Fragment>& drawn, std::size_t most);
  Status run_ghdl(const HardwareKey& key, unsigned init_bits, std::span<const std::uint32_t> words,
                  std::vector<Fragment>& drawn, std::size_t most);

  SimulatorFolders folders_;
  Simulators& rtl_;
  bool quick_;
  Worst ours_, published_;
  std::string failure_;
  Status tools_ = Ok{};
  std::uint64_t golden_fragments_ = 0, rtl_fragments_ = 0;
};

}  // namespace halfway::stability
