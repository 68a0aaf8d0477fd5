// SPDX-License-Identifier: Apache-2.0
// Section with the hardware: block diagrams, the steps that make a fragment, and timing diagrams of a few
// clocks.
#include <fmt/format.h>

#include "sim/os/file.hpp"
#include "sim/report/html.hpp"
#include "sim/report/section.hpp"
#include "sim/report/timing_traces.hpp"

namespace halfway::report {
namespace {

struct ShaderPart {
  Shader shader;
  const char* title;
  const char* heading;  // of docs/rtl/<shader>.md
};
constexpr std::array c_parts = {
    ShaderPart{Shader::quadratic, "The quadratic shader", "From the init vector to a pixel"},
    ShaderPart{Shader::spherical, "The spherical shader", "From the line record to a pixel"},
    ShaderPart{Shader::processors, "The shading processors", "One term"},
};

// The text from a second-level heading to the next.
std::string under(const std::string& markdown, const std::string& heading,
                  const std::filesystem::path& file) {
  const std::string mark = "\n## " + heading + "\n";
  const std::size_t at = markdown.find(mark);
  if (at == std::string::npos) throw_bad_input("{}: has no heading '## {}'", file.string(), heading);
  const std::size_t begin = at + mark.size();
  return markdown.substr(begin, markdown.find("\n## ", begin) - begin);
}

}  // namespace

void add_hardware(Page& page) {
  const std::filesystem::path rtl = page.settings.folders.source / "rtl";
  Json& shaders = page.view["hardware"] = Json::array();
  for (const ShaderPart& part : c_parts) {
    const std::string name = to_string(part.shader);
    const auto diagram = must(read_file(rtl / "diagrams" / (name + ".svg")));
    const auto svg = inline_svg(diagram, name + "-",
                                fmt::format("{}: its entities, and what goes between them", part.title));
    const std::filesystem::path file = page.settings.folders.source / "docs/rtl" / (name + ".md");
    const auto text = must(read_file(file));
    const auto words = under(text, part.heading, file);
    Json& shader = shaders.emplace_back(Json{{"name", name},
                                             {"title", part.title},
                                             {"diagram", svg},
                                             {"words", from_markdown(words, part.title)},
                                             {"timing", nullptr}});
    if (!page.settings.timing) continue;
    page.settings.on_progress("timing: " + name);
    const auto timing = caught([&] { return draw_shader_timing(part.shader, page.settings.folders); });
    if (!timing) {
      if (timing.error().code != ExitCode::tool_failed) throw Failure{timing.error()};
      page.report.notes.push_back(fmt::format("no timing diagram of {}: {}", name, timing.error().message));
      continue;
    }
    shader["timing"] = {{"key", timing->key}, {"fragments", timing->words}, {"svgs", Json::array()}};
    for (std::size_t n = 0; n < timing->svgs.size(); ++n) {
      const std::string label = n == 0 ? fmt::format("The first clocks of two small triangles in {}: {}",
                                                     timing->key, timing->words)
                                       : "The clocks that follow";
      auto row = inline_svg(timing->svgs[n], fmt::format("{}-timing-{}-", name, n), label);
      shader["timing"]["svgs"].push_back(std::move(row));
    }
  }
}

}  // namespace halfway::report
