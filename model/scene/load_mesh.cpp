// SPDX-License-Identifier: Apache-2.0
#include "scene/load_mesh.hpp"

#include <assimp/BaseImporter.h>
#include <assimp/DefaultIOSystem.h>
#include <assimp/importerdesc.h>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <memory>
#include <new>
#include <string_view>
#include <utility>

#include "scene/check_mesh_file.hpp"

namespace halfway {

namespace {

constexpr std::array<std::string_view, 5> c_endings = {".obj", ".ply", ".stl", ".gltf", ".glb"};

// What the child may take. A million triangles of OBJ take assimp 240 MiB.
constexpr rlim_t c_child_memory_bytes = rlim_t{8} << 30;
// Sanitizers reserve terabytes of addresses. GCC tells of itself by these names, Clang by __has_feature.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool c_limits_addresses = false;
#elif defined(__has_feature)
constexpr bool c_limits_addresses = !__has_feature(address_sanitizer) && !__has_feature(thread_sanitizer);
#else
constexpr bool c_limits_addresses = true;
#endif
constexpr rlim_t c_child_cpu_seconds = 300;
constexpr std::uintmax_t c_max_file_bytes = std::uintmax_t{4} << 30;

std::string lower_ending(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return ending;
}

// ---- What the child writes and the parent reads: plain values, one after the other.

class Sink {
 public:
  explicit Sink(int descriptor) : file_(::fdopen(descriptor, "wb")) {}
  template <class T>
  void put(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    if (std::fwrite(&value, sizeof value, 1, file_) != 1) throw std::bad_alloc();
  }
  void put_text(std::string_view text) {
    put(static_cast<std::uint64_t>(text.size()));
    for (const char c : text) put(c);
  }
  void finish() {
    if (std::fflush(file_) != 0) throw std::bad_alloc();
  }

 private:
  std::FILE* file_;
};

class Source {
 public:
  explicit Source(std::FILE* file) : file_(file) {}
  template <class T>
  T get() {
    T value{};
    if (std::fread(&value, sizeof value, 1, file_) != 1) failed_ = true;
    return value;
  }
  std::string get_text() {
    std::string text;
    for (auto left = get<std::uint64_t>(); left > 0 && !failed_; --left) text += get<char>();
    return text;
  }
  bool failed() const { return failed_; }

 private:
  std::FILE* file_;
  bool failed_ = false;
};

enum class Reply : std::uint8_t { mesh, error };

// ---- In the child

class Refused {
 public:
  explicit Refused(std::string reason) : reason_(std::move(reason)) {}
  const std::string& reason() const { return reason_; }

 private:
  std::string reason_;
};

void keep_four_readers(Assimp::Importer& importer) {
  for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
    const std::string_view name = importer.GetImporterInfo(i)->mName;
    const std::string_view endings = importer.GetImporterInfo(i)->mFileExtensions;
    const bool is_gltf2 = name.starts_with("glTF2");
    if (endings == "obj" || endings == "ply" || endings == "stl" || is_gltf2) continue;
    const std::unique_ptr<Assimp::BaseImporter> unused(importer.GetImporter(i));
    importer.UnregisterLoader(unused.get());
  }
}

/// Opens regular files alone, whatever a mesh file names as its materials or buffers: a pipe or a device may
/// never end.
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
      // Nodes may show one mesh any number of times.
      faces += found.back().mesh->mNumFaces;
      if (faces > c_max_triangles) {
        throw Refused(fmt::format("more than {} triangles; reduce the mesh", c_max_triangles));
      }
    }
    // From the back, so that they are taken in the file's order.
    for (unsigned i = node->mNumChildren; i-- > 0;) pending.emplace_back(node->mChildren[i], to_file);
  }
  return found;
}

glm::dvec3 colour_of(const aiColor3D& colour) {
  return {static_cast<double>(colour.r), static_cast<double>(colour.g), static_cast<double>(colour.b)};
}

