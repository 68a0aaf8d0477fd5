// SPDX-License-Identifier: Apache-2.0
// What a study keeps of a point: its frame as PNG, one JSON file with checksums of both, each written whole
// or not at all, and one line of a table.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "common/result.hpp"
#include "sim/study/design_point.hpp"
#include "sim/study/measure.hpp"

namespace halfway::study {

/// What a point's figures depend on beside the point: a record of another provenance is measured anew.
struct Provenance {
  std::string scene;       ///< by name
  std::string scene_hash;  ///< of all its numbers
  std::string program;     ///< hash of this program
  std::string rtl;         ///< hash of every file of the RTL
  std::string tools;       ///< versions of those that draw hardware, count and compare
};
/// Of all numbers of the scene that a picture depends on.
std::string scene_hash(const Scene& scene);

/// The scene is the one at tessellation 1.
Result<Provenance> provenance_of(const Scene& scene, const SimulatorFolders& folders);

/// Without the frame.
struct Record {
  DesignPoint point;
  Measurement measured;
  std::string picture{};  ///< checksum of the frame's file
};

/// By which the files of something are called, without ending: a point's by its name.
std::string record_name(const Provenance& provenance, const std::string& name);
std::string record_name(const Provenance& provenance, const DesignPoint& point);

/// Records of one study in a folder: two files a point.
class Records {
 public:
  Records(std::filesystem::path folder, Provenance provenance)
      : folder_(std::move(folder)), provenance_(std::move(provenance)) {}

  /// None where there is none of this provenance, or no frame of it; an error where either is damaged.
  Result<std::optional<Record>> find(const DesignPoint& point) const;
  Status add(const Record& record) const;
  /// Of a point whose record follows: what that has for Record::picture.
  Result<std::string> add_frame(const DesignPoint& point, const Frame& frame) const;
  std::filesystem::path file(const DesignPoint& point) const;
  std::filesystem::path picture(const DesignPoint& point) const;

 private:
  std::filesystem::path folder_;
  Provenance provenance_;
};

}  // namespace halfway::study
