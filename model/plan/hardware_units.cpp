// SPDX-License-Identifier: Apache-2.0
#include "plan/hardware_units.hpp"

#include <algorithm>
#include <bit>

namespace halfway {
namespace {

// The quadratic shader cuts the words of its interpolators in halves, the spherical one those of depth.
constexpr int kHalves = 2;
// The quadratic shader built for the clock.

// Entities below one, with all that lies below them.
class Units {
 public:
  // The walk of the shading processors is exact in either preset.
  explicit Units(const HardwareKey& key)
      : key_(key), exact_(key.preset == Preset::exact || key.shader == Shader::processors) {}

  std::map<std::string, int> take() && {
    // What is not there is not named.
    std::erase_if(counts_, [](const auto& unit) { return unit.second == 0; });
    return std::move(counts_);
  }

  void add(const std::string& entity, int count = 1) { counts_[entity] += count; }
  void add_stream_registers(int count) {
    add("stream_register", count);
    add("parameter_register", count);
  }
  void add_walker() {
    add("triangle_walker");
    add("edge_walker", exact_ ? 2 : 0);
    add("slope_walker", exact_ ? 0 : 2);
    add("parameter_register", exact_ ? 1 : 0);  // the lower section
  }
  // `parts`: of each word
  void add_z_interpolator(int parts = 1) {
    add("z_interpolator");
    add("plane_interpolator");
    add("part_interpolator", 2 * parts);
    add("parameter_register", (exact_ ? 4 : 3) * parts);
  }
  // The spherical shader's: in the stages of line and span.
  void add_ambient() { add("parameter_register", 2); }
  void add_quadratic_interpolator(int parts) {
    add("quadratic_interpolator");
    add("part_interpolator", (exact_ ? 6 : 5) * parts);
    add("parameter_register", (exact_ ? 7 : 4) * parts);
  }
  // channels 0: the light's horizon alone
  void add_diffuse_slice(int channels) {
    add("diffuse_slice");
    add("line_interpolator");
    add("angle_address");
    add("parameter_register", channels > 0 ? 3 : 2);
    if (channels == 0) return;
    add("cosine_rom");
    add("multiplier", channels);
  }
  void add_specular_slice() {
    const int tables = std::popcount(key_.spherical.powers);
    add("specular_slice");
    add("line_interpolator");
    add("angle_address");
    add("parameter_register", tables > 1 ? 5 : 3);  // the power chooses between tables
    add("cosine_rom", tables);
    add("multiplier", static_cast<int>(key_.spherical.highlight_channels));
  }
  void add_quadratic_shader() {
    add_stream_registers(1);  // the init buffer
    add("stream_queue");
    add_walker();
    add_z_interpolator(kHalves);
    for (unsigned c = 0; c < key_.channels; ++c) add_quadratic_interpolator(kHalves);
    // The second place of their words.
    const int channels = static_cast<int>(key_.channels);
    add("parameter_register", kHalves * (exact_ ? 4 + 10 * channels : 3 + 6 * channels));
    add("saturate", static_cast<int>(key_.channels));
  }
  void add_spherical_shader() {
    const golden::SphericalConfig config = golden_config(key_);
    const bool diffuse_part = exact_ ? golden::SphericalLayout<golden::Exact>(config).has_diffuse_part()
                                     : golden::SphericalLayout<golden::Published>(config).has_diffuse_part();
    add_stream_registers(1);
    add("stream_queue");
    add("parameter_register");  // the header, for depth
    add_ambient();
    add_walker();
    add_z_interpolator(kHalves);
    for (int light = 0; light < config.lights; ++light) {
      if (diffuse_part) add_diffuse_slice(config.diffuse ? config.channels : 0);
      if (config.specular) add_specular_slice();
    }
    add("saturating_sum", config.channels);
    add("saturate", config.channels);
  }
  void add_function_roms(const std::string& entity, int roms, int count) {
    add(entity, count);
    add("function_rom", roms * count);
  }
  void add_power_units() {
    const ProcessorUnits& p = key_.processors;
    if (p.specular) add_function_roms("power", 2, static_cast<int>(p.lights()));
  }
  void add_normalizations(int count) {
    add("vector_shift", count);
    add_function_roms("reciprocal_root", 1, count);
  }
  void add_unit_vectors(int count) {
    add("unit_vector", count);
    add_normalizations(count);
    add("dot_product", count);
    add("vector_multiply", count);
    add("delay_line", count);
  }
  // The first and the second vector are normalized: N and the view vector, or L and H. A folded processor
  // does one after the other, by the same units.
  void add_folded_processor(bool first, bool second, bool has_cosine) {
    add("shading_processor");
    add("parameter_register");  // what of its light it keeps
    add("vector_multiply");
    add("dot_product", first || second || has_cosine ? 1 : 0);
    add_normalizations(first || second ? 1 : 0);
  }
  void add_unrolled_processor(bool first, bool second) {
    add("unrolled_shading_processor");
    add("parameter_register");
    add("vector_multiply");  // k I
    add("delay_line", 2);
    add_unit_vectors((first ? 1 : 0) + (second ? 1 : 0));
  }
  void add_ambient_processor() {
    const bool view =
        is_exact() && golden::ProcessorsLayout<golden::Exact>(processors_config(key_)).has_view();
    if (is_folded())
      add_folded_processor(key_.processors.normalize, view, false);
    else
      add_unrolled_processor(key_.processors.normalize, view);
  }
  void add_light_processor(bool positional, bool spot, bool specular) {
    const bool first = specular && !is_exact() ? spot : positional;
    const bool second = specular && (is_exact() || positional);
    add("spot_cone", spot ? 1 : 0);
    add("shadow_counter", key_.processors.shadows ? 1 : 0);
    if (is_folded()) {
      add_folded_processor(first, second, true);
      return;
    }
    add_unrolled_processor(first, second);
    add("vector_multiply", first && is_exact() ? 2 : 1);  // the place at its distance; the weighted term
    const bool horizon = specular && is_exact();          // a product besides the one with A
    add("dot_product", 1 + (horizon ? 1 : 0) + (spot ? 1 : 0));
    add("delay_line", 2 + (first ? 1 : 0) + (horizon ? 2 : 0) + (specular ? 1 : 0) + (spot ? 2 : 0));
  }
  // Of one light, which hardware for a place or for a spot serves as well.
  void add_light_processors(bool positional, bool spot) {
    if (key_.processors.diffuse) add_light_processor(positional, spot, false);
    if (key_.processors.specular) add_light_processor(positional, spot, true);
  }
  void add_processors_shader() {
    const golden::ProcessorsConfig config = processors_config(key_);
    const int planes = is_exact() ? golden::ProcessorsLayout<golden::Exact>(config).planes()
                                  : golden::ProcessorsLayout<golden::Published>(config).planes();
    add_stream_registers(2);       // the buffer in front, the fragment
    add("parameter_register", 6);  // request and material of line and span; depth and colour
    add_walker();
    add_z_interpolator();
    add("plane_interpolator", planes);
    add("part_interpolator", 2 * planes);
    add("parameter_register", 4 * planes);
    if (config.shadows) {
      add("object_stage");
      add("parameter_register");  // the token that it holds
    }
    add("shading_pipeline");
    add_ambient_processor();
    for (int light = 0; light < config.lights(); ++light)
      add_light_processors(light >= config.directional, light >= config.directional + config.positional);
    add_power_units();
    add("saturate", config.channels);
  }

