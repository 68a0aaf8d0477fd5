-- SPDX-License-Identifier: Apache-2.0
-- Made by `make tables` from model/words/generator/formats.cpp; edit that.
-- Number formats and the layouts of the flat vectors, for both presets. A slice of (-1, 0) is a field that
-- the preset does not have. A format of preset published without a comment is that of preset exact. A vector of n
-- channels has x_bits(exact, n) bits; channel n starts there.
-- In bounds u is the format's unit, u_x that of format x. Frames have up to 4096 lines and pixels, so
-- lines = pixels = 4095; steps = 8190: one pixel per line along the edge, then the span; k = lines + steps,
-- k_published = lines + pixels. There are up to 16 lights with 32 terms; m is an exponent, e Euler's number.

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
  end record;

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

  function init_header (exact : boolean) return init_header_t;

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

  function init_channel (exact : boolean) return init_channel_t;

  function init_bits (exact : boolean; channels : natural) return natural;

  type ambient_channel_t is record
    ambient : slice_t;
  end record;

  function ambient_channel (exact : boolean) return ambient_channel_t;

  function ambient_bits (exact : boolean; channels : natural) return natural;

  type diffuse_header_t is record
    angle : slice_t;
    slope : slice_t;
  end record;

  function diffuse_header (exact : boolean) return diffuse_header_t;

  type diffuse_channel_t is record
    factor : slice_t;
  end record;

  function diffuse_channel (exact : boolean) return diffuse_channel_t;

  function diffuse_bits (exact : boolean; channels : natural) return natural;

  type specular_header_t is record
    angle : slice_t;
    slope : slice_t;
    power : slice_t;
  end record;

  function specular_header (exact : boolean) return specular_header_t;

  type specular_channel_t is record
    factor : slice_t;
  end record;

  function specular_channel (exact : boolean) return specular_channel_t;

  function specular_bits (exact : boolean; channels : natural) return natural;

  type request_header_t is record
    command : slice_t;
    light : slice_t;
    opens : slice_t;
    normalize : slice_t;
  end record;

  function request_header (exact : boolean) return request_header_t;

  function request_bits (exact : boolean) return natural;

  type plane_header_t is record
    value : slice_t;
    dx : slice_t;
    de0 : slice_t;
    de1 : slice_t;
  end record;

  function plane_header (exact : boolean) return plane_header_t;

  function plane_bits (exact : boolean) return natural;

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

  function pixel_header (exact : boolean) return pixel_header_t;

  function pixel_bits (exact : boolean) return natural;

  type light_axes_header_t is record
    positional : slice_t;
    spot : slice_t;
    shift : slice_t;
    outer : slice_t;
    slope : slice_t;
    around_eye : slice_t;
  end record;

  function light_axes_header (exact : boolean) return light_axes_header_t;

  type light_axes_channel_t is record
    place : slice_t;
    axis : slice_t;
    half : slice_t;
  end record;

  function light_axes_channel (exact : boolean) return light_axes_channel_t;

  function light_axes_bits (exact : boolean; channels : natural) return natural;

  type light_colour_channel_t is record
    intensity : slice_t;
  end record;

  function light_colour_channel (exact : boolean) return light_colour_channel_t;

  function light_colour_bits (exact : boolean; channels : natural) return natural;

end package;

