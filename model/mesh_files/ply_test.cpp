// SPDX-License-Identifier: Apache-2.0
#include "mesh_files/ply.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "common/test/is_error.hpp"
#include "mesh_files/test/spelling.hpp"
#include "sim/os/must.hpp"

namespace halfway {
namespace {

class PlySpelling : public ::testing::TestWithParam<Spelling> {};

TEST_P(PlySpelling, IsReadExactlyOrRefusedWithItsPlace) {
  EXPECT_EQ(triangles_of(read_ply(GetParam().text, "a.ply")), GetParam().wanted);
}

// ---- Text

const std::string c_xyz = "property float x\nproperty float y\nproperty float z\n";
const std::string c_corners = "property list uchar int vertex_indices\n";
const std::string c_format = "ply\nformat ascii 1.0\n";
const std::string c_vertices = "0 0 0\n1 0 0\n0 1 0\n";
const std::string c_header3 = c_format + "element vertex 3\n" + c_xyz;
const std::string c_face1 = "element face 1\n" + c_corners + "end_header\n";
const std::string c_plain = c_header3 + c_face1 + c_vertices + "3 0 1 2\n";

/// A file whose data starts on line 10: these three vertices and this face.
std::string vertices(const std::string& lines) {
  return c_header3 + c_face1 + lines + "3 0 1 2\n";
}
std::string face(const std::string& line) {
  return c_header3 + c_face1 + c_vertices + line + "\n";
}
/// A polygon of these vertices, in one face.
std::string polygon(const std::string& lines) {
  std::string corners;
  std::size_t count = 0;
  for (const char c : lines) {
    if (c == '\n') corners += " " + std::to_string(count++);
  }
  return c_format + "element vertex " + std::to_string(count) + "\n" + c_xyz + c_face1 + lines +
         std::to_string(count) + corners + "\n";
}
/// Strips over five vertices (0,0,0) (0,1,0) (1,0,0) (1,1,0) (2,0,0).
std::string strips(const std::string& line, const std::string& type = "int") {
  return c_format + "element vertex 5\n" + c_xyz + "element tristrips 1\nproperty list int " + type +
         " vertex_indices\nend_header\n0 0 0\n0 1 0\n1 0 0\n1 1 0\n2 0 0\n" + line + "\n";
}
std::string with_line_end(const std::string& text, const std::string& end) {
  std::string result;
  for (const char c : text) result += c == '\n' ? end : std::string(1, c);
  return result;
}

const std::vector<Spelling> c_ply_text = {
    {"plain", c_plain, c_triangle},
    {"crlf", with_line_end(c_plain, "\r\n"), c_triangle},
    {"cr", with_line_end(c_plain, "\r"), c_triangle},
    {"empty_lines", changed(c_plain, "1 0 0\n", "\n1 0 0 \n\t\n") + "\n \n", c_triangle},
    {"tabs", changed(c_plain, "1 0 0\n", "\t1\t0  0 \n"), c_triangle},
    {"byte_order_mark_after_the_header", changed(c_plain, "end_header\n", "end_header\n\xef\xbb\xbf"),
     c_triangle},
    {"byte_order_mark_and_a_blank", changed(c_plain, "end_header\n", "end_header\n\xef\xbb\xbf "),
     c_triangle},
    {"byte_order_mark", "\xef\xbb\xbf" + c_plain, c_triangle},

    // numbers
    {"dots_signs_exponents", vertices("+.5 -5. 1e1\n5.E-1 -.25e+1 -0\n007 1 0\n"),
     "0.5,-5,10 0.5,-2.5,0 7,1,0"},
    {"nan", vertices("0 0 0\n1 nan 0\n0 1 0\n"),
     "! a.ply:11: vertex 1: 'nan' is not finite; correct the number"},
    {"word", vertices("0 0 zero\n1 0 0\n0 1 0\n"),
     "! a.ply:10: vertex 0: 'zero' is not a number; correct the number"},
    {"number_missing", vertices("0 0 0\n1 0\n0 1 0\n"),
     "! a.ply:11: vertex 1: z is missing at the end of the line; add it"},
    {"number_too_many", vertices("0 0 0\n1 0 0 7\n0 1 0\n"),
     "! a.ply:11: vertex 1: '7' follows its last number; remove it"},

    // types
    {"doubles", changed(vertices("0 0 0\n0.1 0 0\n0 1 0\n"), "float x", "double x"), "0,0,0 0.1,0,0 0,1,0"},
    {"integers",
     changed(changed(changed(c_plain, "float x", "short x"), "float y", "uint8 y"), "float z", "int z"),
     c_triangle},
    {"new_names", changed(changed(c_plain, "float x", "float64 x"), "uchar int", "uint32 uint16"),
     c_triangle},
    {"fraction_as_integer", changed(vertices("0 0 0\n1.5 0 0\n0 1 0\n"), "float x", "int x"),
     "! a.ply:11: vertex 1: '1.5' is not an integer; correct it, or the type in the header"},
    {"negative_as_unsigned", changed(vertices("0 0 0\n-1 0 0\n0 1 0\n"), "float x", "uchar x"),
     "! a.ply:11: vertex 1: '-1' is out of the range of its type; correct it, or the type in the header"},
    {"least_char", changed(vertices("-128 0 0\n127 0 0\n0 1 0\n"), "float x", "char x"),
     "-128,0,0 127,0,0 0,1,0"},

    // indices
    {"vertex_index", changed(c_plain, "vertex_indices", "vertex_index"), c_triangle},
    {"integers_with_a_point", changed(face("3.0 0. 1.00 2"), "vertex 3", "vertex 3.0"), c_triangle},
    {"index_1.5", face("3 0 1.5 2"),
     "! a.ply:13: face 0: '1.5' is not an integer; correct it, or the type in the header"},
    {"index_negative", face("3 0 1 -1"),
     "! a.ply:13: face 0: its corner is vertex -1, but the file has 3, counted from 0; correct the index"},
    {"index_beyond", face("3 0 1 3"),
     "! a.ply:13: face 0: its corner is vertex 3, but the file has 3, counted from 0; correct the index"},
    {"corner_missing", face("3 0 1"),
     "! a.ply:13: face 0: vertex_indices is missing at the end of the line; add it"},
    {"corner_too_many", face("3 0 1 2 0"), "! a.ply:13: face 0: '0' follows its last number; remove it"},
    {"length_negative", changed(face("-3 0 1 2"), "uchar int", "char int"),
     "! a.ply:13: face 0: a list of -3 values; correct it"},

    // polygons
    {"notch", polygon("0 0 0\n4 0 0\n4 4 0\n2 1 0\n0 4 0\n"),
     "4,0,0 4,4,0 2,1,0; 2,1,0 0,4,0 0,0,0; 2,1,0 0,0,0 4,0,0"},
    {"bow_tie", polygon("0 0 0\n4 4 0\n4 0 0\n0 4 0\n"), "0,0,0 4,4,0 4,0,0; 0,0,0 4,0,0 0,4,0"},
    {"polygon_on_a_line", polygon("0 0 0\n1 1 1\n2 2 2\n3 3 3\n"),
     "! a.ply: no face of the mesh has any area; correct the vertices"},
    {"two_corners", face("2 0 1"), "! a.ply: the mesh has no faces; export it with faces"},

    // strips
    {"strip", strips("5 0 1 2 3 4"), "0,0,0 0,1,0 1,0,0; 1,0,0 0,1,0 1,1,0; 1,0,0 1,1,0 2,0,0"},
    {"strip_restart", strips("7 0 1 2 -1 2 3 4"), "0,0,0 0,1,0 1,0,0; 1,0,0 1,1,0 2,0,0"},
    {"strip_restart_resets_the_direction", strips("9 0 1 2 3 -1 2 3 4 -1"),
     "0,0,0 0,1,0 1,0,0; 1,0,0 0,1,0 1,1,0; 1,0,0 1,1,0 2,0,0"},
    {"strip_with_repeated_vertices", strips("7 0 1 2 2 2 3 4"), "0,0,0 0,1,0 1,0,0; 1,0,0 1,1,0 2,0,0"},
    {"strip_beyond", strips("3 0 1 5"),
     "! a.ply:15: tristrips 0: its corner is vertex 5, but the file has 5, counted from 0; correct the "
     "index"},
    {"face_with_minus_1_is_no_strip", face("4 0 1 2 -1"),
     "! a.ply:13: face 0: its corner is vertex -1, but the file has 3, counted from 0; correct the index"},

    // counts of items
    {"items_missing", changed(c_plain, "element face 1", "element face 2"),
     "! a.ply:14: the file ends at item 1 of 2 of 'face'; it is truncated, or the count in its header is "
     "wrong; export it again"},
    {"item_too_many", c_plain + "3 2 1 0\n",
     "! a.ply:14: '3' follows the last element; correct the counts in the header, or remove it"},
    {"no_vertices", changed(changed(c_plain, "vertex 3", "vertex 0"), c_vertices, ""),
     "! a.ply:10: face 0: its corner is vertex 0, but the file has 0, counted from 0; correct the index"},
    {"no_faces", changed(changed(c_plain, "face 1", "face 0"), "3 0 1 2\n", ""),
     "! a.ply: the mesh has no faces; export it with faces"},
    {"points_only", c_header3 + "end_header\n" + c_vertices,
     "! a.ply: the mesh has no faces; export it with faces"},

    // header
    {"comments", changed(c_plain, "element vertex", "comment \\\nobj_info # x\n\ncomment\nelement vertex"),
     c_triangle},
    {"other_properties_and_elements",
     c_format +
         "element material 1\nproperty double shine\nproperty list uchar float k\nelement vertex 3\n"
         "property uchar a\n" +
         c_xyz +
         "property list int int w\nelement face 1\n"
         "property uchar flags\n" +
         c_corners +
         "property list uchar float texcoord\nelement edge 2\n"
         "property int vertex1\nproperty int vertex2\nend_header\n1e300 2 nan .5\n1 0 0 0 2 7 7\n"
         "2 1 0 0 0\n3 0 1 0 1 -9\n255 3 0 1 2 6 0 0 1 0 .5 1\n0 1\n1 2\n",
     c_triangle},
    {"skipped_word",
     changed(changed(c_plain, "end_header", "property char a\nend_header"), "3 0 1 2", "3 0 1 2 x"),
     c_triangle},
    {"length_of_a_skipped_list",
     changed(changed(c_plain, "end_header", "property list char char a\nend_header"), "3 0 1 2", "3 0 1 2 x"),
     "! a.ply:14: face 0: 'x' is not an integer; correct it, or the type in the header"},
    {"not_ply", "plyx\n", "! a.ply:1: not a PLY file: its first line is not 'ply'; export it again"},
    {"no_format", changed(c_plain, "format ascii 1.0\n", ""),
     "! a.ply:8: the PLY header names no format; export the file again"},
    {"two_formats", c_format + "format ascii 1.0\n", "! a.ply:3: a second format; remove it"},
    {"other_format", "ply\nformat binary 1.0\n",
     "! a.ply:2: 'binary' is not a format of PLY; export the file again"},
    {"other_version", "ply\nformat ascii 2.0\n",
     "! a.ply:2: '2.0' is not a version of PLY that can be read; export as 1.0"},
    {"no_end_header", c_header3,
     "! a.ply:7: the PLY header has no end_header; the file is truncated, export it again"},
    {"other_keyword", c_format + "elemnt vertex 3\n",
     "! a.ply:3: 'elemnt' is not a keyword of a PLY header; correct or remove the line"},
    {"word_after_end_header", changed(c_plain, "end_header", "end_header 1"),
     "! a.ply:9: a word after end_header; remove it"},
    {"word_after_property", changed(c_plain, "float x", "float x y"),
     "! a.ply:4: 'y' at the end of a property line; remove it"},
    {"count_of_word", c_format + "element vertex three\n",
     "! a.ply:3: 'three' is not a count of items; correct it"},
    {"count_beyond_64_bits", c_format + "element vertex 18446744073709551616\n",
     "! a.ply:3: '18446744073709551616' is not a count of items; correct it"},
    {"vertices_beyond_the_limit", c_format + "element vertex 30000001\n",
     "! a.ply:3: 30000001 vertices, but 30000000 is the most; reduce the mesh"},
    {"count_of_faces_beyond_the_file", changed(c_plain, "face 1", "face 18446744073709551615"),
     "! a.ply:14: the file ends at item 1 of 18446744073709551615 of 'face'; it is truncated, or the count "
     "in "
     "its header is wrong; export it again"},
    {"two_elements", changed(c_plain, "element face 1", "element vertex 3"),
     "! a.ply:7: a second element 'vertex'; rename or remove it"},
    {"face_before_vertex", c_format + c_face1, "! a.ply:3: element face before element vertex; reorder them"},
    {"property_first", c_format + c_xyz, "! a.ply:3: a property before the first element; reorder them"},
    {"other_type", changed(c_plain, "float x", "half x"),
     "! a.ply:4: 'half' is not a type of PLY; correct it"},
    {"length_of_float", changed(c_plain, "list uchar", "list float"),
     "! a.ply:8: 'float' is not a type for the length of a list; correct it"},
    {"corners_of_float", changed(c_plain, "uchar int", "uchar float"),
     "! a.ply:8: vertex_indices is not a list of integers; correct it"},
    {"two_corner_lists", changed(c_plain, c_corners, c_corners + "property list uchar int vertex_index\n"),
     "! a.ply:9: a second list of corners; remove it"},
    {"no_corners", changed(c_plain, "vertex_indices", "indices"),
     "! a.ply:7: element face has no list vertex_indices; export the file again"},
    {"x_of_list", changed(c_plain, "property float x", "property list uchar float x"),
     "! a.ply:4: x is a list; correct it"},
    {"x_twice", changed(c_plain, "float y", "float x"),
     "! a.ply:5: a second property 'x' of 'vertex'; rename or remove it"},
    {"missing_z", changed(c_plain, "property float z\n", ""),
     "! a.ply:3: vertices have no property z; export the file again"},
    {"normals_twice",
     changed(c_plain, "element face", "property float nx\nproperty float normal_x\nelement face"),
     "! a.ply:8: a second property nx; remove it"},
    {"nameless", changed(c_plain, "float x", "float"), "! a.ply:4: a property without a name; give it one"},
    {"items_without_properties", changed(c_plain, "element vertex", "element nothing 50\nelement vertex"),
     "! a.ply:3: the 50 items of 'nothing' have no property; remove the element"},
};

INSTANTIATE_TEST_SUITE_P(Text, PlySpelling, ::testing::ValuesIn(c_ply_text), name_of);

// ---- Binary

/// Header and data of a triangle; `order` is "little" or "big".
std::string binary_ply(bool big, const std::string& line_end = "\n", float x = 1.0f, std::int32_t index = 2) {
  const auto bytes = [big](auto value) { return big ? big_endian(value) : little_endian(value); };
  std::string text = with_line_end(
      changed(c_header3 + c_face1, "ascii", big ? "binary_big_endian" : "binary_little_endian"), line_end);
  for (const float number : {0.0f, 0.0f, 0.0f, x, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f}) text += bytes(number);
  text += '\3';
  for (const std::int32_t corner : {0, 1, index}) text += bytes(corner);
  return text;
}
/// Bytes of the header.
std::size_t start(const std::string& text) {
  return text.find("end_header") + 11;
}
std::string at_byte(const std::string& text, std::size_t byte, const std::string& what) {
  return fmt::format("! a.ply: byte {}: {}", start(text) + byte, what);
}

/// All types in one vertex: x, y, z of these types, the other types skipped.
std::string all_types(bool big) {
  const auto bytes = [big](auto value) { return big ? big_endian(value) : little_endian(value); };
  std::string text = std::string("ply\nformat binary_") + (big ? "big" : "little") +
                     "_endian 1.0\nelement vertex 3\nproperty char a\nproperty short x\nproperty uchar b\n"
                     "property double y\nproperty uint c\nproperty list ushort double d\nproperty int z\n"
                     "element face 1\nproperty list int ushort vertex_indices\nproperty float quality\n"
                     "end_header\n";
  const int zs[] = {0, -70000, 70000};
  for (const int i : {0, 1, 2}) {
    text += '\xff';
    text += bytes(static_cast<std::uint16_t>(-300 * i));
    text += '\x80';
    text += bytes(0.1 * i) + bytes(std::uint32_t{0xffffffff}) + bytes(static_cast<std::uint16_t>(i));
    for (int k = 0; k < i; ++k) text += bytes(std::numeric_limits<double>::quiet_NaN());
    text += bytes(zs[i]);
  }
  text += bytes(std::int32_t{3});
  for (const int i : {0, 1, 2}) text += bytes(static_cast<std::uint16_t>(i));
  return text + bytes(std::numeric_limits<float>::infinity());
}

const float c_nan = std::numeric_limits<float>::quiet_NaN(),
            c_infinity = std::numeric_limits<float>::infinity();

const std::vector<Spelling> c_ply_binary = {
    {"little", binary_ply(false), c_triangle},
    {"big", binary_ply(true), c_triangle},
    {"crlf", binary_ply(false, "\r\n"), c_triangle},
    {"cr", binary_ply(true, "\r"), c_triangle},
    // After a header of CR lines the data may start with the byte of LF.
    {"cr_then_lf",
     changed(binary_ply(false, "\r"), "end_header\r" + std::string(4, '\0'),
             "end_header\r" + little_endian(0x0a)),
     fmt::format("{},0,0 1,0,0 0,1,0", static_cast<double>(std::bit_cast<float>(0x0a)))},
    {"all_types_little", all_types(false), "0,0,0 -300,0.1,-70000 -600,0.2,70000"},
    {"all_types_big", all_types(true), "0,0,0 -300,0.1,-70000 -600,0.2,70000"},
    {"nan", binary_ply(false, "\n", c_nan),
     at_byte(binary_ply(false), 12, "vertex 1: x is not finite, or too large; correct it")},
    {"index_beyond", binary_ply(false, "\n", 1, 3),
     at_byte(binary_ply(false), 49,
             "face 0: its corner is vertex 3, but the file has 3, counted from 0; correct the index")},
    {"wrong_byte_order", changed(binary_ply(true), "big", "little"),
     at_byte(binary_ply(false), 45,
             "face 0: its corner is vertex 16777216, but the file has 3, counted from 0; correct the index")},
    {"trailing_line_ends", binary_ply(false) + "\r\n\n", c_triangle},
    {"trailing_byte", binary_ply(false) + std::string(1, '\0'),
     at_byte(binary_ply(false), 49,
             "1 bytes follow the last element; correct the counts in the header, or remove them")},
    {"truncated", binary_ply(false).substr(0, binary_ply(false).size() - 1),
     at_byte(binary_ply(false), 45,
             "the file ends at item 0 of 1 of 'face'; it is truncated, or the count in its "
             "header is wrong; export it again")},
    {"ends_in_end_header", binary_ply(false).substr(0, start(binary_ply(false)) - 1),
     at_byte(binary_ply(false), -1,
             "the file ends at item 0 of 3 of 'vertex'; it is truncated, or the count in its "
             "header is wrong; export it again")},
    {"items_missing", changed(binary_ply(false), "face 1", "face 2"),
     at_byte(binary_ply(false), 49,
             "the file ends at item 1 of 2 of 'face'; it is truncated, or the count in its "
             "header is wrong; export it again")},
};

INSTANTIATE_TEST_SUITE_P(Binary, PlySpelling, ::testing::ValuesIn(c_ply_binary), name_of);

// ---- Normals, positions, notes

TEST(Ply, NormalsOfVerticesAreThoseOfTheirCorners) {
  const auto loaded = read_ply(c_format + "element vertex 3\n" + c_xyz +
                                   "property float nx\nproperty float ny\nproperty float nz\n" + c_face1 +
                                   "0 0 0 0 0 2\n1 0 0 0 0 0\n0 1 0 .5 -.5 1e0\n3 2 0 1\n",
                               "a.ply");
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(triangles_of(loaded), "0,1,0 0,0,0 1,0,0");
  EXPECT_EQ(normals_of(*loaded), "0.5,-0.5,1 0,0,2 0,0,0 ");
}

TEST(Ply, NormalsThatCannotBeReadAreComputed) {
  const std::string text = c_header3 + "property float nx\nproperty float ny\nproperty double nz\n" +
                           c_face1 + "0 0 0 0 nan 1\n1 0 0 -1.#IND 0 x\n0 1 0 0 0 1\n3 0 1 2\n";
  const auto loaded = must(read_ply(text, "a.ply"));
  EXPECT_EQ(normals_of(loaded), "0,0,0 0,0,0 0,0,1 ");
  EXPECT_EQ(loaded.notes, std::vector<std::string>{
                              "a.ply:13: a normal is not three finite numbers; it is computed (2 times)"});
  std::string names = text;
  for (const std::string axis : {"x", "y", "z"}) names = changed(names, " n" + axis, " normal_" + axis);
  EXPECT_EQ(normals_of(must(read_ply(names, "a.ply"))), "0,0,0 0,0,0 0,0,1 ");
  const auto part = must(read_ply(changed(text, "double nz", "double n"), "a.ply"));
  EXPECT_EQ(normals_of(part), "0,0,0 0,0,0 0,0,0 ");
  EXPECT_EQ(part.notes, (std::vector<std::string>{
                            "a.ply:9: property 'n' is not used",
                            "a.ply:3: vertices have only a part of nx, ny and nz; normals are computed"}));
}

TEST(Ply, BinaryNormalsBeyondTheRangeAreComputed) {
  std::string text =
      changed(c_header3 + "property double nx\nproperty double ny\nproperty double nz\n" + c_face1, "ascii",
              "binary_little_endian");
  for (int i = 0; i < 3; ++i) {
    for (const float x : {i == 1 ? 1.f : 0.f, i == 2 ? 1.f : 0.f, 0.f}) text += little_endian(x);
    for (const double n : {i == 0 ? 1e300 : 0.0, 0.0, 1.0}) text += little_endian(n);
  }
  text += '\3';
  for (const std::int32_t corner : {0, 1, 2}) text += little_endian(corner);
  EXPECT_EQ(normals_of(must(read_ply(text, "a.ply"))), "0,0,0 0,0,1 0,0,1 ");
}

TEST(Ply, WithoutNormalsCornersHaveTheNormalZero) {
  const auto loaded = must(read_ply(c_plain, "a.ply"));
  EXPECT_EQ(normals_of(loaded), "0,0,0 0,0,0 0,0,0 ");
  EXPECT_EQ(loaded.default_crease_degrees, c_smooth_crease_degrees);
  ASSERT_EQ(loaded.mesh.materials.size(), 1u);
  EXPECT_EQ(loaded.mesh.materials[0].name, "default");
  EXPECT_TRUE(loaded.notes.empty());
}

TEST(Ply, NotesSayWhatIsLeftOut) {
  const auto loaded =
      read_ply(c_format + "element vertex 4\n" + c_xyz +
                   "property uchar red\nproperty uchar green\nproperty uchar blue\n" + "element face 3\n" +
                   c_corners + "element edge 1\nproperty int vertex1\nend_header\n" +
                   "0 0 0 1 2 3\n1 0 0 1 2 3\n0 1 0 1 2 3\n2 0 0 1 2 3\n3 0 1 2\n2 0 1\n4 0 1 3 1\n5\n",
               "a.ply");
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->notes, (std::vector<std::string>{
                               "a.ply: 1 faces without area left out", "a.ply: 1 points and lines left out",
                               "a.ply: elements 'edge' are left out", "a.ply: vertex colours are left out"}));
}

TEST(Ply, ToleratedSpellingsAreNoted) {
  EXPECT_EQ(must(read_ply(face("3.0 0 1 2.0"), "a.ply")).notes,
            std::vector<std::string>{"a.ply:13: an integer is written with a point (2 times)"});
  EXPECT_EQ(
      must(read_ply(changed(changed(c_plain, "end_header", "element edge 0\nproperty int a\nend_header"),
                            "\n0", "\n\xef\xbb\xbf\x30"),
                    "a.ply"))
          .notes,
      std::vector<std::string>{"a.ply:12: a byte order mark in the file is left out"});
  const std::string text = binary_ply(false);
  EXPECT_EQ(must(read_ply(text + "\n", "a.ply")).notes,
            std::vector<std::string>{
                fmt::format("a.ply: byte {}: line ends after the last element are left out", text.size())});
}

TEST(Ply, MoreTrianglesThanTheLimitAreRefused) {
  // A strip of 10 million triangles and one more.
  const std::uint32_t corners = c_max_triangles + 3;
  std::string text = changed(strips(""), "ascii", "binary_little_endian")
                         .substr(0, strips("").find("end_header\n") + 11 + 15);
  for (const float number : {0.f, 0.f, 0.f, 0.f, 1.f, 0.f, 1.f, 0.f, 0.f, 1.f, 1.f, 0.f, 2.f, 0.f, 0.f})
    text += little_endian(number);
  text += little_endian(corners);
  for (std::uint32_t i = 0; i < corners; ++i) text += little_endian(i % 5);
  EXPECT_TRUE(
      is_error(read_ply(text, "a.ply"), "tristrips 0: more than 10000000 triangles; reduce the mesh"));
}

}  // namespace
}  // namespace halfway
