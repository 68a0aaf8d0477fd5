// SPDX-License-Identifier: Apache-2.0
#include "sim/figures/cut_lines.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "frame/assemble.hpp"
#include "golden/triangle_walker.hpp"
#include "golden_run/golden_run.hpp"
#include "setup/half_triangle.hpp"
#include "setup/spherical_setup.hpp"
#include "setup/walk_header.hpp"
#include "shading/bell.hpp"

namespace halfway::figures {
namespace {

using words::Published;
using Words = std::vector<std::uint32_t>;
using WordSpan = std::span<const std::uint32_t>;

// The lights of a pixel whose highlight's angle is within the bell, one bit each.
using Inside = std::uint32_t;

// Cuts the lines of one half of a triangle.
class Cutter {
 public:
  Cutter(const Scene& scene, const HardwareKey& key, const SphericalSetup& setup)
      : scene_(scene),
        key_(key),
        layout_(golden_config(key)),
        setup_(setup),
        words_((setup.init_bits() + 31) / 32) {}

  // `group`: the half's header and records. Appends what the cutting host sends, and counts it.
  void cut(const ScreenTriangle& triangle, const std::array<HalfVertex, 3>& vertex, const HalfTriangle& half,
           WordSpan group, Words& out, CutLines& count) const {
    const std::vector<Line> lines = walked(triangle, vertex, half, group);
    const bool whole = std::ranges::all_of(lines, [](const Line& line) {
      return line.pixels.empty() ||
             std::ranges::count(line.pixels, line.pixels[0]) == std::ssize(line.pixels);
    });
    const auto record = [&](std::size_t line) { return group.subspan((1 + line) * words_, words_); };
    if (whole) {
      out.insert(out.end(), group.begin(), group.begin() + static_cast<std::ptrdiff_t>(words_));
      ++count.vectors;
      for (std::size_t i = 0; i < lines.size(); ++i, ++count.records)
        put_record(record(i), 0, lines[i].pixels.empty() ? 0 : lines[i].pixels[0], out);
      return;
    }
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const auto& [y, first, pixels] = lines[i];
      for (std::size_t from = 0, until = 0; from < pixels.size(); from = until) {
        while (until < pixels.size() && pixels[until] == pixels[from]) ++until;
        const auto x = [&, &first = first](std::size_t pixel) {
          return static_cast<long double>(first) + static_cast<long double>(pixel);
        };
        put_one_line(triangle.source, {y, 1, half.start, half.stop, x(from), 0, x(until - 1), 0}, vertex,
                     group, out);
        put_record(record(i), from, pixels[from], out);
        ++count.vectors;
        ++count.records;
      }
    }
  }

 private:
  struct Line {
    std::int64_t y, first;
    std::vector<Inside> pixels;
  };

  // The lines of the half, as the hardware walks them.
  std::vector<Line> walked(const ScreenTriangle& triangle, const std::array<HalfVertex, 3>& vertex,
                           const HalfTriangle& half, WordSpan header) const {
    const Material& material = scene_.materials[triangle.material];
    std::array<PointVectors, 3> vectors;
    for (std::size_t i = 0; i < 3; ++i) {
      glm::dvec3 corner(0.0);
      corner[static_cast<int>(i)] = 1.0;
      vectors[i] = setup_.vectors_at(material, surface_point(triangle, corner));
    }
    std::vector<Line> lines;
    golden::TriangleWalker<Published> walker;
    walker.line_load(header);
    walker.walk([&] {
      Line line{static_cast<std::int64_t>(walker.y()), walker.start().value(), {}};
      const std::int64_t pixels = walker.line_empty() ? 0 : walker.stop().value() - line.first;
      const auto t = [&](const HalfEdge& edge) {
        return static_cast<double>((line.y - vertex[edge.top].y) /
                                   (vertex[edge.bottom].y - vertex[edge.top].y));
      };
      for (std::size_t light = 0; light < key_.spherical.lights; ++light) {
        const auto end = [&](const HalfEdge& edge) {
          const LightVectors &a = vectors[edge.top].light[light], &b = vectors[edge.bottom].light[light];
          return std::pair(slerp(a.u, b.u, t(edge)), slerp(a.v, b.v, t(edge)));
        };
        const auto [u1, v1] = end(half.start);
        const auto [u2, v2] = pixels > 1 ? end(half.stop) : std::pair(u1, v1);
        line.pixels.resize(static_cast<std::size_t>(pixels));
        const CosineArc arc = cosine_arc(u1, u2, v1, v2);
        const double bell_end = std::numbers::pi / 2 / published_scale(material.exponent),
                     step = pixels > 1 ? 1.0 / static_cast<double>(pixels - 1) : 0.0;
        for (std::size_t i = 0; i < line.pixels.size(); ++i)
          if (std::abs(static_cast<double>(i) * step * arc.sweep - arc.phase) <= bell_end)
            line.pixels[i] |= Inside{1} << light;
      }
      lines.push_back(std::move(line));
    });
    return lines;
  }

