// SPDX-License-Identifier: Apache-2.0
// For tests: the vectors of a scene by its setup, and their fragments by the golden model.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "frame/assemble.hpp"
#include "golden_run/golden_run.hpp"
#include "setup/setup.hpp"

namespace halfway {

struct Drawn {
  std::vector<std::uint32_t> words;
  std::size_t vector_words = 0;
  SetupCounts counts;
  std::vector<Fragment> fragments;
  bool fault = false;
};

/// Draws the words with the golden model. Returns the bits of its vectors.
inline unsigned draw_words(const HardwareKey& key, Drawn& drawn) {
  const auto model = make_golden_model(key);
  drawn.vector_words = (model->init_bits() + 31) / 32;
  model->draw(drawn.words, drawn.fragments);
  drawn.fault = model->fault();
  return model->init_bits();
}

inline Drawn draw(const Scene& scene, FrameSize size, const HardwareKey& key,
                  const SetupOptions& options = {}) {
  const auto setup = make_setup(scene, size, key, options);
  Drawn drawn;
  setup->append_prologue(drawn.words, drawn.counts);
  setup->append_all(drawn.words, drawn.counts);
  EXPECT_EQ(setup->init_bits(), draw_words(key, drawn));
  EXPECT_EQ(drawn.words.size(), (drawn.counts.vectors + drawn.counts.records) * drawn.vector_words);
  return drawn;
}

inline Frame frame_of(const Scene& scene, FrameSize size, const std::vector<Fragment>& fragments) {
  FrameAssembler assembler(size, scene.background);
  EXPECT_TRUE(assembler.add(fragments));
  return assembler.frame();
}

}  // namespace halfway
