// SPDX-License-Identifier: Apache-2.0
// Made by `make tables` from model/tables/formats.cpp; edit that.
// Number formats and the layouts of the flat vectors, for both presets.
// In bounds u is the format's unit, u_x that of format x. Frames have up to 4096 lines and pixels, so
// lines = pixels = 4095; steps = 8190: one pixel per line along the edge, then the span; k = lines + steps,
// k_published = lines + pixels. There are up to 16 lights with 32 terms; m is an exponent, e Euler's number.
#pragma once

#include <array>
#include <string_view>

namespace halfway::golden {

/// A named word in a flat vector, bit 0 first; in a channel's block `low` counts from the block's start.
struct Field {
  std::string_view name;
  int low, bits;
  bool is_signed;
  int fraction_bits;
};

struct Exact {
  static constexpr std::string_view c_name = "exact";
  // u1.0: one bit
  //   at most 1
  static constexpr int c_flag_bits = 1;
  static constexpr int c_flag_fraction_bits = 0;
  // u32.0: number of the scene's triangle, carried through as a tag
  //   at most 4294967295: 2^32 - 1
  static constexpr int c_triangle_bits = 32;
  static constexpr int c_triangle_fraction_bits = 0;
  // u12.0: frames up to 4096 pixels wide
  //   at most 4095: frame - 1
  static constexpr int c_pixel_x_bits = 12;
  static constexpr int c_pixel_x_fraction_bits = 0;
  // u12.0: frames up to 4096 lines high
  //   at most 4095: frame - 1
  static constexpr int c_pixel_y_bits = 12;
  static constexpr int c_pixel_y_fraction_bits = 0;
  // u13.0: 0 to 4096 lines
  //   at most 4096: frame
  static constexpr int c_lines_bits = 13;
  static constexpr int c_lines_fraction_bits = 0;
  // s13.0: -1 to 4096: a span's end is exclusive on either side
  //   at most 4096: frame
  static constexpr int c_span_x_bits = 14;
  static constexpr int c_span_x_fraction_bits = 0;
  // u8.0: stored in the frame: the sum before it, rounded once and clamped
  //   at most 255: 2^8 - 1
  //   rounded: off by at most 0.5 colour steps: u / 2
  static constexpr int c_colour_bits = 8;
  static constexpr int c_colour_fraction_bits = 0;
  // u24.0: compared by the depth test: the sum before it, rounded once
  //   at most 16777215: 2^24 - 1
  //   rounded: off by at most 0.5 depth steps: u / 2
  static constexpr int c_depth_bits = 24;
  static constexpr int c_depth_fraction_bits = 0;
  // s24.15: first differences, each word off by at most half a unit
  //   off by at most 0.19 depth steps: (1 + k) * u / 2
  static constexpr int c_depth_sum_bits = 40;
  static constexpr int c_depth_sum_fraction_bits = 15;
  // u3.0: of a vector or token of the shading processors
  //   at most 7
  static constexpr int c_command_bits = 3;
  static constexpr int c_command_fraction_bits = 0;
  // u5.0: a light's number from 1; 0 is the ambient light
  //   at most 16: lights
  static constexpr int c_light_bits = 5;
  static constexpr int c_light_fraction_bits = 0;
  // s9.0: shadow volumes opened minus those closed, clamped to -512 to 511
  //   at most 512: 2^9
  static constexpr int c_shadow_count_bits = 10;
  static constexpr int c_shadow_count_fraction_bits = 0;
  // u18.6: 1 / width of a spot's soft edge, in cosines: at least 1/2. The largest slope is 2^18, so that a cone of a tenth of a degree reaches its full light. The share is t^2 (3 - 2t), where t is the slope times the distance of the cosine from the edge. Its error is 6 t^2 (1 - t), at most 8/9, times the relative error of the slope
  //   off by at most 2^-7: u / 2
  //   share: off by at most 0.014 of the spot's light: 8 / 9 * u / 2 / (1 / 2)
  static constexpr int c_spot_slope_bits = 24;
  static constexpr int c_spot_slope_fraction_bits = 6;
  // u18.0: up to the edge's height in subpixels: 16 per pixel from -2048 to 6143; subdivision does not double it
  //   at most 131056: (6143 + 2048) * 16
  static constexpr int c_edge_error_bits = 18;
  static constexpr int c_edge_error_fraction_bits = 0;
  // s13.0: an edge is a whole pixel and a remainder
  //   at most 4096: frame
  static constexpr int c_edge_x_bits = 14;
  static constexpr int c_edge_x_fraction_bits = 0;
  // s11.28: second differences; each word is off by at most half a unit. So is each sample; the weights of the six samples add up to at most 5/3. With samples up to 1023 the quadratic stays within +-2046
  //   off by at most 0.15 colour steps: (1 + k + k * (k - 1) / 2) * u / 2
  //   samples: off by at most 3.2e-09 colour steps: 5 / 3 * u / 2
  static constexpr int c_intensity_bits = 40;
  static constexpr int c_intensity_fraction_bits = 28;
  // s10.22: half bells; start and slope are each off by at most half a unit, together a quarter of a 2^-9 cell; exponents up to 10^6 stay within +-1024
  //   off by at most 2^-11 half bells: (1 + pixels) * u / 2
  static constexpr int c_angle_bits = 33;
  static constexpr int c_angle_fraction_bits = 22;
  // u3.0: which table: cosine to the power 2^word
  //   at most 4
  static constexpr int c_power_bits = 3;
  static constexpr int c_power_fraction_bits = 0;
  // s1.42: first differences, each word off by at most half a unit
  //   off by at most 0.4 steps of vector: (1 + k) * u / 2 / u_vector
  static constexpr int c_plane_sum_bits = 44;
  static constexpr int c_plane_sum_fraction_bits = 42;
  // s1.28: interpolated N/w, view ray and 1/w, scaled so that the largest component is 1/2 to 1; plane_sum rounded
  //   off by at most 2^-29: u / 2
  static constexpr int c_vector_bits = 30;
  static constexpr int c_vector_fraction_bits = 28;
  // s1.22: components of unit vectors, rounded; an exponent m multiplies the error of a cosine by m. The error of the length: that of root, half that of a square of at least 1/4, and three rounded components. The error of the angle: a vector of at least 1/2 whose components are cut by half a unit (at most 3.1 halves across it), and rounding (1.8)
  //   component: off by at most 2^-23: u / 2
  //   length: off by at most 1.42e-06: 1.2 * 10^-6 + 2 * u_square + sqrt(3) * u / 2
  //   angle: off by at most 5.9e-07 radians: 4.9 * u / 2
  static constexpr int c_direction_bits = 24;
  static constexpr int c_direction_fraction_bits = 22;
  // s2.28: from a surface point to a light, before it is normalized: the light's position is rounded, the point's is cut
  //   off by at most 5.59e-09: (1 / 2 + 1) * u
  static constexpr int c_offset_bits = 31;
  static constexpr int c_offset_fraction_bits = 28;
  // s1.26: a light's direction, or its position divided by 2^light_shift
  //   off by at most 2^-27: u / 2
  static constexpr int c_light_place_bits = 28;
  static constexpr int c_light_place_fraction_bits = 26;
  // u5.0: a light may be 2^31 times as far as the nearest surface
  //   at most 31
  static constexpr int c_light_shift_bits = 5;
  static constexpr int c_light_shift_fraction_bits = 0;
  // u2.28: square of a vector's length, 1/4 to 3; cut
  //   off by at most 2^-28: u
  static constexpr int c_square_bits = 30;
  static constexpr int c_square_fraction_bits = 28;
  // u0.12: table of 1/sqrt(x), 512 entries: half a step, and half a cell of 2^-8 times the slope, 1/2 to 1
  //   off by at most 0.0011: u / 2 + 2^-8 / 2 / 2
  //   relative: off by at most 0.00115 of it: sqrt(2) * u / 2 + 2^-8 / 2 / 2
  static constexpr int c_root_entry_bits = 12;
  static constexpr int c_root_entry_fraction_bits = 12;
  // u1.23: after a Newton step from an entry with relative error r: too small by 3/2 r^2; raised by 17/2 units, cut by half a unit and by one unit (sqrt(2) of the result at x = 2, where r is largest)
  //   off by at most 1.2e-06 of it: 3 / 2 * 0.00115^2 - (17 - 1) / 2 * u + sqrt(2) * u
  static constexpr int c_root_bits = 24;
  static constexpr int c_root_fraction_bits = 23;
  // u13.8: up to 8191; an error dn changes x^n by x^n ln(1/x) dn, at most dn/(e n)
  //   off by at most 2^-9: u / 2
  //   highlight: off by at most 0.0008 of a highlight's peak: u / 2 / e
  static constexpr int c_exponent_bits = 21;
  static constexpr int c_exponent_fraction_bits = 8;
  // u1.16: a power of a cosine, or the share of a spot for slopes up to 2^12: t is cut by a unit and by 2^-28 of the slope, and the share changes by at most 3/2 of t; a diffuse term's cosine is rounded
  //   power: off by at most 0.00101: 2^-15 + m * 2^-23
  //   spot: off by at most 5.34e-05: 3 / 2 * (u + 2^12 * 2^-28) + u / 2
  //   diffuse: off by at most 2^-17: u / 2
  static constexpr int c_weight_bits = 17;
  static constexpr int c_weight_fraction_bits = 16;
  // u4.16: k of a material, up to 15
  //   off by at most 2^-17: u / 2
  static constexpr int c_coefficient_bits = 20;
  static constexpr int c_coefficient_fraction_bits = 16;
  // u14.4: colour steps, 64 times white
  //   off by at most 2^-5 colour steps: u / 2
  static constexpr int c_light_intensity_bits = 18;
  static constexpr int c_light_intensity_fraction_bits = 4;
  // u14.8: k I in colour steps, rounded; clamped at 64 times white
  //   off by at most 2^-9 colour steps: u / 2
  static constexpr int c_reflected_bits = 22;
  static constexpr int c_reflected_fraction_bits = 8;
  // u10.12: sum of the terms in colour steps, each cut except the ambient one; clamped at four times white
  //   off by at most 2^-7 colour steps: terms * u
  static constexpr int c_radiance_bits = 22;
  static constexpr int c_radiance_fraction_bits = 12;
  // u16.8: colour steps; the largest factor times the smallest entry of 8 bits is white, so a larger factor would change nothing
  //   off by at most 2^-9 colour steps: u / 2
  static constexpr int c_factor_bits = 24;
  static constexpr int c_factor_fraction_bits = 8;

