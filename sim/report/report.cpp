// SPDX-License-Identifier: Apache-2.0
#include "sim/report/report.hpp"

#include <fmt/format.h>

#include "sim/files/template.hpp"
#include "sim/os/file.hpp"
#include "sim/report/html.hpp"
#include "sim/report/section.hpp"

namespace halfway::report {
namespace {

// A page that another command writes.
struct OtherPage {
  const char* id;
  const char* title;
  const char* file;     // relative to the checkout
  const char* command;  // the command that writes it
};
constexpr std::array c_pages = {
    OtherPage{"stability", "Hard cases", "docs/results/hard_cases.md", "make stability"},
    OtherPage{"proofs", "Proofs", "docs/results/proofs.md", "make prove"},
    OtherPage{"mutants", "Mutants", "docs/results/mutants.md", "make mutate"},
    OtherPage{"bounds", "Bounds", "docs/results/bounds.md", "make bounds"},
    OtherPage{"synthesis", "Synthesis", "docs/results/synthesis.md", "make synth"},
    OtherPage{"bench", "Speed of simulation", "docs/results/speed.md", "make bench"},
};

// Add a section for each page.
void add_pages(Page& page) {
  Json& pages = page.view["pages"] = Json::array();
  for (const OtherPage& other : c_pages) {
    const std::filesystem::path file = page.settings.folders.source / other.file;
    if (!std::filesystem::exists(file)) continue;
    page.settings.on_progress(other.file);
    const auto text = must(read_file(file));
    pages.push_back({{"id", other.id},
                     {"title", other.title},
                     {"command", other.command},
                     {"file", other.file},
                     {"html", from_markdown(text, other.title)}});
  }
}

}  // namespace

Json Page::lacks(const std::string& what, const std::string& command) {
  report.notes.push_back(fmt::format("{}: {} makes it", what, command));
  return {{"what", what}, {"command", command}};
}

Report write_report(const ReportSettings& settings) {
  const std::filesystem::path here = settings.folders.source / "sim" / "report";
  if (const auto folder = settings.page.parent_path(); !folder.empty()) must(make_folders(folder));
  const auto scratch = must(TemporaryFolder::make(std::filesystem::temp_directory_path()));
  Page page{settings, {}, Json::object(), Json::object(), scratch.path()};
  for (const auto& [file, name] : {std::pair{"report.css", "style"}, std::pair{"report.js", "script"}})
    page.view[name] = must(read_file(here / file));
  for (const auto add : {add_frames, add_study, add_figures, add_hardware, add_pages}) add(page);
  page.view["commit"] = commit_of(settings.folders.source);
  page.view["data"] = script_safe(page.data.dump());
  const auto text = must(filled_template(here / "report.html.mustache", page.view, Escape::html));
  must(write_file(settings.page, text));
  page.report.bytes = text.size();
  return page.report;
}

}  // namespace halfway::report
