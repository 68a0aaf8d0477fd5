// SPDX-License-Identifier: Apache-2.0
// From a netlist to a shared library: Verilator, then one translation unit of its output and a harness,
// cached.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/result.hpp"
#include "sim/ghdl/ghdl_library.hpp"

namespace halfway {

struct VerilatedBuild {
  std::string name;     ///< of the cached build, before the hash
  std::string netlist;  ///< mended
  std::string top;
  std::filesystem::path harness;                       ///< a C++ source that includes "Vshader.h"
  std::filesystem::path include_folder;                ///< the project's root, for the harness's own includes
  std::vector<std::filesystem::path> harness_headers;  ///< which its meaning depends on
  std::vector<std::string> definitions;                ///< NAME=value for the harness
  bool waves = false;                                  ///< with FST tracing, which costs speed
  bool fast = true;                                    ///< worth a long compilation
  std::string compiler;                                ///< empty: clang++ where it is installed, else g++
};

/// A loaded shared library; unloaded when the last copy goes.
class VerilatedLibrary {
 public:
  /// Builds the library in build/cache/verilator/<name>-<hash>/ unless it is there, and loads it.
  static Result<VerilatedLibrary> open(const VerilatedBuild& build, const std::filesystem::path& cache);

  template <class Function>
  Result<Function*> function(const char* name) const {
    void* found = symbol(name);
    if (found == nullptr) return tool_failed(file_.string() + ": has no function " + name);
    return reinterpret_cast<Function*>(found);
  }
  const std::filesystem::path& file() const { return file_; }

 private:
  VerilatedLibrary(std::shared_ptr<void> handle, std::filesystem::path file)
      : handle_(std::move(handle)), file_(std::move(file)) {}
  void* symbol(const char* name) const;
  std::shared_ptr<void> handle_;
  std::filesystem::path file_;
};

}  // namespace halfway
