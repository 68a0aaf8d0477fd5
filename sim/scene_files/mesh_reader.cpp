// SPDX-License-Identifier: Apache-2.0
// halfway_mesh_reader: runs assimp in a separate process with limits on memory and time. `load_mesh` starts
// it.
//   halfway_mesh_reader FILE POLYGONS VERTICES
// The numbers are check_mesh_file's, '-' if the format does not give them. The reply (mesh_reply.hpp) is
// written to standard output, a file. Exit 0: a mesh, or the reason for refusing it; any other exit is a
// crash.
#include <assimp/BaseImporter.h>
#include <assimp/DefaultIOSystem.h>
#include <assimp/importerdesc.h>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <charconv>
#include <cmath>
#include <cstring>
#include <memory>
#include <new>
#include <string_view>
#include <utility>
#include <vector>

#include "mesh_files/number.hpp"
#include "scene/mesh.hpp"
#include "sim/scene_files/check_mesh_file.hpp"
#include "sim/scene_files/mesh_reply.hpp"
#include "sim/system/sanitizers.hpp"

namespace halfway {
namespace {

// Memory limit. assimp takes a few hundred MiB for a million triangles.
constexpr rlim_t c_memory_bytes = rlim_t{8} << 30;

class Refused {
 public:
  explicit Refused(std::string reason) : reason_(std::move(reason)) {}
  const std::string& reason() const { return reason_; }

