// SPDX-License-Identifier: Apache-2.0
#include "sim/report/linked_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <pugixml.hpp>
#include <sstream>

#include "sim/files/gnuplot.hpp"
#include "sim/os/must.hpp"

namespace halfway::report {
namespace {

// Shapes distinguish the series without colours.
constexpr std::array c_shapes = {2, 1, 6, 7, 5, 9, 13, 11, 4, 8, 12, 10, 3, 14, 15};

// A long legend takes more room.
std::string style_of(const Plot& plot) {
  constexpr std::size_t c_lines = 12, c_line = 35;
  if (plot.narrow)
    return plot_style(440, 420) + "set key below center vertical maxrows 4 width -3 samplen 1 Left reverse\n";
  if (plot.legend.empty()) return plot_style(520, 390) + "unset key\n";
  const bool is_long = plot.legend.size() > c_lines;
  return plot_style(is_long ? 920 : 800, is_long ? static_cast<double>(c_line * plot.legend.size()) : 420) +
         "set key outside right center Left reverse spacing 1.4\n";
}

std::string tick_label(double tick) {
  return tick < 1e6 ? fmt::format("{:g}", tick) : fmt::format("{:g} M", tick / 1e6);
}

// Ticks at round numbers on an axis of less than two decades, as gnuplot selects them: fewer for a wider
// range.
std::string ticks_within(double least, double most) {
  std::vector<double> digits = {1.0, 2.0, 5.0};
  if (most / least < 20) digits = {1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0};
  std::string ticks;
  for (double decade = std::pow(10.0, std::floor(std::log10(least))); decade <= most; decade *= 10.0)
    for (const double digit : digits)
      if (const double tick = digit * decade; tick > least / 1.1 && tick < most * 1.1)
        ticks += fmt::format("{}\"{}\" {}", ticks.empty() ? "" : ", ", tick_label(tick), tick);
  return ticks;
}

// A logarithmic axis with a separate position for 0.
struct Axis {
  double least = std::numeric_limits<double>::infinity(), most = 0.0;  // of the values above 0
  bool has_zero = false;

