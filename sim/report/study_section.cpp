// SPDX-License-Identifier: Apache-2.0
// Section with accuracy against time: the points of a study as plots with links to the points.
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <set>

#include "sim/files/load_scene.hpp"
#include "sim/os/csv.hpp"
#include "sim/os/file.hpp"
#include "sim/report/front_plot.hpp"
#include "sim/report/html.hpp"
#include "sim/report/linked_plot.hpp"
#include "sim/report/section.hpp"
#include "sim/study/design_point.hpp"
#include "sim/study/hardware.hpp"
#include "sim/study/record.hpp"

namespace halfway::report {
namespace {

// A column of the study's table and its description.
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
    Axes{"perceived-time", c_time, {"perceived_pixels", "pixels seen to differ (FLIP)"}},
    Axes{"mach-time", c_time, {"mach_rms", "rms of Mach bands, steps of 1/255 per pixel"}},
    Axes{"rms-clocks", c_clocks, c_rms},
    Axes{"rms-cells", {"cells", "cells: LUTs (multipliers among them), flip-flops, memory"}, c_rms},
    Axes{"rms-host", {"host_instructions", "instructions of setup on the host"}, c_rms},
};

// Columns that a point's panel shows unchanged, and their descriptions.
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
    std::pair{"device", "FPGA"},
    std::pair{"clock", "origin of that clock"},
    std::pair{"frame_ns", "ns per frame"},
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

// Those that the table of all points has too.
constexpr std::array c_shown_columns = {
    "front",    "frame_ns", "cycles",           "cells",   "host_instructions", "rms", "largest_error",
    "error_99", "psnr_db",  "perceived_pixels", "mach_rms"};

// Columns that apply to hardware only; the table has 0 for software.
constexpr std::array c_of_hardware = {"cycles",       "fragments",    "leaves",
                                      "init_vectors", "line_records", "host_evaluations"};

// Print an integer from 1000 on, otherwise four digits; never with an exponent.
std::string shown(double value) {
  return value >= 1e3 ? fmt::format("{:.0f}", value) : fmt::format("{:.4g}", value);
}

// Text of a cell for the page; empty if unknown.
std::string text_of(const Table& table, std::size_t row, const char* column) {
  const std::string_view name = column;
  if (!is_hardware(table, row) && std::ranges::find(c_of_hardware, name) != c_of_hardware.end()) return "";
  const std::string& text = table.text(row, column);
  if (name == "front") return text.empty() ? "" : text == "1" ? "yes" : "no";
  if (text == "inf") return "∞";
  const auto value = table.number(row, column);
  return value ? shown(*value) : text;
}

bool has_any(const Table& table, const char* column) {
  for (std::size_t row = 0; row < table.rows.size(); ++row)
    if (table.number(row, column)) return true;
  return false;
}

// Add entries to a plot's list `missing`: the points not shown, and the reason.
void add_missing(Json& plot, const std::map<std::string, std::size_t>& missing, const char* why) {
  if (missing.empty()) return;
  std::size_t count = 0;
  std::vector<std::string> names;
  for (const auto& [name, points] : missing) {
    count += points;
    names.push_back(fmt::format("{} of {}", points, name));
  }
  plot["missing"].push_back(
      {{"why", why}, {"points", fmt::format("{}", fmt::join(names, "; "))}, {"count", count}});
}

// Describe the picture of a row in words.
std::string told_picture(const Table& table, std::size_t row) {
  const std::string& exponent = table.text(row, "exponent");
  return fmt::format("{}{}tessellation {}, {}×{}", exponent.empty() ? "" : "exponent " + exponent,
                     exponent.empty() ? "" : ", ", table.text(row, "tessellation"), table.text(row, "width"),
                     table.text(row, "height"));
}

// Identify the study, because the folder of `make study` may contain another one. `points` and `space`: the
// smallest space of the checkout that contains all its points, and the share of the space that was measured.
Json study_of(const Page& page, const Table& points, const std::filesystem::path& file) {
  std::error_code error;
  const auto written = std::filesystem::last_write_time(file, error);
  const auto seconds = std::chrono::time_point_cast<std::chrono::seconds>(
      std::filesystem::file_time_type::clock::to_sys(written));
  std::set<std::string> names;
  for (std::size_t row = 0; row < points.rows.size(); ++row) names.insert(points.text(row, "point"));
  Json of = {{"scene", points.text(0, "scene")},
             {"hash", points.text(0, "scene_hash")},
             {"points", fmt::format("{} points, of no space in", names.size())},
             {"space", "sim/study/spaces"},
             {"date", fmt::format("{:%Y-%m-%d}", fmt::gmtime(seconds))},
             {"tools", points.text(0, "tools")}};
  std::size_t least = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(page.settings.folders.source / "sim/study/spaces", error)) {
    if (entry.path().extension() != ".toml") continue;
    const auto space = caught([&] { return study::read_space(entry.path()); });
    if (!space) continue;  // a scene file
    const auto has = [&](const std::string& name) {
      return std::ranges::find(*space, name, &study::DesignPoint::name) != space->end();
    };
    if ((least != 0 && space->size() >= least) || !std::ranges::all_of(names, has)) continue;
    least = space->size();
    of["points"] = fmt::format("{} of the {} points of", names.size(), least);
    of["space"] = "sim/study/spaces/" + entry.path().filename().string();
  }
  return of;
}

