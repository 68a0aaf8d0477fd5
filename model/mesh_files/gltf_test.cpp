// SPDX-License-Identifier: Apache-2.0
#include "mesh_files/gltf.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "mesh_files/test/spelling.hpp"
#include "sim/os/must.hpp"

namespace halfway {
namespace {

using nlohmann::json;

/// Bytes 0 to 47: the positions (0,0,0) (1,0,0) (0,1,0) (1,1,0). 48 to 57: the indices 0 1 2 3 1, 16 bits
/// each; 58 and 59 unused. 60 to 63: the bytes 0 2 3 9. 64 to 75: (5,6,7).
std::string buffer() {
  std::string bytes;
  for (const float x : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f, 1.f, 1.f, 0.f})
    bytes += little_endian(x);
  for (const int i : {0, 1, 2, 3, 1, 0}) bytes += little_endian(static_cast<std::uint16_t>(i));
  bytes += std::string("\0\2\3\x9", 4);
  for (const float x : {5.f, 6.f, 7.f}) bytes += little_endian(x);
  return bytes;
}

/// A triangle: accessor 0 has the positions, accessor 1 the first three indices.
json plain(const std::string& bytes = buffer()) {
  json file =
      json::parse(R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
    "meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],"buffers":[{}],
    "bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":10},
                   {"buffer":0,"byteOffset":60,"byteLength":4},{"buffer":0,"byteOffset":64,"byteLength":12}],
    "accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},
                 {"bufferView":1,"componentType":5123,"count":3,"type":"SCALAR"}]})");
  file["buffers"][0]["byteLength"] = bytes.size();
  file["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64(bytes);
  return file;
}

/// The file with values at these places; null removes one.
std::string with(const std::vector<std::pair<const char*, json>>& changes, json file = plain()) {
  for (const auto& [place, value] : changes) {
    const json::json_pointer pointer(place);
    if (value.is_null()) {
      file[pointer.parent_pointer()].erase(pointer.back());
    } else {
      file[pointer] = value;
    }
  }
  return file.dump();
}

/// Read a file next to which there is one other.
Result<LoadedMesh> read_gltf(std::string_view text, std::string_view file) {
  return halfway::read_gltf(text, file, [](std::string_view name) {
    return name == "sub/a b.bin" ? BufferFile{.refusal = {}, .bytes = buffer()}
                                 : BufferFile{.refusal = "is not here", .bytes = {}};
  });
}
std::string triangles(const std::string& text) {
  return triangles_of(read_gltf(text, "a.gltf"));
}

std::string floats(const std::vector<float>& values) {
  std::string bytes;
  for (const float x : values) bytes += little_endian(x);
  return bytes;
}
/// A buffer.
json bytes_of(const std::string& bytes) {
  return {{"byteLength", bytes.size()}, {"uri", "data:;base64," + base64(bytes)}};
}

class GltfSpelling : public ::testing::TestWithParam<Spelling> {};

TEST_P(GltfSpelling, IsReadExactlyOrRefusedWithItsPlace) {
  EXPECT_EQ(triangles(GetParam().text), GetParam().wanted);
}

const json c_sparse = json::parse(
    R"({"count":1,"indices":{"bufferView":2,"byteOffset":1,"componentType":5121},"values":{"bufferView":3}})");

