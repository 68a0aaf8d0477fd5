// SPDX-License-Identifier: Apache-2.0
// What each stage of a shader holds of a line or a pixel: in the golden model, and in signals of the RTL.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/result.hpp"
#include "plan/hardware_key.hpp"
#include "sim/ghdl/ghdl_library.hpp"
#include "sim/stream_files/init_file.hpp"

namespace halfway {

/// Bits of a signal in GHDL's trace of tb/frame_tb.vhd.
struct Signal {
  std::string path;     ///< scopes and name, such as frame_tb/dut/span_load
  int low = 0;          ///< the lowest of the bits
  int clocks = 0;       ///< after the stage's
  bool skewed = false;  ///< the upper half of the signal's bits comes a clock after the lower one
};

/// A word that a stage holds.
struct StageWord {
  std::string name;
  int bits = 1, fraction_bits = 0;
  bool is_signed = false;
  std::string entity;  ///< whose register it is, and what gives that its inputs
  Signal signal;
};

struct Stage {
  std::string name;
  std::string entity;                ///< that makes it happen
  std::vector<std::string> strobes;  ///< signals that are all '1' when a line or a pixel comes here
  int clocks = 0;                    ///< after its strobes, when its registers hold that
  std::vector<StageWord> words{};
  std::optional<Signal> command{};  ///< of a token: only an object's counts
};

/// What the golden model says of a stage.
struct GoldenEvent {
  std::size_t stage;
  std::uint32_t triangle, y, x;      ///< x: the pixel; the first stage's: the line's first
  std::vector<std::uint64_t> words;  ///< of the stage, in their order
};

/// What the RTL did.
struct RtlEvent {
  std::uint64_t cycle;                              ///< from the one that takes the first init vector
  std::vector<std::optional<std::uint64_t>> words;  ///< nothing where a bit is neither 0 nor 1
};

/// The stages of a key's shader, in the order in which a pixel comes to them: line, span, ..., fragment.
class ShaderStages {
 public:
  virtual ~ShaderStages() = default;
  const std::vector<Stage>& stages() const { return stages_; }

  /// Draws whole triangles' vectors by the golden model. Events come in this order: a line; for each of its
  /// pixels the stages from the span on, fragment last, but what the pixel does not come to.
  virtual std::vector<GoldenEvent> draw(std::span<const std::uint32_t> init_words) = 0;

  /// The signals that read() wants of a trace.
  std::vector<std::string> signals() const;
  /// Stage by stage, in their order.
  Result<std::vector<std::vector<RtlEvent>>> read(const std::filesystem::path& vcd) const;

 protected:
  std::vector<Stage> stages_;
};

std::unique_ptr<ShaderStages> make_stages(const HardwareKey& key);

/// A run of GHDL.
struct StageTrace {
  std::vector<std::vector<RtlEvent>> events;  ///< stage by stage
  std::string fault;                          ///< of the hardware, as the testbench tells it; empty: none
};

/// Simulates whole triangles' vectors in GHDL, which the golden model draws `fragments` fragments of.
Result<StageTrace> trace_stages(const HardwareKey& key, const ShaderStages& stages,
                                const SimulatorFolders& folders, const InitStream& vectors,
                                std::uint64_t fragments);

/// What the planes of the processors shader are of: "N x", ..., "1/w".
std::vector<std::string> plane_names(const HardwareKey& key);

/// As what a channel is told apart: "grey", or "red", "green", "blue".
std::string channel_name(unsigned channel, unsigned channels);

}  // namespace halfway
