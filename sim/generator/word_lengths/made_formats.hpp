// SPDX-License-Identifier: Apache-2.0
// Setups and golden models with word lengths that are not compiled into the program. The same sources are
// compiled with other formats into a shared library, which is cached.
#pragma once

#include <memory>

#include "golden_run/golden_run.hpp"
#include "plan/hardware_key.hpp"
#include "setup/setup.hpp"
#include "sim/engines/ghdl/ghdl_library.hpp"
#include "sim/os/shared_library.hpp"
#include "words/generator/word_lengths.hpp"

namespace halfway {

/// Creates setups and golden models for keys with the word lengths that the library was compiled for.
class MadeFormats {
 public:
  /// Open the library for the key's shader, preset and word lengths. If it is not in the cache, compile it
  /// with the program's own compiler. Returns bad input if the program was built from other sources than the
  /// checkout's.
  static Result<std::shared_ptr<const MadeFormats>> open(const HardwareKey& key,
                                                         const SimulatorFolders& folders);

  std::unique_ptr<Setup> make_setup(const Scene& scene, FrameSize frame, const HardwareKey& key,
                                    const SetupOptions& options) const;
  std::unique_ptr<GoldenModel> make_golden_model(const HardwareKey& key) const;

 private:
  using MakeSetup = Setup*(const Scene&, const FrameSize&, const HardwareKey&, const SetupOptions&);
  using MakeGoldenModel = GoldenModel*(const HardwareKey&);
  explicit MadeFormats(SharedLibrary library) : library_(std::move(library)) {}
  SharedLibrary library_;
  MakeSetup* setup_ = nullptr;
  MakeGoldenModel* golden_model_ = nullptr;
};

/// The setup and the golden model of a key: from `formats`, or the program's own if it is null.
std::unique_ptr<Setup> make_setup(const Scene& scene, FrameSize frame, const HardwareKey& key,
                                  const SetupOptions& options, const MadeFormats* formats);
std::unique_ptr<GoldenModel> make_golden_model(const HardwareKey& key, const MadeFormats* formats);

}  // namespace halfway
