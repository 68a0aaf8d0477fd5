// SPDX-License-Identifier: Apache-2.0
// Mutations for text formats that random bytes rarely reach: replace a number by one of any size; remove,
// duplicate or move a line.
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <random>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

namespace {

// Separated by spaces.
constexpr std::string_view c_numbers =
    "0 -0.0 1 -1 0.5 2 3 4 1e-3 1e-8 1e-16 1e-30 1e-45 1e-100 1e-160 5e-324 2.3e-308 1e3 1e6 1e8 "
    "1e12 1e15 -1e15 1e16 1e30 1e38 3.5e38 1e154 1e200 1e308 1e309 -1e308 nan inf -inf 89.999999 90 "
    "180 179.9999 0.1 255 65535 2147483647 -2147483648 4294967296 9223372036854775807 "
    "18446744073709551616 0x7f";

bool is_number_part(char c) {
  return (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '+' || c == 'e' || c == 'E';
}

struct Piece {
  std::size_t begin, size;
};

std::vector<Piece> numbers_in(std::string_view text) {
  std::vector<Piece> found;
  for (std::size_t i = 0; i < text.size();) {
    std::size_t end = i;
    bool digit = false;
    for (; end < text.size() && is_number_part(text[end]); ++end)
      digit = digit || (text[end] >= '0' && text[end] <= '9');
    if (digit) found.push_back({i, end - i});
    i = end > i ? end : i + 1;
  }
  return found;
}

std::vector<Piece> lines_in(std::string_view text) {
  std::vector<Piece> found;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t end = std::min(text.find('\n', i), text.size() - 1) + 1;
    found.push_back({i, end - i});
    i = end;
  }
  return found;
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most,
                                               unsigned seed) {
  static const std::vector<std::string> c_known = [] {
    std::istringstream numbers{std::string(c_numbers)};
    return std::vector<std::string>(std::istream_iterator<std::string>(numbers), {});
  }();
  std::minstd_rand random(seed);
  const auto pick = [&](std::size_t count) { return random() % count; };
  std::string text(reinterpret_cast<const char*>(data), size);
  const std::size_t way = pick(8);
  if (way < 4) return LLVMFuzzerMutate(data, size, most);
  if (way < 7) {
    for (std::size_t left = 1 + pick(3); left > 0; --left) {
      const std::vector<Piece> numbers = numbers_in(text);
      if (numbers.empty()) return LLVMFuzzerMutate(data, size, most);
      const Piece& at = numbers[pick(numbers.size())];
      const std::string with = pick(4) == 0 ? text.substr(numbers[pick(numbers.size())].begin, at.size)
                                            : c_known[pick(c_known.size())];
      text.replace(at.begin, at.size, with);
    }
  } else {
    const std::vector<Piece> lines = lines_in(text);
    if (lines.empty()) return LLVMFuzzerMutate(data, size, most);
    const Piece from = lines[pick(lines.size())], to = lines[pick(lines.size())];
    const std::string line = text.substr(from.begin, from.size);
    if (pick(3) == 0)
      text.erase(from.begin, from.size);
    else
      text.insert(to.begin, line);
  }
  if (text.size() > most) text.resize(most);
  std::memcpy(data, text.data(), text.size());
  return text.size();
}