  static constexpr int c_init_header_bits = 480;
  static constexpr std::array<Field, 27> c_init_header = {{
      {"triangle", 0, 32, false, 0},
      {"y", 32, 12, false, 0},
      {"upper_lines", 44, 13, false, 0},
      {"lower_lines", 57, 13, false, 0},
      {"backward", 70, 1, false, 0},
      {"start_x", 71, 14, true, 0},
      {"start_quotient", 85, 14, true, 0},
      {"start_remainder", 99, 18, false, 0},
      {"start_divisor", 117, 18, false, 0},
      {"start_error", 135, 18, false, 0},
      {"start_carry", 153, 1, false, 0},
      {"upper_x", 154, 14, true, 0},
      {"upper_quotient", 168, 14, true, 0},
      {"upper_remainder", 182, 18, false, 0},
      {"upper_divisor", 200, 18, false, 0},
      {"upper_error", 218, 18, false, 0},
      {"upper_carry", 236, 1, false, 0},
      {"lower_x", 237, 14, true, 0},
      {"lower_quotient", 251, 14, true, 0},
      {"lower_remainder", 265, 18, false, 0},
      {"lower_divisor", 283, 18, false, 0},
      {"lower_error", 301, 18, false, 0},
      {"lower_carry", 319, 1, false, 0},
      {"z", 320, 40, true, 15},
      {"z_dx", 360, 40, true, 15},
      {"z_de0", 400, 40, true, 15},
      {"z_de1", 440, 40, true, 15},
  }};
  struct init_header_at {
    static constexpr const Field& triangle = c_init_header[0];
    static constexpr const Field& y = c_init_header[1];
    static constexpr const Field& upper_lines = c_init_header[2];
    static constexpr const Field& lower_lines = c_init_header[3];
    static constexpr const Field& backward = c_init_header[4];
    static constexpr const Field& start_x = c_init_header[5];
    static constexpr const Field& start_quotient = c_init_header[6];
    static constexpr const Field& start_remainder = c_init_header[7];
    static constexpr const Field& start_divisor = c_init_header[8];
    static constexpr const Field& start_error = c_init_header[9];
    static constexpr const Field& start_carry = c_init_header[10];
    static constexpr const Field& upper_x = c_init_header[11];
    static constexpr const Field& upper_quotient = c_init_header[12];
    static constexpr const Field& upper_remainder = c_init_header[13];
    static constexpr const Field& upper_divisor = c_init_header[14];
    static constexpr const Field& upper_error = c_init_header[15];
    static constexpr const Field& upper_carry = c_init_header[16];
    static constexpr const Field& lower_x = c_init_header[17];
    static constexpr const Field& lower_quotient = c_init_header[18];
    static constexpr const Field& lower_remainder = c_init_header[19];
    static constexpr const Field& lower_divisor = c_init_header[20];
    static constexpr const Field& lower_error = c_init_header[21];
    static constexpr const Field& lower_carry = c_init_header[22];
    static constexpr const Field& z = c_init_header[23];
    static constexpr const Field& z_dx = c_init_header[24];
    static constexpr const Field& z_de0 = c_init_header[25];
    static constexpr const Field& z_de1 = c_init_header[26];
  };

