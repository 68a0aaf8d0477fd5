// SPDX-License-Identifier: Apache-2.0
// Rows of whole frames: each shader's presets and set-ups on the scene `spheres`, and bright lights.
#include <fmt/format.h>

#include "accuracy/row.hpp"

namespace halfway::accuracy {
namespace {

using page::Fields;

constexpr FrameSize c_size{640, 480};
constexpr const char* c_no_number = "–";

constexpr const char* c_spheres = "sim/scenes/spheres.toml";
constexpr const char* c_sphere = "sim/studies/sphere.toml";

Scene spheres() {
  return loaded(c_spheres);
}

std::string decibels(const FrameDistance& error) {
  return fmt::format("{:.1f}", error.psnr_db);
}
std::string largest(const FrameDistance& error) {
  return std::to_string(error.max_lsb);
}

Fields quadratic_fields(const std::string& shader, const FrameDistance& error, const Drawn* drawn) {
  const auto count = [&](std::uint64_t number) { return drawn == nullptr ? c_no_number : grouped(number); };
  const Drawn counts = drawn == nullptr ? Drawn{} : *drawn;
  return {{"shader", shader},
          {"PSNR, dB", decibels(error)},
          {"largest error", largest(error)},
          {"points shaded by the host", count(counts.setup.shaded)},
          {"init vectors", count(counts.setup.vectors)},
          {"cycles", count(counts.cycles)}};
}

Row quadratic_row(const std::string& id, const std::string& split, HighlightTest test) {
  const PlanRequest request{.shader = Shader::quadratic};
  return {.id = id, .measure = [=] {
            SetupOptions options;
            options.quadratic.test = test;
            const Drawn d = drawn(spheres(), c_size, request, options);
            return quadratic_fields("quadratic, " + split, d.error, &d);
          }};
}

Row spherical_row(const std::string& id, const std::string& shader, Preset preset, SpanEnds ends) {
  const PlanRequest request{.shader = Shader::spherical, .preset = preset};
  return {.id = id, .measure = [=]() -> Fields {
            SetupOptions options;
            options.spherical.ends = ends;
            const Drawn d = drawn(spheres(), c_size, request, options);
            return {{"shader", shader},
                    {"PSNR, dB", decibels(d.error)},
                    {"largest error", largest(d.error)},
                    {"vectors evaluated by the host", grouped(d.setup.shaded)},
                    {"init vectors + line records",
                     fmt::format("{} + {}", grouped(d.setup.vectors), grouped(d.setup.records))},
                    {"cycles", grouped(d.cycles)}};
          }};
}

Row processors_row(const std::string& id, const std::string& processors, Preset preset) {
  const auto request = [preset](ProcessorForm form) {
    return PlanRequest{.shader = Shader::processors, .preset = preset, .form = form};
  };
  return {.id = id, .measure = [=]() -> Fields {
            const Drawn folded = drawn(spheres(), c_size, request(ProcessorForm::folded));
            const Drawn unrolled = drawn(spheres(), c_size, request(ProcessorForm::unrolled));
            return {{"shading processors", processors},
                    {"PSNR, dB", decibels(unrolled.error)},
                    {"largest error", largest(unrolled.error)},
                    {"init vectors (3 are not triangles: `new_frame`, ambient light, light)",
                     grouped(unrolled.setup.vectors)},
                    {"cycles, folded", grouped(folded.cycles)},
                    {"cycles, unrolled", grouped(unrolled.cycles)}};
          }};
}

// The study's sphere without highlights.
Scene matte_sphere(double intensity) {
  Scene scene = loaded(c_sphere);
  for (Material& material : scene.materials) material.specular = 0.0;
  for (auto& light : scene.directional) light.intensity *= intensity;
  return scene;
}

Row bright_row(int intensity) {
  const PlanRequest request{.shader = Shader::spherical};
  constexpr FrameSize c_small{320, 240};
  return {.id = fmt::format("intensity_{}", intensity), .measure = [=]() -> Fields {
            const Drawn d = drawn(matte_sphere(intensity), c_small, request);
            return {{"intensity", std::to_string(intensity)},
                    {"PSNR, dB", decibels(d.error)},
                    {"largest error", largest(d.error)}};
          }};
}

}  // namespace

std::vector<Row> quadratic_rows() {
  return {{.id = "gouraud",
           .measure =
               [] {
                 return quadratic_fields("Gouraud, in software", gouraud_error(spheres(), c_size), nullptr);
               }},
          quadratic_row("never_split", "never split", HighlightTest::none),
          quadratic_row("published_test", "split by the published highlight test", HighlightTest::centroid),
          quadratic_row("conservative_test", "split by the conservative test (default)",
                        HighlightTest::conservative)};
}

std::vector<Row> spherical_rows() {
  return {
      spherical_row(
          "published",
          "preset `published`: cos² tables of 6×6 (address bits × data bits), an angle of 12 bits that wraps",
          Preset::published, SpanEnds::slerped_along_edges),
      spherical_row(
          "slerped_ends",
          "preset `exact`, ends of lines by spherical linear interpolation (slerp) along the edges, as in "
          "the paper",
          Preset::exact, SpanEnds::slerped_along_edges),
      spherical_row("ends_on_surface", "preset `exact`, ends of lines on the surface (default)",
                    Preset::exact, SpanEnds::on_surface)};
}

std::vector<Row> bright_rows() {
  return {bright_row(1), bright_row(10), bright_row(100), bright_row(1000)};
}

std::vector<Row> processors_rows() {
  return {processors_row("published", "preset `published`: N not normalized, 16 bits, integer light",
                         Preset::published),
          processors_row("exact", "preset `exact`", Preset::exact)};
}

}  // namespace halfway::accuracy
