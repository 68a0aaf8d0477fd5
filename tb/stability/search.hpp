// SPDX-License-Identifier: Apache-2.0
// Randomized search. Makes inputs from seeds and compares golden model with specification, and RTL with
// golden model, until an input fails. That input is shrunk and kept as a regression.
//
// A search is a class (triangle_search.cpp) and an entry of c_searches in search_main.cpp. It defines the
// parameters of an input, makes inputs and checks them. An input is a list of integers, so all searches share
// the driver (seeds, threads, progress, page), the shrinker and the files of regressions.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/result.hpp"
#include "sim/ghdl/ghdl_library.hpp"
#include "stability/trial.hpp"

namespace halfway::stability {

struct Parameter {
  std::string_view name;  ///< in the files of regressions
  std::int64_t simplest, least, greatest;
  std::int64_t grain = 1;  ///< values at multiples of it from `simplest` are simpler than the values between
};

/// One value for each parameter.
using Input = std::vector<std::int64_t>;

/// An input for which a property does not hold. Shrinking keeps the quantity.
struct Failure {
  std::string quantity;  ///< a word
  std::string what;
};

/// Results so far.
struct Tally {
  std::uint64_t inputs = 0, fragments = 0, rtl_inputs = 0, rtl_fragments = 0;
  std::map<std::string, Worst> worst{};  ///< worst figure of each quantity; one figure per input
  void add(const Tally& other);
};

/// The figures of one input. The first one above its bound is the failure.
class InputFigures {
 public:
  explicit InputFigures(Tally& tally) : tally_(tally) {}
  /// Adds the worst figure of a quantity. Ignored if it has no figure.
  void add(const char* quantity, const Worst& worst);
  const std::optional<Failure>& failure() const { return failure_; }

 private:
  Tally& tally_;
  std::optional<Failure> failure_;
};

/// Adds `inputs` inputs, drawn by the trial, to the tally. Returns the failure if RTL and golden model
/// differ, and an error if a tool is missing or broke.
Result<std::optional<Failure>> rtl_failure(const Trial& trial, std::uint64_t inputs, Tally& tally);

/// Checks the inputs of one thread. It may keep models and simulators between inputs.
class Checker {
 public:
  virtual ~Checker() = default;
  /// Compares the golden model with the specification.
  virtual std::optional<Failure> check(const Input& input, Tally& tally) = 0;
  /// Compares the RTL with the golden model, one input after the other in the same hardware. Fails if a tool
  /// is missing or broke.
  virtual Result<std::optional<Failure>> check_rtl(std::span<const Input> inputs, Tally& tally) = 0;
};

class Search {
 public:
  virtual ~Search() = default;
  virtual std::string_view name() const = 0;   ///< the kind of inputs, in the plural
  virtual std::string_view about() const = 0;  ///< one or two sentences for the page
  virtual std::span<const Parameter> parameters() const = 0;
  /// Gives the same input for the same seed, independent of previous calls, and other inputs for other seeds.
  virtual Input make(std::uint32_t seed) const = 0;
  /// Inputs that may be simpler than this one and differ from it in several parameters. The shrinker itself
  /// tries each parameter alone.
  virtual std::vector<Input> simpler(const Input& /*input*/) const { return {}; }
  /// With `quick`, leaves out hardware that takes minutes to build.
  virtual std::unique_ptr<Checker> checker(const SimulatorFolders& folders, bool quick) const = 0;

  virtual std::uint64_t full_count() const = 0;   ///< inputs of `make search`
  virtual std::uint64_t quick_count() const = 0;  ///< of `make test`
  virtual std::uint64_t rtl_every() const = 0;    ///< one batch in so many is checked in the RTL
};

}  // namespace halfway::stability
