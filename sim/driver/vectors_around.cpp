// SPDX-License-Identifier: Apache-2.0
#include "sim/driver/vectors_around.hpp"

#include "words/processors_layout.hpp"

namespace halfway {
namespace {

constexpr std::size_t c_around = 2;

// Vectors of the shading processors that define a state.
bool is_load(const HardwareKey& key, std::span<const std::uint32_t> vector) {
  return key.shader == Shader::processors && words::is_load(words::command_of<words::Exact>(vector));
}

}  // namespace

void VectorsAround::add(std::span<const std::uint32_t> words, std::size_t count, bool wanted) {
  Triangle triangle{std::exchange(next_, next_ + count), {words.begin(), words.end()}};
  if (is_load(key_, words)) {
    kept_.push_back(std::move(triangle));
    return;
  }
  if (!wanted && after_ == 0) {
    before_.push_back(std::move(triangle));
    if (before_.size() > c_around) before_.pop_front();
    return;
  }
  for (Triangle& earlier : before_) kept_.push_back(std::move(earlier));
  before_.clear();
  kept_.push_back(std::move(triangle));
  any_wanted_ = any_wanted_ || wanted;
  after_ = wanted ? c_around : after_ - 1;
}

void VectorsAround::finish() {
  if (any_wanted_) return;
  for (Triangle& last : before_) kept_.push_back(std::move(last));
  before_.clear();
}

std::vector<std::uint32_t> VectorsAround::words() const {
  std::vector<std::uint32_t> all;
  for (const Triangle& triangle : kept_) all.insert(all.end(), triangle.words.begin(), triangle.words.end());
  return all;
}

}  // namespace halfway
