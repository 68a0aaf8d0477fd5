// SPDX-License-Identifier: Apache-2.0
#include "sim/report/report.hpp"

#include <fmt/format.h>

#include "sim/report/html.hpp"
#include "sim/report/section.hpp"
#include "sim/system/file.hpp"
#include "sim/system/subprocess.hpp"

namespace halfway::report {

std::string Page::lacks(const std::string& what, const std::string& command) {
  report.notes.push_back(fmt::format("{}: {} makes it", what, command));
  return fmt::format("<p class=\"missing\">{}: not made yet; <code>{}</code> makes it.</p>\n", escaped(what),
                     escaped(command));
}

std::string table(const std::string& caption, const std::vector<std::string>& head,
                  const std::vector<std::vector<std::string>>& rows) {
  std::string text = fmt::format(
      "<div class=\"scroll\" role=\"region\" aria-label=\"{0}\" "
      "tabindex=\"0\"><table><caption>{0}</caption>\n"
      "<thead><tr>",
      escaped(caption));
  for (const std::string& cell : head) text += fmt::format("<th scope=\"col\">{}</th>", cell);
  text += "</tr></thead>\n<tbody>\n";
  for (const auto& row : rows) {
    text += "<tr>";
    for (const std::string& cell : row) text += fmt::format("<td>{}</td>", cell);
    text += "</tr>\n";
  }
  return text + "</tbody></table></div>\n";
}

namespace {

// What the page is made by; empty where that cannot be told, as without Git.
std::string told_commit(const std::filesystem::path& source) {
  if (find_program("git").empty()) return "";
  const auto said = run_process({.arguments = {"git", "-C", source.string(), "describe", "--always", "--tags",
                                               "--dirty= with changes"}},
                                "");
  if (!said || !said->succeeded()) return "";
  return fmt::format("<p id=\"commit\">Made at commit {}.</p>\n",
                     escaped(said->output.substr(0, said->output.find('\n'))));
}

}  // namespace

Result<Report> write_report(const ReportSettings& settings) {
  const std::filesystem::path here = settings.folders.source / "sim" / "report";
  if (const auto folder = settings.page.parent_path(); !folder.empty())
    if (Status made = make_folders(folder); !made) return made.error();
  const auto scratch = TemporaryFolder::make(std::filesystem::temp_directory_path());
  if (!scratch) return scratch.error();
  Page page{settings, {}, {}, Json::object(), scratch->path()};
  for (const auto& [file, mark] : {std::pair{"page.css", "style"}, std::pair{"page.js", "script"}}) {
    auto text = read_file(here / file);
    if (!text) return text.error();
    page.parts[mark] = std::move(*text);
  }
  for (const auto add : {add_frames, add_study, add_figures, add_hardware, add_pages})
    if (Status added = add(page); !added) return added.error();
  page.parts["commit"] = told_commit(settings.folders.source);
  page.parts["data"] = script_safe(page.data.dump());

  const auto outline = read_file(here / "page.html");
  if (!outline) return outline.error();
  std::string text;
  std::size_t at = 0;
  for (std::size_t mark; (mark = outline->find("{{", at)) != std::string::npos;) {
    const std::size_t end = outline->find("}}", mark);
    const std::string name = outline->substr(mark + 2, end - mark - 2);
    const auto part = page.parts.find(name);
    if (end == std::string::npos || part == page.parts.end())
      return tool_failed(
          fmt::format("{}: '{{{{{}}}}}' is no part of the report", (here / "page.html").string(), name));
    text.append(*outline, at, mark - at).append(part->second);
    at = end + 2;
  }
  text.append(*outline, at);
  if (Status written = write_file(settings.page, text); !written) return written.error();
  page.report.bytes = text.size();
  return page.report;
}

}  // namespace halfway::report
