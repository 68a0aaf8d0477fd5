// SPDX-License-Identifier: Apache-2.0
// Values of each stage of a shader for a line or a pixel, in the golden model and in signals of the RTL. It
// needs no threads, files or exceptions, so a browser runs it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "plan/hardware_key.hpp"

namespace halfway {

/// Bits of a signal of the RTL.
struct Signal {
  std::string path;            ///< instances and name, such as walker/x, from the shader on
  int low = 0;                 ///< lowest bit
  int clocks = 0;              ///< delay after the stage's clock
  bool skewed = false;         ///< the upper half of the bits is one clock later than the lower half
  std::string netlist_path{};  ///< path of an equal signal of the netlist, if it omits this one
};

/// Number format of a word.
struct WordFormat {
  int bits = 1, fraction_bits = 0;
  bool is_signed = false;
};

/// A register of a stage.
struct StageWord {
  std::string name;
  WordFormat format;
  std::string entity;  ///< the register's entity and the entity of its inputs
  Signal signal;
};

struct Stage {
  std::string name;
  std::string entity;                ///< entity that drives the strobes
  std::vector<std::string> strobes;  ///< all are '1' when a line or a pixel enters the stage
  int clocks = 0;                    ///< delay from the strobes to the registers
  std::vector<StageWord> words{};
  std::optional<Signal> command{};  ///< of a token; it counts only if it is an object
};

/// Values of a stage in the golden model.
struct GoldenEvent {
  std::size_t stage;
  std::uint32_t triangle, y, x;      ///< x of the pixel; for the first stage: start of the line
  std::vector<std::uint64_t> words;  ///< in the order of the stage's words
};

/// Values of a stage in the RTL.
struct RtlEvent {
  std::uint64_t cycle;                              ///< counted from the one that takes the first init vector
  std::vector<std::optional<std::uint64_t>> words;  ///< std::nullopt if a bit is neither 0 nor 1
};

/// Bits of a signal that ShaderStages::read needs.
struct TracedPart {
  std::string path, netlist_path;  ///< in a simulation, and in the netlist
  int low, bits;
  friend bool operator<(const TracedPart& a, const TracedPart& b) {
    return std::tie(a.path, a.low, a.bits) < std::tie(b.path, b.low, b.bits);
  }
};

/// The signals of a simulation: their values before each rising edge of the clock.
struct SignalTrace {
  std::size_t edges = 0;
  /// `bits` bits, 64 at most, from bit `low` up; std::nullopt if one of them is neither 0 nor 1.
  std::function<std::optional<std::uint64_t>(const std::string& path, std::size_t edge, int low, int bits)>
      part{};
};

/// A trace of parts of signals as 32-bit words, as a hardware module records it. `words`: edge by edge, the
/// words of each part in their order, the least significant first.
SignalTrace word_trace(const std::set<TracedPart>& parts, std::vector<std::uint32_t> words);

/// The stages of a key's shader in pipeline order: line, span, ..., fragment.
class ShaderStages {
 public:
  virtual ~ShaderStages() = default;
  const std::vector<Stage>& stages() const { return stages_; }

  /// Draw the vectors of whole triangles with the golden model. Order of events: a line, then for each of its
  /// pixels the stages from the span to the fragment, without stages that the pixel does not reach.
  virtual std::vector<GoldenEvent> draw(std::span<const std::uint32_t> init_words) = 0;

  /// What read() needs in a trace, each part once.
  std::set<TracedPart> parts() const;
  /// Read the events of a trace: one list per stage.
  std::vector<std::vector<RtlEvent>> read(const SignalTrace& trace) const;

 protected:
  std::vector<Stage> stages_;
};

/// Without a stage for hardware with object processors.
std::unique_ptr<ShaderStages> make_stages(const HardwareKey& key);

/// Names of the planes of the processors shader: "N x", ..., "1/w".
std::vector<std::string> plane_names(const HardwareKey& key);

/// Name of a channel: "grey", or "red", "green", "blue".
std::string channel_name(unsigned channel, unsigned channels);

}  // namespace halfway
