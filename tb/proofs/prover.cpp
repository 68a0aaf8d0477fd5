// SPDX-License-Identifier: Apache-2.0
#include "prover.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "sim/ghdl/ghdl_library.hpp"
#include "sim/system/file.hpp"
#include "sim/system/subprocess.hpp"
#include "tables/formats.hpp"

namespace halfway::proofs {
namespace {

constexpr const char* kInstall = "apt-get install yosys cvc5 gappa";
constexpr std::chrono::minutes kTimeout{10};
constexpr const char* kFormats = "rtl/tables/formats_pkg.vhd";

bool is_in(std::string_view text, std::string_view part) {
  return text.find(part) != std::string_view::npos;
}

Result<ProcessEnd> run(const std::filesystem::path& folder, std::vector<std::string> arguments,
                       const std::filesystem::path& standard_output = {}) {
  return run_process({.arguments = std::move(arguments),
                      .working_folder = folder,
                      .standard_output = standard_output,
                      .timeout = kTimeout},
                     kInstall);
}

Error failed(const Proof& proof, std::string_view tool, const ProcessEnd& end) {
  constexpr std::size_t kMost = 1000;  // characters: the first message, not all that follow from it
  return tool_failed(fmt::format("{}: {} came to no verdict ({}):\n{}", proof.unit, tool, end.how(),
                                 end.output.substr(0, std::min(end.output.find("\n\n"), kMost))));
}

std::vector<tables::PresetFormats> narrowed(const std::vector<Width>& widths) {
  auto presets = tables::preset_formats();
  for (tables::PresetFormats& preset : presets) {
    for (tables::Format& format : preset.formats) {
      const auto width =
          std::find_if(widths.begin(), widths.end(), [&](const Width& w) { return w.format == format.name; });
      if (width == widths.end()) continue;
      format.integer_bits = width->integer_bits;
      format.fraction_bits = width->fraction_bits;
    }
  }
  return presets;
}

bool is_narrow(const Proof& proof, const Fault* fault) {
  return !proof.widths.empty() && (fault != nullptr || !proof.full_width);
}

Result<std::vector<VhdlSource>> sources_of(const Folders& folders, const Proof& proof, const Fault* fault) {
  auto sources = read_rtl_sources(folders.source);
  if (!sources) return sources.error();
  bool found = fault == nullptr;
  for (VhdlSource& source : *sources) {
    if (is_narrow(proof, fault) && source.name == kFormats)
      source.content = tables::vhdl_package(narrowed(proof.widths));
    if (fault == nullptr || source.name != std::string("rtl/") + fault->file) continue;
    const std::size_t at = source.content.find(fault->from);
    // Of the formats that both presets have, preset exact's stands first.
    if (at == std::string::npos ||
        (source.name != kFormats && source.content.find(fault->from, at + 1) != std::string::npos))
      return bad_input(
          fmt::format("{}: `{}` does not occur once; mend the list of proofs", source.name, fault->from));
    source.content.replace(at, fault->from.size(), fault->to);
    found = true;
  }
  if (!found)
    return bad_input(fmt::format("rtl/{}: is not in files.f; mend the list of proofs", fault->file));
  return sources;
}

std::string_view trimmed(std::string_view line) {
  const std::size_t begin = line.find_first_not_of(' ');
  return begin == std::string_view::npos ? std::string_view() : line.substr(begin);
}

std::string_view between(std::string_view text, std::string_view before, std::string_view after) {
  const std::size_t at = text.find(before);
  if (at == std::string_view::npos) return {};
  text.remove_prefix(at + before.size());
  const std::size_t end = text.find(after);
  return end == std::string_view::npos ? std::string_view() : text.substr(0, end);
}

// GHDL writes what is asserted as $fatal, and what is assumed in VHDL; Yosys wants assert and assume.
//   always @*                                    always @* x: assert (n1_o);
//     if (!n1_o)
//       $fatal(1, "assertion failure x");
//   x: assert n1_o = '1' severity warning; --  assume       always @* x: assume (n1_o);
struct Formal {
  std::string verilog;
  int asserts = 0, assumes = 0;
};

Formal formal(std::string_view netlist) {
  std::vector<std::string_view> lines;
  for (std::size_t begin = 0; begin < netlist.size();) {
    const std::size_t end = std::min(netlist.find('\n', begin), netlist.size());
    lines.push_back(netlist.substr(begin, end - begin));
    begin = end + 1;
  }
  Formal result;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (i + 2 < lines.size() && is_in(lines[i + 2], "$fatal(") && trimmed(lines[i]) == "always @*") {
      result.verilog += fmt::format("  always @* {}: assert ({});\n", between(lines[i + 2], "failure ", "\""),
                                    between(lines[i + 1], "if (!", ")"));
      ++result.asserts;
      i += 2;
    } else if (is_in(lines[i], "'bX; // (signal)")) {
      // A signal of the unit without a driver: one that is anything, and the same wherever it is read.
    } else if (lines[i].ends_with("--  assume")) {
      const std::string_view label = between(lines[i], "  ", ":");
      result.verilog +=
          fmt::format("  always @* {}: assume ({});\n", label, between(lines[i], "assert ", " ="));
      ++result.assumes;
    } else {
      result.verilog.append(lines[i]).push_back('\n');
    }
  }
  return result;
}

// A constant of more than 32 bits comes out as a string of digits: "01" for 2'b01.
// One below zero comes out with zeros for its sign: that one is refused.
Result<std::string> with_constants(std::string_view verilog) {
  std::string result;
  while (!verilog.empty()) {
    const std::size_t open = verilog.find('"');
    const std::size_t close = open == std::string_view::npos ? open : verilog.find('"', open + 1);
    if (close == std::string_view::npos) break;
    const std::string_view digits = verilog.substr(open + 1, close - open - 1);
    if (digits.size() > 32 && digits.find('1') == digits.size() - 32)
      return tool_failed(fmt::format("{}: GHDL has lost the sign of a constant; write it positive", digits));
    result.append(verilog.substr(0, open));
    result += digits.find_first_not_of("01") == std::string_view::npos && !digits.empty()
                  ? fmt::format("{}'b{}", digits.size(), digits)
                  : fmt::format("\"{}\"", digits);
    verilog.remove_prefix(close + 1);
  }
  result.append(verilog);
  return result;
}

// How often `word` stands in the unit, in front of a space, outside comments.
int count_of(std::string_view unit, std::string_view word) {
  int count = 0;
  for (std::size_t begin = 0; begin < unit.size();) {
    const std::size_t end = std::min(unit.find('\n', begin), unit.size());
    std::string_view line = unit.substr(begin, end - begin);
    line = line.substr(0, line.find("--"));
    if (is_in(line, fmt::format(" : {} ", word))) ++count;
    begin = end + 1;
  }
  return count;
}

constexpr std::string_view kPrepared =
    "read_verilog -formal formal.v; prep -flatten -top {0}; {1}setundef -undriven -anyseq; opt -full; {2}"
    "opt_clean -purge; async2sync; dffunmap; opt_clean; ";

// A unit is bound to its entity, or an entity around it.
std::string top_of(const Proof& proof, std::string_view unit) {
  const std::string entity = std::filesystem::path(proof.entity).filename();
  return is_in(unit, "\nentity ") ? entity + "_proof" : entity;
}

// Declarations and statements of a process that gives `entry` of `address`: a constant for each bit of the
// entries.
std::string vhdl_of_entries(const Proof& proof) {
  std::string constants, assignments;
  for (int bit = 0; bit < proof.entry_bits; ++bit) {
    std::string word;
    for (const std::uint64_t entry : proof.entries)
      word.insert(word.begin(), (entry >> bit & 1) != 0 ? '1' : '0');
    constants += fmt::format("    constant c_{} : std_logic_vector({} downto 0) := \"{}\";\n", bit,
                             proof.entries.size() - 1, word);
    assignments += fmt::format("    entry({0}) <= c_{0}(to_integer(unsigned(address)));\n", bit);
  }
  return fmt::format("{}  begin\n{}", constants, assignments);
}

// Its result is the netlist's top.
Result<std::string> make_netlist(const Folders& folders, const std::filesystem::path& folder,
                                 const Proof& proof, const Fault* fault) {
  const auto sources = sources_of(folders, proof, fault);
  if (!sources) return sources.error();
  auto unit = read_file(folders.source / "tb/proofs" / proof.unit);
  if (!unit) return tool_failed(unit.error().message);
  // An architecture that is analysed last is the one that is taken.
  std::string contracts;
  for (const char* contract : proof.contracts) {
    const auto text = read_file(folders.source / "tb/proofs" / contract);
    if (!text) return tool_failed(text.error().message);
    contracts += *text;
  }
  if (const std::size_t at = unit->find("\n$entries\n"); at != std::string::npos)
    unit->replace(at + 1, std::string_view("$entries\n").size(), vhdl_of_entries(proof));
  // GHDL drops what stands under `when others`.
  if (is_in(*unit, " case ")) return bad_input(fmt::format("{}: a case; write if and elsif", proof.unit));
  std::vector<std::string> command = {"ghdl", "--synth", "--std=08", "--no-assert-cover", "--out=verilog"};
  for (const auto& [name, value] : proof.generics) command.push_back("-g" + name + '=' + value);
  for (const VhdlSource& source : *sources) {
    if (auto written = write_file(folder / source.name, source.content); !written) return written.error();
    command.push_back(source.name);
  }
  const std::string top = top_of(proof, *unit);
  unit->insert(0, contracts);
  if (auto written = write_file(folder / "unit.psl", *unit); !written) return written.error();
  command.insert(command.end(), {"unit.psl", "-e", top});
  const auto synthesized = run(folder, command, folder / "netlist.v");
  if (!synthesized) return synthesized.error();
  if (!synthesized->succeeded()) return failed(proof, "ghdl", *synthesized);
  const auto netlist = read_file(folder / "netlist.v");
  if (!netlist) return netlist.error();

  // The RTL's own assertions are of constants, and are gone. What the unit says must all have come through.
  const Formal prepared = formal(*netlist);
  const int asserts = count_of(*unit, "assert"), assumes = count_of(*unit, "assume");
  if (prepared.asserts != asserts || prepared.assumes != assumes || asserts == 0 ||
      is_in(prepared.verilog, "$fatal"))
    return tool_failed(fmt::format("{}: of {} assertions and {} assumptions {} and {} came out of GHDL",
                                   proof.unit, asserts, assumes, prepared.asserts, prepared.assumes));
  const auto verilog = with_constants(prepared.verilog);
  if (!verilog) return verilog.error();
  if (auto written = write_file(folder / "formal.v", *verilog); !written) return written.error();
  return top;
}

std::string last_line_with(std::string_view text, std::string_view part) {
  const std::size_t at = text.rfind(part);
  return at == std::string_view::npos ? std::string()
                                      : std::string(text.substr(at, text.find('\n', at) - at));
}

Result<Answer> by_solver(const std::filesystem::path& folder, const Proof& proof, int depth, bool step) {
  std::vector<std::string> command = {"yosys-smtbmc", "-s", "cvc5",
                                      "--noprogress", "-t", std::to_string(depth)};
  if (step) command.push_back("-i");
  command.push_back("model.smt2");
  const auto end = run(folder, command);
  if (!end) return end.error();
  if (end->timed_out) return Answer{Verdict::open, "no answer within 10 minutes"};
  if (end->succeeded() && is_in(end->output, "Status: PASSED")) return Answer{Verdict::holds, ""};
  if (end->exit_status == 1 && is_in(end->output, "Status: FAILED") &&
      (step || is_in(end->output, "Assert failed")))
    return Answer{step ? Verdict::open : Verdict::refuted,
                  (step ? "the induction step fails: " : "") + last_line_with(end->output, "Assert failed")};
  return failed(proof, "yosys-smtbmc", *end);
}

// `depth` of 0: over all clocks; else no way to break it in so many is as good.
Result<Answer> by_abc(const std::filesystem::path& folder, const Proof& proof, int depth) {
  const auto end = run(folder, {"yosys-abc", "-c",
                                fmt::format("read_aiger model.aig; fold; strash; orpos; {}",
                                            depth == 0 ? "pdr" : fmt::format("bmc3 -F {}", depth))});
  if (!end) return end.error();
  if (end->timed_out) return Answer{Verdict::open, "no answer within 10 minutes"};
  if (is_in(end->output, "Property proved.") || is_in(end->output, "No output asserted in"))
    return Answer{Verdict::holds, ""};
  if (is_in(end->output, "was asserted in frame"))
    return Answer{Verdict::refuted, last_line_with(end->output, "was asserted")};
  return failed(proof, "yosys-abc", *end);
}

// `$name.bits` and `$name.fraction`: of preset exact, from the VHDL as it stands there.
Result<std::string> with_formats(std::string text, std::string_view vhdl) {
  for (std::size_t at; (at = text.find('$')) != std::string::npos;) {
    std::size_t dot = at + 1;
    while (dot < text.size() &&
           (std::isalnum(static_cast<unsigned char>(text[dot])) != 0 || text[dot] == '_'))
      ++dot;
    const std::string name = text.substr(at + 1, dot - at - 1);
    const bool fraction = text.compare(dot, 9, ".fraction") == 0;
    if (!fraction && text.compare(dot, 5, ".bits") != 0)
      return bad_input(fmt::format("${}: neither .bits nor .fraction follows", name));
    const std::string_view format = between(vhdl, fmt::format("    {} => (", name), ")");
    const std::size_t comma = format.find(", ");
    if (comma == std::string_view::npos) return bad_input(fmt::format("{}: no such format", name));
    text.replace(at, dot - at + (fraction ? 9 : 5),
                 fraction ? format.substr(comma + 2) : format.substr(0, comma));
  }
  return text;
}

Result<Answer> by_gappa(const Folders& folders, const std::filesystem::path& folder, const Proof& proof,
                        const Fault* fault) {
  const auto sources = sources_of(folders, proof, fault);
  if (!sources) return sources.error();
  const auto unit = read_file(folders.source / "tb/proofs" / proof.unit);
  if (!unit) return tool_failed(unit.error().message);
  const auto formats = std::find_if(sources->begin(), sources->end(),
                                    [](const VhdlSource& source) { return source.name == kFormats; });
  const auto text = with_formats(*unit, formats->content);
  if (!text) return text.error();
  if (auto written = write_file(folder / "unit.gappa", *text); !written) return written.error();
  const auto end = run(folder, {"gappa", "unit.gappa"});
  if (!end) return end.error();
  if (end->succeeded()) return Answer{Verdict::holds, ""};
  if (is_in(end->output, "some enclosures were not satisfied") ||
      is_in(end->output, "some properties were not satisfied"))
    return Answer{Verdict::refuted, end->output};
  return failed(proof, "gappa", *end);
}

}  // namespace

