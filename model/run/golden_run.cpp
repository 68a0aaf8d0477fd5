// SPDX-License-Identifier: Apache-2.0
#include "run/golden_run.hpp"

#include "golden/quadratic_shader.hpp"

namespace halfway {
namespace {

template <class Shader>
class Model final : public GoldenModel {
 public:
  void draw(std::span<const std::uint32_t> init_words, std::vector<Fragment>& fragments) override {
    for (; init_words.size() >= Shader::c_init_words; init_words = init_words.subspan(Shader::c_init_words))
      shader_.draw(init_words, Room{fragments});
  }
  void draw_probed(std::span<const std::uint32_t> init_words, std::vector<Fragment>& fragments,
                   std::vector<ProbeEvent>& events) override {
    for (; init_words.size() >= Shader::c_init_words; init_words = init_words.subspan(Shader::c_init_words))
      shader_.draw(
          init_words, [&](const Fragment& f) { fragments.push_back(f); }, Watch{events});
  }
  unsigned init_bits() const override { return Shader::c_init_bits; }
  unsigned probe_bits() const override { return Shader::c_probe_bits; }

 private:
  struct Room {
    std::vector<Fragment>& fragments;
    Fragment* room(std::size_t count) {
      fragments.resize(fragments.size() + count);
      return fragments.data() + fragments.size() - count;
    }
  };
  struct Watch {
    std::vector<ProbeEvent>& events;
    void line(const Shader& shader) {
      add(shader, Stage::line, shader.walker().start(), shader.line_probe());
    }
    void span(const Shader& shader, golden::SpanXWord x) {
      add(shader, Stage::span, x, shader.span_probe(x));
    }
    void add(const Shader& shader, Stage stage, golden::SpanXWord x, const auto& words) {
      events.push_back({stage,
                        shader.walker().triangle(),
                        shader.walker().y(),
                        static_cast<std::uint32_t>(golden::low_bits(x.bits(), golden::Exact::c_pixel_x_bits)),
                        {words.begin(), words.end()}});
    }
  };
  Shader shader_;
};

template <class Preset>
std::unique_ptr<GoldenModel> make(unsigned channels) {
  if (channels == 1) return std::make_unique<Model<golden::QuadraticShader<Preset, 1>>>();
  return std::make_unique<Model<golden::QuadraticShader<Preset, 3>>>();
}

}  // namespace

std::unique_ptr<GoldenModel> make_golden_model(const HardwareKey& key) {
  return key.preset == Preset::exact ? make<golden::Exact>(key.channels)
                                     : make<golden::Published>(key.channels);
}

}  // namespace halfway
