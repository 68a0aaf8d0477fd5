// SPDX-License-Identifier: Apache-2.0
#include "stability/spherical_trial.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>
#include <vector>

#include "golden_run/test/spherical_drawing.hpp"
#include "stability/specification.hpp"

namespace halfway::stability {
namespace {

using golden::Exact, golden::Published;

// All words of every record stay in their formats, on every pixel of its line.
template <class P>
void require_words_in_range(Trial& trial, const Drawing& drawing, const std::string& name) {
  constexpr bool c_exact = std::is_same_v<P, Exact>;
  const golden::SphericalConfig config = golden_config(drawing.key);
  const golden::SphericalLayout<P> layout(config);
  const auto require_factor = [&](std::span<const std::uint32_t> words, const golden::Field& field, int low) {
    trial.require(golden::get_bits(words, field, low) <= (c_exact ? 65535U : 1023U)
                                                             << P::c_factor_fraction_bits,
                  [&] { return name + ": a factor exceeds the largest"; });
  };
  const auto model = make_golden_model(drawing.key);
  const std::size_t vector_words = (drawing.init_bits + 31) / 32;
  for (std::span<const std::uint32_t> rest = drawing.words; !rest.empty();
       rest = rest.subspan(model->group(rest) * vector_words))
    for (int c = 0; c < config.channels; ++c)
      require_factor(rest, P::ambient_channel_at::ambient, layout.ambient_low(c));
  for_each_line<P>(drawing, [&](const golden::TriangleWalker<P>& walker,
                                std::span<const std::uint32_t> record) {
    const std::int64_t steps = std::abs(walker.stop().value() - walker.start().value()) - 1;
    const auto require_angle = [&](const golden::Field& angle, const golden::Field& slope, int low) {
      if (!c_exact || walker.line_empty()) return;  // words of preset published wrap
      trial.require(std::abs(angle_after<P>(record, angle, slope, low, steps)) < std::int64_t{1}
                                                                                     << (P::c_angle_bits - 1),
                    [&] { return name + ": an angle wraps"; });
    };
    for (int l = 0; l < config.lights; ++l) {
      if (layout.has_diffuse_part()) {
        using At = typename P::diffuse_header_at;
        require_angle(At::angle, At::slope, layout.diffuse_low(l));
        for (int c = 0; c < layout.diffuse_channels(); ++c)
          require_factor(record, P::diffuse_channel_at::factor,
                         layout.diffuse_low(l) + P::c_diffuse_header_bits + c * P::c_diffuse_channel_bits);
      }
      using At = typename P::specular_header_at;
      require_angle(At::angle, At::slope, layout.specular_low(l));
      for (int c = 0; c < config.highlight_channels; ++c)
        require_factor(record, P::specular_channel_at::factor,
                       layout.specular_low(l) + P::c_specular_header_bits + c * P::c_specular_channel_bits);
    }
  });
}

}  // namespace

SurfacePoint surface_at(const Scene& scene, FrameSize frame, std::int64_t x, std::int64_t y) {
  const ScreenTriangle t = Pieces(scene, frame).all().at(0);
  return surface_point(t,
                       barycentric_screen(t, (2 * x + 1) << c_subpixel_bits, (2 * y + 1) << c_subpixel_bits));
}

Truth::Truth(const Scene& scene, FrameSize frame) : scene_(scene), pieces_(scene, frame) {}

LongVec Truth::radiance_at(std::uint32_t source, std::int64_t x, std::int64_t y) const {
  const ScreenTriangle& t = pieces_.nearest(source, x, y);
  const ExactSurface s = surface(t, c_subpixel_bits, x, y);
  Material material = scene_.materials[t.material];
  material.exponent = std::min(material.exponent, c_largest_exponent);
  return radiance(scene_, material, s.position_world, unit_normal(t, s));
}

LongVec Truth::normal_at(std::uint32_t source, std::int64_t x, std::int64_t y) const {
  const ScreenTriangle& t = pieces_.nearest(source, x, y);
  return unit_normal(t, surface(t, c_subpixel_bits, x, y));
}

Shown show(Trial& trial, const Scene& scene, const std::string& name, const ShowOptions& options) {
  DrawOptions draw{.plan = {.shader = Shader::spherical, .all_effects = true, .lights = options.lights},
                   .frame = options.frame};
  draw.setup.spherical.threshold = options.threshold;
  const Drawing exact = trial.draw(scene, draw);
  require_words_in_range<Exact>(trial, exact, name);
  trial.require(!exact.fragments.empty(), [&] { return name + ": nothing is drawn"; });
  const double bound = promised_steps(scene, exact.key, options.threshold);
  const Truth truth(scene, options.frame);

  Shown shown{.fragments = exact.fragments.size(), .counts = exact.counts};
  std::map<std::tuple<std::uint32_t, int, int>, LongVec> there;
  const auto where = [&](const Fragment& f) { return fmt::format("{}, pixel {}, {}", name, f.x, f.y); };
  for (const Fragment& f : exact.fragments) {
    const LongVec radiance = there[{f.triangle, f.x, f.y}] = truth.radiance_at(f.triangle, f.x, f.y);
    trial.ours(colour_error(f, radiance), bound, [&] { return where(f); });
    shown.brightest = std::max(shown.brightest, int{f.red});
  }

  trial.require(shown.brightest >= options.least_red, [&] { return name + ": too dark"; });

  draw.setup.spherical.ends = SpanEnds::slerped_along_edges;
  const Drawing slerped = trial.draw(scene, draw);
  require_words_in_range<Exact>(trial, slerped, name + ", ends by slerp");
  trial.require(slerped.fragments.size() == exact.fragments.size(),
                [&] { return name + ": ends by slerp cover other pixels"; });

  if (!options.published) return shown;
  draw.plan.preset = Preset::published;
  draw.plan.tables = options.published_tables;
  const Drawing published = trial.draw(scene, draw);
  require_words_in_range<Published>(trial, published, name + ", published");
  for (const Fragment& f : published.fragments) {
    trial.require(f.x < options.frame.width && f.y < options.frame.height,
                  [&] { return where(f) + ": preset published draws outside the frame"; });
    shown.published_brightest = std::max(shown.published_brightest, int{f.red});
    // Vertices on whole pixels: along the edges the pixels differ from the exact ones.
    const auto found = there.find({f.triangle, f.x, f.y});
    if (found != there.end())
      trial.published(colour_error(f, found->second), bound, [&] { return where(f); });
  }
  return shown;
}

}  // namespace halfway::stability
