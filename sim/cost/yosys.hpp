// SPDX-License-Identifier: Apache-2.0
// Runs synthesis tools and keeps their results in build/cache. Errors are thrown as Failure.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/cost/families.hpp"
#include "sim/os/subprocess.hpp"

namespace halfway::synth {

inline constexpr std::chrono::minutes c_tool_timeout{60};
inline constexpr const char* c_install_tools = c_hx8k.install;

/// What the command prints. If it fails, the error has its output; `doing` and `install` are for the message.
std::string run_tool(std::vector<std::string> arguments, const std::filesystem::path& folder,
                     const std::string& doing, const char* install = c_install_tools);

/// The first line that a tool prints for its version.
std::string version_of(const std::string& tool, const std::string& option,
                       const char* install = c_install_tools);

/// The folder of a result in the cache: that of the same key, or a fresh one that `make` fills. Without an
/// error it is kept. Thread-safe.
std::filesystem::path kept(const std::filesystem::path& cache, const std::string& name,
                           const std::vector<std::string_view>& key,
                           const std::function<void(const std::filesystem::path&)>& make);

class Yosys {
 public:
  /// Results are kept in `cache`.
  static Yosys find(const std::filesystem::path& cache);
  const std::string& version() const { return version_; }

  /// Names and texts.
  using Files = std::vector<std::pair<std::string, std::string>>;
  /// The folder of the files and of what the script writes. It is kept if `check` does not throw.
  /// Thread-safe.
  std::filesystem::path run(const std::string& name, const std::string& script, const Files& files,
                            const std::function<void(const std::filesystem::path&)>& check) const;

 private:
  Yosys(std::string version, std::filesystem::path cache)
      : version_(std::move(version)), cache_(std::move(cache)) {}
  std::string version_;
  std::filesystem::path cache_;
};

/// The file cells.json that every script writes by c_statistics, and its numbers of the whole design.
inline constexpr std::string_view c_statistics = "tee -q -o cells.json stat -json";
nlohmann::json read_statistics(const std::filesystem::path& folder);

/// The folder's statistics. Throws Failure if a cell is of no kind.
Cells count_cells(const std::filesystem::path& folder, std::span<const CellKind> kinds);

}  // namespace halfway::synth