Status find_tools() {
  for (const char* tool : {"ghdl", "yosys", "yosys-smtbmc", "yosys-abc", "cvc5", "gappa"}) {
    if (!find_program(tool).empty()) continue;
    return tool_failed(fmt::format("{}: is missing; install it with: {}", tool,
                                   std::string_view(tool) == "ghdl" ? kInstallGhdl : kInstall));
  }
  return Ok{};
}

Result<Answer> prove(const Folders& folders, const Proof& proof, const Fault* fault) {
  auto scratch = TemporaryFolder::make(folders.scratch);
  if (!scratch) return scratch.error();
  const std::filesystem::path& folder = scratch->path();
  if (proof.method == Method::gappa) return by_gappa(folders, folder, proof, fault);
  const auto top = make_netlist(folders, folder, proof, fault);
  if (!top) return top.error();

  // A fault is refuted by clocks that show it, whatever proves that there are none without it: bit by bit
  // they are found in seconds, by cvc5 in minutes; but ABC takes nothing that has no register.
  const bool bits = proof.method == Method::pdr || proof.method == Method::unrolled ||
                    (fault != nullptr && proof.depth > 1);
  std::string script = fmt::format(kPrepared, *top, proof.any_products ? "cutpoint t:$mul; " : "",
                                   proof.bit_registers ? "simplemap t:$dff r:WIDTH<8 %i; opt -full; " : "");
  script +=
      bits
          ? "delete -output; techmap; opt -fast; memory_map; techmap; opt -full; dffunmap; abc -g AND -fast; "
            "opt_clean; write_aiger -I -B -zinit -no-startoffset model.aig"
      : is_narrow(proof, fault) || !proof.entries.empty()
          ? "memory_map; opt -full; dffunmap; opt_clean; write_smt2 -wires model.smt2"
          : "write_smt2 -wires model.smt2";
  const auto prepared = run(folder, {"yosys", "-q", "-p", script});
  if (!prepared) return prepared.error();
  if (!prepared->succeeded()) return failed(proof, "yosys", *prepared);
  const int fault_depth = std::max(proof.depth, proof.fault_depth);
  if (bits)
    return by_abc(folder, proof,
                  fault != nullptr              ? fault_depth
                  : proof.method == Method::pdr ? 0
                                                : proof.depth);
  const auto first = by_solver(folder, proof, fault == nullptr ? proof.depth : fault_depth, false);
  if (!first || first->verdict != Verdict::holds || fault != nullptr || proof.method == Method::bounded)
    return first;
  return by_solver(folder, proof, proof.depth, true);
}

}  // namespace halfway::proofs