Material material_of(const aiMaterial& source, bool is_gltf, std::vector<std::string>& notes) {
  Material material;
  material.name = source.GetName().C_Str();
  aiColor3D colour;
  float number = 0.0f;
  double exponent = material.exponent;
  if (is_gltf) {
    aiColor4D base;
    if (source.Get(AI_MATKEY_BASE_COLOR, base) == aiReturn_SUCCESS) {
      material.colour = colour_of(aiColor3D(base.r, base.g, base.b));
    }
    double metal = 1.0;  // glTF's default
    if (source.Get(AI_MATKEY_METALLIC_FACTOR, number) == aiReturn_SUCCESS)
      metal = static_cast<double>(number);
    material.specular_colour = glm::dvec3(1.0 - metal) + metal * material.colour;
    if (source.Get(AI_MATKEY_ROUGHNESS_FACTOR, number) == aiReturn_SUCCESS) {
      const double roughness = std::max(static_cast<double>(number), 0.05);
      exponent = 2.0 / std::pow(roughness, 4.0) - 2.0;
      material.specular *= std::max(1.0 - roughness, 0.0);  // a rough surface spreads its highlight thin
    }
  } else {
    material.diffuse = 1.0;
    material.specular = 0.0;
    if (source.Get(AI_MATKEY_COLOR_DIFFUSE, colour) == aiReturn_SUCCESS) material.colour = colour_of(colour);
    if (source.Get(AI_MATKEY_COLOR_SPECULAR, colour) == aiReturn_SUCCESS && !colour.IsBlack()) {
      material.specular_colour = colour_of(colour);
      material.specular = 1.0;
    }
    if (material.colour == glm::dvec3(0.0)) material.diffuse = 0.0;
    if (source.Get(AI_MATKEY_SHININESS, number) == aiReturn_SUCCESS) exponent = static_cast<double>(number);
  }
  for (const glm::dvec3& part : {material.colour, material.specular_colour}) {
    for (int channel = 0; channel < 3; ++channel) {
      if (!std::isfinite(part[channel]) || part[channel] < 0.0) {
        throw Refused(
            fmt::format("material '{}' has a colour that is negative or not finite; mend it", material.name));
      }
    }
  }
  if (!std::isfinite(exponent)) {
    throw Refused(fmt::format("material '{}' has an exponent that is not finite; mend it", material.name));
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

void put_material(Sink& sink, const Material& material) {
  sink.put_text(material.name);
  sink.put(material.colour);
  sink.put(material.specular_colour);
  sink.put(material.diffuse);
  sink.put(material.specular);
  sink.put(material.exponent);
}

Material get_material(Source& source) {
  Material material;
  material.name = source.get_text();
  material.colour = source.get<glm::dvec3>();
  material.specular_colour = source.get<glm::dvec3>();
  material.diffuse = source.get<double>();
  material.specular = source.get<double>();
  material.exponent = source.get<double>();
  return material;
}

/// Does the child's whole work; throws Refused with the reason, without the file's name.
void import_file(const std::filesystem::path& path, const MeshFileSummary& summary, Sink& sink) {
  Assimp::Importer importer;
  importer.SetIOHandler(new RegularFiles);  // which the importer owns
  keep_four_readers(importer);
  const aiScene* scene = importer.ReadFile(path.string(), aiProcess_ValidateDataStructure);
  if (scene == nullptr) throw Refused(importer.GetErrorString());
  if (scene->mRootNode == nullptr || scene->mNumMeshes == 0) throw Refused("the mesh has no faces");

  const std::string ending = lower_ending(path);
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
          throw Refused(fmt::format("face {} names vertex {}, but the mesh has {}; mend the index", f,
                                    mesh.mFaces[f].mIndices[i], mesh.mNumVertices));
        }
      }
    }
    for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
      const aiVector3D& position = mesh.mVertices[v];
      if (std::isfinite(position.x) && std::isfinite(position.y) && std::isfinite(position.z)) continue;
      throw Refused(fmt::format("vertex {} of mesh '{}' has a coordinate that is not finite; mend it", v + 1,
                                mesh.mName.C_Str()));
    }
    if (mesh.HasVertexColors(0)) notes.push_back("vertex colours are left out");
    if (mesh.HasBones()) notes.push_back("bones are left out: the mesh stands in its bind pose");
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

  // assimp gives a file without materials one of its own; ours is better.
  const bool has_materials = is_gltf || summary.has_materials;
  const std::vector<Instance> parts = instances(*scene);
  std::vector<std::uint32_t> new_index(scene->mNumMaterials, UINT32_MAX);
  std::vector<Material> materials;
  for (const Instance& part : parts) {
    const unsigned index = part.mesh->mMaterialIndex;
    if (!has_materials || index >= scene->mNumMaterials || new_index[index] != UINT32_MAX) continue;
    new_index[index] = static_cast<std::uint32_t>(materials.size());
    materials.push_back(material_of(*scene->mMaterials[index], is_gltf, notes));
  }
  sink.put(Reply::mesh);
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
    const bool has_normals = mesh.HasNormals() && lower_ending(path) != ".stl";  // STL's are the facets'
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

