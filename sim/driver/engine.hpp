// SPDX-License-Identifier: Apache-2.0
// The RTL of one hardware key in a simulator: init vectors in, fragments out. Code that draws frames uses
// this interface and does not depend on the kind of simulator.
//
// To add an engine:
//   1. Derive a class from Engine, in a folder of its own under sim/.
//   2. Add its kind to EngineKind, c_engine_kinds, to_string() and title().
//   3. Open it in open_engine(), sim/run/open_engine.cpp.
// `halfway sim --simulator NAME` then draws with it, compares every fragment with the golden model's and
// writes NAME.trace, NAME.png and an entry of summary.json. `halfway view` and `halfway plan` have their own
// lists of supported kinds.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "common/result.hpp"
#include "frame/fragment.hpp"

namespace halfway {

/// In the order used in results.
enum class EngineKind { ghdl, verilator, lanes };
inline constexpr EngineKind c_engine_kinds[] = {EngineKind::ghdl, EngineKind::verilator, EngineKind::lanes};

/// Name in options, files and summaries.
constexpr const char* to_string(EngineKind kind) {
  switch (kind) {
    case EngineKind::ghdl:
      return "ghdl";
    case EngineKind::verilator:
      return "verilator";
    case EngineKind::lanes:
      break;
  }
  return "lanes";
}

/// Name in sentences.
constexpr const char* title(EngineKind kind) {
  switch (kind) {
    case EngineKind::ghdl:
      return "GHDL";
    case EngineKind::verilator:
      return "Verilator";
    case EngineKind::lanes:
      break;
  }
  return "lanes";
}

class Engine {
 public:
  /// Fragments in the stream's order, valid during the call.
  using OnDrawn = std::function<void(std::span<const Fragment>)>;

  virtual ~Engine() = default;
  virtual EngineKind kind() const = 0;
  /// Another engine of the same hardware, reset, with the same options, for another thread.
  virtual Result<std::shared_ptr<Engine>> another() const = 0;

  /// Draws the vectors of whole triangles. The last fragments may be output by the next call. A fault of the
  /// hardware (a hang, more than `most` fragments) is an error with the exit code `differs`; fragments before
  /// the fault may have been output.
  virtual Status draw(std::span<const std::uint32_t> init_words, std::uint64_t most,
                      const OnDrawn& on_drawn) = 0;
  /// Draws the remaining fragments until the hardware is empty. The next vectors start another frame.
  virtual Status drain(std::uint64_t most, const OnDrawn& on_drawn) = 0;

  /// Clocks from the first accepted vector to the last accepted vector or output fragment, both included, of
  /// all frames. std::nullopt if the engine cannot count them.
  virtual std::optional<std::uint64_t> cycles() const = 0;
  /// Number of parts of the frame that were drawn separately, each after a reset.
  virtual std::uint64_t parts() const { return 1; }
  /// True if fragments are output by drain() only.
  virtual bool draws_late() const { return false; }

  /// The same, but appends the fragments to `out`. Its size is limited to `most`.
  Status run(std::span<const std::uint32_t> init_words, std::vector<Fragment>& out, std::uint64_t most) {
    return draw(init_words, room(out, most), appended_to(out));
  }
  Status finish(std::vector<Fragment>& out, std::uint64_t most) {
    return drain(room(out, most), appended_to(out));
  }

 private:
  static std::uint64_t room(const std::vector<Fragment>& out, std::uint64_t most) {
    return most - std::min<std::uint64_t>(most, out.size());
  }
  static OnDrawn appended_to(std::vector<Fragment>& out) {
    return [&out](std::span<const Fragment> drawn) { out.insert(out.end(), drawn.begin(), drawn.end()); };
  }
};

/// Converts an opened engine to a shared pointer, for callers that accept any engine.
template <class Opened>
Result<std::shared_ptr<Engine>> shared_engine(Result<Opened> opened) {
  if (!opened) return opened.error();
  return std::shared_ptr<Engine>(std::make_shared<Opened>(std::move(*opened)));
}

}  // namespace halfway
