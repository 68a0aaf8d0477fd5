// SPDX-License-Identifier: Apache-2.0
// halfway_vectors ENTITY|all FOLDER: writes FOLDER/ENTITY/*.txt for tb/**/ENTITY_tb.vhd.
#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <string_view>
#include <utility>

#include "sim/stream_files/table4.hpp"
#include "vectors/entities.hpp"

int main(int argc, char** argv) {
  using namespace halfway;
  using namespace halfway::vectors;
  constexpr std::array c_entities = {
      std::pair{"cosine_rom", &write_cosine_rom},
      std::pair{"saturate", &write_saturate},
      std::pair{"multiplier", &write_multiplier},
      std::pair{"angle_address", &write_angle_address},
      std::pair{"saturating_sum", &write_saturating_sum},
      std::pair{"parameter_register", &write_parameter_register},
      std::pair{"stream_register", &write_stream_register},
      std::pair{"stream_queue", &write_stream_queue},
      std::pair{"function_rom", &write_function_rom},
      std::pair{"dot_product", &write_dot_product},
      std::pair{"vector_multiply", &write_vector_multiply},
      std::pair{"vector_shift", &write_vector_shift},
      std::pair{"unit_vector", &write_unit_vector},
      std::pair{"reciprocal_root", &write_reciprocal_root},
      std::pair{"power", &write_power},
      std::pair{"spot_cone", &write_spot_cone},
      std::pair{"delay_line", &write_delay_line},
      std::pair{"shading_pkg", &write_shading_pkg},
      std::pair{"line_interpolator", &write_line_interpolator},
      std::pair{"part_interpolator", &write_part_interpolator},
      std::pair{"skewed_strobe", &write_skewed_strobe},
      std::pair{"skewed_register", &write_skewed_register},
      std::pair{"skewed_multiplexer", &write_skewed_multiplexer},
      std::pair{"deskew", &write_deskew},
      std::pair{"skewed_interpolator", &write_skewed_interpolator},
      std::pair{"plane_interpolator", &write_plane_interpolator},
      std::pair{"z_interpolator", &write_z_interpolator},
      std::pair{"quadratic_interpolator", &write_quadratic_interpolator},
      std::pair{"edge_walker", &write_edge_walker},
      std::pair{"slope_walker", &write_slope_walker},
      std::pair{"object_stage", &write_object_stage},
      std::pair{"line_counter", &write_line_counter},
      std::pair{"edge_pair", &write_edge_pair},
      std::pair{"line_stage", &write_line_stage},
      std::pair{"span_stage", &write_span_stage},
      std::pair{"triangle_walker", &write_triangle_walker},
      std::pair{"diffuse_slice", &write_diffuse_slice},
      std::pair{"specular_slice", &write_specular_slice},
      std::pair{"spherical_light", &write_spherical_light},
      std::pair{"ambient_light", &write_ambient_light},
      std::pair{"colour_sum", &write_colour_sum},
      std::pair{"shadow_counter", &write_shadow_counter},
      std::pair{"light_vector", &write_light_vector},
      std::pair{"half_vector", &write_half_vector},
      std::pair{"cosine_power", &write_cosine_power},
      std::pair{"light_weight", &write_light_weight},
      std::pair{"reflected_term", &write_reflected_term},
      std::pair{"radiance_sum", &write_radiance_sum},
      std::pair{"ambient_term", &write_ambient_term},
      std::pair{"light_term", &write_light_term},
      std::pair{"light_state", &write_light_state},
      std::pair{"shading_sequence", &write_shading_sequence},
      std::pair{"token_register", &write_token_register},
      std::pair{"shared_adder", &write_shared_adder},
      std::pair{"shared_dot_product", &write_shared_dot_product},
      std::pair{"shared_multiplier", &write_shared_multiplier},
      std::pair{"shared_normalizer", &write_shared_normalizer},
      std::pair{"shared_weight", &write_shared_weight},
      std::pair{"shading_processor", &write_shading_processor},
      std::pair{"unrolled_shading_processor", &write_shading_processor},
      std::pair{"table4", &write_table4},
      std::pair{"shading_pipeline", &write_shading_pipeline},
      std::pair{"quadratic_shader", &write_quadratic_shader},
      std::pair{"spherical_shader", &write_spherical_shader},
      std::pair{"token_rasterizer", &write_token_rasterizer},
      std::pair{"token_order", &write_token_order},
      std::pair{"fragment_output", &write_fragment_output},
      std::pair{"processors_shader", &write_processors_shader},
      std::pair{"quadratic_axi", &write_quadratic_shader},
      std::pair{"spherical_axi", &write_spherical_shader},
      std::pair{"processors_axi", &write_processors_shader},
      std::pair{"fragment_pixel", &write_fragment_pixel},
      std::pair{"scan_out", &write_scan_out},
      std::pair{"board_top", &write_scan_out},
      std::pair{"drawing_rate", &write_drawing_rate},
  };
  bool found = false;
  for (const auto& [name, write] : c_entities) {
    if (argc != 3 || (argv[1] != std::string_view("all") && argv[1] != std::string_view(name))) continue;
    found = true;
    if (const Status written = write(std::filesystem::path(argv[2]) / name); !written) {
      fmt::print(stderr, "{}\n", written.error().message);
      return static_cast<int>(written.error().code);
    }
  }
  if (found) return static_cast<int>(ExitCode::equal);
  fmt::print(stderr, "usage: halfway_vectors ENTITY|all FOLDER\nentities:");
  for (const auto& entity : c_entities) fmt::print(stderr, " {}", entity.first);
  fmt::print(stderr, "\n");
  return static_cast<int>(ExitCode::bad_input);
}
