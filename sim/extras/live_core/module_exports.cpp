// SPDX-License-Identifier: Apache-2.0
// The core of the page, compiled to WebAssembly: LiveFrame as functions with numbers and addresses. The page
// implements the functions of the module "live" by a hardware module with a memory of its own.
#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "golden_run/golden_run.hpp"
#include "sim/driver/shader_stages.hpp"
#include "sim/engines/verilator/harness_api.h"
#include "sim/extras/live_core/live_frame.hpp"

#define HALFWAY_EXPORT(name) extern "C" __attribute__((export_name(#name), used))
#define HALFWAY_IMPORT(name) extern "C" __attribute__((import_module("live"), import_name(#name)))

/// Draws units and loads. Returns 0, or the end of the hardware (HalfwayStatus).
HALFWAY_IMPORT(hardware_draw)
int hardware_draw(const std::uint32_t* words, std::uint32_t word_count, const std::uint32_t* units,
                  std::uint32_t unit_count, std::uint32_t most);
/// Number of fragments drawn by the last call.
HALFWAY_IMPORT(hardware_count) std::uint32_t hardware_count();
/// Copies them.
HALFWAY_IMPORT(hardware_take) void hardware_take(halfway::Fragment* destination);
/// Draws words as a single stream in another copy of the hardware, and records the parts of
/// ShaderStages::parts.
HALFWAY_IMPORT(hardware_observe)
int hardware_observe(const std::uint32_t* words, std::uint32_t word_count, std::uint32_t most);
/// Number of words that the last observation recorded.
HALFWAY_IMPORT(hardware_trace_words) std::uint32_t hardware_trace_words();
/// Copies them.
HALFWAY_IMPORT(hardware_take_trace) void hardware_take_trace(std::uint32_t* destination);
/// Resets the hardware and forgets its loads.
HALFWAY_IMPORT(hardware_reset) void hardware_reset();
/// Milliseconds.
HALFWAY_IMPORT(now) double browser_now();

namespace halfway::live {
namespace {

static_assert(sizeof(Fragment) == sizeof(HalfwayFragment));
static_assert(sizeof(Settings) == c_setting_names.size() * sizeof(double));

/// What lanes draw of a stream of init vectors, in order: the number of vectors of each unit
/// (GoldenModel::group); 0 for a load (GoldenModel::is_load), which is one vector.
std::vector<std::uint32_t> units_of(const GoldenModel& golden, std::span<const std::uint32_t> init_words) {
  const std::size_t vector_words = (golden.init_bits() + 31) / 32;
  std::vector<std::uint32_t> units;
  while (!init_words.empty()) {
    const bool load = golden.is_load(init_words);
    const std::size_t vectors =
        load ? 1 : std::clamp<std::size_t>(golden.group(init_words), 1, init_words.size() / vector_words);
    units.push_back(load ? 0 : static_cast<std::uint32_t>(vectors));
    init_words = init_words.subspan(vectors * vector_words);
  }
  return units;
}

Error fault_of(int end) {
  const auto differs = [](const char* what) { return Error{ExitCode::differs, what}; };
  switch (end) {
    case halfway_buffer_full:
      return differs("the hardware draws more fragments than its triangles have");
    case halfway_hang:
      return differs("the hardware hangs: no progress within the idle limit");
    case halfway_fault:
      return differs("the hardware reports a fault");
    default:
      return tool_failed("the hardware module ends with the unknown status " + std::to_string(end));
  }
}

/// The hardware module of the page.
class HardwareModule final : public Engine {
 public:
  explicit HardwareModule(const HardwareKey& key) : golden_(make_golden_model(key)) {}

  EngineKind kind() const override { return EngineKind::lanes; }
  Result<std::shared_ptr<Engine>> another() const override { return tool_failed("there is one module"); }

  Status draw(std::span<const std::uint32_t> init_words, std::uint64_t most,
              const OnDrawn& on_drawn) override {
    const std::vector<std::uint32_t> units = units_of(*golden_, init_words);
    const int end = hardware_draw(init_words.data(), static_cast<std::uint32_t>(init_words.size()),
                                  units.data(), static_cast<std::uint32_t>(units.size()),
                                  static_cast<std::uint32_t>(std::min<std::uint64_t>(most, UINT32_MAX)));
    if (end != halfway_done) return fault_of(end);
    fragments_.resize(hardware_count());
    hardware_take(fragments_.data());
    on_drawn(fragments_);
    return Ok{};
  }
  /// A draw has output all its fragments.
  Status drain(std::uint64_t, const OnDrawn&) override {
    hardware_reset();
    return Ok{};
  }
  std::optional<std::uint64_t> cycles() const override { return std::nullopt; }

  static Result<Observation> observe(std::span<const std::uint32_t> init_words, const ShaderStages& stages,
                                     std::uint64_t most) {
    const int end = hardware_observe(init_words.data(), static_cast<std::uint32_t>(init_words.size()),
                                     static_cast<std::uint32_t>(most));
    std::vector<std::uint32_t> words(hardware_trace_words());
    hardware_take_trace(words.data());
    std::string fault;
    if (end == halfway_buffer_full)
      fault = "the hardware draws more fragments or takes more clocks than are recorded";
    else if (end != halfway_done)
      fault = fault_of(end).message;
    return Observation{word_trace(stages.parts(), std::move(words)), fault};
  }

