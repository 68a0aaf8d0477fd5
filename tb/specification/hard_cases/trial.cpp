// SPDX-License-Identifier: Apache-2.0
#include "specification/hard_cases/trial.hpp"

#include <fmt/format.h>

#include <cmath>

#include "golden_run/golden_run.hpp"
#include "sim/driver/limits.hpp"
#include "sim/driver/stream_comparator.hpp"
#include "sim/engines/ghdl/ghdl_runner.hpp"
#include "sim/files/init_file.hpp"
#include "sim/files/trace.hpp"
#include "sim/os/file.hpp"
#include "words/init_vector.hpp"

namespace halfway::stability {
namespace {

// What GHDL draws in minutes.
constexpr std::size_t c_most_for_ghdl = 4000;
constexpr unsigned c_most_lights_for_ghdl = 3;

bool is_for_ghdl(const HardwareKey& key, std::size_t fragments) {
  return fragments <= c_most_for_ghdl &&
         (key.shader != Shader::processors || key.processors.lights() <= c_most_lights_for_ghdl);
}

// The shading processors keep lights between streams. These words delete them, as after a reset.
std::vector<std::uint32_t> forget_lights(const HardwareKey& key, unsigned words_each) {
  using Request = words::Exact::request_header_at;
  static_assert(words::Exact::c_request_header_bits == words::Published::c_request_header_bits);
  std::vector<std::uint32_t> words;
  const auto command = [&](words::Command c, std::uint32_t light) {
    InitVector vector(words, 32 * words_each);
    vector.put(Request::command, static_cast<std::uint32_t>(c));
    vector.put(Request::light, light);
  };
  for (std::uint32_t light = 0; light <= key.processors.lights(); ++light)
    command(words::Command::remove, light);
  command(words::Command::new_frame, 0);
  return words;
}

}  // namespace

void Worst::add(double next, double next_bound, const std::function<std::string()>& where_of) {
  ++count;
  // Compares the figures relative to their bounds, without a division by a bound of 0.
  const auto nearer = [&] {
    if (!std::isfinite(figure)) return false;
    if (within() != (next <= next_bound)) return within();
    return !(next * bound <= figure * next_bound) || (bound == 0.0 && !(next <= figure));
  };
  if (count > 1 && !nearer()) return;
  figure = next;
  bound = next_bound;
  where = where_of();
}

std::string refutation(bool is_silent, const Worst& ours, const Worst& published) {
  const auto told = [](const Worst& worst) {
    return fmt::format("{:.4g} of {:.4g} at {}", worst.figure, worst.bound, worst.where);
  };
  if (ours.count == 0) return "has no figure";
  if (!ours.within()) return told(ours);
  if (is_silent)
    return published.count == 0 ? "" : "has a figure of the published form, but is listed without one";
  if (published.count == 0) return "has no figure of the published form";
  return published.within() ? "the published form does not break: " + told(published) : "";
}

Result<Drawing> draw_golden(const Scene& scene, const DrawOptions& options) {
  const auto plan = plan_scene(scene, options.plan);
  if (!plan) return plan.error();
  auto stream = whole_stream(scene, options.frame, plan->key, {.setup = options.setup, .check = false});
  if (!stream) return stream.error();
  return Drawing{std::move(*stream), plan->key};
}

Drawing Trial::draw(const Scene& scene, const DrawOptions& options) {
  Result<Drawing> drawing = draw_golden(scene, options);
  if (!drawing) {
    require(false, [&] { return drawing.error().message; });
    return {};
  }
  if (options.in_rtl)
    compare_rtl(drawing->key, drawing->init_bits, drawing->words, drawing->golden, drawing->fault);
  return std::move(*drawing);
}

std::vector<Fragment> Trial::draw(const HardwareKey& key, std::span<const std::uint32_t> words) {
  const auto golden = make_golden_model(key);
  std::vector<Fragment> fragments;
  golden->draw(words, fragments);
  compare_rtl(key, golden->init_bits(), words, fragments, golden->fault());
  return fragments;
}

void Trial::compare_rtl(const HardwareKey& key, unsigned init_bits, std::span<const std::uint32_t> words,
                        std::span<const Fragment> golden, bool fault) {
  golden_fragments_ += golden.size();
  if (!tools_ || words.empty()) return;
  const auto compare = [&](std::string_view name, const Status& status, std::span<const Fragment> drawn) {
    if (!status && status.error().code == ExitCode::tool_failed) {
      tools_ = status;
      return;
    }
    rtl_fragments_ += drawn.size();
    require(bool(status) != fault, [&] {
      return fault ? fmt::format("{}: {} reports no fault, but the golden model does", key.name(), name)
                   : fmt::format("{}: {}: {}", key.name(), name, status.error().message);
    });
    if (fault) return;  // after a fault the fragments have no meaning
    StreamComparator comparator;
    comparator.add(golden, drawn);
    comparator.finish();
    require(comparator.mismatches() == 0,
            [&] { return fmt::format("{}: {}", key.name(), comparator.describe(name)); });
  };
  std::vector<Fragment> drawn;
  const std::size_t most = golden.size() + c_most_surplus;
  const Status verilated = run_verilator(key, init_bits, words, drawn, most);
  compare("Verilator", verilated, drawn);
  if (quick_ || !is_for_ghdl(key, golden.size()) || !rtl_.through_ghdl.insert(key.name()).second) return;
  drawn.clear();
  const Status simulated = run_ghdl(key, init_bits, words, drawn, most);
  compare("GHDL", simulated, drawn);
}

Status Trial::run_verilator(const HardwareKey& key, unsigned init_bits, std::span<const std::uint32_t> words,
                            std::vector<Fragment>& drawn, std::size_t most) {
  auto found = rtl_.verilated.find(key.name());
  if (found == rtl_.verilated.end()) {
    auto opened = VerilatorSimulator::open(key, folders_);
    if (!opened) return opened.error();
    found = rtl_.verilated.emplace(key.name(), std::move(*opened)).first;
  }
  VerilatorSimulator& rtl = found->second;
  Status status = Ok{};
  if (key.shader == Shader::processors)
    status = rtl.run(forget_lights(key, (init_bits + 31) / 32), drawn, most);
  if (status) status = rtl.run(words, drawn, most);
  if (status) status = rtl.finish(drawn, most);
  if (!status) rtl_.verilated.erase(found);  // its state is undefined
  return status;
}

Status Trial::run_ghdl(const HardwareKey& key, unsigned init_bits, std::span<const std::uint32_t> words,
                       std::vector<Fragment>& drawn, std::size_t most) {
  auto folder = TemporaryFolder::make(folders_.cache);
  if (!folder) return folder.error();
  const auto init = folder->path() / "init.txt", trace = folder->path() / "ghdl.trace";
  if (auto written = write_init_file(init, key.name(), {init_bits, {words.begin(), words.end()}}); !written)
    return written.error();
  const auto runner = GhdlRunner::open(key, folders_);
  if (!runner) return runner.error();
  const auto run = runner->run(
      init, trace, {.max_fragments = static_cast<std::uint32_t>(most), .idle_limit = c_idle_limit});
  if (!run) return run.error();
  auto read = read_trace(trace, key.name());
  if (!read) return read.error();
  drawn = std::move(read->fragments);
  return Ok{};
}

}  // namespace halfway::stability
