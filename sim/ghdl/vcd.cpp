// SPDX-License-Identifier: Apache-2.0
#include "sim/ghdl/vcd.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "sim/system/file.hpp"

namespace halfway {
namespace {

std::vector<std::string> words_of(std::string_view line) {
  std::istringstream stream{std::string(line)};
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

}  // namespace

Result<SampledSignals> sample_vcd(const std::filesystem::path& file, const std::string& clock,
                                  const std::vector<std::string>& paths, std::size_t most_edges) {
  auto reader = LineReader::open(file);
  if (!reader) return reader.error();
  std::vector<std::string> scopes;
  std::map<std::string, std::string> code_of;  // by path
  std::map<std::string, std::string> now;      // by code
  SampledSignals sampled;
  std::string clock_code;
  bool rising = false;  // the clock rises at the current time; later changes are after the edge
  const auto sample = [&] {
    for (const std::string& path : paths) sampled.values[path].push_back(now[code_of[path]]);
    ++sampled.edges;
  };
  std::map<std::string, std::string> moved;
  const auto close_time = [&] {
    if (rising && sampled.edges < most_edges) sample();
    for (auto& [code, value] : moved) now[code] = value;
    moved.clear();
    rising = false;
  };
  for (std::string_view line;;) {
    const auto next = reader->next(line);
    if (next == LineReader::Next::failed) return reader->error();
    if (next == LineReader::Next::end_of_file) break;
    if (line.empty()) continue;
    if (line.front() == '$') {
      const auto words = words_of(line);
      if (words[0] == "$scope" && words.size() > 2) {
        scopes.push_back(words[2]);
      } else if (words[0] == "$upscope" && !scopes.empty()) {
        scopes.pop_back();
      } else if (words[0] == "$var" && words.size() > 4) {
        const std::string path =
            fmt::format("{}/{}", fmt::join(scopes, "/"), words[4].substr(0, words[4].find('[')));
        code_of.emplace(path, words[3]);
      } else if (words[0] == "$enddefinitions") {
        for (const std::string& path : paths)
          if (!code_of.contains(path))
            return reader->at(fmt::format("the trace has no signal {}; was it renamed?", path));
        const auto code = code_of.find(clock);
        if (code == code_of.end())
          return reader->at(fmt::format("the trace has no clock {}; was it renamed?", clock));
        clock_code = code->second;
      }
    } else if (clock_code.empty()) {
      continue;  // of the header
    } else if (line.front() == '#') {
      close_time();
      if (sampled.edges >= most_edges) break;
    } else if (line.front() == 'b') {
      const auto words = words_of(line);
      if (words.size() == 2) moved[words[1]] = words[0].substr(1);
    } else {
      const std::string code(line.substr(1));
      moved[code] = std::string(1, line.front());
      if (code == clock_code && line.front() == '1' && now[code] == "0") rising = true;
    }
  }
  close_time();
  return sampled;
}

}  // namespace halfway