 private:
  std::unique_ptr<GoldenModel> golden_;
  std::vector<Fragment> fragments_;
};

struct Core {
  LiveFrame frame{[] { return 1e-3 * browser_now(); }};
  std::optional<HardwareModule> hardware;
  std::vector<std::uint8_t> input, pixels;
  Settings settings;
  std::array<double, c_figure_names.size()> figures{};
  std::string text;

  /// Keeps an error's message, and returns its code.
  int report(const Status& status) {
    text = status ? std::string() : status.error().message;
    return static_cast<int>(status ? ExitCode::equal : status.error().code);
  }

  void write_figures() {
    const Figures& f = frame.figures();
    const auto number = [](std::uint64_t value) { return static_cast<double>(value); };
    figures = {number(f.fragments),
               number(f.mismatches),
               number(f.setup.triangles),
               number(f.setup.leaves),
               number(f.words),
               f.hardware_clocks ? number(*f.hardware_clocks) : -1.0,
               f.error ? f.error->rms : -1.0,
               f.error ? double(f.error->max_lsb) : -1.0,
               1e3 * f.seconds.setup,
               1e3 * f.seconds.golden,
               1e3 * f.seconds.rtl,
               1e3 * f.seconds.compare};
  }
};

/// The one object of the module, made with the first call.
Core& core() {
  static Core one;
  return one;
}

}  // namespace
}  // namespace halfway::live

using namespace halfway;
using live::core;

HALFWAY_EXPORT(live_input) std::uint8_t* live_input(std::uint32_t bytes) {
  core().input.resize(bytes);
  return core().input.data();
}

HALFWAY_EXPORT(live_scene)
int live_scene(std::uint32_t name_bytes, std::uint32_t text_bytes, double tessellation) {
  auto& c = core();
  const std::string_view input(reinterpret_cast<const char*>(c.input.data()), c.input.size());
  c.hardware.reset();
  const int code =
      c.report(c.frame.load(input.substr(0, name_bytes), input.substr(name_bytes, text_bytes), tessellation));
  c.input = {};
  return code;
}

/// `tables`: place of the size of the cosine tables in cosine_sizes(); 0: the preset's.
HALFWAY_EXPORT(live_plan)
int live_plan(int shader, int preset, unsigned tables) {
  auto& c = core();
  c.hardware.reset();
  PlanRequest request{.shader = static_cast<Shader>(shader), .preset = static_cast<Preset>(preset)};
  const auto sizes = cosine_sizes(request.preset);
  if (tables >= sizes.size()) return c.report(bad_input("the preset has no cosine tables of this size"));
  if (tables > 0) request.tables = sizes[tables];
  const auto key = c.frame.plan(request);
  if (!key) return c.report(key.error());
  c.hardware.emplace(*key);
  c.text = key->name();
  return 0;
}

HALFWAY_EXPORT(live_settings) double* live_settings() {
  return &core().settings.width;
}

HALFWAY_EXPORT(live_draw) int live_draw() {
  auto& c = core();
  if (!c.hardware) return c.report(bad_input("no hardware is planned for a scene"));
  const int code = c.report(c.frame.draw(c.settings, *c.hardware));
  c.write_figures();
  return code;
}

HALFWAY_EXPORT(live_reference) int live_reference() {
  const int code = core().report(core().frame.draw_reference());
  core().write_figures();
  return code;
}

/// The text is lines_of() of the way of a pixel.
HALFWAY_EXPORT(live_way) int live_way(std::uint32_t x, std::uint32_t y) {
  auto& c = core();
  if (!c.hardware) return c.report(bad_input("no hardware is planned for a scene"));
  const auto way = c.frame.way({x, y}, live::HardwareModule::observe);
  if (!way) return c.report(way.error());
  c.text = live::lines_of(*way);
  return 0;
}

HALFWAY_EXPORT(live_pixels) const std::uint8_t* live_pixels(int kind) {
  auto& c = core();
  const auto picture = c.frame.picture(static_cast<live::Picture>(kind));
  if (!picture) {
    c.report(picture.error());
    return nullptr;
  }
  c.pixels.assign(4 * picture->pixels(), 255);
  for (std::size_t i = 0; i < picture->pixels(); ++i)
    std::copy_n(picture->rgb.begin() + static_cast<std::ptrdiff_t>(3 * i), 3,
                c.pixels.begin() + static_cast<std::ptrdiff_t>(4 * i));
  return c.pixels.data();
}

HALFWAY_EXPORT(live_figures) const double* live_figures() {
  return core().figures.data();
}

HALFWAY_EXPORT(live_text) const char* live_text() {
  return core().text.data();
}

HALFWAY_EXPORT(live_text_size) std::uint32_t live_text_size() {
  return static_cast<std::uint32_t>(core().text.size());
}
