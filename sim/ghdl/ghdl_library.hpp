// SPDX-License-Identifier: Apache-2.0
// Analysed VHDL, cached by content: build/cache/ghdl/<hash>/ holds copies of the sources under their own
// relative names and GHDL's work library beside them, so that later edits of the tree cannot disturb a run.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "common/result.hpp"

namespace halfway {

/// Where the sources are and where builds are kept.
struct SimulatorFolders {
  std::filesystem::path source;  ///< the project's root, which holds rtl/, tb/ and sim/
  std::filesystem::path cache;   ///< usually build/cache
};

inline constexpr const char* kInstallGhdl = "apt-get install ghdl-llvm";

enum class GhdlBackEnd { mcode, llvm, gcc };

struct GhdlTool {
  GhdlBackEnd back_end;
  std::string version;           ///< all that `ghdl --version` says
  std::string program = "ghdl";  ///< a name in PATH, or a path

  /// Asks the program; where there is none, an error with the command that installs GHDL.
  static Result<GhdlTool> find(const std::string& program = "ghdl");
};

struct VhdlSource {
  std::string name;  ///< relative to the project's root, as messages show it
  std::string content;
};

/// The RTL in compile order: rtl/files.f, a path relative to rtl/ on each line.
Result<std::vector<VhdlSource>> read_rtl_sources(const std::filesystem::path& source_folder);
Result<VhdlSource> read_vhdl_source(const std::filesystem::path& source_folder, const std::string& name);

class GhdlLibrary {
 public:
  /// Analyses the sources in order, warnings as errors, unless the cache has them. `top` is elaborated too
  /// where the back end makes a program of it (llvm, gcc); empty: nothing to elaborate. The RTL that the
  /// sources begin with is analysed once for all testbenches.
  static Result<GhdlLibrary> open(const GhdlTool& tool, const std::vector<VhdlSource>& sources,
                                  const std::string& top, const std::filesystem::path& cache);
  /// For `synthesize` alone: the same checks, and no code generated, which is nearly all of the time.
  static Result<GhdlLibrary> for_synthesis(const GhdlTool& tool, const std::vector<VhdlSource>& sources,
                                           const std::filesystem::path& cache);

  const std::filesystem::path& folder() const { return folder_; }
  const GhdlTool& tool() const { return tool_; }
  const std::string& hash() const { return hash_; }

  /// The Verilog netlist of `entity`, as `ghdl --synth` prints it, which takes seconds: from the library's
  /// folder where it was asked for before. Refused where GHDL would drop a `when others`.
  Result<std::string> synthesize(const std::string& entity,
                                 const std::vector<std::pair<std::string, std::string>>& generics) const;
  /// The command that simulates `top`; its generics and GHDL's run options go at the end.
  std::vector<std::string> run_arguments(const std::string& top) const;

 private:
  GhdlLibrary(GhdlTool tool, std::filesystem::path folder, std::string hash)
      : tool_(std::move(tool)), folder_(std::move(folder)), hash_(std::move(hash)) {}
  GhdlTool tool_;
  std::filesystem::path folder_;
  std::string hash_;
  std::vector<std::string> to_read_;  ///< the sources' names, where nothing is analysed
};

}  // namespace halfway
