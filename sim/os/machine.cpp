// SPDX-License-Identifier: Apache-2.0
#include "sim/os/machine.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <string_view>
#include <thread>

#include "sim/os/file.hpp"

namespace halfway {
namespace {

// The text between `begin` and the next `end`, after the first `key` in the file.
std::string value_of(const char* file, std::string_view key, std::string_view begin, char end) {
  const auto text = read_file(file);
  const std::size_t at = text ? text->find(key) : std::string::npos;
  if (at == std::string::npos) return "unknown";
  const std::size_t from = text->find(begin, at) + begin.size();
  return text->substr(from, text->find(end, from) - from);
}

// The widest vectors that the processor computes with: ", AVX-512", ", AVX2" or nothing.
std::string vector_extension() {
  const std::string flags = " " + value_of("/proc/cpuinfo", "\nflags", ": ", '\n') + " ";
  if (flags.find(" avx512f ") != std::string::npos) return ", AVX-512";
  return flags.find(" avx2 ") != std::string::npos ? ", AVX2" : "";
}

}  // namespace

std::string machine() {
  const double kilobytes = std::strtod(value_of("/proc/meminfo", "MemTotal", ":", 'k').c_str(), nullptr);
  return fmt::format("{} cores of {}{}, {:.0f} GiB", std::thread::hardware_concurrency(),
                     value_of("/proc/cpuinfo", "model name", ": ", '\n'), vector_extension(),
                     kilobytes / (1 << 20));
}

std::string operating_system() {
  return value_of("/etc/os-release", "PRETTY_NAME", "\"", '"');
}

}  // namespace halfway
