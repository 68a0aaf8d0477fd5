// SPDX-License-Identifier: Apache-2.0
// halfway_stability: the hard cases. Each full sweep has a row of evidence, whose details are the hardware
// that it draws with.
#include <map>
#include <mutex>
#include <optional>
#include <sstream>

#include "evidence/inputs.hpp"
#include "evidence/test_rows.hpp"
#include "sim/ghdl/ghdl_library.hpp"
#include "sim/synth/nameless_netlist.hpp"
#include "sim/system/file.hpp"

namespace halfway::stability {
namespace {

const std::filesystem::path c_root = HALFWAY_SOURCE_DIR;

Result<std::string> common_hash() {
  constexpr std::string_view c_tools[] = {"ghdl", "verilator"};
  return evidence::program_hash(c_tools, c_root, HALFWAY_FOLDERS);
}

// Netlists of the hardware that rows name: one line "entity generic=value ..." each. For several threads.
class Netlists {
 public:
  Result<std::string> hash(const std::string& lines) {
    ContentHash hash;
    std::istringstream stream(lines);
    for (std::string line; std::getline(stream, line);) {
      const auto one = hash_of(line);
      if (!one) return one.error();
      hash.add(*one);
    }
    return hash.hex();
  }

 private:
  Result<std::string> hash_of(const std::string& line) {
    {
      const std::lock_guard lock(mutex_);
      if (const auto known = known_.find(line); known != known_.end()) return known->second;
      if (const Status opened = open(); !opened) return opened.error();
    }
    std::istringstream words(line);
    std::string entity;
    words >> entity;
    std::vector<std::pair<std::string, std::string>> generics;
    for (std::string word; words >> word;) {
      const std::size_t equals = word.find('=');
      generics.emplace_back(word.substr(0, equals), word.substr(equals + 1));
    }
    const auto netlist = library_->synthesize(entity, generics);
    if (!netlist) return netlist.error();
    const std::lock_guard lock(mutex_);
    return known_[line] = ContentHash().add(synth::nameless(*netlist)).hex();
  }

  Status open() {
    if (library_) return Ok{};
    const auto tool = GhdlTool::find();
    if (!tool) return tool.error();
    const auto sources = read_rtl_sources(c_root);
    if (!sources) return sources.error();
    const auto library = GhdlLibrary::for_synthesis(*tool, *sources, HALFWAY_CACHE_DIR);
    if (!library) return library.error();
    library_ = *library;
    return Ok{};
  }

  std::mutex mutex_;
  std::optional<GhdlLibrary> library_;
  std::map<std::string, std::string> known_;
};

}  // namespace
}  // namespace halfway::stability

int main(int argc, char** argv) {
  using namespace halfway;
  stability::Netlists netlists;
  return evidence::run_tests(
      argc, argv,
      {.place = {.root = stability::c_root,
                 .rows = "tb/stability/evidence.txt",
                 .page = "docs/results/hard_cases.md"},
       .common = stability::common_hash,
       .of_details = [&](const std::string& details) { return netlists.hash(details); }});
}
