// SPDX-License-Identifier: Apache-2.0
// The papers' figures, as figures.json tells of them.
#include <fmt/format.h>

#include <cstdio>
#include <pugixml.hpp>

#include "sim/pictures/image.hpp"
#include "sim/report/html.hpp"
#include "sim/report/section.hpp"
#include "sim/system/file.hpp"

namespace halfway::report {
namespace {

std::string text_of(const Json& json, const char* key) {
  return escaped(json.at(key).get<std::string>());
}

// The same with what stands between backticks as code.
std::string words_of(const Json& json, const char* key) {
  std::string words = text_of(json, key), html;
  for (std::size_t at = 0;;) {
    const std::size_t begin = words.find('`', at), end = words.find('`', begin + 1);
    if (begin == std::string::npos || end == std::string::npos) return html + words.substr(at);
    html += fmt::format("{}<code>{}</code>", words.substr(at, begin - at),
                        words.substr(begin + 1, end - begin - 1));
    at = end + 1;
  }
}

// Width and height as attributes: the page keeps the room while a picture is not there yet.
Result<std::string> room_of(const std::filesystem::path& picture) {
  if (picture.extension() != ".svg") {
    const auto frame = read_png(picture);
    if (!frame) return frame.error();
    return fmt::format("width=\"{}\" height=\"{}\"", frame->size.width, frame->size.height);
  }
  pugi::xml_document document;
  const auto parsed = document.load_file(picture.c_str());
  const char* const box = document.child("svg").attribute("viewBox").value();
  double width = 0.0, height = 0.0;
  if (!parsed || std::sscanf(box, "%*f %*f %lf %lf", &width, &height) != 2)
    return bad_input(picture.string() + ": is no SVG with a viewBox; run make figures again");
  return fmt::format("width=\"{:.0f}\" height=\"{:.0f}\"", width, height);
}

}  // namespace

Status add_figures(Page& page) {
  const std::filesystem::path file = page.settings.figures / "figures.json";
  if (!std::filesystem::exists(file)) {
    page.parts["figures"] = page.lacks("The papers' figures", "make figures");
    return Ok{};
  }
  page.settings.on_progress("figures");
  const auto text = read_file(file);
  if (!text) return text.error();
  std::string html;
  std::vector<std::vector<std::string>> rows;
  try {
    const Json figures = Json::parse(*text);
    for (const Json& figure : figures) {
      const std::string id = text_of(figure, "id");
      const std::string name = text_of(figure, "paper") + ", " + text_of(figure, "number");
      html += fmt::format("<details id=\"figure/{}\"><summary>{}: {}</summary>\n<p>Here: {}</p>\n", id, name,
                          words_of(figure, "caption"), words_of(figure, "shows"));
      for (const Json& picture : figure.at("pictures")) {
        const std::filesystem::path path = page.settings.figures / picture.at("file").get<std::string>();
        const auto uri = data_uri(path, path.extension() == ".svg" ? "image/svg+xml" : "image/png");
        if (!uri) return uri.error();
        const auto room = room_of(path);
        if (!room) return room.error();
        html += fmt::format("<img class=\"figure\" loading=\"lazy\" {} src=\"{}\" alt=\"{}\">\n", *room, *uri,
                            text_of(picture, "alt"));
      }
      html += "</details>\n";
      for (const Json& row : figure.at("rows")) {
        const bool agrees = row.at("verdict") == "agrees";
        rows.push_back({fmt::format("<a href=\"#figure/{}\">{}</a>", id, name),
                        fmt::format("<strong class=\"{0}\">{0}</strong>", agrees ? "agrees" : "differs"),
                        words_of(row, "what"), words_of(row, "published"), words_of(row, "measured"),
                        words_of(row, "criterion"), words_of(row, "reason")});
      }
      ++page.report.figures;
    }
  } catch (const Json::exception& bad) {
    return bad_input(fmt::format("{}: {}; run make figures again", file.string(), bad.what()));
  }
  page.parts["figures"] =
      table("Published against measured",
            {"figure", "verdict", "what", "published", "measured", "agrees if", "why not"}, rows) +
      html;
  return Ok{};
}

}  // namespace halfway::report
