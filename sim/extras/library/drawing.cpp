// SPDX-License-Identifier: Apache-2.0
// Hardware, init vectors, fragments and frames of the C interface.
#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <optional>
#include <span>
#include <utility>

#include "frame/frame.hpp"
#include "golden_run/golden_run.hpp"
#include "plan/plan.hpp"
#include "setup/quadratic_setup.hpp"
#include "setup/setup.hpp"
#include "setup/walk_header.hpp"
#include "sim/driver/frame_driver.hpp"
#include "sim/extras/library/objects.hpp"

namespace halfway::library {

int write_error(halfway_error* out, ExitCode code, const std::string& text) {
  if (out) {
    out->code = static_cast<int>(code);
    const std::size_t length = std::min(text.size(), sizeof out->text - 1);
    std::memcpy(out->text, text.data(), length);
    out->text[length] = '\0';
  }
  return static_cast<int>(code);
}

Status check_frame(std::uint32_t width, std::uint32_t height) {
  if (width >= 1 && height >= 1 && width <= c_max_frame_side && height <= c_max_frame_side) return Ok{};
  return bad_input(fmt::format("the frame is {}x{}, but each side must be 1 to {} pixels", width, height,
                               c_max_frame_side));
}

namespace {

constexpr int c_subpixel_bits = 4;

static_assert(sizeof(halfway_fragment) == sizeof(Fragment));
static_assert(offsetof(halfway_fragment, z) == offsetof(Fragment, z));
static_assert(offsetof(halfway_fragment, x) == offsetof(Fragment, x));
static_assert(offsetof(halfway_fragment, blue) == offsetof(Fragment, blue));

halfway_hardware hardware_of(const HardwareKey& key, const PlanRequest& request) {
  return {key, request, key.name(), make_golden_model(key)->init_bits()};
}

/// Refuse a scene that needs other hardware. Three channels of the quadratic shader draw every scene.
Status check_hardware(const halfway_hardware& hardware, const Scene& scene) {
  const Result<Plan> plan = plan_scene(scene, hardware.request);
  if (!plan) return plan.error();
  const HardwareKey& key = hardware.key;
  if (plan->key.name() == hardware.name || (key.shader == Shader::quadratic && key.channels == 3))
    return Ok{};
  return bad_input(fmt::format("{}: needs {}, but the hardware is {}; plan it for this scene", scene.name,
                               plan->key.name(), hardware.name));
}

Result<PlanRequest> plan_request(const halfway_request& request) {
  if (request.shader < HALFWAY_QUADRATIC || request.shader > HALFWAY_PROCESSORS)
    return bad_input(fmt::format("request: shader {} is not one of halfway_shader", request.shader));
  if (request.preset < HALFWAY_EXACT || request.preset > HALFWAY_PUBLISHED)
    return bad_input(fmt::format("request: preset {} is not one of halfway_preset", request.preset));
  if (request.degree < 0 || request.degree > 2)
    return bad_input(fmt::format("request: degree {} is not 1 or 2", request.degree));
  PlanRequest plan{.shader = static_cast<Shader>(request.shader),
                   .preset = static_cast<Preset>(request.preset),
                   .all_effects = request.all_effects != 0};
  if (request.degree != 0) plan.degree = request.degree;
  return plan;
}

Result<SetupOptions> setup_options(const halfway_setup& setup, Preset preset) {
  constexpr HighlightTest c_tests[] = {HighlightTest::none, HighlightTest::centroid,
                                       HighlightTest::conservative};
  SetupOptions options;
  if (setup.highlight_test < HALFWAY_TEST_OF_PRESET || setup.highlight_test > HALFWAY_TEST_CONSERVATIVE)
    return bad_input(
        fmt::format("setup: highlight_test {} is not one of halfway_highlight_test", setup.highlight_test));
  if (setup.highlight_test != HALFWAY_TEST_OF_PRESET)
    options.quadratic.test = c_tests[setup.highlight_test - HALFWAY_TEST_NONE];
  else if (preset == Preset::published)
    options.quadratic.test = HighlightTest::centroid;
  else
    options.quadratic.test = HighlightTest::conservative;
  if (setup.threshold == 0.0) return options;
  if (!(setup.threshold > 0.0) || !std::isfinite(setup.threshold))
    return bad_input(fmt::format("setup: threshold is {}; give a number above 0", setup.threshold));
  options.quadratic.threshold = options.spherical.threshold = setup.threshold;
  return options;
}

Status check_triangle(const halfway_screen_triangle& triangle, std::size_t index, const HardwareKey& key) {
  const auto refuse = [&](const char* what, double value) {
    return bad_input(fmt::format("screen triangle {}: {} is {}", index, what, value));
  };
  const auto in = [](double value, double low, double high) { return value >= low && value <= high; };
  for (std::size_t i = 0; i < 3; ++i) {
    if (!in(triangle.x[i], c_guard_begin, c_guard_end)) return refuse("an x", triangle.x[i]);
    if (!in(triangle.y[i], c_guard_begin, c_guard_end)) return refuse("a y", triangle.y[i]);
    if (!in(triangle.z[i], 0.0, 1.0)) return refuse("a depth", triangle.z[i]);
  }
  for (std::size_t i = 0; i < (key.degree == 1 ? 3 : 6); ++i)
    for (std::size_t c = 0; c < key.channels; ++c)
      if (!in(triangle.colour[i][c], 0.0, c_largest_sample)) return refuse("a colour", triangle.colour[i][c]);
  return Ok{};
}

/// Append the vectors of a checked triangle.
void append_triangle(const halfway_screen_triangle& given, const HardwareKey& key, FrameSize frame,
                     std::vector<std::uint32_t>& words) {
  ScreenTriangle triangle{.source = given.number, .material = 0, .vertex = {}};
  for (std::size_t i = 0; i < 3; ++i) {
    ScreenVertex& vertex = triangle.vertex[i];
    vertex.x = static_cast<std::int32_t>(fixed(given.x[i], c_subpixel_bits));
    vertex.y = static_cast<std::int32_t>(fixed(given.y[i], c_subpixel_bits));
    vertex.z = given.z[i];
  }
  // Order the vertices, and with them the midpoints, for a positive area.
  std::array<std::size_t, 6> order = {0, 1, 2, 3, 4, 5};
  if (triangle.twice_area() == 0) return;
  if (triangle.twice_area() < 0) {
    std::swap(triangle.vertex[1], triangle.vertex[2]);
    order = {0, 2, 1, 4, 3, 5};
  }
  ChannelSamples samples{};
  for (std::size_t c = 0; c < key.channels; ++c)
    for (std::size_t i = 0; i < 6; ++i) samples[c][i] = given.colour[order[i]][c];
  const std::array<ScreenPoint, 3> points = screen_points(triangle);
  const DepthFit depth(points, c_subpixel_bits, fixed_depths(triangle));
  append_exact(
      {words, static_cast<int>(key.channels), key.degree},
      {given.number, points, c_subpixel_bits, plan_walks(points, c_subpixel_bits, frame), depth, samples});
}

}  // namespace
}  // namespace halfway::library

