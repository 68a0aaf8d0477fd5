// SPDX-License-Identifier: Apache-2.0
// Sections with the pages that other commands write.
#include "sim/report/html.hpp"
#include "sim/report/section.hpp"
#include "sim/system/file.hpp"

namespace halfway::report {
namespace {

struct OtherPage {
  const char* id;
  const char* title;
  const char* file;     // relative to the checkout
  const char* command;  // the command that writes it
};
constexpr std::array c_pages = {
    OtherPage{"stability", "Hard cases", "tb/stability/README.md", "make stability"},
    OtherPage{"proofs", "Proofs", "tb/proofs/README.md", "make prove"},
    OtherPage{"mutants", "Mutants", "tb/mutants/README.md", "make mutate"},
    OtherPage{"bounds", "Bounds", "tb/bounds/README.md", "make bounds"},
    OtherPage{"synthesis", "Synthesis", "tb/synth/README.md", "make synth"},
    OtherPage{"bench", "Speed of simulation", "sim/bench/README.md", "make bench"},
};

}  // namespace

Status add_pages(Page& page) {
  Json& pages = page.view["pages"] = Json::array();
  for (const OtherPage& other : c_pages) {
    const std::filesystem::path file = page.settings.folders.source / other.file;
    if (!std::filesystem::exists(file)) continue;
    page.settings.on_progress(other.file);
    const auto text = read_file(file);
    if (!text) return text.error();
    pages.push_back({{"id", other.id},
                     {"title", other.title},
                     {"command", other.command},
                     {"file", other.file},
                     {"html", from_markdown(*text, other.title)}});
  }
  return Ok{};
}

}  // namespace halfway::report
