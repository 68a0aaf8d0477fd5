// SPDX-License-Identifier: Apache-2.0
#include "mutants/netlist_faults.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "sim/engines/verilator/netlist.hpp"
#include "sim/engines/verilator/verilated_library.hpp"
#include "sim/os/file.hpp"
#include "sim/os/must.hpp"
#include "sim/os/subprocess.hpp"

namespace halfway::mutants {
namespace {

constexpr const char* c_install_yosys = "apt-get install yosys";
constexpr std::chrono::seconds c_yosys_time{3600};
constexpr std::chrono::seconds c_miter_time{60};     // of a netlist; for larger ones nothing is proved
constexpr std::chrono::seconds c_reduction_time{5};  // of one fault, before the proof

// {0}: top, {1}: faults, {2}: seed, {3}: marks of the modules without faults, {4}: cells without a module.
// Make the faults after optimization: a fault in logic that is constant, or that no output depends on, would
// have no effect.
constexpr const char* c_mutate =
    "read_verilog netlist.v\n"
    "hierarchy -top {0}\n"
    "proc\n{3}flatten\nopt -full\nwreduce\nopt_dff\nopt_clean -purge\nmemory -nomap\nopt_clean "
    "-purge\n"
    "write_rtlil before.il\n"
    "mutate -list {1} -seed {2} -ctrl mutsel 16 1 -o faults.ys c:* a:tested %d{4}\n"
    "script faults.ys\n"
    "opt_clean\n"
    "write_verilog -noattr mutated.v\n";

// The Verilog that Yosys writes has implicit widths.
constexpr const char* c_lint = "/* verilator lint_off WIDTH */\n";

/// Yosys's or ABC's end; `time` limits it.
ProcessEnd run_in(const std::filesystem::path& folder, std::vector<std::string> arguments,
                  std::chrono::seconds time = c_yosys_time) {
  return must(run_process({.arguments = std::move(arguments), .working_folder = folder, .timeout = time},
                          c_install_yosys));
}

void expect_success(const ProcessEnd& end, const std::string& what) {
  if (!end.succeeded()) throw Failure{tool_failed(fmt::format("{}: {}: {}", what, end.how(), end.output))};
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// The word that follows " -name " in a line of Yosys's list.
std::string option(const std::string& line, const std::string& name) {
  const auto at = line.find(" -" + name + " ");
  if (at == std::string::npos) return {};
  const auto begin = at + name.size() + 3;
  return line.substr(begin, line.find(' ', begin) - begin);
}

/// GHDL appends the generics to an entity's name.
bool is_of(const std::string& module, const std::string& entity) {
  return module == entity || module.starts_with(entity + "_");
}

/// The constants at the ports of cells, by "cell port", in Yosys's text of a netlist.
std::map<std::string, std::string> constants_of(const std::string& text) {
  std::map<std::string, std::string> constants;
  std::string cell;
  for (const std::string& line : lines_of(text)) {
    std::istringstream stream(line);
    std::string key, first, second;
    stream >> key >> first >> second;
    if (key == "cell") cell = second + ' ';
    const auto quote = second.find('\'');
    if (key == "connect" && quote != std::string::npos)
      constants.emplace(cell + first.substr(1), second.substr(quote + 1));
  }
  return constants;
}

/// `constants` are those of the netlist without faults.
Fault read_fault(const std::string& line, const std::vector<std::string>& netlist_lines,
                 const std::vector<std::string>& places,
                 const std::map<std::string, std::string>& constants) {
  Fault fault{option(line, "mode"),
              option(line, "port"),
              fmt::format("{}[{}]", option(line, "wire"), option(line, "wirebit")),
              {}};
  const auto constant = constants.find(option(line, "cell") + ' ' + fault.port);
  if (constant != constants.end()) {
    const std::string& bits = constant->second;
    const std::size_t bit = std::stoul(option(line, "portbit"));
    fault.changes = bit >= bits.size() || fault.kind != fmt::format("const{}", bits[bits.size() - 1 - bit]);
  }
  // The line of the statement itself, or of the instance that contains it.
  static const std::regex c_source(R"( -src netlist\.v:(\d+)\.)");
  for (auto at = std::sregex_iterator(line.begin(), line.end(), c_source); at != std::sregex_iterator();
       ++at) {
    const std::size_t number = std::stoul((*at)[1]) - 1;
    if (number >= places.size() || places[number].empty()) continue;
    const std::string& text = netlist_lines[number];
    if (fault.place.empty() || text.starts_with("  assign ") || text.starts_with("  always "))
      fault.place = places[number];
  }
  return fault;
}

/// Both netlists with the same inputs, one without a fault and one with fault `select`. Writes to a memory
/// are compared, too, since the memory is mapped to registers.
std::string miter(const FaultyNetlist& netlist) {
  std::string header, gold, gate, differences;
  std::string declared = "  input [15:0] select;\n  output differs;\n";
  for (const FaultyNetlist::Port& port : netlist.ports) {
    const std::string range = fmt::format("[{}:0]", port.bits - 1);
    if (port.is_input) {
      header += port.name + ", ";
      declared += fmt::format("  input {} {};\n", range, port.name);
      gold += fmt::format(".{0}({0}), ", port.name);
      gate += fmt::format(".{0}({0}), ", port.name);
    } else {
      declared += fmt::format("  wire {0} {1}_gold, {1}_gate;\n", range, port.name);
      gold += fmt::format(".{0}({0}_gold), ", port.name);
      gate += fmt::format(".{0}({0}_gate), ", port.name);
      differences += fmt::format(" | (|({0}_gold ^ {0}_gate))", port.name);
    }
  }
  return fmt::format(
      "module miter({0}select, differs);\n{1}  {2} gold({3}.mutsel(16'd0));\n  {2} "
      "gate({4}.mutsel(select));\n"
      "  assign differs = 1'b0{5};\nendmodule\n",
      header, declared, netlist.top, gold, gate, differences);
}

/// The and-gates of the miter with the input `select` set to `number`: converts AIGER's text to its binary
/// form, which ABC reads.
std::string select_fault(const std::string& text, std::uint32_t number) {
  std::istringstream in(text);
  std::string word;
  std::uint32_t most = 0, inputs = 0, latches = 0, outputs = 0, gates = 0;
  in >> word >> most >> inputs >> latches >> outputs >> gates;
  std::vector<std::uint32_t> to(2 * (most + 1));
  for (std::uint32_t literal = 0; literal < to.size(); ++literal) to[literal] = literal;
  struct Gate {
    std::uint32_t output, a, b;
  };
  std::vector<std::uint32_t> input(inputs), next(latches), output(outputs);
  std::vector<Gate> gate(gates);
  for (auto& literal : input) in >> literal;
  for (auto& literal : next) in >> word >> literal;
  for (auto& literal : output) in >> literal;
  for (auto& one : gate) in >> one.output >> one.a >> one.b;
  // Symbols: "i12 select[3]".
  for (std::string name; in >> word >> name && word != "c";)
    if (word.starts_with('i') && name.starts_with("select")) {
      const auto bracket = name.find('[');
      const unsigned bit =
          bracket == std::string::npos ? 0 : static_cast<unsigned>(std::stoul(name.substr(bracket + 1)));
      const std::uint32_t literal = input[std::stoul(word.substr(1))];
      to[literal] = number >> bit & 1U;
      to[literal + 1] = to[literal] ^ 1U;
    }
  std::string result = fmt::format("aig {} {} {} {} {}\n", most, inputs, latches, outputs, gates);
  for (const auto literal : next) result += fmt::format("{}\n", to[literal]);
  for (const auto literal : output) result += fmt::format("{}\n", to[literal]);
  const auto add_difference = [&](std::uint32_t difference) {
    for (; difference >= 0x80; difference >>= 7) result += static_cast<char>(difference | 0x80);
    result += static_cast<char>(difference);
  };
  for (const Gate& one : gate) {
    const std::uint32_t high = std::max(to[one.a], to[one.b]), low = std::min(to[one.a], to[one.b]);
    add_difference(one.output - high);
    add_difference(high - low);
  }
  return result;
}

}  // namespace

std::set<std::string> modules_of(const std::string& netlist, const std::vector<std::string>& entities) {
  static const std::regex c_instance(R"(^  (\w+) \w+ \($)"), c_module(R"(^module (\w+))");
  std::set<std::string> marked;
  std::map<std::string, std::set<std::string>> parents;
  std::string module;
  for (const std::string& line : lines_of(netlist))
    if (std::smatch found; std::regex_search(line, found, c_module)) {
      module = found[1];
      if (std::ranges::any_of(entities, [&](const std::string& entity) { return is_of(module, entity); }))
        marked.insert(module);
    } else if (std::regex_match(line, found, c_instance)) {
      parents[found[1]].insert(module);
    }
  for (std::size_t before = 0; before != marked.size();) {
    before = marked.size();
    for (const auto& [inner, outer] : parents)
      if (std::ranges::includes(marked, outer)) marked.insert(inner);
  }
  return marked;
}

std::set<std::size_t> selectable_faults(const std::string& mutated) {
  static const std::regex c_selection(R"(mutsel == 16'h([0-9a-f]{4}))");
  std::set<std::size_t> numbers;
  for (auto at = std::sregex_iterator(mutated.begin(), mutated.end(), c_selection);
       at != std::sregex_iterator(); ++at)
    numbers.insert(std::stoul((*at)[1], nullptr, 16));
  return numbers;
}

std::vector<std::string> vhdl_places(const std::string& printed) {
  static const std::regex c_place(R"(/\* (\S+\.vhd):(\d+):\d+ )");
  static const std::regex c_comment(R"(/\*.*?\*/|//.*)");
  std::vector<std::string> places;
  std::string last;
  for (const std::string& line : lines_of(printed)) {
    if (std::smatch found; std::regex_search(line, found, c_place)) {
      const std::string file = found[1];
      last = fmt::format("{}:{}", file.substr(file.starts_with("rtl/") ? 4 : 0), found[2].str());
    }
    // Lines with only comments are not in the mended netlist.
    if (std::regex_replace(line, c_comment, "").find_first_not_of(" \t\r") == std::string::npos) continue;
    places.push_back(last);
    // A comment belongs to the next statement, which ends with a semicolon.
    if (line.find(';') != std::string::npos && !line.starts_with("    ")) last.clear();
  }
  return places;
}

FaultyNetlist make_faulty_netlist(const Design& design, const GhdlLibrary& library,
                                  const std::filesystem::path& scratch, unsigned seed) {
  const std::string printed = must(library.synthesize(design.entity, design.generics));
  const std::string text = must(mend_netlist(printed));
  FaultyNetlist netlist{scratch / design.name, design.entity, {}, {}};
  // Optimize first: cells that Yosys makes in a module get its mark.
  std::string marks = design.without_faults.empty() ? "" : "opt -full\n";
  for (const std::string& module : modules_of(text, design.without_faults))
    marks += fmt::format("setattr -set tested 1 {}/*\n", module);
  // After flattening Yosys makes logic for enables of registers, of which it does not say the module.
  std::string unknown;
  if (!marks.empty()) {
    marks += fmt::format("setattr -set own 1 {}/c:$auto$opt_dff*\n", design.entity);
    unknown = " c:$auto$opt_dff* a:own %d %d";
  }
  const std::string script = fmt::format(c_mutate, design.entity, design.faults, seed, marks, unknown);
  // Reuse the result of an earlier run on the same netlist.
  const std::string key = ContentHash().add(text).add(script).add(c_lint).hex();
  const auto kept = read_file(netlist.folder / "key");
  if (!kept || *kept != key) {
    must(make_folders(netlist.folder));
    must(write_file(netlist.folder / "netlist.v", text));
    must(write_file(netlist.folder / "mutate.ys", script));
    expect_success(run_in(netlist.folder, {"yosys", "-q", "mutate.ys"}), design.name);
    must(write_file(netlist.folder / "key", key));
  }
  const auto netlist_lines = lines_of(text);
  const auto places = vhdl_places(printed);
  if (places.size() != netlist_lines.size())
    throw Failure{tool_failed(fmt::format("{}: {} lines of the netlist have {} places; correct vhdl_places",
                                          design.name, netlist_lines.size(), places.size()))};
  const auto constants = constants_of(must(read_file(netlist.folder / "before.il")));
  const std::string mutated = must(read_file(netlist.folder / "mutated.v"));
  const std::set<std::size_t> selectable = selectable_faults(mutated);
  for (const std::string& line : lines_of(must(read_file(netlist.folder / "faults.ys")))) {
    Fault& fault = netlist.faults.emplace_back(read_fault(line, netlist_lines, places, constants));
    fault.changes = fault.changes && selectable.contains(netlist.faults.size());
  }
  static const std::regex c_declaration(R"(^  (input|output) (?:\[(\d+):0\] )?(\w+);$)");
  for (const std::string& line : lines_of(mutated))
    if (std::smatch found; std::regex_match(line, found, c_declaration) && found[3] != "mutsel")
      netlist.ports.push_back({found[3],
                               found[2].matched ? static_cast<std::uint32_t>(std::stoul(found[2])) + 1 : 1,
                               found[1] == "input"});
  return netlist;
}

CompiledNetlist compile(const Design& design, const FaultyNetlist& netlist,
                        const std::filesystem::path& source, const std::filesystem::path& scratch) {
  std::string ports = "PORT(mutsel,16,1)";
  for (const FaultyNetlist::Port& port : netlist.ports)
    ports += fmt::format("PORT({},{},{})", port.name, port.bits, port.is_input ? 1 : 0);
  return CompiledNetlist(
      must(open_verilated({.name = design.name,
                           .netlist = c_lint + must(read_file(netlist.folder / "mutated.v")),
                           .top = design.entity,
                           .harness = source / "tb/mutants/model_harness.cpp",
                           .include_folder = source,
                           .harness_headers = {source / "tb/mutants/model_harness.hpp"},
                           .definitions = {"MUTANT_PORTS=" + ports},
                           .fast = false,
                           .compiler = {}},
                          scratch)));
}

std::vector<bool> prove_equivalent(const FaultyNetlist& netlist, const std::vector<std::uint32_t>& numbers,
                                   std::chrono::seconds time) {
  std::vector<bool> proved(numbers.size());
  if (numbers.empty()) return proved;
  must(write_file(netlist.folder / "miter.v", miter(netlist)));
  must(write_file(
      netlist.folder / "miter.ys",
      "read_verilog mutated.v miter.v\nhierarchy -top miter\nproc\nflatten\nopt -full\nmemory_map\n"
      "setundef -undriven -zero\nsetundef -init -zero\nopt -full\nasync2sync\ntechmap\nopt\ndffunmap\n"
      "setundef -zero\nopt_clean\naigmap\nopt_clean\nwrite_aiger -ascii -symbols -zinit miter.aag\n"));
  const ProcessEnd made = run_in(netlist.folder, {"yosys", "-q", "miter.ys"}, c_miter_time);
  if (made.timed_out) return proved;
  expect_success(made, "miter of " + netlist.top);
  const std::string gates = must(read_file(netlist.folder / "miter.aag"));
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    must(write_file(netlist.folder / "fault.aig", select_fault(gates, numbers[i])));
    const ProcessEnd end =
        run_in(netlist.folder,
               {"yosys-abc", "-c",
                fmt::format("read_aiger fault.aig; &get -n; &scorr; &put; pdr -T {}; sat", time.count())},
               c_reduction_time + time);
    // Without registers later versions of pdr decide nothing; with registers sat decides nothing.
    proved[i] = end.succeeded() && (end.output.find("Property proved.") != std::string::npos ||
                                    end.output.find("UNSATISFIABLE") != std::string::npos);
  }
  return proved;
}

}  // namespace halfway::mutants
