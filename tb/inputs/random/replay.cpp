// SPDX-License-Identifier: Apache-2.0
// Runs a target on every file of the given folders, without libFuzzer: seeds and regressions in `make test`.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <system_error>
#include <vector>

#include "inputs/random/fuzz.hpp"
#include "sim/os/file.hpp"

namespace {

/// A small file that takes longer is a fault.
constexpr std::chrono::seconds c_longest{20};

}  // namespace

int main(int argc, char** argv) {
  using namespace halfway;
  if (argc < 2) {
    fmt::print(stderr, "usage: {} FOLDER...\n", argv[0]);
    return 2;
  }
  std::size_t replayed = 0;
  for (int i = 1; i < argc; ++i) {
    std::vector<std::filesystem::path> files;
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(argv[i], error))
      files.push_back(entry.path());
    if (error) {
      fmt::print(stderr, "{}: {}\n", argv[i], error.message());
      return 2;
    }
    std::sort(files.begin(), files.end());
    for (const auto& file : files) {
      const auto bytes = read_file(file);
      if (!bytes) {
        fmt::print(stderr, "{}\n", bytes.error().message);
        return 2;
      }
      // Print the name before the run: after a crash it is the last line of the output.
      fmt::print("{}\n", file.string());
      std::fflush(stdout);
      const auto start = std::chrono::steady_clock::now();
      LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes->data()), bytes->size());
      if (std::chrono::steady_clock::now() - start > c_longest) {
        fmt::print(stderr, "{}: took longer than {} s\n", file.string(), c_longest.count());
        return 1;
      }
      ++replayed;
    }
  }
  fmt::print("{} inputs replayed\n", replayed);
  return replayed == 0 ? 2 : 0;
}
