// SPDX-License-Identifier: Apache-2.0
#include "sim/files/load_scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <string>
#include <utility>
#include <vector>

#include "common/test/is_error.hpp"
#include "projection/project.hpp"
#include "scene/camera.hpp"
#include "sim/files/test/built_in_scene.hpp"
#include "sim/os/test/folder_test.hpp"

namespace halfway {
namespace {

class LoadScene : public FolderTest {
 protected:
  Result<Scene> load(const std::string& toml) const {
    return load_scene(write("s.toml", toml).string(), c_built_in_scenes);
  }
  Scene load_file(const std::string& name, const std::string& text) const {
    return must(load_scene(write(name, text).string(), c_built_in_scenes));
  }

  /// The error message without the folder, or "loaded".
  std::string error(const std::string& toml) const {
    const Result<Scene> scene = load(toml);
    if (scene) return "loaded";
    EXPECT_EQ(scene.error().code, ExitCode::bad_input);
    std::string message = scene.error().message;
    const std::string prefix = here().string() + "/";
    for (std::size_t at; (at = message.find(prefix)) != std::string::npos;) message.erase(at, prefix.size());
    return message;
  }
};

void expect_sound(const Scene& scene) {
  EXPECT_TRUE(has_view(scene.camera));
  EXPECT_FALSE(scene.triangles.empty());
  for (const glm::dvec3& normal : scene.normals_world) EXPECT_NEAR(glm::length(normal), 1.0, 1e-12);
  for (const SceneTriangle& triangle : scene.triangles) {
    EXPECT_LT(triangle.material, scene.materials.size());
    for (int corner = 0; corner < 3; ++corner) {
      EXPECT_LT(triangle.position[corner], scene.positions_world.size());
      EXPECT_LT(triangle.normal[corner], scene.normals_world.size());
    }
  }
}

TEST_F(LoadScene, BuiltInScenesLoadAndAreInsideTheFrame) {
  const std::pair<const char*, std::size_t> cases[] = {{"spheres", 2 * (168 + 374 + 690)},
                                                       {"highlights", 3 * 168},
                                                       {"teapot", 4032},
                                                       {"lights", 2 * 690},
                                                       {"matte", 690 + 1560},
                                                       {"shadows", 12 * 16 + 12 + 396}};
  for (const auto& [name, triangles] : cases) {
    const Scene scene = built_in_scene(name);
    EXPECT_EQ(scene.name, name);
    EXPECT_EQ(scene.triangles.size(), triangles);
    EXPECT_TRUE(scene.notes.empty());
    expect_sound(scene);
    const ViewBasis basis = view_basis(scene.camera);
    const double half = std::tan(scene.camera.vertical_fov_degrees / 360.0 * 3.141592653589793);
    for (const glm::dvec3& p : scene.positions_world) {
      const glm::dvec3 to = p - scene.camera.eye_world;
      const double depth = -glm::dot(to, basis.backward_world);
      EXPECT_LT(std::abs(glm::dot(to, basis.up_world)), depth * half) << name;
      EXPECT_LT(std::abs(glm::dot(to, basis.right_world)), depth * half * 4.0 / 3.0) << name;
    }
  }
}

TEST_F(LoadScene, BuiltInScenesHaveTheirEffects) {
  const Scene lights = built_in_scene("lights");
  EXPECT_EQ(lights.directional.size(), 5u);
  EXPECT_EQ(lights.positional.size(), 5u);
  const Scene matte = built_in_scene("matte");
  for (const Material& material : matte.materials) {
    EXPECT_EQ(material.specular, 0.0);
    EXPECT_EQ(material.colour, glm::dvec3(material.colour.x));
  }
  const Scene highlights = built_in_scene("highlights");
  ASSERT_EQ(highlights.materials.size(), 3u);
  EXPECT_EQ(highlights.materials[0].exponent, 5.0);
  EXPECT_EQ(highlights.materials[1].exponent, 10.0);
  EXPECT_EQ(highlights.materials[2].exponent, 20.0);
  const Scene shadows = built_in_scene("shadows");
  EXPECT_TRUE(shadows.shadows);
  EXPECT_EQ(shadows.directional.size(), 1u);
  EXPECT_EQ(shadows.positional.size(), 1u);
  EXPECT_FALSE(lights.shadows);
}

TEST_F(LoadScene, ReadsEveryKey) {
  const Scene scene = must(load(R"(ambient = [0.1, 0.2, 0.3]
background = 0.5
shadows = true
[camera]
eye = [1, 2, 9]
target = [0, 1, 0]
up = [0, 2, 0]
fov = 55
near = 0.5
far = 50.0
[[directional]]
to_light = [0, 0, 2]
intensity = [1, 2, 3]
[[positional]]
position = [4, 5, 6]
[[spot]]
position = [0, 9, 0]
axis = [0, -3, 0]
inner = 0
outer = 60
intensity = 2
[[material]]
name = "m"
brdf = "cook_torrance"
colour = [0.1, 0.2, 0.3]
specular_colour = 0.25
k_a = 0.5
emission = [0.25, 0.5, 2]
k_d = 0
k_s = 2
exponent = 1
roughness = 1
reflectance = 0
[[mesh]]
kind = "sphere"
slices = 3
stacks = 2
radius = 2
translate = [10, 0, 0]
rotate = { degrees = 90, axis = [0, 0, 5] }
scale = [1, 3, 1]
material = "m"
)"));
  expect_sound(scene);
  EXPECT_EQ(scene.ambient, glm::dvec3(0.1, 0.2, 0.3));
  EXPECT_EQ(scene.background, glm::dvec3(0.5));
  EXPECT_EQ(scene.camera.eye_world, glm::dvec3(1.0, 2.0, 9.0));
  EXPECT_EQ(scene.camera.target_world, glm::dvec3(0.0, 1.0, 0.0));
  EXPECT_EQ(scene.camera.vertical_fov_degrees, 55.0);
  EXPECT_EQ(scene.camera.near, 0.5);
  EXPECT_EQ(scene.camera.far, 50.0);
  EXPECT_EQ(scene.directional.at(0).to_light_world, glm::dvec3(0.0, 0.0, 1.0));
  EXPECT_EQ(scene.directional.at(0).intensity, glm::dvec3(1.0, 2.0, 3.0));
  EXPECT_EQ(scene.positional.at(0).position_world, glm::dvec3(4.0, 5.0, 6.0));
  EXPECT_EQ(scene.positional.at(0).intensity, glm::dvec3(1.0));
  EXPECT_EQ(scene.spots.at(0).axis_world, glm::dvec3(0.0, -1.0, 0.0));
  EXPECT_EQ(scene.spots.at(0).cos_inner, 1.0);
  EXPECT_NEAR(scene.spots.at(0).cos_outer, 0.5, 1e-15);
  const Material& material = scene.materials.at(0);
  EXPECT_EQ(material.brdf, Brdf::cook_torrance);
  EXPECT_EQ(material.colour, glm::dvec3(0.1, 0.2, 0.3));
  EXPECT_EQ(material.specular_colour, glm::dvec3(0.25));
  EXPECT_EQ(material.ambient, 0.5);
  EXPECT_EQ(material.emission, glm::dvec3(0.25, 0.5, 2.0));
  EXPECT_EQ(material.diffuse, 0.0);
  EXPECT_EQ(material.specular, 2.0);
  EXPECT_EQ(material.exponent, 1.0);
  EXPECT_EQ(material.roughness, 1.0);
  EXPECT_EQ(material.reflectance, 0.0);
  // The pole (0, 2, 0) is scaled to (0, 6, 0), rotated to (-6, 0, 0) and moved to (4, 0, 0).
  EXPECT_NEAR(glm::length(scene.positions_world.at(0) - glm::dvec3(4.0, 0.0, 0.0)), 0.0, 1e-14);
  EXPECT_NEAR(glm::length(scene.normals_world.at(0) - glm::dvec3(-1.0, 0.0, 0.0)), 0.0, 1e-14);
}

TEST_F(LoadScene, ABoxHasSizeAndDivisions) {
  const auto box = [&](const std::string& keys) {
    const Scene scene = must(load("[[mesh]]\nkind = \"box\"\n" + keys));
    glm::dvec3 high(0.0);
    for (const glm::dvec3& p : scene.positions_world) high = glm::max(high, p);
    return std::pair(high, scene.triangles.size());
  };
  EXPECT_EQ(box(""), std::pair(glm::dvec3(0.5), std::size_t{12}));
  EXPECT_EQ(box("size = 3\n"), std::pair(glm::dvec3(1.5), std::size_t{12}));
  EXPECT_EQ(box("size = [1, 2.0, 3]\ndivisions = 5\n"),
            std::pair(glm::dvec3(0.5, 1.0, 1.5), std::size_t{300}));
}

TEST_F(LoadScene, ShadowsOfAnOpenMeshAreNoted) {
  write("quad.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 4 3\n");
  const std::string scene =
      "[[directional]]\nto_light = [0, 0, 1]\n[[mesh]]\nkind = \"box\"\n[[mesh]]\nfile = \"quad.obj\"\n"
      "[[mesh]]\nkind = \"teapot\"\ndivisions = 2\n";
  const Scene with = must(load("shadows = true\n" + scene));
  ASSERT_EQ(with.notes.size(), 2u);
  EXPECT_EQ(with.notes[0],
            at("quad.obj").string() +
                ": the mesh is open at 4 edges; each of its triangles casts a shadow only where "
                "it faces away from the light");
  EXPECT_EQ(with.notes[1].find(at("s.toml").string() + ":8: the mesh is open at 32 edges; "), 0u);
  const Scene without = must(load(scene));
  EXPECT_TRUE(without.notes.empty());
}

TEST_F(LoadScene, MirroringKeepsTheOutsideOut) {
  const Scene scene = must(load("[[mesh]]\nkind = \"sphere\"\nscale = [-1, 2, 1]\n"));
  for (const SceneTriangle& t : scene.triangles) {
    const glm::dvec3& a = scene.positions_world[t.position[0]];
    const glm::dvec3 face =
        glm::cross(scene.positions_world[t.position[1]] - a, scene.positions_world[t.position[2]] - a);
    EXPECT_GT(glm::dot(face, a), 0.0);
    for (const std::uint32_t normal : t.normal) EXPECT_GT(glm::dot(face, scene.normals_world[normal]), 0.0);
  }
}

TEST_F(LoadScene, CreaseAngleDecidesBetweenFlatAndSmooth) {
  const auto normals_of = [&](const std::string& keys) {
    const Scene scene = must(load("[[mesh]]\nkind = \"sphere\"\nslices = 8\nstacks = 8\n" + keys));
    std::vector<std::uint32_t> used;
    for (const SceneTriangle& t : scene.triangles) used.insert(used.end(), t.normal.begin(), t.normal.end());
    std::sort(used.begin(), used.end());
    return std::unique(used.begin(), used.end()) - used.begin();
  };
  const int vertices = 8 * 7 + 2;
  EXPECT_EQ(normals_of(""), vertices);
  EXPECT_EQ(normals_of("normals = \"computed\"\n"), vertices);
  EXPECT_EQ(normals_of("crease_angle = 60\n"), vertices);
  // Only the two triangles of a quad are in one plane.
  EXPECT_EQ(normals_of("crease_angle = 1\n"), 8 * 6 * 4 + 2 * 8 * 3);
}

TEST_F(LoadScene, FittedCameraLooksFromItsDirection) {
  const Result<Scene> scene =
      load("[camera]\nfit = true\ndirection = [0, 0, -4]\nfov = 30\n[[mesh]]\nkind = \"teapot\"\n");
  ASSERT_TRUE(scene) << scene.error().message;
  const BoundingSphere sphere = bounding_sphere(*scene);
  EXPECT_EQ(scene->camera.target_world, sphere.centre_world);
  EXPECT_NEAR(scene->camera.eye_world.z,
              sphere.centre_world.z - 1.05 * sphere.radius / std::sin(15.0 / 180.0 * 3.141592653589793),
              1e-9);
}

TEST_F(LoadScene, EveryFaultNamesFileAndLine) {
  const std::string mesh = "[[mesh]]\nkind = \"sphere\"\n", box = "[[mesh]]\nkind = \"box\"\n",
                    camera = "[camera]\neye = [0, 0, 9]\n", fitted = "[camera]\nfit = true\n",
                    spot = "[[spot]]\nposition = [0, 0, 1]\naxis = [0, 0, 1]\n",
                    material = "[[material]]\nname = \"a\"\n";
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"\na = 1\nb = ]\n", "3: bad TOML: "},
      {"x = 1\n" + mesh, "1: unknown key 'x' in the scene; it may have: camera, ambient, "},
      {"\n[camera]\neye = [0, 0, 5]\nfow = 3\n" + mesh, "4: unknown key 'fow' in camera; it may have: fit, "},
      {"ambient = 0.2\n", " the scene has no mesh"},
      {"mesh = 3\n", "1: mesh of the scene must be written [[mesh]]"},
      {"[mesh]\nkind = \"sphere\"\n", "1: mesh of the scene must be written [[mesh]]"},
      {"ambient = \"grey\"\n" + mesh, "1: ambient of the scene must be three numbers"},
      {"ambient = [1, 2, true]\n" + mesh, "1: ambient of the scene must be a number"},
      {"ambient = nan\n" + mesh, "1: ambient of the scene is not finite"},
      {"ambient = [0, 0,\n inf]\n" + mesh, "2: ambient of the scene is not finite"},
      {"background = 1e300\n" + mesh, "1: background of the scene is 1e+300, but must be "},
      {"shadows = 1\n" + mesh, "1: shadows of the scene must be true or false"},
      {"[camera]\nfov = 30\n" + mesh, "1: camera has no 'eye'"},
      {"[camera]\neye = [1, 2, 3]\ntarget = [1, 2, 3]\n" + mesh, "2: eye of camera is the target"},
      {"[camera]\neye = [0, 9, 0]\n" + mesh, "2: eye of camera makes up parallel to the view"},
      {camera + "up = [0, 0, -2]\n" + mesh, "3: up of camera makes up parallel to the view"},
      {camera + "up = [0, 0, 0]\n" + mesh, "3: up of camera has no direction"},
      {camera + "fov = 0\n" + mesh, "3: fov of camera is 0, but must be greater than 0"},
      {camera + "near = 0\n" + mesh, "3: near of camera is 0, but must be greater than 0"},
      {camera + "near = 2\nfar = 2\n" + mesh, "4: far of camera must be greater than near"},
      {fitted + "eye = [0, 0, 1]\n" + mesh, "3: eye of camera cannot be given with fit"},
      {fitted + "direction = [0, 1, 0]\n" + mesh, "3: direction of camera makes up parallel"},
      {fitted + "direction = [0, 0, 0]\n" + mesh, "3: direction of camera has no direction"},
      {"[camera]\neye = [0, 0, 1]\ndirection = [0, 1, 0]\n" + mesh, "3: direction of camera needs fit"},
      {"[[directional]]\nto_light = [0, 0, 0]\n" + mesh, "2: to_light of directional has no direction"},
      {"[[directional]]\n" + mesh, "1: directional has no 'to_light'"},
      {"[[spot]]\nposition = [0, 0, 1]\naxis = [0, 0, 0]\nouter = 9\n" + mesh,
       "3: axis of spot has no direction"},
      {spot + "outer = 91\n" + mesh, "4: outer of spot is 91, but"},
      {spot + "outer = 0\n" + mesh, "4: outer of spot must be"},
      {spot + "outer = 9\ninner = 10\n" + mesh, "5: inner of spot is 10"},
      {"[[material]]\ncolour = 1\n" + mesh, "1: material has no 'name'"},
      {"[[material]]\nname = 3\n" + mesh, "2: name of material must be a text"},
      {"[[material]]\nname = \"a\"\n[[material]]\nname = \"a\"\n" + mesh, "4: name of material 'a' is taken"},
      {material + "brdf = \"lambert\"\n" + mesh, "3: brdf of material is 'lambert', but must be"},
      {material + "exponent = 0.5\n" + mesh, "3: exponent of material is 0.5, but must be at least 1"},
      {material + "k_a = -1\n" + mesh, "3: k_a of material is -1, but must be at least 0"},
      {material + "colour = [0, 0, -1]\n" + mesh, "3: colour of material is -1"},
      {material + "roughness = 0\n" + mesh, "3: roughness of material is 0, but must be"},
      {material + "reflectance = 1.5\n" + mesh, "3: reflectance of material is 1.5, but must be"},
      {mesh + "material = \"b\"\n", "3: material of mesh 'b' is not defined"},
      {mesh + "slices = 2\n", "3: slices of mesh is 2, but must be from 3 to"},
      {mesh + "slices = 3.5\n", "3: slices of mesh must be a whole number"},
      {mesh + "radius = 0\n", "3: radius of mesh is 0, but must be greater than 0"},
      {mesh + "slices = 10000\nstacks = 10000\n",
       "1: the scene has 199980000 triangles up to this mesh, but"},
      {"[[mesh]]\nkind = \"teapot\"\ndivisions = 1\n", "3: divisions of mesh is 1, but must be from 2 to"},
      {box + "size = [1, 0, 1]\n", "3: size of mesh is 0, but must be greater than 0"},
      {box + "divisions = 0\n", "3: divisions of mesh is 0, but must be from 1 to"},
      {box + "divisions = 1000\n", "1: the scene has 12000000 triangles up to"},
      {mesh + "size = 3\n", "3: unknown key 'size' in mesh; it may have: kind, slices, "},
      {"[[mesh]]\nkind = \"cube\"\n", "2: kind of mesh must be \"sphere\", \"teapot\" or \"box\""},
      {"[[mesh]]\nscale = 1\n", "1: mesh has neither 'kind' nor 'file'"},
      {"[[mesh]]\nkind = \"sphere\"\nfile = \"a.obj\"\n", "2: kind of mesh cannot be given with file"},
      {"[[mesh]]\nfile = \"gone.obj\"\n", "2: file of mesh cannot be used: gone.obj: no such file"},
      {"[[mesh]]\nfile = \"mesh.blend\"\n", "2: file of mesh is not a mesh file by its name"},
      {"[[mesh]]\nfile = 7\n", "2: file of mesh must be a text"},
      {mesh + "scale = 0\n", "3: scale of mesh must not be zero"},
      {mesh + "scale = 1e15\nradius = 1e15\n", "1: vertex 1 has a coordinate beyond 1e+15"},
      {mesh + "scale = 1e-300\nradius = 1e-300\n", "1: no triangle of the mesh has any area"},
      {mesh + "rotate = 90\n", "3: rotate of mesh must be written {"},
      {mesh + "rotate = { degrees = 9, axis = [0, 0, 0] }\n", "3: axis of rotate has no direction"},
      {mesh + "rotate = { axis = [0, 0, 1] }\n", "3: rotate has no 'degrees'"},
      {mesh + "normals = \"smooth\"\n", "3: normals of mesh is 'smooth', but must be"},
      {mesh + "crease_angle = 181\n", "3: crease_angle of mesh is 181, but must be"},
      {mesh + "normals = \"file\"\ncrease_angle = 18\n", "4: crease_angle of mesh needs normals"},
  };
  for (const auto& [toml, place_and_message] : cases) {
    const std::string message = error(toml);
    EXPECT_TRUE(message.starts_with("s.toml:" + place_and_message)) << toml << "\nsays: " << message;
  }
}

TEST_F(LoadScene, FaultyFilesAreErrors) {
  const auto expect_error = [](const std::string& path, const std::string& expected) {
    EXPECT_TRUE(is_error(load_scene(path, c_built_in_scenes), ExitCode::bad_input, expected)) << path;
  };
  std::filesystem::create_directory(at("d.toml"));
  std::filesystem::create_symlink("/dev/zero", at("z.toml"));
  write("e.toml", "");
  write("e.xyz", "1");
  write("b.toml", std::string("\0\xff\xfe\x01", 4));
  write("deep.toml", "a = " + std::string(100000, '['));
  for (const auto& [name, fault] :
       {std::pair("gone.toml", ": no such file; check the path"),
        std::pair("gone.obj", ": no such file; check the path"),
        std::pair("d.toml", ": a directory; name a file in it"), std::pair("e.toml", ": the file is empty"),
        std::pair("e.xyz", ": not a scene by its name"), std::pair("z.toml", ": not a regular file"),
        std::pair("b.toml", ":1: bad TOML"), std::pair("deep.toml", ":1: bad TOML")})
    expect_error(at(name).string(), at(name).string() + fault);
  expect_error(here().string(), here().string() + ": a directory; name a file in it");
  expect_error("nope",
               "nope: neither a built-in scene nor a file; built in are: highlights, lights, matte, shadows, "
               "spheres, teapot");
  for (const std::string& name :
       {std::string(), std::string(".."), std::string("teapot\0x", 8), std::string(100000, 'x')})
    expect_error(name, "");
}

TEST_F(LoadScene, AMeshFileGetsCameraLightAndMaterial) {
  const Scene scene = load_file(
      "tetra.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\nf 1 1 2\n");
  expect_sound(scene);
  EXPECT_EQ(scene.name, "tetra");
  EXPECT_EQ(scene.triangles.size(), 4u);
  EXPECT_EQ(scene.materials.size(), 1u);
  ASSERT_EQ(scene.directional.size(), 1u);
  const ViewBasis basis = view_basis(scene.camera);
  EXPECT_LT(glm::dot(scene.directional[0].to_light_world, basis.right_world), 0.0);
  EXPECT_GT(glm::dot(scene.directional[0].to_light_world, basis.up_world), 0.0);
  EXPECT_GT(glm::dot(scene.directional[0].to_light_world, basis.backward_world), 0.0);
  ASSERT_EQ(scene.notes.size(), 1u);
  EXPECT_EQ(scene.notes[0], at("tetra.obj").string() + ": 1 triangles without area left out");
}

TEST_F(LoadScene, AMeshFileHasItsOwnLights) {
  const std::string file =
      R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0,"extensions":{"KHR_lights_punctual":{"light":0}}}],
    "extensions":{"KHR_lights_punctual":{"lights":[{"type":"directional","color":[0,1,0]}]}},
    "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"buffers":[{"byteLength":36,"uri":
      "data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}],"bufferViews":[{"buffer":0,"byteLength":36}],
    "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}]})";
  const Scene scene = load_file("lit.gltf", file);
  ASSERT_EQ(scene.directional.size(), 1u);
  EXPECT_EQ(scene.directional[0].to_light_world, glm::dvec3(0.0, 0.0, 1.0));
  EXPECT_EQ(scene.directional[0].intensity, glm::dvec3(0.0, 1.0, 0.0));
  const Scene own = load_file("own.toml", "[[mesh]]\nfile = \"lit.gltf\"\n");
  EXPECT_TRUE(own.directional.empty());
  EXPECT_EQ(own.notes.at(0), at("lit.gltf").string() + ": its lights are left out; the scene has its own");
}

