// SPDX-License-Identifier: Apache-2.0
#include "plan/hardware_units.hpp"

#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "common/file.hpp"
#include "sim/ghdl/ghdl_library.hpp"

namespace halfway {
namespace {

// Instances of each entity below the netlist's top.
class Netlist {
 public:
  Netlist(const std::string& text, std::set<std::string> entities) : entities_(std::move(entities)) {
    static const std::regex c_module(R"(^module (\w+)\s*$)"), c_instance(R"(^  (\w+) (\w+) \(\s*$)");
    std::istringstream lines(text);
    std::string module;
    for (std::string line; std::getline(lines, line);) {
      std::smatch match;
      if (std::regex_match(line, match, c_module))
        module = match[1];
      else if (std::regex_match(line, match, c_instance) && !entity(match[1]).empty())
        instances_[module].push_back(match[1]);
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

TEST(HardwareUnits, AreThoseOfTheNetlist) {
  const auto tool = GhdlTool::find();
  ASSERT_TRUE(tool) << tool.error().message;
  const auto sources = read_rtl_sources(HALFWAY_SOURCE_DIR);
  ASSERT_TRUE(sources) << sources.error().message;
  std::set<std::string> entities;
  for (const VhdlSource& source : *sources) entities.insert(std::filesystem::path(source.name).stem());
  const auto library =
      GhdlLibrary::open(*tool, *sources, "", std::filesystem::path(HALFWAY_SOURCE_DIR) / "build" / "cache");
  ASSERT_TRUE(library) << library.error().message;
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
    }
  }
  for (const HardwareKey& key : keys) {
    const auto netlist = library->synthesize(key.entity(), key.generics());
    ASSERT_TRUE(netlist) << netlist.error().message;
    std::map<std::string, int> found;
    Netlist(*netlist, entities).count(key.entity(), found);
    EXPECT_EQ(found, hardware_units(key)) << key.name();
  }
}

}  // namespace
}  // namespace halfway
