// SPDX-License-Identifier: Apache-2.0
#include "sim/ghdl/rtl_hash.hpp"

#include <algorithm>
#include <cctype>

#include "sim/ghdl/ghdl_library.hpp"
#include "sim/system/file.hpp"

namespace halfway {

std::string bare_vhdl(std::string_view text) {
  std::string bare;
  bool in_string = false;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const char c = text[at];
    if (c == '"') in_string = !in_string;
    if (in_string) {
      bare += c;
    } else if (text.substr(at).starts_with("--")) {
      at = std::min(text.find('\n', at), text.size()) - 1;
    } else if (std::isspace(static_cast<unsigned char>(c)) == 0) {
      bare += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    } else if (!bare.empty() && bare.back() != ' ') {
      bare += ' ';
    }
  }
  return bare;
}

Result<std::string> rtl_hash(const std::filesystem::path& source_folder) {
  const auto sources = read_rtl_sources(source_folder);
  if (!sources) return sources.error();
  ContentHash hash;
  for (const VhdlSource& source : *sources) hash.add(source.name).add(bare_vhdl(source.content));
  return hash.hex();
}

}  // namespace halfway
