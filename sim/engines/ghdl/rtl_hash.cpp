// SPDX-License-Identifier: Apache-2.0
#include "sim/engines/ghdl/rtl_hash.hpp"

#include <cctype>

#include "sim/engines/ghdl/ghdl_library.hpp"
#include "sim/os/file.hpp"

namespace halfway {

std::string bare_vhdl(std::string_view text) {
  std::string bare;
  // Skips text up to and with `end`, and returns it.
  const auto take = [&text](std::string_view end, std::size_t from) {
    const std::size_t found = text.find(end, from);
    const std::string_view taken =
        text.substr(0, found == std::string_view::npos ? text.size() : found + end.size());
    text.remove_prefix(taken.size());
    return taken;
  };
  const auto separate = [&bare] {
    if (!bare.empty() && bare.back() != ' ') bare += ' ';
  };
  while (!text.empty()) {
    const char c = text.front();
    if (c == '"' || c == '\\') {  // a string, an extended identifier
      bare += take(text.substr(0, 1), 1);
    } else if (c == '\'' && text.size() > 2 && text[2] == '\'') {
      bare += take("'", 1);
    } else if (text.starts_with("--") || text.starts_with("/*")) {
      take(c == '-' ? "\n" : "*/", 2);
      separate();
    } else {
      if (std::isspace(static_cast<unsigned char>(c)) != 0)
        separate();
      else
        bare += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
      text.remove_prefix(1);
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