  static constexpr int c_init_channel_bits = 400;
  static constexpr std::array<Field, 10> c_init_channel = {{
      {"value", 0, 40, true, 28},
      {"dx", 40, 40, true, 28},
      {"de0", 80, 40, true, 28},
      {"de1", 120, 40, true, 28},
      {"dxx", 160, 40, true, 28},
      {"dxe0", 200, 40, true, 28},
      {"dxe1", 240, 40, true, 28},
      {"de0e0", 280, 40, true, 28},
      {"de0e1", 320, 40, true, 28},
      {"de1e1", 360, 40, true, 28},
  }};
  struct init_channel_at {
    static constexpr const Field& value = c_init_channel[0];
    static constexpr const Field& dx = c_init_channel[1];
    static constexpr const Field& de0 = c_init_channel[2];
    static constexpr const Field& de1 = c_init_channel[3];
    static constexpr const Field& dxx = c_init_channel[4];
    static constexpr const Field& dxe0 = c_init_channel[5];
    static constexpr const Field& dxe1 = c_init_channel[6];
    static constexpr const Field& de0e0 = c_init_channel[7];
    static constexpr const Field& de0e1 = c_init_channel[8];
    static constexpr const Field& de1e1 = c_init_channel[9];
  };

  static constexpr int c_ambient_header_bits = 0;

