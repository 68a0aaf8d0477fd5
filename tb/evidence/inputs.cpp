// SPDX-License-Identifier: Apache-2.0
#include "evidence/inputs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <sstream>

#include "sim/system/file.hpp"
#include "sim/system/subprocess.hpp"

namespace halfway::evidence {
namespace {

bool is_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

// End of the literal that starts at `at`; `at` if none starts there. A quote after a word's character
// separates digits.
std::size_t literal_end(std::string_view text, std::size_t at) {
  const char quote = text[at];
  if (quote != '"' && (quote != '\'' || (at > 0 && is_word(text[at - 1])))) return at;
  if (quote == '"' && at > 0 && text[at - 1] == 'R') {
    const std::size_t open = text.find('(', at);
    if (open == std::string_view::npos) return text.size();
    const std::string end = fmt::format("){}\"", text.substr(at + 1, open - at - 1));
    const std::size_t close = text.find(end, open);
    return close == std::string_view::npos ? text.size() : close + end.size();
  }
  std::size_t end = at + 1;
  while (end < text.size() && text[end] != quote) end += text[end] == '\\' ? 2 : 1;
  return std::min(end + 1, text.size());
}

std::size_t comment_end(std::string_view text, std::size_t at) {
  const std::string_view rest = text.substr(at);
  std::size_t end = at;
  if (rest.starts_with("//"))
    end = text.find('\n', at);
  else if (rest.starts_with("/*") && (end = text.find("*/", at + 2)) != std::string_view::npos)
    end += 2;
  return std::min(end, text.size());
}

bool is_source(const std::filesystem::path& file) {
  const std::string name = file.filename().string();
  constexpr std::string_view c_endings[] = {".cpp", ".hpp", ".h"};
  return std::ranges::any_of(c_endings, [&](std::string_view ending) { return name.ends_with(ending); }) &&
         !name.ends_with("_test.cpp");
}

}  // namespace

std::string bare_cpp(std::string_view text) {
  std::string bare;
  for (std::size_t at = 0; at < text.size();) {
    if (const std::size_t end = comment_end(text, at); end > at) {
      at = end;
    } else if (const std::size_t literal = literal_end(text, at); literal > at) {
      bare += text.substr(at, literal - at);
      at = literal;
    } else {
      if (std::isspace(static_cast<unsigned char>(text[at])) == 0) bare += text[at];
      ++at;
    }
  }
  return bare;
}

Result<std::string> sources_hash(const std::filesystem::path& root, std::string_view folders) {
  ContentHash hash;
  std::size_t count = 0;
  std::istringstream list{std::string(folders)};
  for (std::string folder; std::getline(list, folder, ':');) {
    std::error_code error;
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(root / folder, error))
      if (entry.is_regular_file() && is_source(entry.path())) files.push_back(entry.path());
    if (error) return tool_failed(fmt::format("{}: {}", (root / folder).string(), error.message()));
    std::ranges::sort(files);
    for (const auto& file : files) {
      const auto text = read_file(file);
      if (!text) return text.error();
      hash.add(folder + '/' + file.filename().string()).add(bare_cpp(*text));
      ++count;
    }
  }
  if (count == 0) return tool_failed(fmt::format("{}: no sources in these folders", folders));
  return hash.hex();
}

Result<std::string> versions(std::span<const std::string_view> tools) {
  std::string all;
  for (const std::string_view tool : tools) {
    const std::string install = fmt::format("apt-get install {}", tool);
    const auto end = run_process({.arguments = {std::string(tool), tool == "yosys" ? "-V" : "--version"},
                                  .timeout = std::chrono::seconds(30)},
                                 install);
    if (!end) return end.error();
    if (!end->succeeded())
      return tool_failed(fmt::format("{}: {}; install it with: {}", tool, end->how(), install));
    all += fmt::format("{}{}", all.empty() ? "" : "; ", end->output.substr(0, end->output.find('\n')));
  }
  return all;
}

Result<std::string> program_hash(std::span<const std::string_view> tools, const std::filesystem::path& root,
                                 std::string_view folders) {
  const auto found = versions(tools);
  if (!found) return found.error();
  const auto sources = sources_hash(root, folders);
  if (!sources) return sources.error();
  return ContentHash().add(*found).add(*sources).hex();
}

}  // namespace halfway::evidence
