// SPDX-License-Identifier: Apache-2.0
#include "sim/engines/ghdl/vcd.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sstream>

#include "sim/os/file.hpp"

namespace halfway {
namespace {

std::vector<std::string> words_of(std::string_view line) {
  std::istringstream stream{std::string(line)};
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

// Reads the header: the code of each signal, by scopes and name joined by '/', such as "frame_tb/dut/x".
std::map<std::string, std::string> read_codes(LineReader& lines) {
  std::map<std::string, std::string> codes;
  std::vector<std::string> scopes;
  for (std::string_view line; must(lines.next(line));) {
    const auto words = words_of(line);
    if (words.empty()) continue;
    if (words[0] == "$enddefinitions") return codes;
    if (words[0] == "$scope" && words.size() > 2) {
      scopes.push_back(words[2]);
    } else if (words[0] == "$upscope" && !scopes.empty()) {
      scopes.pop_back();
    } else if (words[0] == "$var" && words.size() > 4) {
      const std::string name = words[4].substr(0, words[4].find('['));
      codes.emplace(fmt::format("{}/{}", fmt::join(scopes, "/"), name), words[3]);
    }
  }
  throw Failure{lines.at("the trace has no $enddefinitions")};
}

}  // namespace

Result<SampledSignals> sample_vcd(const std::filesystem::path& file, const std::string& clock,
                                  const std::vector<std::string>& paths, std::size_t most_edges) try {
  LineReader lines = must(LineReader::open(file));
  const std::map<std::string, std::string> codes = read_codes(lines);
  for (const std::string& path : paths)
    if (!codes.contains(path))
      return lines.at(fmt::format("the trace has no signal {}; was it renamed?", path));
  if (!codes.contains(clock))
    return lines.at(fmt::format("the trace has no clock {}; was it renamed?", clock));
  const std::string& clock_code = codes.at(clock);

  SampledSignals sampled;
  std::map<std::string, std::string> before, now;  // by code
  // Sample at the end of a time in which the clock rose, with the values before that time.
  const auto close_time = [&] {
    if (now[clock_code] == "1" && before[clock_code] == "0" && sampled.edges < most_edges) {
      for (const std::string& path : paths) sampled.values[path].push_back(before[codes.at(path)]);
      ++sampled.edges;
    }
    before = now;
  };
  for (std::string_view line; sampled.edges < most_edges && must(lines.next(line));) {
    if (line.empty() || line.front() == '$') continue;
    if (line.front() == '#') {
      close_time();
    } else if (line.front() == 'b') {
      if (const auto words = words_of(line.substr(1)); words.size() == 2) now[words[1]] = words[0];
    } else {
      now[std::string(line.substr(1))] = line.substr(0, 1);
    }
  }
  close_time();
  return sampled;
} catch (const Failure& failure) {
  return failure.error;
}

}  // namespace halfway
