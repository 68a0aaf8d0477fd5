// SPDX-License-Identifier: Apache-2.0
// glTF 2.0, as .gltf and .glb.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "common/result.hpp"
#include "mesh_files/loaded_mesh.hpp"

namespace halfway {

/// A file with the bytes of a buffer.
struct BufferFile {
  /// Not empty: why it cannot be read. It follows the file's name.
  std::string refusal;
  std::string bytes;
};
/// Read the file of this name, which is in the folder of the glTF file or below.
using ReadBuffer = std::function<BufferFile(std::string_view name)>;

/// Read a glTF file from its bytes. `file` is its name in messages. Refusals name the line of faulty JSON, or
/// the object, as in "file: meshes[0].primitives[1].indices: ".
///
/// Read: the nodes of the scene that the file selects, of its first scene, or of all root nodes if there is
/// none; their transforms; triangles, strips and fans with POSITION and NORMAL, indexed or not, interleaved
/// or sparse; the materials that primitives use. Every index, count and length of buffers, accessors, meshes
/// and nodes is checked, and a value of another type is refused there. Keys that are not read are not
/// checked. Buffers are in the file, in base64, or files of their own.
/// Materials: the base colour is the colour; a roughness r gives the exponent 2 / r^4 - 2, at least 1, and
/// the factor 1 - r on k_s; the highlight of a metal has its colour. Other values are those of the default
/// material. A material that cannot be read is the default one, with a note.
/// Left out with a note: points and lines, textures, colours of vertices, bones (the mesh is in its bind
/// pose), morph targets, all other keys and extensions. A required extension that is not drawn is refused.
Result<LoadedMesh> read_gltf(std::string_view bytes, std::string_view file, const ReadBuffer& read_buffer);

}  // namespace halfway