TEST_F(LoadScene, MeshFilesAreRelativeToTheScene) {
  write("sub/t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const Scene scene = must(load("[[mesh]]\nfile = \"sub/t.obj\"\ntranslate = [0, 0, 7]\n"));
  EXPECT_EQ(scene.positions_world.at(0), glm::dvec3(0.0, 0.0, 7.0));
  ASSERT_EQ(scene.notes.size(), 1u);
  EXPECT_NE(scene.notes[0].find("no light"), std::string::npos);
  write("sub/t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n");
  EXPECT_EQ(error("[[mesh]]\nfile = \"sub/t.obj\"\n")
                .find("sub/t.obj:4: a face names vertex 4, but the file has 3"),
            0u);
}

std::string culling_of(const Scene& scene) {
  std::string all;
  for (const SceneTriangle& triangle : scene.triangles)
    all += triangle.culling == Culling::closed ? 'c' : triangle.culling == Culling::back ? 'b' : 'n';
  return all;
}

TEST_F(LoadScene, OpenSurfacesAreDrawnFromBothSidesUnlessCulled) {
  const std::string tetra = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  EXPECT_EQ(culling_of(load_file("both.obj", tetra + "v 5 0 0\nv 6 0 0\nv 5 1 0\nf 5 6 7\n")), "ccccn");
  const std::string mesh = "[[mesh]]\nfile = \"both.obj\"\n";
  const auto culling = [&](const std::string& toml) { return culling_of(must(load(toml))); };
  EXPECT_EQ(culling(mesh), "ccccn");
  EXPECT_EQ(culling(mesh + "cull = \"auto\"\n"), "ccccn");
  EXPECT_EQ(culling(mesh + "cull = \"back\"\n"), "ccccb");
  EXPECT_EQ(culling(mesh + "cull = \"none\"\n"), "nnnnn");
  EXPECT_EQ(culling(mesh + "scale = [1, -2, 1]\n"), "ccccn");
  // A scene's own value holds for its meshes without one.
  EXPECT_EQ(culling("cull = \"back\"\n" + mesh + "cull = \"none\"\n" + mesh), "nnnnnccccb");
  EXPECT_EQ(culling("cull = \"none\"\n" + mesh + "cull = \"auto\"\n"), "ccccn");
  EXPECT_EQ(error(mesh + "cull = \"front\"\n"),
            "s.toml:3: cull of mesh is 'front', but must be \"auto\", \"back\" or \"none\"");
  const std::string closed =
      "[[mesh]]\nkind = \"box\"\n[[mesh]]\nkind = \"sphere\"\nslices = 3\nstacks = 2\n";
  EXPECT_EQ(culling(closed), std::string(12 + 6, 'c'));
  // The triangle without area closes the surface.
  EXPECT_EQ(culling_of(load_file("seam.obj",
                                 "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv .5 .5 0\n"
                                 "f 1 5 2\nf 1 3 5\nf 2 5 3\nf 1 2 4\nf 1 4 3\nf 2 3 4\n")),
            "ccccc");
}

