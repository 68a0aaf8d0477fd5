// SPDX-License-Identifier: Apache-2.0
#include "golden_run/object_count.hpp"

#include <cstddef>

#include "golden/object_front.hpp"

namespace halfway {
namespace {

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

std::uint64_t count_objects(const HardwareKey& key, std::span<const std::uint32_t> init_words) {
  return key.preset == Preset::exact ? count<words::Exact>(key, init_words)
                                     : count<words::Published>(key, init_words);
}

}  // namespace halfway
