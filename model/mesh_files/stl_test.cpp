// SPDX-License-Identifier: Apache-2.0
#include "mesh_files/stl.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "mesh_files/test/spelling.hpp"
#include "sim/os/must.hpp"

namespace halfway {
namespace {

class StlSpelling : public ::testing::TestWithParam<Spelling> {};

TEST_P(StlSpelling, IsReadExactlyOrRefusedWithItsPlace) {
  EXPECT_EQ(triangles_of(read_stl(GetParam().text, "a.stl")), GetParam().wanted);
}

const std::string c_normal = "facet normal 0 0 1\nouter loop\n";
const std::string c_two = c_normal + "vertex 0 0 0\nvertex 1 0 0\n";
const std::string c_end = "endloop\nendfacet\n";
const std::string c_facet = c_two + "vertex 0 1 0\n" + c_end;

std::string solid(const std::string& facets) {
  return "solid a\n" + facets + "endsolid a\n";
}

const std::vector<Spelling> c_stl_text = {
    {"plain", solid(c_facet), c_triangle},
    {"blanks_first", " \n\t" + solid(c_facet), c_triangle},
    {"byte_order_mark", "\xef\xbb\xbf" + solid(c_facet), c_triangle},
    {"name_of_keywords", "solid facet # normal \\\n" + c_facet + "endsolid solid facet\n", c_triangle},
    {"two_solids", solid(c_facet) + "\n" + solid(c_facet), c_triangle + "; " + c_triangle},
    {"capitals",
     "SOLID A\nFACET NORMAL 0 0 1\nOuter Loop\nVERTEX 0 0 0\nVERTEX 1 0 0\nVERTEX 0 1 0\nENDLOOP\n"
     "ENDFACET\nENDSOLID A\n",
     c_triangle},
    {"one_line",
     "solid\nfacet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop endfacet endsolid",
     c_triangle},
    {"numbers", solid(changed(c_two, "1 0 0", "+.5 -5. 1E-1") + "vertex 1e1 -0 0005\n" + c_end),
     "0,0,0 0.5,-5,0.1 10,0,5"},
    {"normal_of_nan", solid(changed(c_facet, "normal 0 0 1", "normal nan -NaN inf")), c_triangle},

    {"normal_ind", solid(changed(c_facet, "normal 0 0 1", "normal -1.#IND00e+000 -1.#IND00e+000 1.#QNAN")),
     c_triangle},
    {"normal_of_words", solid(changed(c_facet, "normal 0 0 1", "normal up")), c_triangle},
    {"no_normal", solid(changed(c_facet, " normal 0 0 1", "")), c_triangle},
    {"words_joined_and_divided",
     changed(changed(changed(solid(c_facet), "endsolid ", "endsolid"), "endloop", "end loop"), "endfacet",
             "END Facet"),
     c_triangle},
    {"colours_after_facets", solid(changed(c_facet, "endfacet", "endfacet 31 0 color 1") + c_facet),
     c_triangle + "; " + c_triangle},
    {"facets_on_one_line", solid(changed(c_facet, "endfacet\n", "endfacet ") + c_facet),
     c_triangle + "; " + c_triangle},
    {"end_of_another", solid(changed(c_facet, "endloop", "end facet")),
     "! a.stl:7: 'facet' instead of 'endloop'; correct the line"},
    {"long_normal", solid(changed(c_facet, "normal 0 0 1", "normal 0 0 1 1")),
     "! a.stl:2: '1' instead of 'outer'; correct the line"},
    {"garbage_line", solid(changed(c_facet, "vertex 0 1 0", "nonsense\nvertex 0 1 0")),
     "! a.stl:6: 'nonsense' instead of 'vertex'; correct the line"},
    {"garbage_between_facets", solid(c_facet + "nonsense\n" + c_facet),
     "! a.stl:9: 'nonsense' instead of 'facet' or 'endsolid'; correct the line"},
    {"garbage_after_the_end", solid(c_facet) + "nonsense\n",
     "! a.stl:10: 'nonsense' instead of 'solid'; correct the line"},
    {"misspelt", solid(changed(c_facet, "vertex 1", "vertx 1")),
     "! a.stl:5: 'vertx' instead of 'vertex'; correct the line"},
    {"missing_z", solid(changed(c_facet, "1 0 0", "1 0")),
     "! a.stl:6: facet 1: 'vertex' is not a number; correct the number"},
    {"nan", solid(changed(c_facet, "1 0 0", "1 nan 0")),
     "! a.stl:5: facet 1: 'nan' is not finite; correct the number"},
    {"four_vertices", solid(c_two + "vertex 0 1 0\nvertex 1 1 0\n" + c_end),
     "! a.stl:7: facet 1 has more than 3 vertices; divide it into triangles"},
    {"no_endloop", solid(changed(c_facet, "endloop\n", "")),
     "! a.stl:7: 'endfacet' instead of 'endloop'; correct the line"},
    {"no_endsolid", "solid a\n" + c_facet,
     "! a.stl:9: the file ends where 'facet' or 'endsolid' must follow; it is truncated, export it again"},
    {"ends_in_a_facet", "solid a\n" + c_two,
     "! a.stl:6: the file ends where 'vertex' must follow; it is truncated, export it again"},
    {"zero_byte", solid(c_facet + std::string(1, '\0')),
     "! a.stl:9: '?endsolid' instead of 'facet' or 'endsolid'; correct the line"},
    {"empty", solid(""), "! a.stl: the mesh has no faces; export it with faces"},
    {"utf_16", std::string("\xff\xfes\0o\0l\0i\0d\0", 12), "! a.stl:1: the text is UTF-16; save it as UTF-8"},
    {"other_text", "v 0 0 0\n",
     "! a.stl: not an STL file, or truncated: it neither starts with 'solid' nor has the 84 bytes of a "
     "binary header; export it again"},
};

INSTANTIATE_TEST_SUITE_P(Text, StlSpelling, ::testing::ValuesIn(c_stl_text), name_of);

/// A binary file of triangles (0, 0, 0) (x, 0, 0) (0, 1, 0).
std::string binary_stl(std::uint32_t count, const std::vector<float>& xs, const std::string& header = "",
                       std::uint16_t attribute = 0) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  std::string bytes = header + std::string(80 - header.size(), ' ') + little_endian(count);
  for (const float x : xs) {
    for (const float number : {nan, nan, nan, 0.0f, 0.0f, 0.0f, x, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f}) {
      bytes += little_endian(number);
    }
    bytes += little_endian(attribute);
  }
  return bytes;
}

const std::vector<Spelling> c_stl_binary = {
    {"plain", binary_stl(1, {1}), c_triangle},
    {"two", binary_stl(2, {1, 2}), c_triangle + "; 0,0,0 2,0,0 0,1,0"},
    {"header_of_solid", binary_stl(1, {1}, "solid facet normal"), c_triangle},
    {"header_of_zeros", binary_stl(1, {1}, std::string(80, '\0')), c_triangle},
    {"count_too_large", binary_stl(2, {1}),
     "! a.stl: not an STL file, or damaged: its header (byte 80) requires 2 facets and so 184 bytes, it has "
     "134; export it again"},
    {"bytes_after_facets", binary_stl(1, {1}) + "made by", c_triangle},
    {"largest_count", binary_stl(UINT32_MAX, {1}),
     "! a.stl: not an STL file, or damaged: its header (byte 80) requires 4294967295 facets and so "
     "214748364834 bytes, it has 134; export it again"},
    {"nan", binary_stl(2, {1, std::numeric_limits<float>::quiet_NaN()}),
     "! a.stl: facet 2 (byte 158): vertex 2 has a coordinate that is not finite; correct it"},
    {"no_facets", binary_stl(0, {}), "! a.stl: the mesh has no faces; export it with faces"},
};

INSTANTIATE_TEST_SUITE_P(Binary, StlSpelling, ::testing::ValuesIn(c_stl_binary), name_of);

TEST(Stl, HasTheDefaultMaterialAndCrease) {
  const auto loaded = must(read_stl(solid(c_facet), "a.stl"));
  EXPECT_EQ(loaded.default_crease_degrees, c_stl_crease_degrees);
  ASSERT_EQ(loaded.mesh.materials.size(), 1u);
  EXPECT_EQ(loaded.mesh.materials[0].name, "default");
  EXPECT_EQ(normals_of(loaded), "0,0,0 0,0,0 0,0,0 ");
  EXPECT_TRUE(loaded.notes.empty());
}

TEST(Stl, PositionsAreJoined) {
  const auto loaded = must(read_stl(binary_stl(2, {1, 2}), "a.stl"));
  EXPECT_EQ(loaded.mesh.positions.size(), 4u);
}

TEST(Stl, ColoursOfFacetsAreNoted) {
  const auto loaded = must(read_stl(binary_stl(1, {1}, "", 0x801f), "a.stl"));
  EXPECT_EQ(loaded.notes, std::vector<std::string>{"a.stl: colours of facets are left out"});
}

TEST(Stl, WhatFollowsFacetsIsNoted) {
  EXPECT_EQ(must(read_stl(solid(changed(c_facet, "endfacet", "endfacet 1 2")), "a.stl")).notes,
            std::vector<std::string>{"a.stl:8: words after endfacet are left out (2 times)"});
  EXPECT_EQ(must(read_stl(binary_stl(1, {1}) + "ab", "a.stl")).notes,
            std::vector<std::string>{"a.stl: byte 134: 2 bytes after the facets are left out"});
}

TEST(Stl, MoreTrianglesThanTheLimitAreRefused) {
  const std::uint32_t count = c_max_triangles + 1;
  std::string bytes = std::string(80, ' ') + little_endian(count);
  bytes.resize(84 + 50 * std::size_t{count});
  EXPECT_EQ(triangles_of(read_stl(bytes, "a.stl")),
            "! a.stl: 10000001 triangles, but 10000000 is the most; reduce the mesh");
}

}  // namespace
}  // namespace halfway