// A note if it is not the default study.
Json unusual(Page& page, const Table& points) {
  const std::filesystem::path& source = page.settings.folders.source;
  const auto usual = load_scene((source / "sim/study/spaces/sphere.toml").string(), source / "sim/scenes");
  if (!usual || study::scene_hash(*usual) == points.text(0, "scene_hash")) return nullptr;
  const std::string note =
      fmt::format("The study is of the scene {}, not of sim/study/spaces/sphere.toml as it now is",
                  points.text(0, "scene"));
  page.report.notes.push_back(note + "; make study measures that");
  return note;
}

// The panels of all points: values, frame, and the point with the reference of its picture.
Json points_of(Page& page, const Table& points) {
  std::map<std::string, std::size_t> phong;  // the reference row of each picture
  for (std::size_t row = 0; row < points.rows.size(); ++row)
    if (points.text(row, "method") == "phong") phong.emplace(picture_of(points, row), row);
  Json all = Json::array();
  for (std::size_t row = 0; row < points.rows.size(); ++row) {
    page.settings.on_progress(fmt::format("points: {} of {}", row + 1, points.rows.size()));
    Json& point = all.emplace_back(Json{{"name", points.text(row, "point")}, {"values", Json::array()}});
    for (const auto& [column, words] : c_told)
      if (const std::string value = text_of(points, row, column); !value.empty())
        point["values"].push_back(Json::array({words, value}));
    const std::filesystem::path picture =
        page.settings.study / "points" / (points.text(row, "record") + ".png");
    if (std::filesystem::exists(picture)) point["image"] = data_uri(picture, "image/png");
    if (const auto reference = phong.find(picture_of(points, row)); reference != phong.end())
      point["reference"] = reference->second;
    ++page.report.points;
  }
  return all;
}

// The plot of these axes, and the points that are not on it.
struct StudyPlot {
  Plot plot;
  // Points without an x value per series; points that do not fit the device are counted separately.
  std::map<std::string, std::size_t> missing{}, too_large{};
};

StudyPlot plotted(const Table& points, const Measure& along, const Measure& error,
                  const std::vector<std::string>& series, const std::string& picture) {
  StudyPlot made{{.x_label = along.words, .y_label = error.words}};
  for (std::size_t row = 0; row < points.rows.size(); ++row) {
    const auto x = points.number(row, along.column), y = points.number(row, error.column);
    const std::string name = series_of(points, row);
    if (!y) continue;
    if (!is_hardware(points, row)) {
      if (picture_of(points, row) == picture) made.plot.levels.push_back({*y, name});
    } else if (!x) {
      const std::string& clock = points.text(row, "clock");
      const bool has_no_room =
          along.column == c_time.column && !clock.empty() && clock != synth::c_not_placed;
      ++(has_no_room ? made.too_large : made.missing)[name];
    } else {
      const auto s = static_cast<std::size_t>(std::ranges::find(series, name) - series.begin());
      made.plot.points.push_back({*x, *y, s, row,
                                  fmt::format("{}: {} {}, {} {}", points.text(row, "point"), along.words,
                                              shown(*x), error.words, shown(*y)),
                                  picture_of(points, row) != picture});
    }
  }
  made.plot.front = lower_left(made.plot.points);
  return made;
}