 private:
  std::string reason_;
};

void keep_one_reader(Assimp::Importer& importer) {
  for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
    const std::string_view name = importer.GetImporterInfo(i)->mName;
    const std::string_view endings = importer.GetImporterInfo(i)->mFileExtensions;
    const bool is_gltf2 = name.starts_with("glTF2");
    if (is_gltf2) continue;
    const std::unique_ptr<Assimp::BaseImporter> unused(importer.GetImporter(i));
    importer.UnregisterLoader(unused.get());
  }
}

/// Opens regular files only, also for materials and buffers that a mesh file names, because a pipe or a
/// device may never end.
class RegularFiles final : public Assimp::DefaultIOSystem {
 public:
  bool Exists(const char* file) const override {
    std::error_code fault;
    return std::filesystem::is_regular_file(file, fault);
  }
  Assimp::IOStream* Open(const char* file, const char* mode) override {
    return Exists(file) ? DefaultIOSystem::Open(file, mode) : nullptr;
  }
};

struct Instance {
  const aiMesh* mesh;
  aiMatrix4x4 to_file;
};

std::vector<Instance> instances(const aiScene& scene) {
  std::vector<Instance> found;
  std::vector<std::pair<const aiNode*, aiMatrix4x4>> pending;
  pending.emplace_back(scene.mRootNode, aiMatrix4x4());
  std::uint64_t faces = 0;
  while (!pending.empty()) {
    const auto [node, to_parent] = pending.back();
    pending.pop_back();
    const aiMatrix4x4 to_file = to_parent * node->mTransformation;
    for (unsigned i = 0; i < node->mNumMeshes; ++i) {
      found.push_back({scene.mMeshes[node->mMeshes[i]], to_file});
      // Several nodes may use the same mesh.
      faces += found.back().mesh->mNumFaces;
      if (faces > c_max_triangles) {
        throw Refused(fmt::format("more than {} triangles; reduce the mesh", c_max_triangles));
      }
    }
    // In reverse, so that they are processed in the file's order.
    for (unsigned i = node->mNumChildren; i-- > 0;) pending.emplace_back(node->mChildren[i], to_file);
  }
  return found;
}

glm::dvec3 colour_of(const aiColor3D& colour) {
  return {static_cast<double>(colour.r), static_cast<double>(colour.g), static_cast<double>(colour.b)};
}

Material material_of(const aiMaterial& source, std::vector<std::string>& notes) {
  Material material;
  material.name = source.GetName().C_Str();
  float number = 0.0f;
  double exponent = material.exponent;
  aiColor4D base;
  if (source.Get(AI_MATKEY_BASE_COLOR, base) == aiReturn_SUCCESS) {
    material.colour = colour_of(aiColor3D(base.r, base.g, base.b));
  }
  double metal = 1.0;  // glTF's default
  if (source.Get(AI_MATKEY_METALLIC_FACTOR, number) == aiReturn_SUCCESS) metal = static_cast<double>(number);
  material.specular_colour = glm::dvec3(1.0 - metal) + metal * material.colour;
  if (source.Get(AI_MATKEY_ROUGHNESS_FACTOR, number) == aiReturn_SUCCESS) {
    const double roughness = std::max(static_cast<double>(number), 0.05);
    exponent = 2.0 / std::pow(roughness, 4.0) - 2.0;
    material.specular *= std::max(1.0 - roughness, 0.0);  // a rough surface has a weak highlight
  }
  for (const glm::dvec3& part : {material.colour, material.specular_colour}) {
    for (int channel = 0; channel < 3; ++channel) {
      if (!std::isfinite(part[channel]) || part[channel] < 0.0) {
        throw Refused(fmt::format("material '{}' has a colour that is negative or not finite; correct it",
                                  material.name));
      }
    }
  }
  if (!std::isfinite(exponent)) {
    throw Refused(fmt::format("material '{}' has an exponent that is not finite; correct it", material.name));
  }
  material.exponent = std::max(exponent, 1.0);
  if (exponent < 1.0 && material.specular > 0.0) {
    notes.push_back(fmt::format("material '{}': exponent {} raised to 1", material.name, exponent));
  }
  for (int type = aiTextureType_DIFFUSE; type <= AI_TEXTURE_TYPE_MAX; ++type) {
    if (source.GetTextureCount(static_cast<aiTextureType>(type)) == 0) continue;
    notes.push_back(fmt::format("material '{}': textures are left out", material.name));
    break;
  }
  return material;
}

void put_material(ReplySink& sink, const Material& material) {
  sink.put_text(material.name);
  sink.put(material.colour);
  sink.put(material.specular_colour);
  sink.put(material.diffuse);
  sink.put(material.specular);
  sink.put(material.exponent);
}

/// Read the file and write the reply. Throws Refused with the reason, without the file's name.
void import_file(const std::filesystem::path& path, const MeshFileSummary& summary, ReplySink& sink) {
  Assimp::Importer importer;
  importer.SetIOHandler(new RegularFiles);  // owned by the importer
  keep_one_reader(importer);
  const aiScene* scene = importer.ReadFile(path.string(), aiProcess_ValidateDataStructure);
  if (scene == nullptr) throw Refused(importer.GetErrorString());
  if (scene->mRootNode == nullptr || scene->mNumMeshes == 0) throw Refused("the mesh has no faces");

  const std::string ending = lower_case(path.extension().string());
  const bool is_gltf = ending == ".gltf" || ending == ".glb";
  std::vector<std::string> notes;
  std::uint64_t polygons = 0, points_and_lines = 0, vertices = 0, triangles_expected = 0;
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) {
    const aiMesh& mesh = *scene->mMeshes[m];
    vertices += mesh.mNumVertices;
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const unsigned corners = mesh.mFaces[f].mNumIndices;
      if (corners < 3) {
        ++points_and_lines;
      } else {
        ++polygons;
        triangles_expected += corners - 2;
      }
      for (unsigned i = 0; i < corners; ++i) {
        if (mesh.mFaces[f].mIndices[i] >= mesh.mNumVertices) {
          throw Refused(fmt::format("face {} names vertex {}, but the mesh has {}; correct the index", f,
                                    mesh.mFaces[f].mIndices[i], mesh.mNumVertices));
        }
      }
    }
    for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
      const aiVector3D& position = mesh.mVertices[v];
      if (std::isfinite(position.x) && std::isfinite(position.y) && std::isfinite(position.z)) continue;
      throw Refused(fmt::format("vertex {} of mesh '{}' has a coordinate that is not finite; correct it",
                                v + 1, mesh.mName.C_Str()));
    }
    if (mesh.HasVertexColors(0)) notes.push_back("vertex colours are left out");
    if (mesh.HasBones()) notes.push_back("bones are omitted: the mesh is in its bind pose");
  }
  if (polygons == 0) throw Refused("the mesh has no faces");
  if (triangles_expected > c_max_triangles) {
    throw Refused(fmt::format("{} triangles, but {} is the most; reduce the mesh", triangles_expected,
                              c_max_triangles));
  }
  if (summary.polygons.has_value() && *summary.polygons != polygons) {
    throw Refused(fmt::format("{} polygons in the file, but only {} can be read; it is damaged",
                              *summary.polygons, polygons));
  }
  if (summary.vertices.has_value() && *summary.vertices != vertices) {
    throw Refused(fmt::format("{} vertices in the file, but only {} can be read; it is damaged",
                              *summary.vertices, vertices));
  }
  if (points_and_lines > 0) notes.push_back(fmt::format("{} points and lines left out", points_and_lines));
  if (polygons < triangles_expected) scene = importer.ApplyPostProcessing(aiProcess_Triangulate);
  if (scene == nullptr) throw Refused(importer.GetErrorString());

  // Of PLY, assimp's material is its own; use the default material instead.
  const bool has_materials = is_gltf;
  const std::vector<Instance> parts = instances(*scene);
  std::vector<std::uint32_t> new_index(scene->mNumMaterials, UINT32_MAX);
  std::vector<Material> materials;
  for (const Instance& part : parts) {
    const unsigned index = part.mesh->mMaterialIndex;
    if (!has_materials || index >= scene->mNumMaterials || new_index[index] != UINT32_MAX) continue;
    new_index[index] = static_cast<std::uint32_t>(materials.size());
    materials.push_back(material_of(*scene->mMaterials[index], notes));
  }
  sink.put(ReplyKind::mesh);
  sink.put(static_cast<std::uint32_t>(materials.size()));
  for (const Material& material : materials) put_material(sink, material);
  std::sort(notes.begin(), notes.end());
  notes.erase(std::unique(notes.begin(), notes.end()), notes.end());
  sink.put(static_cast<std::uint32_t>(notes.size()));
  for (const std::string& note : notes) sink.put_text(note);

  sink.put(static_cast<std::uint32_t>(parts.size()));
  for (const Instance& part : parts) {
    const aiMesh& mesh = *part.mesh;
    glm::dmat4 to_file;
    for (unsigned column = 0; column < 4; ++column) {
      for (unsigned row = 0; row < 4; ++row) {
        to_file[static_cast<int>(column)][static_cast<int>(row)] =
            static_cast<double>(part.to_file[row][column]);
      }
    }
    sink.put(to_file);
    sink.put(has_materials ? new_index.at(mesh.mMaterialIndex) : 0u);
    sink.put(mesh.mNumVertices);
    for (unsigned v = 0; v < mesh.mNumVertices; ++v) sink.put(mesh.mVertices[v]);
    const bool has_normals = mesh.HasNormals();
    sink.put(has_normals);
    if (has_normals) {
      for (unsigned v = 0; v < mesh.mNumVertices; ++v) sink.put(mesh.mNormals[v]);
    }
    std::uint32_t triangles = 0;
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) triangles += mesh.mFaces[f].mNumIndices == 3 ? 1 : 0;
    sink.put(triangles);
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      if (face.mNumIndices == 3) sink.put(std::array{face.mIndices[0], face.mIndices[1], face.mIndices[2]});
    }
  }
  sink.finish();
}