  static constexpr int c_ambient_channel_bits = 24;
  static constexpr std::array<Field, 1> c_ambient_channel = {{
      {"ambient", 0, 24, false, 8},
  }};
  struct ambient_channel_at {
    static constexpr const Field& ambient = c_ambient_channel[0];
  };

  static constexpr int c_diffuse_header_bits = 66;
  static constexpr std::array<Field, 2> c_diffuse_header = {{
      {"angle", 0, 33, true, 22},
      {"slope", 33, 33, true, 22},
  }};
  struct diffuse_header_at {
    static constexpr const Field& angle = c_diffuse_header[0];
    static constexpr const Field& slope = c_diffuse_header[1];
  };

  static constexpr int c_diffuse_channel_bits = 24;
  static constexpr std::array<Field, 1> c_diffuse_channel = {{
      {"factor", 0, 24, false, 8},
  }};
  struct diffuse_channel_at {
    static constexpr const Field& factor = c_diffuse_channel[0];
  };

  static constexpr int c_specular_header_bits = 69;
  static constexpr std::array<Field, 3> c_specular_header = {{
      {"angle", 0, 33, true, 22},
      {"slope", 33, 33, true, 22},
      {"power", 66, 3, false, 0},
  }};
  struct specular_header_at {
    static constexpr const Field& angle = c_specular_header[0];
    static constexpr const Field& slope = c_specular_header[1];
    static constexpr const Field& power = c_specular_header[2];
  };

  static constexpr int c_specular_channel_bits = 24;
  static constexpr std::array<Field, 1> c_specular_channel = {{
      {"factor", 0, 24, false, 8},
  }};
  struct specular_channel_at {
    static constexpr const Field& factor = c_specular_channel[0];
  };

  static constexpr int c_request_header_bits = 10;
  static constexpr std::array<Field, 4> c_request_header = {{
      {"command", 0, 3, false, 0},
      {"light", 3, 5, false, 0},
      {"opens", 8, 1, false, 0},
      {"normalize", 9, 1, false, 0},
  }};
  struct request_header_at {
    static constexpr const Field& command = c_request_header[0];
    static constexpr const Field& light = c_request_header[1];
    static constexpr const Field& opens = c_request_header[2];
    static constexpr const Field& normalize = c_request_header[3];
  };

  static constexpr int c_request_channel_bits = 0;

  static constexpr int c_plane_header_bits = 176;
  static constexpr std::array<Field, 4> c_plane_header = {{
      {"value", 0, 44, true, 42},
      {"dx", 44, 44, true, 42},
      {"de0", 88, 44, true, 42},
      {"de1", 132, 44, true, 42},
  }};
  struct plane_header_at {
    static constexpr const Field& value = c_plane_header[0];
    static constexpr const Field& dx = c_plane_header[1];
    static constexpr const Field& de0 = c_plane_header[2];
    static constexpr const Field& de1 = c_plane_header[3];
  };

  static constexpr int c_plane_channel_bits = 0;

  static constexpr int c_pixel_header_bits = 90;
  static constexpr std::array<Field, 8> c_pixel_header = {{
      {"command", 0, 3, false, 0},
      {"light", 3, 5, false, 0},
      {"opens", 8, 1, false, 0},
      {"normalize", 9, 1, false, 0},
      {"triangle", 10, 32, false, 0},
      {"y", 42, 12, false, 0},
      {"x", 54, 12, false, 0},
      {"z", 66, 24, false, 0},
  }};
  struct pixel_header_at {
    static constexpr const Field& command = c_pixel_header[0];
    static constexpr const Field& light = c_pixel_header[1];
    static constexpr const Field& opens = c_pixel_header[2];
    static constexpr const Field& normalize = c_pixel_header[3];
    static constexpr const Field& triangle = c_pixel_header[4];
    static constexpr const Field& y = c_pixel_header[5];
    static constexpr const Field& x = c_pixel_header[6];
    static constexpr const Field& z = c_pixel_header[7];
  };

