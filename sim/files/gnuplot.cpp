// SPDX-License-Identifier: Apache-2.0
#include "sim/files/gnuplot.hpp"

#include <fmt/format.h>

#include "sim/os/file.hpp"
#include "sim/os/must.hpp"
#include "sim/os/subprocess.hpp"

namespace halfway {

std::string plot_style(double width, double height) {
  std::string style = fmt::format(
      "set encoding utf8\n"
      "set terminal svg size {},{} dynamic noenhanced font 'sans-serif,13' background '#ffffff'\n"
      "set border 3\nset tics nomirror out scale 0.6\nset key noautotitle\n",
      width, height);
  // Blue, red, green, violet, ochre and grey.
  int linetype = 0;
  for (const std::size_t colour : {2, 9, 4, 7, 1, 0})
    style +=
        fmt::format("set linetype {} linecolor rgb '{}' linewidth 1.6\n", ++linetype, c_plot_colours[colour]);
  return style;
}

std::string gnuplot_text(std::string_view text) {
  std::string safe = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') safe += '\\';
    safe += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return safe + '"';
}

std::string run_gnuplot(std::string_view script, const std::filesystem::path& folder,
                        const std::string& name) {
  const std::filesystem::path file = folder / (name + ".gnuplot"), picture = folder / (name + ".raw.svg");
  must(write_file(file, fmt::format("set output '{}'\n{}", picture.filename().string(), script)));
  const auto end = must(run_process({.arguments = {"gnuplot", file.filename().string()},
                                     .working_folder = folder,
                                     .environment = {{"LC_ALL", "C.UTF-8"}}},
                                    "apt-get install gnuplot-nox"));
  if (!end.succeeded() || !end.output.empty())
    throw_tool_failed("{}: gnuplot: {}: {}", file.string(), end.how(), end.output);
  std::string svg = must(read_file(picture));
  std::error_code ignored;
  std::filesystem::remove(picture, ignored);
  return svg;
}

}  // namespace halfway
