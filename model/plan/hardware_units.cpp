// SPDX-License-Identifier: Apache-2.0
#include "plan/hardware_units.hpp"

#include <algorithm>
#include <bit>

namespace halfway {
namespace {

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
    add("line_interpolator", exact_ ? 0 : 2);
    add("parameter_register", exact_ ? 1 : 2);  // the lower section, or the slopes
  }
  void add_z_interpolator() {
    add("z_interpolator");
    add("plane_interpolator");
    add("line_interpolator", 2);
    add("parameter_register", exact_ ? 4 : 3);
  }
  // The spherical shader's: in the stages of line, span, sample and product.
  void add_ambient() { add("parameter_register", 4); }
  void add_quadratic_interpolator() {
    add("quadratic_interpolator");
    add("line_interpolator", exact_ ? 6 : 5);
    add("parameter_register", exact_ ? 7 : 4);
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
    add_stream_registers(2);
    add("parameter_register", 3);  // what a fragment has beside its tag
    add_walker();
    add_z_interpolator();
    for (unsigned c = 0; c < key_.channels; ++c) add_quadratic_interpolator();
    add("saturate", static_cast<int>(key_.channels));
  }
  void add_spherical_shader() {
    const golden::SphericalConfig config = golden_config(key_);
    const bool diffuse_part = exact_ ? golden::SphericalLayout<golden::Exact>(config).has_diffuse_part()
                                     : golden::SphericalLayout<golden::Published>(config).has_diffuse_part();
    add_stream_registers(4);       // the buffer in front, the stages of sample, product and fragment
    add("parameter_register", 4);  // depth in three stages, colour
    add_ambient();
    add_walker();
    add_z_interpolator();
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
  // What a processor has; `normalizations` of up to two vectors, side by side in one of the unrolled form,
  // one after the other in a folded one.
  void add_processor(int normalizations, bool has_cosine) {
    const bool folded = key_.processors.form == ProcessorForm::folded;
    const int units = folded ? std::min(normalizations, 1) : normalizations;
    add(folded ? "shading_processor" : "unrolled_shading_processor");
    add("parameter_register");  // what of its light it keeps
    add("vector_multiply");
    add("dot_product",
        folded ? (has_cosine || normalizations > 0 ? 1 : 0) : normalizations + (has_cosine ? 1 : 0));
    add("vector_shift", units);
    add_function_roms("reciprocal_root", 1, units);
  }
  void add_ambient_processor() {
    const golden::ProcessorsConfig config = processors_config(key_);
    const bool has_view = is_exact() && golden::ProcessorsLayout<golden::Exact>(config).has_view();
    add_processor((config.normalize ? 1 : 0) + (has_view ? 1 : 0), false);
  }
  // Of one light, which hardware for a place or for a spot serves as well.
  void add_light_processors(bool positional, bool spot) {
    const ProcessorUnits& p = key_.processors;
    const int terms = (p.diffuse ? 1 : 0) + (p.specular ? 1 : 0);
    if (p.diffuse) add_processor(positional ? 1 : 0, true);
    if (p.specular)
      add_processor(is_exact() ? 1 + (positional ? 1 : 0) : (positional ? 1 : 0) + (spot ? 1 : 0), true);
    if (spot) add("spot_cone", terms);
    if (p.shadows) add("shadow_counter", terms);
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
    add("line_interpolator", 2 * planes);
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
