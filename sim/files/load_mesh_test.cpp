// SPDX-License-Identifier: Apache-2.0
#include "sim/files/load_mesh.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "common/test/is_error.hpp"
#include "mesh_files/test/spelling.hpp"
#include "projection/project.hpp"
#include "scene_files/parse_scene.hpp"
#include "sim/os/test/folder_test.hpp"
#include "sim/os/test/source_folder.hpp"

namespace halfway {
namespace {

// Files of every format: those that fuzzing starts from.
struct MeshFile {
  const char* name;  // in tb/inputs/random/seeds
  std::string triangles;
};
const MeshFile c_mesh_files[] = {{"obj/triangle.obj", c_triangle},
                                 {"ply/ascii.ply", "0,0,0 1,0,0 1,1,0; 0,0,0 1,1,0 0,1,0"},
                                 {"ply/little.ply", "0,0,0 1,0,0 1,1,0.5; 0,0,0 1,1,0.5 0,1,0"},
                                 {"ply/big.ply", "0,0,0 1,0,0 1,1,0.5; 0,0,0 1,1,0.5 0,1,0"},
                                 {"stl/ascii.stl", "0,0,0 1,0,0 0,1,0; 0,0,0 0,1,0 -1,0,0"},
                                 {"stl/binary.stl", "0,0,0 1,0,0 0,1,0; 0,0,0 0,1,0 -1,0,0"},
                                 {"gltf/triangle.gltf", "0,0,1 1,0,1 0,1,1; 3,0,1 4,0,1 3,2,1"},
                                 {"glb/triangle.glb", "0,0,1 1,0,1 0,1,1; 3,0,1 4,0,1 3,2,1"}};

std::string seed(const char* name) {
  return must(read_file(c_source_folder / "tb/inputs/random/seeds" / name));
}
std::string ending_of(const MeshFile& file) {
  return std::filesystem::path(file.name).extension().string();
}
const std::string c_obj = seed("obj/triangle.obj"), c_gltf = seed("gltf/triangle.gltf");

/// The glTF file with its buffer in another file.
std::string gltf_with_buffer(const std::string& uri) {
  const std::size_t from = c_gltf.find("data:");
  return std::string(c_gltf).replace(from, c_gltf.find('"', from) - from, uri);
}

class LoadMesh : public FolderTest {
 protected:
  Result<LoadedMesh> load(const std::string& name, const std::string& text) const {
    return load_mesh(write(name, text));
  }

  void expect_error(const std::string& name, const std::string& text, const std::string& expected) const {
    EXPECT_TRUE(is_error(load(name, text), ExitCode::bad_input, at(expected).string())) << name;
  }
};

TEST_F(LoadMesh, ReadsEachFormatByItsEnding) {
  for (const MeshFile& file : c_mesh_files)
    EXPECT_EQ(triangles_of(load("m" + ending_of(file), seed(file.name))), file.triangles) << file.name;
  EXPECT_EQ(triangles_of(load("M.OBJ", c_obj)), c_triangle);
  EXPECT_EQ(must(load("m.stl", seed("stl/ascii.stl"))).default_crease_degrees, 60.0);
  EXPECT_EQ(must(load("m.obj", c_obj)).default_crease_degrees, 180.0);
}

TEST_F(LoadMesh, AppliesGltfMaterials) {
  const LoadedMesh loaded = must(load("m.gltf", c_gltf));
  const Material& m = loaded.mesh.materials.at(loaded.mesh.triangles[0].material);
  EXPECT_EQ(m.name, "m");
  EXPECT_EQ(m.colour, glm::dvec3(1.0, 0.5, 0.2));
  EXPECT_NEAR(glm::length(m.specular_colour - glm::dvec3(1.0, 0.85, 0.76)), 0.0, 1e-12);
  EXPECT_NEAR(m.specular, 0.24, 1e-12);
  EXPECT_NEAR(m.exponent, 76.125, 1e-9);
}

// Opening a pipe waits for a writer, and a device may never end. The loader must not wait for either.
TEST_F(LoadMesh, PipesAndDevicesAreNeitherLibrariesNorBuffers) {
  ASSERT_EQ(::mkfifo(at("pipe").c_str(), 0600), 0);
  for (const std::string name : {"pipe", "/dev/zero"}) {
    const LoadedMesh loaded = must(load("m.obj", "mtllib " + name + "\nusemtl a\n" + c_obj));
    ASSERT_EQ(loaded.notes.size(), 1u);
    EXPECT_NE(loaded.notes[0].find(name + " cannot be read"), std::string::npos);
    expect_error("m.gltf", gltf_with_buffer(name), "m.gltf: buffers[0].uri: ");
  }
}

TEST_F(LoadMesh, BuffersAreReadFromTheFolder) {
  const std::string glb = seed("glb/triangle.glb");
  write("sub/a b.bin", glb.substr(glb.size() - 80));
  EXPECT_EQ(triangles_of(load("m.gltf", gltf_with_buffer("sub/a%20b.bin"))),
            triangles_of(load("m.glb", glb)));
  expect_error("m.gltf", gltf_with_buffer("gone.bin"),
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
      "ply\nformat ascii 1.0\nelement vertex 16\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 4\nproperty list uchar int vertex_indices\nend_header\n";
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

TEST_F(LoadMesh, TruncatedAndDamagedFilesAreErrorsOrMeshes) {
  std::mt19937 random(7);
  for (const MeshFile& file : c_mesh_files) {
    const std::string text = seed(file.name), name = "m" + ending_of(file);
    for (std::size_t size = 0; size < text.size(); size += 1 + text.size() / 200) {
      const auto loaded = load(name, text.substr(0, size));
      expect_error_or_sound(loaded, name + " cut to " + std::to_string(size));
      // OBJ has no end mark: a truncated file is a valid mesh, or lacks a vertex or a corner.
      if (name != "m.obj" && size + 20 < text.size()) {
        EXPECT_FALSE(loaded) << name << ": " << size;
      }
    }
    for (int trial = 0; trial < 40; ++trial) {
      std::string damaged = text;
      for (auto hits = 1 + random() % 3; hits > 0; --hits)
        damaged[random() % damaged.size()] = static_cast<char>(random());
      expect_error_or_sound(load(name, damaged), name + " trial " + std::to_string(trial));
    }
  }
}

TEST_F(LoadMesh, OtherFilesAreRefused) {
  expect_error("a.dae", c_obj, "a.dae: not a mesh file by its name");
  expect_error("a.obj", "", "a.obj: the file is empty");
  expect_error("a.obj", "\xff\xfev", "a.obj:1: the text is UTF-16; save it as UTF-8");
  std::filesystem::create_directory(at("d.obj"));
  EXPECT_TRUE(is_error(load_mesh(at("d.obj")), "a directory"));
}

}  // namespace
}  // namespace halfway