  void add(double value) {
    if (value <= 0) {
      has_zero = true;
      return;
    }
    least = std::min(least, value);
    most = std::max(most, value);
  }
  // If all values are 0, use any range.
  void close() {
    if (most == 0.0) least = most = 1.0;
  }
  // Position of 0: an eighth of the axis's length below the smallest value.
  double zero() const { return least * std::pow(std::max(10.0, most / least), -0.125); }
  double place(double value) const { return value > 0 ? value : zero(); }
  double begin() const { return has_zero ? zero() : least; }
  // Position of the gap between 0 and the other values.
  double gap() const { return std::pow(zero(), 0.3) * std::pow(least, 0.7); }
  std::string ticks(const char* name) const {
    // Number format of gnuplot's own ticks, consistent with ours: millions with a suffix.
    const std::string own = most < 1e6 ? "" : fmt::format("set format {} \"%.0s %c\"\n", name);
    if (!has_zero && most / least >= 100) return own;
    std::string text = most / least < 100 ? ticks_within(least, most) : std::string();
    if (text.empty())
      for (double tick = std::pow(10.0, std::ceil(std::log10(least))); tick <= most * 1.1; tick *= 10.0)
        text += fmt::format("{}\"{}\" {}", text.empty() ? "" : ", ", tick_label(tick), tick);
    // Without 0, add ticks to gnuplot's, which are too few on a short axis. With 0, replace gnuplot's ticks,
    // because ticks between 0 and the smallest value have no meaning.
    if (!has_zero) return own + fmt::format("set {}tics add ({})\n", name, text);
    return fmt::format("set {}tics (\"0\" {}{}{})\n", name, zero(), text.empty() ? "" : ", ", text);
  }
};

}  // namespace

std::size_t series_number(Plot& plot, const std::string& name) {
  const auto found = std::ranges::find(plot.legend, name);
  const auto number = static_cast<std::size_t>(found - plot.legend.begin());
  if (found == plot.legend.end()) plot.legend.push_back(name);
  return number;
}

PointLook look_of(std::size_t series) {
  return {c_plot_colours[series % c_plot_colours.size()], c_shapes[series % c_shapes.size()]};
}

std::string draw_plot(const Plot& plot, const std::filesystem::path& scratch) {
  Axis x, y;
  for (const PlotPoint& point : plot.points) {
    x.add(point.x);
    y.add(point.y);
  }
  for (const PlotLevel& level : plot.levels) y.add(level.y);
  x.close();
  y.close();
  std::string script = style_of(plot);
  script += fmt::format(
      "set xlabel {}\nset ylabel {}\nset logscale xy\nset xrange [{}:{}]\nset yrange [{}:{}]\n"
      "set grid linecolor rgb \"#8a8a8a\" linewidth 0.3\n",
      gnuplot_text(plot.x_label), gnuplot_text(plot.y_label), x.begin() / 1.15, x.most * 1.15,
      y.begin() / 1.5, y.most * 1.5);
  script += x.ticks("x") + y.ticks("y");
  constexpr const char* c_gap = "nohead linecolor rgb \"#8a8a8a\" linewidth 1";
  if (x.has_zero) script += fmt::format("set arrow from {0}, graph 0 to {0}, graph 1 {1}\n", x.gap(), c_gap);
  if (y.has_zero)
    script += fmt::format("set arrow from graph 0, first {0} to graph 1, first {0} {1}\n", y.gap(), c_gap);
  for (const PlotLevel& level : plot.levels)
    script += fmt::format(
        "set arrow from graph 0, first {0} to graph 1, first {0} nohead dashtype 3 linecolor rgb \"{1}\"\n"
        "set label {2} at graph 1, first {0} right offset 0, 0.5 textcolor rgb \"{1}\"\n",
        y.place(level.y), "#767676", gnuplot_text(level.name));
  // Draw the front's line before the marks: the element drawn last receives the pointer. Sort the marks by
  // series.
  std::vector<PlotPoint> points = plot.points;
  std::ranges::stable_sort(points, {}, &PlotPoint::series);
  std::string blocks = "$front << END\n";
  for (const auto& [at_x, at_y] : plot.front) blocks += fmt::format("{} {}\n", x.place(at_x), y.place(at_y));
  blocks += plot.front.empty() ? "NaN NaN\nEND\n$points << END\n" : "END\n$points << END\n";
  std::string legend, rings;
  for (std::size_t at = 0; at < points.size(); ++at) {
    const PlotPoint& point = points[at];
    const std::size_t series = point.series;
    const double at_x = x.place(point.x), at_y = y.place(point.y);
    const PointLook look = plot.looks.empty() ? look_of(series) : plot.looks.at(series);
    if (point.ring) rings += fmt::format("{} {}\n", at_x, at_y);
    if (!point.label.empty())
      script += fmt::format("set label {} at {},{} left offset 0.7,0.4 font ',11'\n",
                            gnuplot_text(point.label), at_x, at_y);
    blocks += fmt::format("{} {} {} 0x{}\n", at_x, at_y, look.shape, look.colour + 1);
    if (series < plot.legend.size() && (at == 0 || points[at - 1].series != series))
      legend += fmt::format(", NaN with points pointtype {} pointsize 0.8 linecolor rgb \"{}\" title {}",
                            look.shape, look.colour, gnuplot_text(plot.legend[series]));
  }
  if (!plot.ring_legend.empty())
    legend += ", $rings using 1:2 with points pointtype 6 pointsize 1.5 linecolor rgb \"#8a8a8a\" title " +
              gnuplot_text(plot.ring_legend);
  const auto svg = run_gnuplot(
      script + blocks + "END\n$rings << END\n" + (rings.empty() ? "NaN NaN\n" : rings) +
          "END\nplot $front using 1:2 with steps linecolor rgb \"black\" dashtype 2, $points using "
          "1:2:3:4 with points pointtype variable pointsize 0.8 linecolor rgb variable" +
          legend + "\n",
      scratch, "plot");

  pugi::xml_document document;
  if (const auto parsed = document.load_string(svg.c_str(), pugi::parse_default | pugi::parse_ws_pcdata);
      !parsed)
    throw_tool_failed("gnuplot: wrote SVG that cannot be read: {}", parsed.description());
  // Titles of curves would appear as tooltips.
  for (const pugi::xpath_node& title : document.select_nodes("//g/title"))
    title.parent().remove_child(title.node());
  const pugi::xpath_node_set marks = document.select_nodes("//g[@id='gnuplot_plot_2']//use");
  if (marks.size() != points.size())
    throw_tool_failed("gnuplot: drew {} marks for {} points", marks.size(), points.size());
  for (std::size_t at = 0; at < points.size(); ++at) {
    const pugi::xml_node mark = marks[at].node();
    pugi::xml_node link = mark.parent().insert_child_before("a", mark);
    link.append_attribute("href") = fmt::format("#point-{}", points[at].number).c_str();
    link.append_attribute("aria-label") = points[at].name.c_str();
    if (points[at].aside) link.append_attribute("class") = "aside";
    link.append_child("title").text() = points[at].name.c_str();
    // An invisible circle around the mark makes it large enough for a finger. gnuplot's transform is a
    // translation and the mark's scale.
    const std::string transform = mark.attribute("transform").value();
    pugi::xml_node around = link.append_child("circle");
    around.append_attribute("r") = "8";
    around.append_attribute("fill") = "none";
    around.append_attribute("stroke") = "none";
    around.append_attribute("transform") = transform.substr(0, transform.find(')') + 1).c_str();
    link.append_move(mark);
  }
  std::ostringstream out;
  document.print(out, "", pugi::format_raw);
  return out.str();
}

}  // namespace halfway::report
