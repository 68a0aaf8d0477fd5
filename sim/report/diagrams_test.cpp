// SPDX-License-Identifier: Apache-2.0
// The block diagrams in rtl/diagrams must agree with the VHDL.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <set>

#include "plan/hardware_key.hpp"
#include "sim/os/file.hpp"
#include "sim/os/test/source_folder.hpp"

namespace halfway::report {
namespace {

using ::testing::ElementsAreArray;
using ::testing::IsSupersetOf;

const std::filesystem::path c_rtl = c_source_folder / "rtl";

std::set<std::string> found(const std::string& text, const char* pattern) {
  std::set<std::string> all;
  const std::regex expression(pattern);
  for (std::sregex_iterator it(text.begin(), text.end(), expression), end; it != end; ++it)
    all.insert((*it)[1]);
  return all;
}

// All entities instantiated in a top's hierarchy, including the top. The parts of a skewed entity and of a
// stream_register are not shown.
std::set<std::string> tree_of(const std::string& top) {
  static const std::map<std::string, std::filesystem::path> c_files = [] {
    std::map<std::string, std::filesystem::path> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(c_rtl))
      if (entry.path().extension() == ".vhd") files[entry.path().stem()] = entry.path();
    return files;
  }();
  std::set<std::string> tree;
  std::vector<std::string> open = {top};
  while (!open.empty()) {
    const std::string entity = open.back();
    open.pop_back();
    if (!tree.insert(entity).second) continue;
    if (entity.starts_with("skewed_") || entity == "stream_register") continue;
    for (const std::string& part : found(must(read_file(c_files.at(entity))), R"(entity work\.(\w+))"))
      open.push_back(part);
  }
  return tree;
}

class Diagram : public ::testing::TestWithParam<Shader> {
 protected:
  std::string name_ = to_string(GetParam());
  std::string dot_ = must(read_file(c_rtl / "diagrams" / (name_ + ".dot")));
  std::set<std::string> nodes_ = found(dot_, R"(\n\s*(\w+) \[[^\]]*label=)");
};
INSTANTIATE_TEST_SUITE_P(Of, Diagram, ::testing::ValuesIn(c_shaders),
                         [](const auto& shader) { return to_string(shader.param); });

TEST_P(Diagram, NamesTheEntitiesOfTheShader) {
  // Names of nodes and clusters. The part after __ is a role.
  std::set<std::string> shown = found(dot_, R"(\n\s*subgraph cluster_(\w+) \{)");
  for (const std::string& node : nodes_)
    if (!node.starts_with("port_")) shown.insert(node.substr(0, node.find("__")));
  EXPECT_THAT(shown, ElementsAreArray(tree_of(name_ + "_shader")));
}

TEST_P(Diagram, LinksConnectItsNodes) {
  for (const char* end : {R"(-> (\w+))", R"((\w+) ->)"}) EXPECT_THAT(nodes_, IsSupersetOf(found(dot_, end)));
}

TEST_P(Diagram, IsDrawnFromItsText) {
  const std::string svg = must(read_file(c_rtl / "diagrams" / (name_ + ".svg")));
  // Check each line of a label, in the label formats of all Graphviz versions.
  for (const std::string& label : found(dot_, R"re(label="([^"]*)")re"))
    for (std::size_t at = 0; at != std::string::npos;) {
      const std::size_t end = label.find("\\n", at);
      std::string line = label.substr(at, end == std::string::npos ? end : end - at);
      line = std::regex_replace(line, std::regex("'"), "&#39;");
      line = std::regex_replace(line, std::regex("^  "), " &#160;");
      EXPECT_NE(svg.find('>' + line + '<'), std::string::npos) << line << ": run make diagrams";
      at = end == std::string::npos ? end : end + 2;
    }
  for (const std::string& node : nodes_)
    EXPECT_NE(svg.find("<title>" + node + "</title>"), std::string::npos) << node << ": run make diagrams";
  const auto count = [](const std::string& text, const std::regex& word) {
    return std::distance(std::sregex_iterator(text.begin(), text.end(), word), {});
  };
  EXPECT_EQ(count(svg, std::regex("class=\"edge\"")), count(dot_, std::regex(" -> ")));
}

}  // namespace
}  // namespace halfway::report
