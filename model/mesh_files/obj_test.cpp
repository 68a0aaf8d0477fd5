// SPDX-License-Identifier: Apache-2.0
#include "mesh_files/obj.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "mesh_files/test/spelling.hpp"
#include "sim/os/must.hpp"

namespace halfway {
namespace {

using Libraries = std::map<std::string, std::string>;

Result<LoadedMesh> read(const std::string& text, const Libraries& libraries = {}) {
  return read_obj(text, "a.obj", [&libraries](std::string_view name) {
    const auto found = libraries.find(std::string(name));
    MaterialLibrary library{.path = "dir/" + std::string(name), .text = {}};
    if (found != libraries.end()) library.text = found->second;
    return library;
  });
}

// ---- Spellings: each is read exactly, or refused with file and line

class ObjSpelling : public ::testing::TestWithParam<Spelling> {};

TEST_P(ObjSpelling, IsReadExactlyOrRefusedWithItsLine) {
  EXPECT_EQ(triangles_of(read(GetParam().text)), GetParam().wanted);
}

const std::string c_three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
const std::string c_square = "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\n";

const std::vector<Spelling> c_obj_text = {
    {"plain", c_three + "f 1 2 3\n", c_triangle},

    // numbers
    {"number_spellings", "v 1e1 2E+1 5e-1\nv -.5e1 5.e1 +1\nv 0 1 0\nf 1 2 3\n", "10,20,0.5 -5,50,1 0,1,0"},
    {"comma", "v 0,5 1 0\n", "! a.obj:1: vertex 1: '0,5' is not a number; correct the coordinate"},
    {"nan", "v 0 0 nan\n", "! a.obj:1: vertex 1: 'nan' is not finite; correct the coordinate"},
    {"too_large", "v 0 1e39 0\n", "! a.obj:1: vertex 1: '1e39' is too large; correct the coordinate"},
    {"texture_of_anything", "vt\nvt u v\nvt nan inf -1.#IND\nvt 0 0 0 0\n" + c_three + "f 1/1 2/2 3/4\n",
     c_triangle},

    // counts of numbers
    {"weight", "v 2 4 8 2\nv 1 0 0 1\nv 0 .5 0 .5\nf 1 2 3\n", "1,2,4 1,0,0 0,1,0"},
    {"weight_zero", "v 2 4 8 0.0\n", "! a.obj:1: vertex 1 has the weight zero; correct the coordinate"},
    {"weight_too_small", "v 1 0 0\nv 1e30 0 0 1e-30\n",
     "! a.obj:2: vertex 2 is too large; correct the coordinate"},
    {"colours", "v 0 0 0 .5 .25 1\nv 1 0 0 1 1 1\nv 0 1 0 0 0 0\nf 1 2 3\n", c_triangle},
    {"two_coordinates", "v 0 0 0\nv 1 0\n",
     "! a.obj:2: vertex 2 has 2 numbers; it must have 3, 4, 6 or more"},
    {"five_numbers", "v 0 0 0 1 1\n", "! a.obj:1: vertex 1 has 5 numbers; it must have 3, 4, 6 or more"},
    {"seven_numbers", "v 0 0 0 1 1 1 .5\nv 1 0 0 nan inf -1.#IND 9\nv 0 1 0 0 0 0 0\nf 1 2 3\n", c_triangle},
    {"colour_of_words", "v 0 0 0 1 1 v\n",
     "! a.obj:1: vertex 1: 'v' is not a number; correct the coordinate"},
    {"weight_nan", "v 0 0 0 nan\n", "! a.obj:1: vertex 1 has the weight zero; correct the coordinate"},
    {"texture_of_dots", "vt .5 .5\nvt .5\nvt .5 .5 0.\n" + c_three + "f 1/1 2/2 3/3\n", c_triangle},

    // lines
    {"crlf", "v 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nf 1 2 3\r\n", c_triangle},
    {"cr", "v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3\r", c_triangle},
    {"cr_fault", "v 0 0 0\rv 1 0\r", "! a.obj:2: vertex 2 has 2 numbers; it must have 3, 4, 6 or more"},
    {"fault_after_a_continued_line", "v 0 0 \\\n0\nv 1 0\n",
     "! a.obj:3: vertex 2 has 2 numbers; it must have 3, 4, 6 or more"},
    {"form_feeds", "v\f0 0\v0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", c_triangle},
    {"tabs", "v\t0\t0  0 \n \tv 1 0\t0\nv 0 1 0\n\tf\t1  2 3\t\n", c_triangle},
    {"byte_order_mark", "\xef\xbb\xbfv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", c_triangle},
    {"comments", "# v 9 9 9\n#\n" + c_three + "f 1 2 3 # 4\n#f 1 2 2\n", c_triangle},
    {"comment_after_data", "v 0 0 0 #1\nv 1 0 0 # 5 6 7\nv 0 1 0\t#\nf 1 2 3\n", c_triangle},
    {"continued", "v 0 0 \\\n0\nv 1 \\\r\n 0\\\n 0\nv 0 1 0\nf 1 \\\n2\\\n  3\n", c_triangle},
    {"continued_at_the_end", c_three + "f 1 2 3 \\", "! a.obj:4: '\\' is not a corner of a face"},
    {"continued_fault", c_three + "f 1 2 \\\n9\n",
     "! a.obj:4: a face names vertex 9, but the file has 3; correct the index"},
    {"comment_is_not_continued", "# c:\\models\\\n" + c_three + "f 1 2 3 # c:\\\n", c_triangle},
    {"backslash_and_blank", "v 0 0 0 \\ \nv 1 0 0\n",
     "! a.obj:1: vertex 1: '\\' is not a number; correct the coordinate"},
    {"zero_byte", c_three + std::string("f 1 2 3\n\0\n", 10),
     "! a.obj:5: '?' is not a keyword of OBJ; correct or remove the line"},

    {"object_name_ends_in_backslash", "v 0 1 0\no D:\\parts\\\nv 0 0 0\nv 2 0 0\nv 2 1 0\nf -3 -2 -1\n",
     "0,0,0 2,0,0 2,1,0"},
    {"group_name_ends_in_backslash", "g a\\\nv 9 9 0\n" + c_three + "f 2 3 4\n", c_triangle},
    {"other_names_end_in_backslash",
     "mtllib a\\\nv 9 9 0\r\nusemtl a\\\r\nusemap a\\\nv 0 0 0\rtrace_obj a\\\rv 1 0 0\n#\\\nv 0 1 0\n"
     "g a #\\\nf 2 3 4\n",
     c_triangle},

    // keywords
    {"groups", "o a\ng b c\ns off\nmg 1 2\nlod 1\n" + c_three + "s 1\ng\nf 1 2 3\n", c_triangle},
    {"curves",
     "cstype "
     "1\ndeg\nbmat\nstep\ncurv\ncurv2\nsurf\nparm\ntrim\nhole\nscrv\nsp\nend\ncon\nctech\nstech\nbsp\nbzp\n"
     "cdc\ncdp\nres\nc_interp\nd_interp\nvp\nbevel\n" +
         c_three + "f 1 2 3\n",
     c_triangle},
    {"unknown_keyword", c_three + "vv 1 2 3\n",
     "! a.obj:4: 'vv' is not a keyword of OBJ; correct or remove the line"},
    {"no_faces", c_three, "! a.obj: the mesh has no faces; export it with faces"},
    {"points_and_lines", c_three + "p 1\nl 1 2 3\nl 1/1 2/1\nvt 0\nf 1 2 3\n", c_triangle},
    {"line_of_words", c_three + "l 1 two\n", "! a.obj:4: 'two' is not a corner of a face"},

    // indices
    {"negative", c_three + "f -3 -2 -1\n", c_triangle},
    {"negative_counts_so_far", c_three + "f -3 -2 -1\nv 5 5 5\nf -4 -3 -1\n",
     c_triangle + "; 0,0,0 1,0,0 5,5,5"},
    {"negative_texture_and_normal", "vt 0\nvn 0 0 1\n" + c_three + "f -3/-1/-1 -2/-1/-1 -1/-1/-1\n",
     c_triangle},
    {"vertices_after_faces", "f 1 2 3\n" + c_three, c_triangle},
    {"too_negative", c_three + "f 1 2 -4\n",
     "! a.obj:4: a face names vertex -4, but the file has 3 so far; correct the index"},
    {"zero", c_three + "f 0 1 2\n",
     "! a.obj:4: a face names vertex 0, but the file has 3; correct the index"},
    {"beyond", c_three + "\n\nf 1 2 4\n",
     "! a.obj:6: a face names vertex 4, but the file has 3; correct the index"},
    {"beyond_64_bits", c_three + "f 1 2 99999999999999999999\n",
     "! a.obj:4: a face names vertex 99999999999999999999, but the file has 3; correct the index"},
    {"least_64_bits", c_three + "f 1 2 -9223372036854775808\n",
     "! a.obj:4: a face names vertex -9223372036854775808, but the file has 3 so far; correct the index"},
    {"texture_beyond", c_three + "vt 0\nf 1/1 2/2 3/-2\n", c_triangle},
    {"texture_missing", "vn 0 0 1\n" + c_three + "f 1/1/1 2/1/1 3/1/1\n", c_triangle},
    {"normal_beyond", c_three + "f 1//1 2//1 3//1\n", c_triangle},
    {"all_three", "vt 0\nvn 0 0 1\n" + c_three + "f 1/1/1 2/1/1 3/1/1\n", c_triangle},
    {"empty_parts", "vt 0\n" + c_three + "f 1/ 2// 3/1/\n", c_triangle},
    {"four_parts", "vt 0\nvn 0 0 1\n" + c_three + "f 1/1/1/1 2 3\n",
     "! a.obj:6: '1/1/1/1' is not a corner of a face"},
    {"point", c_three + "f 1.0 2 3\n", "! a.obj:4: '1.0' is not a corner of a face"},
    {"blank_and_slash", "vn 0 0 1\n" + c_three + "f 1 //1 2 3\n",
     "! a.obj:5: '//1' is not a corner of a face"},
    {"no_corner", c_three + "f\n", "! a.obj:4: a face, line or point without a corner"},

    // polygons
    {"repeated_place", c_square + "v 4 0 0\nf 1 2 5 3\n", "0,0,0 4,0,0 4,4,0"},
    {"notch_on_a_diagonal", c_square + "v 2 2 0\nf 1 2 3 5 4\n",
     "4,0,0 4,4,0 2,2,0; 2,2,0 0,4,0 0,0,0; 2,2,0 0,0,0 4,0,0"},
    {"bow_tie", c_square + "f 1 3 2 4\n", "0,0,0 4,4,0 4,0,0; 0,0,0 4,0,0 0,4,0"},
    {"polygon_on_a_line", "v 0 0 0\nv 1 1 1\nv 2 2 2\nv 3 3 3\nf 1 2 3 4\n",
     "! a.obj:5: no face from here on has any area; correct the vertices"},
};

INSTANTIATE_TEST_SUITE_P(All, ObjSpelling, ::testing::ValuesIn(c_obj_text), name_of);

// ---- Normals, positions, notes

TEST(Obj, ACornerWithoutANormalHasTheNormalZero) {
  const auto loaded = must(read(c_three + "vn 0 0 2\nvn .5 -.5 1e0\nf 1//1 2 3//-1\n"));
  EXPECT_EQ(normals_of(loaded), "0,0,2 0,0,0 0.5,-0.5,1 ");
}

TEST(Obj, ThePartsOfAPolygonKeepTheirNormals) {
  const auto loaded =
      must(read(c_square + "vn 1 0 0\nvn 2 0 0\nvn 3 0 0\nvn 4 0 0\nf 1//1 2//2 3//3 4//4\n"));
  EXPECT_EQ(normals_of(loaded), "1,0,0 2,0,0 3,0,0 1,0,0 3,0,0 4,0,0 ");
}

TEST(Obj, PositionsAreJoinedInTheOrderOfTheirUse) {
  const auto loaded = must(read("v 9 9 9\nv 0 0 0\nv 1 0 0\nv -0 0 -0\nv 0 1 0\nf 3 5 2\nf 4 3 5\n"));
  ASSERT_EQ(loaded.mesh.positions.size(), 3u);
  EXPECT_EQ(loaded.mesh.positions[0], glm::dvec3(1, 0, 0));
  EXPECT_EQ(loaded.mesh.triangles[0].position, (std::array<std::uint32_t, 3>{0, 1, 2}));
  EXPECT_EQ(loaded.mesh.triangles[1].position, (std::array<std::uint32_t, 3>{2, 0, 1}));
}

TEST(Obj, NotesSayWhatIsLeftOut) {
  const auto loaded = must(read(
      "usemap wood\nv 0 0 0 1 1 1\nv 1 0 0\nv 0 1 0\nv 2 0 0\np 1\nl 1 2\nf 1 2\ncstype bezier\ncurv 0 1 1 "
      "2\nend\n"
      "f 1 2 4 2\nf 1 2 3\n"));
  EXPECT_EQ(loaded.notes, (std::vector<std::string>{
                              "a.obj: 1 faces without area left out", "a.obj: 3 points and lines left out",
                              "a.obj:9: curves and surfaces are left out (3 times)",
                              "a.obj:1: textures are left out", "a.obj:2: vertex colours are left out"}));
  EXPECT_EQ(must(read("vt 0\n" + c_three + "f 1/2 2/7 3/-2\n")).notes,
            std::vector<std::string>{
                "a.obj:5: a corner names a texture coordinate that the file does not have (3 times)"});
  EXPECT_EQ(
      must(read("vn 0 0 1\n" + c_three + "f 1//1 2//2 3//-2\n")).notes,
      std::vector<std::string>{"a.obj:5: a corner names a normal that the file does not have (2 times)"});
}

TEST(Obj, AnOutlineThatCrossesItselfIsAFan) {
  const auto loaded = must(read(c_square + "v 2 0 0\nf 1 2 3 4\nf 1 2 4 3\nf 1 3 2 4\n"));
  EXPECT_EQ(loaded.mesh.triangles.size(), 6u);
  EXPECT_EQ(loaded.notes,
            std::vector<std::string>{"a.obj:7: the outline of a face crosses itself; it is drawn "
                                     "as a fan around its first corner (2 times)"});
}

TEST(Obj, ANormalThatCannotBeReadIsComputed) {
  const auto loaded = must(
      read("vn 0 0 1\nvn -1.#IND 0 0\nvn 0 up 1\nvn 0 1\n" + c_three + "f 1//2 2//3 3//4\nf 1//1 2 3\n"));
  EXPECT_EQ(normals_of(loaded), "0,0,0 0,0,0 0,0,0 0,0,1 0,0,0 0,0,0 ");
  EXPECT_EQ(loaded.notes, std::vector<std::string>{
                              "a.obj:2: a normal is not three finite numbers; it is computed (3 times)"});
}

TEST(Obj, MoreTrianglesThanTheLimitAreRefused) {
  // Corners on a parabola: each face is a convex fan of 4094 triangles.
  std::string text, face = "f";
  for (int i = 1; i <= 4096; ++i) {
    text += fmt::format("v {} {} 0\n", i, i * i);
    face += " " + std::to_string(i);
  }
  for (int i = 0; i < 2443; ++i) text += face + "\n";
  const auto loaded = read(text);
  ASSERT_FALSE(loaded);
  EXPECT_EQ(loaded.error().message, "a.obj:6539: more than 10000000 triangles; reduce the mesh");
}

// ---- Materials

const std::string c_faces = c_three + "usemtl a\nf 1 2 3\nusemtl b\nf 1 3 2\n";

TEST(Obj, MaterialsAreThoseThatFacesUse) {
  const auto loaded =
      read("mtllib m.mtl\nusemtl unused\n" + c_faces,
           {{"m.mtl",
             "# comment\nnewmtl b\n  Kd .25 0.5 1. # blue\n\tKs 1 .5 0\r\nNs 3e1\nillum 2\nd .5\n"
             "newmtl a\nKd 0 0 0\nKs 0 0 0\nNs 0.5\nnewmtl unused\nNs .1\nKs 1 1 1\nmap_Kd x.png\n"}});
  ASSERT_TRUE(loaded) << loaded.error().message;
  ASSERT_EQ(loaded->mesh.materials.size(), 2u);
  const Material &a = loaded->mesh.materials[0], &b = loaded->mesh.materials[1];
  EXPECT_EQ(loaded->mesh.triangles[0].material, 0u);
  EXPECT_EQ(loaded->mesh.triangles[1].material, 1u);
  EXPECT_EQ(a.name, "a");
  EXPECT_EQ(a.diffuse, 0.0);
  EXPECT_EQ(a.specular, 0.0);
  EXPECT_EQ(a.exponent, 1.0);
  EXPECT_EQ(b.name, "b");
  EXPECT_EQ(b.colour, glm::dvec3(0.25, 0.5, 1.0));
  EXPECT_EQ(b.specular_colour, glm::dvec3(1.0, 0.5, 0.0));
  EXPECT_EQ(b.diffuse, 1.0);
  EXPECT_EQ(b.specular, 1.0);
  EXPECT_EQ(b.exponent, 30.0);
  EXPECT_EQ(loaded->notes, std::vector<std::string>{"a.obj: material 'b': transparency is left out"});
}

TEST(Obj, KeysOfMaterialsThatAreNotUsedAreNoted) {
  const auto loaded =
      must(read("mtllib m.mtl\n" + c_faces, {{"m.mtl",
                                              "newmtl a\nd 1.0\nTr 0\nKe 0 0 0\nTf 1 1 1\nillum 2\nNi 1.5\n"
                                              "newmtl b\nKe 1 0 0\nd -halo 1\nKa 1 1 1\nTr .5\nillum 3\n"}}));
  EXPECT_EQ(loaded.notes,
            (std::vector<std::string>{"dir/m.mtl:13: 'illum' is not used", "dir/m.mtl:11: 'ka' is not used",
                                      "dir/m.mtl:10: d: '-halo' is not a number; the line is left out",
                                      "a.obj: material 'b': transparency is left out"}));
}

TEST(Obj, EmissionIsRead) {
  const auto loaded =
      must(read("mtllib m.mtl\n" + c_faces, {{"m.mtl", "newmtl a\nKd .2 0 0\nKe 1 .5 0\nnewmtl b\n"}}));
  EXPECT_EQ(loaded.mesh.materials.at(0).emission, glm::dvec3(1, 0.5, 0));
  EXPECT_EQ(loaded.mesh.materials.at(0).colour, glm::dvec3(0.2, 0, 0));
  EXPECT_EQ(loaded.mesh.materials.at(1).emission, glm::dvec3(0));
  EXPECT_EQ(loaded.notes, std::vector<std::string>{});
}

TEST(Obj, TransparentFacesAreNotDrawn) {
  for (const std::string key : {"d 0\nTr 0\n", "Tr 1\n"}) {
    const auto loaded =
        must(read("mtllib m.mtl\n" + c_faces, {{"m.mtl", "newmtl a\n" + key + "newmtl b\nd 1\nTr 1\n"}}));
    EXPECT_EQ(triangles_of(loaded), "0,0,0 0,1,0 1,0,0");
    EXPECT_EQ(loaded.mesh.materials.at(loaded.mesh.triangles[0].material).name, "b");
    EXPECT_EQ(loaded.notes,
              std::vector<std::string>{"a.obj: material 'a' is transparent: its faces are not drawn"});
  }
  EXPECT_EQ(
      triangles_of(read("mtllib m.mtl\nusemtl a\n" + c_three + "f 1 2 3\n", {{"m.mtl", "newmtl a\nd 0\n"}})),
      "! a.obj: the mesh has no faces; export it with faces");
}

TEST(Obj, TexturesOfMaterialsAreNoted) {
  for (const std::string key : {"map_Kd", "bump", "disp", "decal", "refl", "norm"})
    EXPECT_EQ(must(read("mtllib m.mtl\n" + c_three + "usemtl a\nf 1 2 3\n",
                        {{"m.mtl", "newmtl a\n" + key + " x\n"}}))
                  .notes,
              std::vector<std::string>{"a.obj: material 'a': textures are left out"});
}

TEST(Obj, ASecondDefinitionKeepsTheOtherKeys) {
  const auto loaded = must(read("mtllib m.mtl \n" + c_faces,
                                {{"m.mtl", "newmtl a \nKd 1 0 0\nNs 2\nnewmtl b\nnewmtl a\t\nNs 9\n"}}));
  EXPECT_EQ(loaded.mesh.materials.at(0).colour, glm::dvec3(1, 0, 0));
  EXPECT_EQ(loaded.mesh.materials.at(0).exponent, 9.0);
}

TEST(Obj, MaterialsAreNoted) {
  const auto loaded = must(read("mtllib m.mtl\nf 1 2 3\nusemtl nowhere\n" + c_faces,
                                {{"m.mtl", "newmtl a\nKs 1 1 1\nNs 0\nbump -bm 1 b.png\n"}}));
  ASSERT_EQ(loaded.mesh.materials.size(), 3u);
  EXPECT_EQ(loaded.mesh.materials[0].name, "default");
  EXPECT_EQ(loaded.mesh.materials[0].colour, glm::dvec3(0.6));
  EXPECT_EQ(loaded.mesh.materials[2].name, "b");
  EXPECT_EQ(loaded.notes, (std::vector<std::string>{"a.obj: faces without a material are grey",
                                                    "a.obj: material 'a': exponent 0 raised to 1",
                                                    "a.obj: material 'a': textures are left out",
                                                    "a.obj: material 'b' is not defined; it is grey"}));
}

TEST(Obj, NamesMayHaveBlanksAndNumberSigns) {
  const Libraries libraries{{"my materials.mtl", "newmtl red brick #1\nKd 1 0 0\nnewmtl b\nKd 0 0 1\n"},
                            {"x.mtl", ""}};
  const auto loaded =
      read("mtllib my materials.mtl\n" + c_three + "usemtl red brick #1\nf 1 2 3\nusemtl b # blue\nf 1 3 2\n",
           libraries);
  ASSERT_TRUE(loaded) << loaded.error().message;
  ASSERT_EQ(loaded->mesh.materials.size(), 2u);
  EXPECT_EQ(loaded->mesh.materials[0].name, "red brick #1");
  EXPECT_EQ(loaded->mesh.materials[1].name, "b");
  EXPECT_TRUE(loaded->notes.empty());
}

TEST(Obj, ABackslashAtTheEndBelongsToAName) {
  const auto loaded = must(read("mtllib C:\\m\\\n" + c_three + "usemtl a\\\nf 1 2 3\n",
                                {{"C:\\m\\", "newmtl a\\\nmap_Kd C:\\\nKd 0 0 1\n# c:\\\nKs 1 \\\n0 0\n"}}));
  EXPECT_EQ(loaded.mesh.materials.at(0).name, "a\\");
  EXPECT_EQ(loaded.mesh.materials.at(0).colour, glm::dvec3(0, 0, 1));
  EXPECT_EQ(loaded.mesh.materials.at(0).specular_colour, glm::dvec3(1, 0, 0));
}

TEST(Obj, ALineMayNameSeveralLibraries) {
  const Libraries libraries{{"1.mtl", "newmtl a\nKd 1 0 0\n"}, {"2.mtl", "newmtl b\nKd 0 0 1\n"}};
  const auto loaded = must(read("mtllib 1.mtl gone.mtl 2.mtl\n" + c_faces, libraries));
  EXPECT_EQ(loaded.mesh.materials.at(0).colour, glm::dvec3(1, 0, 0));
  EXPECT_EQ(loaded.mesh.materials.at(1).colour, glm::dvec3(0, 0, 1));
  EXPECT_EQ(loaded.notes,
            (std::vector<std::string>{
                "a.obj: material library dir/gone.mtl cannot be read; its materials are grey"}));
}

TEST(Obj, WithoutALibraryThereIsOneDefaultMaterial) {
  for (const std::string& text :
       {c_faces, "mtllib gone.mtl\n" + c_faces, "mtllib m.mtl\n" + c_three + "f 1 2 3\nf 1 3 2\n"}) {
    const auto loaded = must(read(text, {{"m.mtl", "newmtl a\n"}}));
    ASSERT_EQ(loaded.mesh.materials.size(), 1u);
    EXPECT_EQ(loaded.mesh.materials[0].name, "default");
    EXPECT_EQ(loaded.mesh.materials[0].colour, glm::dvec3(1.0));
    EXPECT_EQ(loaded.mesh.triangles[1].material, 0u);
  }
}

TEST(Obj, AMaterialWithoutANameIsTheDefault) {
  const auto loaded =
      must(read("mtllib m.mtl\n" + c_three + "usemtl\nf 1 2 3\n", {{"m.mtl", "newmtl\nKd 1 0 0\n"}}));
  EXPECT_EQ(loaded.mesh.materials.at(0).colour, glm::dvec3(0.6));
  EXPECT_EQ(loaded.notes,
            (std::vector<std::string>{"a.obj: faces without a material are grey",
                                      "dir/m.mtl:1: newmtl has no name; its material is left out"}));
}

class MtlFaults : public ::testing::TestWithParam<Spelling> {};

// The material keeps its other keys.
TEST_P(MtlFaults, AreLeftOutWithANote) {
  const auto loaded = must(read("mtllib m.mtl\n" + c_faces,
                                {{"m.mtl", GetParam().text + "newmtl a\nKd 1 0 0\nNs 9\nnewmtl b\n"}}));
  EXPECT_EQ(loaded.notes, std::vector<std::string>{"dir/m.mtl:" + GetParam().wanted});
  EXPECT_EQ(loaded.mesh.materials.at(0).colour, glm::dvec3(1, 0, 0));
  EXPECT_EQ(loaded.mesh.materials.at(0).exponent, 9.0);
}

INSTANTIATE_TEST_SUITE_P(
    All, MtlFaults,
    ::testing::Values(
        Spelling{"word", "newmtl a\nKd red\n", "2: Kd: 'red' is not a number; the line is left out"},
        Spelling{"nan", "newmtl a\nKd nan 0 0\n", "2: Kd: 'nan' is not finite; the line is left out"},
        Spelling{"spectral", "newmtl a\nKd spectral a.rfl 1\n",
                 "2: Kd: 'spectral' is not a number; the line is left out"},
        Spelling{"two", "newmtl a\nKs 1 1\n",
                 "2: Ks: 2 numbers instead of 3, or 1 for grey; the line is left out"},
        Spelling{"four", "newmtl a\nKd 1 1 1 1\n", "2: Kd: more than 3 numbers; the line is left out"},
        Spelling{"none", "newmtl a\n\nNs # 3\n", "3: Ns: no number; the line is left out"},
        Spelling{"negative", "newmtl a\nKd 1 -.5 1\n", "2: Kd: '-.5' is negative; the line is left out"},
        Spelling{"too_early", "Kd 1 1 1\n", "1: a line before the first newmtl is left out"}),
    name_of);

}  // namespace
}  // namespace halfway
