// SPDX-License-Identifier: Apache-2.0
// The quadratic paper: figures 7 to 11, the times of its section 6, and its statements on arithmetic.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "common/to_integer.hpp"
#include "golden/line_interpolator.hpp"
#include "sim/figures/figure7.hpp"
#include "sim/figures/figure_pictures.hpp"
#include "sim/figures/six_point_fit.hpp"
#include "sim/figures/software_shading.hpp"
#include "sim/files/timing_diagram.hpp"

namespace halfway::figures {
namespace {

// ---- Figure 7 ----

// The page's names of registers, by their names in figure7.txt.
constexpr std::array<std::pair<const char*, const char*>, 3> c_line_registers = {
    {{"dI_start", "ΔI_start"}, {"I_start", "I_start"}, {"dI(X_start)", "ΔI(X_start)"}}};
constexpr std::array<std::pair<const char*, const char*>, 2> c_pixel_registers = {
    {{"dI(X,Y)", "ΔI(X,Y)"}, {"I(X,Y)", "I(X,Y)"}}};

// One box per word of our registers, over the clocks in which the register holds it: blue as printed, red if
// printed differently, grey after the printed ones.
std::string figure_7_script(const Figure7& figure, const Figure7Trace& trace) {
  TimingDiagram diagram{.end = c_figure7_pixels, .width = 930, .axis = "clock"};
  for (std::uint32_t clock = 0; clock < c_figure7_pixels; ++clock) {
    diagram.ticks.emplace_back(clock + 0.5, std::to_string(clock + 1));
    diagram.lines.push_back(clock + 1.0);
  }
  const auto box = [&](double from, double clocks, const std::string& name, const TraceWords& words,
                       std::size_t i) {
    const TraceWords& printed = figure.words(name);
    const unsigned colour = i >= printed.size()         ? c_grey_box
                            : printed[i] == words.at(i) ? c_blue_box
                                                        : c_red_box;
    diagram.lanes.back().boxes.push_back({from, from + clocks, fmt::format("{:08X}", words.at(i)), colour});
  };
  for (const auto& [name, shown] : c_line_registers) {
    diagram.lanes.push_back({shown});
    double from = 0;
    for (std::uint32_t k = 0; k < c_figure7_lines; from += ++k)
      box(from, k + 1, name, trace.line.at(name), k);
  }
  for (const auto& [name, shown] : c_pixel_registers) {
    diagram.lanes.push_back({shown});
    for (std::uint32_t i = 0; i < c_figure7_pixels; ++i) box(i, 1, name, trace.pixel.at(name), i);
  }
  return timing_script(diagram);
}

// The words that a register holds while the printed ones are shown, and how many of these differ.
Measured compared_words(const Figure7& figure, const std::string& name, std::span<const std::uint32_t> held) {
  const TraceWords& printed = figure.words(name);
  const auto words = held.first(printed.size());
  std::size_t differing = 0;
  for (std::size_t i = 0; i < printed.size(); ++i) differing += words[i] != printed[i] ? 1 : 0;
  return {fmt::format("{}: {} of {} differ", hexadecimal(words), differing, printed.size()),
          static_cast<double>(differing)};
}

void draw_figure_7(const Context& context, Drawing& out) {
  const Figure7 figure = read_figure7(context.folders.source / "tb/specification/paper/figure7.txt");
  const Figure7Trace golden = golden_figure7(figure);
  for (const auto& [name, shown] : c_line_registers)
    out.measured[shown] = compared_words(figure, name, golden.line.at(name));
  for (const auto& [name, shown] : c_pixel_registers)
    out.measured[shown] = compared_words(figure, name, golden.pixel.at(name));
  if (!context.quick) {
    const Figure7Trace rtl = rtl_figure7(figure, context.folders);
    std::size_t words = 0, differing = 0;
    const auto compare = [&](const auto& published, const auto& seen) {
      for (const auto& [name, expected] : published)
        for (std::size_t i = 0; i < expected.size(); ++i) {
          ++words;
          const auto found = seen.find(name);
          differing +=
              found == seen.end() || found->second.size() <= i || found->second[i] != expected[i] ? 1 : 0;
        }
    };
    compare(figure.line, rtl.line);
    compare(figure.pixel, rtl.pixel);
    out.measured["printed words that the RTL's registers do not hold, in GHDL"] =
        measured(static_cast<double>(differing), "{} of {}", words);
    const auto clocks = rtl.pixel_clock.empty() ? 0 : rtl.pixel_clock.back() - rtl.pixel_clock.front() + 1;
    out.measured["clocks for the ten pixels of four lines, in GHDL"] =
        measured(static_cast<double>(clocks), "{} for {}", rtl.pixel_clock.size());
  }
  draw_plot(
      context, "quadratic-07",
      {.title = "The five registers of the quadratic interpolator over ten clocks; words as printed are "
                "blue, the one that is printed differently is red, grey goes on where the scan breaks off",
       .script = figure_7_script(figure, golden)},
      out);
}

// ---- Figures 8 to 11 ----

constexpr FrameSize c_mesh_size{176, 132}, c_sphere_size{160, 120};

SetupOptions split_by(HighlightTest test) {
  SetupOptions options;
  options.quadratic.test = test;
  return options;
}

struct QuadraticWay {
  const char* what;
  Preset preset;
  HighlightTest test;
};
constexpr std::array<QuadraticWay, 4> c_figure_8_ways = {
    {{"six samples a triangle, never split", Preset::exact, HighlightTest::none},
     {"split by the published highlight test", Preset::exact, HighlightTest::centroid},
     {"the published hardware: vertices on whole pixels, edges by real slopes", Preset::published,
      HighlightTest::centroid},
     {"preset exact, split by our test", Preset::exact, HighlightTest::conservative}}};

void draw_figure_8(const Context& context, Drawing& out) {
  std::vector<Frame> pictures;
  for (const auto& [name, scene] : {std::pair{"hen", hen_scene()}, {"teapot", teapot_scene(context)}}) {
    const auto draw = [&, &scene = scene](const QuadraticWay& way, FrameSize size) {
      return draw_in_hardware(context, scene, size, {.shader = Shader::quadratic, .preset = way.preset},
                              split_by(way.test))
          .frame;
    };
    for (const QuadraticWay& way : c_figure_8_ways) {
      if (context.quick) break;
      const ReferenceImage phong = draw_in_software(scene, c_compared_size, context.threads).phong;
      out.measured[fmt::format("{}: {}", name, way.what)] =
          likeness(draw(way, c_compared_size), phong.frame, phong.mask).measured();
    }
    const Frame phong = draw_in_software(scene, c_mesh_size, context.threads).phong.frame;
    for (const Frame& frame :
         {draw_mesh(scene, c_mesh_size, context.threads), phong, draw(c_figure_8_ways[1], c_mesh_size)})
      pictures.push_back(frame);
  }
  save_picture(context, "quadratic-08", sheet(pictures, 3),
               "A hen and the teapot: mesh, Phong shading, quadratic shading", out);
}

// A sphere with the given number of triangles and exponents of 5 and 50.
void draw_spheres(const std::string& id, std::uint32_t slices, std::uint32_t stacks, const Context& context,
                  Drawing& out) {
  std::vector<Frame> pictures;
  std::size_t triangles = 0;
  for (const double n : {5.0, 50.0}) {
    const Scene scene = sphere_scene(slices, stacks, n);
    triangles = scene.triangles.size();
    const Software software = draw_in_software(scene, c_compared_size, context.threads);
    const auto draw = [&](HighlightTest test, FrameSize size) {
      return draw_in_hardware(context, scene, size, {.shader = Shader::quadratic}, split_by(test)).frame;
    };
    const auto rms = [&](const Frame& frame) {
      return distance(frame, software.phong.frame, software.phong.mask).rms;
    };
    const Frame unsplit = draw(HighlightTest::none, c_compared_size);
    const double of_quadratic = rms(unsplit), of_gouraud = rms(software.gouraud.frame);
    out.measured[fmt::format("n = {}: rms error of quadratic shading as a part of Gouraud's", n)] =
        measured(of_quadratic / of_gouraud, "{:.2f} ({:.2f} of {:.2f})", of_quadratic, of_gouraud);
    const Software shown = draw_in_software(scene, c_sphere_size, context.threads);
    for (const Frame& frame :
         {shown.gouraud.frame, draw(HighlightTest::none, c_sphere_size), shown.phong.frame})
      pictures.push_back(frame);
    if (context.quick) continue;

    const auto alike = [&](const Frame& frame) {
      return likeness(frame, software.phong.frame, software.phong.mask);
    };
    const Likeness published = alike(draw(HighlightTest::centroid, c_compared_size)),
                   ours = alike(draw(HighlightTest::conservative, c_compared_size));
    Measured similar = alike(unsplit).measured();
    similar.text += fmt::format(
        "; split by the published test {:.2f} % and {}/255, by ours {:.2f} % and {}/255",
        published.seen_percent, published.distance.max_lsb, ours.seen_percent, ours.distance.max_lsb);
    out.measured[fmt::format("n = {}: quadratic against Phong shading", n)] = similar;
    out.measured[fmt::format("n = {}: Gouraud against Phong shading", n)] =
        alike(software.gouraud.frame).measured();
  }
  out.measured["triangles of a sphere"] = constructed(static_cast<double>(triangles), "{}");
  save_picture(context, id, sheet(pictures, 3),
               fmt::format("Spheres of {} triangles, exponents 5 above and 50 below: Gouraud, quadratic and "
                           "Phong shading",
                           triangles),
               out);
}

// ---- Section 6: times; sections 3 and 5: what the text says of cost and arithmetic ----

struct Times {
  double gouraud = 0.0, quadratic = 0.0, phong = 0.0;  // processor seconds per frame
};

constexpr FrameSize c_timed_size{500, 500};

Times software_times(const Scene& scene) {
  constexpr int c_rounds = 15;
  const auto triangles = Projector(scene, c_timed_size, {}).project_all();
  Times least{1e9, 1e9, 1e9};
  std::array<Frame, 3> frames;
  for (int round = 0; round < c_rounds; ++round)
    for (const auto& [shading, seconds, frame] :
         {std::tuple{SoftwareShading::gouraud, &least.gouraud, &frames[0]},
          {SoftwareShading::quadratic, &least.quadratic, &frames[1]},
          {SoftwareShading::phong, &least.phong, &frames[2]}}) {
      SoftwareFrame drawn = shade_in_software(scene, triangles, c_timed_size, shading);
      *frame = std::move(drawn.frame);
      *seconds = std::min(*seconds, drawn.seconds);
    }
  // The renderers must draw their own method's picture.
  const RenderOptions options{.frame = c_timed_size};
  const ReferenceImage phong = render_reference(scene, triangles, options);
  const Frame gouraud = render_gouraud(scene, triangles, options).frame;
  if (distance(frames[0], gouraud, phong.mask).max_lsb > 1 ||
      distance(frames[2], phong.frame, phong.mask).max_lsb > 12 ||
      distance(frames[1], phong.frame, phong.mask).psnr_db < 30.0)
    throw Failure{{ExitCode::differs, "the software renderers do not draw what the reference draws"}};
  return least;
}

void draw_times(const Context& context, Drawing& out) {
  // Error of the paper's rule for fraction bits: a second difference of almost half a unit is rounded to 0
  // over a line of M pixels.
  constexpr int c_pixels = 1000, c_rule_bits = 10;
  golden::LineInterpolator<32> value, difference;
  const double second = 0.499 * std::ldexp(1.0, -c_rule_bits);
  const auto word = [](double v) {
    return words::Word<32>::from_bits(
        std::uint64_t(to_integer<std::int64_t>(std::round(std::ldexp(v, c_rule_bits)))));
  };
  value.load(word(0.0));
  difference.load(word(0.0));
  double right = 0.0, right_difference = 0.0;
  for (int i = 0; i < c_pixels; ++i) {
    value.step(difference.value());
    difference.step(word(second));
    right += right_difference;
    right_difference += second;
  }
  const double off = std::abs(right - std::ldexp(static_cast<double>(value.value().bits()), -c_rule_bits));
  out.measured["error after M = 1000 pixels by the 10 fraction bits of b > log₂ M"] =
      measured(off, "{:.0f} colour steps");
  constexpr std::array c_values{0.1, 0.4, 0.3, 0.9, 0.5, 0.7};
  const double t3 = fit_six_points_as_printed(10.0, 0.0, 2.0, 6.0, c_values).t3;
  out.measured["T3 of a triangle with Y2 = 0, by the printed formula"] = {
      std::isfinite(t3) ? "a number" : "division by zero, no number"};
  // Count the operations of a form of the fit.
  const auto count = [&](const auto& fit) {
    OperationCounts counts;
    const auto counted = [&](double v) { return CountedNumber(v, counts); };
    std::array values{counted(0.0), counted(0.0), counted(0.0), counted(0.0), counted(0.0), counted(0.0)};
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = counted(c_values[i]);
    fit(counted(7.0), counted(1.0), counted(2.0), counted(6.0), values);
    return Measured{fmt::format("{}, {}, {}", counts.additions, counts.multiplications, counts.divisions)};
  };
  const std::string operations = "additions, multiplications and divisions for the six coefficients";
  out.measured[operations + ", as printed"] =
      count([](const auto&... of) { fit_six_points_as_printed(of...); });
  out.measured[operations + ", our form"] = count([](const auto&... of) { fit_six_points(of...); });
  const double cycle_ns = 50.0, frames = std::floor(1e9 / (cycle_ns * 1e6));
  out.measured["frames a second at 1000×1000 and 50 ns a pixel"] = constructed(frames, "{}");
  if (context.quick) return;

  const Scene scene = sphere_scene(12, 8, 50.0);
  const Times times = software_times(scene);
  out.measured["quadratic shading, as a multiple of Gouraud shading's time"] =
      measured(times.quadratic / times.gouraud, "{:.2f}");
  out.measured["Phong shading, likewise"] = measured(times.phong / times.gouraud, "{:.1f}");
  // Assume a constant additional time per pixel for all three methods, chosen so that Phong's ratio is the
  // published one.
  constexpr double c_published_phong = 450.0 / 230.0;
  const double additional = (times.phong - c_published_phong * times.gouraud) / (c_published_phong - 1.0);
  out.measured["the first with an additional time that makes the second 1.96"] =
      measured((times.quadratic + additional) / (times.gouraud + additional),
               "{:.2f}, by {:.1f} times Gouraud's time", additional / times.gouraud);

  const auto pace = [&](const Scene& of, FrameSize size, const PlanRequest& plan,
                        const SetupOptions& options = {}) {
    const Hardware drawn = draw_in_hardware(context, of, size, plan, options);
    return static_cast<double>(drawn.cycles) / static_cast<double>(drawn.fragments);
  };
  const double quadratic = pace(scene, c_timed_size, {.shader = Shader::quadratic});
  // The same hardware with colours that are linear on each triangle, as in Gouraud shading.
  Scene matte = scene;
  matte.materials[0].specular = 0.0;
  const double linear =
      pace(matte, c_timed_size, {.shader = Shader::quadratic}, split_by(HighlightTest::none));
  const double folded =
      pace(scene, {160, 160},
           {.shader = Shader::processors, .preset = Preset::published, .form = ProcessorForm::folded});
  out.measured["clocks per pixel, quadratic shader"] = measured(quadratic, "{:.3f}");
  out.measured["in hardware, quadratic as a multiple of linear"] = constructed(quadratic / linear, "{:.3f}");
  out.measured["in hardware, Phong shading by the processors paper's version I, likewise"] =
      constructed(folded / linear, "{:.2f}");
}

}  // namespace

std::map<std::string, Draw> quadratic_drawings() {
  std::map<std::string, Draw> all = {
      {"quadratic-07", draw_figure_7}, {"quadratic-08", draw_figure_8}, {"quadratic-times", draw_times}};
  for (const auto& [id, slices, stacks] :
       {std::tuple{"quadratic-09", 12U, 8U}, {"quadratic-10", 17U, 12U}, {"quadratic-11", 23U, 16U}})
    all[id] = [id = std::string(id), slices = slices, stacks = stacks](const Context& context, Drawing& out) {
      draw_spheres(id, slices, stacks, context, out);
    };
  return all;
}

}  // namespace halfway::figures
