-- SPDX-License-Identifier: Apache-2.0
-- Made by `make tables` from model/tables/formats.cpp; edit that.
-- Number formats and the layouts of the flat vectors, for both presets. A slice of (-1, 0) is a field that
-- the preset does not have.

library ieee;
  use ieee.std_logic_1164.all;

package formats_pkg is

  type format_t is record
    bits     : natural;
    fraction : natural;
  end record;

  type slice_t is record
    high : integer;
    low  : natural;
  end record;

  type formats_t is record
    flag : format_t;
    triangle : format_t;
    pixel_x : format_t;
    pixel_y : format_t;
    lines : format_t;
    span_x : format_t;
    colour : format_t;
    depth : format_t;
    depth_sum : format_t;
    sample_word : format_t;
    command : format_t;
    light : format_t;
    shadow_count : format_t;
    spot_slope : format_t;
    edge_error : format_t;
    edge_x : format_t;
    intensity : format_t;
    angle : format_t;
    power : format_t;
    plane_sum : format_t;
    vector : format_t;
    direction : format_t;
    offset : format_t;
    light_place : format_t;
    light_shift : format_t;
    square : format_t;
    root_entry : format_t;
    root : format_t;
    exponent : format_t;
    weight : format_t;
    coefficient : format_t;
    light_intensity : format_t;
    reflected : format_t;
    radiance : format_t;
    factor : format_t;
    product_word : format_t;
  end record;

  constant c_exact_formats : formats_t := (
    -- u1.0: one bit
    flag => (1, 0),
    -- u32.0: number of the scene's triangle, carried through as a tag
    triangle => (32, 0),
    -- u12.0: frames up to 4096 pixels wide
    pixel_x => (12, 0),
    -- u12.0: frames up to 4096 lines high
    pixel_y => (12, 0),
    -- u13.0: 0 to 4096 lines
    lines => (13, 0),
    -- s13.0: -1 to 4096: a span's end is exclusive on either side
    span_x => (14, 0),
    -- u8.0: what the frame stores
    colour => (8, 0),
    -- u24.0: what the z test compares
    depth => (24, 0),
    -- s24.15: first differences, each rounded to 2^-16, at most 4095 lines and 8190 steps: off by at most (1 + 4095 + 8190) 2^-16 = 0.19 of a depth step
    depth_sum => (40, 15),
    -- u16.0: a cosine table's entry, of whatever size, for the probe
    sample_word => (16, 0),
    -- u3.0: of a vector or token of the shading processors
    command => (3, 0),
    -- u5.0: a light's number from 1; 0 is the ambient light
    light => (5, 0),
    -- s9.0: shadow volumes opened less those closed, up to 511 either way
    shadow_count => (10, 0),
    -- u18.6: one over the width of a spot's soft edge, in cosines; a harder edge has one of 2^-18, so that a cone of a tenth of a degree still comes to its full light
    spot_slope => (24, 6),
    -- u18.0: below the edge's height in subpixels: 8192 pixels of 16, doubled at no level of subdivision
    edge_error => (18, 0),
    -- s13.0: an edge is a whole pixel and a remainder
    edge_x => (14, 0),
    -- s11.28: second differences, each word rounded to 2^-29, k = 4095 lines + 8190 steps: off by at most (1 + k + k^2/2) 2^-29 = 0.15 of a colour step; samples up to 1023 stay within +-2046
    intensity => (40, 28),
    -- s10.22: half bells; start and slope each rounded to 2^-23, at most 4095 steps: off by at most 2^-11, a quarter of a 2^-9 cell; exponents up to 10^6 stay within +-1024
    angle => (33, 22),
    -- u3.0: which table: cosine to the power 2^word
    power => (3, 0),
    -- s1.42: first differences, each rounded to 2^-43, at most 4095 lines and 8190 steps: off by at most 12286 2^-43 = 0.4 of a step of vector
    plane_sum => (44, 42),
    -- s1.28: interpolated N/w, view ray and 1/w, the largest scaled to 1/2 to 1
    vector => (30, 28),
    -- s1.22: components of unit vectors; an exponent m multiplies the error of a cosine by m
    direction => (24, 22),
    -- s2.28: from a surface point to a light, before it is normalized
    offset => (31, 28),
    -- s1.26: a light's direction, or its place with 2^light_shift taken off
    light_place => (28, 26),
    -- u5.0: how much farther a light may be than the nearest surface: 2^31
    light_shift => (5, 0),
    -- u2.28: of a vector's length, 1/4 to 3
    square => (30, 28),
    -- u0.12: table of 1/sqrt(x), 512 entries: within 2^-9.8 of it
    root_entry => (12, 12),
    -- u1.23: after a Newton step: within 2^-19 of 1/sqrt(x)
    root => (24, 23),
    -- u13.8: up to 8191; off by 2^-9: 0.0008 of a highlight's peak at most
    exponent => (21, 8),
    -- u1.16: a power of a cosine, or of a spot's edge
    weight => (17, 16),
    -- u4.16: k of a material, up to 15
    coefficient => (20, 16),
    -- u14.4: colour steps, 64 times white
    light_intensity => (18, 4),
    -- u14.8: k I in colour steps; held at 64 times white
    reflected => (22, 8),
    -- u10.12: sum of the terms in colour steps; held at four times white
    radiance => (22, 12),
    -- u16.8: off by at most 2^-9 of a step; the largest times the least entry of up to 8 bits is white, so what is brighter needs no more
    factor => (24, 8),
    -- u40.0: a factor times a table's entry, for the probe
    product_word => (40, 0)
  );

  constant c_published_formats : formats_t := (
    -- u1.0: one bit
    flag => (1, 0),
    -- u32.0: number of the scene's triangle, carried through as a tag
    triangle => (32, 0),
    -- u12.0: frames up to 4096 pixels wide
    pixel_x => (12, 0),
    -- u12.0: frames up to 4096 lines high
    pixel_y => (12, 0),
    -- u13.0: 0 to 4096 lines
    lines => (13, 0),
    -- s13.0: -1 to 4096: a span's end is exclusive on either side
    span_x => (14, 0),
    -- u8.0: what the frame stores
    colour => (8, 0),
    -- u24.0: what the z test compares
    depth => (24, 0),
    -- s24.15: first differences, each rounded to 2^-16, at most 4095 lines and 8190 steps: off by at most (1 + 4095 + 8190) 2^-16 = 0.19 of a depth step
    depth_sum => (40, 15),
    -- u16.0: a cosine table's entry, of whatever size, for the probe
    sample_word => (16, 0),
    -- u3.0: of a vector or token of the shading processors
    command => (3, 0),
    -- u5.0: a light's number from 1; 0 is the ambient light
    light => (5, 0),
    -- s9.0: shadow volumes opened less those closed, up to 511 either way
    shadow_count => (10, 0),
    -- u18.6: one over the width of a spot's soft edge, in cosines; a harder edge has one of 2^-18, so that a cone of a tenth of a degree still comes to its full light
    spot_slope => (24, 6),
    -- u0.0: edges are stepped by a real slope
    edge_error => (0, 0),
    -- s13.18: 32 bits, as the quadratic paper's other registers
    edge_x => (32, 18),
    -- s11.20: 32 bits, 20 of them fraction: the quadratic paper's figure 7
    intensity => (32, 20),
    -- s0.11: 12 bits, the upper 6 of them the address: the spherical paper's line interpolator; wraps at the bell's ends
    angle => (12, 11),
    -- u0.0: cosine squared alone
    power => (0, 0),
    -- s1.26: first differences: off by at most 12286 2^-27 = 1.5 steps of vector
    plane_sum => (28, 26),
    -- s1.14: 16 bits: the processors paper names no width; interpolated N and P
    vector => (16, 14),
    -- s1.14: 16 bits, so that an N that is not normalized passes as it is
    direction => (16, 14),
    -- s2.14: from a surface point to a light, before it is normalized
    offset => (17, 14),
    -- s1.14: as vector
    light_place => (16, 14),
    -- u0.0: places share one scale
    light_shift => (0, 0),
    -- u2.14: of a vector's length, 1/4 to 3
    square => (16, 14),
    -- u0.9: table of 1/sqrt(x), 64 entries: within 2^-6.4 of it
    root_entry => (9, 9),
    -- u0.9: the table's entry
    root => (9, 9),
    -- u10.0: integers up to 1023
    exponent => (10, 0),
    -- u1.8: a power of a cosine, or of a spot's edge
    weight => (9, 8),
    -- u1.7: an integer, in 1/128
    coefficient => (8, 7),
    -- u8.0: an integer, in colour steps
    light_intensity => (8, 0),
    -- u8.0: k I, an integer
    reflected => (8, 0),
    -- u8.0: an integer; held at white
    radiance => (8, 0),
    -- u10.8: colour steps up to 1023; off by at most 2^-9 of a step
    factor => (18, 8),
    -- u36.0: a factor times a table's entry, for the probe
    product_word => (36, 0)
  );

  function formats (exact : boolean) return formats_t;

  type init_header_t is record
    triangle : slice_t;
    y : slice_t;
    upper_lines : slice_t;
    lower_lines : slice_t;
    backward : slice_t;
    start_x : slice_t;
    start_quotient : slice_t;
    start_remainder : slice_t;
    start_divisor : slice_t;
    start_error : slice_t;
    start_carry : slice_t;
    upper_x : slice_t;
    upper_quotient : slice_t;
    upper_remainder : slice_t;
    upper_divisor : slice_t;
    upper_error : slice_t;
    upper_carry : slice_t;
    lower_x : slice_t;
    lower_quotient : slice_t;
    lower_remainder : slice_t;
    lower_divisor : slice_t;
    lower_error : slice_t;
    lower_carry : slice_t;
    z : slice_t;
    z_dx : slice_t;
    z_de0 : slice_t;
    z_de1 : slice_t;
    start_slope : slice_t;
    upper_slope : slice_t;
  end record;

  constant c_exact_init_header : init_header_t := (
    triangle => (31, 0),
    y => (43, 32),
    upper_lines => (56, 44),
    lower_lines => (69, 57),
    backward => (70, 70),
    start_x => (84, 71),
    start_quotient => (98, 85),
    start_remainder => (116, 99),
    start_divisor => (134, 117),
    start_error => (152, 135),
    start_carry => (153, 153),
    upper_x => (167, 154),
    upper_quotient => (181, 168),
    upper_remainder => (199, 182),
    upper_divisor => (217, 200),
    upper_error => (235, 218),
    upper_carry => (236, 236),
    lower_x => (250, 237),
    lower_quotient => (264, 251),
    lower_remainder => (282, 265),
    lower_divisor => (300, 283),
    lower_error => (318, 301),
    lower_carry => (319, 319),
    z => (359, 320),
    z_dx => (399, 360),
    z_de0 => (439, 400),
    z_de1 => (479, 440),
    start_slope => (-1, 0),
    upper_slope => (-1, 0)
  );

  constant c_published_init_header : init_header_t := (
    triangle => (31, 0),
    y => (43, 32),
    upper_lines => (56, 44),
    lower_lines => (-1, 0),
    backward => (-1, 0),
    start_x => (88, 57),
    start_quotient => (-1, 0),
    start_remainder => (-1, 0),
    start_divisor => (-1, 0),
    start_error => (-1, 0),
    start_carry => (-1, 0),
    upper_x => (152, 121),
    upper_quotient => (-1, 0),
    upper_remainder => (-1, 0),
    upper_divisor => (-1, 0),
    upper_error => (-1, 0),
    upper_carry => (-1, 0),
    lower_x => (-1, 0),
    lower_quotient => (-1, 0),
    lower_remainder => (-1, 0),
    lower_divisor => (-1, 0),
    lower_error => (-1, 0),
    lower_carry => (-1, 0),
    z => (224, 185),
    z_dx => (264, 225),
    z_de0 => (304, 265),
    z_de1 => (-1, 0),
    start_slope => (120, 89),
    upper_slope => (184, 153)
  );

  function init_header (exact : boolean) return init_header_t;

  constant c_exact_init_header_bits : natural := 480;
  constant c_published_init_header_bits : natural := 305;

  type init_channel_t is record
    value : slice_t;
    dx : slice_t;
    de0 : slice_t;
    de1 : slice_t;
    dxx : slice_t;
    dxe0 : slice_t;
    dxe1 : slice_t;
    de0e0 : slice_t;
    de0e1 : slice_t;
    de1e1 : slice_t;
  end record;

  constant c_exact_init_channel : init_channel_t := (
    value => (39, 0),
    dx => (79, 40),
    de0 => (119, 80),
    de1 => (159, 120),
    dxx => (199, 160),
    dxe0 => (239, 200),
    dxe1 => (279, 240),
    de0e0 => (319, 280),
    de0e1 => (359, 320),
    de1e1 => (399, 360)
  );

  constant c_published_init_channel : init_channel_t := (
    value => (31, 0),
    dx => (63, 32),
    de0 => (95, 64),
    de1 => (-1, 0),
    dxx => (127, 96),
    dxe0 => (159, 128),
    dxe1 => (-1, 0),
    de0e0 => (191, 160),
    de0e1 => (-1, 0),
    de1e1 => (-1, 0)
  );

  function init_channel (exact : boolean) return init_channel_t;

  constant c_exact_init_channel_bits : natural := 400;
  constant c_published_init_channel_bits : natural := 192;

  function init_channel_low (exact : boolean; channel : natural) return natural;

  function init_bits (exact : boolean; channels : natural) return natural;

  type probe_header_t is record
    line_event : slice_t;
    span_event : slice_t;
    sample_event : slice_t;
    product_event : slice_t;
    line_y : slice_t;
    line_start : slice_t;
    line_stop : slice_t;
    line_carry : slice_t;
    line_z : slice_t;
    span_y : slice_t;
    span_x : slice_t;
    span_z : slice_t;
  end record;

  constant c_exact_probe_header : probe_header_t := (
    line_event => (0, 0),
    span_event => (1, 1),
    sample_event => (2, 2),
    product_event => (3, 3),
    line_y => (15, 4),
    line_start => (29, 16),
    line_stop => (43, 30),
    line_carry => (44, 44),
    line_z => (84, 45),
    span_y => (96, 85),
    span_x => (110, 97),
    span_z => (150, 111)
  );

  constant c_published_probe_header : probe_header_t := (
    line_event => (0, 0),
    span_event => (1, 1),
    sample_event => (2, 2),
    product_event => (3, 3),
    line_y => (15, 4),
    line_start => (29, 16),
    line_stop => (43, 30),
    line_carry => (-1, 0),
    line_z => (83, 44),
    span_y => (95, 84),
    span_x => (109, 96),
    span_z => (149, 110)
  );

  function probe_header (exact : boolean) return probe_header_t;

  constant c_exact_probe_header_bits : natural := 151;
  constant c_published_probe_header_bits : natural := 150;

  type probe_channel_t is record
    line_value : slice_t;
    line_dx : slice_t;
    line_de0 : slice_t;
    line_de1 : slice_t;
    span_value : slice_t;
    span_dx : slice_t;
  end record;

  constant c_exact_probe_channel : probe_channel_t := (
    line_value => (39, 0),
    line_dx => (79, 40),
    line_de0 => (119, 80),
    line_de1 => (159, 120),
    span_value => (199, 160),
    span_dx => (239, 200)
  );

  constant c_published_probe_channel : probe_channel_t := (
    line_value => (31, 0),
    line_dx => (63, 32),
    line_de0 => (95, 64),
    line_de1 => (-1, 0),
    span_value => (127, 96),
    span_dx => (159, 128)
  );

  function probe_channel (exact : boolean) return probe_channel_t;

  constant c_exact_probe_channel_bits : natural := 240;
  constant c_published_probe_channel_bits : natural := 160;

  function probe_channel_low (exact : boolean; channel : natural) return natural;

  function probe_bits (exact : boolean; channels : natural) return natural;

  constant c_exact_ambient_header_bits : natural := 0;
  constant c_published_ambient_header_bits : natural := 0;

  type ambient_channel_t is record
    ambient : slice_t;
  end record;

  constant c_exact_ambient_channel : ambient_channel_t := (
    ambient => (23, 0)
  );

  constant c_published_ambient_channel : ambient_channel_t := (
    ambient => (17, 0)
  );

  function ambient_channel (exact : boolean) return ambient_channel_t;

  constant c_exact_ambient_channel_bits : natural := 24;
  constant c_published_ambient_channel_bits : natural := 18;

  function ambient_channel_low (exact : boolean; channel : natural) return natural;

  function ambient_bits (exact : boolean; channels : natural) return natural;

  type diffuse_header_t is record
    angle : slice_t;
    slope : slice_t;
  end record;

  constant c_exact_diffuse_header : diffuse_header_t := (
    angle => (32, 0),
    slope => (65, 33)
  );

  constant c_published_diffuse_header : diffuse_header_t := (
    angle => (11, 0),
    slope => (23, 12)
  );

  function diffuse_header (exact : boolean) return diffuse_header_t;

  constant c_exact_diffuse_header_bits : natural := 66;
  constant c_published_diffuse_header_bits : natural := 24;

  type diffuse_channel_t is record
    factor : slice_t;
  end record;

  constant c_exact_diffuse_channel : diffuse_channel_t := (
    factor => (23, 0)
  );

  constant c_published_diffuse_channel : diffuse_channel_t := (
    factor => (17, 0)
  );

  function diffuse_channel (exact : boolean) return diffuse_channel_t;

  constant c_exact_diffuse_channel_bits : natural := 24;
  constant c_published_diffuse_channel_bits : natural := 18;

  function diffuse_channel_low (exact : boolean; channel : natural) return natural;

  function diffuse_bits (exact : boolean; channels : natural) return natural;

  type specular_header_t is record
    angle : slice_t;
    slope : slice_t;
    power : slice_t;
  end record;

  constant c_exact_specular_header : specular_header_t := (
    angle => (32, 0),
    slope => (65, 33),
    power => (68, 66)
  );

  constant c_published_specular_header : specular_header_t := (
    angle => (11, 0),
    slope => (23, 12),
    power => (-1, 0)
  );

  function specular_header (exact : boolean) return specular_header_t;

  constant c_exact_specular_header_bits : natural := 69;
  constant c_published_specular_header_bits : natural := 24;

  type specular_channel_t is record
    factor : slice_t;
  end record;

  constant c_exact_specular_channel : specular_channel_t := (
    factor => (23, 0)
  );

  constant c_published_specular_channel : specular_channel_t := (
    factor => (17, 0)
  );

  function specular_channel (exact : boolean) return specular_channel_t;

  constant c_exact_specular_channel_bits : natural := 24;
  constant c_published_specular_channel_bits : natural := 18;

  function specular_channel_low (exact : boolean; channel : natural) return natural;

  function specular_bits (exact : boolean; channels : natural) return natural;

  type diffuse_probe_header_t is record
    angle : slice_t;
    in_range : slice_t;
    sample : slice_t;
  end record;

  constant c_exact_diffuse_probe_header : diffuse_probe_header_t := (
    angle => (32, 0),
    in_range => (33, 33),
    sample => (49, 34)
  );

  constant c_published_diffuse_probe_header : diffuse_probe_header_t := (
    angle => (11, 0),
    in_range => (12, 12),
    sample => (28, 13)
  );

  function diffuse_probe_header (exact : boolean) return diffuse_probe_header_t;

  constant c_exact_diffuse_probe_header_bits : natural := 50;
  constant c_published_diffuse_probe_header_bits : natural := 29;

  type diffuse_probe_channel_t is record
    product : slice_t;
  end record;

  constant c_exact_diffuse_probe_channel : diffuse_probe_channel_t := (
    product => (39, 0)
  );

  constant c_published_diffuse_probe_channel : diffuse_probe_channel_t := (
    product => (35, 0)
  );

  function diffuse_probe_channel (exact : boolean) return diffuse_probe_channel_t;

  constant c_exact_diffuse_probe_channel_bits : natural := 40;
  constant c_published_diffuse_probe_channel_bits : natural := 36;

  function diffuse_probe_channel_low (exact : boolean; channel : natural) return natural;

  function diffuse_probe_bits (exact : boolean; channels : natural) return natural;

  type specular_probe_header_t is record
    angle : slice_t;
    in_range : slice_t;
    sample : slice_t;
  end record;

  constant c_exact_specular_probe_header : specular_probe_header_t := (
    angle => (32, 0),
    in_range => (33, 33),
    sample => (49, 34)
  );

  constant c_published_specular_probe_header : specular_probe_header_t := (
    angle => (11, 0),
    in_range => (12, 12),
    sample => (28, 13)
  );

  function specular_probe_header (exact : boolean) return specular_probe_header_t;

  constant c_exact_specular_probe_header_bits : natural := 50;
  constant c_published_specular_probe_header_bits : natural := 29;

  type specular_probe_channel_t is record
    product : slice_t;
  end record;

  constant c_exact_specular_probe_channel : specular_probe_channel_t := (
    product => (39, 0)
  );

  constant c_published_specular_probe_channel : specular_probe_channel_t := (
    product => (35, 0)
  );

  function specular_probe_channel (exact : boolean) return specular_probe_channel_t;

  constant c_exact_specular_probe_channel_bits : natural := 40;
  constant c_published_specular_probe_channel_bits : natural := 36;

  function specular_probe_channel_low (exact : boolean; channel : natural) return natural;

  function specular_probe_bits (exact : boolean; channels : natural) return natural;

  type request_header_t is record
    command : slice_t;
    light : slice_t;
    opens : slice_t;
    normalize : slice_t;
  end record;

  constant c_exact_request_header : request_header_t := (
    command => (2, 0),
    light => (7, 3),
    opens => (8, 8),
    normalize => (9, 9)
  );

  constant c_published_request_header : request_header_t := (
    command => (2, 0),
    light => (7, 3),
    opens => (8, 8),
    normalize => (9, 9)
  );

  function request_header (exact : boolean) return request_header_t;

  constant c_exact_request_header_bits : natural := 10;
  constant c_published_request_header_bits : natural := 10;

  constant c_exact_request_channel_bits : natural := 0;
  constant c_published_request_channel_bits : natural := 0;

  function request_channel_low (exact : boolean; channel : natural) return natural;

  function request_bits (exact : boolean; channels : natural) return natural;

  type plane_header_t is record
    value : slice_t;
    dx : slice_t;
    de0 : slice_t;
    de1 : slice_t;
  end record;

  constant c_exact_plane_header : plane_header_t := (
    value => (43, 0),
    dx => (87, 44),
    de0 => (131, 88),
    de1 => (175, 132)
  );

  constant c_published_plane_header : plane_header_t := (
    value => (27, 0),
    dx => (55, 28),
    de0 => (83, 56),
    de1 => (111, 84)
  );

  function plane_header (exact : boolean) return plane_header_t;

  constant c_exact_plane_header_bits : natural := 176;
  constant c_published_plane_header_bits : natural := 112;

  constant c_exact_plane_channel_bits : natural := 0;
  constant c_published_plane_channel_bits : natural := 0;

  function plane_channel_low (exact : boolean; channel : natural) return natural;

  function plane_bits (exact : boolean; channels : natural) return natural;

  type pixel_header_t is record
    command : slice_t;
    light : slice_t;
    opens : slice_t;
    normalize : slice_t;
    triangle : slice_t;
    y : slice_t;
    x : slice_t;
    z : slice_t;
  end record;

  constant c_exact_pixel_header : pixel_header_t := (
    command => (2, 0),
    light => (7, 3),
    opens => (8, 8),
    normalize => (9, 9),
    triangle => (41, 10),
    y => (53, 42),
    x => (65, 54),
    z => (89, 66)
  );

  constant c_published_pixel_header : pixel_header_t := (
    command => (2, 0),
    light => (7, 3),
    opens => (8, 8),
    normalize => (9, 9),
    triangle => (41, 10),
    y => (53, 42),
    x => (65, 54),
    z => (89, 66)
  );

  function pixel_header (exact : boolean) return pixel_header_t;

  constant c_exact_pixel_header_bits : natural := 90;
  constant c_published_pixel_header_bits : natural := 90;

  constant c_exact_pixel_channel_bits : natural := 0;
  constant c_published_pixel_channel_bits : natural := 0;

  function pixel_channel_low (exact : boolean; channel : natural) return natural;

  function pixel_bits (exact : boolean; channels : natural) return natural;

  type light_axes_header_t is record
    positional : slice_t;
    spot : slice_t;
    shift : slice_t;
    outer : slice_t;
    slope : slice_t;
    around_eye : slice_t;
  end record;

  constant c_exact_light_axes_header : light_axes_header_t := (
    positional => (0, 0),
    spot => (1, 1),
    shift => (6, 2),
    outer => (30, 7),
    slope => (54, 31),
    around_eye => (64, 55)
  );

  constant c_published_light_axes_header : light_axes_header_t := (
    positional => (0, 0),
    spot => (1, 1),
    shift => (-1, 0),
    outer => (17, 2),
    slope => (41, 18),
    around_eye => (51, 42)
  );

  function light_axes_header (exact : boolean) return light_axes_header_t;

  constant c_exact_light_axes_header_bits : natural := 65;
  constant c_published_light_axes_header_bits : natural := 52;

  type light_axes_channel_t is record
    place : slice_t;
    axis : slice_t;
    half : slice_t;
  end record;

  constant c_exact_light_axes_channel : light_axes_channel_t := (
    place => (27, 0),
    axis => (51, 28),
    half => (-1, 0)
  );

  constant c_published_light_axes_channel : light_axes_channel_t := (
    place => (15, 0),
    axis => (31, 16),
    half => (47, 32)
  );

  function light_axes_channel (exact : boolean) return light_axes_channel_t;

  constant c_exact_light_axes_channel_bits : natural := 52;
  constant c_published_light_axes_channel_bits : natural := 48;

  function light_axes_channel_low (exact : boolean; channel : natural) return natural;

  function light_axes_bits (exact : boolean; channels : natural) return natural;

  constant c_exact_light_colour_header_bits : natural := 0;
  constant c_published_light_colour_header_bits : natural := 0;

  type light_colour_channel_t is record
    intensity : slice_t;
  end record;

  constant c_exact_light_colour_channel : light_colour_channel_t := (
    intensity => (17, 0)
  );

  constant c_published_light_colour_channel : light_colour_channel_t := (
    intensity => (7, 0)
  );

  function light_colour_channel (exact : boolean) return light_colour_channel_t;

  constant c_exact_light_colour_channel_bits : natural := 18;
  constant c_published_light_colour_channel_bits : natural := 8;

  function light_colour_channel_low (exact : boolean; channel : natural) return natural;

  function light_colour_bits (exact : boolean; channels : natural) return natural;

  type processor_probe_header_t is record
    leaves : slice_t;
    command : slice_t;
  end record;

  constant c_exact_processor_probe_header : processor_probe_header_t := (
    leaves => (0, 0),
    command => (3, 1)
  );

  constant c_published_processor_probe_header : processor_probe_header_t := (
    leaves => (0, 0),
    command => (3, 1)
  );

  function processor_probe_header (exact : boolean) return processor_probe_header_t;

  constant c_exact_processor_probe_header_bits : natural := 4;
  constant c_published_processor_probe_header_bits : natural := 4;

  type processor_probe_channel_t is record
    radiance : slice_t;
  end record;

  constant c_exact_processor_probe_channel : processor_probe_channel_t := (
    radiance => (21, 0)
  );

  constant c_published_processor_probe_channel : processor_probe_channel_t := (
    radiance => (7, 0)
  );

  function processor_probe_channel (exact : boolean) return processor_probe_channel_t;

  constant c_exact_processor_probe_channel_bits : natural := 22;
  constant c_published_processor_probe_channel_bits : natural := 8;

  function processor_probe_channel_low (exact : boolean; channel : natural) return natural;

  function processor_probe_bits (exact : boolean; channels : natural) return natural;

