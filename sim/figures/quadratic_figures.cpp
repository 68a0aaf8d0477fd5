// SPDX-License-Identifier: Apache-2.0
// The quadratic paper's figures 7 to 11, the times of its section 6, and what its text says of the
// arithmetic.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "common/to_integer.hpp"
#include "golden/line_interpolator.hpp"
#include "scene/builtin_meshes.hpp"
#include "sim/figures/figure.hpp"
#include "sim/figures/figure7.hpp"
#include "sim/figures/pictures.hpp"
#include "sim/figures/plot.hpp"
#include "sim/figures/six_point_fit.hpp"
#include "sim/figures/software_shading.hpp"
#include "sim/scene_files/load_scene.hpp"
#include "sim/verilator/verilator_simulator.hpp"

namespace halfway::figures {
namespace {

constexpr const char* c_paper = "quadratic";

// ---- Figure 7 ----

// As the page calls the registers, by their names in figure7.txt.
constexpr std::array<std::pair<const char*, const char*>, 3> c_line_registers = {
    {{"dI_start", "ΔI_start"}, {"I_start", "I_start"}, {"dI(X_start)", "ΔI(X_start)"}}};
constexpr std::array<std::pair<const char*, const char*>, 2> c_pixel_registers = {
    {{"dI(X,Y)", "ΔI(X,Y)"}, {"I(X,Y)", "I(X,Y)"}}};

Result<Figure7> published_figure7(const Context& context) {
  return read_figure7(context.folders.source / "tb" / "published" / "figure7.txt");
}

Result<Figure7Trace> verilated_figure7(const Context& context, const Figure7& figure) {
  auto simulator = VerilatorSimulator::open(figure7_key(), context.folders, {.record_probes = true});
  if (!simulator) return simulator.error();
  constexpr std::size_t c_most = 1000;
  std::vector<Fragment> fragments;
  if (const Status ran = simulator->run(figure7_init(figure), 1, fragments, c_most); !ran) return ran.error();
  if (const Status ended = simulator->finish(fragments, c_most); !ended) return ended.error();
  Figure7Trace trace;
  for (const ProbeRecord& record : simulator->probes()) trace.add(record.words, {}, record.cycle);
  return trace;
}

// A box a word, in the clocks in which the register holds it.
std::string figure_7_script(const Figure7Trace& trace) {
  std::array<std::string, 3> blocks;  // printed by the paper, ours alone, lines
  const auto add = [&](double lane, std::size_t from, std::size_t until, std::uint32_t word, bool printed) {
    blocks[printed ? 0 : 1] += fmt::format("{} {} {} {:08X}\n", lane, from, until, word);
  };
  double lane = 5.0;
  for (const auto& [name, shown] : c_line_registers) {
    std::size_t from = 0;
    for (std::uint32_t k = 0; k < c_figure7_lines; from += ++k)
      add(lane, from, from + k + 1, trace.line.at(name).at(k), true);
    lane -= 1.0;
  }
  constexpr std::array<std::size_t, 2> c_printed{7, 8};  // words of either; then the scan breaks off
  for (std::size_t r = 0; r < c_pixel_registers.size(); ++r, lane -= 1.0)
    for (std::size_t i = 0; i < c_figure7_pixels; ++i)
      add(lane, i, i + 1, trace.pixel.at(c_pixel_registers[r].first).at(i), i < c_printed[r]);
  std::string script = "$printed << EOD\n" + blocks[0] + "EOD\n$ours << EOD\n" + blocks[1] + "EOD\n";
  script += fmt::format(
      "set xrange [0:{0}]\nset yrange [0.4:5.7]\nunset ytics\nset border 1\nset xtics 1 format "
      "''\n"
      "set for [i = 1:{0}] label i sprintf('clock %d', i) at first i - 0.5, graph -0.05 center font ',11'\n"
      "set lmargin 13\nset bmargin 2.2\nset tmargin 0.4\nset rmargin 1\n",
      c_figure7_pixels);
  double label_at = 5.0;
  int label = 100;
  for (const auto& registers :
       {std::span(c_line_registers.data(), 3), std::span(c_pixel_registers.data(), 2)})
    for (const auto& [name, shown] : registers)
      script += fmt::format("set label {} '{}' at graph -0.012, first {} right noenhanced\n", label++, shown,
                            std::exchange(label_at, label_at - 1.0));
  return script +
         "set style fill solid noborder\nhalf = 0.36\n"
         "plot $printed using 2:1:($2 + 0.02):($3 - 0.02):($1 - half):($1 + half) with boxxyerror linecolor "
         "rgb "
         "'#cfe4f7', $ours using 2:1:($2 + 0.02):($3 - 0.02):($1 - half):($1 + half) with boxxyerror "
         "linecolor rgb "
         "'#ededed', $printed using (($2 + $3) / 2):1:4 with labels font ',11', $ours using (($2 + $3) / "
         "2):1:4 with "
         "labels font ',11'\n";
}

Status draw_figure_7(const Context& context, Drawing& out) {
  const auto figure = published_figure7(context);
  if (!figure) return figure.error();
  const Figure7Trace golden = golden_figure7(*figure);
  const auto note = [&](const char* shown, const TraceWords& published, const Figure7Trace& trace,
                        const char* name, bool line) {
    const TraceWords& held = (line ? trace.line : trace.pixel).at(name);
    out.measured[shown] = {hexadecimal(held, published.size())};
  };
  for (const auto& [name, shown] : c_line_registers) note(shown, figure->line.at(name), golden, name, true);
  for (const auto& [name, shown] : c_pixel_registers)
    note(shown, figure->pixel.at(name), golden, name, false);
  if (!context.quick) {
    const auto rtl = verilated_figure7(context, *figure);
    if (!rtl) return rtl.error();
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
    compare(figure->line, rtl->line);
    compare(figure->pixel, rtl->pixel);
    out.measured["printed words that the RTL's registers do not hold, in Verilator"] = {
        fmt::format("{} of {}", differing, words), static_cast<double>(differing)};
    const auto clocks = rtl->pixel_clock.empty() ? 0 : rtl->pixel_clock.back() - rtl->pixel_clock.front() + 1;
    out.measured["clocks for the ten pixels of four lines, in Verilator"] = {
        fmt::format("{} for {}", clocks, rtl->pixel_clock.size()), static_cast<double>(clocks)};
  }
  return draw_plot(
      context, "quadratic-07",
      {.size = {1080, 300},
       .title = "The five registers of the quadratic interpolator over ten clocks; the printed words are "
                "blue, grey goes on where the scan breaks off",
       .script = figure_7_script(golden)},
      out);
}

// The words are the published figure's own file: a claim prints them as they stand there.
Figure figure_7() {
  Figure figure{
      "quadratic-07",
      c_paper,
      "figure 7",
      "timing diagram of the hardware by the VHDL simulator: five registers, 32 bits with 20 of fraction, "
      "one "
      "pixel a clock.",
      "the registers of preset published after the printed start values, golden model and RTL; blue is "
      "what the paper prints, grey what follows.",
      {{"ΔI_start", "FFFD1688 FFFD0626 FFFCF5C4 FFFCE562", the_same()},
       {"I_start", "06AFFFF8 06AD1680 06AA1CA6 06A7126A", the_same()},
       {"ΔI(X_start)", "00150725 0014FB83 0014EFE1 0014E43F", the_same()},
       {"ΔI(X,Y)", "00150725 0014FB83 0014F6A1 0014EFE1 0014EAFF 0014E61D 0014E43F", the_same()},
       {"I(X,Y)", "06AFFFF8 06AD1680 06C21203 06AA1CA6 06BF0C87 06D3F786 06A7126A 06BBF6A9", the_same()},
       {.what = "printed words that the RTL's registers do not hold, in Verilator",
        .published = "27 words",
        .criterion = at_most(0),
        .slow = true},
       {.what = "clocks for the ten pixels of four lines, in Verilator",
        .published = "one pixel a clock",
        .criterion = within(10, 0),
        .slow = true}},
      draw_figure_7};
  return figure;
}

// ---- Figures 8 to 11 ----

constexpr FrameSize c_mesh_size{176, 132}, c_sphere_size{160, 120};

SetupOptions split_by(HighlightTest test) {
  SetupOptions options;
  options.quadratic.test = test;
  return options;
}

constexpr const char* c_whole_pixels =
    "outlines move by up to a pixel, and pixels are sampled beside their centres; the images of the paper "
    "are its "
    "software's";
constexpr std::array c_meshes{"hen", "teapot"};

struct QuadraticWay {
  const char* what;
  Preset preset;
  HighlightTest test;
  std::array<const char*, c_meshes.size()> why_not;
};
constexpr std::array<QuadraticWay, 4> c_figure_8_ways = {
    {{"six samples a triangle, never split",
      Preset::exact,
      HighlightTest::none,
      {"six samples miss a highlight that is narrower than its triangle; the paper splits such triangles",
       ""}},
     {"split by the published highlight test",
      Preset::exact,
      HighlightTest::centroid,
      {"the test looks at one point of a triangle, and where the hen bends sharply highlights slip between "
       "its samples",
       ""}},
     {"the published hardware: vertices on whole pixels, edges by real slopes",
      Preset::published,
      HighlightTest::centroid,
      {c_whole_pixels, c_whole_pixels}},
     {"preset exact, split by our test", Preset::exact, HighlightTest::conservative, {"", ""}}}};

Status draw_figure_8(const Context& context, Drawing& out) {
  auto teapot = teapot_scene(context);
  if (!teapot) return teapot.error();
  std::vector<Frame> pictures;
  for (const auto& [name, scene] :
       {std::pair{c_meshes[0], hen_scene()}, std::pair{c_meshes[1], std::move(*teapot)}}) {
    const auto draw = [&, &scene = scene](const QuadraticWay& way, FrameSize size) {
      return draw_in_hardware(context, scene, size, {.shader = Shader::quadratic, .preset = way.preset},
                              split_by(way.test));
    };
    for (const QuadraticWay& way : c_figure_8_ways) {
      if (context.quick) break;
      const Software software = draw_in_software(scene, c_compared_size, context.threads);
      const auto drawn = draw(way, c_compared_size);
      if (!drawn) return drawn.error();
      const auto alike = likeness(drawn->frame, software.phong.frame, software.phong.mask);
      if (!alike) return alike.error();
      out.measured[fmt::format("{}: {}", name, way.what)] = alike->measured();
    }
    const auto small = draw(c_figure_8_ways[1], c_mesh_size);
    if (!small) return small.error();
    for (const Frame& frame :
         {draw_mesh(scene, c_mesh_size, context.threads),
          draw_in_software(scene, c_mesh_size, context.threads).phong.frame, small->frame})
      pictures.push_back(frame);
  }
  return save_picture(context, "quadratic-08", sheet(pictures, 3),
                      "A hen and the teapot: mesh, Phong shading, quadratic shading", out);
}

Figure figure_8() {
  Figure figure{
      "quadratic-08",
      c_paper,
      "figure 8",
      "the mesh of a chicken (left), its image by classical Phong shading (middle) and by quadratic shading "
      "(right). The mesh was not published.",
      "a hen of our own and the teapot: mesh, per-pixel Phong shading, quadratic shading by the RTL with the "
      "published highlight test.",
      {},
      draw_figure_8};
  for (std::size_t mesh = 0; mesh < c_meshes.size(); ++mesh)
    for (const QuadraticWay& way : c_figure_8_ways)
      figure.claims.push_back(looks_alike(fmt::format("{}: {}", c_meshes[mesh], way.what),
                                          "indistinguishable from Phong shading", way.why_not[mesh]));
  return figure;
}

struct Sphere {
  const char* id;
  const char* number;
  const char* tessellated;
  std::uint32_t slices, stacks, triangles;
};
constexpr std::array<Sphere, 3> c_spheres = {{{"quadratic-09", "figure 9", "coarsely", 12, 8, 168},
                                              {"quadratic-10", "figure 10", "moderately", 17, 12, 374},
                                              {"quadratic-11", "figure 11", "highly", 23, 16, 690}}};
constexpr std::array c_sphere_exponents{5.0, 50.0};

Status draw_spheres(const Sphere& sphere, const Context& context, Drawing& out) {
  std::vector<Frame> pictures;
  for (const double n : c_sphere_exponents) {
    const Scene scene = sphere_scene(sphere.slices, sphere.stacks, n);
    out.measured["triangles of a sphere"] = {fmt::format("{}", scene.triangles.size()),
                                             static_cast<double>(scene.triangles.size())};
    const Software software = draw_in_software(scene, c_compared_size, context.threads);
    const auto draw = [&](HighlightTest test, FrameSize size) {
      return draw_in_hardware(context, scene, size, {.shader = Shader::quadratic}, split_by(test));
    };
    const auto unsplit = draw(HighlightTest::none, c_compared_size),
               small = draw(HighlightTest::none, c_sphere_size);
    if (!unsplit) return unsplit.error();
    if (!small) return small.error();
    const double of_quadratic = distance(unsplit->frame, software.phong.frame, software.phong.mask).rms,
                 of_gouraud = distance(software.gouraud.frame, software.phong.frame, software.phong.mask).rms;
    out.measured[fmt::format("n = {}: rms error of quadratic shading as a part of Gouraud's", n)] = {
        fmt::format("{:.2f} ({:.2f} of {:.2f})", of_quadratic / of_gouraud, of_quadratic, of_gouraud),
        of_quadratic / of_gouraud};
    const Software shown = draw_in_software(scene, c_sphere_size, context.threads);
    for (const Frame& frame : {shown.gouraud.frame, small->frame, shown.phong.frame})
      pictures.push_back(frame);
    if (context.quick) continue;

    const auto published = draw(HighlightTest::centroid, c_compared_size),
               ours = draw(HighlightTest::conservative, c_compared_size);
    if (!published) return published.error();
    if (!ours) return ours.error();
    std::vector<Likeness> alike;
    for (const Frame* frame : {&software.gouraud.frame, &unsplit->frame, &published->frame, &ours->frame}) {
      const auto one = likeness(*frame, software.phong.frame, software.phong.mask);
      if (!one) return one.error();
      alike.push_back(*one);
    }
    Measured similar = alike[1].measured();
    similar.text += fmt::format(
        "; split by the published test {:.2f} % and {}/255, by ours {:.2f} % and {}/255",
        alike[2].seen_percent, alike[2].distance.max_lsb, alike[3].seen_percent, alike[3].distance.max_lsb);
    out.measured[fmt::format("n = {}: quadratic against Phong shading", n)] = similar;
    out.measured[fmt::format("n = {}: Gouraud against Phong shading", n)] = alike[0].measured();
  }
  return save_picture(
      context, sphere.id, sheet(pictures, 3),
      fmt::format("Spheres of {} triangles, exponents 5 above and 50 below: Gouraud, quadratic and "
                  "Phong shading",
                  sphere.triangles),
      out);
}

Figure sphere_figure(const Sphere& sphere) {
  Figure figure{
      sphere.id,
      c_paper,
      sphere.number,
      fmt::format("{} tessellated spheres ({} triangles), specular exponents 5 (top) and 50 (bottom), by "
                  "Gouraud (left), "
                  "quadratic (middle) and Phong shading (right).",
                  sphere.tessellated, sphere.triangles),
      "the same; quadratic shading by the RTL, preset exact, six samples a triangle and no splitting.",
      {{"triangles of a sphere", fmt::format("{}", sphere.triangles), within(sphere.triangles, 0)}},
      [sphere](const Context& context, Drawing& out) { return draw_spheres(sphere, context, out); }};
  for (const double n : c_sphere_exponents) {
    const bool high = &sphere == &c_spheres.back(), sharp = n == c_sphere_exponents.back();
    Claim gouraud = looks_alike(
        fmt::format("n = {}: Gouraud against Phong shading", n),
        "no significant difference on high tessellations",
        sharp ? "a highlight of exponent 50 is still too narrow for three samples a triangle" : "");
    if (!high) {
      gouraud.published = "performs poorly on coarse tessellations";
      gouraud.criterion = at_least(c_alike_percent, gouraud.criterion.unit);
      gouraud.why_not.clear();
    }
    figure.claims.push_back(std::move(gouraud));
    figure.claims.push_back(looks_alike(
        fmt::format("n = {}: quadratic against Phong shading", n), "of similar quality",
        &sphere == &c_spheres.front() && sharp ? "six samples miss a highlight that is narrower than its "
                                                 "triangle; split by the published test there is no "
                                                 "difference to be seen"
                                               : ""));
    figure.claims.push_back({fmt::format("n = {}: rms error of quadratic shading as a part of Gouraud's", n),
                             "superior to Gouraud shading", at_most(0.5), ""});
  }
  return figure;
}

// ---- Section 6: times; sections 3 and 5: what the text says of cost and arithmetic ----

struct Times {
  double gouraud = 0.0, quadratic = 0.0, phong = 0.0;  // processor seconds of a frame
};

constexpr FrameSize c_timed_size{500, 500};

Result<Times> software_times(const Scene& scene) {
  constexpr int c_rounds = 15;
  const auto triangles = Projector(scene, c_timed_size, {.subpixel_bits = 4}).project_all();
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
  // They must draw what they are named for.
  const RenderOptions options{.frame = c_timed_size, .subpixel_bits = 4};
  const ReferenceImage phong = render_reference(scene, triangles, options);
  const Frame gouraud = render_gouraud(scene, triangles, options).frame;
  if (distance(frames[0], gouraud, phong.mask).max_lsb > 1 ||
      distance(frames[2], phong.frame, phong.mask).max_lsb > 12 ||
      distance(frames[1], phong.frame, phong.mask).psnr_db < 30.0)
    return Error{ExitCode::differs, "the software renderers do not draw what the reference draws"};
  return least;
}

Status draw_times(const Context& context, Drawing& out) {
  // What a rule of fraction bits leaves: a second difference of just less than half a unit, which is rounded
  // away, over a line of M pixels.
  constexpr int c_pixels = 1000, c_rule_bits = 10;
  golden::LineInterpolator<32> value, difference;
  const double second = 0.499 * std::ldexp(1.0, -c_rule_bits);
  const auto word = [](double v) {
    return golden::Word<32>::from_bits(
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
  out.measured["error after M = 1000 pixels by the 10 fraction bits of b > log₂ M"] = {
      fmt::format("{:.0f} colour steps", off), off};
  // T3 as printed has Y2² below: with Y2 = 0, T5 X2² = 2 C12 above it.
  const double x2 = 10.0, y2 = 0.0, c12 = 0.3, t5 = 2.0 * c12 / (x2 * x2), t4 = 0.1;
  const double t3 = (2.0 * c12 - t5 * x2 * x2 - t4 * x2 * y2) / (y2 * y2);
  out.measured["T3 of a triangle with Y2 = 0, by the printed formula"] = {
      std::isfinite(t3) ? "a number" : "0/0, no number"};
  OperationCounts counts;
  const auto counted = [&](double v) { return CountedNumber(v, counts); };
  fit_six_points(
      counted(7.0), counted(1.0), counted(2.0), counted(6.0),
      std::array{counted(0.1), counted(0.4), counted(0.3), counted(0.9), counted(0.5), counted(0.7)});
  out.measured["additions, multiplications and divisions for the six coefficients"] = {
      fmt::format("{}, {}, {}", counts.additions, counts.multiplications, counts.divisions)};
  const double cycle_ns = 50.0, frames = std::floor(1e9 / (cycle_ns * 1e6));
  out.measured["frames a second at 1000×1000 and 50 ns a pixel"] = {fmt::format("{}", frames), frames};
  if (context.quick) return Ok{};

  const Scene scene = sphere_scene(12, 8, 50.0);
  const auto times = software_times(scene);
  if (!times) return times.error();
  const double quadratic = times->quadratic / times->gouraud, phong = times->phong / times->gouraud;
  out.measured["quadratic shading, as a multiple of Gouraud shading's time"] = {
      fmt::format("{:.2f}", quadratic), quadratic};
  out.measured["Phong shading, likewise"] = {fmt::format("{:.1f}", phong), phong};
  // A time that all three spend on every pixel, so great that Phong's ratio is the published one.
  constexpr double c_published_phong = 450.0 / 230.0;
  const double beside = (times->phong - c_published_phong * times->gouraud) / (c_published_phong - 1.0);
  const double ratio = (times->quadratic + beside) / (times->gouraud + beside);
  out.measured["the first with a time beside shading that makes the second 1.96"] = {
      fmt::format("{:.2f}, by {:.1f} times Gouraud's time", ratio, beside / times->gouraud), ratio};

  const auto quadratic_rtl = draw_in_hardware(context, scene, c_timed_size, {.shader = Shader::quadratic});
  if (!quadratic_rtl) return quadratic_rtl.error();
  // The same hardware on colours that are linear on each triangle: what Gouraud shading asks of it.
  Scene matte = scene;
  matte.materials[0].specular = 0.0;
  const auto linear_rtl = draw_in_hardware(context, matte, c_timed_size, {.shader = Shader::quadratic},
                                           split_by(HighlightTest::none));
  if (!linear_rtl) return linear_rtl.error();
  const auto pace = [](const Hardware& h) {
    return static_cast<double>(h.cycles) / static_cast<double>(h.fragments);
  };
  out.measured["clocks a pixel, quadratic shader"] = {fmt::format("{:.3f}", pace(*quadratic_rtl)),
                                                      pace(*quadratic_rtl)};
  const double in_hardware = pace(*quadratic_rtl) / pace(*linear_rtl);
  out.measured["in hardware, quadratic as a multiple of linear"] = {fmt::format("{:.3f}", in_hardware),
                                                                    in_hardware};
  const auto folded = draw_in_hardware(
      context, scene, {160, 160},
      {.shader = Shader::processors, .preset = Preset::published, .form = ProcessorForm::folded});
  if (!folded) return folded.error();
  out.measured["in hardware, Phong shading by the processors paper's version I, likewise"] = {
      fmt::format("{:.2f}", pace(*folded) / pace(*linear_rtl)), pace(*folded) / pace(*linear_rtl)};
  return Ok{};
}

// Less than half of what quadratic shading takes more than Gouraud shading in the paper.
constexpr double c_time_tolerance = 0.04;

Figure times() {
  return {
      "quadratic-times",
      c_paper,
      "sections 3, 5 and 6",
      "text: coarse spheres drawn in 230 ms by Gouraud, 250 ms by quadratic, 450 ms by Phong shading, 1 : "
      "1.09 : 1.96; "
      "one pixel a clock, 50 ns; 25 additions, 51 multiplications, 5 divisions a triangle; b > log₂ M.",
      "three plain renderers in double of a sphere of 168 triangles, exponent 50, 500×500, with one scan "
      "conversion: "
      "processor time, the best of 15 in turn; and clocks of the RTL in Verilator.",
      {{.what = "quadratic shading, as a multiple of Gouraud shading's time",
        .published = "1.09",
        .criterion = within(1.09, c_time_tolerance),
        .why_not =
            "two sums a pixel in place of one cost a processor that forms them side by side next to nothing",
        .slow = true,
        .timed = true},
       {.what = "Phong shading, likewise",
        .published = "1.96",
        .criterion = within(1.96, 0.2),
        .why_not =
            "theirs seem to have spent most of each time on what all three share, such as setting a pixel; "
            "with little beside shading, a normalization and a power a pixel cost many times an addition",
        .slow = true,
        .timed = true},
       {.what = "the first with a time beside shading that makes the second 1.96",
        .published = "1.09",
        .criterion = within(1.09, c_time_tolerance),
        .why_not = "what one more sum costs is lost in so much time beside shading",
        .slow = true,
        .timed = true},
       {.what = "clocks a pixel, quadratic shader",
        .published = "1",
        .criterion = within(1, 0.02),
        .slow = true},
       {.what = "in hardware, quadratic as a multiple of linear",
        .published = "as fast as Gouraud shading",
        .criterion = within(1, 0.02),
        .slow = true},
       {.what = "in hardware, Phong shading by the processors paper's version I, likewise",
        .published = "slower",
        .criterion = at_least(1.96),
        .slow = true},
       {"frames a second at 1000×1000 and 50 ns a pixel", "16", within(16, 0),
        "an error of the paper: 50 ns a pixel are 20; 16 belong to the 60 ns of the spherical paper"},
       {"additions, multiplications and divisions for the six coefficients", "25, 51, 5", the_same(),
        "all six share one denominator, the triangle's area, which the published form is not reduced to"},
       {"T3 of a triangle with Y2 = 0, by the printed formula", "a number", the_same(),
        "an error of the paper: a horizontal first edge divides by zero; over the squared area nothing does"},
       {"error after M = 1000 pixels by the 10 fraction bits of b > log₂ M", "below 1 colour step",
        at_most(1),
        "an error of the paper: the second difference's rounding adds up with the square of the pixels, so "
        "that "
        "it takes about 2 log₂ M bits, the 20 that figure 7 has"}},
      draw_times};
}

}  // namespace

std::vector<Figure> quadratic_figures() {
  std::vector<Figure> all{figure_7(), figure_8()};
  for (const Sphere& sphere : c_spheres) all.push_back(sphere_figure(sphere));
  all.push_back(times());
  return all;
}

}  // namespace halfway::figures