[[noreturn]] void run_child(const std::filesystem::path& path, const MeshFileSummary& summary,
                            int descriptor) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // nothing runs on after us, whatever kills us
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, c_child_cpu_seconds);
  if (c_limits_addresses) limit(RLIMIT_AS, c_child_memory_bytes);
  // What a dying library prints would stand before our own message.
  const int null = ::open("/dev/null", O_WRONLY);
  if (null >= 0) {
    ::dup2(null, STDOUT_FILENO);
    ::dup2(null, STDERR_FILENO);
  }
  std::string reason;
  try {
    Sink sink(descriptor);
    import_file(path, summary, sink);
    ::_exit(0);
  } catch (const Refused& refused) {
    reason = refused.reason();
  } catch (const std::bad_alloc&) {
    reason = fmt::format("reading it takes more than {} GiB; reduce the mesh", c_child_memory_bytes >> 30);
  } catch (const std::exception& exception) {
    reason = exception.what();
  } catch (...) {
    reason = "assimp failed";
  }
  try {
    if (::ftruncate(descriptor, 0) != 0 || ::lseek(descriptor, 0, SEEK_SET) != 0) ::_exit(1);
    Sink sink(descriptor);
    sink.put(Reply::error);
    sink.put_text(reason);
    sink.finish();
    ::_exit(0);
  } catch (...) {
    ::_exit(1);
  }
}

// ---- In the parent

/// Runs the import in a child; the file that holds its reply.
Result<std::unique_ptr<std::FILE, int (*)(std::FILE*)>> import_in_child(const std::filesystem::path& path,
                                                                        const MeshFileSummary& summary) {
  const std::string name = path.string();
  const int descriptor = ::memfd_create("halfway-mesh", MFD_CLOEXEC);
  if (descriptor < 0) return tool_failed(name + ": no memory file for the reader; free some memory");
  // Else the child would print again what the parent has yet to print.
  std::fflush(nullptr);
  const pid_t child = ::fork();
  if (child == 0) run_child(path, summary, descriptor);
  if (child < 0) {
    ::close(descriptor);
    return tool_failed(name + ": no process for the reader; free some memory");
  }
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> reply(::fdopen(descriptor, "rb"), &std::fclose);
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU) {
      return bad_input(
          fmt::format("{}: reading it takes more than {} s; reduce the mesh", name, c_child_cpu_seconds));
    }
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL) {
      return bad_input(name + ": the reader was killed, perhaps for want of memory; reduce the mesh");
    }
    return bad_input(name + ": the reader broke on it; the file is damaged, export it anew");
  }
  if (reply == nullptr || std::fseek(reply.get(), 0, SEEK_SET) != 0) {
    return tool_failed(name + ": the reader's reply cannot be read");
  }
  return reply;
}

