// SPDX-License-Identifier: Apache-2.0
#include "sim/figures/figure7.hpp"

#include <fmt/format.h>

#include <sstream>
#include <string_view>

#include "sim/os/file.hpp"
#include "sim/os/must.hpp"
#include "sim/run/stage_trace.hpp"

namespace halfway::figures {

using words::Published;

const HardwareKey& figure7_key() {
  static const HardwareKey c_key{.preset = Preset::published, .channels = 1};
  return c_key;
}

Figure7 read_figure7(const std::filesystem::path& file) {
  std::istringstream in(must(read_file(file)));
  Figure7 figure;
  for (std::string text; std::getline(in, text);) {
    if (text.empty() || text[0] == '#') continue;
    std::istringstream fields(text);
    std::string kind, name;
    fields >> kind >> name >> std::hex;
    TraceWords words;
    std::vector<bool> restored;
    for (std::uint32_t word = 0; fields >> word;) {
      words.push_back(word);
      restored.push_back(fields.peek() == '=');
      if (std::string in_scan; restored.back()) fields >> in_scan;
    }
    const bool is_step = kind == "step" && words.size() == 1;
    if (!fields.eof() || words.empty() || !(is_step || kind == "line" || kind == "pixel"))
      throw_bad_input("{}: cannot be read: {}", file.string(), text);
    if (is_step)
      figure.step[name] = words.front();
    else
      (kind == "line" ? figure.line : figure.pixel)[name] = words, figure.restored[name] = restored;
  }
  return figure;
}

std::string Figure7::published(const std::string& name) const {
  std::string text;
  for (std::size_t i = 0; i < words(name).size(); ++i)
    text += fmt::format("{}{}{:08X}{}", i == 0 ? "" : " ", restored.at(name)[i] ? "[" : "", words(name)[i],
                        restored.at(name)[i] ? "]" : "");
  return text;
}

std::array<std::uint32_t, Figure7Shader::c_init_words> figure7_init(const Figure7& figure) {
  using At = Published::init_header_at;
  using ChannelAt = Published::init_channel_at;
  constexpr std::uint64_t c_one = std::uint64_t{1} << Published::c_edge_x_fraction_bits;
  std::array<std::uint32_t, Figure7Shader::c_init_words> init{};
  words::set_bits(init, At::triangle, c_figure7_triangle);
  words::set_bits(init, At::y, c_figure7_y);
  words::set_bits(init, At::upper_lines, c_figure7_lines);
  words::set_bits(init, At::start_x, c_figure7_x * c_one);
  words::set_bits(init, At::start_slope, 0);
  words::set_bits(init, At::upper_x, c_figure7_x * c_one);
  words::set_bits(init, At::upper_slope, c_one);
  const auto put = [&](const words::Field& field, std::uint32_t word) {
    words::set_bits(init, field, word, Published::c_init_header_bits);
  };
  put(ChannelAt::value, figure.line.at("I_start").at(0));
  put(ChannelAt::dx, figure.line.at("dI(X_start)").at(0));
  put(ChannelAt::de0, figure.line.at("dI_start").at(0));
  put(ChannelAt::dxx, figure.step.at("dI(X,Y)"));
  put(ChannelAt::dxe0, figure.step.at("dI(X_start)"));
  put(ChannelAt::de0e0, figure.step.at("dI_start"));
  return init;
}

namespace {

// Append a line or a pixel: the registers of the stage. One without a value sets `known` to false.
void add(Figure7Trace& trace, const Stage& stage, std::span<const std::optional<std::uint64_t>> words) {
  const auto word = [&](std::string_view name) {
    const auto at = std::ranges::find(stage.words, name, &StageWord::name) - stage.words.begin();
    const auto& value = words[static_cast<std::size_t>(at)];
    if (!value) trace.known = false;
    return static_cast<std::uint32_t>(value.value_or(0));
  };
  if (stage.name == "line") {
    trace.line["dI_start"].push_back(word("grey edge_de0"));
    trace.line["I_start"].push_back(word("grey edge_value"));
    trace.line["dI(X_start)"].push_back(word("grey edge_dx"));
  } else if (stage.name == "span") {
    trace.pixel["dI(X,Y)"].push_back(word("grey span_dx"));
    trace.pixel["I(X,Y)"].push_back(word("grey span_value"));
    trace.pixel_x.push_back(word("span_x"));
    trace.pixel_y.push_back(word("span_y"));
  }
}

}  // namespace

Figure7Trace golden_figure7(const Figure7& figure) {
  const auto stages = make_stages(figure7_key());
  Figure7Trace trace;
  for (const GoldenEvent& event : stages->draw(figure7_init(figure)))
    add(trace, stages->stages()[event.stage],
        std::vector<std::optional<std::uint64_t>>(event.words.begin(), event.words.end()));
  return trace;
}

Figure7Trace rtl_figure7(const Figure7& figure, const SimulatorFolders& folders) {
  const auto stages = make_stages(figure7_key());
  const auto init = figure7_init(figure);
  const auto rtl = trace_stages(figure7_key(), *stages, folders,
                                {Figure7Shader::c_init_bits, {init.begin(), init.end()}}, c_figure7_pixels);
  if (!rtl.fault.empty()) throw Failure{{ExitCode::differs, rtl.fault}};
  Figure7Trace trace;
  for (std::size_t stage = 0; stage < rtl.events.size(); ++stage)
    for (const RtlEvent& event : rtl.events[stage]) {
      add(trace, stages->stages()[stage], event.words);
      if (stage < 2) (stage == 0 ? trace.line_clock : trace.pixel_clock).push_back(event.cycle);
    }
  return trace;
}

std::string hexadecimal(std::span<const std::uint32_t> words) {
  std::string text;
  for (const std::uint32_t word : words) text += fmt::format("{}{:08X}", text.empty() ? "" : " ", word);
  return text;
}

}  // namespace halfway::figures
