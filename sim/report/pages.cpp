// SPDX-License-Identifier: Apache-2.0
// Sections with the pages that other commands write.
#include "sim/os/file.hpp"
#include "sim/report/html.hpp"
#include "sim/report/section.hpp"

namespace halfway::report {
namespace {

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

}  // namespace

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

}  // namespace halfway::report
