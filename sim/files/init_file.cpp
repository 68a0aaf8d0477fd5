// SPDX-License-Identifier: Apache-2.0
#include "sim/files/init_file.hpp"

#include <fmt/format.h>

#include <array>

namespace halfway {
namespace {

constexpr StreamReader::Kind c_init{"halfway-init", "an init file", "write it again with halfway init",
                                    " <bits>"};

/// The value of each hexadecimal digit; 16 for any other character.
constexpr std::array<std::uint8_t, 256> c_digit_values = [] {
  std::array<std::uint8_t, 256> values{};
  values.fill(16);
  for (unsigned i = 0; i < 10; ++i) values['0' + i] = static_cast<std::uint8_t>(i);
  for (unsigned i = 0; i < 6; ++i) {
    values['a' + i] = static_cast<std::uint8_t>(10 + i);
    values['A' + i] = static_cast<std::uint8_t>(10 + i);
  }
  return values;
}();

}  // namespace

Result<InitFileWriter> InitFileWriter::open(const std::filesystem::path& path, std::string_view key_name,
                                            unsigned bits) {
  auto writer = LineWriter::open(path);
  if (!writer) return writer.error();
  writer->append(fmt::format("{} 1 {} {}\n", c_init.word, key_name, bits));
  return InitFileWriter(std::move(*writer), bits);
}

void InitFileWriter::write(std::span<const std::uint32_t> words) {
  const std::size_t words_per_vector = (bits_ + 31) / 32;
  std::string line;
  for (; words.size() >= words_per_vector && words_per_vector > 0; words = words.subspan(words_per_vector)) {
    line.clear();
    for (std::size_t digit = (bits_ + 3) / 4; digit-- > 0;)
      line += "0123456789abcdef"[(words[digit / 8] >> (digit % 8 * 4)) & 15U];
    writer_.append(line += '\n');
    ++count_;
  }
}

Status InitFileWriter::commit() {
  writer_.append(fmt::format("end {}\n", count_));
  return writer_.commit();
}

Result<InitFileReader> InitFileReader::open(const std::filesystem::path& path, std::string_view key_name) {
  auto reader = StreamReader::open(path, c_init, key_name, c_most_init_bits / 4 + 1);
  if (!reader) return reader.error();
  const auto bits = to_number(reader->fields(), c_most_init_bits);
  if (!bits || *bits == 0) return reader->broken_header();
  return InitFileReader(std::move(*reader), static_cast<unsigned>(*bits));
}

Result<std::size_t> InitFileReader::read(std::vector<std::uint32_t>& words, std::size_t limit) {
  const std::size_t words_per_vector = (bits_ + 31) / 32;
  const std::size_t digits = (bits_ + 3) / 4;
  const unsigned top_bits = bits_ % 4 == 0 ? 4 : bits_ % 4;
  std::size_t got = 0;
  for (std::string_view line; got < limit; ++got, ++count_) {
    const auto more = reader_.next(line, count_);
    if (!more) return more.error();
    if (!*more) break;
    if (line.size() != digits) {
      return reader_.at(fmt::format("{} characters; a vector of {} bits takes {} hexadecimal digits",
                                    line.size(), bits_, digits));
    }
    const std::size_t first = words.size();
    words.resize(first + words_per_vector);
    std::uint32_t bad = 0;
    for (std::size_t i = 0; i < digits; ++i) {
      const std::size_t digit = digits - 1 - i;
      const std::uint32_t value = c_digit_values[static_cast<unsigned char>(line[i])];
      bad |= value & 16U;
      words[first + digit / 8] |= (value & 15U) << (digit % 8 * 4);
    }
    if (bad != 0 || (c_digit_values[static_cast<unsigned char>(line[0])] >> top_bits) != 0) {
      words.resize(first);
      return reader_.at(bad != 0 ? std::string("a character that is not a hexadecimal digit")
                                 : fmt::format("a value of more than {} bits", bits_));
    }
  }
  return got;
}

Status write_init_file(const std::filesystem::path& path, std::string_view key_name,
                       const InitStream& stream) {
  auto writer = InitFileWriter::open(path, key_name, stream.bits);
  if (!writer) return writer.error();
  writer->write(stream.words);
  return writer->commit();
}

Result<InitStream> read_init_file(const std::filesystem::path& path, std::string_view key_name) {
  auto reader = InitFileReader::open(path, key_name);
  if (!reader) return reader.error();
  InitStream stream{reader->bits(), {}};
  while (true) {
    const auto got = reader->read(stream.words, 1U << 16);
    if (!got) return got.error();
    if (*got == 0) return stream;
  }
}

}  // namespace halfway
