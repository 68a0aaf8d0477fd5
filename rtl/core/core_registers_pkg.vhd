-- SPDX-License-Identifier: Apache-2.0
-- Made by `make tables` from rtl/core/core_registers.toml; edit that.
-- Registers of halfway_core: byte offsets, lowest bit and number of bits of fields. The same for the words of a
-- command.

library ieee;
use ieee.std_logic_1164.all;

package core_registers_pkg is

  -- A field of a command: its word, lowest bit and number of bits.
  type command_field_t is record
    word, low, bits : natural;
  end record;

  constant c_identity : std_logic_vector(31 downto 0) := x"48414C46";

  constant c_version_major : natural := 0;
  constant c_version_minor : natural := 1;
  constant c_version_patch : natural := 0;

  constant c_address_identity : natural := 0;
  constant c_address_version : natural := 4;
  constant c_address_shader : natural := 8;
  constant c_address_lights : natural := 12;
  constant c_address_objects : natural := 16;
  constant c_address_memory : natural := 20;
  constant c_address_control : natural := 24;
  constant c_address_status : natural := 28;
  constant c_address_faults : natural := 32;
  constant c_address_interrupt_enable : natural := 36;
  constant c_address_interrupts : natural := 40;
  constant c_address_ring_base : natural := 44;
  constant c_address_ring_size : natural := 48;
  constant c_address_ring_head : natural := 52;
  constant c_address_ring_tail : natural := 56;
  constant c_address_picture : natural := 60;
  constant c_address_triangles : natural := 64;
  constant c_address_fragments : natural := 68;
  constant c_address_pixels : natural := 72;
  constant c_address_busy_clocks : natural := 76;
  constant c_address_stalled_clocks : natural := 80;

  -- Access of each word.
  type access_t is (unmapped, ro, rw, w1c);
  type accesses_t is array (0 to 63) of access_t;
  constant c_accesses : accesses_t := (
    0 => ro,
    1 => ro,
    2 => ro,
    3 => ro,
    4 => ro,
    5 => ro,
    6 => rw,
    7 => ro,
    8 => w1c,
    9 => rw,
    10 => w1c,
    11 => rw,
    12 => rw,
    13 => rw,
    14 => ro,
    15 => ro,
    16 => ro,
    17 => ro,
    18 => ro,
    19 => ro,
    20 => ro,
    others => unmapped);

  constant c_command_words : natural := 16;

  constant c_command_packets : command_field_t := (0, 0, 32);
  constant c_command_packet_words : command_field_t := (1, 0, 32);
  constant c_command_colour_base : command_field_t := (2, 0, 32);
  constant c_command_depth_base : command_field_t := (3, 0, 32);
  constant c_command_colour_stride : command_field_t := (4, 0, 16);
  constant c_command_depth_stride : command_field_t := (4, 16, 16);
  constant c_command_width : command_field_t := (5, 0, 13);
  constant c_command_height : command_field_t := (5, 16, 13);
  constant c_command_left : command_field_t := (6, 0, 13);
  constant c_command_right : command_field_t := (6, 16, 13);
  constant c_command_top : command_field_t := (7, 0, 13);
  constant c_command_bottom : command_field_t := (7, 16, 13);
  constant c_command_blue : command_field_t := (8, 0, 8);
  constant c_command_green : command_field_t := (8, 8, 8);
  constant c_command_red : command_field_t := (8, 16, 8);
  constant c_command_clear : command_field_t := (8, 24, 1);
  constant c_command_swap : command_field_t := (8, 25, 1);
  constant c_command_kind : command_field_t := (8, 28, 4);
  constant c_version_major_low : natural := 24;
  constant c_version_major_bits : natural := 8;
  constant c_version_minor_low : natural := 16;
  constant c_version_minor_bits : natural := 8;
  constant c_version_patch_low : natural := 0;
  constant c_version_patch_bits : natural := 16;
  constant c_shader_kind_low : natural := 0;
  constant c_shader_kind_bits : natural := 2;
  constant c_shader_kind_quadratic : natural := 0;
  constant c_shader_kind_spherical : natural := 1;
  constant c_shader_kind_processors : natural := 2;
  constant c_shader_exact_low : natural := 2;
  constant c_shader_exact_bits : natural := 1;
  constant c_shader_channels_low : natural := 4;
  constant c_shader_channels_bits : natural := 2;
  constant c_shader_diffuse_low : natural := 8;
  constant c_shader_diffuse_bits : natural := 1;
  constant c_shader_specular_low : natural := 9;
  constant c_shader_specular_bits : natural := 1;
  constant c_shader_degree_low : natural := 10;
  constant c_shader_degree_bits : natural := 2;
  constant c_shader_highlight_channels_low : natural := 12;
  constant c_shader_highlight_channels_bits : natural := 2;
  constant c_shader_normalize_low : natural := 16;
  constant c_shader_normalize_bits : natural := 1;
  constant c_shader_shadows_low : natural := 17;
  constant c_shader_shadows_bits : natural := 1;
  constant c_shader_unrolled_low : natural := 18;
  constant c_shader_unrolled_bits : natural := 1;
  constant c_shader_table_address_bits_low : natural := 20;
  constant c_shader_table_address_bits_bits : natural := 4;
  constant c_shader_table_data_bits_low : natural := 24;
  constant c_shader_table_data_bits_bits : natural := 4;
  constant c_lights_lights_low : natural := 0;
  constant c_lights_lights_bits : natural := 8;
  constant c_lights_directional_low : natural := 8;
  constant c_lights_directional_bits : natural := 8;
  constant c_lights_positional_low : natural := 16;
  constant c_lights_positional_bits : natural := 8;
  constant c_lights_spots_low : natural := 24;
  constant c_lights_spots_bits : natural := 8;
  constant c_objects_objects_low : natural := 0;
  constant c_objects_objects_bits : natural := 16;
  constant c_objects_subpixels_low : natural := 16;
  constant c_objects_subpixels_bits : natural := 8;
  constant c_objects_powers_low : natural := 24;
  constant c_objects_powers_bits : natural := 8;
  constant c_memory_true_colour_low : natural := 0;
  constant c_memory_true_colour_bits : natural := 1;
  constant c_memory_block_bits_low : natural := 4;
  constant c_memory_block_bits_bits : natural := 4;
  constant c_memory_slot_bits_low : natural := 8;
  constant c_memory_slot_bits_bits : natural := 4;
  constant c_memory_data_bits_low : natural := 16;
  constant c_memory_data_bits_bits : natural := 8;
  constant c_control_enable_low : natural := 0;
  constant c_control_enable_bits : natural := 1;
  constant c_control_abort_low : natural := 1;
  constant c_control_abort_bits : natural := 1;
  constant c_status_busy_low : natural := 0;
  constant c_status_busy_bits : natural := 1;
  constant c_faults_wrong_kind_low : natural := 0;
  constant c_faults_wrong_kind_bits : natural := 1;
  constant c_faults_wrong_length_low : natural := 1;
  constant c_faults_wrong_length_bits : natural := 1;
  constant c_faults_shader_low : natural := 2;
  constant c_faults_shader_bits : natural := 1;
  constant c_faults_limit_low : natural := 3;
  constant c_faults_limit_bits : natural := 1;
  constant c_faults_memory_low : natural := 4;
  constant c_faults_memory_bits : natural := 1;
  constant c_faults_read_low : natural := 5;
  constant c_faults_read_bits : natural := 1;
  constant c_faults_command_low : natural := 6;
  constant c_faults_command_bits : natural := 1;
  constant c_faults_aborted_low : natural := 7;
  constant c_faults_aborted_bits : natural := 1;
  constant c_interrupt_enable_frame_low : natural := 0;
  constant c_interrupt_enable_frame_bits : natural := 1;
  constant c_interrupt_enable_fault_low : natural := 1;
  constant c_interrupt_enable_fault_bits : natural := 1;
  constant c_interrupts_frame_low : natural := 0;
  constant c_interrupts_frame_bits : natural := 1;
  constant c_interrupts_fault_low : natural := 1;
  constant c_interrupts_fault_bits : natural := 1;
  constant c_ring_base_address_low : natural := 6;
  constant c_ring_base_address_bits : natural := 26;
  constant c_ring_size_log2_low : natural := 0;
  constant c_ring_size_log2_bits : natural := 4;
  constant c_command_kind_draw : natural := 1;

end package;
