// SPDX-License-Identifier: Apache-2.0
// halfway_accuracy: measures the tables of docs/accuracy.md. Each row of a table is a row of evidence.
#include <map>

#include "accuracy/row.hpp"
#include "evidence/inputs.hpp"
#include "evidence/test_rows.hpp"
#include "sim/system/file.hpp"
#include "sim/system/must.hpp"

namespace halfway::accuracy {
namespace {

Result<std::string> program_hash() {
  constexpr std::string_view c_tools[] = {"ghdl", "verilator", "yosys"};
  return evidence::program_hash(c_tools, folders().source, HALFWAY_FOLDERS);
}

// Hash of the files that the row of this name reads, and of the netlists that it draws with.
Result<std::string> inputs_hash(const std::string& name) {
  const auto found = all_rows().find(name);
  // A stored row may name one that does not exist any more. It is stale.
  if (found == all_rows().end()) return std::string();
  const Row& row = found->second;
  ContentHash hash;
  try {
    for (const std::string& file : row.reads) hash.add(must(read_file(folders().source / file)));
    if (row.draws)
      for (const study::HardwareSource& source : row.draws()) {
        const GhdlLibrary library = must(GhdlLibrary::for_synthesis(
            must(GhdlTool::find()), must(read_rtl_sources(source.folders.source)), source.folders.cache));
        hash.add(must(synth::netlist_hash(library, source.design())));
      }
  } catch (const Failure& failure) {
    return failure.error;
  }
  return hash.hex();
}

}  // namespace
}  // namespace halfway::accuracy

int main(int argc, char** argv) {
  using namespace halfway;
  return evidence::run_tests(argc, argv,
                             {.place = {.root = accuracy::folders().source,
                                        .rows = "tb/accuracy/evidence.txt",
                                        .page = "docs/accuracy.md"},
                              .common = accuracy::program_hash,
                              .of_details = accuracy::inputs_hash});
}