using namespace halfway;
using namespace halfway::library;

halfway_hardware* halfway_plan(const halfway_scene* scene, const halfway_request* request,
                               halfway_error* error) {
  return made<halfway_hardware>(error, [&]() -> Result<halfway_hardware> {
    const Result<PlanRequest> wanted = plan_request(request ? *request : halfway_request{});
    if (!wanted) return wanted.error();
    const Result<Plan> plan = plan_scene(scene->scene, *wanted);
    if (!plan) return plan.error();
    return hardware_of(plan->key, *wanted);
  });
}

halfway_hardware* halfway_quadratic(int channels, int degree, halfway_error* error) {
  return made<halfway_hardware>(error, [&]() -> Result<halfway_hardware> {
    if (channels != 1 && channels != 3)
      return bad_input(fmt::format("hardware: {} channels; give 1 or 3", channels));
    if (degree != 1 && degree != 2) return bad_input(fmt::format("hardware: degree {}; give 1 or 2", degree));
    return hardware_of({.channels = static_cast<unsigned>(channels), .degree = degree}, {.degree = degree});
  });
}

const char* halfway_name(const halfway_hardware* hardware) {
  return hardware->name.c_str();
}

unsigned halfway_init_bits(const halfway_hardware* hardware) {
  return hardware->init_bits;
}

size_t halfway_words_per_vector(const halfway_hardware* hardware) {
  return words_per_vector(hardware->init_bits);
}

