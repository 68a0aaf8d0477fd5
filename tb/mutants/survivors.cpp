// SPDX-License-Identifier: Apache-2.0
#include "survivors.hpp"

namespace halfway::mutants {
namespace {

constexpr std::string_view c_layout =
    "the generator writes the same functions for every layout; nothing asks for this one";
constexpr std::string_view c_size =
    "for who instantiates a shader without a size of its own; `make sim` names the size always";
constexpr std::string_view c_no_such =
    "behind it only the report that there is no such table, which ends the run";
constexpr std::string_view c_wider =
    "with the formats that there are a triangle's vector is always the wider one";

constexpr KnownGap c_gaps[] = {
    {"tables/formats_pkg.vhd", "return request_channel_low(exact, channels);", c_layout},
    {"tables/formats_pkg.vhd", "return plane_channel_low(exact, channels);", c_layout},
    {"tables/formats_pkg.vhd", "return pixel_channel_low(exact, channels);", c_layout},
    {"tables/formats_pkg.vhd", "if exact then", c_layout},
    {"tables/formats_pkg.vhd", "return c_exact_plane_header;", c_layout},
    {"tables/formats_pkg.vhd", "return c_published_plane_header;", c_layout},
    {"tables/formats_pkg.vhd", "return c_exact_light_colour_channel;", c_layout},
    {"tables/formats_pkg.vhd", "return c_published_light_colour_channel;", c_layout},
    {"tables/formats_pkg.vhd", "`exact` never true", c_layout},
    {"tables/formats_pkg.vhd", "`exact` never false", c_layout},
    {"tables/cosine_pkg.vhd", "return (0 to 2 ** address_bits - 1 => 0);", c_no_such},
    {"tables/cosine_pkg.vhd", "`not exact and power = 2 and address_bits = 4 and data_bits = 4` never false",
     c_no_such},
    {"tables/cosine_pkg.vhd", "if exact then", c_size},
    {"tables/cosine_pkg.vhd", "return 9;", c_size},
    {"tables/cosine_pkg.vhd", "return 8;", c_size},
    {"tables/cosine_pkg.vhd", "return 6;", c_size},
    {"tables/cosine_pkg.vhd", "`exact` never true", c_size},
    {"tables/cosine_pkg.vhd", "`exact` never false", c_size},
    {"tables/function_pkg.vhd", "return (9, 12, 12, 0);", c_no_such},
    {"tables/function_pkg.vhd", "return c_exact_reciprocal_root;", c_no_such},
    {"tables/function_pkg.vhd", "`not exact and which = c_decay` never false", c_no_such},
    {"shaders/processors_pkg.vhd", "return load_bits(c);", c_wider},
    {"shaders/processors_pkg.vhd", "`load_bits(c) > c_draw_bits` never true", c_wider},
};

constexpr std::string_view c_dropped = "a longer slice, whose upper bits `plain_direction` drops";

constexpr KnownSurvivor c_survivors[] = {
    {"illumination/shading_processor.vhd", "if c_shape.far then", "c_shape.far", "true",
     "a wider multiplier: the same products"},
    {"illumination/shading_processor.vhd", "elsif at_place = '0' then", "at_place = '0'", "false",
     "a directional light in a processor for positional ones, too, takes their clocks to the same sum; "
     "clocks are counted of processors for one kind"},
    {"illumination/shading_processor.vhd",
     "extended(plain_direction(g_exact, signed(in_token(low + c_vector - 1 downto low))), c_vector);", "1",
     "0", c_dropped},
    {"illumination/shading_processor.vhd", "sum := (others => '0');", "'0'", "'1'",
     "a value for the netlist alone: wherever the sum is used it was given another"},
    {"illumination/unrolled_shading_processor.vhd",
     "unsigned(k_i(channel * (c_k + c_intensity + 2) + c_k + c_intensity - 1 downto", "2", "3",
     "a longer slice: above a product of numbers without a sign there are zeros"},
    {"illumination/unrolled_shading_processor.vhd",
     "signed(behind(normal_low(c_config, axis) + c_vector - 1 downto normal_low(c_config, axis))));", "-",
     "+", c_dropped},
};

}  // namespace

std::span<const KnownSurvivor> known_survivors() {
  return c_survivors;
}

std::span<const KnownGap> known_gaps() {
  return c_gaps;
}

}  // namespace halfway::mutants
