// SPDX-License-Identifier: Apache-2.0
// Writes stimulus and expected results for each testbench, from the golden model. `folder` belongs to the
// entity.
#pragma once

#include <filesystem>

#include "common/result.hpp"

namespace halfway::vectors {

Status write_cosine_rom(const std::filesystem::path& folder);
Status write_saturate(const std::filesystem::path& folder);
Status write_multiplier(const std::filesystem::path& folder);
Status write_angle_address(const std::filesystem::path& folder);
Status write_saturating_sum(const std::filesystem::path& folder);
Status write_parameter_register(const std::filesystem::path& folder);
Status write_stream_register(const std::filesystem::path& folder);
Status write_stream_queue(const std::filesystem::path& folder);
Status write_fragment_pixel(const std::filesystem::path& folder);
Status write_scan_out(const std::filesystem::path& folder);
Status write_drawing_rate(const std::filesystem::path& folder);
Status write_function_rom(const std::filesystem::path& folder);
Status write_dot_product(const std::filesystem::path& folder);
Status write_vector_multiply(const std::filesystem::path& folder);
Status write_vector_shift(const std::filesystem::path& folder);
Status write_unit_vector(const std::filesystem::path& folder);
Status write_reciprocal_root(const std::filesystem::path& folder);
Status write_power(const std::filesystem::path& folder);
Status write_spot_cone(const std::filesystem::path& folder);
Status write_delay_line(const std::filesystem::path& folder);
Status write_shading_pkg(const std::filesystem::path& folder);
Status write_line_interpolator(const std::filesystem::path& folder);
Status write_part_interpolator(const std::filesystem::path& folder);
Status write_skewed_strobe(const std::filesystem::path& folder);
Status write_skewed_register(const std::filesystem::path& folder);
Status write_skewed_multiplexer(const std::filesystem::path& folder);
Status write_deskew(const std::filesystem::path& folder);
Status write_skewed_interpolator(const std::filesystem::path& folder);
Status write_plane_interpolator(const std::filesystem::path& folder);
Status write_z_interpolator(const std::filesystem::path& folder);
Status write_quadratic_interpolator(const std::filesystem::path& folder);
Status write_edge_walker(const std::filesystem::path& folder);
Status write_slope_walker(const std::filesystem::path& folder);
Status write_line_counter(const std::filesystem::path& folder);
Status write_edge_pair(const std::filesystem::path& folder);
Status write_line_stage(const std::filesystem::path& folder);
Status write_span_stage(const std::filesystem::path& folder);
Status write_object_stage(const std::filesystem::path& folder);
Status write_triangle_walker(const std::filesystem::path& folder);
Status write_diffuse_slice(const std::filesystem::path& folder);
Status write_specular_slice(const std::filesystem::path& folder);
Status write_spherical_light(const std::filesystem::path& folder);
Status write_ambient_light(const std::filesystem::path& folder);
Status write_colour_sum(const std::filesystem::path& folder);
Status write_shadow_counter(const std::filesystem::path& folder);
Status write_light_vector(const std::filesystem::path& folder);
Status write_half_vector(const std::filesystem::path& folder);
Status write_cosine_power(const std::filesystem::path& folder);
Status write_light_weight(const std::filesystem::path& folder);
Status write_reflected_term(const std::filesystem::path& folder);
Status write_radiance_sum(const std::filesystem::path& folder);
Status write_ambient_term(const std::filesystem::path& folder);
Status write_light_term(const std::filesystem::path& folder);
Status write_light_state(const std::filesystem::path& folder);
Status write_shading_sequence(const std::filesystem::path& folder);
Status write_token_register(const std::filesystem::path& folder);
Status write_shared_adder(const std::filesystem::path& folder);
Status write_shared_dot_product(const std::filesystem::path& folder);
Status write_shared_multiplier(const std::filesystem::path& folder);
Status write_shared_normalizer(const std::filesystem::path& folder);
Status write_shared_weight(const std::filesystem::path& folder);
Status write_shading_processor(const std::filesystem::path& folder);
Status write_shading_pipeline(const std::filesystem::path& folder);
Status write_quadratic_shader(const std::filesystem::path& folder);
Status write_spherical_shader(const std::filesystem::path& folder);
Status write_token_rasterizer(const std::filesystem::path& folder);
Status write_token_order(const std::filesystem::path& folder);
Status write_fragment_output(const std::filesystem::path& folder);
Status write_processors_shader(const std::filesystem::path& folder);

}  // namespace halfway::vectors
