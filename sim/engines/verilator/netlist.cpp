// SPDX-License-Identifier: Apache-2.0
#include "sim/engines/verilator/netlist.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace halfway {
namespace {

std::string_view trim(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

/// The line without comments `/* ... */` and `// ...`; GHDL keeps a comment on one line.
std::string without_comments(std::string_view line) {
  std::string code(line);
  for (std::size_t at; (at = code.find("/*")) != std::string::npos;) {
    const std::size_t end = code.find("*/", at + 2);
    code.erase(at, end == std::string::npos ? std::string::npos : end + 2 - at);
  }
  return code.substr(0, code.find("//"));
}

Error refuse(std::size_t line_number, std::string_view line, std::string_view what) {
  return tool_failed(
      fmt::format("netlist.v:{}: {}; write the RTL without it: {}", line_number, what, trim(line)));
}

// Faults of GHDL that are visible in the text. The first two are repaired, the others are refused.

/// True for a text of Verilog itself: the value of an attribute, or of a vendor's parameter.
bool is_text(std::string_view code, std::size_t open) {
  static const std::regex c_before_text(R"(\(\* \w+=$|\.\w+\($)");
  const std::string_view before = code.substr(0, open);
  return std::regex_search(before.begin(), before.end(), c_before_text);
}

/// GHDL 2 prints a constant of more than 32 bits as a quoted string of its digits, which Verilog reads as
/// characters: make it a binary number. False if the string holds anything else and is no text.
bool mend_constants(std::string& code) {
  std::size_t open = 0;
  while ((open = code.find('"', open)) != std::string::npos) {
    const std::size_t close = code.find('"', open + 1);
    if (close == std::string::npos || close == open + 1) return false;
    std::string digits = code.substr(open + 1, close - open - 1);
    bool is_number = true;
    for (char& digit : digits) {
      if (std::string_view("UXWZ-").find(digit) != std::string_view::npos) digit = 'x';
      is_number = is_number && (digit == '0' || digit == '1' || digit == 'x');
    }
    if (is_number)
      code.replace(open, close + 1 - open, fmt::format("{}'b{}", digits.size(), digits));
    else if (is_text(code, open))
      open = close + 1;
    else
      return false;
  }
  return true;
}

/// GHDL prints bits without a driver as high impedance, which makes Verilator look for a tristate bus: make
/// them unknown.
void mend_undriven_bits(std::string& code) {
  for (std::size_t at = 0; (at = code.find("'bZ", at)) != std::string::npos; ++at) code[at + 2] = 'x';
}

/// GHDL names the operation in a comment, but version 2 prints the operands without $signed. No version
/// prints `mod` of signed numbers: the operator of Verilog is `rem`.
bool is_wrong_division(std::string_view line) {
  if (line.find("// smod") != std::string_view::npos) return true;
  const bool divides =
      line.find("// sdiv") != std::string_view::npos || line.find("// srem") != std::string_view::npos;
  return divides && line.find("$signed(") == std::string_view::npos;
}

/// GHDL prints `>>`, which shifts zeros in, where `>>>` would repeat the sign.
bool is_signed_right_shift(std::string_view code) {
  const std::size_t at = code.find(" >> ");
  return at != std::string_view::npos && code.find("$signed(") < at;
}

/// GHDL prints abs, minimum, maximum and some assignments in VHDL.
bool is_vhdl(std::string_view text, bool in_always) {
  for (const std::string_view vhdl : {"std_logic_vector", " when ", " abs ", "(abs ", "unsigned'", "signed'"})
    if (text.find(vhdl) != std::string_view::npos) return true;
  return text.find(" <= ") != std::string_view::npos && !in_always && !text.starts_with("assign ");
}

/// An `always` without `begin` holds one statement, which may be a case: only a declaration ends it for sure.
bool ends_always(std::string_view text) {
  return text.starts_with("assign") || text.starts_with("wire") || text.starts_with("endmodule");
}

}  // namespace

std::vector<ModulePort> ports_of(std::string_view netlist, std::string_view top) {
  static const std::regex c_port(R"((input|output) +(?:\[(\d+):0\] *)?(\w+))");
  const std::size_t begin = netlist.find(fmt::format("module {}\n", top));
  if (begin == std::string_view::npos) return {};
  const std::string head(netlist.substr(begin, netlist.find(';', begin) - begin));
  std::vector<ModulePort> ports;
  for (std::sregex_iterator at(head.begin(), head.end(), c_port), last; at != last; ++at)
    ports.push_back({(*at)[3], (*at)[1] == "output",
                     (*at)[2].matched ? static_cast<unsigned>(std::stoul((*at)[2])) + 1 : 1U});
  return ports;
}

unsigned port_bits(std::string_view netlist, std::string_view top, std::string_view port) {
  const std::vector<ModulePort> ports = ports_of(netlist, top);
  const auto found = std::ranges::find(ports, port, &ModulePort::name);
  return found == ports.end() ? 0 : found->bits;
}

Result<std::string> mend_netlist(std::string_view netlist) {
  std::string mended;
  mended.reserve(netlist.size());
  std::size_t number = 0;
  bool in_always = false;
  std::istringstream lines{std::string(netlist)};
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (is_wrong_division(line)) return refuse(number, line, "a signed division, printed wrongly");
    std::string code = without_comments(line);
    if (!mend_constants(code)) return refuse(number, line, "a quoted string");
    mend_undriven_bits(code);
    if (is_signed_right_shift(code))
      return refuse(number, line, "shift_right of a signed, printed as a logical shift");
    const std::string_view text = trim(code);
    if (text.empty()) continue;
    if (text.starts_with("always")) in_always = true;
    if (is_vhdl(text, in_always)) return refuse(number, line, "VHDL text");
    if (ends_always(text)) in_always = false;
    (mended += code) += '\n';
  }
  return mended;
}

}  // namespace halfway