  static constexpr int c_pixel_channel_bits = 0;

  static constexpr int c_light_axes_header_bits = 65;
  static constexpr std::array<Field, 6> c_light_axes_header = {{
      {"positional", 0, 1, false, 0},
      {"spot", 1, 1, false, 0},
      {"shift", 2, 5, false, 0},
      {"outer", 7, 24, true, 22},
      {"slope", 31, 24, false, 6},
      {"around_eye", 55, 10, true, 0},
  }};
  struct light_axes_header_at {
    static constexpr const Field& positional = c_light_axes_header[0];
    static constexpr const Field& spot = c_light_axes_header[1];
    static constexpr const Field& shift = c_light_axes_header[2];
    static constexpr const Field& outer = c_light_axes_header[3];
    static constexpr const Field& slope = c_light_axes_header[4];
    static constexpr const Field& around_eye = c_light_axes_header[5];
  };

  static constexpr int c_light_axes_channel_bits = 52;
  static constexpr std::array<Field, 2> c_light_axes_channel = {{
      {"place", 0, 28, true, 26},
      {"axis", 28, 24, true, 22},
  }};
  struct light_axes_channel_at {
    static constexpr const Field& place = c_light_axes_channel[0];
    static constexpr const Field& axis = c_light_axes_channel[1];
  };

  static constexpr int c_light_colour_header_bits = 0;

