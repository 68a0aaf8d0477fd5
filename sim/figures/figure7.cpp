// SPDX-License-Identifier: Apache-2.0
#include "sim/figures/figure7.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <sstream>

namespace halfway::figures {

using golden::Published;

const HardwareKey& figure7_key() {
  static const HardwareKey key{.preset = Preset::published, .channels = 1, .probe = true};
  return key;
}

Result<Figure7> read_figure7(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in.is_open()) return bad_input(file.string() + ": cannot be opened");
  Figure7 figure;
  for (std::string text; std::getline(in, text);) {
    if (text.empty() || text[0] == '#') continue;
    std::istringstream fields(text);
    std::string kind, name;
    fields >> kind >> name >> std::hex;
    TraceWords words;
    for (std::uint32_t word = 0; fields >> word;) words.push_back(word);
    const Error bad = bad_input(fmt::format("{}: cannot be read: {}", file.string(), text));
    if (!fields.eof() || words.empty()) return bad;
    if (kind == "step" && words.size() == 1)
      figure.step[name] = words.front();
    else if (kind == "line" || kind == "pixel")
      (kind == "line" ? figure.line : figure.pixel)[name] = words;
    else
      return bad;
  }
  return figure;
}

std::array<std::uint32_t, Figure7Shader::c_init_words> figure7_init(const Figure7& figure) {
  using At = Published::init_header_at;
  using ChannelAt = Published::init_channel_at;
  constexpr std::uint64_t c_one = std::uint64_t{1} << Published::c_edge_x_fraction_bits;
  std::array<std::uint32_t, Figure7Shader::c_init_words> init{};
  golden::set_bits(init, At::triangle, c_figure7_triangle);
  golden::set_bits(init, At::y, c_figure7_y);
  golden::set_bits(init, At::upper_lines, c_figure7_lines);
  golden::set_bits(init, At::start_x, c_figure7_x * c_one);
  golden::set_bits(init, At::start_slope, 0);
  golden::set_bits(init, At::upper_x, c_figure7_x * c_one);
  golden::set_bits(init, At::upper_slope, c_one);
  const auto put = [&](const golden::Field& field, std::uint32_t word) {
    golden::set_bits(init, field, word, Published::c_init_header_bits);
  };
  put(ChannelAt::value, figure.line.at("I_start").at(0));
  put(ChannelAt::dx, figure.line.at("dI(X_start)").at(0));
  put(ChannelAt::de0, figure.line.at("dI_start").at(0));
  put(ChannelAt::dxx, figure.step.at("dI(X,Y)"));
  put(ChannelAt::dxe0, figure.step.at("dI(X_start)"));
  put(ChannelAt::de0e0, figure.step.at("dI_start"));
  return init;
}

void Figure7Trace::add(std::span<const std::uint32_t> probe, std::span<const std::uint32_t> unknown,
                       std::uint64_t clock) {
  using At = Published::probe_header_at;
  using ChannelAt = Published::probe_channel_at;
  const auto read = [&](const golden::Field& field, int low) {
    if (!unknown.empty() && golden::get_bits(unknown, field, low) != 0) known = false;
    return static_cast<std::uint32_t>(golden::get_bits(probe, field, low));
  };
  const auto channel = [&](const golden::Field& field) {
    return read(field, Published::c_probe_header_bits);
  };
  const auto header = [&](const golden::Field& field) { return read(field, 0); };
  if (header(At::line_event) != 0) {
    line["dI_start"].push_back(channel(ChannelAt::line_de0));
    line["I_start"].push_back(channel(ChannelAt::line_value));
    line["dI(X_start)"].push_back(channel(ChannelAt::line_dx));
    line_clock.push_back(clock);
  }
  if (header(At::span_event) != 0) {
    pixel["dI(X,Y)"].push_back(channel(ChannelAt::span_dx));
    pixel["I(X,Y)"].push_back(channel(ChannelAt::span_value));
    pixel_x.push_back(header(At::span_x));
    pixel_y.push_back(header(At::span_y));
    pixel_clock.push_back(clock);
  }
}

Figure7Trace golden_figure7(const Figure7& figure) {
  struct Watch {
    Figure7Trace* trace;
    void line(const Figure7Shader& shader) const { trace->add(shader.line_probe(), {}, 0); }
    void span(const Figure7Shader& shader, golden::SpanXWord x) const {
      trace->add(shader.span_probe(x), {}, 0);
    }
  };
  Figure7Trace trace;
  Figure7Shader shader;
  shader.draw(
      figure7_init(figure), [](const Fragment&) {}, Watch{&trace});
  return trace;
}

std::string hexadecimal(std::span<const std::uint32_t> words, std::size_t most) {
  std::string text;
  for (const std::uint32_t word : words.first(std::min(most, words.size())))
    text += fmt::format("{}{:08X}", text.empty() ? "" : " ", word);
  return text;
}

}  // namespace halfway::figures
