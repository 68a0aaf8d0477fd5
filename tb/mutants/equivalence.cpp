// SPDX-License-Identifier: Apache-2.0
#include "equivalence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <regex>

#include "sim/system/subprocess.hpp"
#include "sim/verilator/netlist.hpp"

namespace halfway::mutants {
namespace {

constexpr const char* kInstall = "apt-get install yosys";
constexpr std::chrono::seconds c_time{60};
constexpr int c_levels = 2;  // of modules around the change

bool is_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

std::string without_comments(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    if (text.substr(i, 2) == "/*") {
      i = std::min(text.find("*/", i), text.size() - 2) + 2;
    } else if (text.substr(i, 2) == "//") {
      i = std::min(text.find('\n', i), text.size());
    } else {
      result.push_back(text[i++]);
    }
  }
  return result;
}

// n123_o is the first of its kind: n0_o.
std::string renumbered(std::string_view text) {
  std::map<std::string, std::string, std::less<>> numbers;
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    std::size_t end = i;
    while (end < text.size() && is_word(text[end])) ++end;
    if (end == i) {
      result.push_back(text[i++]);
      continue;
    }
    const std::string_view word = text.substr(i, end - i);
    const std::size_t digits = std::min(word.find_first_not_of("0123456789", 1), word.size());
    if (word.size() > 1 && word[0] == 'n' && digits > 1 && (digits == word.size() || word[digits] == '_')) {
      const auto number =
          numbers.try_emplace(std::string(word.substr(0, digits)), fmt::format("n{}", numbers.size()));
      result += number.first->second;
      result += word.substr(digits);
    } else {
      result += word;
    }
    i = end;
  }
  return result;
}

// The module and all that it is made of, each once.
void add_modules(const Netlist& netlist, const std::string& name, std::set<std::string>& done,
                 std::string& text) {
  const auto module = netlist.modules.find(name);
  if (module == netlist.modules.end() || !done.insert(name).second) return;
  for (const auto& [other, its_text] : netlist.modules)
    if (module->second.find("\n  " + other + " ") != std::string::npos)
      add_modules(netlist, other, done, text);
  text += module->second;
}

bool is_in(std::string_view text, std::string_view part) {
  return text.find(part) != std::string_view::npos;
}

// {0}: the file, {1}: the top, {2}: gold or gate
constexpr std::string_view kRead =
    "read_verilog {0}; prep -flatten -top {1}; expose -input w:*_read__; expose w:*_told__; opt_clean; "
    "rename {1} {2}; ";

}  // namespace

Netlist netlist_of(std::string_view verilog, const std::string& top) {
  Netlist netlist{top, {}};
  const std::string text = without_comments(verilog);
  for (std::size_t at = text.find("module "); at != std::string::npos;) {
    const std::size_t end = text.find("endmodule", at) + 9;
    const std::size_t name = at + 7;
    std::size_t name_end = name;
    while (is_word(text[name_end])) ++name_end;
    netlist.modules[text.substr(name, name_end - name)] = renumbered(text.substr(at, end - at)) + "\n";
    at = text.find("module ", end);
  }
  return netlist;
}

std::string with_open_memories(std::string_view verilog) {
  // Written once and read once a clock, as GHDL writes it. Kept: nothing reads what is told, until it is
  // exposed.
  static const std::regex memory(
      R"(  reg (\[\d+:0\] )?(\w+)\[\d+:0\] ;[^\n]*\n(?:  initial begin\n(?:    [^\n]*X;\n)*    end\n)?)"
      R"(  always @\(posedge clk\)\n    if \((\w+)\)\n      (\w+) <= (\w+)\[(\w+)\];\n)"
      R"(  always @\(posedge clk\)\n    if \((\w+)\)\n      (\w+)\[(\w+)\] <= ([^\n]*);\n)");
  std::string result;
  std::string text(verilog);
  std::smatch m;
  while (std::regex_search(text, m, memory)) {
    result += m.prefix();
    if (m[2] == m[5] && m[2] == m[8]) {
      result += fmt::format(
          "  wire {1}{0}_read__;\n  always @(posedge clk)\n    if ({2})\n      {3} <= {0}_read__;\n"
          "  (* keep *) wire {0}_reads_told__ = {2};\n  (* keep *) wire [31:0] {0}_from_told__ = {2} ? {4} : "
          "0;\n"
          "  (* keep *) wire {0}_writes_told__ = {5};\n  (* keep *) wire [31:0] {0}_to_told__ = {5} ? {6} : "
          "0;\n"
          "  (* keep *) wire {1}{0}_word_told__ = {5} ? {7} : 0;\n",
          m[2].str(), m[1].str(), m[3].str(), m[4].str(), m[6].str(), m[7].str(), m[9].str(), m[10].str());
    } else {
      result += m.str();
    }
    text = m.suffix();
  }
  return result + text;
}

