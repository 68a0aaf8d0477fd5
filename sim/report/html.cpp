// SPDX-License-Identifier: Apache-2.0
#include "sim/report/html.hpp"

#include <OpenImageIO/strutil.h>
#include <cmark-gfm-core-extensions.h>
#include <cmark-gfm.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <kainjow/mustache.hpp>
#include <memory>
#include <pugixml.hpp>
#include <sstream>
#include <vector>

#include "sim/os/file.hpp"
#include "sim/os/must.hpp"
#include "sim/os/subprocess.hpp"

namespace halfway::report {
namespace {

using Parser = std::unique_ptr<cmark_parser, decltype(&cmark_parser_free)>;
using Node = std::unique_ptr<cmark_node, decltype(&cmark_node_free)>;

bool is_outside(const char* url) {
  return std::string_view(url).starts_with("https://") || std::string_view(url).starts_with("http://");
}

// Remove what only a separate page has and adapt the rest to be part of another page.
void adapt(cmark_node* document) {
  std::vector<cmark_node*> all;
  cmark_iter* walk = cmark_iter_new(document);
  for (cmark_event_type event; (event = cmark_iter_next(walk)) != CMARK_EVENT_DONE;)
    if (event == CMARK_EVENT_ENTER) all.push_back(cmark_iter_get_node(walk));
  cmark_iter_free(walk);
  for (cmark_node* node : all) {
    const cmark_node_type type = cmark_node_get_type(node);
    if (type == CMARK_NODE_HEADING) {
      cmark_node_set_heading_level(node, std::min(6, cmark_node_get_heading_level(node) + 2));
    } else if (type == CMARK_NODE_HTML_BLOCK) {
      cmark_node_free(node);
    } else if (type == CMARK_NODE_IMAGE ||
               (type == CMARK_NODE_LINK && !is_outside(cmark_node_get_url(node)))) {
      while (cmark_node* child = cmark_node_first_child(node)) cmark_node_insert_before(node, child);
      cmark_node_free(node);
    }
  }
}

}  // namespace

std::string base64_of(const std::filesystem::path& file) {
  const auto bytes = must(read_file(file));
  return OIIO::Strutil::base64_encode(bytes);
}

std::string data_uri(const std::filesystem::path& file, std::string_view media_type) {
  const auto text = base64_of(file);
  return fmt::format("data:{};base64,{}", media_type, text);
}

nlohmann::ordered_json commit_of(const std::filesystem::path& source) {
  if (find_program("git").empty()) return nullptr;
  const auto described = run_process({.arguments = {"git", "-C", source.string(), "describe", "--always",
                                                    "--tags", "--dirty= with changes"}},
                                     "");
  if (!described || !described->succeeded()) return nullptr;
  return described->output.substr(0, described->output.find('\n'));
}

std::string script_safe(const std::string& json) {
  return OIIO::Strutil::replace(json, "<", "\\u003c", true);
}

std::string from_markdown(std::string_view markdown, std::string_view name) {
  cmark_gfm_core_extensions_ensure_registered();
  const Parser parser(cmark_parser_new(CMARK_OPT_DEFAULT), cmark_parser_free);
  cmark_parser_attach_syntax_extension(parser.get(), cmark_find_syntax_extension("table"));
  cmark_parser_feed(parser.get(), markdown.data(), markdown.size());
  const Node document(cmark_parser_finish(parser.get()), cmark_node_free);
  adapt(document.get());
  const std::unique_ptr<char, decltype(&std::free)> html(
      cmark_render_html(document.get(), CMARK_OPT_DEFAULT, cmark_parser_get_syntax_extensions(parser.get())),
      std::free);
  const std::string box =
      fmt::format(R"(<div class="scroll" role="region" aria-label="{}: table" tabindex="0"><table>)",
                  kainjow::mustache::html_escape(std::string(name)));
  return OIIO::Strutil::replace(OIIO::Strutil::replace(html.get(), "<table>", box, true), "</table>",
                                "</table></div>", true);
}

std::string inline_svg(const std::string& svg, const std::string& prefix, const std::string& label,
                       const char* role) {
  pugi::xml_document document;
  const auto parsed = document.load_string(svg.c_str(), pugi::parse_default | pugi::parse_ws_pcdata);
  pugi::xml_node root = document.child("svg");
  if (!parsed || !root) throw_bad_input("{}: not an SVG: {}", prefix, parsed.description());
  for (const pugi::xpath_node& found : root.select_nodes("descendant-or-self::*/@*")) {
    pugi::xml_attribute attribute = found.attribute();
    const std::string_view key = attribute.name();
    std::string value = attribute.value();
    if (key == "id")
      value.insert(0, prefix);
    else if (key.ends_with("href") && value.starts_with('#') && !value.starts_with("#point-"))
      value.insert(1, prefix);
    else
      value = OIIO::Strutil::replace(value, "url(#", "url(#" + prefix, true);
    // Replace black and white by the page's text and background colours.
    if (value == "black" || value == "#000000" || value == "rgb(  0,   0,   0)")
      value = "currentColor";
    else if (value == "white" || value == "#ffffff" || value == "rgb(255, 255, 255)")
      value = "none";
    attribute.set_value(value.c_str());
  }
  // The viewBox keeps the proportions. The page sets the width and needs the width that the figure was drawn
  // with.
  if (!root.attribute("viewBox"))
    root.append_attribute("viewBox") =
        fmt::format("0 0 {} {}", root.attribute("width").as_int(), root.attribute("height").as_int()).c_str();
  double width = 0.0;
  if (std::sscanf(root.attribute("viewBox").value(), "%*f %*f %lf", &width) == 1)
    root.append_attribute("style") = fmt::format("--width: {}px", width).c_str();
  for (const char* name : {"width", "height", "role", "aria-label"}) root.remove_attribute(name);
  root.append_attribute("role") = role;
  root.append_attribute("aria-label") = label.c_str();
  // Titles would appear as tooltips that repeat the label.
  for (const char* name : {"title", "desc"}) root.remove_child(name);
  std::ostringstream out;
  root.print(out, "", pugi::format_raw | pugi::format_no_declaration);
  return out.str();
}

}  // namespace halfway::report
