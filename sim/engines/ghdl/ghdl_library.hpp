// SPDX-License-Identifier: Apache-2.0
// Analysed VHDL, cached by content without comments. build/cache/ghdl/<hash>/ contains copies of the sources
// under their relative names and GHDL's work library. Later edits of the tree do not affect a run; lines in
// GHDL's messages are those of the copies.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/result.hpp"

namespace halfway {

/// Folders of the sources and of the builds.
struct SimulatorFolders {
  std::filesystem::path source;  ///< the project's root with rtl/, tb/ and sim/
  std::filesystem::path cache;   ///< usually build/cache
};

inline constexpr const char* c_install_ghdl = "apt-get install ghdl-llvm";

struct GhdlTool {
  bool makes_program;            ///< as the back ends llvm and gcc do; mcode runs in memory
  std::string version;           ///< the output of `ghdl --version`
  std::string program = "ghdl";  ///< a name in PATH, or a path; tests name another

  /// Find ghdl. If it is missing, return an error with the command that installs it.
  static Result<GhdlTool> find();
};

struct VhdlSource {
  std::string name;  ///< relative to the project's root, as in messages
  std::string content;
};

/// The RTL of a folder in compile order. Its files.f lists one path relative to the folder per line.
Result<std::vector<VhdlSource>> read_rtl_sources(const std::filesystem::path& source_folder,
                                                 const std::string& rtl_folder = "rtl");
Result<VhdlSource> read_vhdl_source(const std::filesystem::path& source_folder, const std::string& name);

/// VHDL without comments, in lower case outside of literals, with one space for white space: equal for equal
/// tokens.
std::string bare_vhdl(std::string_view text);
/// Hash of the sources of rtl/files.f, each as bare_vhdl.
Result<std::string> rtl_hash(const std::filesystem::path& source_folder);

class GhdlLibrary {
 public:
  /// Analyse the sources in order, with warnings as errors, unless the result is cached. `top` is also
  /// elaborated if the back end makes a program of it (llvm, gcc); empty: no elaboration. The RTL at the
  /// start of the sources is analysed once for all testbenches.
  static Result<GhdlLibrary> open(const GhdlTool& tool, const std::vector<VhdlSource>& sources,
                                  const std::string& top, const std::filesystem::path& cache);
  /// For `synthesize` only: the same checks without code generation, which takes most of the time. With
  /// `vendor_cells`, components may have no entity.
  static Result<GhdlLibrary> for_synthesis(const GhdlTool& tool, const std::vector<VhdlSource>& sources,
                                           const std::filesystem::path& cache, bool vendor_cells = false);

  const std::filesystem::path& folder() const { return folder_; }
  const GhdlTool& tool() const { return tool_; }
  const std::string& hash() const { return hash_; }

  using Generics = std::vector<std::pair<std::string, std::string>>;
  /// The Verilog netlist of `entity`, as `ghdl --synth` prints it. Synthesis takes seconds, so the result is
  /// stored in the library's folder. Refuses a design for which GHDL would omit a `when others`.
  Result<std::string> synthesize(const std::string& entity, const Generics& generics) const;
  /// The same netlist as VHDL, with positions in the sources.
  Result<std::string> synthesize_vhdl(const std::string& entity, const Generics& generics) const;
  /// The command that simulates `top`. Generics and GHDL's run options are appended to it.
  std::vector<std::string> run_arguments(const std::string& top) const;

 private:
  GhdlLibrary(GhdlTool tool, std::filesystem::path folder, std::string hash)
      : tool_(std::move(tool)), folder_(std::move(folder)), hash_(std::move(hash)) {}
  std::string netlist(const std::string& entity, const Generics& generics, const std::string& ending) const;
  GhdlTool tool_;
  std::filesystem::path folder_;
  std::string hash_;
  std::vector<std::string> to_read_;  ///< names of the sources; used if nothing is analysed
};

/// Analyse the sources, run the testbench `top` with these options of GHDL, and return its output. A
/// testbench that fails is an error with the code `differs`.
Result<std::string> run_testbench(const std::string& top, const std::vector<VhdlSource>& sources,
                                  const std::vector<std::string>& options,
                                  const std::filesystem::path& cache);

}  // namespace halfway
