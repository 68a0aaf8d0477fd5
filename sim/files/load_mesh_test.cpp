// SPDX-License-Identifier: Apache-2.0
#include "sim/files/load_mesh.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "common/test/is_error.hpp"
#include "mesh_files/test/spelling.hpp"
#include "projection/project.hpp"
#include "scene_files/parse_scene.hpp"
#include "sim/os/file.hpp"
#include "sim/os/must.hpp"

namespace halfway {
namespace {

template <class T>
std::string bytes(const std::vector<T>& values) {
  std::string result(values.size() * sizeof(T), '\0');
  std::memcpy(result.data(), values.data(), result.size());
  return result;
}

// The same square pyramid with apex (0, 0, 1) in every format: 4 triangles and a square base, or 6 triangles.
const std::string c_obj =
    "# pyramid\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nv 0 0 1\n"
    "f 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\nf 4 3 2 1\n";
const std::string c_ply_header =
    "element vertex 5\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 5\nproperty list uchar int vertex_indices\nend_header\n";
const std::string c_ply_ascii = "ply\nformat ascii 1.0\n" + c_ply_header +
                                "-1 -1 0\n1 -1 0\n1 1 0\n-1 1 0\n0 0 1\n"
                                "3 0 1 4\n3 1 2 4\n3 2 3 4\n3 3 0 4\n4 3 2 1 0\n";
const std::vector<float> c_positions = {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0, 0, 0, 1};
const std::vector<std::uint16_t> c_indices = {0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4, 3, 2, 1, 3, 1, 0};

std::string ply_binary() {
  std::string text = "ply\nformat binary_little_endian 1.0\n" + c_ply_header + bytes(c_positions);
  for (const std::vector<std::int32_t>& face :
       std::vector<std::vector<std::int32_t>>{{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}, {3, 2, 1, 0}}) {
    text += static_cast<char>(face.size()) + bytes(face);
  }
  return text;
}

std::string stl_binary() {
  std::string text(80, ' ');
  text += bytes(std::vector<std::uint32_t>{6});
  for (std::size_t t = 0; t < 6; ++t) {
    text += bytes(std::vector<float>{0, 0, 0});
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t v = c_indices[3 * t + c];
      text += bytes(std::vector<float>{c_positions[3 * v], c_positions[3 * v + 1], c_positions[3 * v + 2]});
    }
    text += std::string(2, '\0');
  }
  return text;
}

std::string stl_ascii() {
  std::string text = "solid pyramid\n";
  for (std::size_t t = 0; t < 6; ++t) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (std::size_t c = 0; c < 3; ++c) {
      text += "vertex";
      for (std::size_t k = 0; k < 3; ++k)
        text += " " + std::to_string(c_positions[3 * c_indices[3 * t + c] + k]);
      text += "\n";
    }
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid pyramid\n";
}

const std::string c_buffer = bytes(c_positions) + bytes(c_indices);

std::string gltf_json(const std::string& buffer_uri, const std::string& count = "18") {
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],)"
         R"("nodes":[{"children":[1],"translation":[10,0,0]},{"mesh":0,"scale":[2,2,2]}],)"
         R"("materials":[{"name":"gold","pbrMetallicRoughness":{"baseColorFactor":[0.8,0.6,0.2,1],)"
         R"("metallicFactor":1,"roughnessFactor":0.5}}],)"
         R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"material":0}]}],)"
         R"("buffers":[{"byteLength":96)" +
         buffer_uri +
         R"(}],"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":60},{"buffer":0,"byteOffset":60,"byteLength":36}],)"
         R"("accessors":[{"bufferView":0,"componentType":5126,"count":5,"type":"VEC3","min":[-1,-1,0],"max":[1,1,1]},)"
         R"({"bufferView":1,"componentType":5123,"count":)" +
         count + R"(,"type":"SCALAR"}]})";
}

std::string gltf(const std::string& buffer = c_buffer) {
  return gltf_json(R"(,"uri":"data:application/octet-stream;base64,)" + base64(buffer) + '"');
}

std::string glb() {
  std::string chunk = gltf_json("");
  while (chunk.size() % 4 != 0) chunk += ' ';
  const auto size = [](std::size_t n) { return static_cast<std::uint32_t>(n); };
  return "glTF" + bytes(std::vector<std::uint32_t>{2, size(12 + 8 + chunk.size() + 8 + c_buffer.size())}) +
         bytes(std::vector<std::uint32_t>{size(chunk.size()), 0x4e4f534a}) + chunk +
         bytes(std::vector<std::uint32_t>{size(c_buffer.size()), 0x004e4942}) + c_buffer;
}

std::vector<std::pair<std::string, std::string>> files() {
  return {{"p.obj", c_obj},        {"p.ply", c_ply_ascii}, {"q.ply", ply_binary()}, {"p.stl", stl_ascii()},
          {"q.stl", stl_binary()}, {"p.gltf", gltf()},     {"p.glb", glb()},        {"P.OBJ", c_obj}};
}

