// SPDX-License-Identifier: Apache-2.0
#include "inputs/random/fuzz.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>

#include "sim/os/file.hpp"

namespace halfway::fuzz {

const std::filesystem::path& folder() {
  static const TemporaryFolder c_temporary = [] {
    auto made = TemporaryFolder::make(std::filesystem::temp_directory_path());
    if (!made) demand(false, made.error().message);
    return std::move(*made);
  }();
  return c_temporary.path();
}

std::filesystem::path write_input(std::string_view name, std::string_view bytes) {
  const std::filesystem::path path = folder() / name;
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  demand(!file.fail(), "the input cannot be written to " + path.string());
  return path;
}

void demand(bool holds, std::string_view what) {
  if (holds) return;
  fmt::print(stderr, "broken promise: {}\n", what);
  std::fflush(stderr);
  std::abort();
}

void demand_refusal(const Error& error) {
  const std::string begin = folder().string() + "/";
  demand(error.code == ExitCode::bad_input, "a bad file must end with exit code 2: " + error.message);
  demand(error.message.starts_with(begin) && error.message.size() > begin.size(),
         "the message must begin with the file's name: " + error.message);
}

}  // namespace halfway::fuzz