  static constexpr int c_light_colour_channel_bits = 18;
  static constexpr std::array<Field, 1> c_light_colour_channel = {{
      {"intensity", 0, 18, false, 4},
  }};
  struct light_colour_channel_at {
    static constexpr const Field& intensity = c_light_colour_channel[0];
  };
};

struct Published {
  static constexpr std::string_view c_name = "published";
  // u1.0: one bit
  //   at most 1
  static constexpr int c_flag_bits = 1;
  static constexpr int c_flag_fraction_bits = 0;
  // u32.0: number of the scene's triangle, carried through as a tag
  //   at most 4294967295: 2^32 - 1
  static constexpr int c_triangle_bits = 32;
  static constexpr int c_triangle_fraction_bits = 0;
  // u12.0: frames up to 4096 pixels wide
  //   at most 4095: frame - 1
  static constexpr int c_pixel_x_bits = 12;
  static constexpr int c_pixel_x_fraction_bits = 0;
  // u12.0: frames up to 4096 lines high
  //   at most 4095: frame - 1
  static constexpr int c_pixel_y_bits = 12;
  static constexpr int c_pixel_y_fraction_bits = 0;
  // u13.0: 0 to 4096 lines
  //   at most 4096: frame
  static constexpr int c_lines_bits = 13;
  static constexpr int c_lines_fraction_bits = 0;
  // s13.0: -1 to 4096: a span's end is exclusive on either side
  //   at most 4096: frame
  static constexpr int c_span_x_bits = 14;
  static constexpr int c_span_x_fraction_bits = 0;
  // u8.0: stored in the frame: the sum before it, rounded once and clamped
  //   at most 255: 2^8 - 1
  //   rounded: off by at most 0.5 colour steps: u / 2
  static constexpr int c_colour_bits = 8;
  static constexpr int c_colour_fraction_bits = 0;
  // u24.0: compared by the depth test: the sum before it, rounded once
  //   at most 16777215: 2^24 - 1
  //   rounded: off by at most 0.5 depth steps: u / 2
  static constexpr int c_depth_bits = 24;
  static constexpr int c_depth_fraction_bits = 0;
  // s24.15: first differences, each word off by at most half a unit
  //   off by at most 0.19 depth steps: (1 + k) * u / 2
  static constexpr int c_depth_sum_bits = 40;
  static constexpr int c_depth_sum_fraction_bits = 15;
  // u3.0: of a vector or token of the shading processors
  //   at most 7
  static constexpr int c_command_bits = 3;
  static constexpr int c_command_fraction_bits = 0;
  // u5.0: a light's number from 1; 0 is the ambient light
  //   at most 16: lights
  static constexpr int c_light_bits = 5;
  static constexpr int c_light_fraction_bits = 0;
  // s9.0: shadow volumes opened minus those closed, clamped to -512 to 511
  //   at most 512: 2^9
  static constexpr int c_shadow_count_bits = 10;
  static constexpr int c_shadow_count_fraction_bits = 0;
  // u18.6: 1 / width of a spot's soft edge, in cosines: at least 1/2. The largest slope is 2^18, so that a cone of a tenth of a degree reaches its full light. The share is t^2 (3 - 2t), where t is the slope times the distance of the cosine from the edge. Its error is 6 t^2 (1 - t), at most 8/9, times the relative error of the slope
  //   off by at most 2^-7: u / 2
  //   share: off by at most 0.014 of the spot's light: 8 / 9 * u / 2 / (1 / 2)
  static constexpr int c_spot_slope_bits = 24;
  static constexpr int c_spot_slope_fraction_bits = 6;
  // u0.0: edges are stepped by a real slope
  //   at most 0
  static constexpr int c_edge_error_bits = 0;
  static constexpr int c_edge_error_fraction_bits = 0;
  // s13.18: 32 bits, as the quadratic paper's other registers; start and slope each off by at most half a unit
  //   off by at most 2^-7 pixels: (1 + lines) * u / 2
  static constexpr int c_edge_x_bits = 32;
  static constexpr int c_edge_x_fraction_bits = 18;
  // s11.20: 32 bits with 20 fraction bits: the quadratic paper's figure 7; second differences, each word off by at most half a unit: 4 colour steps after 4095 steps. The error of edges between pixels is additional
  //   off by at most 16 colour steps: (1 + k_published + k_published * (k_published - 1) / 2) * u / 2
  //   samples: off by at most 8e-07 colour steps: 5 / 3 * u / 2
  static constexpr int c_intensity_bits = 32;
  static constexpr int c_intensity_fraction_bits = 20;
  // s0.11: 12 bits, the upper 6 of them the address: the spherical paper's line interpolator. That it wraps at the bell's ends is our reading. Start and slope are each off by at most half a unit: 8 addresses after 1023 steps
  //   off by at most 1 half bells: (1 + pixels) * u / 2
  static constexpr int c_angle_bits = 12;
  static constexpr int c_angle_fraction_bits = 11;
  // u0.0: only cosine squared
  //   at most 0
  static constexpr int c_power_bits = 0;
  static constexpr int c_power_fraction_bits = 0;
  // s1.26: first differences, each word off by at most half a unit
  //   off by at most 1.5 steps of vector: (1 + k) * u / 2 / u_vector
  static constexpr int c_plane_sum_bits = 28;
  static constexpr int c_plane_sum_fraction_bits = 26;
  // s1.14: 16 bits: the processors paper's text gives no width; interpolated N and P, plane_sum rounded
  //   off by at most 2^-15: u / 2
  static constexpr int c_vector_bits = 16;
  static constexpr int c_vector_fraction_bits = 14;
  // s1.14: 16 bits, so that an N that is not normalized is not changed; otherwise as in preset exact, but vectors of at most 17 bits are cut, by a quarter of a unit
  //   component: off by at most 2^-15: u / 2
  //   length: off by at most 0.0094: 0.0092 + 2 * u_square + sqrt(3) * u / 2
  //   angle: off by at most 0.000102 radians: 3.3 * u / 2 * (1 + 0.0094)
  static constexpr int c_direction_bits = 16;
  static constexpr int c_direction_fraction_bits = 14;
  // s2.14: from a surface point to a light, before it is normalized; with the vector to the eye, a sum of three words below 2
  //   at most 4: (2 - u) + 1 + 1
  static constexpr int c_offset_bits = 17;
  static constexpr int c_offset_fraction_bits = 14;
  // s1.14: as vector
  //   off by at most 2^-15: u / 2
  static constexpr int c_light_place_bits = 16;
  static constexpr int c_light_place_fraction_bits = 14;
  // u0.0: all positions have one scale
  //   at most 0
  static constexpr int c_light_shift_bits = 0;
  static constexpr int c_light_shift_fraction_bits = 0;
  // u2.14: square of a vector's length, 1/4 to 3; cut
  //   off by at most 2^-14: u
  static constexpr int c_square_bits = 16;
  static constexpr int c_square_fraction_bits = 14;
  // u0.9: table of 1/sqrt(x), 64 entries: half a step, and half a cell of 2^-5 times the slope, 1/2 to 1
  //   off by at most 0.0088: u / 2 + 2^-5 / 2 / 2
  //   relative: off by at most 0.0092 of it: sqrt(2) * u / 2 + 2^-5 / 2 / 2
  static constexpr int c_root_entry_bits = 9;
  static constexpr int c_root_entry_fraction_bits = 9;
  // u0.9: the table's entry
  //   off by at most 0.0092 of it: sqrt(2) * u / 2 + 2^-5 / 2 / 2
  static constexpr int c_root_bits = 9;
  static constexpr int c_root_fraction_bits = 9;
  // u10.0: integers up to 1023
  //   off by at most 0.5: u / 2
  //   highlight: off by at most 0.184 of a highlight's peak: u / 2 / e
  static constexpr int c_exponent_bits = 10;
  static constexpr int c_exponent_fraction_bits = 0;
  // u1.8: a power of a cosine, or the share of a spot: next to 1 the middle of a cell of the logarithm and its rounding are off by 0.0062, so that an m-th power falls by e^(-m / 232); 2^-x, rounding and the cut of the product are additional. A diffuse term's cosine is rounded
  //   power: off by at most 1: 1 - e^(-m / 232) + 0.0074 + u / 2 + 2^-10
  //   spot: off by at most 2^-7: 3 / 2 * u + u / 2
  //   diffuse: off by at most 2^-9: u / 2
  static constexpr int c_weight_bits = 9;
  static constexpr int c_weight_fraction_bits = 8;
  // u1.7: an integer, in 1/128
  //   off by at most 2^-8: u / 2
  static constexpr int c_coefficient_bits = 8;
  static constexpr int c_coefficient_fraction_bits = 7;
  // u8.0: an integer, in colour steps
  //   off by at most 0.5 colour steps: u / 2
  static constexpr int c_light_intensity_bits = 8;
  static constexpr int c_light_intensity_fraction_bits = 0;
  // u8.0: k I, an integer, rounded
  //   off by at most 0.5 colour steps: u / 2
  static constexpr int c_reflected_bits = 8;
  static constexpr int c_reflected_fraction_bits = 0;
  // u8.0: an integer: each term except the ambient one is cut; clamped at white
  //   off by at most 32 colour steps: terms * u
  static constexpr int c_radiance_bits = 8;
  static constexpr int c_radiance_fraction_bits = 0;
  // u10.8: colour steps up to 1023
  //   off by at most 2^-9 colour steps: u / 2
  static constexpr int c_factor_bits = 18;
  static constexpr int c_factor_fraction_bits = 8;

