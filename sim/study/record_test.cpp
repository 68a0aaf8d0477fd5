// SPDX-License-Identifier: Apache-2.0
// A record is valid only for the scene, program, RTL and tools that it was measured with.
#include "sim/study/record.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "sim/files/image_library.hpp"
#include "sim/files/test/built_in_scene.hpp"
#include "sim/os/test/folder_test.hpp"

namespace halfway::study {
namespace {

Scene scene_of_everything() {
  Scene scene = built_in_scene(c_source_folder / "sim/study/spaces/sphere.toml", {.tessellation = 0.25});
  scene.positional.resize(2);
  scene.spots.resize(2);
  scene.materials.resize(2);
  return scene;
}

TEST(SceneHash, ChangesWithEveryNumberThatAPictureDependsOn) {
  constexpr double c_tiny = 1e-12;
  using Change = std::function<void(Scene&)>;
  std::vector<std::pair<std::string, Change>> changes;
  const auto vector = [&](const std::string& name, const auto& change) {
    for (int i = 0; i < 3; ++i)
      changes.emplace_back(name + std::to_string(i), [change, i](Scene& s) { change(s, i); });
  };
  vector("eye", [](Scene& s, int i) { s.camera.eye_world[i] += c_tiny; });
  vector("target", [](Scene& s, int i) { s.camera.target_world[i] += c_tiny; });
  vector("up", [](Scene& s, int i) { s.camera.up_world[i] += c_tiny; });
  changes.emplace_back("fov", [](Scene& s) { s.camera.vertical_fov_degrees += c_tiny; });
  changes.emplace_back("near", [](Scene& s) { s.camera.near += c_tiny; });
  changes.emplace_back("far", [](Scene& s) { s.camera.far += c_tiny; });
  vector("ambient", [](Scene& s, int i) { s.ambient[i] += c_tiny; });
  vector("background", [](Scene& s, int i) { s.background[i] += c_tiny; });
  changes.emplace_back("shadows", [](Scene& s) { s.shadows = !s.shadows; });
  vector("to light", [](Scene& s, int i) { s.directional[0].to_light_world[i] += c_tiny; });
  vector("directional", [](Scene& s, int i) { s.directional[0].intensity[i] += c_tiny; });
  vector("position of a light", [](Scene& s, int i) { s.positional[1].position_world[i] += c_tiny; });
  vector("positional", [](Scene& s, int i) { s.positional[1].intensity[i] += c_tiny; });
  vector("position of a spot", [](Scene& s, int i) { s.spots[1].position_world[i] += c_tiny; });
  vector("axis", [](Scene& s, int i) { s.spots[1].axis_world[i] += c_tiny; });
  changes.emplace_back("inner", [](Scene& s) { s.spots[1].cos_inner += c_tiny; });
  changes.emplace_back("outer", [](Scene& s) { s.spots[1].cos_outer += c_tiny; });
  vector("spot", [](Scene& s, int i) { s.spots[1].intensity[i] += c_tiny; });
  changes.emplace_back("brdf", [](Scene& s) { s.materials[1].brdf = Brdf::phong; });
  vector("colour", [](Scene& s, int i) { s.materials[1].colour[i] += c_tiny; });
  vector("specular colour", [](Scene& s, int i) { s.materials[1].specular_colour[i] += c_tiny; });
  vector("emission", [](Scene& s, int i) { s.materials[1].emission[i] += c_tiny; });
  for (double Material::* number : {&Material::ambient, &Material::diffuse, &Material::specular,
                                    &Material::exponent, &Material::roughness, &Material::reflectance})
    changes.emplace_back("a material's number", [number](Scene& s) { s.materials[1].*number += c_tiny; });
  vector("vertex", [](Scene& s, int i) { s.positions_world.back()[i] += c_tiny; });
  vector("normal", [](Scene& s, int i) { s.normals_world.back()[i] += c_tiny; });
  changes.emplace_back("corner", [](Scene& s) { s.triangles.back().position[2] ^= 1U; });
  changes.emplace_back("corner's normal", [](Scene& s) { s.triangles.back().normal[2] ^= 1U; });
  changes.emplace_back("material of a triangle", [](Scene& s) { s.triangles.back().material ^= 1U; });
  changes.emplace_back("back of a triangle", [](Scene& s) { s.triangles.back().culling = Culling::none; });
  changes.emplace_back("a directional light more", [](Scene& s) { s.directional.emplace_back(); });
  changes.emplace_back("a positional light more", [](Scene& s) { s.positional.emplace_back(); });
  changes.emplace_back("a spot more", [](Scene& s) { s.spots.emplace_back(); });
  changes.emplace_back("a light less", [](Scene& s) { s.positional.pop_back(); });
  changes.emplace_back("a spot less", [](Scene& s) { s.spots.pop_back(); });
  changes.emplace_back("a material less", [](Scene& s) { s.materials.pop_back(); });
  changes.emplace_back("a triangle less", [](Scene& s) { s.triangles.pop_back(); });

  const Scene scene = scene_of_everything();
  std::set<std::string> hashes = {scene_hash(scene)};
  EXPECT_EQ(scene_hash(scene_of_everything()), *hashes.begin());
  for (const auto& [name, change] : changes) {
    Scene changed = scene;
    change(changed);
    EXPECT_TRUE(hashes.insert(scene_hash(changed)).second) << name;
  }
}

using RecordsTest = FolderTest;

TEST_F(RecordsTest, AreFoundByTheirProvenanceOnly) {
  const Provenance known{"scene", "1", "2", "3", "4"};
  Record record{{.method = Method::adaptive}, {}};
  record.measured.picture.psnr_db = std::numeric_limits<double>::infinity();
  record.measured.cycles = 77;
  const Records records(here(), known);
  records.add_frame(record.point, Frame(record.point.size));
  records.add(record);
  const auto find = [&](const Provenance& provenance, const DesignPoint& point) {
    return Records(here(), provenance).find(point);
  };
  const auto found = find(known, record.point);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->measured.cycles, 77U);
  EXPECT_EQ(found->measured.picture.psnr_db, std::numeric_limits<double>::infinity());
  EXPECT_EQ(found->measured.host_instructions, std::nullopt);
  for (std::string Provenance::* part : {&Provenance::scene, &Provenance::scene_hash, &Provenance::program,
                                         &Provenance::rtl, &Provenance::tools}) {
    Provenance other = known;
    other.*part += "0";
    EXPECT_FALSE(find(other, record.point)) << other.*part;
  }
  DesignPoint other = record.point;
  other.host.quadratic.threshold = 4.0;
  EXPECT_FALSE(find(known, other));
  write(records.file(record.point), "{}");
  EXPECT_FALSE(find(known, record.point));
  records.add(record);
  EXPECT_TRUE(find(known, record.point));
  std::filesystem::remove(records.picture(record.point));
  EXPECT_FALSE(find(known, record.point));
}

// Change one byte, or one file name, of a checkout's RTL.
TEST_F(RecordsTest, ProvenanceCoversEveryFileOfTheRtl) {
  const Scene scene = scene_of_everything();
  std::set<std::string> hashes;
  const auto expect_another = [&](const char* what) {
    const Provenance provenance = provenance_of(scene, {here(), at("cache")});
    EXPECT_TRUE(hashes.insert(provenance.rtl).second) << what;
    EXPECT_EQ(provenance.scene_hash, scene_hash(scene));
  };
  write("rtl/a.vhd", "a");
  expect_another("one file");
  write("rtl/part/b.vhd", "b");
  expect_another("two");
  write("rtl/part/b.vhd", "c");
  expect_another("a byte");
  std::filesystem::rename(at("rtl/a.vhd"), at("rtl/d.vhd"));
  expect_another("a name");
}

// A program with one byte more is another program; an identical copy is the same.
TEST_F(RecordsTest, ProvenanceCoversTheProgram) {
  const std::string mine = text_of("/proc/self/exe"), images = text_of(image_library_file());
  const Provenance provenance = provenance_of(scene_of_everything(), {c_source_folder, here()});
  EXPECT_THAT(provenance.tools,
              ::testing::ContainsRegex("GHDL .*Verilator .*OpenImageIO [0-9]+[.][0-9]+[.][0-9]+"));
  const std::string mesa = text_of(mesa_program(c_source_folder));
  EXPECT_EQ(provenance.program, ContentHash().add(mine).add(images).add(mesa).hex());
  EXPECT_NE(provenance.program, ContentHash().add(mine + '\0').add(images).add(mesa).hex());
  EXPECT_NE(provenance.program, ContentHash().add(mine).add(images).add(mesa + '\0').hex());
}

}  // namespace
}  // namespace halfway::study