// A square, and a second one that shares an edge and is wound the other way.
TEST_F(LoadScene, AFaceOfTheOtherWindingIsDrawn) {
  const Scene scene =
      load_file("second_face_clockwise.obj",
                "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\nf 1 2 3 4\nf 2 3 6 5\n");
  EXPECT_EQ(culling_of(scene), "nnnn");
  const std::vector<ScreenTriangle> drawn = Projector(scene, {80, 60}, {}).project_all();
  ASSERT_EQ(drawn.size(), 4u);
  for (const ScreenTriangle& triangle : drawn) {
    EXPECT_EQ(triangle.is_back, triangle.source >= 2);
    for (const ScreenVertex& v : triangle.vertex) EXPECT_EQ(v.normal_world, glm::dvec3(0, 0, 1));
  }
}

// The same triangle seen from its front and, by the other node, from behind.
TEST_F(LoadScene, DoubleSidedOfGltfIsObeyed) {
  const auto load_gltf = [&](const std::string& material) {
    return load_file(
        "sides.gltf",
        R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1]}],"nodes":[{"mesh":0},{"mesh":0,)"
        R"("rotation":[0,1,0,0],"translation":[3,0,0]}],"meshes":[{"primitives":[{"attributes":)"
        R"({"POSITION":0},"material":0}]}],"accessors":[{"bufferView":0,"componentType":5126,"count":3,)"
        R"("type":"VEC3"}],"bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,"uri":)"
        R"("data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}],"materials":[{)" +
            material + "}]}");
  };
  const Scene both = load_gltf(R"("doubleSided":true)");
  EXPECT_EQ(culling_of(both), "nn");
  const std::vector<ScreenTriangle> drawn = Projector(both, {80, 60}, {}).project_all();
  ASSERT_EQ(drawn.size(), 2u);
  for (const ScreenTriangle& triangle : drawn) {
    EXPECT_EQ(triangle.is_back, triangle.source == 1);
    for (const ScreenVertex& v : triangle.vertex) EXPECT_GT(v.normal_world.z, 0.99);
  }
  for (const char* one_sided : {"", R"("doubleSided":false)"}) {
    const Scene front = load_gltf(one_sided);
    EXPECT_EQ(culling_of(front), "bb");
    ProjectionCounts counts;
    EXPECT_EQ(Projector(front, {80, 60}, {}).project_all(&counts).size(), 1u);
    EXPECT_EQ(counts.left_out, 1u);
    const Scene scene = must(load("[[mesh]]\nfile = \"sides.gltf\"\ncull = \"none\"\n"));
    EXPECT_EQ(culling_of(scene), "nn");
  }
  // A material that cannot be read is the default one, which has one side.
  const Scene faulty = load_gltf(R"("doubleSided":1)");
  EXPECT_EQ(culling_of(faulty), "bb");
  EXPECT_TRUE(std::any_of(faulty.notes.begin(), faulty.notes.end(), [](const std::string& note) {
    return note.find("materials[0].doubleSided") != std::string::npos;
  }));
}

