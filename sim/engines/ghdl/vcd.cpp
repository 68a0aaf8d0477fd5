// SPDX-License-Identifier: Apache-2.0
#include "sim/engines/ghdl/vcd.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdlib>
#include <sstream>

#include "sim/os/must.hpp"

namespace halfway {
namespace {

std::vector<std::string> words_of(std::string_view line) {
  std::istringstream stream{std::string(line)};
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

}  // namespace

VcdReader::VcdReader(const std::filesystem::path& file) : lines_(must(LineReader::open(file))) {
  std::vector<std::string> scopes;
  for (std::string_view line; must(lines_.next(line));) {
    const auto words = words_of(line);
    if (words.empty()) continue;
    if (words[0] == "$enddefinitions") return;
    if (words[0] == "$scope" && words.size() > 2) {
      scopes.push_back(words[2]);
    } else if (words[0] == "$upscope" && !scopes.empty()) {
      scopes.pop_back();
    } else if (words[0] == "$var" && words.size() > 4) {
      const std::string name = words[4].substr(0, words[4].find('['));
      signals_.emplace(fmt::format("{}/{}", fmt::join(scopes, "/"), name),
                       VcdSignal{words[3], words[2] == "1"});
    }
  }
  throw Failure{at("the trace has no $enddefinitions")};
}

std::optional<VcdChange> VcdReader::next() {
  for (std::string_view line; must(lines_.next(line));) {
    if (line.empty() || line.front() == '$') continue;
    const std::string rest(line.substr(1));
    if (line.front() == '#') {
      time_ = std::strtoull(rest.c_str(), nullptr, 10);
    } else if (line.front() == 'b') {
      if (const auto words = words_of(rest); words.size() == 2) return VcdChange{words[1], words[0]};
    } else {
      return VcdChange{rest, std::string(1, line.front())};
    }
  }
  return std::nullopt;
}

Result<SampledSignals> sample_vcd(const std::filesystem::path& file, const std::string& clock,
                                  const std::vector<std::string>& paths, std::size_t most_edges) try {
  VcdReader reader(file);
  for (const std::string& path : paths)
    if (!reader.signals().contains(path))
      return reader.at(fmt::format("the trace has no signal {}; was it renamed?", path));
  const auto clock_signal = reader.signals().find(clock);
  if (clock_signal == reader.signals().end())
    return reader.at(fmt::format("the trace has no clock {}; was it renamed?", clock));
  const std::string& clock_code = clock_signal->second.code;

  SampledSignals sampled;
  std::map<std::string, std::string> before, now;  // by code
  std::uint64_t time = 0;
  // Sample at the end of a time in which the clock rose, with the values before that time.
  const auto close_time = [&] {
    if (now[clock_code] == "1" && before[clock_code] == "0" && sampled.edges < most_edges) {
      for (const std::string& path : paths)
        sampled.values[path].push_back(before[reader.signals().at(path).code]);
      ++sampled.edges;
    }
    before = now;
  };
  while (sampled.edges < most_edges) {
    auto change = reader.next();
    if (!change || reader.time() != time) close_time();
    if (!change) break;
    time = reader.time();
    now[change->code] = std::move(change->value);
  }
  return sampled;
} catch (const Failure& failure) {
  return failure.error;
}

}  // namespace halfway
