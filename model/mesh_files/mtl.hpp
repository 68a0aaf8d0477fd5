// SPDX-License-Identifier: Apache-2.0
// Material libraries of OBJ files.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>

#include "mesh_files/notes.hpp"
#include "scene/scene.hpp"

namespace halfway {

struct MtlMaterial {
  Material material;
  double file_exponent = 0.0;   ///< Ns; below 1 the material's exponent is 1
  std::optional<double> d, tr;  ///< opacity and transparency
  bool has_textures = false;
  /// d, because some files have Tr = 1 too.
  double opacity() const { return d.value_or(1.0 - tr.value_or(0.0)); }
};
using MtlMaterials = std::unordered_map<std::string, MtlMaterial>;

/// A material without Kd, Ks and Ns: grey, without a highlight.
Material plain_material(std::string_view name);

/// Add the materials of a library. Repeated keys and definitions replace earlier ones. A line that cannot be
/// read is left out with a note. `file` is the library's name in notes.
void read_mtl(std::string_view text, std::string_view file, MtlMaterials& materials, Notes& notes);

}  // namespace halfway