const std::vector<Spelling> c_spellings = {
    {"plain", with({}), c_triangle},
    {"byte_order_mark", "\xef\xbb\xbf" + with({}), c_triangle},

    // modes
    {"strip", with({{"/meshes/0/primitives/0/mode", 5}, {"/accessors/1/count", 4}}),
     c_triangle + "; 0,1,0 1,0,0 1,1,0"},
    {"fan", with({{"/meshes/0/primitives/0/mode", 6}, {"/accessors/1/count", 4}}),
     c_triangle + "; 0,0,0 0,1,0 1,1,0"},
    {"lines", with({{"/meshes/0/primitives/0/mode", 1}}),
     "! a.gltf: the mesh has no faces; export it with faces"},
    {"mode_7", with({{"/meshes/0/primitives/0/mode", 7}}),
     "! a.gltf: meshes[0].primitives[0].mode: 7 is not a mode of glTF; correct it"},
    {"four_corners", with({{"/accessors/1/count", 4}}),
     "! a.gltf: meshes[0].primitives[0]: 4 corners are not whole triangles; export the file again"},

    {"no_position", with({{"/meshes/0/primitives/0/attributes", json::object()}}),
     "! a.gltf: the mesh has no faces; export it with faces"},

    // accessors
    {"bytes_as_indices", with({{"/accessors/1/bufferView", 2}, {"/accessors/1/componentType", 5121}}),
     "0,0,0 0,1,0 1,1,0"},
    {"index_beyond", with({{"/accessors/0/count", 2}}),
     "! a.gltf: meshes[0].primitives[0].indices: index 2 names vertex 2, but the primitive has 2, counted "
     "from 0; "
     "correct the index"},
    {"count_beyond", with({{"/accessors/1/count", 6}}),
     "! a.gltf: accessors[1]: 6 items of 2 bytes end after the buffer view of 10 bytes; export the file "
     "again"},
    {"offset_beyond", with({{"/accessors/0/byteOffset", 4}}),
     "! a.gltf: accessors[0]: 4 items of 12 bytes end after the buffer view of 48 bytes; export the file "
     "again"},
    {"count_0", with({{"/accessors/1/count", 0}}),
     "! a.gltf: accessors[1].count: 0, not 1 to 30000000; correct the mesh"},
    {"count_huge", with({{"/accessors/0/count", 1'000'000'000'000'000}}),
     "! a.gltf: accessors[0].count: 1000000000000000, not 1 to 30000000; correct the mesh"},
    {"count_3.0", with({{"/accessors/1/count", 3.0}}), c_triangle},
    {"count_3.5", with({{"/accessors/1/count", 3.5}}),
     "! a.gltf: accessors[1].count: is not a whole number from 0; correct it"},
    {"indices_of_float", with({{"/accessors/1/componentType", 5126}}),
     "! a.gltf: accessors[1].componentType: 5126 is not an unsigned integer; export the file again"},
    {"positions_quantized", with({{"/accessors/0/componentType", 5123}}),
     "! a.gltf: accessors[0].componentType: 5123 is not float (5126), as "
     "meshes[0].primitives[0].attributes.POSITION requires; export the file without quantization"},
    {"positions_of_two", with({{"/accessors/0/type", "VEC2"}}),
     "! a.gltf: accessors[0].type: 'VEC2' is not VEC3, as meshes[0].primitives[0].attributes.POSITION "
     "requires; "
     "export the file again"},
    {"other_component_type", with({{"/accessors/0/componentType", 5130}}),
     "! a.gltf: accessors[0].componentType: 5130 is not a type of glTF; export the file again"},
    {"view_after_its_buffer", with({{"/bufferViews/1/byteLength", 29}}),
     "! a.gltf: bufferViews[1]: ends after its buffer of 76 bytes; export the file again"},
    {"interleaved",
     with({{"/bufferViews/0/byteStride", 16}, {"/bufferViews/0/byteLength", 44}, {"/accessors/0/count", 3}}),
     "0,0,0 0,0,0 0,1,1"},
    {"stride_too_small", with({{"/bufferViews/0/byteStride", 8}}),
     "! a.gltf: bufferViews[0].byteStride: is 8 for items of 12 bytes; correct it"},
    {"stride_of_text", with({{"/bufferViews/0/byteStride", "12"}}),
     "! a.gltf: bufferViews[0].byteStride: is not a whole number from 0; correct it"},
    {"no_views", with({{"/bufferViews", nullptr}}),
     "! a.gltf: accessors[0].bufferView: is 0, but the file has 0, counted from 0; correct the index"},
    {"sparse", with({{"/accessors/0/sparse", c_sparse}}), "0,0,0 1,0,0 5,6,7"},
    {"sparse_of_zeros", with({{"/accessors/0/sparse", c_sparse}, {"/accessors/0/bufferView", nullptr}}),
     "0,0,0 0,0,0 5,6,7"},
    {"sparse_beyond",
     with({{"/accessors/0/sparse", c_sparse}, {"/accessors/0/sparse/indices/byteOffset", 3}}),
     "! a.gltf: accessors[0].sparse.indices: index 0 is 9, but the accessor has 4 items; correct it"},
    {"nan", plain(std::string("\0\0\xc0\x7f", 4) + buffer().substr(4)).dump(),
     "! a.gltf: accessors[0]: vector 0 has a number that is not finite; correct it"},
    {"normals_missing_some",
     with(
         {{"/meshes/0/primitives/0/attributes/NORMAL", 2},
          {"/accessors/2", json::parse(R"({"bufferView":3,"componentType":5126,"count":1,"type":"VEC3"})")}}),
     "! a.gltf: meshes[0].primitives[0].attributes.NORMAL: has 1 normals for 4 positions; export the file "
     "again"},

    // buffers
    {"buffer_short", with({{"/buffers/0/byteLength", 77}}),
     "! a.gltf: buffers[0]: must have 77 bytes, it has 76; export the file with its buffers"},
    {"not_base64", with({{"/buffers/0/uri", "data:;base64,AA?A"}}),
     "! a.gltf: buffers[0].uri: '?' is not base64; export the file again"},
    {"base64_truncated", with({{"/buffers/0/uri", "data:;base64,AAAAA"}}),
     "! a.gltf: buffers[0].uri: its base64 is truncated; export the file again"},
    {"data_as_text", with({{"/buffers/0/uri", "data:text/plain,abc"}}),
     "! a.gltf: buffers[0].uri: its data are not base64; export the file again"},
    {"address", with({{"/buffers/0/uri", "https://example.com/a.bin"}}),
     "! a.gltf: buffers[0].uri: 'https://example.com/a.bin' is an address; store the buffer in a file next "
     "to "
     "this one"},
    {"up_encoded", with({{"/buffers/0/uri", "%2e%2E/a.bin"}}),
     "! a.gltf: buffers[0].uri: '../a.bin' is outside of the file's folder; move the buffer next to this "
     "file"},
    {"absolute", with({{"/buffers/0/uri", "/dev/zero"}}),
     "! a.gltf: buffers[0].uri: '/dev/zero' is outside of the file's folder; move the buffer next to this "
     "file"},
    {"percent", with({{"/buffers/0/uri", "a%2"}}),
     "! a.gltf: buffers[0].uri: % is not followed by two hexadecimal digits; correct it"},
    {"gone", with({{"/buffers/0/uri", "gone.bin"}}), "! a.gltf: buffers[0].uri: 'gone.bin' is not here"},
    {"in_a_file", with({{"/buffers/0/uri", "sub/a%20b.bin"}}), c_triangle},
    {"no_uri", with({{"/buffers/0/uri", nullptr}}),
     "! a.gltf: buffers[0]: has no uri; export the file with its buffers"},

    // nodes
    {"translation", with({{"/nodes/0/translation", {1, 2, 0.3}}}), "1,2,0.3 2,2,0.3 1,3,0.3"},
    {"scale_then_rotation_then_translation",
     with({{"/nodes/0/scale", {2, 3, 1}},
           {"/nodes/0/rotation", {0, 0, 1, 0}},
           {"/nodes/0/translation", {10, 0, 0}}}),
     "10,0,0 8,0,0 10,-3,0"},
    {"matrix", with({{"/nodes/0/matrix", {0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1}}}),
     "5,6,7 5,7,7 4,6,7"},
    {"mirrored", with({{"/nodes/0/scale", {-1, 1, 1}}}), "0,0,0 0,1,0 -1,0,0"},
    {"children", with({{"/nodes", json::parse(R"([{"children":[1],"translation":[1,0,0]},
                                                  {"mesh":0,"translation":[0,1,0]}])")}}),
     "1,1,0 2,1,0 1,2,0"},
    {"no_nodes", with({{"/nodes", nullptr}}),
     "! a.gltf: scenes[0].nodes[0]: is 0, but the file has 0, counted from 0; correct the index"},
    {"translation_of_two", with({{"/nodes/0/translation", {1, 2}}}),
     "! a.gltf: nodes[0].translation: has 2 numbers, not 3; correct it"},
    {"scale_0", with({{"/nodes/0/scale", {0, 0, 0}}}),
     "! a.gltf: the mesh has no faces; export it with faces"},
    {"flat", with({{"/nodes/0/scale", {1, 2, 0}}}), "0,0,0 1,0,0 0,2,0"},
    {"matrix_rounded",
     with({{"/nodes/0/matrix", {1, 0, 0, 1e-8, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0.99999994}},
           {"/nodes/1", {{"children", {0}}, {"translation", {1, 0, 0}}}},
           {"/scenes/0/nodes", {1}}}),
     "1,0,0 2,0,0 1,1,0"},
    {"translation_huge", with({{"/nodes/0/translation", {1e300, 0, 0}}}),
     "! a.gltf: nodes[0]: its transform moves a vertex beyond the range of float; correct it"},
    {"rotation_0", with({{"/nodes/0/rotation", {0, 0, 0, 0}}}), c_triangle},
    {"rotation_of_length_2", with({{"/nodes/0/rotation", {0, 0, 2, 0}}}), "0,0,0 -1,0,0 0,-1,0"},
    {"skinned_node_is_moved",
     with({{"/nodes/0/skin", 0},
           {"/nodes/0/translation", {9, 9, 0}},
           {"/nodes/0/children", {1}},
           {"/nodes/1", {{"mesh", 0}}},
           {"/skins", json::parse(R"([{"joints":[0]}])")}}),
     c_triangle + "; 9,9,0 10,9,0 9,10,0"},
    {"instances",
     with({{"/nodes/0/translation", {10, 0, 0}},
           {"/nodes/0/extensions/EXT_mesh_gpu_instancing/attributes/TRANSLATION", 0},
           {"/nodes/0/extensions/EXT_mesh_gpu_instancing/attributes/SCALE", 2},
           {"/extensionsRequired", {"EXT_mesh_gpu_instancing"}},
           {"/accessors/0/count", 3},
           {"/accessors/2",
            json::parse(R"({"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","sparse":
             {"count":3,"indices":{"bufferView":4,"componentType":5121},"values":{"bufferView":5}}})")},
           {"/bufferViews/4", json::parse(R"({"buffer":1,"byteLength":3})")},
           {"/bufferViews/5", json::parse(R"({"buffer":1,"byteLength":36,"byteOffset":4})")},
           {"/buffers/1", bytes_of(std::string("\0\1\2\0", 4) + floats({1, 1, 1, 2, 2, 2, -1, 1, 1}))}}),
     "10,0,0 11,0,0 10,1,0; 11,0,0 13,0,0 11,2,0; 10,1,0 10,2,0 9,1,0"},
    {"instances_rotated",
     with({{"/nodes/0/extensions/EXT_mesh_gpu_instancing/attributes/ROTATION", 2},
           {"/accessors/2", json::parse(R"({"bufferView":4,"componentType":5120,"count":2,"type":"VEC4"})")},
           {"/bufferViews/4", json::parse(R"({"buffer":1,"byteLength":8})")},
           {"/buffers/1", bytes_of("\xc0@@@" + std::string("\0\0\0\x81", 4))}}),
     "0,0,0 0,0,-1 -1,0,0; " + c_triangle},
    {"instances_without_attributes",
     with({{"/nodes/0/extensions/EXT_mesh_gpu_instancing/attributes", json::object()}}), c_triangle},
    {"lights_that_are_no_list", with({{"/extensions/KHR_lights_punctual/lights", 5}}), c_triangle},
    {"instances_of_two_counts",
     with({{"/nodes/0/extensions/EXT_mesh_gpu_instancing/attributes", {{"TRANSLATION", 0}, {"SCALE", 2}}},
           {"/accessors/2", json::parse(R"({"componentType":5126,"count":3,"type":"VEC3"})")}}),
     "! a.gltf: nodes[0].extensions.EXT_mesh_gpu_instancing.attributes: has 4 and 3 instances; export the "
     "file "
     "again"},
    {"instances_fewer_than_scales",
     with({{"/nodes/0/extensions/EXT_mesh_gpu_instancing/attributes", {{"TRANSLATION", 2}, {"SCALE", 0}}},
           {"/accessors/2", json::parse(R"({"componentType":5126,"count":3,"type":"VEC3"})")}}),
     "! a.gltf: nodes[0].extensions.EXT_mesh_gpu_instancing.attributes: has 3 and 4 instances; export the "
     "file again"},
    {"instances_too_many",
     with({{"/nodes/0/extensions/EXT_mesh_gpu_instancing/attributes/SCALE", 2},
           {"/accessors/2", json::parse(R"({"componentType":5126,"count":1000001,"type":"VEC3"})")}}),
     "! a.gltf: nodes[0].extensions.EXT_mesh_gpu_instancing.attributes.SCALE: more than 1000000 instances; "
     "export fewer"},
    {"perspective", with({{"/nodes/0/matrix", {1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}}),
     "! a.gltf: nodes[0].matrix: its last row is not 0 0 0 1; export the file again"},
    {"node_in_a_circle", with({{"/nodes/0/children", {0}}}),
     "! a.gltf: nodes[0]: is reached twice; export the file with a tree of nodes"},
    {"scene_selected", with({{"/scenes", json::parse(R"([{"nodes":[]},{"nodes":[0]}])")}, {"/scene", 1}}),
     c_triangle},
    {"scene_empty", with({{"/scenes", json::parse(R"([{"nodes":[]},{"nodes":[0]}])")}}),
     "! a.gltf: the mesh has no faces; export it with faces"},
    {"no_scene", with({{"/scenes", nullptr}, {"/scene", nullptr}}), c_triangle},

    // the file
    {"not_json", "{\n\"asset\": {\"version\": 2.0,,\n",
     "! a.gltf:2: not glTF 2.0: its JSON is damaged here; export the file again"},
    {"number_too_large", "{\"a\":1,\n\"b\":1e999}",
     "! a.gltf:2: the number '1e999' is too large; correct it"},
    {"utf_16", "\xfe\xff{}", "! a.gltf:1: the text is UTF-16; save it as UTF-8"},
    {"array", "[]", "! a.gltf:1: not glTF 2.0: its JSON is not an object"},
    {"deep",
     with({}).insert(1, R"("extras":)" + std::string(1'000'000, '[') + std::string(1'000'000, ']') + ","),
     c_triangle},
    {"version_1", with({{"/asset/version", "1.0"}}), "! a.gltf: asset: glTF '1.0'; export as glTF 2.0"},
    {"version_1_with_other_faults",
     with({{"/asset/version", "1.0"}, {"/extensions/KHR_lights_punctual/lights", 5}, {"/nodes", 5}}),
     "! a.gltf: asset: glTF '1.0'; export as glTF 2.0"},
    {"no_asset", with({{"/asset", nullptr}}), "! a.gltf: no asset; export the file again"},
    {"draco", with({{"/extensionsRequired", {"KHR_draco_mesh_compression"}}}),
     "! a.gltf: extensionsRequired[0]: 'KHR_draco_mesh_compression' cannot be read; export the file without "
     "it"},
    {"unlit", with({{"/extensionsRequired", {"KHR_materials_unlit"}}}), c_triangle},
    {"emissive_strength", with({{"/extensionsRequired", {"KHR_materials_emissive_strength"}}}), c_triangle},
    {"transmission", with({{"/extensionsRequired", {"KHR_materials_transmission"}}}),
     "! a.gltf: extensionsRequired[0]: 'KHR_materials_transmission' cannot be read; export the file without "
     "it"},
    {"later_version", with({{"/asset/minVersion", "2.1"}}),
     "! a.gltf: asset.minVersion: is later than 2.0; export as glTF 2.0"},
    {"invisible",
     with({{"/nodes/1",
            json::parse(R"({"children":[0],"extensions":{"KHR_node_visibility":{"visible":false}}})")},
           {"/scenes/0/nodes", {1}}}),
     "! a.gltf: the mesh has no faces; export it with faces"},
    {"transparent",
     with({{"/meshes/0/primitives/0/material", 0},
           {"/materials",
            json::parse(R"([{"alphaMode":"BLEND","pbrMetallicRoughness":{"baseColorFactor":[1,1,1,0]}}])")}}),
     "! a.gltf: the mesh has no faces; export it with faces"},
};

INSTANTIATE_TEST_SUITE_P(All, GltfSpelling, ::testing::ValuesIn(c_spellings), name_of);

// ---- GLB

std::string chunk(const std::string& type, const std::string& data) {
  return little_endian(static_cast<std::uint32_t>(data.size())) + type + data;
}
std::string glb(const std::string& chunks, std::uint32_t version = 2, std::uint32_t extra = 0) {
  return "glTF" + little_endian(version) +
         little_endian(static_cast<std::uint32_t>(12 + chunks.size()) + extra) + chunks;
}
std::string json_chunk() {
  return chunk("JSON", with({{"/buffers/0/uri", nullptr}}));
}
const std::string c_binary_type("BIN\0", 4);

INSTANTIATE_TEST_SUITE_P(
    Glb, GltfSpelling,
    ::testing::Values(
        Spelling{"plain", glb(json_chunk() + chunk(c_binary_type, buffer())), c_triangle},
        Spelling{"more_chunks", glb(json_chunk() + chunk(c_binary_type, buffer()) + chunk("MORE", "xyz")),
                 c_triangle},
        Spelling{"no_binary", glb(json_chunk()),
                 "! a.gltf: buffers[0]: has no uri; export the file with its buffers"},
        Spelling{"binary_short", glb(json_chunk() + chunk(c_binary_type, buffer().substr(1))),
                 "! a.gltf: buffers[0]: must have 76 bytes, it has 75; export the file with its buffers"},
        Spelling{"version_1", glb(json_chunk(), 1), "! a.gltf: byte 4: GLB version 1; export as version 2"},
        Spelling{"header_only", "glTF",
                 "! a.gltf: byte 0: the file ends in its header; it is truncated, export it again"},
        Spelling{"length_too_large", glb(chunk("JSON", "{}"), 2, 1),
                 "! a.gltf: byte 8: its header requires 23 bytes, it has 22; export it again"},
        Spelling{"trailing_byte", glb(chunk("JSON", "{}")) + "x",
                 "! a.gltf: byte 8: its header requires 22 bytes, it has 23; export it again"},
        Spelling{"chunk_too_long", glb(little_endian(std::uint32_t{3}) + "JSON{}"),
                 "! a.gltf: byte 12: chunk 0 is longer than the file; export the file again"},
        Spelling{"binary_first", glb(chunk(c_binary_type, "ab") + chunk("JSON", "{}")),
                 "! a.gltf: byte 12: the first chunk, and no other, must be JSON; export the file again"}),
    name_of);

// ---- Normals, files, notes

TEST(Gltf, NormalsAreThoseOfTheVertices) {
  const auto loaded = must(read_gltf(with({{"/meshes/0/primitives/0/attributes/NORMAL", 0}}), "a.gltf"));
  EXPECT_EQ(normals_of(loaded), "0,0,0 1,0,0 0,1,0 ");
}

TEST(Gltf, WithoutNormalsOrMaterialThereAreDefaults) {
  const auto loaded = must(read_gltf(with({}), "a.gltf"));
  EXPECT_EQ(normals_of(loaded), "0,0,0 0,0,0 0,0,0 ");
  ASSERT_EQ(loaded.mesh.materials.size(), 1u);
  EXPECT_EQ(loaded.mesh.materials[0].name, "default");
  EXPECT_EQ(loaded.mesh.materials[0].specular, 0.0);  // glTF's default roughness is 1
  EXPECT_TRUE(loaded.notes.empty());
}

TEST(Gltf, NotesSayWhatIsLeftOut) {
  const auto loaded =
      read_gltf(with({{"/meshes/0/primitives/1", json::parse(R"({"attributes":{"POSITION":0},"mode":0})")},
                      {"/meshes/0/primitives/0/attributes/COLOR_0", 0},
                      {"/nodes/0/skin", 0},
                      {"/meshes/0/primitives/0/targets", json::array()},
                      {"/meshes/0/primitives/0/material", 0},
                      {"/materials", json::parse(R"([{"name":"m","normalTexture":{"index":0},
                                           "pbrMetallicRoughness":{"roughnessFactor":0.95}}])")}}),
                "a.gltf");
  ASSERT_TRUE(loaded) << loaded.error().message;
  ASSERT_EQ(loaded->notes.size(), 6u);
  EXPECT_EQ(loaded->notes[0], "a.gltf: 1 points and lines left out");
  EXPECT_EQ(loaded->notes[1], "a.gltf: nodes[0]: bones are omitted: the mesh is in its bind pose");
  EXPECT_TRUE(loaded->notes[2].starts_with("a.gltf: material 'm': exponent 0.45")) << loaded->notes[2];
  EXPECT_EQ(loaded->notes[3], "a.gltf: material 'm': textures are left out");
  EXPECT_EQ(loaded->notes[4], "a.gltf: meshes[0].primitives[0]: morph targets are left out");
  EXPECT_EQ(loaded->notes[5], "a.gltf: meshes[0].primitives[0]: vertex colours are left out");
}

using TextList = std::vector<std::string>;

TEST(Gltf, ANodeOfScaleZeroLeavesTheOthers) {
  const auto nodes = json::parse(R"([{"mesh":0},{"mesh":0,"scale":[0,0,0]}])");
  const auto loaded = must(read_gltf(with({{"/nodes", nodes}, {"/scenes/0/nodes", {0, 1}}}), "a.gltf"));
  EXPECT_EQ(triangles_of(loaded), c_triangle);
  EXPECT_EQ(loaded.notes,
            (TextList{"a.gltf: nodes[1]: its transform has a scale of zero: it is flat, or not drawn",
                      "a.gltf: nodes[1]: triangles without area are left out"}));
}

TEST(Gltf, ATransformThatIsNotARotationIsNoted) {
  const auto flat = must(read_gltf(
      with({{"/nodes/0/scale", {1, 2, 0}}, {"/meshes/0/primitives/0/attributes/NORMAL", 0}}), "a.gltf"));
  EXPECT_EQ(normals_of(flat), "0,0,0 0,0,0 0,0,0 ");
  EXPECT_EQ(
      must(read_gltf(with({{"/nodes/0/rotation", {0, 0, 2, 0}}}), "a.gltf")).notes,
      TextList{"a.gltf: nodes[0]: its rotation does not have the length 1; only its direction is used"});
}

/// The only material of a file with this one.
LoadedMesh with_material(const json& material, const json& index = 0) {
  return must(read_gltf(
      with({{"/meshes/0/primitives/0/material", index}, {"/materials", json::array({material})}}), "a.gltf"));
}

TEST(Gltf, AMaterialThatCannotBeReadIsTheDefault) {
  const auto wrong =
      json::parse(R"({"name":"m","pbrMetallicRoughness":{"baseColorFactor":[1,0,-1,1],"metallicFactor":2}})");
  for (const auto& [loaded, note] :
       {std::pair(with_material(wrong),
                  "materials[0].pbrMetallicRoughness.baseColorFactor: is negative; correct "
                  "the colour; it is the default material"),
        std::pair(with_material(json::object(), 7),
                  "meshes[0].primitives[0].material: is 7, but the file has 1, "
                  "counted from 0; correct the index; it has the default material")}) {
    EXPECT_EQ(loaded.mesh.materials.at(0).name, "default");
    EXPECT_EQ(loaded.notes, TextList{std::string("a.gltf: ") + note});
  }
}

TEST(Gltf, EmissionIsRead) {
  const auto plain = with_material(json::parse("{}"));
  const auto loaded = with_material(json::parse(R"({"emissiveFactor":[1,0.8,0.1]})"));
  const Material& m = loaded.mesh.materials.at(0);
  EXPECT_EQ(m.emission, glm::dvec3(1.0, 0.8, 0.1));
  EXPECT_EQ(m.colour, plain.mesh.materials.at(0).colour);
  EXPECT_EQ(m.diffuse, plain.mesh.materials.at(0).diffuse);
  EXPECT_EQ(loaded.notes, TextList{});
  const auto with_strength = [](const std::string& strength) {
    return with_material(
        json::parse(R"({"emissiveFactor":[1,0.5,0],"extensions":{"KHR_materials_emissive_strength":{)" +
                    strength + "}}}"));
  };
  EXPECT_EQ(with_strength(R"("emissiveStrength":4)").mesh.materials.at(0).emission,
            glm::dvec3(4.0, 2.0, 0.0));
  EXPECT_EQ(with_strength("").mesh.materials.at(0).emission, glm::dvec3(1.0, 0.5, 0.0));
  EXPECT_EQ(with_strength(R"("emissiveStrength":-1)").mesh.materials.at(0).name, "default");
}

TEST(Gltf, ASurfaceWithoutLightingEmitsItsColour) {
  const auto unlit = with_material(json::parse(
      R"({"extensions":{"KHR_materials_unlit":{}},
          "pbrMetallicRoughness":{"baseColorFactor":[1,0.5,0,1],"roughnessFactor":0.2}})"));
  const Material& m = unlit.mesh.materials.at(0);
  EXPECT_EQ(m.emission, glm::dvec3(1, 0.5, 0));
  EXPECT_EQ(m.ambient + m.diffuse + m.specular, 0.0);
}

TEST(Gltf, SurfacesOfAlphaZeroAreNotDrawn) {
  // The second triangle has another material.
  const auto notes_of = [](const std::string& alpha, std::size_t drawn) {
    const auto loaded =
        must(read_gltf(with({{"/meshes/0/primitives/1",
                              json::parse(R"({"attributes":{"POSITION":0},"indices":1,"material":0})")},
                             {"/materials", json::array({json::parse("{" + alpha + "}")})}}),
                       "a.gltf"));
    EXPECT_EQ(loaded.mesh.triangles.size(), drawn) << alpha;
    return loaded.notes;
  };
  const std::string base = R"(,"pbrMetallicRoughness":{"baseColorFactor":[1,1,1,)";
  EXPECT_EQ(notes_of(R"("alphaMode":"OPAQUE")" + base + "0]}", 2), TextList{});
  EXPECT_EQ(notes_of(R"("alphaMode":"MASK")" + base + "0.5]}", 2), TextList{});
  for (const std::string& hidden :
       {R"("alphaMode":"MASK")" + base + "0.49]}", R"("alphaMode":"BLEND")" + base + "0]}"})
    EXPECT_EQ(notes_of(hidden, 1),
              TextList{"a.gltf: materials[0]: it is transparent: its surfaces are not drawn"});
}

TEST(Gltf, GlossinessIsRoughness) {
  const auto loaded = with_material(json::parse(
      R"({"extensions":{"KHR_materials_pbrSpecularGlossiness":{"diffuseFactor":[1,0,0,1],"specularFactor":[0,1,0],
          "glossinessFactor":0.75}}})"));
  const Material& m = loaded.mesh.materials.at(0);
  EXPECT_EQ(m.colour, glm::dvec3(1, 0, 0));
  EXPECT_EQ(m.specular_colour, glm::dvec3(0, 1, 0));
  EXPECT_EQ(m.exponent, 510.0);
}

TEST(Gltf, KeysAndExtensionsThatAreNotUsedAreNoted) {
  const auto loaded = must(read_gltf(
      with({{"/animations", json::array()},
            {"/nodes/0/weights", {1}},
            {"/nodes/0/extensions", json::parse(R"({"EXT_other":{},"KHR_lights_punctual":{"light":0}})")},
            {"/extensions", json::parse(R"({"KHR_lights_punctual":{"lights":[{"type":"point"}]}})")},
            {"/extensionsRequired", {"KHR_lights_punctual"}},
            {"/meshes/0/primitives/0/material", 0},
            {"/materials",
             json::parse(R"([{"name":"m","extras":1,"alphaMode":"BLEND","extensions":{"KHR_materials_ior":{}},
                "pbrMetallicRoughness":{"baseColorFactor":[1,1,1,0.5],"roughnesFactor":0}}])")}}),
      "a.gltf"));
  EXPECT_EQ(
      loaded.notes,
      (TextList{
          "a.gltf: 'animations' is not used",
          "a.gltf: materials[0].pbrMetallicRoughness: 'roughnesFactor' is not used",
          "a.gltf: nodes[0]: extension 'EXT_other' is not used",
          "a.gltf: materials[0]: extension 'KHR_materials_ior' is not used",
          "a.gltf: extensions.KHR_lights_punctual.lights[0]: its intensity is the same at all distances",
          "a.gltf: morph targets are left out", "a.gltf: materials[0]: transparency is left out"}));
}

TEST(Gltf, LightsHaveThePlacesOfTheirNodes) {
  const auto loaded = must(read_gltf(
      with(
          {{"/extensions/KHR_lights_punctual/lights", json::parse(R"([
               {"type":"directional","intensity":2}, {"type":"point","color":[1,0.5,0],"intensity":4},
               {"type":"spot","spot":{"innerConeAngle":0.5,"outerConeAngle":1}}, {"type":"spot"},
               {"type":"area"}, {"type":"point","intensity":-1},
               {"type":"spot","spot":{"innerConeAngle":1,"outerConeAngle":0.5}}])")},
           {"/scenes/0/nodes", {0, 1}},
           {"/nodes/0/rotation", {0, 0.7071067811865476, 0, 0.7071067811865476}},  // -z to -x
           {"/nodes/0/translation", {1, 2, 3}},
           {"/nodes/0/children", {2, 3, 4, 5, 6, 7, 8, 9}},
           {"/nodes/1", json::parse(R"({"scale":[0,0,0],"extensions":{"KHR_lights_punctual":{"light":0}}})")},
           {"/nodes/2", json::parse(R"({"extensions":{"KHR_lights_punctual":{"light":0}}})")},
           {"/nodes/3",
            json::parse(R"({"translation":[0,0,1],"extensions":{"KHR_lights_punctual":{"light":1}}})")},
           {"/nodes/4", json::parse(R"({"extensions":{"KHR_lights_punctual":{"light":2}}})")},
           {"/nodes/5", json::parse(R"({"extensions":{"KHR_lights_punctual":{"light":3}}})")},
           {"/nodes/6", json::parse(R"({"extensions":{"KHR_lights_punctual":{"light":4}}})")},
           {"/nodes/7", json::parse(R"({"extensions":{"KHR_lights_punctual":{"light":5}}})")},
           {"/nodes/8", json::parse(R"({"extensions":{"KHR_lights_punctual":{"light":6}}})")},
           {"/nodes/9", json::parse(R"({"extensions":{"KHR_lights_punctual":{"light":7}}})")}}),
      "a.gltf"));
  const auto is_near = [](const glm::dvec3& a, const glm::dvec3& b) { return glm::length(a - b) < 1e-12; };
  const FileLights& lights = loaded.lights;
  ASSERT_EQ(lights.directional.size(), 1u);
  EXPECT_PRED2(is_near, lights.directional[0].to_light_world, glm::dvec3(1, 0, 0));
  EXPECT_EQ(lights.directional[0].intensity, glm::dvec3(0.5));
  ASSERT_EQ(lights.positional.size(), 1u);
  EXPECT_PRED2(is_near, lights.positional[0].position_world, glm::dvec3(2, 2, 3));
  EXPECT_EQ(lights.positional[0].intensity, glm::dvec3(1, 0.5, 0));
  ASSERT_EQ(lights.spots.size(), 2u);
  EXPECT_PRED2(is_near, lights.spots[0].axis_world, glm::dvec3(-1, 0, 0));
  EXPECT_PRED2(is_near, lights.spots[0].position_world, glm::dvec3(1, 2, 3));
  EXPECT_EQ(lights.spots[0].intensity, glm::dvec3(0.25));
  EXPECT_EQ(lights.spots[0].cos_inner, std::cos(0.5));
  EXPECT_EQ(lights.spots[0].cos_outer, std::cos(1.0));
  EXPECT_EQ(lights.spots[1].cos_inner, 1.0);
  EXPECT_NEAR(lights.spots[1].cos_outer, std::sqrt(0.5), 1e-12);
  const std::string light = "a.gltf: extensions.KHR_lights_punctual.lights",
                    left_out = "; the light is left out";
  EXPECT_EQ(
      loaded.notes,
      (TextList{light + "[0]: its node has no direction, or is beyond 1e+15" + left_out,
                light + "[4]: 'area' is not a type of light" + left_out,
                light + "[5]: its intensity is not 0 to 1e+15" + left_out,
                light + "[6]: its angles do not increase from 0 to 90 degrees" + left_out,
                light + "[1]: its intensity is the same at all distances (3 times)",
                "a.gltf: nodes[9].extensions.KHR_lights_punctual.light: is 7, but the file has 7, counted "
                "from 0; correct the index" +
                    left_out}));
}

TEST(Gltf, ALightThatCannotBeReadIsLeftOut) {
  const std::string place = "extensions.KHR_lights_punctual.lights[0].";
  for (const auto& [light, fault] : {std::pair(R"({"type":"spot","spot":{"innerConeAngle":"0"}})",
                                               "spot.innerConeAngle: is not a number; correct it"),
                                     std::pair(R"({"type":"point","color":[1,1,1,1,1]})",
                                               "color: has 5 numbers, not 3 or 4; correct it")}) {
    const auto loaded =
        must(read_gltf(with({{"/extensions/KHR_lights_punctual/lights", json::array({json::parse(light)})},
                             {"/nodes/0/extensions/KHR_lights_punctual/light", 0}}),
                       "a.gltf"));
    EXPECT_EQ(triangles_of(loaded), c_triangle);
    EXPECT_TRUE(loaded.lights.empty());
    EXPECT_EQ(loaded.notes, TextList{"a.gltf: " + place + fault + "; the light is left out"});
  }
}

TEST(Gltf, FactorsAreLimited) {
  const auto rounded =
      with_material(json::parse(R"({"pbrMetallicRoughness":{"roughnessFactor":1.0000001}})"));
  EXPECT_EQ(rounded.mesh.materials.at(0).specular, 0.0);
  EXPECT_EQ(rounded.notes, TextList{});
  EXPECT_EQ(with_material(json::parse(R"({"pbrMetallicRoughness":{"roughnessFactor":2}})")).notes,
            TextList{"a.gltf: materials[0].pbrMetallicRoughness.roughnessFactor: 2 is limited to 0 to 1"});
}

TEST(Gltf, ANormalThatIsNotFiniteIsComputed) {
  const auto loaded = must(read_gltf(
      with({{"/meshes/0/primitives/0/attributes/NORMAL", 2},
            {"/accessors/2",
             json::parse(R"({"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","sparse":)" +
                         changed(c_sparse.dump(), "\"bufferView\":3", "\"bufferView\":4") + "}")},
            {"/bufferViews/4", json::parse(R"({"buffer":1,"byteLength":12})")},
            {"/buffers/1",
             {{"byteLength", 12}, {"uri", "data:;base64," + base64(std::string(11, '\xff') + '\x7f')}}}}),
      "a.gltf"));
  EXPECT_EQ(normals_of(loaded), "0,0,0 1,0,0 0,0,0 ");
  EXPECT_EQ(loaded.notes, TextList{"a.gltf: meshes[0].primitives[0].attributes.NORMAL: a normal is not three "
                                   "finite numbers; it is computed"});
}

}  // namespace
}  // namespace halfway