// toml++ parses and frees nested tables recursively.
TEST_F(LoadScene, KeysOfManyPartsAreRefused) {
  const std::string mesh = "[[mesh]]\nkind = \"box\"\n";
  std::string deep = "a";
  for (int i = 0; i < 200'000; ++i) deep += ".a";
  EXPECT_EQ(error(mesh + deep + " = 1\n"), "s.toml:3: bad TOML: a key of more than 16 parts");
  EXPECT_EQ(error("[" + deep + "]\n"), "s.toml:1: bad TOML: a key of more than 16 parts");
  EXPECT_EQ(error("a = [\n{ b = '''\n''', " + deep + " = 1 }]\n"),
            "s.toml:3: bad TOML: a key of more than 16 parts");
  // After characters that only look like the start or the end of a text or a comment.
  for (const std::string before :
       {R"(b = "\"")", R"(b = '\')", R"(b = """x""""")", R"(b = '''x''''')", R"(b = "")", R"(b = '')",
        R"(# ")", R"(b = "#")", R"(b = """\"""")", R"(b = """"""")", R"(b = """""")"})
    EXPECT_NE(error(before + "\n" + deep + " = 1\n").find("a key of more than 16 parts"), std::string::npos)
        << before;
  // Dots in texts and comments do not count.
  const std::string dots(40, '.');
  for (const std::string& text :
       {'"' + dots + '"', "'" + dots + "'", "\"\"\"\n" + dots + "\"\"\"", "'''" + dots + "'''"})
    EXPECT_EQ(error("[[material]] # " + dots + "\nname = " + text + "\n" + mesh), "loaded") << text;
}

TEST_F(LoadScene, NamesThatCannotBeFoldersAreRefused) {
  for (const std::string name : {"..toml", "...toml", "a\nb.toml", "\x1b[31m.toml"}) {
    EXPECT_TRUE(is_error(load_scene(write(name, "[[mesh]]\nkind = \"box\"\n").string(), c_built_in_scenes),
                         "a scene cannot be called"))
        << name;
  }
}

TEST_F(LoadScene, AFittedCameraHasAViewOrTheSceneIsRefused) {
  EXPECT_NE(error("[[mesh]]\nkind = \"box\"\nsize = 1e-9\ntranslate = [1e6, 0, 0]\n")
                .find("a camera cannot be fitted"),
            std::string::npos);
  EXPECT_EQ(error("[[mesh]]\nkind = \"box\"\nsize = 1e-3\ntranslate = [1e6, 0, 0]\n"), "loaded");
}

}  // namespace
}  // namespace halfway