Equivalence::Equivalence(const Judge& judge) : judge_(judge) {
  // What a scene may leave out, each with little else.
  for (const Preset preset : {Preset::exact, Preset::published}) {
    const bool exact = preset == Preset::exact;
    HardwareKey key{.shader = Shader::quadratic, .preset = preset, .spherical = {}, .processors = {}};
    for (const unsigned channels : {1U, 3U}) {
      key.channels = channels;
      keys_.push_back(key);
    }
    key.shader = Shader::spherical;
    for (const unsigned parts : {0U, 1U, 2U, 3U})
      for (const unsigned channels : {1U, 3U}) {
        key.channels = channels;
        key.spherical = {.lights = 2,
                         .diffuse = (parts & 1) != 0,
                         .specular = (parts & 2) != 0,
                         .highlight_channels = channels,
                         .powers = exact ? 19U : 2U,
                         .tables = exact ? TableSize{9, 8} : TableSize{4, 4}};
        keys_.push_back(key);
      }
    key.spherical = {};
    key.shader = Shader::processors;
    for (const ProcessorForm form : {ProcessorForm::folded, ProcessorForm::unrolled})
      for (const ProcessorUnits& units :
           {ProcessorUnits{}, ProcessorUnits{.directional = 1, .diffuse = true},
            ProcessorUnits{.positional = 1, .specular = true, .normalize = true},
            ProcessorUnits{.directional = 2, .specular = true},
            ProcessorUnits{.positional = 1, .diffuse = true, .normalize = true, .shadows = true},
            ProcessorUnits{.spots = 1, .diffuse = true},
            ProcessorUnits{.directional = 1,
            .positional = 1,
            .spots = 1,
            .diffuse = true,
            .specular = true,
            .normalize = true}}) {
        key.channels = units.lights() == 1 ? 1 : 3;
        key.processors = units;
        key.processors.form = form;
        keys_.push_back(key);
      }
  }
  for (const Test& frame : judge.frames())
    for (const bool probe : {false, true}) {
      keys_.push_back(frame.key);
      keys_.back().probe = probe;
    }
}

Result<Netlist> Equivalence::synthesize(const HardwareKey& key, const Exchanged& exchanged) const {
  auto folder = TemporaryFolder::make(judge_.folders().scratch / "benches");
  if (!folder) return folder.error();
  Command command{.arguments = {"ghdl", "--synth", "--std=08", "--no-formal", "--out=verilog"},
                  .working_folder = folder->path(),
                  .standard_output = folder->path() / "netlist.v",
                  .timeout = c_time};
  for (const auto& [name, value] : key.generics()) command.arguments.push_back("-g" + name + '=' + value);
  for (const VhdlSource& source : judge_.rtl()) {
    const bool other = source.name == "rtl/" + exchanged.file;
    if (auto written = write_file(folder->path() / source.name, other ? exchanged.content : source.content);
        !written)
      return written.error();
    command.arguments.push_back(source.name);
  }
  command.arguments.insert(command.arguments.end(), {"-e", key.entity()});
  const auto end = run_process(command, kInstallGhdl);
  if (!end) return end.error();
  if (!end->succeeded())
    return Error{ExitCode::differs, fmt::format("synthesis of {}: {}", key.name(), end->output)};
  const auto text = read_file(command.standard_output);
  if (!text) return text.error();
  const auto mended = mend_netlist(*text);
  if (!mended) return Error{ExitCode::differs, mended.error().message};
  return netlist_of(*mended, key.entity());
}

