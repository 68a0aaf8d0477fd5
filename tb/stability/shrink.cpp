// SPDX-License-Identifier: Apache-2.0
#include "stability/shrink.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <chrono>
#include <optional>
#include <tuple>

#include "sim/system/seconds.hpp"

namespace halfway::stability {
namespace {

std::uint64_t distance(std::int64_t a, std::int64_t b) {
  return a < b ? static_cast<std::uint64_t>(b) - static_cast<std::uint64_t>(a)
               : static_cast<std::uint64_t>(a) - static_cast<std::uint64_t>(b);
}

// In this order: the number of parameters that are not at their simplest value, those between grains, the
// bits of their values, and their distances. Every step reduces it, so that shrinking terminates.
using Complexity = std::tuple<std::size_t, std::size_t, int, unsigned __int128>;

Complexity complexity(std::span<const Parameter> parameters, const Input& input) {
  std::size_t others = 0, between = 0;
  int bits = 0;
  unsigned __int128 off = 0;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const std::uint64_t by = distance(input[i], parameters[i].simplest);
    others += by != 0;
    between += by % static_cast<std::uint64_t>(parameters[i].grain) != 0;
    bits += static_cast<int>(std::bit_width(by));
    off += by;
  }
  return {others, between, bits, off};
}

bool in_range(std::span<const Parameter> parameters, const Input& input) {
  for (std::size_t i = 0; i < parameters.size(); ++i)
    if (input[i] < parameters[i].least || input[i] > parameters[i].greatest) return false;
  return input.size() == parameters.size();
}

// Values towards the simplest: the simplest itself, the neighbouring grains, fewer and fewer zero bits at the
// end, smaller and smaller steps.
std::vector<std::int64_t> simpler_values(std::int64_t value, const Parameter& p) {
  std::vector<std::int64_t> values;
  const std::uint64_t by = distance(value, p.simplest), grain = static_cast<std::uint64_t>(p.grain);
  if (by == 0) return values;
  const auto at = [&](std::uint64_t off) {
    values.push_back(value < p.simplest ? p.simplest - static_cast<std::int64_t>(off)
                                        : p.simplest + static_cast<std::int64_t>(off));
  };
  at(0);
  if (by % grain != 0) at(by - by % grain), at(by - by % grain + grain);
  for (int low = static_cast<int>(std::bit_width(by)) - 1; low > 0; --low)
    if (const std::uint64_t rounded = by >> low << low; rounded != by) at(rounded);
  for (std::uint64_t step = by / grain / 2; step > 0; step /= 2) at(by - step * grain);
  for (std::uint64_t step = std::min(by - 1, grain); step > 0; step /= 2) at(by - step);
  return values;
}

}  // namespace

Input shrink(std::span<const Parameter> parameters, Input input,
             const std::function<bool(const Input&)>& fails,
             const std::function<std::vector<Input>(const Input&)>& simpler, const ShrinkOptions& options) {
  const auto began = std::chrono::steady_clock::now();
  std::uint64_t tries = 0;
  const auto exhausted = [&] {
    return tries >= options.most_tries || seconds_since(began) > options.most_seconds;
  };
  const auto take = [&](const Input& next) {
    if (exhausted() || !in_range(parameters, next) ||
        complexity(parameters, next) >= complexity(parameters, input))
      return false;
    ++tries;
    if (!fails(next)) return false;
    input = next;
    return true;
  };
  for (bool moved = true; moved && !exhausted();) {
    moved = false;
    if (simpler)
      for (bool again = true; again;) {
        again = false;
        for (const Input& next : simpler(input))
          if (take(next)) {
            again = moved = true;
            break;
          }
      }
    for (std::size_t i = 0; i < parameters.size(); ++i)
      for (bool again = true; again;) {
        again = false;
        for (const std::int64_t value : simpler_values(input[i], parameters[i])) {
          Input next = input;
          next[i] = value;
          if (take(next)) {
            again = moved = true;
            break;
          }
        }
      }
  }
  return input;
}

std::string write_regression(std::string_view search, std::span<const Parameter> parameters,
                             const Input& input, std::string_view comment) {
  std::string text = "# ";
  for (const char c : comment) text += c == '\n' ? "\n# " : std::string(1, c);
  text += fmt::format("\nsearch {}\n", search);
  for (std::size_t i = 0; i < parameters.size(); ++i)
    if (input[i] != parameters[i].simplest) text += fmt::format("{} {}\n", parameters[i].name, input[i]);
  return text;
}

Result<Regression> read_regression(
    std::string_view file, std::string_view text,
    const std::function<std::span<const Parameter>(std::string_view)>& parameters_of) {
  Regression regression;
  std::span<const Parameter> parameters;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.empty() || line.front() == '#') continue;
    const auto wrong = [&](std::string_view what) {
      return bad_input(fmt::format("{}:{}: {}: {}", file, number, line, what));
    };
    const std::size_t space = std::min(line.find(' '), line.size());
    const std::string_view name = line.substr(0, space),
                           value = line.substr(std::min(space + 1, line.size()));
    if (regression.search.empty()) {
      if (name != "search") return wrong("the file must start with `search` and its name");
      parameters = parameters_of(value);
      if (parameters.empty()) return wrong("there is no such search");
      regression.search = value;
      for (const Parameter& p : parameters) regression.input.push_back(p.simplest);
      continue;
    }
    const auto parameter = std::ranges::find(parameters, name, &Parameter::name);
    if (parameter == parameters.end()) return wrong("there is no such parameter");
    std::int64_t read = 0;
    const auto [rest, error] = std::from_chars(value.data(), value.data() + value.size(), read);
    if (error != std::errc{} || rest != value.data() + value.size()) return wrong("not an integer");
    if (read < parameter->least || read > parameter->greatest)
      return wrong(fmt::format("not from {} to {}", parameter->least, parameter->greatest));
    regression.input[static_cast<std::size_t>(parameter - parameters.begin())] = read;
  }
  if (regression.search.empty()) return bad_input(fmt::format("{}: names no search", file));
  return regression;
}

}  // namespace halfway::stability
