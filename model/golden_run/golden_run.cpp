// SPDX-License-Identifier: Apache-2.0
#include "golden_run/golden_run.hpp"

#include <algorithm>

#include "golden_run/shader_model.hpp"

namespace halfway {
namespace {

template <class Formats>
std::unique_ptr<GoldenModel> make(const HardwareKey& key) {
  if (key.shader == Shader::spherical) return make_shader_model<Formats, Shader::spherical>(key);
  if (key.shader == Shader::processors) return make_shader_model<Formats, Shader::processors>(key);
  return make_shader_model<Formats, Shader::quadratic>(key);
}

template <class Formats>
std::uint64_t count(const HardwareKey& key, std::span<const std::uint32_t> init_words) {
  const words::ProcessorsConfig config = processors_config(key);
  const auto vector_words =
      static_cast<std::size_t>(words::ProcessorsLayout<Formats>(config).init_bits() + 31) / 32;
  golden::ObjectFront<Formats> front(config, static_cast<int>(key.processors.subpixels),
                                     static_cast<int>(key.processors.objects));
  std::uint64_t objects = 0;
  for (; init_words.size() >= vector_words; init_words = init_words.subspan(vector_words))
    front.take(init_words, [&](const auto& token, std::uint32_t, bool) {
      objects += token.command == words::Command::new_object;
    });
  return objects;
}

}  // namespace

std::span<const std::uint32_t> GoldenModel::take_group(std::span<const std::uint32_t>& init_words) const {
  const std::size_t words = group(init_words) * ((init_bits() + 31) / 32);
  const auto triangle = init_words.first(std::min(words, init_words.size()));
  init_words = init_words.subspan(triangle.size());
  return triangle;
}

std::uint64_t GoldenModel::all_pixels(std::span<const std::uint32_t> init_words) const {
  std::uint64_t sum = 0;
  while (!init_words.empty()) sum += pixels(take_group(init_words));
  return sum;
}

std::span<const Fragment> GoldenModel::draw_next(std::span<const std::uint32_t>& init_words,
                                                 std::size_t count) {
  drawn_.clear();
  while (drawn_.size() < count && !init_words.empty()) draw(take_group(init_words), drawn_);
  return drawn_;
}

std::unique_ptr<GoldenModel> make_golden_model(const HardwareKey& key) {
  return key.preset == Preset::exact ? make<words::Exact>(key) : make<words::Published>(key);
}

std::uint64_t count_objects(const HardwareKey& key, std::span<const std::uint32_t> init_words) {
  return key.preset == Preset::exact ? count<words::Exact>(key, init_words)
                                     : count<words::Published>(key, init_words);
}

}  // namespace halfway