void limit(int resource, rlim_t value) {
  rlimit old{};
  if (::getrlimit(static_cast<__rlimit_resource>(resource), &old) == 0) {
    const rlimit wanted{std::min(value, old.rlim_max), old.rlim_max};
    ::setrlimit(static_cast<__rlimit_resource>(resource), &wanted);
  }
}

std::optional<std::uint64_t> number_of(std::string_view text) {
  std::uint64_t number = 0;
  const auto end = std::from_chars(text.data(), text.data() + text.size(), number);
  if (end.ec != std::errc() || end.ptr != text.data() + text.size()) return std::nullopt;
  return number;
}

int run(int argument_count, char** arguments) {
  constexpr int c_arguments = 4;
  if (argument_count != c_arguments) {
    fmt::print(stderr, "halfway_mesh_reader: halfway runs it; usage: FILE POLYGONS VERTICES\n");
    return 2;
  }
  const std::filesystem::path path = arguments[1];
  MeshFileSummary summary;
  summary.polygons = number_of(arguments[2]);
  summary.vertices = number_of(arguments[3]);

  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, c_reader_cpu_seconds);
  if (!c_sanitized) limit(RLIMIT_AS, c_memory_bytes);
  // Output of libraries must not get into the reply.
  const int reply = ::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  if (reply < 0 || ::dup2(STDERR_FILENO, STDOUT_FILENO) < 0) return 1;
  std::string reason;
  try {
    ReplySink sink(reply);
    import_file(path, summary, sink);
    return 0;
  } catch (const Refused& refused) {
    reason = refused.reason();
  } catch (const std::bad_alloc&) {
    reason = fmt::format("reading it takes more than {} GiB; reduce the mesh", c_memory_bytes >> 30);
  } catch (const std::exception& exception) {
    reason = exception.what();
  } catch (...) {
    reason = "assimp failed";
  }
  try {
    if (::ftruncate(reply, 0) != 0 || ::lseek(reply, 0, SEEK_SET) != 0) return 1;
    ReplySink sink(reply);
    sink.put(ReplyKind::error);
    sink.put_text(reason);
    sink.finish();
    return 0;
  } catch (...) {
    return 1;
  }
}

}  // namespace
}  // namespace halfway

int main(int argument_count, char** arguments) {
  // Skip the libraries' clean-up, which may crash after a damaged file.
  ::_exit(halfway::run(argument_count, arguments));
}