Result<bool> Equivalence::same(const Netlist& gold, const Netlist& gate, const std::string& module) {
  std::array<std::string, 2> texts;
  std::set<std::string> done[2];
  add_modules(gold, module, done[0], texts[0]);
  add_modules(gate, module, done[1], texts[1]);
  if (texts[0].empty() || texts[1].empty()) return false;
  const std::string key = ContentHash().add("miter 2").add(module).add(texts[0]).add(texts[1]).hex();
  if (const auto before = judge_.remembered().find(key)) return *before == "same";
  auto folder = TemporaryFolder::make(judge_.folders().scratch / "benches");
  if (!folder) return folder.error();
  const char* names[] = {"gold", "gate"};
  std::string script;
  for (int i = 0; i < 2; ++i) {
    if (auto written = write_file(folder->path() / fmt::format("{}.v", names[i]),
                                  with_open_memories(texts[static_cast<std::size_t>(i)]));
        !written)
      return written.error();
    script += fmt::format(kRead, fmt::format("{}.v", names[i]), module, names[i]);
    if (i == 0) script += "design -stash gold; ";
  }
  script +=
      "design -copy-from gold -as gold gold; miter -equiv -flatten gold gate miter; hierarchy -top miter; "
      "memory_map; "
      "setundef -undriven -zero; setundef -init -zero; opt -full; async2sync; techmap; opt -full; dffunmap; "
      "opt_clean; "
      "abc -g AND -fast; opt_clean; write_aiger -zinit miter.aig";
  const auto made = run_process(
      {.arguments = {"yosys", "-q", "-p", script}, .working_folder = folder->path(), .timeout = c_time},
      kInstall);
  if (!made) return made.error();
  bool proved = false;
  // Where the ports differ there is no miter, and nothing is proved.
  if (made->succeeded()) {
    const auto end = run_process({.arguments = {"yosys-abc", "-c", "read_aiger miter.aig; scorr; pdr -T 30"},
                                  .working_folder = folder->path(),
                                  .timeout = c_time},
                                 kInstall);
    if (!end) return end.error();
    proved = end->succeeded() && is_in(end->output, "Property proved.");
  }
  judge_.remembered().add(key, proved ? "same" : "open");
  return proved;
}

Result<bool> Equivalence::same_within(const Netlist& gold, const Netlist& gate) {
  std::set<std::string> differing;
  for (const auto& [name, text] : gate.modules)
    if (const auto own = gold.modules.find(name); own == gold.modules.end() || own->second != text)
      differing.insert(name);
  for (int level = 0; !differing.empty(); ++level) {
    std::set<std::string> around;
    for (const std::string& name : differing) {
      const auto answer = same(gold, gate, name);
      if (!answer) return answer.error();
      if (*answer) continue;
      if (name == gate.top || level == c_levels) return false;
      // What holds it: a module that its inputs do not all come to.
      for (const auto& [other, text] : gate.modules)
        if (text.find("\n  " + name + " ") != std::string::npos) around.insert(other);
    }
    differing = around;
  }
  return true;
}

Result<bool> Equivalence::proved(const Exchanged& exchanged) {
  bool any = false;
  for (const HardwareKey& key : keys_) {
    const bool used = std::any_of(judge_.frames().begin(), judge_.frames().end(), [&](const Test& frame) {
      return frame.key.shader == key.shader && frame.uses.contains(exchanged.file);
    });
    if (!used) continue;
    any = true;
    Netlist gold;
    {
      const std::lock_guard lock(mutex_);
      const std::string name = key.name();
      auto at = gold_.find(name);
      if (at == gold_.end()) {
        auto made = synthesize(key, {});
        if (!made) return tool_failed(made.error().message);
        at = gold_.emplace(name, std::move(*made)).first;
      }
      gold = at->second;
    }
    const auto gate = synthesize(key, exchanged);
    if (!gate && gate.error().code == ExitCode::differs) return false;
    if (!gate) return gate.error();
    const auto answer = same_within(gold, *gate);
    if (!answer || !*answer) return answer;
  }
  return any;
}

}  // namespace halfway::mutants
