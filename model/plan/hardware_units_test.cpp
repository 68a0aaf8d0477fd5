// SPDX-License-Identifier: Apache-2.0
#include "plan/hardware_units.hpp"

#include <gtest/gtest.h>

#include <map>
#include <optional>
#include <set>
#include <sstream>

#include "plan/plan.hpp"
#include "sim/ghdl/ghdl_library.hpp"
#include "sim/scene_files/load_scene.hpp"

namespace halfway {
namespace {

// Instances of each entity below the netlist's top.
class Netlist {
 public:
  Netlist(const std::string& text, std::set<std::string> entities) : entities_(std::move(entities)) {
    // `module NAME` and, two blanks in, `ENTITY instance (`, as GHDL puts them.
    std::istringstream lines(text);
    std::string module;
    for (std::string line; std::getline(lines, line);) {
      std::istringstream words(line);
      std::string first, second, third;
      if (!(words >> first >> second)) continue;
      words >> third;
      if (line.starts_with("module "))
        module = second;
      else if (line.starts_with("  ") && third == "(" && !entity(first).empty())
        instances_[module].push_back(first);
    }
  }
  void count(const std::string& module, std::map<std::string, int>& units) const {
    const auto it = instances_.find(module);
    if (it == instances_.end()) return;
    for (const std::string& instance : it->second) {
      ++units[entity(instance)];
      count(instance, units);
    }
  }

 private:
  // GHDL adds the generics' values to a module's name.
  std::string entity(const std::string& module) const {
    std::string best;
    for (const std::string& name : entities_)
      if ((module == name || module.starts_with(name + "_")) && name.size() > best.size()) best = name;
    return best;
  }
  std::set<std::string> entities_;
  std::map<std::string, std::vector<std::string>> instances_;
};

Plan plan_of(const std::string& name, Shader shader, Preset preset) {
  const auto scene = load_scene(name, std::filesystem::path(HALFWAY_SOURCE_DIR) / "sim" / "scenes");
  EXPECT_TRUE(scene) << scene.error().message;
  const auto plan = plan_scene(*scene, {.shader = shader, .preset = preset});
  EXPECT_TRUE(plan) << plan.error().message;
  return *plan;
}

class HardwareUnits : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto tool = GhdlTool::find();
    ASSERT_TRUE(tool) << tool.error().message;
    const auto sources = read_rtl_sources(HALFWAY_SOURCE_DIR);
    ASSERT_TRUE(sources) << sources.error().message;
    for (const VhdlSource& source : *sources) entities_.insert(std::filesystem::path(source.name).stem());
    auto library = GhdlLibrary::for_synthesis(*tool, *sources,
                                              std::filesystem::path(HALFWAY_SOURCE_DIR) / "build" / "cache");
    ASSERT_TRUE(library) << library.error().message;
    library_.emplace(std::move(*library));
  }
  std::string netlist(const HardwareKey& key) const {
    const auto text = library_->synthesize(key.entity(), key.generics());
    EXPECT_TRUE(text) << text.error().message;
    return text ? *text : "";
  }
  std::map<std::string, int> found(const HardwareKey& key) {
    const auto [at, is_new] = found_.try_emplace(key.name());
    if (is_new) Netlist(netlist(key), entities_).count(key.entity(), at->second);
    return at->second;
  }

  std::set<std::string> entities_;
  std::optional<GhdlLibrary> library_;
  std::map<std::string, std::map<std::string, int>> found_;  ///< by the key's name
};

TEST_F(HardwareUnits, AreThoseOfTheNetlist) {
  std::vector<HardwareKey> keys;
  for (const Preset preset : {Preset::exact, Preset::published}) {
    const bool exact = preset == Preset::exact;
    const TableSize tables = exact ? TableSize{9, 8} : TableSize{6, 6};
    for (const unsigned channels : {1U, 3U}) {
      keys.push_back({.preset = preset, .channels = channels});
      const auto spherical = [&](SphericalUnits units) {
        units.tables = tables;
        if (!exact && units.powers != 0) units.powers = 2;
        keys.push_back(
            {.shader = Shader::spherical, .preset = preset, .channels = channels, .spherical = units});
      };
      spherical({});
      spherical({.lights = 1, .diffuse = true});
      spherical({.lights = 2, .specular = true, .powers = 16});
      spherical(
          {.lights = 3, .diffuse = true, .specular = true, .highlight_channels = channels, .powers = 22});
      const auto processors = [&](ProcessorUnits units) {
        for (const ProcessorForm form : {ProcessorForm::folded, ProcessorForm::unrolled}) {
          units.form = form;
          keys.push_back(
              {.shader = Shader::processors, .preset = preset, .channels = channels, .processors = units});
        }
      };
      if (channels == 1) {
        processors({});
        processors({.directional = 2, .diffuse = true});
        processors({.positional = 1, .specular = true, .normalize = true, .shadows = true});
      } else {
        processors({.directional = 1, .positional = 1, .spots = 1, .diffuse = true, .specular = true});
        processors({.spots = 1, .diffuse = true, .specular = true, .normalize = true, .shadows = true});
      }
    }
  }
  for (const HardwareKey& key : keys) EXPECT_EQ(found(key), hardware_units(key)) << key.name();
}

