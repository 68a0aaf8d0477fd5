// SPDX-License-Identifier: Apache-2.0
#include "prover.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <regex>

#include "formal_verilog.hpp"
#include "sim/os/file.hpp"
#include "sim/os/must.hpp"
#include "sim/os/subprocess.hpp"
#include "text.hpp"
#include "words/generator/formats.hpp"

namespace halfway::proofs {
namespace {

constexpr const char* c_install = "apt-get install yosys cvc5 gappa";
constexpr std::chrono::minutes c_timeout{60};
constexpr const char* c_timed_out = "no answer within 60 minutes";
constexpr const char* c_formats = "rtl/tables/formats_pkg.vhd";

std::string read_unit(const Folders& folders, const std::string& name) {
  return must(read_file(folders.source / "tb/rtl" / name));
}

ProcessEnd run(const std::filesystem::path& folder, std::vector<std::string> arguments,
               const std::filesystem::path& standard_output = {}) {
  return must(run_process({.arguments = std::move(arguments),
                           .working_folder = folder,
                           .standard_output = standard_output,
                           .timeout = c_timeout},
                          c_install));
}

// Prints only the tool's first message, because the others follow from it.
Failure no_verdict(const Proof& proof, std::string_view tool, const ProcessEnd& end) {
  constexpr std::size_t c_most_characters = 1000;
  return Failure{
      tool_failed(fmt::format("{}: {} gave no verdict ({}):\n{}", proof.unit, tool, end.how(),
                              end.output.substr(0, std::min(end.output.find("\n\n"), c_most_characters))))};
}

std::string last_line_with(std::string_view text, std::string_view part) {
  const std::size_t at = text.rfind(part);
  return at == std::string_view::npos ? std::string()
                                      : std::string(text.substr(at, text.find('\n', at) - at));
}

// ---- The RTL

std::string formats_package(const std::vector<Format>& narrow) {
  auto presets = tables::preset_formats();
  for (tables::PresetFormats& preset : presets)
    for (tables::Format& format : preset.formats)
      for (const Format& other : narrow)
        if (other.name == format.name) {
          format.integer_bits = other.integer_bits;
          format.fraction_bits = other.fraction_bits;
        }
  return tables::vhdl_package(presets);
}

const std::vector<Format>& formats_of(const Proof& proof, const Fault* fault) {
  return fault == nullptr ? proof.formats : proof.fault_formats;
}

VhdlSource* find_source(std::vector<VhdlSource>& rtl, std::string_view name) {
  const auto at = std::ranges::find(rtl, name, &VhdlSource::name);
  return at == rtl.end() ? nullptr : &*at;
}

// The RTL with the formats of the proof, or with those of its faults and the fault.
std::vector<VhdlSource> read_rtl(const Folders& folders, const Proof& proof, const Fault* fault) {
  std::vector<VhdlSource> rtl = read_sources(folders, proof);
  if (const auto& formats = formats_of(proof, fault); !formats.empty())
    if (VhdlSource* package = find_source(rtl, c_formats)) package->content = formats_package(formats);
  if (fault != nullptr) find_source(rtl, "rtl/" + fault->file)->content = text_with_fault(rtl, *fault);
  return rtl;
}

// ---- The unit

std::string entity_of(const Proof& proof) {
  return std::filesystem::path(proof.entity).filename();
}

// The top is the entity, to which a unit is bound, or an entity of the unit's own around it.
std::string top_of(const Proof& proof, std::string_view unit) {
  return entity_of(proof) + (contains(unit, "\nentity ") ? "_proof" : "");
}

// VHDL for `$entries`: `entry` is the table's entry at `address`. Each bit of the entries is one constant.
std::string vhdl_of_table(const Proof& proof) {
  std::string constants, assignments;
  for (int bit = 0; bit < proof.table_bits; ++bit) {
    std::string word;
    for (const std::uint64_t entry : proof.table)
      word.insert(word.begin(), (entry >> bit & 1) != 0 ? '1' : '0');
    constants += fmt::format("    constant c_{} : std_logic_vector({} downto 0) := \"{}\";\n", bit,
                             proof.table.size() - 1, word);
    assignments += fmt::format("    entry({0}) <= c_{0}(to_integer(unsigned(address)));\n", bit);
  }
  return fmt::format("{}  begin\n{}", constants, assignments);
}

// The unit in which every property is of the rising edge of `clk`.
std::string with_clock(std::string text) {
  if (!contains(text, " always ")) return text;
  static const std::regex c_start(R"(\n(vunit [^{]*\{|architecture \w+ of \w+ is))");
  return std::regex_replace(text, c_start, "$& default clock is rising_edge(clk);",
                            std::regex_constants::format_first_only);
}

void replace(std::string& text, std::string_view part, std::string_view by) {
  if (const std::size_t at = text.find(part); at != std::string::npos) text.replace(at, part.size(), by);
}

// The proved entity up to its end, without comments.
std::string read_declaration(const Folders& folders, const Proof& proof) {
  const std::string text = must(read_file(folders.source / "rtl" / (proof.entity + ".vhd")));
  return std::regex_replace(text.substr(0, text.find("end entity")), std::regex("--[^\n]*"), "");
}

bool has_reset(const std::string& declaration) {
  static const std::regex c_reset(R"(\breset *: *in )");
  return std::regex_search(declaration, c_reset);
}

// Writes out `$around`: the head of an entity around the proved one, with the same context and the generics
// that follow in the line.
std::string with_around(const std::string& text, const Proof& proof, const std::string& declaration) {
  static const std::regex c_around(R"(\$around *([^\n]*))");
  std::smatch found;
  if (!std::regex_search(text, found, c_around)) return text;
  const std::string generics = found[1].length() == 0 ? "" : fmt::format("generic ({});", found[1].str());
  return fmt::format(
      "{}{}\nuse ieee.numeric_std.all;\nentity {}_proof is {} port (clk{} : in std_logic); end entity;\n"
      "architecture proof of {}_proof is{}",
      found.prefix().str(), declaration.substr(0, declaration.find("\nentity ")), entity_of(proof), generics,
      has_reset(declaration) ? ", reset" : "", entity_of(proof), found.suffix().str());
}

// Writes out `$dut`: the proved entity, with signals of the same names at its ports, and with the generics
// that follow in the line.
std::string with_dut(const std::string& text, const Proof& proof, const std::string& declaration) {
  static const std::regex c_instance(R"(\$dut *([^\n]*))"), c_port(R"((\w+) *: *(?:in|out|buffer) )");
  std::smatch found;
  if (!std::regex_search(text, found, c_instance)) return text;
  std::string ports;
  for (std::sregex_iterator at(declaration.begin(), declaration.end(), c_port), last; at != last; ++at)
    ports += fmt::format("{}{} => {}", ports.empty() ? "" : ", ", (*at)[1].str(), (*at)[1].str());
  const std::string generics = found[1].length() == 0 ? "" : fmt::format("generic map ({})", found[1].str());
  return fmt::format("{}dut : entity work.{} {} port map ({});{}", found.prefix().str(), entity_of(proof),
                     generics, ports, found.suffix().str());
}

// Writes out the process between `$ghost` and `$end`. At a reset, each signal that it assigns takes its
// initial value, if it has one.
std::string with_ghosts(std::string text, const std::string& declaration) {
  const std::string block(between(text, "$ghost", "$end"));
  static const std::regex c_initial(R"(\bsignal ([\w, ]+):[^;]*:= *([^;]*);)"), c_name(R"(\w+)");
  std::string resets;
  for (std::sregex_iterator at(text.begin(), text.end(), c_initial), last; at != last; ++at) {
    const std::string names = (*at)[1];
    for (std::sregex_iterator name(names.begin(), names.end(), c_name); name != last; ++name)
      if (std::regex_search(block, std::regex(fmt::format(R"(\n *{}\b[^\n]* <= )", name->str()))))
        resets += fmt::format("{} <= {}; ", name->str(), (*at)[2].str());
  }
  if (!resets.empty()) resets = fmt::format("if reset = '1' then {}end if; ", resets);
  replace(text, "$ghost", "ghost : process (clk) begin if rising_edge(clk) then");
  replace(text, "$end", fmt::format("{}end if; end process;", has_reset(declaration) ? resets : ""));
  return text;
}

// Writes out `kept(valid, ready, word, ...)`: what waits stays valid, and its words are stable.
std::string with_kept(const std::string& text) {
  static const std::regex c_kept(R"(\bkept\((\w+), (\w+)([^()]*)\))"), c_word(R"(,\s*([\w.]+))");
  std::string result;
  auto rest = text.begin();
  for (std::sregex_iterator at(text.begin(), text.end(), c_kept), last; at != last; ++at) {
    result.append(rest, (*at)[0].first);
    result += std::regex_replace((*at)[0].str(), c_kept, "prev($1 and not $2 and not reset) -> $1 = '1'");
    result += std::regex_replace((*at)[3].str(), c_word, " and stable($1)");
    rest = (*at)[0].second;
  }
  return result.append(rest, text.end());
}

struct Unit {
  std::string text;
  std::string top;
  PropertyCounts counts;
};

// The unit, with the table and the contracts that the proof needs.
Unit make_unit(const Folders& folders, const Proof& proof) {
  std::string text = read_unit(folders, proof.unit);
  replace(text, "$entity", entity_of(proof));
  replace(text, "$entries\n", vhdl_of_table(proof));
  const std::string declaration = read_declaration(folders, proof);
  text = with_dut(with_around(text, proof, declaration), proof, declaration);
  text = with_kept(with_ghosts(std::move(text), declaration));
  if (contains(text, " case "))
    throw Failure{bad_input(fmt::format(
        "tb/rtl/{}: GHDL drops what follows `when others`; write if and elsif instead of case", proof.unit))};
  Unit unit{.text = {}, .top = top_of(proof, text), .counts = {}};
  // GHDL takes the architecture that it analyses last.
  for (const std::string& contract : proof.contracts)
    unit.text += with_clock(with_kept(read_unit(folders, contract)));
  unit.text += with_clock(std::move(text));
  unit.counts = count_properties(unit.text);
  return unit;
}

// ---- The netlist

// Synthesizes the RTL with the unit to netlist.v.
void synthesize(const std::filesystem::path& folder, const Proof& proof, const std::vector<VhdlSource>& rtl,
                const Unit& unit) {
  std::vector<std::string> command = {"ghdl", "--synth", "--std=08", "--no-assert-cover", "--out=verilog"};
  for (const auto& [name, value] : proof.generics) command.push_back("-g" + name + '=' + value);
  for (const VhdlSource& source : rtl) {
    must(write_file(folder / source.name, source.content));
    command.push_back(source.name);
  }
  must(write_file(folder / "unit.psl", unit.text));
  command.insert(command.end(), {"unit.psl", "-e", unit.top});
  const ProcessEnd end = run(folder, command, folder / "netlist.v");
  if (!end.succeeded()) throw no_verdict(proof, "ghdl", end);
}

// Writes formal.v. All properties of the unit must be in it, and no others.
void write_formal_verilog(const std::filesystem::path& folder, const Proof& proof, const Unit& unit) {
  const auto formal = formal_verilog(must(read_file(folder / "netlist.v")), unit.top);
  if (!formal) throw Failure{tool_failed(fmt::format("{}: {}", proof.unit, formal.error().message))};
  if (formal->counts != unit.counts || unit.counts.asserts == 0)
    throw Failure{tool_failed(fmt::format(
        "{}: the unit has {} assertions and {} assumptions, but GHDL's netlist has {} and {}", proof.unit,
        unit.counts.asserts, unit.counts.assumes, formal->counts.asserts, formal->counts.assumes))};
  must(write_file(folder / "formal.v", formal->text));
}

// ---- Solvers

// ABC works bit by bit. It finds the refutation of a fault in seconds where cvc5 needs minutes, for any
// method that proves the property. It refuses a netlist without registers.
bool uses_abc(const Proof& proof, const Fault* fault) {
  return proof.method == Method::pdr || proof.method == Method::bounded_abc ||
         (fault != nullptr && proof.clocks > 1);
}

std::string yosys_script(const Proof& proof, const Fault* fault, std::string_view top) {
  const std::string prepare = fmt::format(
      "read_verilog -formal formal.v; prep -flatten -top {}; {}setundef -undriven -anyseq; opt -full; "
      "opt_clean -purge; async2sync; dffunmap; opt_clean; ",
      top, proof.any_products ? "cutpoint t:$mul; " : "");
  if (uses_abc(proof, fault))
    return prepare +
           "delete -output; techmap; opt -fast; memory_map; techmap; opt -full; dffunmap; abc -g AND -fast; "
           "opt_clean; write_aiger -I -B -zinit -no-startoffset model.aig";
  if (!formats_of(proof, fault).empty() || !proof.table.empty())
    return prepare + "memory_map; opt -full; dffunmap; opt_clean; write_smt2 -wires model.smt2";
  return prepare + "write_smt2 -wires model.smt2";
}

// `induction_step`: from any state; otherwise from reset.
Answer run_cvc5(const std::filesystem::path& folder, const Proof& proof, int clocks, bool induction_step) {
  std::vector<std::string> command = {"yosys-smtbmc", "-s", "cvc5",
                                      "--noprogress", "-t", std::to_string(clocks)};
  if (induction_step) command.push_back("-i");
  command.push_back("model.smt2");
  const ProcessEnd end = run(folder, command);
  if (end.timed_out) return {Verdict::open, c_timed_out};
  if (end.succeeded() && contains(end.output, "Status: PASSED")) return {Verdict::holds};
  const std::string reason = last_line_with(end.output, "Assert failed");
  if (end.exit_status != 1 || !contains(end.output, "Status: FAILED") || (reason.empty() && !induction_step))
    throw no_verdict(proof, "yosys-smtbmc", end);
  if (induction_step) return {Verdict::open, "the induction step fails: " + reason};
  return {Verdict::refuted, reason};
}

Answer run_abc(const std::filesystem::path& folder, const Proof& proof, const std::string& engine) {
  // Later versions of pdr and bmc3 decide nothing if Yosys has left no registers. sat does, and only then.
  const ProcessEnd end =
      run(folder, {"yosys-abc", "-c", "read_aiger model.aig; fold; strash; orpos; " + engine + "; sat"});
  if (end.timed_out) return {Verdict::open, c_timed_out};
  if (contains(end.output, "Property proved.") || contains(end.output, "No output asserted in"))
    return {Verdict::holds};
  if (contains(end.output, "was asserted in frame"))
    return {Verdict::refuted, last_line_with(end.output, "was asserted")};
  if (contains(end.output, "UNSATISFIABLE")) return {Verdict::holds};
  if (contains(end.output, "SATISFIABLE"))
    return {Verdict::refuted, last_line_with(end.output, "SATISFIABLE")};
  throw no_verdict(proof, "yosys-abc", end);
}

Answer solve(const std::filesystem::path& folder, const Proof& proof, const Fault* fault) {
  const int clocks = fault == nullptr ? proof.clocks : proof.fault_clocks;
  if (uses_abc(proof, fault)) {
    const bool unbounded = proof.method == Method::pdr && fault == nullptr;
    return run_abc(folder, proof, unbounded ? "pdr" : fmt::format("bmc3 -F {}", clocks));
  }
  const Answer from_reset = run_cvc5(folder, proof, clocks, false);
  const bool needs_step = proof.method == Method::induction && fault == nullptr;
  if (!needs_step || from_reset.verdict != Verdict::holds) return from_reset;
  return run_cvc5(folder, proof, clocks, true);
}

Answer prove_unit(const Folders& folders, const std::filesystem::path& folder, const Proof& proof,
                  const Fault* fault) {
  const Unit unit = make_unit(folders, proof);
  synthesize(folder, proof, read_rtl(folders, proof, fault), unit);
  write_formal_verilog(folder, proof, unit);
  const ProcessEnd end = run(folder, {"yosys", "-q", "-p", yosys_script(proof, fault, unit.top)});
  if (!end.succeeded()) throw no_verdict(proof, "yosys", end);
  return solve(folder, proof, fault);
}

// ---- Gappa

// Replaces `$name.bits` and `$name.fraction` by the numbers of preset exact, the first in the package.
std::string with_formats(std::string text, std::string_view package, const std::string& unit) {
  static const std::regex c_number(R"(\$(\w*)(\.bits|\.fraction)?)");
  for (std::smatch found; std::regex_search(text, found, c_number);) {
    const std::string name = found[1];
    const std::string_view format = between(package, fmt::format("    {} => (", name), ")");
    const std::size_t comma = format.find(", ");
    if (!found[2].matched || comma == std::string_view::npos)
      throw Failure{bad_input(fmt::format(
          "tb/rtl/{}: ${}: {}", unit, name,
          found[2].matched ? "formats_pkg has no such format" : "write .bits or .fraction after it"))};
    const bool is_fraction = found[2] == ".fraction";
    text.replace(static_cast<std::size_t>(found.position()), static_cast<std::size_t>(found.length()),
                 is_fraction ? format.substr(comma + 2) : format.substr(0, comma));
  }
  return text;
}

Answer prove_by_gappa(const Folders& folders, const std::filesystem::path& folder, const Proof& proof,
                      const Fault* fault) {
  std::vector<VhdlSource> rtl = read_rtl(folders, proof, fault);
  const VhdlSource* package = find_source(rtl, c_formats);
  if (package == nullptr)
    throw Failure{bad_input(fmt::format("{}: is not in rtl/files.f; add it", c_formats))};
  must(write_file(folder / "unit.gappa",
                  with_formats(read_unit(folders, proof.unit), package->content, proof.unit)));
  const ProcessEnd end = run(folder, {"gappa", "unit.gappa"});
  if (end.succeeded()) return {Verdict::holds};
  if (contains(end.output, "some enclosures were not satisfied") ||
      contains(end.output, "some properties were not satisfied"))
    return {Verdict::refuted, end.output};
  throw no_verdict(proof, "gappa", end);
}

}  // namespace

void find_tools() {
  for (const char* tool : {"ghdl", "yosys", "yosys-smtbmc", "yosys-abc", "cvc5", "gappa"})
    if (find_program(tool).empty())
      throw Failure{tool_failed(fmt::format("{}: is missing; install it with: {}", tool,
                                            std::string_view(tool) == "ghdl" ? c_install_ghdl : c_install))};
}

std::vector<VhdlSource> read_sources(const Folders& folders, const Proof& proof) {
  std::vector<VhdlSource> rtl = must(read_rtl_sources(folders.source));
  if (proof.entity.starts_with("board/"))
    std::ranges::move(must(read_rtl_sources(folders.source, "rtl/board")), std::back_inserter(rtl));
  return rtl;
}

std::string text_with_fault(const std::vector<VhdlSource>& rtl, const Fault& fault) {
  const auto source = std::ranges::find(rtl, "rtl/" + fault.file, &VhdlSource::name);
  if (source == rtl.end())
    throw Failure{bad_input(
        fmt::format("{}: rtl/{} is not in rtl/files.f; name a file that is", fault.where, fault.file))};
  const int count = count_of(source->content, fault.old_text);
  if (count != fault.occurrences)
    throw Failure{
        bad_input(fmt::format("{}: `{}` occurs {} times in rtl/{}, but must occur {}; correct the fault",
                              fault.where, fault.old_text, count, fault.file,
                              fault.occurrences == 1 ? "once" : fmt::format("{} times", fault.occurrences)))};
  std::string text = source->content;
  return text.replace(text.find(fault.old_text), fault.old_text.size(), fault.new_text);
}

Answer prove(const Folders& folders, const Proof& proof, const Fault* fault) {
  const TemporaryFolder scratch = must(TemporaryFolder::make(folders.scratch));
  return proof.method == Method::gappa ? prove_by_gappa(folders, scratch.path(), proof, fault)
                                       : prove_unit(folders, scratch.path(), proof, fault);
}

}  // namespace halfway::proofs