Json plots_of(Page& page, const Table& points, const std::vector<std::string>& series,
              const std::string& picture) {
  Json drawn = Json::array();
  const bool timed = has_any(points, c_time.column);
  for (const Axes& axes : c_axes) {
    if (!timed && axes.x.column == c_clocks.column) continue;  // already drawn
    const Measure& along = axes.x.column == c_time.column && !timed ? c_clocks : axes.x;
    const StudyPlot made = plotted(points, along, axes.y, series, picture);
    if (made.plot.points.empty()) continue;
    page.settings.on_progress(fmt::format("plot: {}", axes.id));
    const std::string title = fmt::format("{}, against {}", axes.y.words, along.words);
    Json& of = drawn.emplace_back(
        Json{{"id", axes.id},
             {"title", title},
             {"svg",
              inline_svg(draw_plot(made.plot, page.scratch), fmt::format("{}-", axes.id),
                         fmt::format("{}; {} points, each a link", title, made.plot.points.size()), "group")},
             {"missing", Json::array()}});
    add_missing(of, made.missing,
                along.column == c_time.column
                    ? "no clock of their hardware is known, which <code>make study PLACE=1</code> finds"
                    : "this was not measured of them");
    add_missing(of, made.too_large, "their hardware does not fit the device");
  }
  return drawn;
}

// The table of all points.
Json rows_of(const Table& points) {
  Json rows = Json::array();
  for (std::size_t row = 0; row < points.rows.size(); ++row) {
    Json cells = Json::array();
    for (const char* column : c_shown_columns) {
      const std::string text = text_of(points, row, column);
      cells.push_back(text.empty() ? "–" : text);
    }
    rows.push_back({{"number", row}, {"name", points.text(row, "point")}, {"cells", std::move(cells)}});
  }
  return rows;
}

// The picture in words, if some points have another one.
Json unless_common(const Table& points, const std::string& picture) {
  std::size_t last = 0, count = 0;
  for (std::size_t row = 0; row < points.rows.size(); ++row)
    if (picture_of(points, row) == picture) last = row, ++count;
  return count == points.rows.size() ? Json() : Json(told_picture(points, last));
}

}  // namespace

void add_study(Page& page) {
  const std::filesystem::path file = page.settings.study / "study.csv";
  page.data["points"] = Json::array();
  Json& view = page.view["study"] = {
      {"missing", Json::array()}, {"of", nullptr}, {"unusual", nullptr}, {"plots", nullptr}};
  if (!std::filesystem::exists(file)) {
    view["missing"].push_back(page.lacks("Accuracy against time", "make study"));
    return;
  }
  const Table points = must(read_csv(file));
  if (!points.rows.empty()) {
    view["of"] = study_of(page, points, file);
    view["unusual"] = unusual(page, points);
  }
  std::vector<std::string> series;
  std::set<std::string> hardware_series;
  for (std::size_t row = 0; row < points.rows.size(); ++row) {
    const std::string of = series_of(points, row);
    if (std::ranges::find(series, of) == series.end()) series.push_back(of);
    if (is_hardware(points, row)) hardware_series.insert(of);
  }
  Json legend = Json::array(), columns = Json::array();
  for (std::size_t s = 0; s < series.size(); ++s) {
    if (!hardware_series.contains(series[s])) continue;  // drawn as a line across
    const PointLook look = look_of(s);
    legend.push_back({{"shape", look.shape - 1}, {"colour", look.colour}, {"name", series[s]}});
  }
  for (const std::string_view column : c_shown_columns)
    columns.push_back(std::ranges::find(c_told, column, [](const auto& told) { return told.first; })->second);
  page.data["points"] = points_of(page, points);
  const std::string picture = commonest_picture(points);
  Json drawn = plots_of(page, points, series, picture);
  view["plots"] = {{"first", drawn.empty() ? Json() : drawn[0]["id"]},  // the legend uses this plot's marks
                   {"legend", std::move(legend)},
                   {"picture", unless_common(points, picture)},
                   {"drawn", std::move(drawn)},
                   {"columns", std::move(columns)},
                   {"rows", rows_of(points)}};
  write_front(points, page.settings.page.parent_path(), page.scratch);
}

}  // namespace halfway::report
