// SPDX-License-Identifier: Apache-2.0
// The papers' figures, as figures.json tells of them.
#include <fmt/format.h>

#include "common/file.hpp"
#include "report/html.hpp"
#include "report/section.hpp"

namespace halfway::report {
namespace {

std::string text_of(const Json& json, const char* key) {
  return escaped(json.at(key).get<std::string>());
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
                          text_of(figure, "caption"), text_of(figure, "shows"));
      for (const Json& picture : figure.at("pictures")) {
        const std::filesystem::path path = page.settings.figures / picture.at("file").get<std::string>();
        const auto uri = data_uri(path, path.extension() == ".svg" ? "image/svg+xml" : "image/png");
        if (!uri) return uri.error();
        html += fmt::format("<img class=\"figure\" loading=\"lazy\" src=\"{}\" alt=\"{}\">\n", *uri,
                            text_of(picture, "alt"));
      }
      html += "</details>\n";
      for (const Json& row : figure.at("rows")) {
        const bool agrees = row.at("verdict") == "agrees";
        rows.push_back({fmt::format("<a href=\"#figure/{}\">{}</a>", id, name), text_of(row, "what"),
                        text_of(row, "published"), text_of(row, "measured"), text_of(row, "criterion"),
                        fmt::format("<strong class=\"{0}\">{0}</strong>{1}{2}", agrees ? "agrees" : "differs",
                                    agrees ? "" : ": ", text_of(row, "reason"))});
      }
      ++page.report.figures;
    }
  } catch (const Json::exception& bad) {
    return bad_input(fmt::format("{}: {}; run make figures again", file.string(), bad.what()));
  }
  page.parts["figures"] = table("Published against measured",
                                {"figure", "what", "published", "measured", "agrees if", "verdict"}, rows) +
                          html;
  return Ok{};
}

}  // namespace halfway::report
