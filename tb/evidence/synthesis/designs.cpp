// SPDX-License-Identifier: Apache-2.0
#include "designs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "plan/hardware_key.hpp"
#include "sim/os/must.hpp"
#include "words/formats.hpp"
#include "words/generator/formats.hpp"

namespace halfway::synth {
namespace {

// README shows their clocks.
constexpr std::string_view c_of_readme[] = {"quadratic_shader_exact", "quadratic_shader_grey_exact",
                                            "quadratic_shader_planes_grey_exact", "spherical_shader_exact"};

using Generics = std::vector<std::pair<std::string, std::string>>;

ListedDesign shader(const std::string& name, const HardwareKey& key) {
  Design design = design_of(key, {});
  design.name = name;
  return {.design = std::move(design), .ecp5 = true};
}

// An entity that contains the shader, and has its generics.
ListedDesign shader_in(const char* entity, const std::string& name, const HardwareKey& key) {
  ListedDesign top = shader(fmt::format("{}_{}", entity, name), key);
  top.design.entity = entity;
  top.design.generics = key.stream_generics();
  top.design.key.clear();
  if (top.design.entity == c_core_top) {
    top.ice40 = false;
    top.seeds = 1;
  }
  return top;
}

HardwareKey spherical(Preset preset, unsigned channels, unsigned powers, words::CosineSize tables) {
  return {.shader = Shader::spherical,
          .preset = preset,
          .channels = channels,
          .spherical = {.lights = 1,
                        .diffuse = true,
                        .specular = true,
                        .highlight_channels = 1,
                        .powers = powers,
                        .tables = tables}};
}

HardwareKey processors(Preset preset, ProcessorForm form) {
  return {
      .shader = Shader::processors,
      .preset = preset,
      .processors = {.directional = 1, .diffuse = true, .specular = true, .normalize = true, .form = form}};
}

std::string bits(const tables::PresetFormats& preset, std::string_view format) {
  for (const tables::Format& f : preset.formats)
    if (f.name == format) return std::to_string(f.integer_bits + f.fraction_bits + (f.is_signed ? 1 : 0));
  return "0";
}

}  // namespace

std::vector<ListedDesign> all_designs(const std::filesystem::path& root) {
  std::vector<ListedDesign> all;
  for (const char* width : {"24", "32", "40"})
    all.push_back({.design = {.name = fmt::format("accumulator_{}", width),
                              .entity = "accumulator",
                              .generics = {{"g_bits", width}},
                              .more = c_accumulator},
                   .quick = true});

  const auto presets = tables::preset_formats();
  for (const Preset preset : {Preset::exact, Preset::published}) {
    const bool exact = preset == Preset::exact;
    const std::string p = to_string(preset);
    const std::pair<std::string, std::string> is_exact = {"g_exact", exact ? "true" : "false"};
    const tables::PresetFormats& formats = presets[exact ? 0 : 1];
    const auto of = [&](std::string_view format) { return bits(formats, format); };
    const words::CosineSize tables = exact ? words::CosineSize{9, 8} : words::CosineSize{6, 6};
    const std::string data_bits = std::to_string(tables.data_bits);
    const std::pair<std::string, std::string> cosine = {"g_cosine", vhdl_name(tables)};
    const std::pair<std::string, std::string> sample = {"g_data_bits", data_bits};
    const std::pair<std::string, std::string> powers = {"g_powers", exact ? "8" : "2"};
    const auto add = [&](const std::string& entity, Generics generics, bool quick = false,
                         const std::string& suffix = "") {
      all.push_back({.design = {.name = fmt::format("{}{}_{}", entity, suffix, p),
                                .entity = entity,
                                .generics = std::move(generics)},
                     .quick = quick});
    };
    const auto with = [](Generics first, const Generics& more) {
      first.insert(first.end(), more.begin(), more.end());
      return first;
    };

    all.push_back(shader("quadratic_shader_" + p, {.preset = preset}));
    all.push_back(shader("quadratic_shader_grey_" + p, {.preset = preset, .channels = 1}));
    all.push_back(shader("quadratic_shader_planes_" + p, {.preset = preset, .degree = 1}));
    all.push_back(
        shader("quadratic_shader_planes_grey_" + p, {.preset = preset, .channels = 1, .degree = 1}));
    all.push_back(shader("spherical_shader_" + p, spherical(preset, 3, exact ? 8 : 2, tables)));
    all.push_back(shader("spherical_shader_grey_" + p, spherical(preset, 1, exact ? 8 : 2, tables)));
    if (exact) {
      for (const char* entity : {c_stream_top, c_core_top}) {
        all.push_back(shader_in(entity, "quadratic_grey_exact", {.channels = 1}));
        all.push_back(shader_in(entity, "spherical_grey_exact", spherical(preset, 1, 8, tables)));
      }
    } else {
      HardwareKey key = processors(preset, ProcessorForm::unrolled);
      key.channels = 1;
      all.push_back(shader_in(c_core_top, "processors_grey_published", key));
    }
    for (const ProcessorForm form : {ProcessorForm::folded, ProcessorForm::unrolled}) {
      all.push_back(
          shader(fmt::format("processors_shader_{}_{}", to_string(form), p), processors(preset, form)));
      all.back().ice40 = !exact;
      // One placement takes minutes. Those of the unrolled form are stored from the space `spheres`.
      if (exact && form == ProcessorForm::folded) all.back().seeds = 1;
    }

    // Four object processors, without and with the filter.
    for (const unsigned subpixels : {1U, 16U}) {
      if (exact) break;  // some 13,000 LUTs without the object processors: a placement takes too long
      HardwareKey key = processors(preset, ProcessorForm::unrolled);
      key.processors.objects = 4;
      key.processors.subpixels = subpixels;
      all.push_back(
          shader(fmt::format("processors_shader_objects_4{}_{}", subpixels > 1 ? "_filtered" : "", p), key));
      all.back().ice40 = false;
    }

    add("line_interpolator", {{"g_bits", of("intensity")}}, true);
    add("part_interpolator", {{"g_bits", std::to_string(std::stoi(of("intensity")) / 2)}}, true);
    add("plane_interpolator", {{"g_bits", of("depth_sum")}, {"g_carries", exact ? "true" : "false"}}, true);
    const std::pair<std::string, std::string> halves = {"g_parts", "2"};
    const Generics skewed = {{"g_bits", of("intensity")}, halves};
    add("skewed_interpolator", skewed, true);
    if (exact) add("skewed_register", skewed, true);
    if (exact) add("skewed_multiplexer", skewed, true);
    if (exact) add("skewed_strobe", {halves}, true);
    if (exact) add("deskew", skewed, true);
    add("word_buffer", {is_exact, {"g_channels", "1"}}, true);
    add("z_interpolator", {is_exact, halves}, true);
    add("quadratic_interpolator", {is_exact, halves}, true);
    if (exact) add("edge_walker", {}, true);
    if (!exact) add("slope_walker", {}, true);
    add("line_counter", {is_exact}, true);
    add("edge_pair", {is_exact}, true);
    if (exact) add("line_stage", {}, true);
    if (exact) add("span_stage", {}, true);
    add("triangle_walker", {is_exact}, true);
    add("saturate",
        {{"g_value_bits", of("intensity")},
         {"g_fraction_bits", std::to_string(exact ? 28 : 20)},
         {"g_result_bits", of("colour")}},
        true);
    add("diffuse_slice", {is_exact, cosine});
    add("specular_slice", {is_exact, {"g_channels", "1"}, powers, cosine});
    add("spherical_light", {is_exact, {"g_highlight_channels", "1"}, powers, cosine});
    add("ambient_light", {is_exact, sample}, true);
    add("colour_sum", {is_exact, {"g_terms", "3"}, sample}, true);
    add("cosine_rom", {is_exact, {"g_power", exact ? "8" : "2"}, cosine}, true);
    add("angle_address", {is_exact, cosine}, true);
    const std::string factor = of("factor");
    add("multiplier", {{"g_a_bits", data_bits}, {"g_b_bits", factor}}, true);
    add("saturating_sum",
        {{"g_terms", "3"},
         {"g_term_bits", std::to_string(std::stoi(factor) + tables.data_bits)},
         {"g_fraction_bits", std::to_string(std::stoi(factor) + tables.data_bits - (exact ? 16 : 10))},
         {"g_result_bits", of("colour")}},
        true);
    if (exact) add("parameter_register", {{"g_bits", of("intensity")}}, true);
    if (exact) add("stream_register", {{"g_bits", "64"}}, true);
    if (exact) add("stream_queue", {{"g_bits", "104"}}, true);
    if (exact) add("axi_output", {{"g_bits", "128"}}, true);
    if (exact) add("axi_control", {}, true);
    if (exact) add("axi_adapter", {}, true);
    if (exact) add("packet_reader", {{"g_bits", "880"}}, true);
    if (exact) add("delay_line", {{"g_bits", "24"}, {"g_depth", "9"}}, true);
    add("function_rom", {is_exact, {"g_which", "0"}}, true);
    const std::pair<std::string, std::string> clocks{"g_clocks", exact ? "2" : "1"};
    const Generics product = {{"g_a_bits", of("direction")}, {"g_b_bits", of("direction")}, clocks};
    add("signed_multiplier", product);
    add("vector_multiply", product);
    add("dot_product", {{"g_bits", of("direction")}, {"g_clocks", exact ? "3" : "2"}});
    add("vector_shift",
        {{"g_vector_bits", of("offset")}, {"g_result_bits", of("direction")}, {"g_clocks", "2"}});
    add("reciprocal_root", {is_exact});
    add("power", {is_exact});
    add("unit_vector", {is_exact, {"g_vector_bits", of("vector")}});
    add("spot_cone", {is_exact});
    for (const char* entity : {"shading_processor", "unrolled_shading_processor"}) {
      const Generics light = {is_exact, {"g_directional", "1"}, {"g_light", "1"}};
      // Those of preset exact do not fit the device.
      for (const auto& [kind, suffix] : {std::pair{"1", "_diffuse"}, {"2", "_specular"}}) {
        add(entity, with(light, {{"g_kind", kind}}), false, suffix);
        all.back().ice40 = !exact;
      }
    }
    add("shading_pipeline", {is_exact, {"g_directional", "1"}});
    all.back().ice40 = !exact;
  }
  // A picture in memory: both formats on 64 bits, and the smallest form, which is too large for the board.
  for (const auto& [format, true_colour] : {std::pair{"rgb565", "false"}, {"xrgb8888", "true"}})
    all.push_back({.design = {.name = fmt::format("fragments_to_memory_{}", format),
                              .entity = "fragments_to_memory",
                              .generics = {{"g_true_colour", true_colour}}},
                   .ice40 = false,
                   .ecp5 = true,
                   .seeds = 1});
  all.push_back(
      {.design = {.name = "fragments_to_memory_small",
                  .entity = "fragments_to_memory",
                  .generics = {{"g_data_bits", "32"}, {"g_block_bits", "5"}, {"g_slot_bits", "1"}}}});
  // The other parts of the core, as in halfway_core with RGB565 and 64 bits.
  for (const auto& [entity, generics] : {std::pair<const char*, Generics>{"register_port", {}},
                                         {"core_registers", {}},
                                         {"ring_control", {{"g_data_bits", "64"}, {"g_block_shift", "7"}}},
                                         {"burst_reader", {{"g_data_bits", "64"}}},
                                         {"read_arbiter", {}}})
    all.push_back({.design = {.name = entity, .entity = entity, .generics = generics}, .ice40 = false});
  for (ListedDesign& listed : all) {
    listed.design.root = root;
    if (std::ranges::count(c_of_readme, listed.design.name) > 0) listed.seeds = 9;
  }
  return all;
}

std::vector<ListedDesign> selected(const Options& options) {
  std::vector<ListedDesign> designs = all_designs(options.folders.source);
  std::erase_if(designs, [&](const ListedDesign& listed) {
    return (options.quick && !listed.quick) || listed.design.name.find(options.part) == std::string::npos;
  });
  if (designs.empty())
    throw Failure{
        bad_input(fmt::format("{}: no design has this in its name; {} lists them", options.part, c_page))};
  return designs;
}

std::string quoted(const Design& design) {
  return fmt::format("`{}`", design.name);
}

}  // namespace halfway::synth
