// SPDX-License-Identifier: Apache-2.0
// The RTL does not use the constructs that GHDL 2.0.0 miscompiles and that are visible in its text:
// shift_right and shift operators of a signed, division, mod, rem, abs, minimum, maximum. It uses no reserved
// word of Verilog as a name.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "sim/os/file.hpp"

namespace halfway {
namespace {

/// The line in lower case, without comments, strings and character literals.
std::string code_of(const std::string& line) {
  static const std::regex c_no_code("--.*|'.'|\"[^\"]*\"?");
  std::string code = std::regex_replace(line, c_no_code, " ");
  std::ranges::transform(code, code.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return code;
}

/// Call `found` with each whole word of the code that is in the list.
template <class Found>
void find_words(const std::string& code, const std::set<std::string>& words, const Found& found) {
  static const std::regex c_word("[a-z0-9_]+");
  for (std::sregex_iterator at(code.begin(), code.end(), c_word), end; at != end; ++at)
    if (words.contains(at->str())) found(at->str());
}

/// All constructs are allowed above the architecture and inside a package: GHDL folds these constants, and
/// they are not hardware. Other lines that are not hardware are marked with `-- evaluated at elaboration`.
constexpr std::string_view c_elaboration_only = "-- evaluated at elaboration";
/// Comments that make a synthesizer skip text. GHDL simulates exactly the text that is synthesized.
constexpr std::array<std::string_view, 3> c_directives = {"translate_off", "synthesis_off", "pragma"};

std::vector<std::string> faults_in(const std::string& name, const std::string& text) {
  static const std::set<std::string> c_miscompiled = {"sra",     "srl", "abs", "minimum",
                                                      "maximum", "mod", "rem"};
  // Reserved in Verilog or SystemVerilog, but not in VHDL. GHDL writes them unchanged.
  static const std::set<std::string> c_verilog_words = {
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
  std::istringstream lines(text);
  std::string line;
  for (std::size_t number = 1; std::getline(lines, line); ++number) {
    const auto fault = [&](std::string_view what) {
      faults.push_back(fmt::format("{}:{}: {}", name, number, what));
    };
    for (const std::string_view directive : c_directives)
      if (line.find(directive) != std::string::npos)
        fault(fmt::format("{}: write one text for simulation and synthesis", directive));
    const std::string code = code_of(line);
    if (line.find(c_elaboration_only) == std::string::npos) {
      static const std::regex c_shift(R"(\bshift_right\b(?!\(unsigned\())"), c_division("/(?!=)");
      if (std::regex_search(code, c_shift)) fault("shift_right: concatenate the sign's bits and a slice");
      if (std::regex_search(code, c_division)) fault("division: GHDL prints a signed one as unsigned");
      find_words(code, c_miscompiled, [&](const std::string& word) {
        fault(fmt::format("{}: GHDL's netlist is wrong; write it out", word));
      });
    }
    // A declaration names hardware: signal, port, entity, instance, record field. Functions and their
    // parameters have no names in the netlist.
    static const std::regex c_declaration("^([^:]*):(?!=)");
    std::smatch declaration;
    if (std::regex_search(code, declaration, c_declaration) && code.find("function") == std::string::npos)
      find_words(declaration[1], c_verilog_words, [&](const std::string& word) {
        fault(fmt::format("{}: a word of Verilog's as a name", word));
      });
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
