// SPDX-License-Identifier: Apache-2.0
// Accuracy against time: the points of a study, as plots whose points open.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

#include "common/file.hpp"
#include "report/front.hpp"
#include "report/html.hpp"
#include "report/plot.hpp"
#include "report/section.hpp"
#include "report/table.hpp"

namespace halfway::report {
namespace {

struct Axes {
  const char* id;
  const char* x;  // columns
  const char* y;
  const char* x_label;
  const char* y_label;
};
constexpr std::array c_axes = {
    Axes{"rms-clocks", "cycles", "rms", "clocks of the frame, RTL", "rms error, steps of 1/255"},
    Axes{"largest-clocks", "cycles", "largest_error", "clocks of the frame, RTL",
         "largest error, steps of 1/255"},
    Axes{"highlight-clocks", "cycles", "highlight_rms", "clocks of the frame, RTL",
         "rms error in highlights, steps of 1/255"},
    Axes{"perceived-clocks", "cycles", "perceived_pixels", "clocks of the frame, RTL",
         "pixels seen to differ (Yee)"},
    Axes{"mach-clocks", "cycles", "mach_rms", "clocks of the frame, RTL",
         "rms of Mach bands, steps of 1/255 a pixel"},
    Axes{"rms-cells", "cells", "rms", "cells: LUTs (multipliers among them), flip-flops, memory",
         "rms error, steps of 1/255"},
    Axes{"rms-host", "host_evaluations", "rms", "evaluations on the host", "rms error, steps of 1/255"},
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
    std::pair{"frame_ns", "ns a frame"},
    std::pair{"fragment_ns", "ns a fragment"},
    std::pair{"rms", "rms error, /255"},
    std::pair{"largest_error", "largest error, /255"},
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
};

std::string told(const Table& table, std::size_t row, const char* column) {
  const auto value = table.number(row, column);
  return value ? fmt::format("{:.6g}", *value) : table.text(row, column);
}

// In words; of any of its rows.
std::string told_picture(const Table& table, std::size_t row) {
  const std::string& exponent = table.text(row, "exponent");
  return fmt::format("{}{}tessellation {}, {}×{}", exponent.empty() ? "" : "exponent " + exponent,
                     exponent.empty() ? "" : ", ", table.text(row, "tessellation"), table.text(row, "width"),
                     table.text(row, "height"));
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
  std::map<std::string, std::size_t> phong;  // the reference of each picture
  for (std::size_t row = 0; row < points->rows.size(); ++row) {
    page.settings.on_progress(fmt::format("points: {} of {}", row + 1, points->rows.size()));
    if (points->text(row, "method") == "phong") phong.emplace(picture_of(*points, row), row);
    const std::string of = series_of(*points, row);
    if (std::ranges::find(series, of) == series.end()) series.push_back(of);
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
  for (const Axes& axes : c_axes) {
    Plot plot{.x_label = axes.x_label, .y_label = axes.y_label};
    std::size_t at_zero = 0;
    for (std::size_t row = 0; row < points->rows.size(); ++row) {
      const auto x = points->number(row, axes.x), y = points->number(row, axes.y);
      if (!x || !y || *x <= 0) continue;
      if (*y <= 0) {
        ++at_zero;
        continue;
      }
      const auto s =
          static_cast<std::size_t>(std::ranges::find(series, series_of(*points, row)) - series.begin());
      plot.points.push_back({*x, *y, s, row,
                             fmt::format("{}: {} {:.4g}, {} {:.4g}", points->text(row, "point"), axes.x_label,
                                         *x, axes.y_label, *y),
                             picture_of(*points, row) != picture});
    }
    if (plot.points.empty()) continue;
    if (first.empty()) first = axes.id;
    page.settings.on_progress(fmt::format("plot: {}", axes.id));
    plot.front = lower_left(plot.points);
    const auto drawn = draw_plot(plot, page.scratch);
    if (!drawn) return drawn.error();
    const std::string title = fmt::format("{}, against {}", axes.y_label, axes.x_label);
    const auto svg =
        inline_svg(*drawn, fmt::format("{}-", axes.id),
                   fmt::format("{}; {} points, each a link", title, plot.points.size()), "group");
    if (!svg) return svg.error();
    html += fmt::format(
        "<figure class=\"plot\" id=\"plot/{}\"><figcaption>{}{}</figcaption><div class=\"scroll\">{}</div>"
        "</figure>\n",
        axes.id, title,
        at_zero == 0
            ? ""
            : fmt::format(" <small>({} points of error 0 have no place on a logarithmic axis)</small>",
                          at_zero),
        *svg);
  }
  std::string legend;
  for (std::size_t s = 0; s < series.size(); ++s) {
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
  html = fmt::format(
      "<ul class=\"legend\" aria-label=\"Legend\">\n{}</ul>\n<p>{}</p>\n<div class=\"plots\">\n{}", legend,
      pictures, html);
  html += "</div>\n<details><summary>All points as a table</summary>\n";
  std::vector<std::vector<std::string>> rows;
  for (std::size_t row = 0; row < points->rows.size(); ++row)
    rows.push_back({fmt::format("<a href=\"#point-{}\">{}</a>", row, escaped(points->text(row, "point"))),
                    told(*points, row, "cycles"), told(*points, row, "host_evaluations"),
                    told(*points, row, "rms"), told(*points, row, "largest_error"),
                    told(*points, row, "perceived_pixels"), told(*points, row, "mach_rms")});
  html += table("Points of the study",
                {"point", "clocks", "evaluations on the host", "rms error", "largest error",
                 "pixels seen to differ", "Mach bands, rms"},
                rows);
  page.parts["study"] = html + "</details>\n";
  const auto front = write_front(*points, page.settings.page.parent_path(), page.scratch);
  if (!front) return front.error();
  return Ok{};
}

}  // namespace halfway::report
