// SPDX-License-Identifier: Apache-2.0
#include "listed.hpp"

namespace halfway::mutants {
namespace {

constexpr Listed c_listed[] = {
    // An entry of a table with one bit the other way; one more than it says; a sample that does not stand
    // still.
    {"tables/cosine_pkg.vhd", "15, 14, 12, 9, 6, 3, 1, 0, 0,", "15, 14, 12, 9, 6, 3, 1, 0, 1,",
     "tables/cosine_rom.vhd"},
    {"tables/cosine_rom.vhd", "to_unsigned(c_table(i), g_data_bits)",
     "to_unsigned(c_table(i) + boolean'pos(i = 511 and g_power = 16), g_data_bits)"},
    {"tables/cosine_rom.vhd", "if enable = '1' then", "if enable = '1' or address(0) = '1' then"},
    // The top bit does not saturate; negative values give white.
    {"arithmetic/saturate.vhd", "value(c_sign - 1 downto c_result_high + 1) & '0'",
     "value(c_sign - 2 downto c_result_high + 1) & \"00\""},
    {"arithmetic/saturate.vhd", "result <= (others => '0')", "result <= (others => '1')"},
    // One half for the other; halves taken a clock early; a digit one too many.
    {"arithmetic/multiplier.vhd", "resize(r.halves(1), whole_t", "resize(r.halves(0), whole_t"},
    {"arithmetic/multiplier.vhd", "enable & r.filled(1)", "enable & enable"},
    {"arithmetic/multiplier.vhd", "i * c_digit));", "i * c_digit)) + 1;"},
    // The bell is not folded; it has a second one beside it; preset published takes the lower bits.
    {"arithmetic/angle_address.vhd", "magnitude <= not angle when", "magnitude <= angle when"},
    {"arithmetic/angle_address.vhd", "magnitude(c_sign downto c_fraction) = c_inside",
     "magnitude(c_sign downto c_fraction + 1) = c_inside(c_sign downto c_fraction + 1)"},
    {"arithmetic/angle_address.vhd", "angle(c_sign downto c_sign - g_address_bits + 1)",
     "angle(g_address_bits - 1 downto 0)"},
    // A sum that wraps; the last term forgotten; the highest bit where the last term has it alone.
    {"arithmetic/saturating_sum.vhd", "positive := g_term_bits + carry_bits", "positive := g_term_bits + 1"},
    {"arithmetic/saturating_sum.vhd", "for i in 1 to g_terms - 1 loop", "for i in 1 to g_terms - 2 loop"},
    {"arithmetic/saturating_sum.vhd", "high := high or terms", "high := terms"},
    // A slope that ends at the cell before; a table for another; a bit of an entry.
    {"tables/function_rom.vhd", "c_table(i + 1) - c_table(i)",
     "c_table(i + 1) - c_table(i) - boolean'pos(i = 7)"},
    {"tables/function_pkg.vhd", "508, 500,", "508, 501,", "tables/function_rom.vhd"},
    {"tables/function_rom.vhd", "if enable = '1' then", "if enable = '1' or address(0) = '1' then"},
    // A tie rounded down; light from the horizon; a cosine above 1.
    {"arithmetic/shading_pkg.vhd", "+ ('0' & word(bits - 1 downto bits - 1))", "+ 0"},
    {"arithmetic/shading_pkg.vhd", "dot(dot'left) = '0' and dot /= c_zero", "dot(dot'left) = '0'"},
    {"arithmetic/shading_pkg.vhd", "one(c_fraction) := '1';", "one(c_fraction) := '0';"},
    // A component left out; one clock late where enable is '0'; the wrong axis.
    {"arithmetic/dot_product.vhd", "for axis in 0 to c_axes - 1 loop", "for axis in 1 to c_axes - 1 loop"},
    {"arithmetic/dot_product.vhd", "if enable = '1' then", "if enable = '1' or a(0) = '1' then"},
    {"arithmetic/vector_multiply.vhd", "axis_of(b, axis)", "axis_of(b, 2 - axis)"},
    {"arithmetic/vector_multiply.vhd", "if enable = '1' then", "if enable = '1' or a(0) = '1' then"},
    // The sign counted as a bit that moves; a zero vector's search without an end; the largest shift left
    // out.
    {"arithmetic/vector_shift.vhd", "words(axis) xor signs", "words(axis)"},
    {"arithmetic/vector_shift.vhd", "moving(c_high - 1 downto 0) & '1'", "moving(c_high - 1 downto 0) & '0'"},
    {"arithmetic/vector_shift.vhd", "for stage in stages - 1 downto 0 loop",
     "for stage in stages - 2 downto 0 loop"},
    // Roots of 1/4 to 1 not doubled; the cell of 2 to 4 off by its half; an x of the clock before; no rise.
    {"arithmetic/reciprocal_root.vhd", "r.root & '0' when r.below_one = '1'",
     "r.root & '0' when r.rest_below_one = '1'"},
    {"arithmetic/reciprocal_root.vhd", "'0' & x(c_high - 2 downto c_high - c_address)",
     "'0' & x(c_high - 1 downto c_high - c_address + 1)"},
    {"arithmetic/reciprocal_root.vhd", "r.square_x * r.entry_square", "r.table_x * r.entry_square"},
    {"arithmetic/reciprocal_root.vhd", "+ root_raise(g_exact)", "+ root_raise(g_exact) - 1"},
    {"arithmetic/reciprocal_root.vhd", "entry & '0' when r.below_one = '1'",
     "entry & '0' when below_one = '1'"},
    // 0 to a power; 1 not quite 1; a stage's exponent for another's; a product's high bits; rounding.
    {"arithmetic/power.vhd", "if r.zeros(5) = '1' then", "if r.zeros(4) = '1' then"},
    {"arithmetic/power.vhd", "r.log_one      <= base(c_fraction);", "r.log_one      <= '0';"},
    {"arithmetic/power.vhd", "r.loss * r.loss_exponent", "r.loss * r.log_exponent"},
    {"arithmetic/power.vhd",
     "if whole(c_whole_bits - 1 downto c_shifts) /= c_zeros(c_whole_bits - 1 downto c_shifts) then",
     "if whole(c_shifts) = '1' then"},
    {"arithmetic/power.vhd", "shifted(c_guard - 1 downto c_guard - 1)",
     "shifted(c_guard - 2 downto c_guard - 2)"},
    {"arithmetic/power.vhd", "for stage in 0 to c_shifts - 1 loop", "for stage in 0 to c_shifts - 2 loop"},
    {"arithmetic/power.vhd", "elsif r.one = '1' then", "elsif r.log_one = '1' then"},
    // Light behind the outer edge; t above 1; a t of the clock before; 3 - t; a slope that does not wait.
    {"illumination/spot_cone.vhd", "if over(over'high) = '0' then",
     "if over(over'high) = '0' or over(0) = '1' then"},
    {"illumination/spot_cone.vhd", "t(t'high downto c_weight - 1)", "t(t'high downto c_weight)"},
    {"illumination/spot_cone.vhd", "- (r.square_t & '0')", "- (r.t & '0')"},
    {"illumination/spot_cone.vhd", "- (r.square_t & '0')", "- ('0' & r.square_t)"},
    {"illumination/spot_cone.vhd", "r.over * r.slope", "r.over * unsigned(slope)"},
    // A place too many; a word taken while the line stands still; the last word of two.
    {"stream/delay_line.vhd", "if index = c_places - 1 then", "if index = c_places then"},
    {"stream/delay_line.vhd", "elsif enable = '1' then", "else"},
    {"stream/delay_line.vhd", "delayed <= before;", "delayed <= word;"},
    // Loads without being told to.
    {"stream/parameter_register.vhd", "if load = '1' then", "if load = '1' or start(0) = '1' then"},
    // Overwrites a word that waits, or its bits alone; survives reset.
    {"stream/stream_register.vhd", "free     <= out_ready or not r.valid", "free     <= '1'"},
    {"stream/stream_register.vhd", "in_valid and free", "in_valid"},
    {"stream/stream_register.vhd", "v.valid := '0'", "v.valid := r.valid"},
    // A word given out twice; a word too many; a claim that a reset leaves.
    {"stream/stream_queue.vhd", "r.read + 1", "r.read"},
    {"stream/stream_queue.vhd", "if v.claimed = c_most then", "if r.claimed = c_most then"},
    {"stream/stream_queue.vhd", "v.claimed   := (others => '0')", "v.claimed   := r.claimed"},
    // A carry lost, and one that comes too high; the increment for the start.
    {"interpolation/part_interpolator.vhd", "'0' & unsigned(addend) & carry", "'0' & unsigned(addend) & '0'"},
    {"interpolation/part_interpolator.vhd", "whole(g_bits + 1) xor word(g_bits - 1)", "whole(g_bits)"},
    {"interpolation/part_interpolator.vhd", "addend := start", "addend := increment"},
    // The wrong sign; step wins over load.
    {"interpolation/line_interpolator.vhd", "r.value + signed(increment)", "r.value - signed(increment)"},
    {"interpolation/line_interpolator.vhd", "if load = '1' then", "if load = '1' and step = '0' then"},
    // Carry turned round; the span takes the next triangle's step.
    {"interpolation/plane_interpolator.vhd", "de <= de1 when line_carries(part) = '1' else de0",
     "de <= de0 when line_carries(part) = '1' else de1"},
    {"interpolation/plane_interpolator.vhd", "increment => span_dx", "increment => dx"},
    // Depth that never takes the carry.
    {"interpolation/z_interpolator.vhd", "line_carry => line_carry", "line_carry => line_load"},
    // Carry ignored in one register; the span takes the next triangle's step.
    {"interpolation/quadratic_interpolator.vhd", "de0_step   <= de0e1 when", "de0_step   <= de0e0 when"},
    {"interpolation/quadratic_interpolator.vhd", "increment => span_dxx", "increment => dxx"},
    // No carry into x; a remainder that is taken once too little; another edge's error below zero.
    {"raster/edge_walker.vhd", "r.quotient & r.carry", "r.quotient & '0'"},
    {"raster/edge_walker.vhd", "increment & not below", "increment & '0'"},
    {"raster/edge_walker.vhd", "v.reduced := '0' & unsigned(load_error)",
     "v.reduced := r.carry & unsigned(load_error)"},
    // A carry lost; the first step's slope of the edge before; a carry where the fraction is large.
    {"raster/slope_walker.vhd", "r.whole & r.carry", "r.whole & '0'", "raster/triangle_walker.vhd"},
    {"raster/slope_walker.vhd", "part     := unsigned(load_slope(c_fraction - 1 downto 0))",
     "part     := r.part", "raster/triangle_walker.vhd"},
    {"raster/slope_walker.vhd", "next_fraction(c_fraction) xor fraction(fraction_t'high)",
     "next_fraction(c_fraction)", "raster/triangle_walker.vhd"},
    // A clock lost between lines of different triangles, and between lines; a line lost to a stall; the stop
    // edge never bends.
    {"raster/triangle_walker.vhd", "v.edges.reads        := r.edges.lower_none and r.edges.left(left_t'high)",
     "v.edges.reads        := '0'"},
    {"raster/triangle_walker.vhd", "v.flows := last or", "v.flows := (last and not v.span.valid) or"},
    {"raster/triangle_walker.vhd", "moves <= fragment_ready and", "moves <="},
    {"raster/triangle_walker.vhd", "load           => turns", "load           => r.edges.leaves"},
    // An init vector read twice; one that nobody is told of until its first line is handed on.
    {"raster/triangle_walker.vhd", "v.edges.reads := not init_valid", "v.edges.reads := '1'"},
    {"raster/triangle_walker.vhd", "init_ready <= edge_load", "init_ready <= line_load"},
    // One that is read while registers are still cleared; registers that are not; no line, and yet a pixel.
    {"raster/triangle_walker.vhd", "edge_reads and not r.clears", "edge_reads"},
    {"raster/triangle_walker.vhd", "v.clears      := reset", "v.clears      := '0'"},
    {"raster/triangle_walker.vhd", "more(more_t'high) or not r.edges.valid", "more(more_t'high)"},
    // A line, or a span, that does not wait for what it needs.
    {"raster/triangle_walker.vhd", "(line_ready or not r.line.valid)", "'1'"},
    {"raster/triangle_walker.vhd", "moves <= fragment_ready and r.flows", "moves <= fragment_ready"},
    {"raster/triangle_walker.vhd", "if moves = '1' or r.flows = '0' then", "if r.flows = '0' then"},
    // A span's end known too late, and where none is; a span of two pixels for one of one.
    {"raster/triangle_walker.vhd", "behind(0) := not r.span.ends", "behind(0) := '1'"},
    {"raster/triangle_walker.vhd", "last := not begins", "last := '0'"},
    {"raster/triangle_walker.vhd", "if r.line.more = 0 then", "if r.line.more = 1 then"},
    // Of equal depths the last; a polygon on the surface is before it; a pixel shaded twice; a column that
    // the
    // token before has just changed; its change that does not go on with it; columns that a clear leaves; a
    // token overwritten while it waits.
    {"raster/object_stage.vhd", "keeps <= nearer or", "keeps <= nearer or not (kept(0) xor token(0)) or"},
    {"raster/object_stage.vhd", "passes <= nearer and present", "passes <= present"},
    {"raster/object_stage.vhd", "z < kept_z", "z <= kept_z"},
    {"raster/object_stage.vhd", "      changed <= c_nothing;", "      changed <= kept;"},
    {"raster/object_stage.vhd", "if changes = '1' and in_column = column then",
     "if changes = '1' and z < 0 then"},
    {"raster/object_stage.vhd", "if changes = '1' and in_column = column then",
     "if r.valid = '1' and in_column = column then"},
    {"raster/object_stage.vhd", "and column > r.last then", "and column > r.last and column(0) = '1' then"},
    {"raster/object_stage.vhd", "not r.valid or not passes or out_ready",
     "not r.valid or out_ready or not passes or r.forwarded"},
    // Idle with a token.
    {"raster/object_stage.vhd", "not r.valid and not r.clearing;", "not r.clearing;"},
    // The next line's slope; the next pixel's horizon; light behind the horizon.
    {"illumination/diffuse_slice.vhd", "increment => slope",
     "increment => part(c_part.slope.high downto c_part.slope.low)"},
    {"illumination/diffuse_slice.vhd", "sample when in_range = '1'", "sample when lit = '1'"},
    {"illumination/diffuse_slice.vhd", "a       => gated", "a       => sample"},
    // A highlight behind the horizon; the next line's power; a power without a table; the span's factors a
    // stage early.
    {"illumination/specular_slice.vhd", "near and lit", "near"},
    {"illumination/specular_slice.vhd", "start => span_power",
     "start => part(c_part.power.high downto c_part.power.low)"},
    {"illumination/specular_slice.vhd", "sample <= (others => '0');", "sample <= samples(1);"},
    {"illumination/specular_slice.vhd", "b       => carried(", "b       => carried_in("},
    // A column that comes again at once is read from memory; a count wraps; a clear ends too early; an object
    // leaves its count; lit where volumes are missing; no fault where they are, and one without a light.
    {"illumination/shadow_counter.vhd", "v.forwarded := '1'", "v.forwarded := '0'"},
    {"illumination/shadow_counter.vhd", "if held = c_most then", "if held = c_least then"},
    {"illumination/shadow_counter.vhd", "if held = c_least then", "if held = c_least and held(0) = '1' then"},
    {"illumination/shadow_counter.vhd", "v.last := unsigned(x)", "v.last := r.last"},
    {"illumination/shadow_counter.vhd", "if r.takes = '1' then", "if r.takes = '1' and r.opens = '1' then"},
    {"illumination/shadow_counter.vhd", "'1' when around <= 0", "'1' when around = 0"},
    {"illumination/shadow_counter.vhd", "'1' when around <= 0", "'1' when around < 0"},
    // Redefines what is not there; a highlight below the horizon; a spot's
    // light
    // everywhere; the far light's shift forgotten.
    {"illumination/shading_processor.vhd", "(command = c_redefine and r.valid = '1')",
     "command = c_redefine"},
    {"illumination/shading_processor.vhd", "r.cycle = c_at.horizon and positive_dot = '0'",
     "r.cycle = c_at.horizon and positive_dot = 'Z'"},
    {"illumination/shading_processor.vhd", "r.cycle = c_at.weigh_in - 1 and spotted = '0'",
     "r.cycle = c_at.weigh_in - 1"},
    {"illumination/terms_pkg.vhd", "near     := arithmetic_shift(near, shift)", "near     := near",
     "illumination/shading_processor.vhd"},
    // A clock more than the paper's; the vector product a clock early.
    {"illumination/shading_processor.vhd", "s.weigh_in := s.angle + 1", "s.weigh_in := s.angle + 2",
     "illumination/table4.vhd"},
    {"illumination/shading_processor.vhd", "s.round_1  := s.scale_1 + c_mul_clocks",
     "s.round_1  := s.scale_1"},
    // A light that changes under the tokens before; the first token's shadow for the next; stages that stand
    // still without need, and that do not while a token waits.
    {"illumination/unrolled_shading_processor.vhd", "not (in_valid and changes and (or r.filled))", "'1'"},
    {"illumination/unrolled_shading_processor.vhd", "g_depth => c_at.term - 1\n", "g_depth => c_at.term\n"},
    {"illumination/unrolled_shading_processor.vhd", "flows <= out_ready or not r.filled(c_at.leave)",
     "flows <= out_ready"},
    {"illumination/unrolled_shading_processor.vhd", "flows <= out_ready or not r.filled(c_at.leave)",
     "flows <= '1'"},
    {"arithmetic/unit_vector.vhd", "c_dot_product_latency + reciprocal_root_latency(g_exact)",
     "reciprocal_root_latency(g_exact)"},
    {"arithmetic/unit_vector.vhd", "factor <= '0' & root;",
     "factor <= \"00\" & root(root'high - 1 downto 0);"},
    // What loads leaves; a light's processors changed about; a fault unseen.
    {"shaders/shading_pipeline.vhd", "valid(c_processors) and object", "valid(c_processors)"},
    {"shaders/shading_pipeline.vhd", "(processor - 1) / c_terms + 1",
     "(processor - 1) / c_terms + 2 - c_terms"},
    {"shaders/shading_pipeline.vhd", "or faults", "faults(0)"},
    // Not busy while only the buffer in front holds a triangle; pixels that nothing has a place for; a pixel
    // with
    // the position of the next; a triangle let go before the upper halves have it.
    {"shaders/quadratic_shader.vhd", "waiting or walking or coming", "walking or coming"},
    {"shaders/quadratic_shader.vhd", "fragment_ready => room", "fragment_ready => '1'"},
    {"shaders/quadratic_shader.vhd", "pixel_t'(triangle, y, x) & pixels(1 to c_parts - 1)",
     "pixel_t'(triangle, y, x) & pixels_t'(1 to c_parts - 1 => (triangle, y, x))"},
    {"shaders/quadratic_shader.vhd", "out_ready => r.walk_taken", "out_ready => walk_ready"},
    {"shaders/quadratic_shader.vhd", "v.copy_waits and not v.placed", "v.copy_waits"},
    {"shaders/quadratic_shader.vhd", "load  => r.copy(1 + part),\n                start",
     "load  => r.copy(1),\n                start"},
    // A record taken as a header, and by depth alone; an empty line's record taken for the next line's; the
    // ambient light of the triangle behind; not busy while only the buffer holds a vector; pixels that
    // nothing has a place for; another line's ambient light; white highlights all red.
    {"shaders/spherical_shader.vhd", "waiting and not line_held", "waiting"},
    {"shaders/spherical_shader.vhd", "header_load  <= not line_held", "header_load  <= '1'"},
    {"shaders/spherical_shader.vhd", "line_step or line_load", "line_load or span_load"},
    {"shaders/spherical_shader.vhd", "load  => span_load,\n      start => line_ambient",
     "load  => line_load,\n      start => line_ambient"},
    {"shaders/spherical_shader.vhd", "waiting or walking or coming", "walking or coming"},
    {"shaders/spherical_shader.vhd", "fragment_ready => room", "fragment_ready => '1'"},
    {"shaders/spherical_shader.vhd", "span_ambient & ambients(1 to c_multiplied - 1)",
     "line_ambient & ambients(1 to c_multiplied - 1)"},
    {"shaders/spherical_shader.vhd", "channel * boolean'pos(g_highlight_channels > 1)",
     "channel * boolean'pos(g_highlight_channels > 3)"},
    // A load taken for a triangle, one that overtakes objects in the walker or in the object stage, one that
    // is
    // dropped; a frame that leaves objects behind, or whose first object is not on a new line; a pixel's next
    // object taken for a new pixel; the next triangle's request or material; a shadow polygon that counts as
    // an
    // object; a first colour that is not rounded; a colour that moves on; not busy with an object in the
    // pipeline; grey that is red.
    {"shaders/processors_shader.vhd", "walk_valid <= waiting and not loads;", "walk_valid <= waiting;"},
    {"shaders/processors_shader.vhd", "shaded_step  <= shaded_valid and shaded_ready",
     "shaded_step  <= shaded_valid"},
    {"shaders/processors_shader.vhd", "waiting and loads and not walking and objects_idle",
     "waiting and loads and objects_idle"},
    {"shaders/processors_shader.vhd", "token_ready and load_valid when", "load_valid when"},
    {"shaders/processors_shader.vhd", "clear     => objects_clear", "clear     => '0'"},
    {"shaders/processors_shader.vhd", "if reset = '1' or objects_clear = '1' then", "if reset = '1' then"},
    {"shaders/processors_shader.vhd", "command_word(c_new_object) when", "command_word(c_new_pixel) when"},
    {"shaders/processors_shader.vhd", "start => line_request", "start => init(request_t'range)"},
    {"shaders/processors_shader.vhd", "start => line_material",
     "start => init(init_material_low(c_config) + material_t'high downto init_material_low(c_config))"},
    {"shaders/processors_shader.vhd",
     "object_token(c_pixel.command.high downto c_pixel.command.low)\n      /= command_word(c_shadow) then",
     "object_token(c_pixel.command.high downto c_pixel.command.low)\n      /= command_word(c_delete) then"},
    {"shaders/processors_shader.vhd", "value(c_formats.radiance.fraction - 1) := '1'",
     "value(c_formats.radiance.fraction - 1) := '0'"},
    {"shaders/processors_shader.vhd", "load  => shaded_step,\n      start => colours",
     "load  => shaded_valid,\n      start => colours"},
    {"shaders/processors_shader.vhd", "or objects_busy or shading", "or objects_busy"},
    {"shaders/processors_shader.vhd", "colour * boolean'pos(g_channels > 1)",
     "colour * boolean'pos(g_channels > 3)"},
};

}  // namespace

std::span<const Listed> listed_mutants() {
  return c_listed;
}

}  // namespace halfway::mutants
