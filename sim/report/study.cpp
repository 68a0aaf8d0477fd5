// SPDX-License-Identifier: Apache-2.0
// Accuracy against time: the points of a study, as plots whose points open.
#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <optional>
#include <set>

#include "sim/report/front.hpp"
#include "sim/report/html.hpp"
#include "sim/report/plot.hpp"
#include "sim/report/section.hpp"
#include "sim/scene_files/load_scene.hpp"
#include "sim/study/design_point.hpp"
#include "sim/study/hardware.hpp"
#include "sim/study/record.hpp"
#include "sim/system/csv.hpp"
#include "sim/system/file.hpp"

namespace halfway::report {
namespace {

// A column of the study's table, and its words.
struct Measure {
  const char* column;
  const char* words;
};
constexpr Measure c_time = {"frame_ns", "time of the frame, ns"};
constexpr Measure c_clocks = {"cycles", "clocks of the frame, RTL"};
constexpr Measure c_rms = {"rms", "rms error, steps of 1/255"};

struct Axes {
  const char* id;
  Measure x, y;
};
constexpr std::array c_axes = {
    Axes{"rms-time", c_time, c_rms},
    Axes{"largest-time", c_time, {"largest_error", "largest error, steps of 1/255"}},
    Axes{"highlight-time", c_time, {"highlight_rms", "rms error in highlights, steps of 1/255"}},
    Axes{"perceived-time", c_time, {"perceived_pixels", "pixels seen to differ (Yee)"}},
    Axes{"mach-time", c_time, {"mach_rms", "rms of Mach bands, steps of 1/255 a pixel"}},
    Axes{"rms-clocks", c_clocks, c_rms},
    Axes{"rms-cells", {"cells", "cells: LUTs (multipliers among them), flip-flops, memory"}, c_rms},
    Axes{"rms-host", {"host_instructions", "instructions of setup on the host"}, c_rms},
};

// Columns that a point's panel shows as they are, and their words.
constexpr std::array c_told = {
    std::pair{"hardware", "hardware"},
    std::pair{"cycles", "clocks of the frame"},
    std::pair{"fragments", "fragments"},
    std::pair{"luts", "LUTs"},
    std::pair{"flip_flops", "flip-flops"},
    std::pair{"multipliers", "multipliers"},
    std::pair{"memory_bits", "bits of memory"},
    std::pair{"product_bits", "bits of products"},
    std::pair{"multiplier_luts", "LUTs of the multipliers"},
    std::pair{"cells", "cells in all"},
    std::pair{"clock_mhz", "clock, MHz"},
    std::pair{"clock", "where that clock is from"},
    std::pair{"frame_ns", "ns a frame"},
    std::pair{"fragment_ns", "ns a fragment"},
    std::pair{"rms", "rms error, /255"},
    std::pair{"largest_error", "largest error, /255"},
    std::pair{"error_99", "99th percentile of errors, /255"},
    std::pair{"psnr_db", "PSNR, dB"},
    std::pair{"highlight_rms", "rms error in highlights, /255"},
    std::pair{"perceived_pixels", "pixels seen to differ"},
    std::pair{"mach_rms", "Mach bands, rms"},
    std::pair{"triangles", "triangles"},
    std::pair{"leaves", "pieces after splitting"},
    std::pair{"init_vectors", "init vectors"},
    std::pair{"line_records", "line records"},
    std::pair{"host_evaluations", "evaluations on the host"},
    std::pair{"host_instructions", "instructions of setup on the host"},
    std::pair{"front", "on the front"},
};

// Those of the table of all points.
constexpr std::array c_columns = {
    std::pair{"front", "on the front"},
    std::pair{"frame_ns", "ns a frame"},
    std::pair{"cycles", "clocks"},
    std::pair{"cells", "cells"},
    std::pair{"host_instructions", "instructions on the host"},
    std::pair{"rms", "rms error"},
    std::pair{"largest_error", "largest error"},
    std::pair{"error_99", "99th percentile"},
    std::pair{"psnr_db", "PSNR, dB"},
    std::pair{"perceived_pixels", "pixels seen to differ"},
    std::pair{"mach_rms", "Mach bands, rms"},
};

// What only hardware has: the table holds 0 there of software.
constexpr std::array c_of_hardware = {"cycles",       "fragments",    "leaves",
                                      "init_vectors", "line_records", "host_evaluations"};

bool in_hardware(const Table& table, std::size_t row) {
  return !table.text(row, "hardware").empty();
}

// Whole where there are four digits or more before the point: never with an exponent.
std::string shown(double value) {
  return value >= 1e3 ? fmt::format("{:.0f}", value) : fmt::format("{:.4g}", value);
}

// Empty: the table tells nothing.
std::string told(const Table& table, std::size_t row, const char* column) {
  const std::string_view name = column;
  if (!in_hardware(table, row) && std::ranges::find(c_of_hardware, name) != c_of_hardware.end()) return "";
  const std::string& text = table.text(row, column);
  if (name == "front") return text.empty() ? "" : text == "1" ? "yes" : "no";
  if (text == "inf") return "∞";
  const auto value = table.number(row, column);
  return value ? shown(*value) : text;
}

// The same in a table's cell.
std::string cell(const Table& table, std::size_t row, const char* column) {
  const std::string text = told(table, row, column);
  return text.empty() ? "–" : escaped(text);
}

bool has_any(const Table& table, const char* column) {
  for (std::size_t row = 0; row < table.rows.size(); ++row)
    if (table.number(row, column)) return true;
  return false;
}

// What a plot does not show.
std::string missing_note(const std::map<std::string, std::size_t>& missing, const std::string& why) {
  if (missing.empty()) return "";
  std::size_t count = 0;
  std::string names;
  for (const auto& [name, points] : missing) {
    count += points;
    names += fmt::format("{}{} of {}", names.empty() ? "" : "; ", points, escaped(name));
  }
  return fmt::format(" <small>(not here, as {}: {}; in all {})</small>", why, names, count);
}

// In words; of any of its rows.
std::string told_picture(const Table& table, std::size_t row) {
  const std::string& exponent = table.text(row, "exponent");
  return fmt::format("{}{}tessellation {}, {}×{}", exponent.empty() ? "" : "exponent " + exponent,
                     exponent.empty() ? "" : ", ", table.text(row, "tessellation"), table.text(row, "width"),
                     table.text(row, "height"));
}

// The space in the checkout that all points are of, the smallest, and how much of it they are.
std::string told_space(const Page& page, const Table& points) {
  std::set<std::string> names;
  for (std::size_t row = 0; row < points.rows.size(); ++row) names.insert(points.text(row, "point"));
  std::string told = fmt::format("{} points, of no space in <code>sim/studies</code>", names.size());
  std::size_t least = 0;
  std::error_code error;
  for (const auto& entry :
       std::filesystem::directory_iterator(page.settings.folders.source / "sim/studies", error)) {
    if (entry.path().extension() != ".toml") continue;
    const auto space = study::read_space(entry.path());
    if (!space) continue;  // a scene
    const auto has = [&](const std::string& name) {
      return std::ranges::any_of(*space, [&](const study::DesignPoint& p) { return p.name() == name; });
    };
    if ((least != 0 && space->size() >= least) || !std::ranges::all_of(names, has)) continue;
    least = space->size();
    told = fmt::format("{} of the {} points of <code>sim/studies/{}</code>", names.size(), least,
                       escaped(entry.path().filename().string()));
  }
  return told;
}

// Which study it is: another may lie where `make study` leaves its own.
std::string told_study(Page& page, const Table& points, const std::filesystem::path& file) {
  if (points.rows.empty()) return "";
  const std::string &scene = points.text(0, "scene"), &hash = points.text(0, "scene_hash");
  std::error_code error;
  const auto written = std::filesystem::last_write_time(file, error);
  const auto seconds = std::chrono::time_point_cast<std::chrono::seconds>(
      std::filesystem::file_time_type::clock::to_sys(written));
  std::string html = fmt::format(
      "<p id=\"study/of\">The scene <strong>{}</strong> (hash <code>{}</code>), {}, in a table of "
      "{:%Y-%m-%d}; "
      "{}.</p>\n",
      escaped(scene), escaped(hash), told_space(page, points), fmt::gmtime(seconds),
      escaped(points.text(0, "tools")));
  const std::filesystem::path& source = page.settings.folders.source;
  const auto usual = load_scene((source / "sim/studies/sphere.toml").string(), source / "sim/scenes");
  if (usual && study::scene_hash(*usual) != hash) {
    const std::string note =
        fmt::format("The study is of the scene {}, not of sim/studies/sphere.toml as it now is", scene);
    page.report.notes.push_back(note + "; make study measures that");
    html +=
        fmt::format("<p class=\"missing\">{}; <code>make study</code> measures that.</p>\n", escaped(note));
  }
  return html;
}

}  // namespace

Status add_study(Page& page) {
  const std::filesystem::path file = page.settings.study / "study.csv";
  page.data["points"] = Json::array();
  if (!std::filesystem::exists(file)) {
    page.parts["study"] = page.lacks("Accuracy against time", "make study");
    return Ok{};
  }
  const auto points = read_csv(file);
  if (!points) return points.error();

  std::vector<std::string> series;
  std::set<std::string> hardware_series;
  std::map<std::string, std::size_t> phong;  // the reference of each picture
  for (std::size_t row = 0; row < points->rows.size(); ++row) {
    page.settings.on_progress(fmt::format("points: {} of {}", row + 1, points->rows.size()));
    if (points->text(row, "method") == "phong") phong.emplace(picture_of(*points, row), row);
    const std::string of = series_of(*points, row);
    if (std::ranges::find(series, of) == series.end()) series.push_back(of);
    if (in_hardware(*points, row)) hardware_series.insert(of);
    Json told_of = Json::array();
    for (const auto& [column, words] : c_told)
      if (const std::string value = told(*points, row, column); !value.empty())
        told_of.push_back({words, value});
    Json point = {{"name", points->text(row, "point")}, {"told", std::move(told_of)}};
    const std::filesystem::path picture =
        page.settings.study / "points" / (points->text(row, "record") + ".png");
    if (std::filesystem::exists(picture)) {
      auto uri = data_uri(picture, "image/png");
      if (!uri) return uri.error();
      point["image"] = std::move(*uri);
      point["width"] = points->number(row, "width").value_or(0);
      point["height"] = points->number(row, "height").value_or(0);
    }
    page.data["points"].push_back(std::move(point));
    ++page.report.points;
  }
  for (std::size_t row = 0; row < points->rows.size(); ++row)
    if (const auto reference = phong.find(picture_of(*points, row)); reference != phong.end())
      page.data["points"][row]["reference"] = reference->second;

  const std::string picture = commonest_picture(*points);
  std::string html, first;  // the first plot's prefix: marks of the legend are its
  const bool timed = has_any(*points, c_time.column);
  for (const Axes& axes : c_axes) {
    const bool of_time = axes.x.column == c_time.column;
    if (!timed && axes.x.column == c_clocks.column) continue;  // drawn already
    const Measure& along = of_time && !timed ? c_clocks : axes.x;
    Plot plot{.x_label = along.words, .y_label = axes.y.words};
    // How many have no place along x, by series, and of these those that never have one.
    std::map<std::string, std::size_t> missing, too_large;
    for (std::size_t row = 0; row < points->rows.size(); ++row) {
      const auto x = points->number(row, along.column), y = points->number(row, axes.y.column);
      const std::string name = series_of(*points, row);
      if (!y) continue;
      if (!in_hardware(*points, row)) {
        if (picture_of(*points, row) == picture) plot.levels.push_back({*y, name});
        continue;
      }
      if (!x) {
        const std::string& clock = points->text(row, "clock");
        const bool has_no_room =
            along.column == c_time.column && !clock.empty() && clock != study::c_not_placed;
        ++(has_no_room ? too_large : missing)[name];
        continue;
      }
      const auto s = static_cast<std::size_t>(std::ranges::find(series, name) - series.begin());
      plot.points.push_back({*x, *y, s, row,
                             fmt::format("{}: {} {}, {} {}", points->text(row, "point"), along.words,
                                         shown(*x), axes.y.words, shown(*y)),
                             picture_of(*points, row) != picture});
    }
    if (plot.points.empty()) continue;
    if (first.empty()) first = axes.id;
    page.settings.on_progress(fmt::format("plot: {}", axes.id));
    plot.front = lower_left(plot.points);
    const auto drawn = draw_plot(plot, page.scratch);
    if (!drawn) return drawn.error();
    const std::string title = fmt::format("{}, against {}", axes.y.words, along.words);
    const auto svg =
        inline_svg(*drawn, fmt::format("{}-", axes.id),
                   fmt::format("{}; {} points, each a link", title, plot.points.size()), "group");
    if (!svg) return svg.error();
    html += fmt::format(
        "<figure class=\"plot\" id=\"plot/{}\"><figcaption>{}{}</figcaption><div class=\"scroll\">{}</div>"
        "</figure>\n",
        axes.id, title,
        missing_note(missing, along.column == c_time.column
                                  ? "no clock of their hardware is known, which <code>make study "
                                    "PLACE=1</code> finds"
                                  : "this was not measured of them") +
            missing_note(too_large, "the device has no room for their hardware"),
        *svg);
  }
  std::string legend;
  for (std::size_t s = 0; s < series.size(); ++s) {
    if (!hardware_series.contains(series[s])) continue;  // a line across
    const PointLook look = look_of(s);
    legend += fmt::format(
        "<li><svg viewBox=\"-8 -8 16 16\" fill=\"none\" aria-hidden=\"true\"><use href=\"#{}-gpPt{}\" "
        "transform=\"scale(4.5)\" "
        "color=\"{}\"/></svg> {}</li>\n",
        first, look.shape - 1, look.colour, escaped(series[s]));
  }
  std::string pictures = "The dashed line joins the designs that no other beats in both.";
  std::size_t of = 0, others = 0;  // a row of the picture; how many there are of others
  for (std::size_t row = 0; row < points->rows.size(); ++row)
    if (picture_of(*points, row) == picture)
      of = row;
    else
      ++others;
  if (others > 0)
    pictures = fmt::format(
        "Faint points drew other pictures than that of {}. Of it, the dashed line joins the designs that no "
        "other beats in both.",
        told_picture(*points, of));
  pictures +=
      " A dotted line is software, which has no clocks: how far it errs. 0 has a place of its own on either "
      "axis.";
  html = told_study(page, *points, file) +
         fmt::format(
             "<ul class=\"legend\" aria-label=\"Legend\">\n{}</ul>\n<p>{}</p>\n<div class=\"plots\">\n{}",
             legend, pictures, html);
  html += "</div>\n<details><summary>All points as a table</summary>\n";
  std::vector<std::vector<std::string>> rows;
  std::vector<std::string> head = {"point"};
  for (const auto& [column, words] : c_columns) head.emplace_back(words);
  for (std::size_t row = 0; row < points->rows.size(); ++row) {
    auto& cells = rows.emplace_back();
    cells.push_back(fmt::format("<a href=\"#point-{}\">{}</a>", row, escaped(points->text(row, "point"))));
    for (const auto& [column, words] : c_columns) cells.push_back(cell(*points, row, column));
  }
  html += table("Points of the study", head, rows);
  page.parts["study"] = html + "</details>\n";
  const auto front = write_front(*points, page.settings.page.parent_path(), page.scratch);
  if (!front) return front.error();
  return Ok{};
}

}  // namespace halfway::report
