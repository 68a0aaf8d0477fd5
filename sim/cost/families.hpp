// SPDX-License-Identifier: Apache-2.0
// The FPGA families: how Yosys synthesizes for them, which cells are counted, and how nextpnr places them. A
// further family is a further row here.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/result.hpp"
#include "sim/cost/global_buffers.hpp"

namespace halfway {

/// Numbers of cells. Each family has some of these kinds.
struct Cells {
  std::uint64_t luts = 0, carries = 0, flip_flops = 0, rams = 0, multipliers = 0;
  /// Only of no family (sim/cost/generic_cells.hpp): bits of writable memory, the sum of all products' bits,
  /// and the LUTs of multipliers on an iCE40.
  std::uint64_t memory_bits = 0, product_bits = 0, multiplier_luts = 0;
  friend bool operator==(Cells, Cells) = default;
};

namespace synth {

/// Cell types whose names start with `prefix` add `weight` to the number; nullptr: they are not counted.
struct CellKind {
  std::string_view prefix;
  std::uint64_t Cells::* number;
  std::uint64_t weight = 1;
};

/// A number of the page of synthesis, and of the stored clocks.
struct CellColumn {
  std::string_view title, name;
  std::uint64_t Cells::* number;
};

/// Names in nextpnr's reports and in the netlists that it reads.
struct PlacedNames {
  std::string_view logic_cell;                ///< in the utilisation
  std::string_view flip_flop, input, output;  ///< prefix of the types, and pins
  std::string_view lut, lut_output;           ///< type and pin
  std::string_view carry_output;              ///< pin
  std::string_view mark;                      ///< in names that Yosys makes
  std::string_view product_output{};  ///< pins of a multiplier, without their number; empty: there is none
  std::span<const std::string_view> packed{};  ///< suffixes of the cells that nextpnr packs
};

/// The device on which a family's designs are placed.
struct Device {
  std::string_view option, name, title;  ///< of --device; in messages; with the family, after "an"
  /// Logic cells, the largest number of them that nextpnr's placers can place, block RAMs and multipliers.
  std::uint64_t cells, most_placed, rams, multipliers;
  std::string_view placer;                            ///< program
  const char* install;                                ///< what the error says if a tool is missing
  std::span<const std::string_view> options;          ///< device and package
  std::span<const std::string_view> clock_options{};  ///< more of them if a clock is determined
  /// From Yosys's netlist to the one to place; nullptr: they are the same.
  Result<std::string> (*prepare)(std::string_view);
  PlacedNames names;
};

struct Family {
  std::string_view name;            ///< in names of cache folders
  std::string_view pass;            ///< of Yosys, without -top
  std::span<const CellKind> kinds;  ///< the first of a type counts
  std::span<const CellColumn> columns;
  const Device* device = nullptr;  ///< none: designs are not placed
  std::string_view models{};       ///< of the cells, for Yosys's read_verilog; of a placed family
  unsigned multiplier_bits = 0;    ///< width of the multipliers; 0: there are none
};

inline constexpr CellKind c_ice40_kinds[] = {{"SB_LUT4", &Cells::luts},
                                             {"SB_CARRY", &Cells::carries},
                                             {"SB_DFF", &Cells::flip_flops},
                                             {"SB_RAM40_4K", &Cells::rams}};
inline constexpr CellColumn c_ice40_columns[] = {{"LUTs", "luts", &Cells::luts},
                                                 {"carries", "carries", &Cells::carries},
                                                 {"flip-flops", "flip_flops", &Cells::flip_flops},
                                                 {"RAMs", "rams", &Cells::rams}};
inline constexpr std::string_view c_ice40_packed[] = {"_DFFLC", "_LC", "_RAM", "$nextpnr_RAM"};
inline constexpr std::string_view c_hx8k_options[] = {"--hx8k", "--package", "ct256"};
inline constexpr std::string_view c_hx8k_clock_options[] = {"--no-promote-globals"};
/// nextpnr 0.4's placers do not finish at 95 % of the logic cells.
inline constexpr Device c_hx8k = {.option = "hx8k",
                                  .name = "HX8K",
                                  .title = "iCE40 HX8K",
                                  .cells = 7680,
                                  .most_placed = 6912,
                                  .rams = 32,
                                  .multipliers = 0,
                                  .placer = "nextpnr-ice40",
                                  .install = "apt-get install yosys nextpnr-ice40 fpga-icestorm",
                                  .options = c_hx8k_options,
                                  .clock_options = c_hx8k_clock_options,
                                  .prepare = with_global_buffers,
                                  .names = {.logic_cell = "ICESTORM_LC",
                                            .flip_flop = "SB_DFF",
                                            .input = "D",
                                            .output = "Q",
                                            .lut = "SB_LUT4",
                                            .lut_output = "O",
                                            .carry_output = "COUT",
                                            .mark = "_SB_",
                                            .packed = c_ice40_packed}};

inline constexpr CellKind c_ecp5_kinds[] = {{"LUT4", &Cells::luts},
                                            {"CCU2C", &Cells::luts, 2},
                                            {"TRELLIS_FF", &Cells::flip_flops},
                                            {"DP16KD", &Cells::rams},
                                            {"MULT18X18D", &Cells::multipliers},
                                            {"TRELLIS_DPR16X4", &Cells::luts, 4},
                                            // Multiplexers between the LUTs of a slice.
                                            {"PFUMX", nullptr},
                                            {"L6MUX21", nullptr}};
inline constexpr CellColumn c_ecp5_columns[] = {{"ECP5: LUTs", "luts", &Cells::luts},
                                                {"ECP5: flip-flops", "flip_flops", &Cells::flip_flops},
                                                {"ECP5: RAMs", "rams", &Cells::rams},
                                                {"ECP5: multipliers", "multipliers", &Cells::multipliers}};
inline constexpr std::string_view c_ecp5_options[] = {"--85k", "--package", "CABGA756", "--speed", "6"};
/// Without buffers for pins and global signals: the design is a part of a larger one.
inline constexpr std::string_view c_ecp5_clock_options[] = {"--out-of-context"};
inline constexpr Device c_lfe5u_85f = {
    .option = "ecp5",
    .name = "LFE5U-85F",
    .title = "ECP5 LFE5U-85F",
    .cells = 83640,
    .most_placed = 83640,
    .rams = 208,
    .multipliers = 156,
    .placer = "nextpnr-ecp5",
    .install = "apt-get install yosys nextpnr-ecp5 (since Debian 13; Debian 12 has no nextpnr-ecp5)",
    .options = c_ecp5_options,
    .clock_options = c_ecp5_clock_options,
    .prepare = nullptr,
    .names = {.logic_cell = "TRELLIS_COMB",
              .flip_flop = "TRELLIS_FF",
              .input = "DI",
              .output = "Q",
              .lut = "LUT4",
              .lut_output = "Z",
              .carry_output = "FCO",
              .mark = "_TRELLIS_FF",
              .product_output = "P"}};

/// In the order of the page's columns.
inline constexpr Family c_families[] = {{.name = "ice40",
                                         .pass = "synth_ice40 -device hx",
                                         .kinds = c_ice40_kinds,
                                         .columns = c_ice40_columns,
                                         .device = &c_hx8k,
                                         .models = "-D ICE40_HX +/ice40/cells_sim.v"},
                                        {.name = "ecp5",
                                         .pass = "synth_ecp5",
                                         .kinds = c_ecp5_kinds,
                                         .columns = c_ecp5_columns,
                                         .device = &c_lfe5u_85f,
                                         .models = "+/ecp5/cells_sim.v",
                                         .multiplier_bits = 18}};
inline constexpr const Family& c_ice40 = c_families[0];
inline constexpr const Family& c_ecp5 = c_families[1];
/// Whose clocks and cells the commands show, if no device is given.
inline constexpr const Family& c_default_family = c_ecp5;

/// The options of all devices.
inline std::vector<std::string> device_options() {
  std::vector<std::string> options;
  for (const Family& family : c_families) options.emplace_back(family.device->option);
  return options;
}

/// The family of the device with this option; nullptr: there is none.
constexpr const Family* family_of(std::string_view option) {
  for (const Family& family : c_families)
    if (family.device->option == option) return &family;
  return nullptr;
}

}  // namespace synth
}  // namespace halfway
