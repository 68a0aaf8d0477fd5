// SPDX-License-Identifier: Apache-2.0
// What to draw, and the knobs of drawing. Each knob is declared once, in the table of draw_knobs.cpp: options
// of the commands that draw, keys of spaces, columns of a study's table and names of designs are made from
// it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "plan/plan.hpp"
#include "setup/setup.hpp"

namespace halfway {

/// What to draw of a scene: the part that all settings of jobs have in common.
struct DrawRequest {
  PlanRequest plan{};
  FrameSize size{};
  SetupOptions setup{};
  unsigned threads = 1;
};

/// A value as text, with what begins its messages: an option, or file, line and key.
struct KnobText {
  std::string place, text;
  [[noreturn]] void fail(std::string_view what) const;
};

struct DrawKnob {
  const char* name;                                                  ///< the key, such as span_ends
  std::vector<std::pair<Shader, std::optional<Preset>>> belongs_to;  ///< without a preset: both
  bool selects_hardware;                                             ///< otherwise it is the host's
  std::string help;
  /// Throws Failure if the text is not one of its values.
  void (*set)(const KnobText& value, PlanRequest& plan, SetupOptions& setup);
  /// Empty: the preset's. Null: the knob is not a key of spaces.
  std::string (*text)(const PlanRequest& plan, const SetupOptions& setup) = nullptr;
  /// The format of its text in names of designs, which have it if it is not the default.
  const char* in_names = "";
  /// False if other knobs leave it without effect: it then goes with `needs`. Null: never.
  bool (*matters)(const PlanRequest& plan, const SetupOptions& setup) = nullptr;
  const char* needs = "";
  bool always_named = false;

  std::string option() const;  ///< such as --span-ends
  bool belongs(Shader shader, Preset preset) const;
};

/// In the order of help and names.
const std::vector<DrawKnob>& draw_knobs();

}  // namespace halfway
