// SPDX-License-Identifier: Apache-2.0
// The RTL does not use the constructs that GHDL 2.0.0 miscompiles and that are visible in its text:
// shift_right and shift operators of a signed, division, mod, rem, abs, minimum, maximum. It uses no reserved
// word of Verilog as a name.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "sim/system/file.hpp"

namespace halfway {
namespace {

bool is_word(char c) {
  return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
}

/// The line in lower case, without comments, strings and character literals.
std::string code_of(std::string_view line) {
  std::string code;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '-' && i + 1 < line.size() && line[i + 1] == '-') break;
    if (line[i] == '\'' && i + 2 < line.size() && line[i + 2] == '\'') {
      i += 2;
      continue;
    }
    if (line[i] == '"') {
      i = std::min(line.find('"', i + 1), line.size());
      code += ' ';
      continue;
    }
    code += static_cast<char>(line[i] >= 'A' && line[i] <= 'Z' ? line[i] - 'A' + 'a' : line[i]);
  }
  return code;
}

bool has_word(std::string_view code, std::string_view word) {
  for (std::size_t at = code.find(word); at != std::string_view::npos; at = code.find(word, at + 1)) {
    const bool begins = at == 0 || !is_word(code[at - 1]);
    const bool ends = at + word.size() == code.size() || !is_word(code[at + word.size()]);
    if (begins && ends) return true;
  }
  return false;
}

/// All constructs are allowed above the architecture and inside a package: GHDL folds these constants, and
/// they are not hardware. Other lines that are not hardware are marked with `-- evaluated at elaboration`.
constexpr std::string_view c_elaboration_only = "-- evaluated at elaboration";
/// Comments that make a synthesizer skip text. GHDL simulates exactly the text that is synthesized.
constexpr std::array<std::string_view, 3> c_directives = {"translate_off", "synthesis_off", "pragma"};

std::vector<std::string> faults_in(const std::string& name, std::string_view text) {
  // Reserved in Verilog or SystemVerilog, but not in VHDL. GHDL writes them unchanged.
  constexpr std::array<std::string_view, 96> c_verilog_words = {
      "always",   "and2",    "assume",   "automatic", "bind",    "bins",      "bit_",     "bufif0",
      "byte",     "casex",   "casez",    "cell",      "chandle", "checker",   "class",    "clocking",
      "cmos",     "config",  "const",    "cover",     "cross",   "deassign",  "defparam", "design",
      "disable",  "dist",    "do",       "edge",      "endcase", "enum",      "event",    "expect",
      "export",   "extends", "extern",   "final",     "force",   "forever",   "fork",     "genvar",
      "global",   "include", "initial",  "input",     "inside",  "instance",  "int",      "interface",
      "join",     "large",   "let",      "liblist",   "local",   "logic",     "longint",  "matches",
      "medium",   "modport", "module",   "negedge",   "output",  "parameter", "posedge",  "primitive",
      "priority", "program", "pulldown", "rand",      "real",    "ref",       "reg",      "release",
      "repeat",   "small",   "soft",     "solve",     "specify", "static",    "string",   "strong",
      "struct",   "super",   "table",    "task",      "this",    "tran",      "tri",      "union",
      "unique",   "var",     "virtual",  "void",      "weak",    "wildcard",  "wire",     "within"};
  std::vector<std::string> faults;
  std::size_t number = 0;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    ++number;
    const auto fault = [&](std::string_view what) {
      faults.push_back(fmt::format("{}:{}: {}", name, number, what));
    };
    for (const std::string_view directive : c_directives)
      if (line.find(directive) != std::string_view::npos)
        fault(fmt::format("{}: write one text for simulation and synthesis", directive));
    const std::string code = code_of(line);
    if (line.find(c_elaboration_only) == std::string_view::npos) {
      if (has_word(code, "shift_right") && code.find("shift_right(unsigned(") == std::string::npos) {
        fault("shift_right: concatenate the sign's bits and a slice");
      }
      for (const std::string_view word : {"sra", "srl", "abs", "minimum", "maximum", "mod", "rem"}) {
        if (has_word(code, word)) fault(fmt::format("{}: GHDL's netlist is wrong; write it out", word));
      }
      for (std::size_t at = code.find('/'); at != std::string::npos; at = code.find('/', at + 1)) {
        if (at + 1 < code.size() && code[at + 1] == '=') continue;
        fault("division: GHDL prints a signed one as unsigned");
      }
    }
    // A declaration names hardware: signal, port, entity, instance, record field.
    const std::size_t colon = code.find(':');
    // Functions and their parameters have no names in the netlist.
    if (colon != std::string::npos && code.substr(colon, 2) != ":=" && !has_word(code, "function")) {
      std::string_view names = std::string_view(code).substr(0, colon);
      for (const std::string_view word : c_verilog_words) {
        if (has_word(names, word)) fault(fmt::format("{}: a word of Verilog's as a name", word));
      }
    }
  }
  return faults;
}

TEST(RtlLint, RtlKeepsOffWhatIsMiscompiled) {
  std::size_t files = 0;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(std::filesystem::path(HALFWAY_SOURCE_DIR) / "rtl")) {
    if (entry.path().extension() != ".vhd") continue;
    ++files;
    const auto text = read_file(entry.path());
    ASSERT_TRUE(text) << text.error().message;
    const auto name = std::filesystem::relative(entry.path(), HALFWAY_SOURCE_DIR).string();
    for (const std::string& fault : faults_in(name, *text)) ADD_FAILURE() << fault;
  }
  EXPECT_GE(files, 5U);
}

TEST(RtlLint, SeesEachFault) {
  const std::vector<std::string> bad = {"  x <= shift_right(signed(y), 3);",
                                        "  x <= Shift_Right (a, 3);",
                                        "  x <= a / b;",
                                        "  x <= abs a;",
                                        "  x <= ABS(a);",
                                        "  x <= minimum(a, b);",
                                        "  x <= a mod 8;",
                                        "  x <= maximum(a, b);",
                                        "  signal edge : std_logic;",
                                        "  tri, a : in std_logic;",
                                        "  x <= a sra 2;",
                                        "  x <= a rem 3; -- 7/8",
                                        "  do : entity work.thing",
                                        "  table : if g_exact generate",
                                        "  -- synthesis translate_off",
                                        "  -- pragma synthesis_on"};
  for (const std::string& line : bad) EXPECT_EQ(faults_in("x.vhd", line).size(), 1U) << line;
  const std::vector<std::string> good = {"  x <= a; -- a/b, abs, mod",
                                         "  if a /= b then",
                                         "  report \"a / b mod abs\";",
                                         "  x <= absolute;",
                                         "  signal edge_x : t;",
                                         "  constant c : natural := n / 2; -- evaluated at elaboration",
                                         "  x <= '/';",
                                         "  x <= shift_right(unsigned(y), 3);"};
  for (const std::string& line : good) EXPECT_EQ(faults_in("x.vhd", line).size(), 0U) << line;
}

}  // namespace
}  // namespace halfway