// Every built-in scene's, as called for and with all effects.
TEST_F(HardwareUnits, OfTheScenesProcessorsAreThoseOfTheNetlist) {
  std::map<std::string, HardwareKey> keys;
  int scenes = 0;
  const auto folder = std::filesystem::path(HALFWAY_SOURCE_DIR) / "sim" / "scenes";
  for (const auto& file : std::filesystem::directory_iterator(folder)) {
    if (file.path().extension() != ".toml") continue;
    ++scenes;
    for (const Preset preset : {Preset::exact, Preset::published}) {
      const Plan plan = plan_of(file.path().stem(), Shader::processors, preset);
      for (HardwareKey key : {plan.called_for, plan.everything})
        for (const ProcessorForm form : {ProcessorForm::folded, ProcessorForm::unrolled}) {
          key.processors.form = form;
          keys.emplace(key.name(), key);
        }
    }
  }
  EXPECT_GE(scenes, 6);
  for (const auto& [name, key] : keys) EXPECT_EQ(found(key), hardware_units(key)) << name;
}

TEST_F(HardwareUnits, WhatAPlanSaysOfAnEffectIsInTheNetlistOrIsNot) {
  for (const char* scene : {"matte", "spheres", "teapot"})
    for (const Shader shader : c_shaders)
      for (const Preset preset : {Preset::exact, Preset::published}) {
        const Plan plan = plan_of(scene, shader, preset);
        const auto here = found(plan.key);
        for (const PlannedEffect& e : plan.effects) {
          SCOPED_TRACE(plan.key.name() + ": " + to_string(e.effect));
          for (const auto& [unit, count] : e.units)
            EXPECT_TRUE(!e.elaborated || (here.contains(unit) && here.at(unit) >= count)) << unit;
          if (!e.other) continue;
          auto difference = found(e.elaborated ? plan.key : *e.other);
          for (const auto& [unit, count] : found(e.elaborated ? *e.other : plan.key))
            difference[unit] -= count;
          std::erase_if(difference, [](const auto& unit) { return unit.second == 0; });
          EXPECT_EQ(difference, e.units);
        }
      }
}

// No module, no instance, no ROM's word of what is not called for.
TEST_F(HardwareUnits, OfAnEffectNotCalledForAreNowhere) {
  const auto expect_none = [&](const HardwareKey& key, const std::vector<std::string>& entities) {
    const std::string text = netlist(key);
    for (const std::string& entity : entities) {
      EXPECT_EQ(text.find(entity), std::string::npos) << key.name() << " has a " << entity;
      EXPECT_FALSE(hardware_units(key).contains(entity)) << key.name();
    }
  };
  for (const Preset preset : {Preset::exact, Preset::published}) {
    const Plan matte = plan_of("matte", Shader::spherical, preset);
    expect_none(matte.key, {"specular", "quadratic"});
    EXPECT_EQ(hardware_units(matte.key).at("multiplier"), 1);
    EXPECT_NE(netlist(matte.everything).find("specular_slice"), std::string::npos);
    // Neither light nor reflection: nothing that illuminates.
    HardwareKey dark = matte.key;
    dark.spherical.lights = 0;
    dark.spherical.diffuse = false;
    expect_none(dark, {"specular", "diffuse", "cosine", "angle_address", "multiplier"});
    expect_none(plan_of("matte", Shader::quadratic, preset).key,
                {"specular", "diffuse", "cosine", "multiplier"});
    EXPECT_EQ(hardware_units(plan_of("matte", Shader::quadratic, preset).key).at("quadratic_interpolator"),
              1);

    // Grey, one light afar, no highlight: a processor for ambient light and one for the light.
    for (const ProcessorForm form : {ProcessorForm::folded, ProcessorForm::unrolled}) {
      HardwareKey key = plan_of("matte", Shader::processors, preset).called_for;
      key.processors.form = form;
      expect_none(key, {"power", "specular_", "shadow_counter", "object_stage", "spot_cone", "cosine_rom"});
      EXPECT_EQ(hardware_units(key).at(form == ProcessorForm::folded ? "shading_processor"
                                                                     : "unrolled_shading_processor"),
                2);
      // Published: version I, which has no unit vectors to make.
      if (preset == Preset::published)
        expect_none(key, {"reciprocal_root", "vector_shift", "function_rom", "unit_vector"});
      // They are looked for by names that are there with all effects.
      HardwareKey all = plan_of("matte", Shader::processors, preset).everything;
      all.processors.form = form;
      const std::string text = netlist(all);
      for (const char* entity :
           {"power", "shadow_counter", "object_stage", "spot_cone", "reciprocal_root", "function_rom"}) {
        EXPECT_NE(text.find(entity), std::string::npos) << all.name() << " has no " << entity;
        EXPECT_TRUE(hardware_units(all).contains(entity)) << all.name();
      }
    }
  }
}

}  // namespace
}  // namespace halfway
