// SPDX-License-Identifier: Apache-2.0
// A scene from text, and its changes by a viewer: camera, lights and exponents.
#pragma once

#include <string>
#include <string_view>

#include "common/result.hpp"
#include "frame/frame_size.hpp"
#include "scene/scene.hpp"

namespace halfway::live {

/// The initial values draw the scene's own frame, except for its size. Angles are in degrees.
struct Settings {
  double width = 640.0, height = 480.0;
  double azimuth = 0.0, elevation = 0.0;  ///< of the camera around its target: see orbited()
  double distance_factor = 1.0;
  double exponent_factor = 1.0;  ///< of every highlight's exponent, which stays at least 1
  /// Turn every light around the camera's target: about `up_world`, counter-clockwise seen from above, then
  /// upwards as seen by the scene's camera.
  double light_azimuth = 0.0, light_elevation = 0.0;
  double threshold = 2.0;  ///< of the quadratic and spherical set-ups

  FrameSize size() const;
};

/// Refuse values outside their range.
Status check(const Settings& settings);

/// Read a scene file (.toml) or a single mesh (.obj, .ply, .stl, .gltf, .glb), by the ending of the file's
/// name. There are no other files: a scene cannot name mesh files, an OBJ's material libraries are not read,
/// and a glTF file that names the file of a buffer is refused.
Result<Scene> read_scene(std::string_view file, std::string_view text, double tessellation);

/// A scene that is changed in place, so that a large mesh is not copied for each frame.
class LiveScene {
 public:
  explicit LiveScene(Scene scene);
  /// Change the scene as in its file by valid settings. Returns bad input if the camera has no view.
  Status apply(const Settings& settings);
  const Scene& scene() const { return scene_; }

 private:
  void turn_lights(const Settings& settings);

  Scene scene_;
  Scene own_;  ///< as in the file; without a mesh
};

}  // namespace halfway::live
