// SPDX-License-Identifier: Apache-2.0
// Replays a design's vectors on its compiled netlist and names the first output that differs.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mutants/design.hpp"
#include "mutants/model_harness.hpp"
#include "sim/os/shared_library.hpp"

namespace halfway::mutants {

/// The bits of a port, lowest byte first.
using Word = std::vector<std::uint8_t>;

/// One vector file, with one row of words per line.
struct VectorFile {
  std::string name;
  std::vector<std::vector<Word>> rows;
};

// Readers throw Failure.

/// Reads a file in the format of sim/files/vector_file.hpp. A column "name/3" joins three words.
VectorFile read_vectors(const std::filesystem::path& file, const std::string& columns, unsigned skip);

/// The vector files of a design. They are read once for all faults.
struct DesignVectors {
  struct Set {
    std::string name;
    std::vector<VectorFile> files;  ///< rows: one file; streams: the files of the inputs, then of the outputs
  };
  std::vector<Set> sets;
};
DesignVectors read_design_vectors(const Design& design, const std::filesystem::path& folder);

/// The compiled netlist of a design with all its faults.
class CompiledNetlist {
 public:
  explicit CompiledNetlist(SharedLibrary library);

  void* (*create)() = nullptr;
  void (*destroy)(void*) = nullptr;
  void (*eval)(void*) = nullptr;
  std::uint32_t (*ports)(void*, ModelPort*) = nullptr;

 private:
  SharedLibrary library_;
};

/// The first difference that the vectors show with fault number `fault` (0: no fault). Empty if all is equal.
std::optional<std::string> replay(const Design& design, const DesignVectors& vectors,
                                  const CompiledNetlist& netlist, std::uint32_t fault);

}  // namespace halfway::mutants
