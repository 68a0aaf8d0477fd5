// SPDX-License-Identifier: Apache-2.0
#include "sim/report/times.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "sim/files/gnuplot.hpp"
#include "sim/os/file.hpp"
#include "sim/os/must.hpp"
#include "sim/report/front_plot.hpp"
#include "sim/report/linked_plot.hpp"
#include "sim/study/front.hpp"

namespace halfway::report {
namespace {

constexpr double c_ms = 1e-6;  // ns to ms
double ms(const Table& table, std::size_t row, const char* column) {
  return c_ms * table.number(row, column).value_or(0.0);
}
std::string ms_text(const Table& table, std::size_t row, const char* column) {
  return table.text(row, column).empty() ? "–" : fmt::format("{:.3g}", ms(table, row, column));
}
std::string text_or_dash(const std::string& text) {
  return text.empty() ? "–" : text;
}
std::string millions(const Table& table, std::size_t row, const char* column) {
  const auto value = table.number(row, column);
  return value ? fmt::format("{:.3g}", 1e-6 * *value) : "–";
}
double rms(const Table& table, std::size_t row) {
  return table.number(row, "rms").value_or(0.0);
}

bool is_phong(const Table& table, std::size_t row) {
  return table.text(row, "method").starts_with("phong");
}

// The marks of the plot: a colour and a shape for each shader, filled for preset exact and hollow for
// published.
struct Mark {
  const char* name;
  PointLook look;
};
constexpr Mark c_marks[] = {
    {"quadratic exact", {c_plot_colours[2], 7}},  {"quadratic published", {c_plot_colours[2], 6}},
    {"spherical exact", {c_plot_colours[9], 5}},  {"spherical published", {c_plot_colours[9], 4}},
    {"processors exact", {c_plot_colours[4], 9}}, {"processors published", {c_plot_colours[4], 8}},
    {"filtered exact", {c_plot_colours[4], 11}},  {"filtered published", {c_plot_colours[4], 10}},
    {"software", {c_plot_colours[0], 2}}};

std::size_t mark_of(const Table& table, std::size_t row) {
  if (!is_hardware(table, row)) return std::size(c_marks) - 1;
  const std::string& method = table.text(row, "method");
  const bool processors = method.starts_with("processors"), filtered = is_filtered(table, row);
  const std::size_t shader = method == "spherical" ? 1 : filtered ? 3 : processors ? 2 : 0;
  return 2 * shader + (table.text(row, "preset") == "exact" ? 0 : 1);
}

bool has_filtered(const Table& picture) {
  for (std::size_t row = 0; row < picture.rows.size(); ++row)
    if (is_filtered(picture, row)) return true;
  return false;
}

// The rows that no other row beats in time and error, from the quickest. Filtered pictures are not compared.
std::vector<std::size_t> front_rows(const Table& picture) {
  std::vector<study::Costs> costs;
  std::vector<std::size_t> rows, front;
  for (std::size_t row = 0; row < picture.rows.size(); ++row) {
    if (is_filtered(picture, row)) continue;
    costs.push_back({ms(picture, row, "overlapped_ns"), rms(picture, row)});
    rows.push_back(row);
  }
  for (const std::size_t at : study::ordered_front_of(costs)) front.push_back(rows[at]);
  return front;
}

Plot times_plot(const Table& picture) {
  Plot plot{.x_label = "ms per frame, host and hardware overlapped",
            .y_label = "rms error, steps of 1/255",
            .ring_legend = "the host takes longer",
            .narrow = true};
  for (const Mark& mark : c_marks) {
    plot.legend.emplace_back(mark.name);
    plot.looks.push_back(mark.look);
  }
  for (std::size_t row = 0; row < picture.rows.size(); ++row) {
    plot.points.push_back({.x = ms(picture, row, "overlapped_ns"),
                           .y = rms(picture, row),
                           .series = mark_of(picture, row),
                           .number = row,
                           .name = picture.text(row, "point"),
                           .aside = is_filtered(picture, row),
                           .ring = is_hardware(picture, row) && picture.text(row, "bound") == "host"});
  }
  // Name the points of the front; of equal ones the first.
  for (const std::size_t row : front_rows(picture))
    if (const std::pair corner(plot.points[row].x, plot.points[row].y);
        plot.front.empty() || plot.front.back() != corner) {
      plot.front.push_back(corner);
      plot.points[row].label = picture.text(row, "design");
    }
  return plot;
}

// The rows from the quickest; of equally quick ones, the most accurate first.
std::vector<std::size_t> by_time(const Table& picture) {
  std::vector<std::size_t> rows(picture.rows.size());
  std::iota(rows.begin(), rows.end(), 0U);
  std::ranges::stable_sort(rows, {}, [&](std::size_t row) {
    return std::pair(ms(picture, row, "overlapped_ns"), rms(picture, row));
  });
  return rows;
}

std::string table_of(const Table& picture, const std::vector<std::size_t>& rows) {
  std::string text =
      "| design | ms per frame, overlapped | bound by | in sequence | host | hardware | clock, MHz | host, "
      "million instructions | words sent | rms error | largest | pixels seen to differ |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n";
  for (const std::size_t row : rows)
    text += fmt::format(
        "| {} | {} | {} | {} | {} | {} | {} | {} | {} | {:.3g} | {} | {} |\n", picture.text(row, "design"),
        ms_text(picture, row, "overlapped_ns"), picture.text(row, "bound"),
        ms_text(picture, row, "sequential_ns"), ms_text(picture, row, "host_ns"),
        ms_text(picture, row, "hardware_ns"), text_or_dash(picture.text(row, "clock_mhz")),
        millions(picture, row, "host_instructions"), text_or_dash(picture.text(row, "words")),
        rms(picture, row), picture.text(row, "largest_error"), picture.text(row, "perceived_pixels"));
  return text;
}

std::string size_of(const Table& picture) {
  return fmt::format("{}×{}", picture.text(0, "width"), picture.text(0, "height"));
}

// The device that the hardware's clocks are of.
std::string device_of(const Table& picture) {
  for (std::size_t row = 0; row < picture.rows.size(); ++row)
    if (!picture.text(row, "device").empty()) return picture.text(row, "device");
  return "FPGA";
}

// The rows of the README: those of the front; Phong shading in software, and the most accurate planes,
// spherical shader and processors of preset exact, whether a design beats them or not.
std::vector<std::size_t> short_rows(const Table& picture, const std::vector<std::size_t>& front) {
  const std::vector<std::size_t> all = by_time(picture);
  std::set<std::size_t> chosen(front.begin(), front.end());
  for (const std::size_t row : all)
    if (is_phong(picture, row)) chosen.insert(row);
  for (const char* method : {"planes", "spherical", "processors-2"}) {
    std::optional<std::size_t> best;
    for (const std::size_t row : all)
      if (picture.text(row, "method") == method && picture.text(row, "preset") == "exact" &&
          !is_filtered(picture, row) && (!best || rms(picture, row) < rms(picture, *best)))
        best = row;
    if (best) chosen.insert(*best);
  }
  std::vector<std::size_t> rows;
  std::ranges::copy_if(all, std::back_inserter(rows), [&](std::size_t row) { return chosen.contains(row); });
  return rows;
}

// The quickest hardware of the front against the most accurate one, and that one against shading in software.
std::string sentences(const Table& picture, const std::vector<std::size_t>& rows,
                      const std::vector<std::size_t>& hardware) {
  const std::size_t quick = hardware.front(), best = hardware.back();
  const auto times_as_long = [&](std::size_t slow, std::size_t fast, const char* column) {
    return ms(picture, slow, column) / ms(picture, fast, column);
  };
  std::string text = fmt::format(
      "- The rms error of {0} is {2:.3g} times smaller than that of {1}. Its frame takes {3:.3g} times as "
      "long.\n",
      picture.text(best, "design"), picture.text(quick, "design"), rms(picture, quick) / rms(picture, best),
      times_as_long(best, quick, "overlapped_ns"));
  for (const std::size_t row : rows)
    if (is_phong(picture, row))
      text += fmt::format("- {} takes {:.2g} times as long as {} overlapped, and {:.2g} times in sequence.\n",
                          picture.text(row, "design"), times_as_long(row, best, "overlapped_ns"),
                          picture.text(best, "design"), times_as_long(row, best, "sequential_ns"));
  return text;
}

}  // namespace

std::vector<Table> pictures_of(const Table& times) {
  std::vector<Table> pictures;
  std::vector<std::string> names;
  for (std::size_t row = 0; row < times.rows.size(); ++row) {
    const std::string name = frame_of(times, row);
    const auto at = static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
    if (at == names.size()) {
      names.push_back(name);
      pictures.push_back({times.columns, {}});
    }
    pictures[at].rows.push_back(times.rows[row]);
  }
  std::ranges::stable_sort(pictures, {}, [](const Table& picture) {
    return picture.number(0, "width").value_or(0) * picture.number(0, "height").value_or(0);
  });
  return pictures;
}

std::string plot_name(const Table& picture) {
  return fmt::format("times-{}-{}x{}.svg", picture.text(0, "scene"), picture.text(0, "width"),
                     picture.text(0, "height"));
}

std::string readme_times(const Table& times) {
  const std::vector<Table> pictures = pictures_of(times);
  if (pictures.empty()) throw_bad_input("times: no design has a known time");
  const Table& picture = pictures.front();
  const std::vector<std::size_t> front = front_rows(picture);
  std::vector<std::size_t> hardware;
  std::ranges::copy_if(front, std::back_inserter(hardware),
                       [&](std::size_t row) { return is_hardware(picture, row); });
  if (hardware.size() < 2) throw_bad_input("times: fewer than two designs of hardware to compare");
  std::string text = fmt::format(
      "![Rms error against milliseconds per frame, {0} designs](docs/results/gallery/{1})\n\n"
      "*{0} designs draw one grey sphere of {2} triangles at {3}. A frame takes the longer of two times: the "
      "host's set-up on one core, and the hardware at its clock on an {4}. The transfer between them and "
      "the depth test after the hardware are not counted. On the dashed line, no other design is both "
      "quicker and more accurate. phong, phong-mesa: Phong shading per pixel in software on one core: "
      "the reference, and OpenGL on Mesa's llvmpipe. planes: Gouraud's shading in hardware. adaptive: "
      "quadratic, triangles split until the estimated error is below the threshold, in colour steps; "
      "quadratic: never split.{5}*\n\n"
      "| design | ms per frame, overlapped | bound by | in sequence | rms error, 1/255 | largest |\n"
      "| --- | --- | --- | --- | --- | --- |\n",
      picture.rows.size(), plot_name(picture), picture.text(0, "triangles"), size_of(picture),
      device_of(picture),
      has_filtered(picture)
          ? " The errors of filtered pictures are against a filtered reference; the line leaves them out."
          : "");
  const std::vector<std::size_t> rows = short_rows(picture, front);
  for (const std::size_t row : rows)
    text += fmt::format("| {} | {} | {} | {} | {:.3g} | {} |\n", picture.text(row, "design"),
                        ms_text(picture, row, "overlapped_ns"), picture.text(row, "bound"),
                        ms_text(picture, row, "sequential_ns"), rms(picture, row),
                        picture.text(row, "largest_error"));
  return text + "\n" + sentences(picture, rows, hardware);
}

std::string page_times(const Table& times) {
  std::string text;
  for (const Table& picture : pictures_of(times))
    text +=
        fmt::format("{0}![Rms error against milliseconds per frame: {4} at {1}](results/gallery/{2})\n\n{3}",
                    text.empty() ? "" : "\n", size_of(picture), plot_name(picture),
                    table_of(picture, by_time(picture)), picture.text(0, "scene"));
  if (text.empty()) throw_bad_input("times: no design has a known time");
  return text;
}

std::size_t write_times(const Table& times, const std::filesystem::path& folder,
                        const std::filesystem::path& scratch) {
  must(make_folders(folder));
  for (const Table& picture : pictures_of(times))
    must(write_file(folder / plot_name(picture), draw_plot(times_plot(picture), scratch)));
  must(write_file(folder / "times.csv", to_csv(times)));
  return times.rows.size();
}

}  // namespace halfway::report
