// SPDX-License-Identifier: Apache-2.0
// Compares the list of designs with rtl/ and with the thresholds.
#include "designs.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "evidence/thresholds.hpp"
#include "measure.hpp"
#include "sim/os/must.hpp"

namespace halfway::synth {
namespace {

const std::filesystem::path c_root = HALFWAY_SOURCE_DIR;

TEST(SynthDesigns, AreOfEveryEntityAndOfNoOther) {
  auto sources = must(read_rtl_sources(c_root));
  sources.push_back(must(read_vhdl_source(c_root, c_accumulator)));
  const std::regex entity(R"((?:^|\n)entity (\w+) is)");
  std::set<std::string> there, listed;
  for (const VhdlSource& source : sources)
    for (std::sregex_iterator it(source.content.begin(), source.content.end(), entity), end; it != end; ++it)
      there.insert((*it)[1]);
  for (const ListedDesign& design : all_designs(c_root)) listed.insert(design.design.entity);
  // These are measured inside the shading processors: a generic of record type has no value on GHDL's command
  // line.
  for (const char* inside :
       {"ambient_term",  "cosine_power",      "filter_queue",        "fragment_output",  "half_vector",
        "light_state",   "light_term",        "light_vector",        "light_weight",     "object_edges",
        "object_front",  "object_merge",      "object_output",       "object_processor", "object_source",
        "pixel_filter",  "radiance_sum",      "raster_interpolator", "reflected_term",   "shading_sequence",
        "shared_adder",  "shared_multiplier", "shared_normalizer",   "shared_weight",    "token_rasterizer",
        "token_register"})
    EXPECT_TRUE(listed.insert(inside).second) << inside;
  // These are measured inside fragments_to_memory.
  for (const char* in_memory : {"frame_fill", "block_address", "block_collector", "block_reader",
                                "block_source", "block_tester", "block_writer", "memory_port", "pixel_store"})
    EXPECT_TRUE(listed.insert(in_memory).second) << in_memory;
  EXPECT_THAT(listed, ::testing::ContainerEq(there));
  EXPECT_GT(there.size(), 30U);
}

TEST(SynthDesigns, TakeMultiplierBitsWhereTheEntityHasThisGeneric) {
  const std::regex entity(R"((?:^|\n)entity (\w+) is)");
  for (const VhdlSource& source : must(read_rtl_sources(c_root)))
    if (std::smatch found; std::regex_search(source.content, found, entity)) {
      const bool has_generic = source.content.find("g_multiplier_bits ") != std::string::npos;
      EXPECT_EQ(takes_multiplier_bits(found[1].str()), has_generic) << found[1];
    }
}

TEST(SynthDesigns, HaveThresholds) {
  const page::Thresholds thresholds = page::Thresholds::read(c_root);
  std::set<std::string> names;
  std::vector<page::Value> values;
  for (const ListedDesign& listed : all_designs(c_root)) {
    const std::string& name = listed.design.name;
    EXPECT_TRUE(names.insert(name).second) << name << ": a second design of this name";
    EXPECT_EQ(thresholds.numbers("clocks_ecp5", name).empty(), !listed.ecp5) << name;
    if (!listed.ice40) continue;
    EXPECT_FALSE(thresholds.numbers("cells", name).empty()) << name;
    values.push_back({"cells", name, {}});
  }
  EXPECT_THAT(thresholds.unmeasured(values), ::testing::IsEmpty());
}

TEST(SynthDesigns, HaveThePapersTimes) {
  EXPECT_EQ(published_ns("quadratic_shader_grey_exact"), 50);
  EXPECT_EQ(published_ns("spherical_shader_published"), 60);
  EXPECT_EQ(published_ns("shading_processor_diffuse_published"), 50);
  EXPECT_FALSE(published_ns("unrolled_shading_processor_diffuse_published"));
}

TEST(SynthDesigns, HaveTheHardwareOfTheirStoredClocks) {
  const ClockStore hx8k = must(read_clocks(c_root, c_ice40)), ecp5 = must(read_clocks(c_root, c_ecp5));
  for (const ListedDesign& listed : all_designs(c_root)) {
    const std::string &name = listed.design.name, hardware = hardware_text(listed.design);
    if (listed.ice40) {
      EXPECT_EQ(hx8k.at(name).hardware, hardware);
    }
    if (listed.ecp5) {
      EXPECT_EQ(ecp5.at(name).hardware, hardware);
    }
  }
}

TEST(SynthDesigns, HaveTheClocksOfThePage) {
  ClockStore hx8k = must(read_clocks(c_root, c_ice40));
  const ClockStore ecp5 = must(read_clocks(c_root, c_ecp5));
  EXPECT_THAT(performance_table(hx8k, ecp5), ::testing::HasSubstr("\n| `quadratic_shader_grey_exact` | "));
  EXPECT_THROW(performance_table(hx8k, {}), Failure);
  hx8k.at("accumulator_40").mhz = 0;
  EXPECT_THROW(performance_table(hx8k, ecp5), Failure);
}

}  // namespace
}  // namespace halfway::synth