package body formats_pkg is

  function formats (exact : boolean) return formats_t is
  begin
    if exact then
      return (
        -- u1.0: one bit
        --   at most 1
        flag => (1, 0),
        -- u32.0: number of the scene's triangle, carried through as a tag
        --   at most 4294967295: 2^32 - 1
        triangle => (32, 0),
        -- u12.0: frames up to 4096 pixels wide
        --   at most 4095: frame - 1
        pixel_x => (12, 0),
        -- u12.0: frames up to 4096 lines high
        --   at most 4095: frame - 1
        pixel_y => (12, 0),
        -- u13.0: 0 to 4096 lines
        --   at most 4096: frame
        lines => (13, 0),
        -- s13.0: -1 to 4096: a span's end is exclusive on either side
        --   at most 4096: frame
        span_x => (14, 0),
        -- u8.0: stored in the frame: the sum before it, rounded once and clamped
        --   at most 255: 2^8 - 1
        --   rounded: off by at most 0.5 colour steps: u / 2
        colour => (8, 0),
        -- u24.0: compared by the depth test: the sum before it, rounded once
        --   at most 16777215: 2^24 - 1
        --   rounded: off by at most 0.5 depth steps: u / 2
        depth => (24, 0),
        -- s24.15: first differences, each word off by at most half a unit
        --   off by at most 0.19 depth steps: (1 + k) * u / 2
        depth_sum => (40, 15),
        -- u3.0: of a vector or token of the shading processors
        --   at most 7
        command => (3, 0),
        -- u5.0: a light's number from 1; 0 is the ambient light
        --   at most 16: lights
        light => (5, 0),
        -- s9.0: shadow volumes of a light: those around the eye, limited to 511; those opened at a pixel minus those closed, at most one for each object processor
        --   at most 511: 2^9 - 1
        shadow_count => (10, 0),
        -- u18.6: 1 / width of a spot's soft edge, in cosines: at least 1/2. The largest slope is 2^18, so that a cone of a tenth of a degree reaches its full light. The share is t^2 (3 - 2t), where t is the slope times the distance of the cosine from the edge. Its error is 6 t^2 (1 - t), at most 8/9, times the relative error of the slope
        --   off by at most 2^-7: u / 2
        --   share: off by at most 0.014 of the spot's light: 8 / 9 * u / 2 / (1 / 2)
        spot_slope => (24, 6),
        -- u18.0: up to the edge's height in subpixels: 16 per pixel from -2048 to 6143; subdivision does not double it
        --   at most 131056: (6143 + 2048) * 16
        edge_error => (18, 0),
        -- s13.0: an edge is a whole pixel and a remainder
        --   at most 4096: frame
        edge_x => (14, 0),
        -- s11.28: second differences; each word is off by at most half a unit. So is each sample; the weights of the six samples add up to at most 5/3. With samples up to 1023 the quadratic stays within +-2046
        --   off by at most 0.15 colour steps: (1 + k + k * (k - 1) / 2) * u / 2
        --   samples: off by at most 3.2e-09 colour steps: 5 / 3 * u / 2
        intensity => (40, 28),
        -- s10.22: half bells; start and slope are each off by at most half a unit, together a quarter of a 2^-9 cell; exponents up to 10^6 stay within +-1024
        --   off by at most 2^-11 half bells: (1 + pixels) * u / 2
        angle => (33, 22),
        -- u3.0: which table: cosine to the power 2^word
        --   at most 4
        power => (3, 0),
        -- s1.42: first differences, each word off by at most half a unit
        --   off by at most 0.4 steps of vector: (1 + k) * u / 2 / u_vector
        plane_sum => (44, 42),
        -- s1.28: interpolated N/w, view ray and 1/w, scaled so that the largest component is 1/2 to 1; plane_sum rounded
        --   off by at most 2^-29: u / 2
        vector => (30, 28),
        -- s1.22: components of unit vectors, rounded; an exponent m multiplies the error of a cosine by m. The error of the length: that of root, half that of a square of at least 1/4, and three rounded components. The error of the angle: a vector of at least 1/2 whose components are cut by half a unit (at most 3.1 halves across it), and rounding (1.8)
        --   component: off by at most 2^-23: u / 2
        --   length: off by at most 1.42e-06: 1.2 * 10^-6 + 2 * u_square + sqrt(3) * u / 2
        --   angle: off by at most 5.9e-07 radians: 4.9 * u / 2
        direction => (24, 22),
        -- s2.28: from a surface point to a light, before it is normalized: the light's position is rounded, the point's is cut
        --   off by at most 5.59e-09: (1 / 2 + 1) * u
        offset => (31, 28),
        -- s1.26: a light's direction, or its position divided by 2^light_shift
        --   off by at most 2^-27: u / 2
        light_place => (28, 26),
        -- u5.0: a light may be 2^31 times as far as the nearest surface
        --   at most 31
        light_shift => (5, 0),
        -- u2.28: square of a vector's length, 1/4 to 3; cut
        --   off by at most 2^-28: u
        square => (30, 28),
        -- u0.12: table of 1/sqrt(x), 512 entries: half a step, and half a cell of 2^-8 times the slope, 1/2 to 1
        --   off by at most 0.0011: u / 2 + 2^-8 / 2 / 2
        --   relative: off by at most 0.00115 of it: sqrt(2) * u / 2 + 2^-8 / 2 / 2
        root_entry => (12, 12),
        -- u1.23: after a Newton step from an entry with relative error r: too small by 3/2 r^2; raised by 17/2 units, cut by half a unit and by one unit (sqrt(2) of the result at x = 2, where r is largest)
        --   off by at most 1.2e-06 of it: 3 / 2 * 0.00115^2 - (17 - 1) / 2 * u + sqrt(2) * u
        root => (24, 23),
        -- u13.8: up to 8191; an error dn changes x^n by x^n ln(1/x) dn, at most dn/(e n)
        --   off by at most 2^-9: u / 2
        --   highlight: off by at most 0.0008 of a highlight's peak: u / 2 / e
        exponent => (21, 8),
        -- u1.16: a power of a cosine, or the share of a spot for slopes up to 2^12: t is cut by a unit and by 2^-28 of the slope, and the share changes by at most 3/2 of t; a diffuse term's cosine is rounded
        --   power: off by at most 0.00101: 2^-15 + m * 2^-23
        --   spot: off by at most 5.34e-05: 3 / 2 * (u + 2^12 * 2^-28) + u / 2
        --   diffuse: off by at most 2^-17: u / 2
        weight => (17, 16),
        -- u4.16: k of a material, up to 15
        --   off by at most 2^-17: u / 2
        coefficient => (20, 16),
        -- u14.4: colour steps, 64 times white
        --   off by at most 2^-5 colour steps: u / 2
        light_intensity => (18, 4),
        -- u14.8: k I in colour steps, rounded; clamped at 64 times white
        --   off by at most 2^-9 colour steps: u / 2
        reflected => (22, 8),
        -- u10.12: sum of the terms in colour steps, each cut except the ambient one; clamped at four times white
        --   off by at most 2^-7 colour steps: terms * u
        radiance => (22, 12),
        -- u16.8: colour steps; the largest factor times the smallest entry of 8 bits is white, so a larger factor would change nothing
        --   off by at most 2^-9 colour steps: u / 2
        factor => (24, 8)
      );
    end if;
    return (
      flag => (1, 0),
      triangle => (32, 0),
      pixel_x => (12, 0),
      pixel_y => (12, 0),
      lines => (13, 0),
      span_x => (14, 0),
      colour => (8, 0),
      depth => (24, 0),
      depth_sum => (40, 15),
      command => (3, 0),
      light => (5, 0),
      shadow_count => (10, 0),
      spot_slope => (24, 6),
      -- u0.0: edges are stepped by a real slope
      --   at most 0
      edge_error => (0, 0),
      -- s13.18: 32 bits, as the quadratic paper's other registers; start and slope each off by at most half a unit
      --   off by at most 2^-7 pixels: (1 + lines) * u / 2
      edge_x => (32, 18),
      -- s11.20: 32 bits with 20 fraction bits: the quadratic paper's figure 7; second differences, each word off by at most half a unit: 4 colour steps after 4095 steps. The error of edges between pixels is additional
      --   off by at most 16 colour steps: (1 + k_published + k_published * (k_published - 1) / 2) * u / 2
      --   samples: off by at most 8e-07 colour steps: 5 / 3 * u / 2
      intensity => (32, 20),
      -- s0.11: 12 bits, the upper 6 of them the address: the spherical paper's line interpolator. That it wraps at the bell's ends is our reading. Start and slope are each off by at most half a unit: 8 addresses after 1023 steps
      --   off by at most 1 half bells: (1 + pixels) * u / 2
      angle => (12, 11),
      -- u0.0: only cosine squared
      --   at most 0
      power => (0, 0),
      -- s1.26: first differences, each word off by at most half a unit
      --   off by at most 1.5 steps of vector: (1 + k) * u / 2 / u_vector
      plane_sum => (28, 26),
      -- s1.14: 16 bits: the processors paper's text gives no width; interpolated N and P, plane_sum rounded
      --   off by at most 2^-15: u / 2
      vector => (16, 14),
      -- s1.14: 16 bits, so that an N that is not normalized is not changed; otherwise as in preset exact, but vectors of at most 17 bits are cut, by a quarter of a unit
      --   component: off by at most 2^-15: u / 2
      --   length: off by at most 0.0094: 0.0092 + 2 * u_square + sqrt(3) * u / 2
      --   angle: off by at most 0.000102 radians: 3.3 * u / 2 * (1 + 0.0094)
      direction => (16, 14),
      -- s2.14: from a surface point to a light, before it is normalized; with the vector to the eye, a sum of three words below 2
      --   at most 4: (2 - u) + 1 + 1
      offset => (17, 14),
      -- s1.14: as vector
      --   off by at most 2^-15: u / 2
      light_place => (16, 14),
      -- u0.0: all positions have one scale
      --   at most 0
      light_shift => (0, 0),
      -- u2.14: square of a vector's length, 1/4 to 3; cut
      --   off by at most 2^-14: u
      square => (16, 14),
      -- u0.9: table of 1/sqrt(x), 64 entries: half a step, and half a cell of 2^-5 times the slope, 1/2 to 1
      --   off by at most 0.0088: u / 2 + 2^-5 / 2 / 2
      --   relative: off by at most 0.0092 of it: sqrt(2) * u / 2 + 2^-5 / 2 / 2
      root_entry => (9, 9),
      -- u0.9: the table's entry
      --   off by at most 0.0092 of it: sqrt(2) * u / 2 + 2^-5 / 2 / 2
      root => (9, 9),
      -- u10.0: integers up to 1023
      --   off by at most 0.5: u / 2
      --   highlight: off by at most 0.184 of a highlight's peak: u / 2 / e
      exponent => (10, 0),
      -- u1.8: a power of a cosine, or the share of a spot: next to 1 the middle of a cell of the logarithm and its rounding are off by 0.0062, so that an m-th power falls by e^(-m / 232); 2^-x, rounding and the cut of the product are additional. A diffuse term's cosine is rounded
      --   power: off by at most 1: 1 - e^(-m / 232) + 0.0074 + u / 2 + 2^-10
      --   spot: off by at most 2^-7: 3 / 2 * u + u / 2
      --   diffuse: off by at most 2^-9: u / 2
      weight => (9, 8),
      -- u1.7: an integer, in 1/128
      --   off by at most 2^-8: u / 2
      coefficient => (8, 7),
      -- u8.0: an integer, in colour steps
      --   off by at most 0.5 colour steps: u / 2
      light_intensity => (8, 0),
      -- u8.0: k I, an integer, rounded
      --   off by at most 0.5 colour steps: u / 2
      reflected => (8, 0),
      -- u8.0: an integer: each term except the ambient one is cut; clamped at white
      --   off by at most 32 colour steps: terms * u
      radiance => (8, 0),
      -- u10.8: colour steps up to 1023
      --   off by at most 2^-9 colour steps: u / 2
      factor => (18, 8)
    );
  end function;

  function init_header (exact : boolean) return init_header_t is
  begin
    if exact then
      return (
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
    end if;
    return (
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
  end function;

  function init_channel (exact : boolean) return init_channel_t is
  begin
    if exact then
      return (
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
    end if;
    return (
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
  end function;

  function init_bits (exact : boolean; channels : natural) return natural is
  begin
    if exact then
      return 480 + channels * 400;
    end if;
    return 305 + channels * 192;
  end function;

  function ambient_channel (exact : boolean) return ambient_channel_t is
  begin
    if exact then
      return (
        ambient => (23, 0)
      );
    end if;
    return (
      ambient => (17, 0)
    );
  end function;

  function ambient_bits (exact : boolean; channels : natural) return natural is
  begin
    if exact then
      return 0 + channels * 24;
    end if;
    return 0 + channels * 18;
  end function;

  function diffuse_header (exact : boolean) return diffuse_header_t is
  begin
    if exact then
      return (
        angle => (32, 0),
        slope => (65, 33)
      );
    end if;
    return (
      angle => (11, 0),
      slope => (23, 12)
    );
  end function;

  function diffuse_channel (exact : boolean) return diffuse_channel_t is
  begin
    if exact then
      return (
        factor => (23, 0)
      );
    end if;
    return (
      factor => (17, 0)
    );
  end function;

  function diffuse_bits (exact : boolean; channels : natural) return natural is
  begin
    if exact then
      return 66 + channels * 24;
    end if;
    return 24 + channels * 18;
  end function;

  function specular_header (exact : boolean) return specular_header_t is
  begin
    if exact then
      return (
        angle => (32, 0),
        slope => (65, 33),
        power => (68, 66)
      );
    end if;
    return (
      angle => (11, 0),
      slope => (23, 12),
      power => (-1, 0)
    );
  end function;

  function specular_channel (exact : boolean) return specular_channel_t is
  begin
    if exact then
      return (
        factor => (23, 0)
      );
    end if;
    return (
      factor => (17, 0)
    );
  end function;

  function specular_bits (exact : boolean; channels : natural) return natural is
  begin
    if exact then
      return 69 + channels * 24;
    end if;
    return 24 + channels * 18;
  end function;

  function request_header (exact : boolean) return request_header_t is
  begin
    return (
      command => (2, 0),
      light => (7, 3),
      opens => (8, 8),
      normalize => (9, 9)
    );
  end function;

  function request_bits (exact : boolean) return natural is
  begin
    return 10;
  end function;

  function plane_header (exact : boolean) return plane_header_t is
  begin
    if exact then
      return (
        value => (43, 0),
        dx => (87, 44),
        de0 => (131, 88),
        de1 => (175, 132)
      );
    end if;
    return (
      value => (27, 0),
      dx => (55, 28),
      de0 => (83, 56),
      de1 => (111, 84)
    );
  end function;

  function plane_bits (exact : boolean) return natural is
  begin
    if exact then
      return 176;
    end if;
    return 112;
  end function;

  function pixel_header (exact : boolean) return pixel_header_t is
  begin
    return (
      command => (2, 0),
      light => (7, 3),
      opens => (8, 8),
      normalize => (9, 9),
      triangle => (41, 10),
      y => (53, 42),
      x => (65, 54),
      z => (89, 66)
    );
  end function;

  function pixel_bits (exact : boolean) return natural is
  begin
    return 90;
  end function;

  function light_axes_header (exact : boolean) return light_axes_header_t is
  begin
    if exact then
      return (
        positional => (0, 0),
        spot => (1, 1),
        shift => (6, 2),
        outer => (30, 7),
        slope => (54, 31),
        around_eye => (64, 55)
      );
    end if;
    return (
      positional => (0, 0),
      spot => (1, 1),
      shift => (-1, 0),
      outer => (17, 2),
      slope => (41, 18),
      around_eye => (51, 42)
    );
  end function;

  function light_axes_channel (exact : boolean) return light_axes_channel_t is
  begin
    if exact then
      return (
        place => (27, 0),
        axis => (51, 28),
        half => (-1, 0)
      );
    end if;
    return (
      place => (15, 0),
      axis => (31, 16),
      half => (47, 32)
    );
  end function;

  function light_axes_bits (exact : boolean; channels : natural) return natural is
  begin
    if exact then
      return 65 + channels * 52;
    end if;
    return 52 + channels * 48;
  end function;

  function light_colour_channel (exact : boolean) return light_colour_channel_t is
  begin
    if exact then
      return (
        intensity => (17, 0)
      );
    end if;
    return (
      intensity => (7, 0)
    );
  end function;

  function light_colour_bits (exact : boolean; channels : natural) return natural is
  begin
    if exact then
      return 0 + channels * 18;
    end if;
    return 0 + channels * 8;
  end function;

end package body;
