// SPDX-License-Identifier: Apache-2.0
// Stored results of a point: its frame as PNG, and its figures as JSON, written last. Each file is written
// atomically.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "sim/study/design_point.hpp"
#include "sim/study/measure.hpp"

namespace halfway::study {

/// Everything that a point's results depend on, except the point itself. A record of another provenance is
/// not used, and the point is measured again.
struct Provenance {
  std::string scene;       ///< by name
  std::string scene_hash;  ///< over all numbers of the scene
  std::string program;     ///< hash of this program and of halfway_mesa
  std::string rtl;         ///< hash of every file of the RTL
  std::string tools;       ///< versions of the tools that simulate, count and compare
};
/// Hash of all numbers of the scene that affect a picture.
std::string scene_hash(const Scene& scene);

/// `scene` must have tessellation 1.
Provenance provenance_of(const Scene& scene, const SimulatorFolders& folders);

/// Results without the frame.
struct Record {
  DesignPoint point;
  Measurement measured;
};

/// Base name, without extension, of the files of the object called `name`, for example a point.
std::string record_name(const Provenance& provenance, const std::string& name);
std::string record_name(const Provenance& provenance, const DesignPoint& point);

/// Records of one study in a folder: two files per point.
class Records {
 public:
  Records(std::filesystem::path folder, Provenance provenance)
      : folder_(std::move(folder)), provenance_(std::move(provenance)) {}

  /// std::nullopt if there is no readable record, or no frame, of this provenance.
  std::optional<Record> find(const DesignPoint& point) const;
  void add(const Record& record) const;
  /// Store the frame of a point before its record.
  void add_frame(const DesignPoint& point, const Frame& frame) const;
  std::filesystem::path file(const DesignPoint& point) const;
  std::filesystem::path picture(const DesignPoint& point) const;

 private:
  std::filesystem::path folder_;
  Provenance provenance_;
};

}  // namespace halfway::study