void halfway_free_hardware(halfway_hardware* hardware) {
  delete hardware;
}

halfway_vectors* halfway_scene_vectors(const halfway_scene* scene, const halfway_hardware* hardware,
                                       uint32_t width, uint32_t height, const halfway_setup* setup,
                                       halfway_error* error) {
  return made<halfway_vectors>(error, [&]() -> Result<halfway_vectors> {
    const HardwareKey& key = hardware->key;
    if (Status status = check_frame(width, height); !status) return status.error();
    if (Status status = check_hardware(*hardware, scene->scene); !status) return status.error();
    const Result<SetupOptions> options = setup_options(setup ? *setup : halfway_setup{}, key.preset);
    if (!options) return options.error();
    Result<FrameStream> stream =
        whole_stream(scene->scene, {width, height}, key, {.setup = *options, .golden = GoldenDraws::nothing});
    if (!stream) return stream.error();
    return halfway_vectors{key, hardware->init_bits, std::move(stream->words)};
  });
}

halfway_vectors* halfway_screen_vectors(const halfway_screen_triangle* triangles, size_t count,
                                        const halfway_hardware* hardware, uint32_t width, uint32_t height,
                                        halfway_error* error) {
  return made<halfway_vectors>(error, [&]() -> Result<halfway_vectors> {
    const HardwareKey& key = hardware->key;
    if (key.shader != Shader::quadratic || key.preset != Preset::exact)
      return bad_input(hardware->name + ": triangles on the screen need hardware of halfway_quadratic");
    if (Status status = check_frame(width, height); !status) return status.error();
    halfway_vectors vectors{key, hardware->init_bits, {}};
    for (std::size_t i = 0; i < count; ++i) {
      if (Status status = check_triangle(triangles[i], i, key); !status) return status.error();
      append_triangle(triangles[i], key, {width, height}, vectors.words);
    }
    return vectors;
  });
}

size_t halfway_vector_count(const halfway_vectors* vectors) {
  return vectors->words.size() / words_per_vector(vectors->init_bits);
}

const uint32_t* halfway_words(const halfway_vectors* vectors) {
  return vectors->words.data();
}

void halfway_free_vectors(halfway_vectors* vectors) {
  delete vectors;
}

halfway_fragments* halfway_draw_golden(const halfway_vectors* vectors, halfway_error* error) {
  return made<halfway_fragments>(error, [&]() -> Result<halfway_fragments> {
    const std::unique_ptr<GoldenModel> golden = make_golden_model(vectors->key);
    const std::span<const Fragment> drawn = golden->draw(vectors->words);
    if (golden->fault()) return bad_input("a pixel has more shadow volumes than the hardware can count");
    halfway_fragments fragments;
    fragments.list.reserve(drawn.size());
    for (const Fragment& fragment : drawn)
      fragments.list.push_back(std::bit_cast<halfway_fragment>(fragment));
    return fragments;
  });
}

size_t halfway_fragment_count(const halfway_fragments* fragments) {
  return fragments->list.size();
}

const halfway_fragment* halfway_fragment_data(const halfway_fragments* fragments) {
  return fragments->list.data();
}

void halfway_free_fragments(halfway_fragments* fragments) {
  delete fragments;
}

halfway_frame* halfway_make_frame(const halfway_scene* scene, uint32_t width, uint32_t height,
                                  halfway_error* error) {
  return made<halfway_frame>(error, [&]() -> Result<halfway_frame> {
    if (Status status = check_frame(width, height); !status) return status.error();
    return halfway_frame{FrameAssembler({width, height}, scene ? scene->scene.background : glm::dvec3(0.0))};
  });
}

int halfway_add_fragments(halfway_frame* frame, const halfway_fragment* fragments, size_t count,
                          halfway_error* error) {
  return done(error, [&]() -> Status {
    std::vector<Fragment> added;
    added.reserve(count);
    for (std::size_t i = 0; i < count; ++i) added.push_back(std::bit_cast<Fragment>(fragments[i]));
    return frame->assembler.add(added);
  });
}

const uint8_t* halfway_rgb(const halfway_frame* frame) {
  return frame->assembler.frame().rgb.data();
}

void halfway_clear_frame(halfway_frame* frame) {
  frame->assembler.clear();
}

void halfway_free_frame(halfway_frame* frame) {
  delete frame;
}