  // The header of a triangle of one line, with the ambient light of the half's header.
  void put_one_line(std::uint32_t source, const HalfTriangle& line, const std::array<HalfVertex, 3>& vertex,
                    WordSpan header, Words& out) const {
    InitVector init(out, setup_.init_bits());
    put_header(init, source, line, vertex);
    for (int c = 0; c < static_cast<int>(key_.channels); ++c)
      init.put(Published::ambient_channel_at::ambient,
               static_cast<std::int64_t>(
                   words::get_bits(header, Published::ambient_channel_at::ambient, layout_.ambient_low(c))),
               layout_.ambient_low(c));
  }

  // The record from pixel `from` of the line on, without the highlights that are outside of their bells.
  void put_record(WordSpan record, std::size_t from, Inside inside, Words& out) const {
    const std::size_t begin = out.size();
    out.insert(out.end(), record.begin(), record.end());
    const auto words = std::span(out).subspan(begin);
    const words::SphericalConfig config = golden_config(key_);
    const auto advance = [&](const words::Field& angle, const words::Field& slope, int low) {
      words::set_bits(words, angle,
                      words::get_bits(record, angle, low) + from * words::get_bits(record, slope, low), low);
    };
    for (int light = 0; light < config.lights; ++light) {
      using Diffuse = Published::diffuse_header_at;
      using Specular = Published::specular_header_at;
      if (layout_.has_diffuse_part()) advance(Diffuse::angle, Diffuse::slope, layout_.diffuse_low(light));
      if (!config.specular) continue;
      const int low = layout_.specular_low(light);
      advance(Specular::angle, Specular::slope, low);
      if ((inside >> light & 1U) != 0) continue;
      for (int c = 0; c < config.highlight_channels; ++c)
        words::set_bits(words, Published::specular_channel_at::factor, 0,
                        low + Published::c_specular_header_bits + c * Published::c_specular_channel_bits);
    }
  }

  const Scene& scene_;
  const HardwareKey& key_;
  words::SphericalLayout<Published> layout_;
  const SphericalSetup& setup_;
  std::size_t words_;  // per vector
};

}  // namespace

CutLines draw_with_cut_lines(const Scene& scene, FrameSize size) {
  const HardwareKey key =
      must(plan_scene(scene, {.shader = Shader::spherical, .preset = Preset::published})).key;
  const SphericalSetup setup(scene, size, key, {});
  const Projector projector(scene, size, {.subpixel_bits = 0, .clip_to_frame = true});
  const Cutter cutter(scene, key, setup);
  const auto golden = make_golden_model(key);
  FrameAssembler assembler(size, scene.background);
  CutLines drawn;
  SetupCounts counts;
  const std::unique_ptr<SetupWorker> worker = setup.worker();
  for (std::uint32_t unit = 0; unit < setup.units(); ++unit) {
    Words uncut, cut;
    worker->append(unit, uncut, counts);
    WordSpan rest(uncut);
    std::vector<ScreenTriangle> on_screen;
    projector.project(unit, on_screen);
    for (const ScreenTriangle& triangle : on_screen) {
      std::array<HalfVertex, 3> vertex;
      for (std::size_t i = 0; i < 3; ++i) {
        const ScreenVertex& v = triangle.vertex[i];
        vertex[i] = {static_cast<long double>(v.x), static_cast<long double>(v.y), depth_steps(v.z)};
      }
      for (const HalfTriangle& half : half_triangles(vertex)) {
        const std::size_t words = golden->group(rest) * ((setup.init_bits() + 31) / 32);
        cutter.cut(triangle, vertex, half, rest.first(words), cut, drawn);
        rest = rest.subspan(words);
      }
    }
    must(assembler.add(golden->draw(cut)));
  }
  drawn.frame = assembler.frame();
  return drawn;
}

}  // namespace halfway::figures