end package;

package body formats_pkg is

  function formats (exact : boolean) return formats_t is
  begin
    if exact then
      return c_exact_formats;
    end if;
    return c_published_formats;
  end function;

  function init_header (exact : boolean) return init_header_t is
  begin
    if exact then
      return c_exact_init_header;
    end if;
    return c_published_init_header;
  end function;

  function init_channel (exact : boolean) return init_channel_t is
  begin
    if exact then
      return c_exact_init_channel;
    end if;
    return c_published_init_channel;
  end function;

  function init_channel_low (exact : boolean; channel : natural) return natural is
  begin
    if exact then
      return c_exact_init_header_bits + channel * c_exact_init_channel_bits;
    end if;
    return c_published_init_header_bits + channel * c_published_init_channel_bits;
  end function;

  function init_bits (exact : boolean; channels : natural) return natural is
  begin
    return init_channel_low(exact, channels);
  end function;

  function probe_header (exact : boolean) return probe_header_t is
  begin
    if exact then
      return c_exact_probe_header;
    end if;
    return c_published_probe_header;
  end function;

  function probe_channel (exact : boolean) return probe_channel_t is
  begin
    if exact then
      return c_exact_probe_channel;
    end if;
    return c_published_probe_channel;
  end function;

  function probe_channel_low (exact : boolean; channel : natural) return natural is
  begin
    if exact then
      return c_exact_probe_header_bits + channel * c_exact_probe_channel_bits;
    end if;
    return c_published_probe_header_bits + channel * c_published_probe_channel_bits;
  end function;

  function probe_bits (exact : boolean; channels : natural) return natural is
  begin
    return probe_channel_low(exact, channels);
  end function;

  function ambient_channel (exact : boolean) return ambient_channel_t is
  begin
    if exact then
      return c_exact_ambient_channel;
    end if;
    return c_published_ambient_channel;
  end function;

  function ambient_channel_low (exact : boolean; channel : natural) return natural is
  begin
    if exact then
      return c_exact_ambient_header_bits + channel * c_exact_ambient_channel_bits;
    end if;
    return c_published_ambient_header_bits + channel * c_published_ambient_channel_bits;
  end function;

  function ambient_bits (exact : boolean; channels : natural) return natural is
  begin
    return ambient_channel_low(exact, channels);
  end function;

  function diffuse_header (exact : boolean) return diffuse_header_t is
  begin
    if exact then
      return c_exact_diffuse_header;
    end if;
    return c_published_diffuse_header;
  end function;

  function diffuse_channel (exact : boolean) return diffuse_channel_t is
  begin
    if exact then
      return c_exact_diffuse_channel;
    end if;
    return c_published_diffuse_channel;
  end function;

  function diffuse_channel_low (exact : boolean; channel : natural) return natural is
  begin
    if exact then
      return c_exact_diffuse_header_bits + channel * c_exact_diffuse_channel_bits;
    end if;
    return c_published_diffuse_header_bits + channel * c_published_diffuse_channel_bits;
  end function;

  function diffuse_bits (exact : boolean; channels : natural) return natural is
  begin
    return diffuse_channel_low(exact, channels);
  end function;

  function specular_header (exact : boolean) return specular_header_t is
  begin
    if exact then
      return c_exact_specular_header;
    end if;
    return c_published_specular_header;
  end function;

  function specular_channel (exact : boolean) return specular_channel_t is
  begin
    if exact then
      return c_exact_specular_channel;
    end if;
    return c_published_specular_channel;
  end function;

  function specular_channel_low (exact : boolean; channel : natural) return natural is
  begin
    if exact then
      return c_exact_specular_header_bits + channel * c_exact_specular_channel_bits;
    end if;
    return c_published_specular_header_bits + channel * c_published_specular_channel_bits;
  end function;

  function specular_bits (exact : boolean; channels : natural) return natural is
  begin
    return specular_channel_low(exact, channels);
  end function;

  function diffuse_probe_header (exact : boolean) return diffuse_probe_header_t is
  begin
    if exact then
      return c_exact_diffuse_probe_header;
    end if;
    return c_published_diffuse_probe_header;
  end function;

  function diffuse_probe_channel (exact : boolean) return diffuse_probe_channel_t is
  begin
    if exact then
      return c_exact_diffuse_probe_channel;
    end if;
    return c_published_diffuse_probe_channel;
  end function;

  function diffuse_probe_channel_low (exact : boolean; channel : natural) return natural is
  begin
    if exact then
      return c_exact_diffuse_probe_header_bits + channel * c_exact_diffuse_probe_channel_bits;
    end if;
    return c_published_diffuse_probe_header_bits + channel * c_published_diffuse_probe_channel_bits;
  end function;

  function diffuse_probe_bits (exact : boolean; channels : natural) return natural is
  begin
    return diffuse_probe_channel_low(exact, channels);
  end function;

  function specular_probe_header (exact : boolean) return specular_probe_header_t is
  begin
    if exact then
      return c_exact_specular_probe_header;
    end if;
    return c_published_specular_probe_header;
  end function;

  function specular_probe_channel (exact : boolean) return specular_probe_channel_t is
  begin
    if exact then
      return c_exact_specular_probe_channel;
    end if;
    return c_published_specular_probe_channel;
  end function;

  function specular_probe_channel_low (exact : boolean; channel : natural) return natural is
  begin
    if exact then
      return c_exact_specular_probe_header_bits + channel * c_exact_specular_probe_channel_bits;
    end if;
    return c_published_specular_probe_header_bits + channel * c_published_specular_probe_channel_bits;
  end function;

  function specular_probe_bits (exact : boolean; channels : natural) return natural is
  begin
    return specular_probe_channel_low(exact, channels);
  end function;

  function request_header (exact : boolean) return request_header_t is
  begin
    if exact then
      return c_exact_request_header;
    end if;
    return c_published_request_header;
  end function;

  function request_channel_low (exact : boolean; channel : natural) return natural is
  begin
    if exact then
      return c_exact_request_header_bits + channel * c_exact_request_channel_bits;
    end if;
    return c_published_request_header_bits + channel * c_published_request_channel_bits;
  end function;

  function request_bits (exact : boolean; channels : natural) return natural is
  begin
    return request_channel_low(exact, channels);
  end function;

  function plane_header (exact : boolean) return plane_header_t is
  begin
    if exact then
      return c_exact_plane_header;
    end if;
    return c_published_plane_header;
  end function;

  function plane_channel_low (exact : boolean; channel : natural) return natural is
  begin
    if exact then
      return c_exact_plane_header_bits + channel * c_exact_plane_channel_bits;
    end if;
    return c_published_plane_header_bits + channel * c_published_plane_channel_bits;
  end function;

  function plane_bits (exact : boolean; channels : natural) return natural is
  begin
    return plane_channel_low(exact, channels);
  end function;

  function pixel_header (exact : boolean) return pixel_header_t is
  begin
    if exact then
      return c_exact_pixel_header;
    end if;
    return c_published_pixel_header;
  end function;

  function pixel_channel_low (exact : boolean; channel : natural) return natural is
  begin
    if exact then
      return c_exact_pixel_header_bits + channel * c_exact_pixel_channel_bits;
    end if;
    return c_published_pixel_header_bits + channel * c_published_pixel_channel_bits;
  end function;

  function pixel_bits (exact : boolean; channels : natural) return natural is
  begin
    return pixel_channel_low(exact, channels);
  end function;

  function light_axes_header (exact : boolean) return light_axes_header_t is
  begin
    if exact then
      return c_exact_light_axes_header;
    end if;
    return c_published_light_axes_header;
  end function;

  function light_axes_channel (exact : boolean) return light_axes_channel_t is
  begin
    if exact then
      return c_exact_light_axes_channel;
    end if;
    return c_published_light_axes_channel;
  end function;

  function light_axes_channel_low (exact : boolean; channel : natural) return natural is
  begin
    if exact then
      return c_exact_light_axes_header_bits + channel * c_exact_light_axes_channel_bits;
    end if;
    return c_published_light_axes_header_bits + channel * c_published_light_axes_channel_bits;
  end function;

  function light_axes_bits (exact : boolean; channels : natural) return natural is
  begin
    return light_axes_channel_low(exact, channels);
  end function;

  function light_colour_channel (exact : boolean) return light_colour_channel_t is
  begin
    if exact then
      return c_exact_light_colour_channel;
    end if;
    return c_published_light_colour_channel;
  end function;

  function light_colour_channel_low (exact : boolean; channel : natural) return natural is
  begin
    if exact then
      return c_exact_light_colour_header_bits + channel * c_exact_light_colour_channel_bits;
    end if;
    return c_published_light_colour_header_bits + channel * c_published_light_colour_channel_bits;
  end function;

  function light_colour_bits (exact : boolean; channels : natural) return natural is
  begin
    return light_colour_channel_low(exact, channels);
  end function;

  function processor_probe_header (exact : boolean) return processor_probe_header_t is
  begin
    if exact then
      return c_exact_processor_probe_header;
    end if;
    return c_published_processor_probe_header;
  end function;

  function processor_probe_channel (exact : boolean) return processor_probe_channel_t is
  begin
    if exact then
      return c_exact_processor_probe_channel;
    end if;
    return c_published_processor_probe_channel;
  end function;

  function processor_probe_channel_low (exact : boolean; channel : natural) return natural is
  begin
    if exact then
      return c_exact_processor_probe_header_bits + channel * c_exact_processor_probe_channel_bits;
    end if;
    return c_published_processor_probe_header_bits + channel * c_published_processor_probe_channel_bits;
  end function;

  function processor_probe_bits (exact : boolean; channels : natural) return natural is
  begin
    return processor_probe_channel_low(exact, channels);
  end function;

end package body;
