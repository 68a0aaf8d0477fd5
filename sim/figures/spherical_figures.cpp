// SPDX-License-Identifier: Apache-2.0
// The spherical paper: figures 5, 9, 10, 11, 14, 15, 16 and 17, table 1, and its statements on them.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>
#include <utility>

#include "common/to_integer.hpp"
#include "reference/spherical_renderer.hpp"
#include "scene/builtin_meshes.hpp"
#include "scene/lights.hpp"
#include "shading/arc.hpp"
#include "shading/bell.hpp"
#include "shading/shade.hpp"
#include "sim/figures/cut_lines.hpp"
#include "sim/figures/figure_pictures.hpp"
#include "sim/files/load_scene.hpp"
#include "sim/os/threads.hpp"
#include "words/generator/cosine.hpp"

namespace halfway::figures {
namespace {

constexpr double c_half_pi = std::numbers::pi / 2;

double squared_cosine(double scale, double x) {
  const double ax = scale * std::abs(x);
  return ax < c_half_pi ? std::cos(ax) * std::cos(ax) : 0.0;
}

double power_of_cosine(double exponent, double x) {
  return highlight_power(std::cos(x), exponent);
}

// Maximum of a function of the angle over [0, pi/2].
template <class Function>
double largest_over_angles(const Function& function) {
  constexpr int c_samples = 20'000;
  double largest = 0.0;
  for (int i = 0; i <= c_samples; ++i) largest = std::max(largest, function(c_half_pi * i / c_samples));
  return largest;
}

// Step in degrees; small where sharp bells have high curvature.
double curve_step(double degrees) {
  return degrees >= -12.0 && degrees < 12.0 ? 0.75 : 3.0;
}

// Rows with x in degrees and the value of each curve, mirrored about 0.
template <class Curve>
std::vector<std::vector<double>> curves(std::span<const double> of, const Curve& curve) {
  std::vector<std::vector<double>> rows;
  for (double degrees = -90.0; degrees <= 90.0; degrees += curve_step(degrees)) {
    rows.push_back({degrees});
    for (const double n : of) rows.back().push_back(curve(n, degrees / 180.0 * std::numbers::pi));
  }
  return rows;
}

std::string curve_list(const std::string& block, const std::string& title, std::span<const double> of) {
  std::string text;
  for (std::size_t i = 0; i < of.size(); ++i)
    text += fmt::format("{}${} using 1:{} with lines linetype {} title '{} = {:.4g}'", i == 0 ? "" : ", ",
                        block, i + 2, i + 1, title, of[i]);
  return text;
}

// ---- Figure 5 ----

void draw_figure_5(const Context& context, Drawing& out) {
  constexpr FrameSize c_size{240, 180};
  const Scene coarse = sphere_scene(12, 8, 20.0);
  Scene smooth = sphere_scene(256, 128, 20.0);
  smooth.camera = coarse.camera;
  const Software drawn = draw_in_software(coarse, c_size, context.threads);
  const Frame truth = draw_in_software(smooth, c_size, context.threads).phong.frame;
  const FrameDistance gouraud = distance(drawn.gouraud.frame, truth, drawn.phong.mask),
                      phong = distance(drawn.phong.frame, truth, drawn.phong.mask);
  out.measured["Gouraud shading: how far from the smooth sphere"] = {
      fmt::format("{}, rms {:.1f}", shown(gouraud), gouraud.rms), static_cast<double>(gouraud.max_lsb)};
  out.measured["Phong shading: its rms error as a part of Gouraud's"] =
      measured(phong.rms / gouraud.rms, "{:.2f} ({}, rms {:.1f})", shown(phong), phong.rms);
  save_picture(context, "spherical-05", sheet(std::array{drawn.gouraud.frame, drawn.phong.frame}, 2),
               "A coarse sphere by Gouraud shading, with a broken highlight, and by Phong shading", out);
}

// ---- Figures 9 and 10, table 1 ----

constexpr std::array c_figure_9_exponents{5.0, 10.0, 20.0, 50.0, 500.0};
constexpr std::array c_figure_9_scales{1.45, 1.98, 2.76};

// Angle at which a bell has fallen to one half.
double half_width(double exponent) {
  return std::acos(std::pow(0.5, 1.0 / exponent));
}

void draw_figure_9(const Context& context, Drawing& out) {
  std::string scales;
  for (std::size_t i = 0; i < c_figure_9_scales.size(); ++i)
    scales += fmt::format("{}{:.2f}", i == 0 ? "" : ", ", published_scale(c_figure_9_exponents[i]));
  out.measured["the caption's a, n = 5, 10, 20"] = {.text = scales, .by_construction = true};
  double largest = 0.0;
  for (const double n : c_figure_9_exponents)
    largest = std::max(largest, largest_over_angles([&](double x) {
                         const double to = half_width(500.0) / half_width(n);
                         return std::abs(power_of_cosine(n, x) - power_of_cosine(500.0, x * to));
                       }));
  out.measured["bells brought to one width: how far apart"] = measured(largest, "{:.3f}");
  const std::string script =
      data_block("left", curves(c_figure_9_exponents, power_of_cosine)) +
      data_block("right", curves(c_figure_9_scales, squared_cosine)) +
      "set multiplot layout 1,2\nset xrange [-90:90]\nset yrange [0:1.05]\nset xtics 30\n"
      "set xlabel 'angle x in degrees'\nset key top right\nset title 'cosⁿ x'\nplot " +
      curve_list("left", "n", c_figure_9_exponents) + "\nset title 'cos² ax'\nplot " +
      curve_list("right", "a", c_figure_9_scales) + "\nunset multiplot\n";
  draw_plot(context, "spherical-09",
            {.title = "The bells of cosⁿ x for five exponents, and of cos² ax for three scales",
             .script = plot_style(860, 330) + script},
            out);
}

// Exponent and scale.
constexpr std::array<std::pair<double, double>, 7> c_table_1 = {
    {{2, 1.0}, {5, 1.4502}, {10, 1.9845}, {20, 2.7582}, {50, 4.3143}, {100, 6.0791}, {500, 13.5535}}};

// The integral of cos² ax sin x over the bell, by Simpson's rule.
double weighted_integral(double scale) {
  constexpr int c_steps = 4000;
  const double end = c_half_pi / scale, step = end / c_steps;
  double sum = 0.0;
  for (int i = 0; i <= c_steps; ++i) {
    const double weight = i == 0 || i == c_steps ? 1.0 : i % 2 == 1 ? 4.0 : 2.0;
    sum += weight * squared_cosine(scale, i * step) * std::sin(i * step);
  }
  return sum * step / 3.0;
}

void draw_table_1(const Context&, Drawing& out) {
  double largest = 0.0;
  std::string scales;
  for (const auto& [exponent, scale] : c_table_1) {
    scales += fmt::format("{}{:.4f}", scales.empty() ? "" : ", ", published_scale(exponent));
    largest = std::max(largest, std::abs(weighted_integral(scale) * (exponent + 1.0) - 1.0));
  }
  out.measured["a for n = 2, 5, 10, 20, 50, 100, 500"] = {.text = scales};
  out.measured["both sides of equation 20, by the printed a"] =
      constructed(largest, "equal within {:.1g} of themselves");
}

void draw_figure_10(const Context& context, Drawing& out) {
  constexpr std::array c_exponents{5.0, 10.0, 20.0, 50.0};
  double narrowest = 1.0, widest = 10.0, farthest = 0.0, far_exponent = 0.0, fitted = 0.0;
  for (const auto& [n, printed] : c_table_1) {
    if (n < 5) continue;  // for n = 2 the two are equal
    const double a = published_scale(n);
    // Near the centre cosⁿ x is 1 − n x²/2, and cos² ax is 1 − a² x².
    narrowest = std::min(narrowest, 2.0 * a * a / n);
    const auto reach = [&](const auto& bell) {
      double x = c_half_pi;
      while (x > 0.0 && bell(x) < 1.0 / 255.0) x -= 1e-4;
      return x;
    };
    widest = std::min(widest, reach([&, n = n](double x) { return power_of_cosine(n, x); }) /
                                  reach([&](double x) { return squared_cosine(a, x); }));
    const double far = largest_over_angles(
        [&, n = n](double x) { return std::abs(power_of_cosine(n, x) - squared_cosine(a, x)); });
    if (far > farthest) farthest = far, far_exponent = n;
    fitted = std::max(fitted, fit_error(n, fitted_bell(n)));
  }
  out.measured["curvature at the centre, cos² ax as a part of cosⁿ x's, n = 5 to 500"] =
      measured(narrowest, "{:.2f}");
  out.measured["reach above 1/255, cosⁿ x as a multiple of cos² ax's"] = measured(widest, "{:.2f}");
  out.measured["largest difference of the two, n = 5 to 500"] =
      measured(255.0 * farthest, "{:.1f}/255 (n = {}); by the bells of preset exact {:.1f}/255", far_exponent,
               255.0 * fitted);
  std::string plots;
  for (std::size_t i = 0; i < c_exponents.size(); ++i) {
    const double n = c_exponents[i], a = published_scale(n);
    std::vector<std::vector<double>> rows;
    for (double degrees = -90.0; degrees <= 90.0; degrees += curve_step(degrees)) {
      const double x = degrees / 180.0 * std::numbers::pi;
      rows.push_back({degrees, power_of_cosine(n, x), squared_cosine(a, x)});
    }
    plots += data_block(fmt::format("bells{}", i), rows);
  }
  plots +=
      "set multiplot layout 2,2\nset xrange [-90:90]\nset yrange [0:1.05]\nset xtics 30\nset ytics 0.5\n"
      "set key samplen 2\n";
  for (std::size_t i = 0; i < c_exponents.size(); ++i)
    plots += fmt::format(
        "set title 'n = {1}, a = {2:.4g}'\n"
        "plot $bells{0} using 1:2 with lines linetype 1 title 'cosⁿ x', "
        "$bells{0} using 1:3 with lines linetype 2 dashtype 2 title 'cos² ax'\n",
        i, c_exponents[i], published_scale(c_exponents[i]));
  plots += "unset multiplot\n";
  draw_plot(context, "spherical-10",
            {.title = "cosⁿ x and the cos² ax that stands for it", .script = plot_style(860, 520) + plots},
            out);
}

// ---- Figure 11 ----

constexpr std::array c_figure_11_bits{4, 6};

double entry_at(const tables::CosineTable& table, double x) {
  const double cells = table.size.entries() / 2;
  const auto cell = to_integer<std::size_t>(std::min(x / c_half_pi * cells, cells - 1.0));
  return table.entries[cell] / double(table.size.largest_entry());
}

void draw_figure_11(const Context& context, Drawing& out) {
  std::array<double, c_figure_11_bits.size()> error{};
  std::string blocks;
  for (std::size_t i = 0; i < c_figure_11_bits.size(); ++i) {
    const int bits = c_figure_11_bits[i];
    const tables::CosineTable table = tables::cosine_table(false, 2, {bits, bits});
    error[i] = tables::table_error(table);
    constexpr int c_samples = 192;  // six samples per entry with 6 address bits
    std::vector<std::vector<double>> rows;
    for (int k = 0; k < c_samples; ++k) {
      const double x = c_half_pi * (k + 0.5) / c_samples, value = entry_at(table, x);
      rows.push_back({x / c_half_pi * 90.0, value, value - squared_cosine(1.0, x)});
    }
    blocks += data_block(fmt::format("table{}", i), rows);
    if (bits == 6)
      out.measured["bits of the ROM, 6 address and 6 data bits"] =
          constructed(static_cast<double>(table.bits()), "{}");
  }
  out.measured["largest error by 6 and 6 bits as a part of that by 4 and 4"] =
      measured(error[1] / error[0], "{:.2f} ({:.1f}/255 of {:.1f}/255)", 255 * error[1], 255 * error[0]);
  const double ours = tables::table_error(tables::cosine_table(true, 2, words::c_exact_cosine_size));
  out.measured["largest error by 6 and 6 bits"] =
      measured(255 * error[1], "{:.1f}/255; by the 9 and 8 of preset exact {:.1f}/255", 255 * ours);
  const std::string script =
      blocks +
      "set multiplot layout 1,2\nset xrange [0:90]\nset xtics 15\nset xlabel 'angle in degrees'\n"
      "set yrange [0:1.05]\nset title 'cos² and its tables'\nset key top right\n"
      "plot cos(x / 90 * pi / 2) ** 2 with lines linetype 6 title 'cos²', $table0 using 1:2 with lines "
      "linetype 2 "
      "title '4 address, 4 data bits', $table1 using 1:2 with lines linetype 1 title '6 and 6'\n"
      "set yrange [-0.15:0.15]\nset title 'error'\n"
      "plot $table0 using 1:3 with lines linetype 2 title '4 and 4', $table1 using 1:3 with lines linetype 1 "
      "title "
      "'6 and 6'\nunset multiplot\n";
  draw_plot(context, "spherical-11",
            {.title = "cos² and its tables of 4 and of 6 address and data bits, and their errors",
             .script = plot_style(860, 330) + script},
            out);
}

// ---- Figures 14 and 15 ----

Scene smooth_highlights(const Context& context) {
  Scene scene = must(load_scene("highlights", context.scenes()));
  const Mesh sphere = make_uv_sphere(96, 64, 1.2);
  scene.positions_world.clear();
  scene.normals_world.clear();
  scene.triangles.clear();
  for (std::uint32_t i = 0; i < 3; ++i) {
    const auto first = static_cast<std::uint32_t>(scene.positions_world.size());
    for (const glm::dvec3& p : sphere.positions)
      scene.positions_world.push_back(p + glm::dvec3(2.5 * (i - 1.0), 0.0, 0.0));
    scene.normals_world.insert(scene.normals_world.end(), sphere.normals.begin(), sphere.normals.end());
    for (SceneTriangle t : sphere.triangles) {
      for (int corner = 0; corner < 3; ++corner) t.position[corner] += first, t.normal[corner] += first;
      t.material = i;
      scene.triangles.push_back(t);
    }
  }
  return scene;
}

// Drawn by spherical interpolation in double.
Frame interpolated(const Scene& scene, FrameSize size, SpanEnds ends, HighlightCurve curve,
                   unsigned threads) {
  const auto triangles = Projector(scene, size, {}).project_all();
  return render_spherical(scene, triangles, {.frame = size, .workers = on_threads(threads)},
                          {.ends = ends, .curve = curve})
      .frame;
}

void draw_figure_14(const Context& context, Drawing& out) {
  constexpr FrameSize c_size{378, 126};
  Scene scene = smooth_highlights(context);
  scene.camera.vertical_fov_degrees = 17.5;
  const auto by = [&](HighlightCurve curve) {
    return interpolated(scene, c_size, SpanEnds::on_surface, curve, context.threads);
  };
  const Frame power = by(HighlightCurve::power), squared = by(HighlightCurve::squared_cosine);
  // Highlights only, with maximum brightness.
  for (Material& m : scene.materials) m.ambient = m.diffuse = 0.0, m.specular = 1.0;
  const std::array bells{by(HighlightCurve::power), by(HighlightCurve::squared_cosine)};
  const auto count = [&](const Frame& frame, std::uint32_t third, int least) {
    int pixels = 0;
    for (std::uint32_t y = 0; y < c_size.height; ++y)
      for (std::uint32_t x = third * c_size.width / 3; x < (third + 1) * c_size.width / 3; ++x)
        pixels += frame.rgb[frame.offset(x, y)] >= least ? 1 : 0;
    return pixels;
  };
  constexpr int c_halo = 1, c_centre = 230;  // in steps of 1/255
  std::string halos, centres;
  double least_halo = 1e9, largest_centre = 0.0;
  for (std::uint32_t i = 0; i < 3; ++i) {
    const auto ratio = [&](int least) {
      return static_cast<double>(count(bells[0], i, least)) / count(bells[1], i, least);
    };
    const double halo = ratio(c_halo), centre = ratio(c_centre);
    halos += fmt::format("{}{:.2f}", i == 0 ? "" : ", ", halo);
    centres += fmt::format("{}{:.2f}", i == 0 ? "" : ", ", centre);
    least_halo = std::min(least_halo, halo);
    largest_centre = std::max(largest_centre, centre);
  }
  out.measured["halos (pixels of 1/255 and more), cosⁿ as a multiple of cos² ax"] = {halos, least_halo};
  out.measured["centres (pixels of 230/255 and more), likewise"] = {centres, largest_centre};
  const FrameDistance apart = distance(power, squared, {});
  out.measured["the two pictures"] = {shown(apart), static_cast<double>(apart.max_lsb)};
  save_picture(context, "spherical-14", sheet(std::array{power, squared}, 1),
               "Spheres of exponents 5, 10 and 20: highlights by cosⁿ above, by cos² ax below", out);
}

constexpr FrameSize c_rings_frame{640, 480};

// Rings around highlights, caused by small tables. Measured in discs around the highlights of the scene
// `highlights`, inside every bell, where wrapping angles cause no ghost highlights.
struct Rings {
  int largest_step = 0;    ///< between neighbouring pixels of a line, in steps of 1/255
  double rms_error = 0.0;  ///< against the same interpolation without tables
};

int blue(const Frame& frame, int x, int y) {
  return frame.rgb[frame.offset(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)) + 2];
}

// Two frames of the scene `highlights` with c_rings_frame: with tables and without.
Rings measure_rings(const Frame& frame, const Frame& without_tables) {
  constexpr int c_spheres = 3, c_radius = 40, c_third = static_cast<int>(c_rings_frame.width) / c_spheres;
  Rings rings;
  double squares = 0.0;
  int count = 0;
  for (int sphere = 0; sphere < c_spheres; ++sphere) {
    int peak_x = 0, peak_y = 0;
    for (int y = c_radius; y < static_cast<int>(c_rings_frame.height) - c_radius; ++y)
      for (int x = sphere * c_third + c_radius; x < (sphere + 1) * c_third - c_radius; ++x)
        if (blue(without_tables, x, y) > blue(without_tables, peak_x, peak_y) || peak_x == 0)
          peak_x = x, peak_y = y;
    for (int dy = -c_radius; dy <= c_radius; ++dy) {
      const int y = peak_y + dy, half = to_integer<int>(std::sqrt(c_radius * c_radius - dy * dy));
      for (int x = peak_x - half; x <= peak_x + half; ++x) {
        rings.largest_step =
            std::max(rings.largest_step, std::abs(blue(frame, x + 1, y) - blue(frame, x, y)));
        const int error = std::abs(blue(frame, x, y) - blue(without_tables, x, y));
        squares += error * error;
        ++count;
      }
    }
  }
  rings.rms_error = std::sqrt(squares / count);
  return rings;
}

void draw_figure_15(const Context& context, Drawing& out) {
  const Scene scene = must(load_scene("highlights", context.scenes()));
  const Frame without = interpolated(scene, c_rings_frame, SpanEnds::slerped_along_edges,
                                     HighlightCurve::squared_cosine, context.threads);
  const Rings none = measure_rings(without, without);
  std::vector<Frame> parts;
  const auto draw = [&](const PlanRequest& plan) {
    Frame frame = draw_in_hardware(context, scene, c_rings_frame, plan).frame;
    parts.push_back(cut_tile(frame, {252, 157, {136, 136}}));
    return frame;
  };
  std::array<Rings, 2> rings;
  for (std::size_t i = 0; i < 2; ++i) {
    const int bits = c_figure_11_bits[i];
    rings[i] = measure_rings(draw({.shader = Shader::spherical,
                                   .preset = Preset::published,
                                   .tables = words::CosineSize{bits, bits}}),
                             without);
    out.measured[fmt::format("{} bits: largest step between neighbouring pixels at highlights", bits)] = {
        fmt::format("{}/255; without tables {}/255", rings[i].largest_step, none.largest_step),
        static_cast<double>(rings[i].largest_step - none.largest_step)};
  }
  out.measured["rms error of 6 bits as a part of that of 4"] =
      measured(rings[1].rms_error / rings[0].rms_error, "{:.2f} ({:.1f}/255 of {:.1f}/255)",
               rings[1].rms_error, rings[0].rms_error);
  draw({.shader = Shader::spherical});
  save_picture(context, "spherical-15", sheet(parts, 3),
               "A coarse sphere by tables of 4 bits, with rings around its highlight, by tables of 6 bits, "
               "with faint ones, and by preset exact, without",
               out);
}

// ---- Figure 16 ----

constexpr FrameSize c_bump_size{144, 108};

constexpr std::array c_figure_16_ways{"the method in double against Phong shading",
                                      "the published hardware, whose angle wraps, against Phong shading",
                                      "the same with lines cut where the bell ends",
                                      "preset exact against Phong shading"};

void draw_figure_16(const Context& context, Drawing& out) {
  std::vector<Frame> pictures;
  for (const auto& [name, scene] : {std::pair{"hen", hen_scene()}, {"teapot", teapot_scene(context)}})
    for (const FrameSize size : {c_compared_size, c_bump_size}) {
      const bool compared = size.width == c_compared_size.width;
      if (context.quick && compared) continue;
      const ReferenceImage phong = draw_in_software(scene, size, context.threads).phong;
      const auto by = [&, &scene = scene](HighlightCurve curve) {
        return interpolated(scene, size, SpanEnds::slerped_along_edges, curve, context.threads);
      };
      std::vector<Frame> drawn{draw_mesh(scene, size, context.threads), phong.frame,
                               by(HighlightCurve::squared_cosine)};
      std::array<std::string, c_figure_16_ways.size()> more;  // notes to the measured values
      const auto sent = [](std::uint64_t vectors, std::uint64_t records) {
        return fmt::format("; {} init vectors and {} line records", vectors, records);
      };
      const Hardware wrapping =
          draw_in_hardware(context, scene, size, {.shader = Shader::spherical, .preset = Preset::published});
      drawn.push_back(wrapping.frame);
      more[1] = sent(wrapping.counts.vectors, wrapping.counts.records);
      const CutLines cut_lines = draw_with_cut_lines(scene, size);
      drawn.push_back(cut_lines.frame);
      more[2] = sent(cut_lines.vectors, cut_lines.records);
      drawn.push_back(draw_in_hardware(context, scene, size, {.shader = Shader::spherical}).frame);
      if (!compared) {
        pictures.insert(pictures.end(), drawn.begin(), drawn.end());
        continue;
      }
      for (std::size_t i = 0; i < c_figure_16_ways.size(); ++i) {
        if (i == 0) {
          const Likeness power = likeness(by(HighlightCurve::power), phong.frame, phong.mask);
          more[i] = fmt::format("; with cosⁿ itself {:.2f} % and {}/255", power.seen_percent,
                                power.distance.max_lsb);
        }
        Measured alike = likeness(drawn[2 + i], phong.frame, phong.mask).measured();
        alike.text += more[i];
        out.measured[fmt::format("{}: {}", name, c_figure_16_ways[i])] = alike;
      }
    }
  save_picture(context, "spherical-16", sheet(pictures, 6),
               "A hen and the teapot: mesh, Phong shading, the published method in double, the published "
               "hardware with ghost highlights, the same with cut lines, and preset exact",
               out);
}

// ---- Sections 3.2 and 6: one vector fixed, or both interpolated ----

struct Turn {
  glm::dvec3 begin, end;
};

// Largest difference in degrees between the angles of the two schemes along the way.
double scheme_angle(const Turn& u, const Turn& v) {
  constexpr int c_steps = 16;
  const CosineArc arc = cosine_arc(u.begin, u.end, v.begin, v.end);
  double largest = 0.0;
  for (int i = 1; i < c_steps; ++i) {
    const double t = static_cast<double>(i) / c_steps;
    const double both = glm::dot(slerp(u.begin, u.end, t), slerp(v.begin, v.end, t));
    const double angle = [](double c) { return std::acos(std::clamp(c, -1.0, 1.0)); }(arc.at(t)) -
                         std::acos(std::clamp(both, -1.0, 1.0));
    largest = std::max(largest, std::abs(angle));
  }
  return largest * 180.0 / std::numbers::pi;
}

// Maximum over the edges of visible triangles, for each light's N.L and N.H.
double largest_scheme_angle(const Scene& scene, FrameSize size) {
  double largest = 0.0;
  for (const ScreenTriangle& t : Projector(scene, size, {}).project_all())
    for (int i = 0; i < 3; ++i) {
      const std::array ends{&t.vertex[i], &t.vertex[(i + 1) % 3]};
      std::array<glm::dvec3, 2> n, to_eye;
      for (int k = 0; k < 2; ++k) {
        n[k] = glm::normalize(ends[k]->normal_world);
        to_eye[k] = direction(ends[k]->position_world, scene.camera.eye_world);
      }
      const auto add = [&](glm::dvec3 l0, glm::dvec3 l1) {
        if (glm::dot(n[0], l0) <= 0.0 || glm::dot(n[1], l1) <= 0.0) return;
        largest = std::max(
            {largest, scheme_angle({n[0], n[1]}, {l0, l1}),
             scheme_angle({n[0], n[1]}, {glm::normalize(l0 + to_eye[0]), glm::normalize(l1 + to_eye[1])})});
      };
      for_each_light(scene, [&](const Light& light) {
        add(direction_to(light, ends[0]->position_world), direction_to(light, ends[1]->position_world));
      });
    }
  return largest;
}

FrameDistance between_schemes(const Scene& scene, FrameSize size, unsigned threads) {
  const auto triangles = Projector(scene, size, {}).project_all();
  const RenderOptions options{.frame = size, .workers = on_threads(threads)};
  const auto by = [&](VectorScheme scheme) {
    return render_spherical(scene, triangles, options, {scheme, SpanEnds::slerped_along_edges});
  };
  const ReferenceImage fixed = by(VectorScheme::one_fixed);
  return distance(fixed.frame, by(VectorScheme::both_interpolated).frame, fixed.mask);
}

// 36 triangles close to a light, so that vectors turn by large angles on each.
Scene close_light_scene() {
  Scene scene =
      scene_of(make_uv_sphere(6, 4, 1.0), {.colour = glm::dvec3(0.6), .exponent = 50.0}, {0.0, 0.0, 1.0});
  scene.directional.clear();
  scene.ambient = glm::dvec3(0.2);
  scene.positional = {{{0.45, 0.6, 1.0}, glm::dvec3(1.0)}};
  scene.camera = {.eye_world = {0.0, 0.0, 3.2}};
  return scene;
}

// Equation 15's last line as printed, and equations 16 and 17, compared with the vectors: the largest error
// of the cosine.
struct EquationErrors {
  double printed_15 = 0.0, from_16 = 0.0;
};
EquationErrors equation_errors() {
  std::mt19937 random(15);
  std::normal_distribution<double> normal;
  EquationErrors errors;
  for (int i = 0; i < 1000; ++i) {
    const auto unit = [&] {
      return glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
    };
    const glm::dvec3 u1 = unit(), u2 = unit(), v = unit();
    const double cos_gamma = glm::dot(u1, u2), gamma = std::acos(cos_gamma), sin_gamma = std::sin(gamma);
    if (sin_gamma < 0.1) continue;
    const double cos_1 = glm::dot(u1, v), cos_2 = glm::dot(u2, v);
    for (const double t : {0.25, 0.5, 0.75}) {
      const double right = glm::dot(slerp(u1, u2, t), v);
      const double printed =
          std::cos(t * gamma) * cos_1 + std::sin(t * gamma) * (cos_1 * cos_gamma - cos_2) / sin_gamma;
      const double b = (cos_2 - cos_1 * cos_gamma) / sin_gamma;
      const double by_16 = std::hypot(cos_1, b) * std::cos(t * gamma - std::atan2(b, cos_1));
      errors.printed_15 = std::max(errors.printed_15, std::abs(printed - right));
      errors.from_16 = std::max(errors.from_16, std::abs(by_16 - right));
    }
  }
  return errors;
}

void draw_schemes(const Context& context, Drawing& out) {
  constexpr FrameSize c_size{320, 240};
  double angle = 0.0;
  unsigned largest = 0;
  for (const char* name : {"spheres", "highlights", "teapot", "lights"}) {
    const Scene scene = must(load_scene(name, context.scenes()));
    angle = std::max(angle, largest_scheme_angle(scene, c_size));
    largest = std::max(largest, between_schemes(scene, c_size, context.threads).max_lsb);
  }
  out.measured["built-in scenes: largest difference of the pictures"] =
      measured(largest, "{}/255; the angles differ by up to {:.2f}°", angle);
  const Scene close = close_light_scene();
  const FrameDistance apart = between_schemes(close, c_size, context.threads);
  out.measured["a sphere of 36 triangles close to a light: the pictures"] = {
      fmt::format("{}; the angles differ by up to {:.1f}°", shown(apart),
                  largest_scheme_angle(close, c_size)),
      static_cast<double>(apart.max_lsb)};
  const EquationErrors errors = equation_errors();
  out.measured["equation 15, last line, as printed"] =
      measured(errors.printed_15, "off the vectors' cosine by up to {:.2f}");
  // Rounding errors only. They depend on the compiler, so the page prints a bound.
  constexpr double c_rounding = 1e-13;
  out.measured["equations 16 and 17"] =
      constructed(std::max(errors.from_16, c_rounding), "equal within {:.0e}");

  // Both vectors turn by the same angle in perpendicular planes.
  std::vector<std::vector<double>> rows;
  for (int degrees = 0; degrees <= 90; degrees += 2) {
    const double a = degrees / 180.0 * std::numbers::pi, c = std::cos(a), s = std::sin(a);
    rows.push_back({static_cast<double>(degrees),
                    scheme_angle({{0, 0, 1}, {s, 0, c}}, {{0, 0, 1}, {0, s, c}}),
                    scheme_angle({{0, 0, 1}, {s, 0, c}}, {{0, 0, 1}, {-s, 0, c}}),
                    scheme_angle({{0.6, 0, 0.8}, {0.6 * c, 0.6 * s, 0.8}}, {{0, 0, 1}, {0, s, c}})});
  }
  draw_plot(
      context, "spherical-schemes",
      {.title = "How far the angle between two turning vectors differs where one is constant",
       .script =
           plot_style(640, 330) + data_block("angles", rows) +
           "set xlabel 'each vector turns by, degrees'\nset ylabel 'largest difference, degrees'\nset xrange "
           "[0:90]\nset xtics 15\nset key top left\n"
           "plot $angles using 1:2 with lines linetype 1 title 'from one direction, at right angles', "
           "$angles using 1:3 with lines linetype 3 title 'from one direction, opposed', "
           "$angles using 1:4 with lines linetype 2 title 'from 37° apart, at right angles'\n"},
      out);
}

}  // namespace

std::map<std::string, Draw> spherical_drawings() {
  return {{"spherical-05", draw_figure_5},  {"spherical-09", draw_figure_9},
          {"spherical-10", draw_figure_10}, {"spherical-table-1", draw_table_1},
          {"spherical-11", draw_figure_11}, {"spherical-14", draw_figure_14},
          {"spherical-15", draw_figure_15}, {"spherical-16", draw_figure_16},
          {"spherical-17", draw_figure_17}, {"spherical-schemes", draw_schemes}};
}

}  // namespace halfway::figures
