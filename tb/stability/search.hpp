// SPDX-License-Identifier: Apache-2.0
// Randomized search: inputs made from seeds, golden model against specification and RTL against golden model,
// until one fails; that one is shrunk and kept as a regression.
//
// A search is a class of its own (triangle_search.cpp), an entry of c_searches in search_main.cpp. It names
// the parameters of an input, makes inputs and checks them. The driver (seeds, threads, progress, page), the
// shrinker and the regressions' files are the same for all, because an input is a list of integers.
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
  std::string_view name;  ///< in the regressions' files
  std::int64_t simplest, least, greatest;
  std::int64_t grain = 1;  ///< multiples of it off the simplest are simpler than what lies between
};

/// A value for each parameter.
using Input = std::vector<std::int64_t>;

/// An input whose property does not hold. What is shrunk keeps its quantity.
struct Failure {
  std::string quantity;  ///< a word
  std::string what;
};

/// What was seen so far.
struct Tally {
  std::uint64_t inputs = 0, fragments = 0, rtl_inputs = 0, rtl_fragments = 0;
  std::map<std::string, Worst> worst{};  ///< by quantity, a figure for each input
  void add(const Tally& other);
};

/// The figures of one input. The first that exceeds its bound is the failure.
class InputFigures {
 public:
  explicit InputFigures(Tally& tally) : tally_(tally) {}
  /// The worst of a quantity; not taken if it has no figure.
  void add(const char* quantity, const Worst& worst);
  const std::optional<Failure>& failure() const { return failure_; }

 private:
  Tally& tally_;
  std::optional<Failure> failure_;
};

/// Adds `inputs` inputs that the trial has drawn to the tally. The failure is a difference of RTL and golden
/// model, an error is a tool that is missing or broke.
Result<std::optional<Failure>> rtl_failure(const Trial& trial, std::uint64_t inputs, Tally& tally);

/// What one thread checks inputs with: it may keep models and simulators from one to the next.
class Checker {
 public:
  virtual ~Checker() = default;
  /// The golden model against the specification.
  virtual std::optional<Failure> check(const Input& input, Tally& tally) = 0;
  /// The RTL against the golden model, one input after the other through the same hardware. An error is a
  /// tool that is missing or broke.
  virtual Result<std::optional<Failure>> check_rtl(std::span<const Input> inputs, Tally& tally) = 0;
};

class Search {
 public:
  virtual ~Search() = default;
  virtual std::string_view name() const = 0;   ///< what it searches through, a plural
  virtual std::string_view about() const = 0;  ///< for the page, a sentence or two
  virtual std::span<const Parameter> parameters() const = 0;
  /// The same input for the same seed, whatever came before; another for another.
  virtual Input make(std::uint32_t seed) const = 0;
  /// Inputs that may be simpler than this one and differ from it in several parameters at once; the shrinker
  /// tries each parameter alone by itself.
  virtual std::vector<Input> simpler(const Input& /*input*/) const { return {}; }
  /// A quick one leaves out hardware that takes minutes to build.
  virtual std::unique_ptr<Checker> checker(const SimulatorFolders& folders, bool quick) const = 0;

  virtual std::uint64_t full_count() const = 0;   ///< inputs of `make search`
  virtual std::uint64_t quick_count() const = 0;  ///< of `make test`
  virtual std::uint64_t rtl_every() const = 0;    ///< one batch in so many goes through the RTL
};

}  // namespace halfway::stability