  static constexpr int c_init_header_bits = 305;
  static constexpr std::array<Field, 10> c_init_header = {{
      {"triangle", 0, 32, false, 0},
      {"y", 32, 12, false, 0},
      {"upper_lines", 44, 13, false, 0},
      {"start_x", 57, 32, true, 18},
      {"start_slope", 89, 32, true, 18},
      {"upper_x", 121, 32, true, 18},
      {"upper_slope", 153, 32, true, 18},
      {"z", 185, 40, true, 15},
      {"z_dx", 225, 40, true, 15},
      {"z_de0", 265, 40, true, 15},
  }};
  struct init_header_at {
    static constexpr const Field& triangle = c_init_header[0];
    static constexpr const Field& y = c_init_header[1];
    static constexpr const Field& upper_lines = c_init_header[2];
    static constexpr const Field& start_x = c_init_header[3];
    static constexpr const Field& start_slope = c_init_header[4];
    static constexpr const Field& upper_x = c_init_header[5];
    static constexpr const Field& upper_slope = c_init_header[6];
    static constexpr const Field& z = c_init_header[7];
    static constexpr const Field& z_dx = c_init_header[8];
    static constexpr const Field& z_de0 = c_init_header[9];
  };

  static constexpr int c_init_channel_bits = 192;
  static constexpr std::array<Field, 6> c_init_channel = {{
      {"value", 0, 32, true, 20},
      {"dx", 32, 32, true, 20},
      {"de0", 64, 32, true, 20},
      {"dxx", 96, 32, true, 20},
      {"dxe0", 128, 32, true, 20},
      {"de0e0", 160, 32, true, 20},
  }};
  struct init_channel_at {
    static constexpr const Field& value = c_init_channel[0];
    static constexpr const Field& dx = c_init_channel[1];
    static constexpr const Field& de0 = c_init_channel[2];
    static constexpr const Field& dxx = c_init_channel[3];
    static constexpr const Field& dxe0 = c_init_channel[4];
    static constexpr const Field& de0e0 = c_init_channel[5];
  };

  static constexpr int c_ambient_header_bits = 0;

  static constexpr int c_ambient_channel_bits = 18;
  static constexpr std::array<Field, 1> c_ambient_channel = {{
      {"ambient", 0, 18, false, 8},
  }};
  struct ambient_channel_at {
    static constexpr const Field& ambient = c_ambient_channel[0];
  };

  static constexpr int c_diffuse_header_bits = 24;
  static constexpr std::array<Field, 2> c_diffuse_header = {{
      {"angle", 0, 12, true, 11},
      {"slope", 12, 12, true, 11},
  }};
  struct diffuse_header_at {
    static constexpr const Field& angle = c_diffuse_header[0];
    static constexpr const Field& slope = c_diffuse_header[1];
  };

