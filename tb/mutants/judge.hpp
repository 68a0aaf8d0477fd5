// SPDX-License-Identifier: Apache-2.0
// The project's tests, ready to be run on RTL with a fault in it: every testbench, and small frames of every
// shader, whose fragments the golden model has said.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "common/result.hpp"
#include "plan/hardware_key.hpp"
#include "sim/ghdl/ghdl_library.hpp"
#include "sim/system/file.hpp"

namespace halfway::mutants {

struct Folders {
  std::filesystem::path source;   ///< the project's root
  std::filesystem::path vectors;  ///< what halfway_vectors wrote
  std::filesystem::path scratch;  ///< for what is built
};

/// A file of the RTL with something else in it; `file` empty: the RTL as it is.
struct Exchanged {
  std::string file;  ///< relative to rtl/
  std::string content;
};

enum class Verdict {
  stillborn,  ///< cannot be analysed or elaborated: no hardware at all
  killed,
  killed_by_time,  ///< simulated twice the time that it should, or took the processor for four times as long
  survived,
};

/// A testbench, or a frame.
struct Test {
  std::string name;  ///< saturate; or the frame's scene and hardware
  std::string top;   ///< the entity that GHDL elaborates
  std::vector<std::string> arguments;
  std::set<std::string> uses;      ///< files of rtl/, through all levels
  std::filesystem::path golden{};  ///< the trace that a frame must have; empty: a testbench
  HardwareKey key{};               ///< of a frame
  std::filesystem::path init{};    ///< of a frame
  double seconds = 60;             ///< that it takes without a fault
  std::uint64_t ends_ns = 0;       ///< of simulated time, without a fault; 0: not known, or a frame's
  std::string hash{};              ///< of all that it reads
};

/// Answers by the hash of what was asked, in a file that grows.
class Remembered {
 public:
  explicit Remembered(std::filesystem::path path);
  std::optional<std::string> find(const std::string& key) const;
  void add(const std::string& key, const std::string& answer);

 private:
  std::filesystem::path path_;
  mutable std::mutex mutex_;
  std::map<std::string, std::string> answers_;
};

class Judge {
 public:
  /// Analyses all, makes the frames' traces, and runs every test without a fault: an error where one fails.
  /// Without frames the testbenches are taken to pass, as ctest has them tried.
  /// `told` hears what is being done.
  static Result<Judge> open(const Folders& folders, unsigned workers, bool with_frames,
                            const std::function<void(const std::string&)>& told);

  const std::vector<VhdlSource>& rtl() const { return rtl_; }
  /// What testbenches and frames are made of, in compile order, the RTL left out.
  const std::vector<VhdlSource>& testbench_sources() const { return testbench_sources_; }
  const std::vector<Test>& testbenches() const { return testbenches_; }
  const std::vector<Test>& frames() const { return frames_; }
  const Folders& folders() const { return folders_; }
  Remembered& remembered() const { return *remembered_; }
  /// A folder in which everything is analysed, with the change.
  class Bench {
   public:
    /// What it came to before, with all as it is now, is not run again.
    Result<Verdict> run(const Test& test);

   private:
    friend class Judge;
    Bench(const Judge& judge, Exchanged exchanged) : judge_(judge), exchanged_(std::move(exchanged)) {}
    /// `output` of the simulation, where it is asked for.
    Result<Verdict> run_anew(const Test& test, std::string* output = nullptr);
    Status make();
    const Judge& judge_;
    Exchanged exchanged_;
    std::optional<TemporaryFolder> folder_{};  ///< made when it is needed
  };
  Bench bench(Exchanged exchanged) const { return Bench(*this, std::move(exchanged)); }

  /// Draws the frame through GHDL's netlist in Verilator, which sees what is hardware alone.
  Result<Verdict> run_verilated(const Test& frame, const Exchanged& exchanged) const;

 private:
  Status prepare(unsigned workers, bool with_frames, const std::function<void(const std::string&)>& told);
  Status add_frames(std::vector<VhdlSource>& sources);

  Folders folders_;
  std::vector<VhdlSource> rtl_, testbench_sources_;
  std::vector<Test> testbenches_, frames_;
  std::filesystem::path library_;
  GhdlBackEnd back_end_ = GhdlBackEnd::mcode;
  std::unique_ptr<Remembered> remembered_;
};

/// Runs `work` on 0 to count - 1 on so many threads.
void in_parallel(unsigned workers, std::size_t count, const std::function<void(std::size_t)>& work);

}  // namespace halfway::mutants