void append_instance(Source& source, Mesh& mesh) {
  Mesh part;
  const auto to_file = source.get<glm::dmat4>();
  const auto material = source.get<std::uint32_t>();
  const auto get_vectors = [&source](std::uint32_t count, std::vector<glm::dvec3>& vectors) {
    for (std::uint32_t i = 0; i < count && !source.failed(); ++i) {
      const auto v = source.get<std::array<float, 3>>();
      vectors.emplace_back(static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2]));
    }
  };
  const auto vertices = source.get<std::uint32_t>();
  get_vectors(vertices, part.positions);
  const bool has_normals = source.get<bool>();
  if (has_normals) {
    get_vectors(vertices, part.normals);
  } else {
    part.normals.emplace_back(0.0);
  }
  const auto triangles = source.get<std::uint32_t>();
  for (std::uint32_t i = 0; i < triangles && !source.failed(); ++i) {
    const auto index = source.get<std::array<std::uint32_t, 3>>();
    part.triangles.push_back({index, has_normals ? index : std::array<std::uint32_t, 3>{}, material});
  }
  if (to_file != glm::dmat4(1.0)) transform(part, to_file);

  const auto first_position = static_cast<std::uint32_t>(mesh.positions.size());
  const auto first_normal = static_cast<std::uint32_t>(mesh.normals.size());
  mesh.positions.insert(mesh.positions.end(), part.positions.begin(), part.positions.end());
  mesh.normals.insert(mesh.normals.end(), part.normals.begin(), part.normals.end());
  for (SceneTriangle& triangle : part.triangles) {
    for (int corner = 0; corner < 3; ++corner) {
      triangle.position[corner] += first_position;
      triangle.normal[corner] += first_normal;
    }
    mesh.triangles.push_back(triangle);
  }
}

}  // namespace

bool is_mesh_file_name(const std::filesystem::path& path) {
  return std::find(c_endings.begin(), c_endings.end(), lower_ending(path)) != c_endings.end();
}

Status check_readable(const std::filesystem::path& path) {
  const std::string name = path.string();
  std::error_code fault;
  const std::filesystem::file_status status = std::filesystem::status(path, fault);
  if (!std::filesystem::exists(status)) return bad_input(name + ": no such file; check the path");
  if (std::filesystem::is_directory(status)) return bad_input(name + ": a directory; name a file in it");
  // A pipe or a device may never end.
  if (!std::filesystem::is_regular_file(status))
    return bad_input(name + ": not a regular file; copy it to one");
  if (!std::ifstream(path)) return bad_input(name + ": cannot be read; check its permissions");
  const std::uintmax_t size = std::filesystem::file_size(path, fault);
  if (fault) return bad_input(name + ": cannot be read: " + fault.message());
  if (size == 0) return bad_input(name + ": the file is empty");
  if (size > c_max_file_bytes) {
    return bad_input(fmt::format("{}: larger than {} GiB; reduce the mesh", name, c_max_file_bytes >> 30));
  }
  return Ok{};
}

Result<LoadedMesh> load_mesh(const std::filesystem::path& path) {
  const std::string name = path.string();
  if (!is_mesh_file_name(path)) {
    return bad_input(name + ": not a mesh file by its name; .obj, .ply, .stl, .gltf and .glb can be read");
  }
  if (Status ok = check_readable(path); !ok) return ok.error();
  Result<MeshFileSummary> summary = check_mesh_file(path);
  if (!summary) return summary.error();
  if (summary->polygons == 0u) return bad_input(name + ": the mesh has no faces; export it with faces");

  auto reply = import_in_child(path, *summary);
  if (!reply) return reply.error();
  Source source(reply->get());
  if (source.get<Reply>() == Reply::error) return bad_input(name + ": " + source.get_text());

  LoadedMesh loaded;
  if (lower_ending(path) == ".stl") loaded.default_crease_degrees = c_stl_crease_degrees;
  for (auto left = source.get<std::uint32_t>(); left > 0 && !source.failed(); --left) {
    loaded.mesh.materials.push_back(get_material(source));
  }
  for (const std::string& library : summary->missing_libraries) {
    loaded.notes.push_back(
        fmt::format("{}: material library {} cannot be read; what it would colour is grey", name, library));
  }
  for (auto left = source.get<std::uint32_t>(); left > 0 && !source.failed(); --left) {
    loaded.notes.push_back(name + ": " + source.get_text());
  }
  for (auto left = source.get<std::uint32_t>(); left > 0 && !source.failed(); --left) {
    append_instance(source, loaded.mesh);
  }
  if (source.failed()) return tool_failed(name + ": the reader's reply is cut off");
  if (loaded.mesh.materials.empty()) {
    loaded.mesh.materials.emplace_back();
    loaded.mesh.materials.back().name = "default";
    for (SceneTriangle& triangle : loaded.mesh.triangles) triangle.material = 0;
  }
  join_positions(loaded.mesh);
  return loaded;
}

}  // namespace halfway