  static constexpr int c_diffuse_channel_bits = 18;
  static constexpr std::array<Field, 1> c_diffuse_channel = {{
      {"factor", 0, 18, false, 8},
  }};
  struct diffuse_channel_at {
    static constexpr const Field& factor = c_diffuse_channel[0];
  };

  static constexpr int c_specular_header_bits = 24;
  static constexpr std::array<Field, 2> c_specular_header = {{
      {"angle", 0, 12, true, 11},
      {"slope", 12, 12, true, 11},
  }};
  struct specular_header_at {
    static constexpr const Field& angle = c_specular_header[0];
    static constexpr const Field& slope = c_specular_header[1];
  };

  static constexpr int c_specular_channel_bits = 18;
  static constexpr std::array<Field, 1> c_specular_channel = {{
      {"factor", 0, 18, false, 8},
  }};
  struct specular_channel_at {
    static constexpr const Field& factor = c_specular_channel[0];
  };

  static constexpr int c_request_header_bits = 10;
  static constexpr std::array<Field, 4> c_request_header = {{
      {"command", 0, 3, false, 0},
      {"light", 3, 5, false, 0},
      {"opens", 8, 1, false, 0},
      {"normalize", 9, 1, false, 0},
  }};
  struct request_header_at {
    static constexpr const Field& command = c_request_header[0];
    static constexpr const Field& light = c_request_header[1];
    static constexpr const Field& opens = c_request_header[2];
    static constexpr const Field& normalize = c_request_header[3];
  };

  static constexpr int c_request_channel_bits = 0;

  static constexpr int c_plane_header_bits = 112;
  static constexpr std::array<Field, 4> c_plane_header = {{
      {"value", 0, 28, true, 26},
      {"dx", 28, 28, true, 26},
      {"de0", 56, 28, true, 26},
      {"de1", 84, 28, true, 26},
  }};
  struct plane_header_at {
    static constexpr const Field& value = c_plane_header[0];
    static constexpr const Field& dx = c_plane_header[1];
    static constexpr const Field& de0 = c_plane_header[2];
    static constexpr const Field& de1 = c_plane_header[3];
  };

  static constexpr int c_plane_channel_bits = 0;

  static constexpr int c_pixel_header_bits = 90;
  static constexpr std::array<Field, 8> c_pixel_header = {{
      {"command", 0, 3, false, 0},
      {"light", 3, 5, false, 0},
      {"opens", 8, 1, false, 0},
      {"normalize", 9, 1, false, 0},
      {"triangle", 10, 32, false, 0},
      {"y", 42, 12, false, 0},
      {"x", 54, 12, false, 0},
      {"z", 66, 24, false, 0},
  }};
  struct pixel_header_at {
    static constexpr const Field& command = c_pixel_header[0];
    static constexpr const Field& light = c_pixel_header[1];
    static constexpr const Field& opens = c_pixel_header[2];
    static constexpr const Field& normalize = c_pixel_header[3];
    static constexpr const Field& triangle = c_pixel_header[4];
    static constexpr const Field& y = c_pixel_header[5];
    static constexpr const Field& x = c_pixel_header[6];
    static constexpr const Field& z = c_pixel_header[7];
  };

  static constexpr int c_pixel_channel_bits = 0;

  static constexpr int c_light_axes_header_bits = 52;
  static constexpr std::array<Field, 5> c_light_axes_header = {{
      {"positional", 0, 1, false, 0},
      {"spot", 1, 1, false, 0},
      {"outer", 2, 16, true, 14},
      {"slope", 18, 24, false, 6},
      {"around_eye", 42, 10, true, 0},
  }};
  struct light_axes_header_at {
    static constexpr const Field& positional = c_light_axes_header[0];
    static constexpr const Field& spot = c_light_axes_header[1];
    static constexpr const Field& outer = c_light_axes_header[2];
    static constexpr const Field& slope = c_light_axes_header[3];
    static constexpr const Field& around_eye = c_light_axes_header[4];
  };

  static constexpr int c_light_axes_channel_bits = 48;
  static constexpr std::array<Field, 3> c_light_axes_channel = {{
      {"place", 0, 16, true, 14},
      {"axis", 16, 16, true, 14},
      {"half", 32, 16, true, 14},
  }};
  struct light_axes_channel_at {
    static constexpr const Field& place = c_light_axes_channel[0];
    static constexpr const Field& axis = c_light_axes_channel[1];
    static constexpr const Field& half = c_light_axes_channel[2];
  };

  static constexpr int c_light_colour_header_bits = 0;

  static constexpr int c_light_colour_channel_bits = 8;
  static constexpr std::array<Field, 1> c_light_colour_channel = {{
      {"intensity", 0, 8, false, 0},
  }};
  struct light_colour_channel_at {
    static constexpr const Field& intensity = c_light_colour_channel[0];
  };
};

}  // namespace halfway::golden
