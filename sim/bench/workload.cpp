// SPDX-License-Identifier: Apache-2.0
#include "sim/bench/workload.hpp"

#include <fmt/format.h>
#include <malloc.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <numbers>
#include <numeric>
#include <string>

#include "common/to_integer.hpp"
#include "golden_run/golden_run.hpp"
#include "scene/builtin_meshes.hpp"
#include "scene/camera.hpp"
#include "scene/lights.hpp"
#include "setup/spherical_setup.hpp"
#include "sim/run/rtl_frame.hpp"
#include "sim/run/scene_stream.hpp"
#include "sim/system/file.hpp"
#include "sim/system/seconds.hpp"
#include "sim/system/threads.hpp"

namespace halfway {
namespace {

/// Memory of this process in bytes: now, or the maximum since the last call of forget_peak.
std::uint64_t memory_bytes(const char* what) {
  const auto text = read_file("/proc/self/status");
  if (!text) return 0;
  const std::size_t at = text->find(what);
  return at == std::string::npos
             ? 0
             : 1024 * std::strtoull(text->c_str() + at + std::char_traits<char>::length(what), nullptr, 10);
}
std::uint64_t resident_bytes() {
  return memory_bytes("VmRSS:");
}
std::uint64_t peak_bytes() {
  return memory_bytes("VmHWM:");
}
void forget_peak() {
  if (std::FILE* file = std::fopen("/proc/self/clear_refs", "w")) {
    std::fputs("5", file);
    std::fclose(file);
  }
}

// Before a measurement the process draws for this many seconds, or a whole frame. So the measured frame is
// like every frame of `make view` except the first.
constexpr double c_warm_seconds = 0.25;

/// With what a host computes once per scene: the bells of the spherical shader.
SetupOptions setup_of(const Scene& scene, const HardwareKey& key) {
  SetupOptions options;
  if (key.shader == Shader::spherical && key.preset == Preset::exact)
    options.spherical.bells = std::make_shared<const Bells>(fitted_bells(scene));
  return options;
}

/// Draws the scene. The memory of `rtl` is used again. Calls `between` between the batches. Stops when the
/// drawing has taken `most_seconds` of processor time.
Status draw_scene(const Scene& scene, FrameSize size, const HardwareKey& key, const SetupOptions& options,
                  RtlFrame& rtl, const std::function<void()>& between, double most_seconds, FrameCost& cost) {
  const double setup_start = thread_seconds();
  const std::unique_ptr<Setup> setup = make_setup(scene, size, key, options);
  const double clear_start = thread_seconds();
  cost.setup = clear_start - setup_start;
  rtl.clear();
  const double clear_seconds = thread_seconds() - clear_start;
  SceneStream stream(*setup, key, 1, {.golden = false, .ahead = false});
  const auto drawing = [&] {
    const RtlFrame::Seconds s = rtl.seconds();
    cost.golden = s.golden;
    cost.rtl = s.rtl;
    cost.compare = s.compare;
    cost.assemble = clear_seconds + s.assemble;
    return cost.drawing();
  };
  for (Batch batch; drawing() + stream.setup_seconds() < most_seconds && stream.next(batch); between())
    if (Status added = rtl.add(batch.init_words); !added) return added;
  if (Status ended = rtl.finish(); !ended) return ended;
  drawing();
  between();
  const SimulatorRun run = rtl.result();
  if (!run.fault.empty()) return Error{ExitCode::differs, run.fault};
  cost.fragments = run.fragments;
  cost.mismatches = run.mismatches;
  cost.setup += stream.setup_seconds();
  cost.vectors = stream.counts().vectors;
  cost.records = stream.counts().records;
  return Ok{};
}

Status draw_frame_here(const std::function<Scene()>& make_scene, FrameSize size, const HardwareKey& key,
                       const std::shared_ptr<Engine>& engine, const InitBatches& pace, FrameCost& cost) {
  const Scene scene = make_scene();
  const std::unique_ptr<GoldenModel> pacer = make_golden_model(pace.key);
  std::vector<Fragment> paced;
  std::vector<double> paces;
  const auto take_pace = [&] {
    // Draw twice and time the second: a large frame evicts the pace's data from the caches.
    double start = 0.0;
    for (int i = 0; i < 2; ++i) {
      start = thread_seconds();
      paced.clear();
      pacer->draw(pace.words, paced);
    }
    paces.push_back(thread_seconds() - start);
  };
  take_pace();
  ::malloc_trim(0);
  forget_peak();
  const std::uint64_t before = resident_bytes();
  const SetupOptions options = setup_of(scene, key);
  RtlFrame rtl(engine, size, scene.background, {.golden = make_golden_model(key)});
  FrameCost first;
  if (Status status = draw_scene(
          scene, size, key, options, rtl, [] {}, c_warm_seconds, first);
      !status)
    return status;
  if (Status status = draw_scene(scene, size, key, options, rtl, take_pace,
                                 std::numeric_limits<double>::infinity(), cost);
      !status)
    return status;
  cost.triangles = scene.triangles.size();
  cost.pace = std::accumulate(paces.begin(), paces.end(), 0.0) / static_cast<double>(paces.size());
  cost.best_pace = *std::ranges::min_element(paces);
  const std::uint64_t peak = peak_bytes();
  cost.memory_bytes = peak > before ? peak - before : 0;
  return Ok{};
}

}  // namespace

Scene sphere_scene(std::uint64_t triangles) {
  // 2 slices (stacks - 1), at most the requested number. Pieces at the equator are almost square.
  const auto n = static_cast<double>(triangles);
  const auto stacks = std::max(2U, to_integer<std::uint32_t>(0.5 + std::sqrt(0.25 + 0.25 * n)));
  const auto slices = std::max(3U, static_cast<std::uint32_t>(triangles / (2 * (stacks - 1))));
  Mesh mesh = make_uv_sphere(slices, stacks, 1.0);
  Scene scene;
  scene.name = fmt::format("sphere-{}", mesh.triangles.size());
  scene.ambient = glm::dvec3(0.5);
  scene.directional.push_back({glm::normalize(glm::dvec3(-0.5, 0.6, 1.0)), glm::dvec3(1.0)});
  Material material;
  material.name = "red";
  material.colour = {0.85, 0.2, 0.15};
  scene.materials.push_back(material);
  scene.positions_world = std::move(mesh.positions);
  scene.normals_world = std::move(mesh.normals);
  scene.triangles = std::move(mesh.triangles);
  for (SceneTriangle& triangle : scene.triangles) triangle.material = 0;
  scene.camera = fit_camera(bounding_sphere(scene), {0.3, 0.4, 1.0});
  return scene;
}

Scene many_spheres(std::uint64_t triangles) {
  constexpr std::uint64_t c_each = 1000, c_side = 12, c_places = c_side * c_side;
  constexpr double c_spacing = 2.2;  // radii
  const Scene one = sphere_scene(c_each);
  Scene scene = one;
  scene.name = fmt::format("spheres-{}", triangles);
  scene.positions_world.clear();
  scene.triangles.clear();
  for (std::uint64_t i = 0; i < triangles / c_each; ++i) {
    const std::uint64_t place = i * 61 % c_places;  // scattered
    const std::uint64_t column = place % c_side, row = place / c_side, layer = i / c_places;
    // Spheres at one place almost coincide, so that all have the same size.
    const glm::dvec3 centre(c_spacing * (static_cast<double>(column) - 0.5 * (c_side - 1)),
                            c_spacing * (static_cast<double>(row) - 0.5 * (c_side - 1)),
                            -0.02 * static_cast<double>(layer));
    const auto first = static_cast<std::uint32_t>(scene.positions_world.size());
    for (const glm::dvec3& position : one.positions_world) scene.positions_world.push_back(position + centre);
    for (SceneTriangle triangle : one.triangles) {
      for (std::uint32_t& position : triangle.position) position += first;
      scene.triangles.push_back(triangle);
    }
  }
  scene.camera = {};
  scene.camera.vertical_fov_degrees = 10.0;
  scene.camera.eye_world = {0.0, 0.0, 0.5 * c_side * c_spacing / std::tan(std::numbers::pi / 36.0)};
  return scene;
}

Scene with_lights(Scene scene, unsigned lights) {
  clear_lights(scene);
  for (unsigned i = 0; i < lights; ++i) {
    const double turn = 2.0 * std::numbers::pi * i / lights;
    scene.directional.push_back(
        {glm::normalize(glm::dvec3(std::cos(turn), std::sin(turn), 1.0)), glm::dvec3(1.0 / lights)});
  }
  return scene;
}

Result<InitBatches> make_batches(const Scene& scene, FrameSize size, const PlanRequest& plan, bool draw) {
  const auto planned = plan_scene(scene, plan);
  if (!planned) return planned.error();
  InitBatches all;
  all.key = planned->key;
  const std::unique_ptr<Setup> setup = make_setup(scene, size, all.key, {});
  all.init_bits = setup->init_bits();
  SceneStream source(*setup, all.key, 1, {.golden = draw});
  for (Batch batch; source.next(batch);) {
    all.words.insert(all.words.end(), batch.init_words.begin(), batch.init_words.end());
    all.golden.insert(all.golden.end(), batch.golden.begin(), batch.golden.end());
  }
  const std::unique_ptr<GoldenModel> golden = make_golden_model(all.key);
  std::size_t vectors = 0;
  for (auto rest = std::span<const std::uint32_t>(all.words); !rest.empty();) {
    const std::size_t triangle = golden->group(rest);
    rest = rest.subspan(triangle * all.words_per_vector());
    vectors += triangle;
    if (vectors < c_batch && !rest.empty()) continue;
    all.batches.push_back(vectors);
    vectors = 0;
  }
  return all;
}

Result<FrameCost> draw_frame(const std::function<Scene()>& make_scene, FrameSize size, const HardwareKey& key,
                             const std::shared_ptr<Engine>& engine, const InitBatches& pace) {
  int ends[2];
  if (::pipe(ends) != 0) return tool_failed("no pipe");
  const pid_t child = ::fork();
  if (child < 0) return tool_failed("no process");
  if (child == 0) {
    FrameCost cost;
    const Status drawn = draw_frame_here(make_scene, size, key, engine, pace, cost);
    if (!drawn) fmt::print(stderr, "{}\n", drawn.error().message);
    const bool sent = drawn && ::write(ends[1], &cost, sizeof cost) == sizeof cost;
    ::_exit(sent ? 0 : 1);
  }
  ::close(ends[1]);
  FrameCost cost;
  const bool received = ::read(ends[0], &cost, sizeof cost) == sizeof cost;
  ::close(ends[0]);
  int status = 0;
  ::waitpid(child, &status, 0);
  if (!received || status != 0) return tool_failed(fmt::format("{}: a frame was not drawn", key.name()));
  return cost;
}

Result<double> frame_rate(const Scene& scene, FrameSize size, const HardwareKey& key,
                          std::span<const std::shared_ptr<Engine>> engines, std::size_t frames) {
  const SetupOptions options = setup_of(scene, key);
  std::vector<RtlFrame> pictures;
  for (const std::shared_ptr<Engine>& engine : engines)
    pictures.emplace_back(engine, size, scene.background, RtlFrameOptions{.golden = make_golden_model(key)});
  const auto draw_with = [&](RtlFrame& rtl) -> Status {
    FrameCost cost;
    const double no_end = std::numeric_limits<double>::infinity();
    if (Status drawn = draw_scene(
            scene, size, key, options, rtl, [] {}, no_end, cost);
        !drawn)
      return drawn;
    if (cost.mismatches != 0) return Error{ExitCode::differs, key.name() + ": the RTL differs"};
    return Ok{};
  };
  // Draw one frame with each engine, which is not timed.
  const auto threads = static_cast<unsigned>(pictures.size());
  const auto draw_one = [&](std::size_t i) { return draw_with(pictures[i]); };
  if (Status drawn = for_each_on_threads(threads, pictures.size(), draw_one); !drawn) return drawn.error();
  // Each engine draws the next frame until all are drawn.
  std::atomic<std::size_t> next_frame = 0;
  const auto draw_rest = [&](std::size_t i) -> Status {
    while (next_frame++ < frames)
      if (Status drawn = draw_with(pictures[i]); !drawn) return drawn;
    return Ok{};
  };
  const auto start = std::chrono::steady_clock::now();
  if (Status drawn = for_each_on_threads(threads, pictures.size(), draw_rest); !drawn) return drawn.error();
  return static_cast<double>(frames) / seconds_since(start);
}

WalkCounts count_walk(const InitBatches& batches) {
  WalkCounter counter(batches.key);
  counter.add(batches.words);
  return counter.counts();
}

double Fit::at(const Terms& row) const {
  return std::inner_product(factors.begin(), factors.end(), row.begin(), 0.0);
}

Fit fit(const std::vector<Terms>& rows, std::span<const double> t) {
  // Fit 1 = the sum of factors times terms / t. Make the columns orthogonal, one after the other.
  const std::size_t terms = rows.empty() ? 0 : rows.front().size();
  std::vector<Terms> columns(terms + 1, Terms(rows.size(), 1.0));  // the last column is the right side
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t k = 0; k < terms; ++k) columns[k][i] = rows[i][k] / t[i];
  const auto product = [&](std::size_t a, std::size_t b) {
    return std::inner_product(columns[a].begin(), columns[a].end(), columns[b].begin(), 0.0);
  };
  // The component along column k of each later column.
  std::vector<Terms> parts(terms, Terms(terms + 1, 0.0));
  for (std::size_t k = 0; k < terms; ++k) {
    const double before = std::inner_product(
        rows.begin(), rows.end(), t.begin(), 0.0, std::plus<>(),
        [&](const Terms& row, double seconds) { return row[k] / seconds * (row[k] / seconds); });
    const double length = product(k, k);
    if (!(length > 1e-12 * before)) return {};
    for (std::size_t next = k + 1; next <= terms; ++next) {
      parts[k][next] = product(k, next) / length;
      for (std::size_t i = 0; i < rows.size(); ++i) columns[next][i] -= parts[k][next] * columns[k][i];
    }
  }
  Fit found;
  found.factors.resize(terms);
  for (std::size_t k = terms; k-- > 0;) {
    found.factors[k] = parts[k][terms];
    for (std::size_t next = k + 1; next < terms; ++next)
      found.factors[k] -= parts[k][next] * found.factors[next];
  }
  for (std::size_t i = 0; i < rows.size(); ++i)
    found.largest_deviation = std::max(found.largest_deviation, std::abs(t[i] / found.at(rows[i]) - 1.0));
  return found;
}

}  // namespace halfway
