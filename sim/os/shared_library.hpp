// SPDX-License-Identifier: Apache-2.0
// Build and load generated C++ as a cached shared library: tools, compiler, library.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/result.hpp"
#include "sim/os/subprocess.hpp"

namespace halfway {

inline constexpr const char* c_install_verilator = "apt-get install verilator";
inline constexpr const char* c_install_compiler = "apt-get install clang";
/// The tools and libraries that compile C++ for a browser.
inline constexpr const char* c_install_web_assembly = "scripts/setup.sh tools";

/// Return the output of the command. If the command fails, the error contains all of its output and starts
/// with `doing`.
Result<std::string> run_tool(Command command, const std::string& install, const std::string& doing);
/// Return a short answer, such as a version, without the line end.
Result<std::string> ask(const std::vector<std::string>& question, const std::string& install);

struct Compiler {
  std::string program;
  std::string identity;  ///< program, version and this processor: what -march=native depends on
  /// `wanted`. If empty: clang++ if installed, otherwise g++.
  static Result<Compiler> find(const std::string& wanted);
};

/// The level at which generated code is optimized, such as -O2. HALFWAY_QUICK_BUILDS in the environment
/// replaces it: tests simulate few clocks, and optimization takes longer than it saves.
std::string optimization(const char* level);

/// A loaded shared library; unloaded when the last copy is destroyed.
class SharedLibrary {
 public:
  /// Throws std::bad_alloc if there is no memory for the library or for one that it needs.
  static Result<SharedLibrary> load(const std::filesystem::path& file);

  template <class Function>
  Result<Function*> function(const char* name) const {
    void* found = symbol(name);
    if (found == nullptr) return tool_failed(file_.string() + ": has no function " + name);
    return reinterpret_cast<Function*>(found);
  }
  /// Set each pointer to the function whose name follows it: bind(run, "halfway_run", drain,
  /// "halfway_drain").
  template <class Function, class... More>
  Status bind(Function*& pointer, const char* name, More&&... more) const {
    const auto found = function<Function>(name);
    if (!found) return found.error();
    pointer = *found;
    if constexpr (sizeof...(more) > 0)
      return bind(std::forward<More>(more)...);
    else
      return Ok{};
  }
  const std::filesystem::path& file() const { return file_; }

 private:
  SharedLibrary(std::shared_ptr<void> handle, std::filesystem::path file)
      : handle_(std::move(handle)), file_(std::move(file)) {}
  void* symbol(const char* name) const;
  std::shared_ptr<void> handle_;
  std::filesystem::path file_;
};

}  // namespace halfway