class LoadMesh : public ::testing::Test {
 protected:
  Result<LoadedMesh> load(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return load_mesh(folder_ / name);
  }

  void expect_error(const std::string& name, const std::string& text, const std::string& expected) const {
    EXPECT_TRUE(is_error(load(name, text), ExitCode::bad_input, folder_.string() + "/" + expected)) << name;
  }

  const TemporaryFolder made_ = must(TemporaryFolder::make(std::filesystem::temp_directory_path()));
  const std::filesystem::path folder_ = made_.path();
};

double volume(const Mesh& mesh) {
  double sum = 0.0;
  for (const SceneTriangle& t : mesh.triangles) {
    sum += glm::dot(mesh.positions[t.position[0]],
                    glm::cross(mesh.positions[t.position[1]], mesh.positions[t.position[2]])) /
           6.0;
  }
  return sum;
}

TEST_F(LoadMesh, ReadsThePyramidFromEveryFormat) {
  for (const auto& [name, text] : files()) {
    LoadedMesh loaded = must(load(name, text));
    EXPECT_EQ(loaded.mesh.triangles.size(), 6u) << name;
    EXPECT_EQ(loaded.mesh.positions.size(), 5u) << name;
    const bool is_gltf = name.starts_with("p.g");
    EXPECT_NEAR(volume(loaded.mesh), (is_gltf ? 8.0 : 1.0) * 4.0 / 3.0, 1e-12) << name;
    EXPECT_EQ(loaded.mesh.materials.size(), 1u) << name;
    EXPECT_EQ(loaded.default_crease_degrees, name[2] == 's' ? 60.0 : 180.0);
    EXPECT_TRUE(loaded.notes.empty()) << name << loaded.notes[0];
    EXPECT_EQ(fill_normals(loaded.mesh, 180.0, false), 18u) << name;
  }
}

TEST_F(LoadMesh, AppliesNodeTransformsAndGltfMaterials) {
  const LoadedMesh loaded = must(load("p.glb", glb()));
  glm::dvec3 apex(0.0);
  for (const glm::dvec3& p : loaded.mesh.positions) {
    if (p.z > 0.0) apex = p;
  }
  EXPECT_EQ(apex, glm::dvec3(10.0, 0.0, 2.0));
  const Material& gold = loaded.mesh.materials[loaded.mesh.triangles[0].material];
  EXPECT_EQ(gold.name, "gold");
  EXPECT_NEAR(glm::length(gold.colour - glm::dvec3(0.8, 0.6, 0.2)), 0.0, 1e-6);
  EXPECT_NEAR(glm::length(gold.specular_colour - gold.colour), 0.0, 1e-6);
  EXPECT_NEAR(gold.specular, 0.4 * 0.5, 1e-6);
  EXPECT_NEAR(gold.exponent, 2.0 / 0.0625 - 2.0, 1e-9);
}