 private:
  bool is_exact() const { return key_.preset == Preset::exact; }
  bool is_folded() const { return key_.processors.form == ProcessorForm::folded; }
  const HardwareKey& key_;
  bool exact_;
  std::map<std::string, int> counts_;
};

}  // namespace

std::map<std::string, int> hardware_units(const HardwareKey& key) {
  Units units(key);
  if (key.shader == Shader::spherical)
    units.add_spherical_shader();
  else if (key.shader == Shader::processors)
    units.add_processors_shader();
  else
    units.add_quadratic_shader();
  return std::move(units).take();
}

std::map<std::string, int> units_added(const HardwareKey& from, const HardwareKey& to) {
  std::map<std::string, int> units = hardware_units(to);
  for (const auto& [unit, count] : hardware_units(from)) units[unit] -= count;
  std::erase_if(units, [](const auto& unit) { return unit.second <= 0; });
  return units;
}

std::map<std::string, int> depth_units(const HardwareKey& key) {
  Units units(key);
  units.add_z_interpolator();
  return std::move(units).take();
}

std::map<std::string, int> ambient_units(const HardwareKey& key) {
  Units units(key);
  if (key.shader == Shader::processors)
    units.add_ambient_processor();
  else
    units.add_ambient();
  return std::move(units).take();
}

std::map<std::string, int> power_units(const HardwareKey& key) {
  Units units(key);
  units.add_power_units();
  return std::move(units).take();
}

}  // namespace halfway
