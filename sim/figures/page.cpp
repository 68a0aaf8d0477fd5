// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "sim/figures/figure.hpp"

namespace halfway::figures {
namespace {

constexpr std::string_view c_head = R"(# The papers' figures, drawn anew

What the three papers print, beside what this project's own hardware, golden model and tables give. `make figures` draws and
measures all of it, and writes this page, its pictures and `figures.json`; `make test` draws again what the golden model can
draw, and fails where a row, a verdict or a picture here is not what comes out. Processor times are another in each run: here they stay
until a verdict changes; what was measured last is in `build/figures`.

A verdict follows from the two numbers and the criterion beside it, in brackets. Where they differ, the reason is given: the
papers' own errors are among them. A step of an 8-bit channel is 1/255; how far pictures are apart is said as the largest
difference of a pixel and as PSNR. Two pictures look alike where at most one in a thousand of their pixels is seen to differ, by
Yee's perceptual metric (`sim/pictures/perception.hpp`), at 640×480; the pictures below are smaller ones of the same. The papers'
mesh, a chicken, was not published: a hen of our own making stands in for it, and the teapot.

)";

struct Paper {
  std::string_view name, title;
};
constexpr std::array<Paper, 3> c_papers = {
    {{"spherical", "Hardware Implementation of Phong Shading using Spherical Interpolation"},
     {"quadratic", "Quadratic Shading and its Hardware Implementation"},
     {"processors", "Real Time Phong Shading (Claussen's shading processors)"}}};

std::string heading(const Entry& e) {
  return fmt::format("{}, {}", e.paper, e.number);
}

std::string anchor(const Entry& e) {
  std::string text;
  for (const char c : heading(e))
    if (c == ' ')
      text += '-';
    else if (c != ',')
      text += c;
  return text;
}

// A bar would end the cell.
std::string cell(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2)
    text.replace(at, 1, "\\|");
  return text;
}

}  // namespace

std::string to_page(std::span<const Entry> entries) {
  std::size_t rows = 0, agreeing = 0;
  for (const Entry& e : entries) {
    rows += e.rows.size();
    agreeing += static_cast<std::size_t>(std::ranges::count_if(e.rows, &Row::agrees));
  }
  std::string page(c_head);
  page += fmt::format("{} numbers and statements: {} agree, {} differ.\n\n## Published against measured\n",
                      rows, agreeing, rows - agreeing);
  for (const auto& [name, title] : c_papers) {
    page += fmt::format(
        "\n### {}: *{}*\n\n| figure | what | published | measured | verdict |\n| --- | --- | --- | --- "
        "| --- |\n",
        name, title);
    for (const Entry& e : entries) {
      if (e.paper != name) continue;
      for (const Row& r : e.rows)
        page += fmt::format("| [{}](#{}) | {} | {} | {} | {} |\n", e.number, anchor(e), cell(r.what),
                            cell(r.published), cell(r.measured),
                            r.agrees ? fmt::format("agrees ({})", r.criterion)
                                     : fmt::format("**differs** ({}): {}", r.criterion, cell(r.reason)));
    }
  }
  page += "\n## The figures\n";
  for (const Entry& e : entries) {
    page += fmt::format("\n### {}\n\nPublished: {}\n\nHere: {}\n", heading(e), e.caption, e.shows);
    for (const Picture& p : e.pictures) page += fmt::format("\n![{}]({})\n", p.alt, p.file);
  }
  return page;
}

}  // namespace halfway::figures
