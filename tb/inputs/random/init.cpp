// SPDX-License-Identifier: Apache-2.0
// Init vectors. A file is read completely or refused. A file that was read, written and read again gives the
// same vectors. For any bits in a vector, the golden model of its hardware draws it and terminates.
#include <algorithm>
#include <memory>
#include <vector>

#include "golden_run/golden_run.hpp"
#include "inputs/random/draw.hpp"
#include "inputs/random/fuzz.hpp"
#include "plan/plan.hpp"
#include "sim/files/init_file.hpp"
#include "words/processors_layout.hpp"
#include "words/word.hpp"

namespace halfway::fuzz {
namespace {

/// Most vectors of an input that are drawn, with line records.
constexpr std::size_t c_most_vectors = 40;
/// Limit of the line counts. A walk of many lines is slow, which is not a fault.
constexpr std::uint64_t c_most_lines = 8;

/// Two lights of each kind, a grey surface with a highlight and a coloured surface.
Scene scene_with_all() {
  Scene scene;
  scene.name = "all";
  scene.shadows = true;
  scene.directional.resize(2);
  scene.positional.resize(2);
  scene.spots.resize(2);
  scene.materials = {{.name = "grey"}, {.name = "red", .colour = {1.0, 0.0, 0.0}, .exponent = 7.0}};
  scene.positions_world = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  scene.normals_world = {{0, 0, 1}};
  for (const std::uint32_t material : {0U, 1U}) scene.triangles.push_back({{0, 1, 2}, {0, 0, 0}, material});
  return scene;
}

/// Every shader in both presets and forms, with all effects and with the fewest.
std::vector<HardwareKey> make_keys() {
  std::vector<HardwareKey> keys;
  Scene all = scene_with_all(), least = scene_with_all();
  least.shadows = false;
  least.positional.clear();
  least.spots.clear();
  least.directional.resize(1);
  least.triangles.resize(1);
  least.materials[0].specular = 0.0;
  for (const Scene* scene : {&all, &least})
    for (const Shader shader : c_shaders)
      for (const Preset preset : {Preset::exact, Preset::published})
        for (const ProcessorForm form : {ProcessorForm::folded, ProcessorForm::unrolled}) {
          PlanRequest request{.shader = shader, .preset = preset, .all_effects = scene == &all};
          if (shader == Shader::processors) request.form = form;
          const auto plan = plan_scene(*scene, request);
          demand(bool(plan), plan ? "" : plan.error().message);
          keys.push_back(plan->key);
        }
  return keys;
}

const std::vector<HardwareKey>& keys() {
  static const std::vector<HardwareKey> c_all = make_keys();
  return c_all;
}

void cut_lines(std::span<std::uint32_t> vector, const HardwareKey& key) {
  const auto cut = [&](const words::Field& field, std::uint64_t least, int low) {
    words::set_bits(vector, field, words::get_bits(vector, field, low) % c_most_lines + least, low);
  };
  const auto cut_exact = [&](int low) {
    cut(words::Exact::init_header_at::upper_lines, 1, low);
    cut(words::Exact::init_header_at::lower_lines, 0, low);
  };
  if (key.shader == Shader::processors)
    key.preset == Preset::exact ? cut_exact(words::ProcessorsLayout<words::Exact>::walk_low())
                                : cut_exact(words::ProcessorsLayout<words::Published>::walk_low());
  else if (key.preset == Preset::exact)
    cut_exact(0);
  else
    cut(words::Published::init_header_at::upper_lines, 1, 0);
}

/// Draws the words as vectors of this hardware, for any width of the words.
void draw(const InitStream& stream, const HardwareKey& key) {
  const auto model = make_golden_model(key);
  const unsigned bits = model->init_bits();
  const std::size_t words = (bits + 31) / 32;
  const std::size_t count = std::min(c_most_vectors, (stream.words.size() + words - 1) / words);
  std::vector<std::uint32_t> vectors(stream.words);
  vectors.resize(count * words);
  // The counts in a header give the number of line records that follow it.
  for (std::size_t first = 0; first < count;) {
    const auto vector = std::span(vectors).subspan(first * words, words);
    if (bits % 32 != 0) vector.back() &= (1U << bits % 32) - 1;
    cut_lines(vector, key);
    first += model->group(vector);
  }
  std::vector<Fragment> fragments;
  model->draw(vectors, fragments);
  for (const Fragment& f : fragments)
    demand(f.x < 4096 && f.y < 4096 && f.z < 1U << 24, "a fragment's fields fit a trace's");
}

}  // namespace
}  // namespace halfway::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace halfway;
  using namespace halfway::fuzz;
  const std::string_view text = text_of(data, size);
  const auto path = write_input("init.txt", text);
  const auto stream = read_init_file(path, {});
  if (!stream) {
    demand_refusal(stream.error());
    demand(stream.error().message.starts_with(path.string() + ":"), "file:line: " + stream.error().message);
    return 0;
  }
  auto reader = InitFileReader::open(path, {});
  demand(bool(reader), "an init file that opens once opens again");
  demand(stream->words.size() == stream->size() * stream->words_per_vector(), "whole vectors");
  const auto copy = folder() / "copy.txt";
  demand(bool(write_init_file(copy, reader->key_name(), *stream)), "writing back");
  const auto again = read_init_file(copy, reader->key_name());
  demand(bool(again) && again->bits == stream->bits && again->words == stream->words,
         "what was written back reads the same");

  bool drawn = false;
  for (const HardwareKey& key : keys()) {
    if (make_golden_model(key)->init_bits() != stream->bits) continue;
    draw(*stream, key);
    drawn = true;
  }
  if (!drawn) draw(*stream, keys()[choice_of(text) % keys().size()]);
  return 0;
}
