// SPDX-License-Identifier: Apache-2.0
#include "sim/report/front_plot.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "sim/os/file.hpp"
#include "sim/os/must.hpp"
#include "sim/study/front.hpp"

namespace halfway::report {
namespace {

constexpr const char* c_cells = "cells";
constexpr const char* c_cycles = "cycles";

// Columns of a study's table that the front contains.
constexpr std::array c_front_columns = {
    "scene",         "scene_hash",    "tools",     "point",          "method",   "preset", "address_bits",
    "data_bits",     "form",          "threshold", "exponent",       "width",    "height", "angle_bits",
    "fraction_bits", "seed_bits",     "newton",    "tessellation",   "hardware", c_cells,  c_cycles,
    "rms",           "largest_error", "psnr_db",   "highlight_test", "span_ends"};

// Error against cells; against clocks if cells were not counted.
Plot front_plot(const Table& front) {
  bool counted = true;
  for (std::size_t row = 0; row < front.rows.size(); ++row)
    counted = counted && (!is_hardware(front, row) || front.number(row, c_cells));
  Plot plot{
      .x_label = counted ? "cells: LUTs (multipliers among them), flip-flops, memory" : "clocks of the frame",
      .y_label = "rms error, steps of 1/255"};
  for (std::size_t row = 0; row < front.rows.size(); ++row) {
    const std::size_t series = series_number(plot, series_of(front, row));
    const auto x = front.number(row, counted ? c_cells : c_cycles), y = front.number(row, "rms");
    if (!is_hardware(front, row) || !x || !y || *x <= 0 || *y <= 0) continue;
    plot.points.push_back({*x, *y, series, row, front.text(row, "point")});
  }
  plot.front = lower_left(plot.points);
  return plot;
}

}  // namespace

bool is_hardware(const Table& table, std::size_t row) {
  return !table.text(row, "hardware").empty();
}

std::string series_of(const Table& table, std::size_t row) {
  const std::string& method = table.text(row, "method");
  const std::string& preset = table.text(row, "preset");
  if (preset.empty()) return method + " (software)";
  const std::string& form = table.text(row, "form");
  return method + (preset == "exact" ? "" : ", " + preset) + (form == "folded" ? ", folded" : "") +
         (table.text(row, "objects").empty() ? "" : ", object processors") +
         (table.text(row, "highlight_test") == "centroid" ? ", centroid" : "") +
         (table.text(row, "span_ends") == "slerp" ? ", slerp" : "");
}

bool is_filtered(const Table& table, std::size_t row) {
  return table.number(row, "subpixels").value_or(1) > 1;
}

std::string frame_of(const Table& table, std::size_t row) {
  std::string text;
  for (const char* column : {"scene_hash", "tessellation", "exponent", "width", "height"})
    text += table.text(row, column) + " ";
  return text;
}

std::string picture_of(const Table& table, std::size_t row) {
  return frame_of(table, row) + (is_filtered(table, row) ? "filtered" : "");
}

std::vector<std::pair<double, double>> lower_left(const std::vector<PlotPoint>& points) {
  std::vector<study::Costs> costs;
  for (const PlotPoint& point : points)
    if (!point.aside) costs.push_back({point.x, point.y});
  std::set<std::pair<double, double>> front;
  for (const std::size_t at : study::front_of(costs)) front.emplace(costs[at][0], costs[at][1]);
  return {front.begin(), front.end()};
}

std::string commonest_picture(const Table& study) {
  std::map<std::string, std::size_t> designs;
  for (std::size_t row = 0; row < study.rows.size(); ++row)
    if (is_hardware(study, row)) ++designs[picture_of(study, row)];
  const auto most = std::ranges::max_element(designs, {}, [](const auto& of) { return of.second; });
  return most == designs.end() ? std::string() : most->first;
}

Table front_of(const Table& study) {
  const std::string picture = commonest_picture(study);
  Table front{{c_front_columns.begin(), c_front_columns.end()}, {}};
  for (std::size_t row = 0; row < study.rows.size(); ++row) {
    if (picture_of(study, row) != picture) continue;
    std::vector<std::string>& values = front.rows.emplace_back();
    for (const char* column : c_front_columns) values.push_back(study.text(row, column));
  }
  return front;
}

std::string draw_front(const Table& front, const std::filesystem::path& scratch) {
  const Plot plot = front_plot(front);
  if (plot.points.empty()) throw_bad_input("front: no design has both a cost and an error to plot");
  return draw_plot(plot, scratch);
}

std::string page_front(const Table& front) {
  const Plot plot = front_plot(front);
  for (const PlotPoint& point : plot.points)
    if (!front.number(point.number, c_cells))
      throw_bad_input("front: not all cells are counted; install Yosys");
  if (plot.front.size() < 2) throw_bad_input("front: no two designs to join");
  // The designs at each place of the plot.
  std::map<std::pair<double, double>, std::vector<std::string>> places;
  for (const PlotPoint& point : plot.points) {
    const std::string& name = front.text(point.number, "point");
    const std::string size =
        fmt::format(", {}x{}", front.text(point.number, "width"), front.text(point.number, "height"));
    places[{point.x, point.y}].push_back(name.substr(0, name.find(size)));
  }
  std::vector<std::string> joined, hidden;
  for (const std::pair<double, double>& corner : plot.front)
    joined.push_back(fmt::format("{} ({} cells, {:.3g})", fmt::join(places.at(corner), " and "), corner.first,
                                 corner.second));
  for (const auto& [place, designs] : places)
    if (designs.size() > 1) hidden.push_back(fmt::format("{}", fmt::join(designs, " and ")));
  const std::size_t any = plot.points.front().number;
  return fmt::format(
      "![Rms error against cells, one point for each of {0} designs](results/gallery/front.svg)\n\n"
      "*{0} designs draw one sphere at {1}x{2}, exponent {3}. A design is on the dashed line if no other\n"
      "design has both fewer cells and a smaller rms error (in colour steps, 1/255 of white):\n{4}.{5}\n"
      "4x4: address bits × data bits of the cosine tables. adaptive: quadratic, triangles split until the "
      "estimated error\nis below the threshold; quadratic: never split. processors-2: with normalization of "
      "N.\n"
      "`make gallery` measures [the table](results/gallery/front.csv) and draws the plot.*\n",
      plot.points.size(), front.text(any, "width"), front.text(any, "height"), front.text(any, "exponent"),
      fmt::join(joined, ";\n"),
      hidden.empty() ? "" : fmt::format("\nEqual in cells and in rms error: {}.", fmt::join(hidden, "; ")));
}

std::size_t write_front(const Table& study, const std::filesystem::path& folder,
                        const std::filesystem::path& scratch) {
  const Table front = front_of(study);
  const std::size_t designs = front_plot(front).points.size();
  if (designs == 0) return designs;
  const auto svg = draw_front(front, scratch);
  if (!folder.empty()) must(make_folders(folder));
  must(write_file(folder / "front.csv", to_csv(front)));
  must(write_file(folder / "front.svg", svg));
  return designs;
}

}  // namespace halfway::report
