// SPDX-License-Identifier: Apache-2.0
#include "sim/figures/figure_plot.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <pugixml.hpp>
#include <sstream>

#include "sim/os/file.hpp"

namespace halfway::figures {
namespace {

// Remove gnuplot's many empty groups, and its titles of curves.
void prune(pugi::xml_node node) {
  for (pugi::xml_node child = node.first_child(), next; child; child = next) {
    next = child.next_sibling();
    prune(child);
    const bool is_group = std::string_view(child.name()) == "g";
    if (is_group && std::string_view(child.attribute("id").value()).starts_with("gnuplot_plot_"))
      child.remove_child("title");
    if (is_group && !child.first_child()) node.remove_child(child);
  }
}

// Insert title and description; gnuplot 5.4 has no option for them.
std::string described(const std::string& svg, const Plot& plot) {
  pugi::xml_document document;
  const auto parsed = document.load_string(svg.c_str(), pugi::parse_default | pugi::parse_declaration);
  pugi::xml_node root = document.child("svg"), desc = root.child("desc");
  if (!parsed || !desc) throw_tool_failed("gnuplot's SVG cannot be read: {}", parsed.description());
  std::string produced = desc.text().get();
  produced.erase(produced.find_last_not_of(' ') + 1);
  root.prepend_attribute("role") = "img";
  root.child("title").text() = plot.title.c_str();
  desc.text() = (plot.words.empty() ? plot.title : plot.words).c_str();
  root.insert_child_after(pugi::node_comment, desc).set_value((" " + produced + " ").c_str());
  prune(root);
  std::ostringstream out;
  document.save(out, "", pugi::format_raw);
  // Put each element on a line, without line breaks in texts.
  std::string text = out.str();
  for (const std::string_view next : {"><g", "><path", "><use", "><rect", "><title", "><desc", "><!--"})
    for (std::size_t at = 0; (at = text.find(next, at)) != std::string::npos; at += next.size())
      text.insert(at + 1, "\n");
  return text + '\n';
}

}  // namespace

std::string data_block(const std::string& name, std::span<const std::vector<double>> rows) {
  std::string text = fmt::format("${} << EOD\n", name);
  for (const std::vector<double>& row : rows) text += fmt::format("{:.6g}\n", fmt::join(row, " "));
  return text + "EOD\n";
}

void draw_plot(const Context& context, const std::string& name, const Plot& plot, Drawing& drawing) {
  const std::string svg = run_gnuplot(plot.script, context.out, name);
  must(write_file(context.out / (name + ".svg"), described(svg, plot)));
  drawing.pictures.push_back({name + ".svg", plot.title});
}

}  // namespace halfway::figures
