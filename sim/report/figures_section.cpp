// SPDX-License-Identifier: Apache-2.0
// Section with the papers' figures, from figures.json.

#include <cmath>
#include <cstdio>
#include <kainjow/mustache.hpp>
#include <pugixml.hpp>
#include <regex>
#include <utility>

#include "common/to_integer.hpp"
#include "sim/files/image.hpp"
#include "sim/os/file.hpp"
#include "sim/report/html.hpp"
#include "sim/report/section.hpp"

namespace halfway::report {
namespace {

// A text as HTML; text between backticks becomes code.
std::string words_of(const Json& json, const char* key) {
  return std::regex_replace(kainjow::mustache::html_escape(json.at(key).get<std::string>()),
                            std::regex("`([^`]*)`"), "<code>$1</code>");
}

// Width and height, so that the page reserves the space while a picture loads.
std::pair<int, int> size_of(const std::filesystem::path& picture) {
  if (picture.extension() != ".svg") {
    const auto frame = must(read_png(picture));
    return std::pair(static_cast<int>(frame.size.width), static_cast<int>(frame.size.height));
  }
  pugi::xml_document document;
  document.load_file(picture.c_str());
  double width = 0.0, height = 0.0;
  if (std::sscanf(document.child("svg").attribute("viewBox").value(), "%*f %*f %lf %lf", &width, &height) !=
      2)
    throw_bad_input("{}: not an SVG with a viewBox; run make figures again", picture.string());
  return std::pair(to_integer<int>(std::round(width)), to_integer<int>(std::round(height)));
}

}  // namespace

void add_figures(Page& page) {
  const std::filesystem::path file = page.settings.figures / "figures.json";
  Json& view = page.view["figures"] = {{"missing", Json::array()}, {"table", nullptr}};
  if (!std::filesystem::exists(file)) {
    view["missing"].push_back(page.lacks("The papers' figures", "make figures"));
    return;
  }
  page.settings.on_progress("figures");
  const auto text = must(read_file(file));
  Json& shown = view["table"]["figures"] = Json::array();
  try {
    for (const Json& figure : Json::parse(text)) {
      Json& of = shown.emplace_back(Json{
          {"id", figure.at("id").get<std::string>()},
          {"name", figure.at("paper").get<std::string>() + ", " + figure.at("number").get<std::string>()},
          {"caption", words_of(figure, "caption")},
          {"shows", words_of(figure, "shows")},
          {"pictures", Json::array()},
          {"rows", Json::array()}});
      for (const Json& picture : figure.at("pictures")) {
        const std::filesystem::path path = page.settings.figures / picture.at("file").get<std::string>();
        const auto uri = data_uri(path, path.extension() == ".svg" ? "image/svg+xml" : "image/png");
        const auto size = size_of(path);
        of["pictures"].push_back({{"uri", uri},
                                  {"width", size.first},
                                  {"height", size.second},
                                  {"alt", picture.at("alt").get<std::string>()}});
      }
      for (const Json& row : figure.at("rows")) {
        Json& line = of["rows"].emplace_back(Json::object());
        for (const char* key : {"verdict", "what", "published", "measured", "criterion", "reason"})
          line[key] = words_of(row, key);
      }
      ++page.report.figures;
    }
  } catch (const Json::exception& bad) {
    throw_bad_input("{}: {}; run make figures again", file.string(), bad.what());
  }
}

}  // namespace halfway::report