// Opening a pipe waits for a writer, and a device may never end. The loader must not wait for either.
TEST_F(LoadMesh, PipesAndDevicesAreNeitherLibrariesNorBuffers) {
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  for (const std::string name : {"pipe", "/dev/zero"}) {
    const LoadedMesh loaded = must(load("m.obj", "mtllib " + name + "\nusemtl a\n" + c_obj));
    ASSERT_EQ(loaded.notes.size(), 1u);
    EXPECT_NE(loaded.notes[0].find(name + " cannot be read"), std::string::npos);
    expect_error("m.gltf", gltf_json(R"(,"uri":")" + name + '"'), "m.gltf: buffers[0].uri: ");
  }
}

TEST_F(LoadMesh, BuffersAreReadFromTheFolder) {
  std::filesystem::create_directory(folder_ / "sub");
  std::ofstream(folder_ / "sub" / "a b.bin", std::ios::binary) << c_buffer;
  EXPECT_EQ(must(load("m.gltf", gltf_json(R"(,"uri":"sub/a%20b.bin")"))).mesh.triangles.size(), 6u);
  expect_error("m.gltf", gltf_json(R"(,"uri":"gone.bin")"),
               "m.gltf: buffers[0].uri: 'gone.bin' is not a file; export the file with its buffers");
}

TEST_F(LoadMesh, KeepsTheFilesNormalsAndReplacesZeroOnes) {
  Result<LoadedMesh> loaded =
      load("n.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 1 0\nvn 0 0 0\nf 1//1 2//1 3//2\n");
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(fill_normals(loaded->mesh, 180.0, false), 1u);
  const SceneTriangle& triangle = loaded->mesh.triangles.at(0);
  EXPECT_EQ(loaded->mesh.normals[triangle.normal[0]], glm::dvec3(0.0, 1.0, 0.0));
  EXPECT_EQ(loaded->mesh.normals[triangle.normal[2]], glm::dvec3(0.0, 0.0, 1.0));
}

// Four posts of the same width, as far from the origin as maps are.
TEST_F(LoadMesh, PostsFarFromTheOriginHaveTheSameWidth) {
  std::string obj, obj_faces, ply, ply_faces, stl = "solid\n";
  for (int i = 0; i < 16; i += 4) {
    const double left = 5334760.0 + 0.3 * i;
    std::vector<std::string> corners;
    for (const auto& [x, y] :
         std::vector<std::pair<double, int>>{{left, 0}, {left + 0.6, 0}, {left + 0.6, 2}, {left, 2}})
      corners.push_back(fmt::format("{:.1f} {} 0\n", x, y));
    for (const std::string& corner : corners) obj += "v " + corner, ply += corner;
    for (const std::size_t k : {1, 2})
      stl += fmt::format("facet outer loop vertex {}vertex {}vertex {}endloop endfacet\n", corners[0],
                         corners[k], corners[k + 1]);
    obj_faces += fmt::format("f {} {} {} {}\n", i + 1, i + 2, i + 3, i + 4);
    ply_faces += fmt::format("4 {} {} {} {}\n", i, i + 1, i + 2, i + 3);
  }
  const std::string header =
      "ply\nformat ascii 1.0\n" + changed(changed(c_ply_header, "vertex 5", "vertex 16"), "face 5", "face 4");
  for (const auto& [name, text] :
       std::vector<std::pair<std::string, std::string>>{{"posts.obj", obj + obj_faces},
                                                        {"posts.ply", header + ply + ply_faces},
                                                        {"posts.stl", stl + "endsolid\n"}}) {
    Scene scene = must(scene_of_mesh(must(load(name, text)), name));
    scene.camera = {.eye_world = {5334762.0, 1.0, 8.0}, .target_world = {5334762.0, 1.0, 0.0}};
    const auto projected = Projector(scene, {640, 480}, {.subpixel_bits = 9}).project_all();
    ASSERT_EQ(projected.size(), 8u) << name;
    std::array<std::int32_t, 4> widths{};
    for (std::size_t i = 0; i < projected.size(); ++i) {
      const auto& [p, q, r] = projected[i].vertex;
      const auto [low, high] = std::minmax({p.position_world.x, q.position_world.x, r.position_world.x});
      EXPECT_NEAR(high - low, 0.6, 2e-9) << name;  // two roundings to double at this place
      const auto [first, last] = std::minmax({p.x, q.x, r.x});
      if (i % 2 == 0) widths[i / 2] = last - first;
      EXPECT_NEAR(last - first, widths[0], 1) << name;
    }
    EXPECT_GT(widths[0], 10'000) << name;
  }
}

/// A damaged file must cause no crash, no index out of range and no infinite or undefined number.
void expect_error_or_sound(const Result<LoadedMesh>& loaded, const std::string& what) {
  if (!loaded) {
    EXPECT_EQ(loaded.error().code, ExitCode::bad_input) << what;
    EXPECT_FALSE(loaded.error().message.empty()) << what;
    return;
  }
  EXPECT_FALSE(loaded->mesh.triangles.empty()) << what;
  for (const SceneTriangle& triangle : loaded->mesh.triangles) {
    ASSERT_LT(triangle.material, loaded->mesh.materials.size()) << what;
    for (int corner = 0; corner < 3; ++corner) {
      ASSERT_LT(triangle.position[corner], loaded->mesh.positions.size()) << what;
      ASSERT_LT(triangle.normal[corner], loaded->mesh.normals.size()) << what;
      const glm::dvec3& p = loaded->mesh.positions[triangle.position[corner]];
      ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) << what;
    }
  }
}

TEST_F(LoadMesh, TruncatedFilesAreErrors) {
  for (const auto& [name, text] : files()) {
    // OBJ has no end mark: a truncated file is a valid mesh, or lacks a vertex or a corner.
    if (text == c_obj) continue;
    for (std::size_t size = 0; size + 20 < text.size(); size += 1 + text.size() / 37) {
      expect_error(name, text.substr(0, size), name);
    }
  }
  for (std::size_t size = 0; size < c_obj.size(); ++size) {
    expect_error_or_sound(load("p.obj", c_obj.substr(0, size)), "obj cut to " + std::to_string(size));
  }
}

TEST_F(LoadMesh, DamagedFilesAreErrorsOrMeshes) {
  std::mt19937 random(7);
  for (const auto& [name, text] : files()) {
    for (int trial = 0; trial < 40; ++trial) {
      std::string damaged = text;
      for (auto hits = 1 + random() % 3; hits > 0; --hits) {
        damaged[random() % damaged.size()] = static_cast<char>(random());
      }
      expect_error_or_sound(load(name, damaged), name + " trial " + std::to_string(trial));
    }
  }
}

TEST_F(LoadMesh, OtherFilesAreRefused) {
  expect_error("a.dae", c_obj, "a.dae: not a mesh file by its name");
  expect_error("a.obj", "", "a.obj: the file is empty");
  expect_error("a.obj", "\xff\xfev", "a.obj:1: the text is UTF-16; save it as UTF-8");
  std::filesystem::create_directory(folder_ / "d.obj");
  EXPECT_NE(load_mesh(folder_ / "d.obj").error().message.find("a directory"), std::string::npos);
}

}  // namespace
}  // namespace halfway
