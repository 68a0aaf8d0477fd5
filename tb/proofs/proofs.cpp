// SPDX-License-Identifier: Apache-2.0
// What is proved, and the faults that each proof refutes.
#include <fmt/format.h>

#include <algorithm>

#include "golden/cosine_tables.hpp"
#include "golden/function_rom.hpp"
#include "prover.hpp"

namespace halfway::proofs {

std::vector<Proof> all_proofs() {
  std::vector<Proof> proofs;

  // Streams.
  for (const bool eager : {false, true}) {
    const char* take = eager ? "take     <= free when" : "in_valid and free";
    proofs.push_back(
        {"stream/stream_register",
         "stream/stream_register.psl",
         eager ? "The same of one that takes what is offered while it is free, valid or not"
               : "Every word comes out once, the next clock on; none is lost, doubled or changed while it "
                 "waits",
         Method::induction,
         3,
         true,
         {{"g_bits", "40"}, {"g_eager", eager ? "true" : "false"}},
         {{"stream/stream_register.vhd", "free     <= out_ready or not r.valid", "free     <= '1'"},
          {"stream/stream_register.vhd", "v.valid := '0'", "v.valid := r.valid"},
          {"stream/stream_register.vhd", "v.valid := in_valid", "v.valid := in_valid or r.valid"},
          {"stream/stream_register.vhd", take, eager ? "take     <= in_valid when" : "in_valid"},
          {"stream/stream_register.vhd", take,
           eager ? "take     <= out_ready when" : "in_valid and out_ready"},
          {"stream/stream_register.vhd", "free     <= out_ready or not r.valid",
           "free     <= not r.valid"}}});
  }
  const std::vector<Fault> queue_faults = {
      {"stream/stream_queue.vhd", "r.stored and (out_ready or not r.out_valid)",
       "r.stored and not r.out_valid"},
      {"stream/stream_queue.vhd", "r.stored and (out_ready or not r.out_valid)", "r.stored"},
      {"stream/stream_queue.vhd", "r.out_valid and out_ready;", "r.out_valid;"},
      {"stream/stream_queue.vhd", "if equal(v.claimed, c_most) then", "if equal(r.claimed, c_most) then"},
      {"stream/stream_queue.vhd", "v.claimed   := (others => '0')", "v.claimed   := r.claimed"},
      {"stream/stream_queue.vhd", "memory(index_of(r.read))", "memory(index_of(r.write))"},
      {"stream/stream_queue.vhd", "v.stored := '1'", "v.stored := r.stored"},
      {"stream/stream_queue.vhd", "v.stored := not r.single", "v.stored := '0'"},
      {"stream/stream_queue.vhd", "v.stored := not r.single", "v.stored := '1'"},
      {"stream/stream_queue.vhd", "v.single := not r.stored", "v.single := '1'"},
      {"stream/stream_queue.vhd", "v.single := not r.stored", "v.single := '0'"},
      {"stream/stream_queue.vhd", "v.single := two", "v.single := '0'"},
      {"stream/stream_queue.vhd", "in_valid = '1' and advance = '0'", "in_valid = '1'"},
      {"stream/stream_queue.vhd", "in_valid = '0' and advance = '1'", "advance = '1'"},
      {"stream/stream_queue.vhd", "next_of(r.second)", "r.second"},
      {"stream/stream_queue.vhd", "to_unsigned(2, g_index_bits + 1)", "to_unsigned(1, g_index_bits + 1)"},
      {"stream/stream_queue.vhd", "r.stored or (r.out_valid and not out_ready)", "r.stored or r.out_valid"},
      {"stream/stream_queue.vhd", "r.stored or (r.out_valid and not out_ready)", "r.stored"},
      {"stream/stream_queue.vhd", "v.stored    := '0'", "v.stored    := r.stored"}};
  proofs.push_back({"stream/stream_queue",
                    "stream/stream_queue.psl",
                    "Numbered words come out with every number, in order, two clocks behind when nothing "
                    "waits; never more are claimed than it has places for: 3 places, 3 bits",
                    Method::pdr,
                    12,
                    true,
                    {{"g_bits", "3"}, {"g_index_bits", "2"}},
                    queue_faults});
  // Three words lie in memory in more than three places alone.
  proofs.push_back({"stream/stream_queue",
                    "stream/stream_queue.psl",
                    "The same of 7 places, 4 bits",
                    Method::pdr,
                    12,
                    false,
                    {{"g_bits", "4"}, {"g_index_bits", "3"}},
                    queue_faults});
  proofs.back().faults.push_back({"stream/stream_queue.vhd", "v.single := two", "v.single := '1'"});
  proofs.push_back({"stream/delay_line",
                    "stream/delay_line.psl",
                    "The word of g_depth = 5 enabled clocks ago, whatever stalls",
                    Method::pdr,
                    16,
                    true,
                    {{"g_bits", "3"}, {"g_depth", "5"}},
                    {{"stream/delay_line.vhd", "if index = c_places - 1 then", "if index = c_places then"},
                     {"stream/delay_line.vhd", "elsif enable = '1' then", "else"},
                     {"stream/delay_line.vhd", "delayed                   <= memory(to_integer(index));",
                      "delayed                   <= word;"}}});

  proofs.push_back(
      {"stream/parameter_register",
       "stream/parameter_register.psl",
       "The word of the last load, and it stands still till the next",
       Method::induction,
       1,
       true,
       {{"g_bits", "40"}},
       {{"stream/parameter_register.vhd", "if load = '1' then", "if load = '0' then"},
        {"stream/parameter_register.vhd", "if load = '1' then", "if load = '1' and start(0) = '1' then"}}});

  // Arithmetic.
  proofs.push_back(
      {"arithmetic/saturate",
       "arithmetic/saturate.psl",
       "The value's whole part, 0 below, the largest above: every value of 40 bits, 28 of fraction",
       Method::induction,
       1,
       true,
       {{"g_value_bits", "40"}, {"g_fraction_bits", "28"}, {"g_result_bits", "8"}},
       {{"arithmetic/saturate.vhd", "value(c_sign - 1 downto c_result_high + 1) & '0'",
         "value(c_sign - 2 downto c_result_high + 1) & \"00\""},
        {"arithmetic/saturate.vhd", "result <= (others => '0')", "result <= (others => '1')"},
        {"arithmetic/saturate.vhd", "not is_zero(unsigned(above))", "unsigned(above) > 2"}}});
  proofs.push_back(
      {"arithmetic/saturating_sum",
       "arithmetic/saturating_sum.psl",
       "The sum's whole part, the largest above: any five terms of 32 bits, 16 of fraction",
       Method::induction,
       1,
       true,
       {{"g_terms", "5"}, {"g_term_bits", "32"}, {"g_fraction_bits", "16"}, {"g_result_bits", "8"}},
       {{"arithmetic/saturating_sum.vhd", "positive := g_term_bits + carry_bits",
         "positive := g_term_bits + 2"},
        {"arithmetic/saturating_sum.vhd", "for i in 1 to g_terms - 1 loop", "for i in 1 to g_terms - 2 loop"},
        {"arithmetic/saturating_sum.vhd", "high := high or terms", "high := terms"}}});

  for (const bool gated : {true, false})
    proofs.push_back(
        {"arithmetic/multiplier",
         "arithmetic/multiplier.psl",
         gated ? "The sum of a's multiples that b's bits ask for, three clocks later, and it stands still "
                 "without enable: 6 by 6 bits"
               : "The same of one whose sums choose what they add",
         Method::induction,
         5,
         true,
         {{"g_a_bits", "6"}, {"g_b_bits", "6"}, {"g_gated", gated ? "true" : "false"}},
         {{"arithmetic/multiplier.vhd", "unsigned(padded((i + 1)", "1 + unsigned(padded((i + 1)"},
          {"arithmetic/multiplier.vhd", "enable & r.filled(1)", "enable & enable"},
          {"arithmetic/multiplier.vhd", "resize(r.halves(1), whole_t", "resize(r.halves(0), whole_t"},
          {"arithmetic/multiplier.vhd", "and digit(digit'high)", "and not digit(digit'high)"},
          {"arithmetic/multiplier.vhd", gated ? "digit * word" : "shift_left(result, 1)",
           gated ? "digit * not word" : "result"}}});
  proofs.push_back(
      {"arithmetic/angle_address",
       "arithmetic/angle_address.psl",
       "Every angle: whether it is inside the bell, and its cell, counted from the top on either side",
       Method::induction,
       1,
       true,
       {{"g_address_bits", "9"}},
       {{"arithmetic/angle_address.vhd", "not angle when angle(c_sign)", "angle when angle(c_sign)"},
        {"arithmetic/angle_address.vhd", "magnitude(c_sign downto c_fraction) = c_inside",
         "magnitude(c_sign downto c_fraction + 1) = c_inside(c_sign downto c_fraction + 1)"},
        {"arithmetic/angle_address.vhd", "magnitude(c_fraction - 1 downto c_fraction - g_address_bits)",
         "magnitude(c_fraction downto c_fraction - g_address_bits + 1)"}}});
  proofs.push_back({"arithmetic/angle_address",
                    "arithmetic/angle_address_published.psl",
                    "Preset `published`: every angle's upper bits",
                    Method::induction,
                    1,
                    true,
                    {{"g_address_bits", "6"}},
                    {{"arithmetic/angle_address.vhd", "angle(c_sign downto c_sign - g_address_bits + 1)",
                      "angle(c_sign - 1 downto c_sign - g_address_bits)"}}});

  // Tables.
  const auto flag = [](bool value) { return std::string(value ? "true" : "false"); };
  const auto rom_faults = [](const char* file) {
    return std::vector<Fault>{{file, "(unsigned(address))", "(unsigned(address(address'high - 1 downto 0)))"},
                              {file, "if enable = '1' then", "if enable = '1' or address(0) = '1' then"}};
  };
  for (const golden::CosineTable& table : golden::c_cosine_tables) {
    proofs.push_back(
        {"tables/cosine_rom",
         "tables/cosine_rom.psl",
         fmt::format("Every address gives the golden model's entry: cos^{} in 2^{} entries of {} bits, `{}`",
                     table.power, table.address_bits, table.data_bits, table.exact ? "exact" : "published"),
         Method::induction,
         1,
         table.power == 2,
         {{"g_exact", flag(table.exact)},
          {"g_power", std::to_string(table.power)},
          {"g_address_bits", std::to_string(table.address_bits)},
          {"g_data_bits", std::to_string(table.data_bits)}},
         rom_faults("tables/cosine_rom.vhd")});
    proofs.back().fault_depth = 4;
    proofs.back().entries.assign(table.entries.begin(), table.entries.end());
    proofs.back().entry_bits = table.data_bits;
  }
  for (const bool exact : {true, false})
    for (int which = 0; which < 3; ++which) {
      constexpr const char* names[] = {"1/sqrt", "log2", "2^-x"};
      const auto function = static_cast<golden::Function>(which);
      const golden::FunctionTable& table = exact ? golden::function_table<golden::Exact>(function)
                                                 : golden::function_table<golden::Published>(function);
      proofs.push_back(
          {"tables/function_rom",
           "tables/function_rom.psl",
           fmt::format("Every address gives the golden model's value{}: {}, `{}`",
                       table.slope_bits > 0 ? " and slope" : "", names[which], exact ? "exact" : "published"),
           Method::induction,
           1,
           !exact,
           {{"g_exact", flag(exact)}, {"g_which", std::to_string(which)}},
           rom_faults("tables/function_rom.vhd")});
      proofs.back().fault_depth = 4;
      for (std::uint32_t at = 0; at < 1U << table.address_bits; ++at) {
        const auto sample = exact ? golden::function_rom<golden::Exact>(function, at)
                                  : golden::function_rom<golden::Published>(function, at);
        proofs.back().entries.push_back(std::uint64_t{sample.slope} << table.value_bits | sample.value);
      }
      proofs.back().entry_bits = table.value_bits + table.slope_bits;
    }

  // Walkers.
  proofs.push_back(
      {"raster/edge_walker",
       "raster/edge_walker.psl",
       "Whole pixels and rest together move by quotient + remainder/divisor every step; the rest stays below "
       "it",
       Method::induction,
       3,
       true,
       {},
       {{"raster/edge_walker.vhd", "r.quotient & r.carry", "r.quotient & '0'"},
        {"raster/edge_walker.vhd", "increment & not below", "increment & '0'"},
        {"raster/edge_walker.vhd", "increment := '0' & r.rise", "increment := '0' & r.remainder"},
        {"raster/edge_walker.vhd", "v.carry   := next_reduced(next_reduced'high)", "v.carry   := below"}}});
  for (const bool complement : {false, true})
    proofs.push_back(
        {"raster/slope_walker",
         "raster/slope_walker.psl",
         complement ? "The same as its complement"
                    : "The whole part of what the start and all slopes that were stepped make together",
         Method::induction,
         2,
         true,
         {{"g_complement", complement ? "true" : "false"}},
         {{"raster/slope_walker.vhd", "r.whole & r.carry", complement ? "r.whole & '1'" : "r.whole & '0'"},
          {"raster/slope_walker.vhd", "part     := unsigned(load_slope(c_fraction - 1 downto 0))",
           "part     := r.part"},
          {"raster/slope_walker.vhd", "next_fraction(c_fraction) xor fraction(fraction_t'high)",
           "next_fraction(c_fraction)"}}});
  for (const bool complement : {false, true})
    proofs.push_back(
        {"raster/split_slope_walker",
         "raster/split_slope_walker.psl",
         complement
             ? "The same as its complement"
             : "The same with the fraction in two halves, a line ahead and two, from each load whose lower "
               "half has stood still",
         Method::induction,
         2,
         true,
         {{"g_complement", complement ? "true" : "false"}},
         {{"raster/split_slope_walker.vhd", "(r.whole & r.carry)",
           complement ? "(r.whole & '1')" : "(r.whole & '0')"},
          {"raster/split_slope_walker.vhd", "low        := r.first_low", "low        := x_low"},
          {"raster/split_slope_walker.vhd", "part_low   := slope_low", "part_low   := r.part_low"},
          {"raster/split_slope_walker.vhd", "part_high  := unsigned(load_slope(c_fraction - 1 downto c_low))",
           "part_high  := r.part_high"},
          {"raster/split_slope_walker.vhd", "high_carry := r.first_carry", "high_carry := '0'"},
          {"raster/split_slope_walker.vhd", "v.first_carry := next_low(c_low)", "v.first_carry := '0'"},
          {"raster/split_slope_walker.vhd", "('0' & part_high & high_carry)", "('0' & part_high & '0')"},
          {"raster/split_slope_walker.vhd", "next_high(next_high'high) xor high(high_t'high)",
           "next_high(next_high'high)"},
          {"raster/split_slope_walker.vhd", "next_low(next_low'high) xor low(low_t'high)",
           "next_low(next_low'high)"},
          {"raster/split_slope_walker.vhd", "v.part_low  := part_low", "v.part_low  := r.part_low"}}});
  const std::vector<Fault> walker_faults = {
      {"raster/triangle_walker.vhd", "init_ready <= edge_load", "init_ready <= line_load"},
      {"raster/triangle_walker.vhd", "v.edges.reads := not init_valid", "v.edges.reads := '1'"},
      {"raster/triangle_walker.vhd", "(moves and r.edges.reads) or not r.edges.valid",
       "r.edges.reads or not r.edges.valid"},
      {"raster/triangle_walker.vhd", "(moves and r.edges.reads) or not r.edges.valid", "not r.edges.valid"},
      {"raster/triangle_walker.vhd", "edge_step <= r.edges.valid and moves", "edge_step <= r.edges.valid"},
      {"raster/triangle_walker.vhd", "line_load <= moves and r.edges.first;", "line_load <= edge_step;"},
      {"raster/triangle_walker.vhd", "line_load <= moves and r.edges.first;",
       "line_load <= line_ready and r.edges.first;"},
      {"raster/triangle_walker.vhd", "moves <= fragment_ready and r.flows",
       "moves <= fragment_ready and r.span.ends"},
      {"raster/triangle_walker.vhd", "moves <= fragment_ready and r.flows", "moves <= fragment_ready"},
      {"raster/triangle_walker.vhd", "moves <= fragment_ready and", "moves <="},
      {"raster/triangle_walker.vhd", "(line_ready or not r.line.valid)", "'1'"},
      {"raster/triangle_walker.vhd", "(line_ready or not r.line.valid)", "line_ready"},
      {"raster/triangle_walker.vhd", "begins    := r.line.draws and line_ready", "begins    := r.line.draws"},
      {"raster/triangle_walker.vhd", "begins    := r.line.draws and line_ready", "begins    := line_ready"},
      {"raster/triangle_walker.vhd", "span_load <= fragment_ready and r.span.ends",
       "span_load <= fragment_ready"},
      {"raster/triangle_walker.vhd", "r.span.ends and r.line.draws and line_ready",
       "r.span.ends and line_ready"},
      {"raster/triangle_walker.vhd", "line_step <= fragment_ready and r.flows and",
       "line_step <= fragment_ready and"},
      {"raster/triangle_walker.vhd", "line_step <= fragment_ready and r.flows and r.line.valid",
       "line_step <= fragment_ready and r.flows"},
      {"raster/triangle_walker.vhd", "v.flows := last or (r.flows and", "v.flows := (r.flows and"},
      {"raster/triangle_walker.vhd", "(r.flows and blank)", "r.flows"},
      {"raster/triangle_walker.vhd", "if moves = '1' or r.flows = '0' then", "if moves = '1' then"},
      {"raster/triangle_walker.vhd", "if moves = '1' or r.flows = '0' then", "if r.flows = '0' then"},
      {"raster/triangle_walker.vhd", "if moves = '1' or r.flows = '0' then", "if true then"},
      {"raster/triangle_walker.vhd", "last := not begins", "last := '0'"},
      {"raster/triangle_walker.vhd", "if is_zero(r.line.more) then", "if r.line.more = 1 then"},
      {"raster/triangle_walker.vhd", "behind(0) := not r.span.ends", "behind(0) := r.span.ends"},
      {"raster/triangle_walker.vhd", "v.line.draws    := not blank", "v.line.draws    := '1'"},
      {"raster/triangle_walker.vhd", "more(more_t'high) or not r.edges.valid", "more(more_t'high)"},
      {"raster/triangle_walker.vhd", "v.line.valid    := r.edges.valid", "v.line.valid    := '1'"},
      {"raster/triangle_walker.vhd", "sum(pixels, behind)", "pixels"},
      {"raster/triangle_walker.vhd", "v.span.x        := r.line.start", "v.span.x        := r.line.stop"},
      {"raster/triangle_walker.vhd", "span_step <= r.span.valid and fragment_ready",
       "span_step <= r.span.valid"},
      {"raster/triangle_walker.vhd", "next_of(r.edges.y)", "r.edges.y"},
      {"raster/triangle_walker.vhd", "fewer(1) := r.edges.follows", "fewer(1) := '1'"},
      {"raster/triangle_walker.vhd", "v.edges.section_last := r.edges.left(left_t'high)",
       "v.edges.section_last := '0'"},
      {"raster/triangle_walker.vhd", "if init_upper_lines = 1 then", "if init_upper_lines = 0 then"},
      {"raster/triangle_walker.vhd", "not (v.edges.reads or v.edges.section_last)", "not v.edges.reads"},
      {"raster/triangle_walker.vhd", "edge_load  <= init_valid and edge_reads", "edge_load  <= edge_reads"},
      {"raster/triangle_walker.vhd", "edge_reads and not r.clears", "edge_reads"},
      {"raster/triangle_walker.vhd", "not edge_goes) or (edge_load and edge_goes)", "not edge_goes)"},
      {"raster/triangle_walker.vhd", "v.edges.first := not reset and", "v.edges.first :="},
      {"raster/triangle_walker.vhd", "v.edges.valid := not reset and", "v.edges.valid :="},
      {"raster/triangle_walker.vhd", "holds and not r.clears", "holds"},
      {"raster/triangle_walker.vhd", "r.edges.valid and not moves", "r.edges.valid and not edge_load"},
      {"raster/triangle_walker.vhd", "v.clears      := reset", "v.clears      := '0'"},
      {"raster/triangle_walker.vhd", "v.edges.reads   := '1'", "v.edges.reads   := v.edges.reads"},
      {"raster/triangle_walker.vhd", "busy           <= r.edges.valid or r.line.valid",
       "busy           <= r.line.valid"},
      {"raster/triangle_walker.vhd", "v.line.valid := '0'", "v.line.valid := v.line.valid"},
      {"raster/triangle_walker.vhd", "v.line.draws := '0'", "v.line.draws := v.line.draws"},
      {"raster/triangle_walker.vhd", "v.span.ends  := '1'", "v.span.ends  := v.span.ends"},
      {"raster/triangle_walker.vhd", "v.flows      := '1'", "v.flows      := v.flows"},
  };
  std::vector<Fault> exact_faults = walker_faults;
  exact_faults.push_back(
      {"raster/triangle_walker.vhd", "if init_lower_lines = 0 then", "if init_lower_lines = 1 then"});
  exact_faults.push_back(
      {"raster/triangle_walker.vhd", "if init_lower_lines = 1 then", "if init_lower_lines = 0 then"});
  exact_faults.push_back(
      {"raster/triangle_walker.vhd", "v.edges.lower_none   := '1'", "v.edges.lower_none   := '0'"});
  exact_faults.push_back({"raster/triangle_walker.vhd", "r.edges.lower_none and r.edges.left(left_t'high)",
                          "r.edges.left(left_t'high)"});
  exact_faults.push_back(
      {"raster/triangle_walker.vhd", "r.edges.lower_none or r.edges.lower_one", "r.edges.lower_none"});
  exact_faults.push_back({"raster/triangle_walker.vhd", "sum(to_x, not from_x)", "to_x - from_x"});
  std::vector<Fault> published_faults = walker_faults;
  published_faults.push_back({"raster/triangle_walker.vhd",
                              "sum(resize(stop, more_t'length), resize(not_start, more_t'length))",
                              "resize(stop, more_t'length) - resize(start, more_t'length)"});
  published_faults.push_back(
      {"raster/triangle_walker.vhd", "start     <= not not_start", "start     <= not_start"});
  const std::vector<Width> narrow_walk = {
      {"span_x", 4, 0}, {"edge_error", 3, 0}, {"lines", 3, 0}, {"pixel_y", 3, 0}, {"triangle", 2, 0}};
  const std::vector<Fault> box_faults = {
      {"raster/triangle_walker.vhd", "load           => turns", "load           => r.edges.leaves"},
      {"raster/triangle_walker.vhd", "else held_lower;", "else lower;"},
      {"raster/triangle_walker.vhd", "load_carry     => section(c_section_bits - 1)",
       "load_carry     => upper(c_section_bits - 1)"},
      {"raster/triangle_walker.vhd", "v.line.draws    := not blank", "v.line.draws    := '1'"},
      {"raster/triangle_walker.vhd", "next_of(r.edges.y)", "r.edges.y + 2"},
      {"raster/triangle_walker.vhd", "v.line.carry    := edge_carry", "v.line.carry    := not edge_carry"},
      {"raster/edge_walker.vhd", "increment := '0' & r.rise", "increment := '0' & r.remainder"},
  };
  for (const bool exact : {true, false})
    proofs.push_back(
        {"raster/triangle_walker",
         "raster/triangle_walker.psl",
         exact
             ? "Each line once, each pixel of [start, stop) once and in turn, y in the frame; a fragment "
               "stands "
               "still while it waits; every clock that nothing holds up takes a pixel or a line, so the walk "
               "ends; no clock between spans is lost"
             : "The same in preset `published`",
         Method::induction,
         3,
         exact,
         {{"g_exact", exact ? "true" : "false"}},
         exact ? exact_faults : published_faults,
         exact ? narrow_walk : std::vector<Width>{},
         false,
         8,
         true});

  // A line's and a section's counts have two bits at least in their lower parts.
  const std::vector<Width> narrow_queue = {{"span_x", 4, 0}, {"edge_error", 3, 0}, {"edge_x", 4, 4},
                                           {"lines", 4, 0},  {"pixel_y", 3, 0},    {"triangle", 2, 0}};
  const std::vector<Fault> queued_faults = {
      {"raster/queued_walker.vhd", "init_ready <= edge_load", "init_ready <= edge_reads"},
      {"raster/queued_walker.vhd",
       "(fragment_ready and (r.span.ends or not r.line.draws)) or not r.line.valid",
       "r.span.ends or not r.line.draws or not r.line.valid"},
      {"raster/queued_walker.vhd",
       "(fragment_ready and (r.span.ends or not r.line.draws)) or not r.line.valid",
       "fragment_ready or not r.line.valid"},
      {"raster/queued_walker.vhd",
       "(fragment_ready and (r.span.ends or not r.line.draws)) or not r.line.valid",
       "(fragment_ready and r.span.ends) or not r.line.valid"},
      {"raster/queued_walker.vhd",
       "(fragment_ready and (r.span.ends or not r.line.draws)) or not r.line.valid",
       "fragment_ready and (r.span.ends or not r.line.draws)"},
      {"raster/queued_walker.vhd", "line_step <= fragment_ready and (r.span.ends or not r.line.draws) and",
       "line_step <= (r.span.ends or not r.line.draws) and"},
      {"raster/queued_walker.vhd",
       "line_step <= fragment_ready and (r.span.ends or not r.line.draws) and r.line.valid",
       "line_step <= fragment_ready and (r.span.ends or not r.line.draws)"},
      {"raster/queued_walker.vhd", "span_load <= fragment_ready and r.span.ends and r.line.draws",
       "span_load <= fragment_ready and r.span.ends"},
      {"raster/queued_walker.vhd", "span_load <= fragment_ready and r.span.ends",
       "span_load <= fragment_ready"},
      {"raster/queued_walker.vhd", "span_step <= fragment_ready and r.span.valid",
       "span_step <= r.span.valid"},
      {"raster/queued_walker.vhd", "line_load <= moves and (", "line_load <= ("},
      {"raster/queued_walker.vhd", "(r.second.valid and r.second.first)", "r.second.first"},
      {"raster/queued_walker.vhd",
       "(r.accepts and r.measured.valid and r.measured.first and not r.second.valid)",
       "(r.accepts and r.measured.first and not r.second.valid)"},
      {"raster/queued_walker.vhd",
       "(r.accepts and r.measured.valid and r.measured.first and not r.second.valid)",
       "(r.edges.valid and r.edges.first and not r.second.valid)"},
      {"raster/queued_walker.vhd", "edge_reads <= r.accepts and r.edges.reads",
       "edge_reads <= r.edges.reads"},
      {"raster/queued_walker.vhd", "edge_reads <= r.accepts and r.edges.reads", "edge_reads <= r.accepts"},
      {"raster/queued_walker.vhd", "edge_reads and not r.clears", "edge_reads"},
      {"raster/queued_walker.vhd", "last            := r.span.below and r.span.no_high",
       "last            := r.span.below"},
      {"raster/queued_walker.vhd", "last            := r.span.below and r.span.no_high",
       "last            := r.span.no_high"},
      {"raster/queued_walker.vhd", "fewer_pixels(0) := not r.span.ends", "fewer_pixels(0) := '1'"},
      {"raster/queued_walker.vhd", "last   := not r.line.long", "last   := '0'"},
      {"raster/queued_walker.vhd", "v.span.no_high := '1'", "v.span.no_high := '0'"},
      {"raster/queued_walker.vhd", "if r.span.high = 0 then", "if v.span.high = 0 then"},
      {"raster/queued_walker.vhd", "if r.span.below = '1' then", "if r.span.below = '0' then"},
      {"raster/queued_walker.vhd", "v.span.x        := r.line.place.start",
       "v.span.x        := r.line.place.stop"},
      {"raster/queued_walker.vhd", "v.span.no_high  := r.line.few", "v.span.no_high  := '1'"},
      {"raster/queued_walker.vhd", "v.span.high     := r.line.place.more(pixels_t'high downto c_low_pixels)",
       "v.span.high     := (others => '0')"},
      {"raster/queued_walker.vhd", "draws => r.measured.covers and comes", "draws => r.measured.covers"},
      {"raster/queued_walker.vhd", "draws => r.measured.covers and comes", "draws => comes"},
      {"raster/queued_walker.vhd", "taken.long := taken.draws", "taken.long := '0'"},
      {"raster/queued_walker.vhd", "taken.few := '1'", "taken.few := taken.long"},
      {"raster/queued_walker.vhd", "if r.accepts = '1' then\n      v.second := taken",
       "if true then\n      v.second := taken"},
      {"raster/queued_walker.vhd", "v.line := r.second;", "v.line := taken;"},
      {"raster/queued_walker.vhd", "v.measured.first          := r.edges.first",
       "v.measured.first          := r.edges.reads"},
      {"raster/queued_walker.vhd", "v.measured.place.backward := r.edges.backward",
       "v.measured.place.backward := not r.edges.backward"},
      {"raster/queued_walker.vhd", "v.measured.place.start    := start", "v.measured.place.start    := stop"},
      {"raster/queued_walker.vhd", "if init_upper_lines = 1 then", "if init_upper_lines = 0 then"},
      {"raster/queued_walker.vhd", "v.offer.upper_few := '1'", "v.offer.upper_few := '0'"},
      {"raster/queued_walker.vhd", "fewer_lines(1) := r.edges.follows", "fewer_lines(1) := '1'"},
      {"raster/queued_walker.vhd", "section_ends   := r.edges.below and r.edges.no_high",
       "section_ends   := r.edges.below"},
      {"raster/queued_walker.vhd", "v.edges.no_high := '1'", "v.edges.no_high := '0'"},
      {"raster/queued_walker.vhd", "if r.edges.below = '1' then", "if r.edges.below = '0' then"},
      {"raster/queued_walker.vhd", "v.edges.first := r.edges.reads", "v.edges.first := init_valid"},
      {"raster/queued_walker.vhd",
       "v.edges.reads        := not init_valid or (r.offer.upper_one and r.offer.lower_none)",
       "v.edges.reads        := not init_valid"},
      {"raster/queued_walker.vhd", "r.edges.y + 1", "r.edges.y"},
      {"raster/queued_walker.vhd", "v.edges.section_last := section_ends", "v.edges.section_last := '0'"},
      {"raster/queued_walker.vhd", "not (v.edges.reads or v.edges.section_last)", "not v.edges.reads"},
      {"raster/queued_walker.vhd", "holds := init_valid;", "holds := '1';"},
      {"raster/queued_walker.vhd", "holds and r.accepts and not r.clears", "holds and r.accepts"},
      {"raster/queued_walker.vhd", "(fragment_ready and (r.line.draws or not r.span.ends))",
       "(fragment_ready and r.line.draws)"},
      {"raster/queued_walker.vhd", "v.span.valid     := not reset and", "v.span.valid     :="},
      {"raster/queued_walker.vhd", "v.span.ends      := reset or", "v.span.ends      :="},
      {"raster/queued_walker.vhd", "v.line.valid     := not reset and", "v.line.valid     :="},
      {"raster/queued_walker.vhd", "v.line.draws     := not reset and", "v.line.draws     :="},
      {"raster/queued_walker.vhd", "(moves and (r.second.valid or taken.valid))", "(moves and taken.valid)"},
      {"raster/queued_walker.vhd", "(r.second.valid and r.second.long)", "r.second.long"},
      {"raster/queued_walker.vhd", "v.second.valid   := not reset and not moves and",
       "v.second.valid   := not reset and"},
      {"raster/queued_walker.vhd", "v.accepts        := reset or moves or not",
       "v.accepts        := moves or not"},
      {"raster/queued_walker.vhd",
       "v.accepts        := reset or moves or not (r.second.valid or taken.valid)",
       "v.accepts        := reset or moves or not r.second.valid"},
      {"raster/queued_walker.vhd", "v.measured.valid := not reset and", "v.measured.valid :="},
      {"raster/queued_walker.vhd", "(r.measured.valid and not r.accepts)", "r.measured.valid"},
      {"raster/queued_walker.vhd", "v.edges.valid    := not reset and", "v.edges.valid    :="},
      {"raster/queued_walker.vhd", "v.clears         := reset", "v.clears         := '0'"},
      {"raster/queued_walker.vhd", "v.edges.reads   := '1'", "v.edges.reads   := v.edges.reads"},
      {"raster/queued_walker.vhd", "r.edges.valid or r.measured.valid or r.second.valid",
       "r.measured.valid or r.second.valid"},
      {"raster/queued_walker.vhd", "busy           <= r.edges.valid or r.measured.valid",
       "busy           <= r.edges.valid"},
  };
  for (const bool exact : {true, false}) {
    // The stages are the same in both presets: a few of theirs in the second, and its edges'.
    std::vector<Fault> faults;
    for (std::size_t i = 0; i < queued_faults.size(); i += exact ? 1 : 8) faults.push_back(queued_faults[i]);
    if (exact)
      faults.insert(
          faults.end(),
          {{"raster/queued_walker.vhd", "v.edges.lower_none   := '1'", "v.edges.lower_none   := '0'"},
           {"raster/queued_walker.vhd", "r.edges.lower_none and section_ends", "section_ends"},
           {"raster/queued_walker.vhd", "r.edges.lower_none or r.edges.lower_one", "r.edges.lower_none"},
           {"raster/queued_walker.vhd", "if init_lower_lines = 0 then", "if init_lower_lines = 1 then"},
           {"raster/queued_walker.vhd", "if init_lower_lines = 1 then", "if init_lower_lines = 0 then"},
           {"raster/queued_walker.vhd", "v.edges.no_high      := r.edges.lower_few",
            "v.edges.no_high      := '1'"},
           {"raster/queued_walker.vhd", "to_x + not from_x", "to_x - from_x"}});
    else
      faults.insert(faults.end(),
                    {{"raster/queued_walker.vhd", "resize(stop, more_t'length) + resize(not_start",
                      "resize(stop, more_t'length) - resize(start"},
                     {"raster/queued_walker.vhd", "start     <= not not_start", "start     <= not_start"}});
    proofs.push_back({"raster/queued_walker",
                      "raster/queued_walker.psl",
                      exact
                          ? "Each line once, each pixel of [start, stop) once and in turn, y in the frame, "
                            "while up to three triangles wait inside, each begun once, in order; a fragment "
                            "stands still while it waits; every clock that nothing holds up takes a pixel or "
                            "a line, so the walk ends; no clock between spans is lost: 4 bits of x, 8 lines"
                          : "The same in preset `published`, full width",
                      exact ? Method::pdr : Method::induction,
                      3,
                      false,
                      {{"g_exact", exact ? "true" : "false"}},
                      faults,
                      narrow_queue,
                      false,
                      12,
                      !exact});
  }

  const std::vector<Width> narrow_box = {
      {"span_x", 3, 0}, {"edge_error", 2, 0}, {"lines", 2, 0}, {"pixel_y", 3, 0}, {"triangle", 1, 0}};
  proofs.push_back(
      {"raster/edge_walker",
       "raster/edge_walker_box.psl",
       "An edge that begins and ends between two pixels leaves them on no line between: any edge "
       "of 6 lines, 8 columns, divisors up to 3",
       Method::pdr,
       8,
       false,
       {},
       {{"raster/edge_walker.vhd", "r.quotient & r.carry", "r.quotient & '1'"},
        {"raster/edge_walker.vhd", "increment := '0' & r.rise", "increment := '0' & r.remainder"}},
       narrow_box});
  proofs.push_back(
      {"raster/triangle_walker",
       "raster/triangle_walker_box.psl",
       "No fragment outside its triangle's box, and every line's start, stop and carry those of exact edges: "
       "any edges whose lines lie in the box, 6 lines, 8 columns, divisors up to 3",
       Method::pdr,
       12,
       false,
       {},
       box_faults,
       narrow_box});

  proofs.push_back(
      {"raster/object_stage",
       "raster/object_stage.psl",
       "A token that waits stands still; none is overwritten or leaves twice, whatever the memory holds",
       Method::induction,
       3,
       true,
       {{"g_bits", "120"}},
       {{"raster/object_stage.vhd", "not r.valid or not passes or out_ready",
         "not r.valid or not passes or out_ready or in_valid"},
        {"raster/object_stage.vhd", "take     <= in_valid and free and not r.clearing",
         "take     <= in_valid and not r.clearing"},
        {"raster/object_stage.vhd", "v.valid := take;", "v.valid := take or r.valid;"},
        {"raster/object_stage.vhd", "not r.valid and not r.clearing;", "not r.clearing;"}},
       {{"pixel_x", 2, 0}},
       false,
       12,
       true});
  proofs.push_back(
      {"raster/object_stage",
       "raster/object_stage_column.psl",
       "A column keeps the nearest, of equals the first; polygons before it leave, and it leaves once: 4 "
       "columns, "
       "4 depths, 2 triangles",
       Method::pdr,
       14,
       false,
       {{"g_bits", "17"}},
       {{"raster/object_stage.vhd", "keeps <= nearer or", "keeps <= nearer or not (kept(0) xor token(0)) or"},
        {"raster/object_stage.vhd", "passes <= nearer and present", "passes <= present"},
        {"raster/object_stage.vhd", "z < kept_z", "z <= kept_z"},
        {"raster/object_stage.vhd", "      changed <= c_nothing;", "      changed <= kept;"},
        {"raster/object_stage.vhd", "if changes = '1' and in_column = column then",
         "if changes = '1' and z < 0 then"},
        {"raster/object_stage.vhd", "and column > r.last then",
         "and column > r.last and column(0) = '1' then"}},
       {{"pixel_x", 2, 0}, {"pixel_y", 1, 0}, {"depth", 2, 0}, {"triangle", 1, 0}}});

  // Shadows.
  proofs.push_back(
      {"illumination/shadow_counter",
       "illumination/shadow_counter.psl",
       "A count moves by one or stands at its limit, and then fault rises and stays: it never wraps; lit "
       "where count and volumes around the eye make 0 or less",
       Method::induction,
       3,
       true,
       {},
       {{"illumination/shadow_counter.vhd", "if held = c_most then",
         "if held = c_least and r.counts = '1' then"},
        {"illumination/shadow_counter.vhd", "if held = c_least then",
         "if held = c_most and r.counts = '1' then"},
        {"illumination/shadow_counter.vhd", "if leaves = '1' then", "if leaves = '1' and step = '1' then"},
        {"illumination/shadow_counter.vhd", "if leaves = '1' then\n      v.fault := '1';",
         "if leaves = '1' then\n      v.fault := not r.fault;"},
        {"illumination/shadow_counter.vhd", "'1' when around <= 0", "'1' when around = 0"},
        {"illumination/shadow_counter.vhd", "'1' when around <= 0", "'1' when around < 0"}},
       {{"pixel_x", 1, 0}, {"shadow_count", 1, 0}},
       false,
       12,
       true});
  proofs.push_back({"illumination/shadow_counter",
                    "illumination/shadow_counter_column.psl",
                    "A column's count is what was opened less what was closed, whatever columns come "
                    "between: 4 columns, 3 bits",
                    Method::pdr,
                    14,
                    false,
                    {},
                    {{"illumination/shadow_counter.vhd", "v.forwarded := '1'", "v.forwarded := '0'"},
                     {"illumination/shadow_counter.vhd", "v.last := unsigned(x)", "v.last := r.last"},
                     {"illumination/shadow_counter.vhd", "if r.takes = '1' then",
                      "if r.takes = '1' and r.opens = '1' then"},
                     {"illumination/shadow_counter.vhd", "v.forward := changed", "v.forward := held"}},
                    {{"pixel_x", 2, 0}, {"shadow_count", 2, 0}}});

  // Shading processors: the second of two directional lights, preset published.
  using Generics = std::vector<std::pair<std::string, std::string>>;
  const Generics diffuse = {{"g_exact", "false"},    {"g_channels", "1"},      {"g_directional", "2"},
                            {"g_specular", "false"}, {"g_normalize", "false"}, {"g_kind", "1"},
                            {"g_light", "2"}};
  for (const bool unrolled : {false, true}) {
    const char* file =
        unrolled ? "illumination/unrolled_shading_processor.vhd" : "illumination/shading_processor.vhd";
    std::vector<Fault> faults = {
        {file, "(command = c_redefine and r.valid = '1')", "command = c_redefine"},
        {file, "c_header.light)) = g_light else", "c_header.light)) /= 0 else"},
        {file, "command = c_delete then", "command = c_redefine then"},
        {file, "load  => take and defines", "load  => in_valid and defines"},
        {file, "when mine = '1' and (command = c_define or (",
         "when mine = '1' and (command = c_delete or ("},
    };
    if (unrolled) faults.push_back({file, "not (in_valid and changes and (or r.filled))", "'1'"});
    proofs.push_back(
        {unrolled ? "illumination/unrolled_shading_processor" : "illumination/shading_processor",
         unrolled ? "illumination/unrolled_shading_processor_commands.psl"
                  : "illumination/shading_processor_commands.psl",
         unrolled ? "The same, and not while a token before it is in the stages"
                  : "A load changes its own light alone; redefine a defined one, delete takes it away",
         Method::induction,
         3,
         true,
         diffuse,
         faults,
         {},
         true,
         12});
  }
  const std::vector<Fault> folded_faults = {
      {"illumination/shading_processor.vhd", "if out_ready = '1' then",
       "if out_ready = '1' or in_valid = '1' then"},
      {"illumination/shading_processor.vhd", "v.cycle := r.cycle + 1;", "v.cycle := r.cycle;"},
      {"illumination/shading_processor.vhd", "take    <= in_valid and free", "take    <= in_valid"},
      {"illumination/shading_processor.vhd", "if r.cycle = c_at.add and r.valid = '1' then",
       "if r.cycle = c_at.leave and r.valid = '1' then"},
      {"illumination/shading_processor.vhd", "(g_kind = c_ambient or r.valid = '1')",
       "(g_kind = c_ambient or r.valid = r.valid)"},
  };
  std::vector<Fault> shadow_faults = folded_faults;
  shadow_faults.push_back(
      {"illumination/shading_processor.vhd", "r.taken = '1' and lit = '0'", "r.taken = '1' and lit = '1'"});
  std::vector<Fault> horizon_faults = folded_faults;
  horizon_faults.push_back({"illumination/shading_processor.vhd",
                            "r.cycle = c_at.horizon and positive_dot = '0'",
                            "r.cycle = c_at.cosine and positive_dot = '0'"});
  horizon_faults.push_back(
      {"arithmetic/shading_pkg.vhd", "dot(dot'left) = '0' and dot /= c_zero", "dot(dot'left) = '0'"});
  std::vector<Fault> diffuse_faults = folded_faults;
  diffuse_faults.push_back(
      {"illumination/terms_pkg.vhd", "held(sum, radiance'length)", "sum(radiance'length - 1 downto 0)"});
  std::vector<Fault> ambient_faults(folded_faults.begin(), folded_faults.begin() + 3);
  ambient_faults.push_back({"illumination/shading_processor.vhd",
                            "g_kind = c_ambient and comes = '1' and\n          not",
                            "g_kind = c_ambient and\n          not"});
  const auto with = [](Generics generics, const Generics& others) {
    for (const auto& [name, value] : others) {
      const auto at = std::find_if(generics.begin(), generics.end(),
                                   [&, key = name](const auto& pair) { return pair.first == key; });
      if (at == generics.end())
        generics.emplace_back(name, value);
      else
        at->second = value;
    }
    return generics;
  };
  proofs.push_back({"illumination/shading_processor",
                    "illumination/shading_processor.psl",
                    "A token comes out once, in the clocks of table 4 at most, and stands still while it "
                    "waits; nothing of it "
                    "changes but an object's colour, and that by one term, held at its largest, where the "
                    "light is there; any "
                    "products",
                    Method::induction,
                    3,
                    true,
                    diffuse,
                    diffuse_faults,
                    {},
                    true,
                    14});
  proofs.push_back({"illumination/shading_processor",
                    "illumination/shading_processor.psl",
                    "The same with shadows: none of the light where volumes are around the point",
                    Method::induction,
                    3,
                    false,
                    with(diffuse, {{"g_shadows", "true"}}),
                    shadow_faults,
                    {{"pixel_x", 2, 0}},
                    true,
                    14});
  proofs.push_back({"illumination/shading_processor",
                    "illumination/shading_processor.psl",
                    "The same of a highlight, preset `exact`: none behind the light's horizon",
                    Method::induction,
                    3,
                    false,
                    with(diffuse, {{"g_exact", "true"},
                                   {"g_directional", "1"},
                                   {"g_diffuse", "false"},
                                   {"g_specular", "true"},
                                   {"g_kind", "2"},
                                   {"g_light", "1"}}),
                    horizon_faults,
                    {},
                    true,
                    26});
  proofs.push_back(
      {"illumination/shading_processor",
       "illumination/shading_processor.psl",
       "The same of the ambient light, preset `exact`: of an object, N alone besides the colour",
       Method::induction,
       3,
       false,
       with(diffuse, {{"g_exact", "true"}, {"g_normalize", "true"}, {"g_kind", "0"}, {"g_light", "0"}}),
       ambient_faults,
       {},
       true,
       16});
  proofs.push_back(
      {"illumination/unrolled_shading_processor",
       "illumination/unrolled_shading_processor.psl",
       "Numbered tokens come out with every number, in order, however held up; any products",
       Method::pdr,
       12,
       true,
       diffuse,
       {{"illumination/unrolled_shading_processor.vhd", "flows <= out_ready or not r.filled(c_at.leave)",
         "flows <= '1'"},
        {"illumination/unrolled_shading_processor.vhd", "free  <= flows and ready", "free  <= ready"},
        {"illumination/unrolled_shading_processor.vhd",
         "g_depth => c_at.term\n      )\n    port map (\n      clk     => clk,\n      reset   => reset,\n    "
         "  enable  => flows,\n      word    => in_token,",
         "g_depth => c_at.term\n      )\n    port map (\n      clk     => clk,\n      reset   => reset,\n    "
         "  enable  => take,\n      word    => in_token,"}},
       {},
       true});

  proofs.push_back(
      {"illumination/unrolled_shading_processor",
       "illumination/unrolled_shading_processor_token.psl",
       "What comes out is what was taken but for an object's colour, and that has the light's term, once, "
       "held at "
       "its largest, where the light is there; any products",
       Method::unrolled,
       9,
       false,
       diffuse,
       {{"illumination/unrolled_shading_processor.vhd", "shaded <= r.valid and lit_now and before_horizon",
         "shaded <= lit_now and before_horizon"},
        {"illumination/unrolled_shading_processor.vhd",
         "shaded = '1' and (now = c_new_pixel or now = c_new_object or now = c_new_scanline)",
         "shaded = '1'"},
        {"illumination/terms_pkg.vhd", "held(sum, radiance'length)", "sum(radiance'length - 1 downto 0)"}},
       {},
       true});

  // The pipeline of three processors.
  for (const bool unrolled : {true, false})
    proofs.push_back(
        {"shaders/shading_pipeline",
         "shaders/shading_pipeline.psl",
         unrolled
             ? "Numbered objects run through three processors and come out with every number, in order, and "
               "nothing else does; any products"
             : "The same of folded processors",
         unrolled ? Method::unrolled : Method::pdr,
         18,
         false,
         {{"g_exact", "false"},
          {"g_channels", "1"},
          {"g_directional", "2"},
          {"g_specular", "false"},
          {"g_normalize", "false"},
          {"g_unrolled", unrolled ? "true" : "false"}},
         {{"shaders/shading_pipeline.vhd", "valid(c_processors) and object", "valid(c_processors)"},
          {"shaders/shading_pipeline.vhd", "out_ready or not object", "'1'"},
          {"shaders/shading_pipeline.vhd", "busy  <= or works", "busy  <= works(0)"}},
         {{"triangle", 4, 0}},
         true});

  // Differences.
  const std::vector<Fault> quadratic_faults = {
      {"interpolation/quadratic_interpolator.vhd", "increment => span_dxx", "increment => dxx"},
      {"interpolation/quadratic_interpolator.vhd", "increment => dx_step", "increment => dxx"},
      {"interpolation/quadratic_interpolator.vhd", "start     => part_dx", "start     => dxx"},
      {"interpolation/part_interpolator.vhd", "unsigned(addend)", "unsigned(not addend)"},
      {"interpolation/part_interpolator.vhd", "addend := start", "addend := increment"},
      {"interpolation/part_interpolator.vhd", "if step = '1' then\n            addend",
       "if load = '1' then\n            addend"},
      {"interpolation/part_interpolator.vhd", "if load = '1' then\n            value",
       "if load = '1' and step = '1' then\n            value"},
  };
  const std::vector<Fault> split_faults = {
      {"interpolation/part_interpolator.vhd", "whole(g_bits + 1) xor word(g_bits - 1)", "whole(g_bits)"},
      {"interpolation/quadratic_interpolator.vhd", "span_steps(strobe_t'high - 1 downto 0)",
       "span_loads(strobe_t'high - 1 downto 0)"},
      {"interpolation/quadratic_interpolator.vhd", "carry_in  => carries(span_dx)(part)",
       "carry_in  => carries(span_value)(part)"},
  };
  const std::vector<Fault> ahead_faults = {
      {"interpolation/part_interpolator.vhd", "loads <= load;", "loads <= step;"},
      {"interpolation/part_interpolator.vhd", "goes  <= load or step", "goes  <= step"},
      {"interpolation/part_interpolator.vhd", "addend <= start", "addend <= increment"},
      {"interpolation/part_interpolator.vhd", "addend <= increment;", "addend <= start;"},
      {"interpolation/part_interpolator.vhd", "if goes = '1' then", "if goes = '1' or load = '1' then"},
      {"interpolation/part_interpolator.vhd", "if loads = '1' then", "if load = '1' then"},
      {"interpolation/part_interpolator.vhd", "whole(g_bits + 1) xor word(g_bits - 1)", "whole(g_bits)"},
      {"interpolation/quadratic_interpolator.vhd", "step      => line_steps(part + c_behind)",
       "step      => line_steps(part)"},
      {"interpolation/quadratic_interpolator.vhd", "load      => span_loads(part + 2 * c_behind)",
       "load      => span_loads(part + c_behind)"},
      {"interpolation/quadratic_interpolator.vhd", "step      => span_steps(part + 2 * c_behind)",
       "step      => span_steps(part + c_behind)"},
      {"interpolation/quadratic_interpolator.vhd", "step      => span_steps(part + c_behind)",
       "step      => span_steps(part + 2 * c_behind)"},
      {"interpolation/quadratic_interpolator.vhd", "span_steps(strobe_t'high - 1 downto 0)",
       "span_loads(strobe_t'high - 1 downto 0)"},
      {"interpolation/quadratic_interpolator.vhd", "carry_in  => carries(span_dx)(part)",
       "carry_in  => carries(span_value)(part)"},
  };
  std::vector<Fault> carried_faults = quadratic_faults;
  for (const auto& [from, to] : {std::pair{"de1_step   <= de1e1 when", "de1_step   <= de0e1 when"},
                                 std::pair{"dx_step    <= dxe1 when", "dx_step    <= dxe0 when"},
                                 std::pair{"part_de1 when line_carries(part + c_behind) = '1'",
                                           "part_de1 when line_carries(part + c_behind) = '0'"},
                                 std::pair{"de0_step   <= de0e1 when line_carries(part) = '1' else de0e0;",
                                           "de0_step   <= de0e0 when line_carries(part) = '1' else de0e1;"}})
    carried_faults.push_back({"interpolation/quadratic_interpolator.vhd", from, to});
  proofs.push_back(
      {"interpolation/line_interpolator",
       "interpolation/line_interpolator.psl",
       "Within (1 + steps)/2 units of a twin of 4 bits more: 12 bits",
       Method::induction,
       2,
       true,
       {{"g_bits", "12"}},
       {{"interpolation/line_interpolator.vhd", "sum(r.value, signed(increment))",
         "r.value - signed(increment)"},
        {"interpolation/line_interpolator.vhd", "if load = '1' then", "if load = '1' and step = '0' then"}},
       {},
       false,
       6});
  proofs.push_back(
      {"interpolation/plane_interpolator",
       "interpolation/plane_interpolator.psl",
       "Within (1 + lines + steps)/2 units of a twin of 4 bits more, any lines and carries: 12 bits",
       Method::bounded,
       5,
       false,
       {{"g_bits", "12"}},
       {{"interpolation/plane_interpolator.vhd", "de <= de1 when line_carries(part) = '1' else de0",
         "de <= de0 when line_carries(part) = '1' else de1"},
        {"interpolation/plane_interpolator.vhd", "increment => span_dx", "increment => dx"},
        {"interpolation/plane_interpolator.vhd", "load      => span_loads(part + c_behind)",
         "load      => line_loads(part + c_behind)"}},
       {},
       false,
       6});
  for (const bool split : {false, true})
    for (const bool exact : {true, false}) {
      proofs.push_back(
          {"interpolation/quadratic_interpolator",
           "interpolation/quadratic_interpolator.psl",
           fmt::format("{}{}",
                       exact ? "Every line's and every pixel's words are what the second differences make of "
                               "the triangle's, bit for bit, full width"
                             : "The same in preset `published`",
                       split ? "; words in two halves" : ""),
           Method::induction,
           split ? 4 : 2,
           true,
           {{"g_exact", exact ? "true" : "false"}, {"g_parts", split ? "2" : "1"}},
           exact ? carried_faults : quadratic_faults,
           {},
           false,
           split ? 7 : 5});
      if (split)
        proofs.back().faults.insert(proofs.back().faults.end(), split_faults.begin(), split_faults.end());
    }
  for (const bool exact : {true, false}) {
    std::vector<Fault> faults = ahead_faults;
    if (exact)
      faults.push_back({"interpolation/quadratic_interpolator.vhd", "line_carries(part + c_behind)",
                        "line_carries(part)"});
    proofs.push_back({"interpolation/quadratic_interpolator",
                      "interpolation/quadratic_interpolator.psl",
                      exact ? "The same of words in three parts, what they add chosen a clock ahead"
                            : "The same in preset `published`; three parts, chosen a clock ahead",
                      Method::induction,
                      8,
                      false,
                      {{"g_exact", exact ? "true" : "false"}, {"g_parts", "3"}, {"g_ahead", "true"}},
                      faults,
                      {},
                      false,
                      12});
    proofs.back().bit_registers = true;
  }
  proofs.push_back(
      {"interpolation/quadratic_interpolator",
       "interpolation/quadratic_interpolator_error.psl",
       "Within (1 + L + L(L-1)/2 + K(1 + L) + K(K-1)/2)/2 units of a twin of 4 bits more after any L "
       "lines, whatever carries, and K steps: 8 bits",
       Method::induction,
       1,
       false,
       {},
       carried_faults,
       {{"intensity", 7, 0}},
       false,
       5});
  proofs.push_back(
      {"interpolation/quadratic_interpolator",
       "interpolation/intensity.gappa",
       "At most 0.15 of a colour step off after 4095 lines and 8190 steps, preset exact, full width",
       Method::gappa,
       0,
       true,
       {},
       {{"tables/formats_pkg.vhd", "intensity => (40, 28)", "intensity => (40, 27)"}}});
  proofs.push_back({"interpolation/z_interpolator",
                    "interpolation/depth_sum.gappa",
                    "At most 0.19 of a depth step off after 4095 lines and 8190 steps, full width",
                    Method::gappa,
                    0,
                    true,
                    {},
                    {{"tables/formats_pkg.vhd", "depth_sum => (40, 15)", "depth_sum => (40, 14)"}}});
  proofs.push_back(
      {"interpolation/plane_interpolator",
       "interpolation/plane_sum.gappa",
       "At most 0.4 of a step of `vector` off after 4095 lines and 8190 steps, preset exact, full width",
       Method::gappa,
       0,
       true,
       {},
       {{"tables/formats_pkg.vhd", "plane_sum => (44, 42)", "plane_sum => (44, 41)"}}});

  // Shaders.
  const std::vector<Width> narrow_pixels = {{"span_x", 4, 0}, {"pixel_x", 3, 0},   {"edge_error", 3, 0},
                                            {"lines", 3, 0},  {"pixel_y", 3, 0},   {"triangle", 2, 0},
                                            {"depth", 4, 0},  {"depth_sum", 4, 1}, {"intensity", 9, 2}};
  proofs.push_back(
      {"shaders/quadratic_shader",
       "shaders/quadratic_shader.psl",
       "Each pixel of the walker has a place in the queue and comes there once, in order, with its own "
       "position; two buffers: the next triangles are taken while one is drawn, each goes to the walker "
       "once, and "
       "its words stand still until the interpolators have them",
       Method::induction,
       3,
       true,
       {{"g_channels", "1"}, {"g_probe", "true"}},
       {{"shaders/quadratic_shader.vhd", "waiting or walking or coming", "walking or coming"},
        {"shaders/quadratic_shader.vhd", "room,\n          triangle", "'1',\n          triangle"},
        {"shaders/quadratic_shader.vhd", "pixel_valid <= r.span_step(c_whole)",
         "pixel_valid <= r.span_step(1)"},
        {"shaders/quadratic_shader.vhd", "v.span_step := (others => '0')", "v.span_step := v.span_step"},
        {"shaders/quadratic_shader.vhd", "(r.walk_valid and not walk_ready) or", "waiting or"},
        {"shaders/quadratic_shader.vhd", "out_ready => r.walk_taken", "out_ready => walk_ready"},
        {"shaders/quadratic_shader.vhd", "v.copy_waits and not v.placed", "v.copy_waits"},
        {"shaders/quadratic_shader.vhd", "(r.copy(1) or r.placed) and not line_load",
         "r.copy(1) or r.placed"},
        {"shaders/quadratic_shader.vhd", "load  => r.copy(1 + part),\n            start",
         "load  => r.copy(1),\n            start"},
        {"shaders/quadratic_shader.vhd", "load  => r.copy(1 + part),\n                start",
         "load  => r.copy(1),\n                start"},
        {"shaders/quadratic_shader.vhd", "line_step and not line_load", "line_step"},
        {"shaders/quadratic_shader.vhd", "span_step and not span_load", "span_step"},
        {"shaders/quadratic_shader.vhd", "pixels <= pixel_t'(triangle, y, x) & pixels(1 to c_whole - 1)",
         "pixels <= (others => pixel_t'(triangle, y, x))"},
        {"stream/stream_register.vhd", "free     <= out_ready or not r.valid", "free     <= not r.valid"}},
       {},
       false,
       12});
  proofs.back().widths = narrow_pixels;
  proofs.back().full_width = true;
  proofs.back().contracts = {"raster/triangle_walker_any.psl", "interpolation/z_interpolator_any.psl",
                             "interpolation/quadratic_interpolator_any.psl"};
  proofs.push_back(
      {"shaders/quadratic_shader",
       "shaders/quadratic_shader_fast.psl",
       "The same of the fast form, six clocks later; the walker takes a triangle from where it is offered, "
       "its words stand in "
       "the buffer until their last part has gone on, and each of three parts where the interpolators load "
       "it, however soon "
       "behind one another triangles begin",
       Method::induction,
       4,
       false,
       {{"g_channels", "1"}, {"g_probe", "true"}, {"g_fast", "true"}},
       {{"shaders/quadratic_shader.vhd", "busy  <= waiting or walking or coming",
         "busy  <= waiting or coming"},
        {"shaders/quadratic_shader.vhd", "busy  <= waiting or walking or coming",
         "busy  <= waiting or walking"},
        {"shaders/quadratic_shader.vhd", "room,\n        triangle", "'1',\n        triangle"},
        {"shaders/quadratic_shader.vhd", "pixel_valid <= r.span_step(c_whole)",
         "pixel_valid <= r.span_step(c_whole - 1)"},
        {"shaders/quadratic_shader.vhd", "v.span_step := (others => '0')", "v.span_step := v.span_step"},
        {"shaders/quadratic_shader.vhd", "pixels <= pixel_t'(triangle, y, x) & pixels(1 to c_whole - 1)",
         "pixels <= (others => pixel_t'(triangle, y, x))"},
        {"shaders/quadratic_shader.vhd", "pixels(c_whole).x(fragment_x'range)",
         "pixels(c_whole - 1).x(fragment_x'range)"},
        {"shaders/quadratic_shader.vhd", "load  => r.walk_valid,", "load  => '1',"},
        {"shaders/quadratic_shader.vhd", "(r.copy_waits and not r.copy(1)) or takes", "takes"},
        {"shaders/quadratic_shader.vhd", "(r.copy_waits and not r.copy(1)) or takes",
         "r.copy_waits or takes"},
        {"shaders/quadratic_shader.vhd", "(r.copy(1) or r.placed) and not line_load",
         "r.copy(1) or r.placed"},
        {"shaders/quadratic_shader.vhd", "(r.copy(1) or r.placed) and not line_load",
         "r.copy(1) or (r.placed and not line_load)"},
        {"shaders/quadratic_shader.vhd", "v.copy_waits and not v.placed", "v.copy_waits"},
        {"shaders/quadratic_shader.vhd", "v.copy_waits and not v.placed", "v.copy_waits and not r.placed"},
        {"shaders/quadratic_shader.vhd", "r.copy(1 to c_parts - 1)", "r.copy(1) & r.copy(1)"},
        {"shaders/quadratic_shader.vhd", "line_load & r.line_load(1 to c_parts - 1)",
         "line_load & r.line_load(2 to c_parts)"},
        {"shaders/quadratic_shader.vhd", "v.walk_valid := init_valid and not takes and not v.copy_waits",
         "v.walk_valid := init_valid and not takes"},
        {"shaders/quadratic_shader.vhd", "v.walk_valid := init_valid and not takes and not v.copy_waits",
         "v.walk_valid := not takes and not v.copy_waits"},
        {"shaders/quadratic_shader.vhd", "if v.copy(part) = '1' then", "if r.copy(part) = '1' then"},
        {"shaders/quadratic_shader.vhd", "if v.copy(part) = '1' then", "if false then"},
        {"shaders/quadratic_shader.vhd", "for part in 2 to c_parts - 1 loop",
         "for part in 2 to c_parts loop"},
        {"shaders/quadratic_shader.vhd", "load  => r.copy(1 + part),\n            start",
         "load  => r.copy(1),\n            start"},
        {"shaders/quadratic_shader.vhd", "load  => r.copy(1 + part),\n                start",
         "load  => r.copy(1),\n                start"},
        {"shaders/quadratic_shader.vhd", "line_step and not line_load", "line_step"},
        {"shaders/quadratic_shader.vhd", "span_step and not span_load", "span_step"},
        {"shaders/quadratic_shader.vhd", "v.copy_waits := '0'", "v.copy_waits := v.copy_waits"},
        {"shaders/quadratic_shader.vhd", "v.placed := '0'", "v.placed := v.placed"},
        {"shaders/quadratic_shader.vhd", "v.line_load := (others => '0')", "v.line_load := v.line_load"}},
       {},
       false,
       20});
  proofs.back().widths = narrow_pixels;
  proofs.back().full_width = true;
  proofs.back().contracts = {"raster/queued_walker_any.psl", "interpolation/z_interpolator_any.psl",
                             "interpolation/quadratic_interpolator_any.psl"};
  proofs.push_back(
      {"shaders/spherical_shader",
       "shaders/spherical_shader.psl",
       "The same five clocks later, each with its own depth and ambient light and the sum of its products; a "
       "record goes to its line; any products",
       Method::induction,
       3,
       false,
       {{"g_channels", "1"}, {"g_highlight_channels", "1"}},
       {{"shaders/spherical_shader.vhd", "waiting or walking or coming", "walking or coming"},
        {"shaders/spherical_shader.vhd", "fragment_ready => room", "fragment_ready => '1'"},
        {"shaders/spherical_shader.vhd", "span_step & r.filled(1 to c_summed - 1)",
         "span_load & r.filled(1 to c_summed - 1)"},
        {"shaders/spherical_shader.vhd", "span_ambient & ambients(1 to c_multiplied - 1)",
         "line_ambient & ambients(1 to c_multiplied - 1)"},
        {"shaders/spherical_shader.vhd", "load  => span_load,\n      start => line_ambient",
         "load  => line_load,\n      start => line_ambient"},
        {"shaders/spherical_shader.vhd", "span_place & places(1 to c_summed - 1)",
         "places(c_summed) & places(1 to c_summed - 1)"},
        {"shaders/spherical_shader.vhd", "load  => header_load,\n      start => init(c_header_bits - 1",
         "load  => '1',\n      start => init(c_header_bits - 1"},
        {"shaders/spherical_shader.vhd", "load  => header_load,\n      start => init(c_header_bits + ",
         "load  => '1',\n      start => init(c_header_bits + "},
        {"shaders/spherical_shader.vhd", "header_load  <= not line_held", "header_load  <= not waiting"},
        {"shaders/spherical_shader.vhd", "span_step and not span_load", "span_step"},
        {"shaders/spherical_shader.vhd", "waiting and not line_held", "waiting"},
        {"shaders/spherical_shader.vhd", "line_step or line_load", "line_step or not waiting"}},
       {},
       true,
       26});
  proofs.back().widths = narrow_pixels;
  proofs.back().full_width = true;
  proofs.back().contracts = {"raster/triangle_walker_any.psl", "interpolation/z_interpolator_any.psl"};
  proofs.push_back(
      {"shaders/processors_shader",
       "shaders/processors_shader.psl",
       "Each object of the pipeline comes out once, with its own depth and colour, and stands still while it "
       "waits; "
       "double buffer; a load goes past the walker as it came, when nothing is before it, and an object to "
       "the "
       "pipeline with what belongs to it and says where it lies; any products",
       Method::induction,
       2,
       false,
       {{"g_exact", "false"},
        {"g_channels", "1"},
        {"g_directional", "0"},
        {"g_specular", "false"},
        {"g_normalize", "false"}},
       {{"shaders/processors_shader.vhd", "or objects_busy or shading", "or objects_busy"},
        {"shaders/processors_shader.vhd", "walk_valid <= waiting and not loads;", "walk_valid <= waiting;"},
        {"shaders/processors_shader.vhd", "waiting and loads and not walking and objects_idle",
         "waiting and loads and objects_idle"},
        {"shaders/processors_shader.vhd", "line_step and not line_load", "line_step"},
        {"shaders/processors_shader.vhd", "span_step and not span_load", "span_step"},
        {"shaders/processors_shader.vhd", "token_ready and load_valid when", "load_valid when"},
        {"shaders/processors_shader.vhd", "command_word(c_new_object) when",
         "command_word(c_new_pixel) when"},
        {"shaders/processors_shader.vhd", "if reset = '1' or objects_clear = '1' then",
         "if reset = '1' then"},
        {"shaders/processors_shader.vhd", "start => line_material",
         "start => init(init_material_low(c_config) + material_t'high downto init_material_low(c_config))"},
        {"shaders/processors_shader.vhd", "command = command_word(c_define) or",
         "command = command_word(c_shadow) or"}},
       {},
       true,
       11});
  proofs.back().contracts = {"raster/triangle_walker_any.psl", "interpolation/z_interpolator_any.psl",
                             "interpolation/plane_interpolator_any.psl"};
  return proofs;
}

}  // namespace halfway::proofs
