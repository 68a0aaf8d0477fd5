// SPDX-License-Identifier: Apache-2.0
#include "sim/synth/pinned.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>
#include <string_view>

#include "common/to_integer.hpp"
#include "sim/system/file.hpp"

namespace halfway::synth {
namespace {

// Start of a line with the flow that the clocks were made with.
constexpr std::string_view c_flow = "flow ";
constexpr std::string_view c_written_by = "\n# Written by `", c_written_with = "` with ";

bool is_hash(std::string_view text) {
  constexpr std::size_t c_digits = 32;
  return text.size() == c_digits && text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

// `command` is the command that writes the file. `notes` are comment lines on how the pins are checked.
Status write(const std::filesystem::path& path, const Pins& pins, const std::string& versions,
             std::string_view command, const std::string& notes) {
  std::string text = fmt::format(
      "# Cells of each design on an iCE40 by itself, and its clock on an HX8K with registered ports, median "
      "seed.{}{}{}{}.\n{}{}\n{}"
      "# name luts carries flip_flops rams mhz netlist, and of how many seeds the clock is where not of {}\n",
      c_written_by, command, c_written_with, versions, c_flow, flow_hash(), notes, c_seeds);
  for (const auto& [name, pin] : pins) {
    text += fmt::format("{} {} {} {} {} {:.1f}", name, pin.cells.luts, pin.cells.carries,
                        pin.cells.flip_flops, pin.cells.rams, pin.mhz);
    if (!pin.netlist.empty()) text += " " + pin.netlist;
    if (!pin.netlist.empty() && pin.mhz > 0 && pin.seeds != c_seeds) text += fmt::format(" {}", pin.seeds);
    text += '\n';
  }
  return write_file(path, text);
}

bool read_seeds(const std::string& word, unsigned& seeds) {
  const char* const end = word.data() + word.size();
  const auto [read, error] = std::from_chars(word.data(), end, seeds);
  return error == std::errc() && read == end && seeds > 0;
}

}  // namespace

Result<Pins> read_pins(const std::filesystem::path& path) {
  auto reader = LineReader::open(path);
  if (!reader) return reader.error();
  Pins pins;
  bool same_flow = false;
  std::string_view line;
  for (auto next = reader->next(line); next != LineReader::Next::end_of_file; next = reader->next(line)) {
    if (next == LineReader::Next::failed) return reader->error();
    if (line.empty() || line.front() == '#') continue;
    if (line.starts_with(c_flow) && is_hash(line.substr(c_flow.size()))) {
      same_flow = line.substr(c_flow.size()) == flow_hash();
      continue;
    }
    std::istringstream words{std::string(line)};
    std::string name, seeds, more;
    Pin pin;
    Ice40Cells& cells = pin.cells;
    words >> name >> cells.luts >> cells.carries >> cells.flip_flops >> cells.rams >> pin.mhz;
    const bool figures = !words.fail();
    words >> pin.netlist >> seeds;
    if (!figures || words >> more || !(pin.netlist.empty() || is_hash(pin.netlist)) ||
        !(seeds.empty() || read_seeds(seeds, pin.seeds)))
      return reader->at(
          "not a name, four numbers of cells, a clock, a netlist's hash and a number of seeds; write the "
          "file again "
          "with make synth PIN=1, or make study PLACE=1 PIN=1");
    pin.line = reader->line_number();
    if (!pins.emplace(name, pin).second) return reader->at("a second line of this name");
  }
  if (!same_flow)
    for (auto& [name, pin] : pins) pin.netlist.clear();
  return pins;
}

Result<std::string> pin_versions(const std::filesystem::path& path) {
  const auto text = read_file(path);
  if (!text) return text.error();
  const std::size_t written = text->find(c_written_by), at = text->find(c_written_with, written);
  if (written == std::string::npos || at == std::string::npos) return std::string();
  const std::size_t begin = at + c_written_with.size();
  std::string versions = text->substr(begin, text->find('\n', begin) - begin);
  if (versions.ends_with('.')) versions.pop_back();
  return versions;
}

Status write_pins(const std::filesystem::path& path, const Pins& pins, const std::string& versions) {
  return write(path, pins, versions, "make synth PIN=1",
               fmt::format("# `make synth` and ctest -R synth fail where flip-flops or RAMs differ, LUTs or "
                           "carries by more than {:.0f} %\n"
                           "# (and {}), or where the clock is more than {:.0f} % slower or faster.\n",
                           100 * c_lut_share, c_lut_slack, 100 * c_clock_share));
}

Status write_study_pins(const std::filesystem::path& path, const Pins& pins, const std::string& versions) {
  return write(
      path, pins, versions, "make study PLACE=1 PIN=1",
      "# `make study` takes them where its hardware has the netlist; 0 MHz: nextpnr has no placement of "
      "it.\n");
}

std::optional<int> published_ns(std::string_view design) {
  if (design.starts_with("quadratic_shader_")) return 50;
  if (design.starts_with("spherical_shader_")) return 60;
  if (design.starts_with("shading_processor_")) return 50;
  return {};
}

Result<std::string> readme_clocks(const Pins& pins) {
  const auto placed = [&](const char* name) -> Result<Pin> {
    const auto found = pins.find(name);
    if (found == pins.end() || found->second.mhz == 0)
      return bad_input(
          fmt::format("{}: {}: not pinned with a clock; docs/performance.md shows it", c_pins, name));
    return found->second;
  };
  constexpr const char* c_shaders[] = {"quadratic_shader_grey_published", "quadratic_shader_grey_exact",
                                       "quadratic_shader_published",      "spherical_shader_grey_published",
                                       "spherical_shader_published",      "spherical_shader_grey_exact",
                                       "spherical_shader_exact"};
  std::string text =
      "| design | LUTs | flip-flops | RAMs | clock, MHz | ns per pixel | paper, ns |\n"
      "| --- | --- | --- | --- | --- | --- | --- |\n";
  unsigned fewest = ~0U, most = 0;
  const auto count_seeds = [&](const Pin& pin) {
    fewest = std::min(fewest, pin.seeds);
    most = std::max(most, pin.seeds);
  };
  for (const char* shader : c_shaders) {
    const auto pin = placed(shader);
    if (!pin) return pin.error();
    count_seeds(*pin);
    text += fmt::format("| `{}` | {} | {} | {} | {:.0f} | {:.1f} | {} |\n", shader, pin->cells.luts,
                        pin->cells.flip_flops, pin->cells.rams, pin->mhz, 1000 / pin->mhz,
                        published_ns(shader).value());
  }
  constexpr const char* c_diffuse = "shading_processor_diffuse_published";
  const auto diffuse = placed(c_diffuse), specular = placed("shading_processor_specular_published"),
             sum_24 = placed("accumulator_24"), sum_40 = placed("accumulator_40");
  for (const Result<Pin>* pin : {&diffuse, &specular, &sum_24, &sum_40})
    if (*pin)
      count_seeds(**pin);
    else
      return pin->error();
  const std::string seeds = fewest == most ? std::to_string(most) : fmt::format("{} to {}", fewest, most);
  return text +
         fmt::format(
             "\nA clock is the median of {} seeds. A single 24-bit adder reaches {:.0f} MHz, a 40-bit adder "
             "{:.0f} MHz. One folded shading processor of\npreset `published` reaches {:.1f} MHz "
             "(diffuse) and {:.1f} MHz (specular): {:.1f} ns per clock. The paper has {} ns.\n",
             seeds, sum_24->mhz, sum_40->mhz, diffuse->mhz, specular->mhz,
             1000 / std::min(diffuse->mhz, specular->mhz), published_ns(c_diffuse).value());
}

std::string compare(const std::string& name, const Pins& pins, const Ice40Cells& cells,
                    std::optional<double> mhz) {
  const std::string how = fmt::format("make synth DESIGN={} PIN=1", name);
  const auto found = pins.find(name);
  if (found == pins.end()) return fmt::format("{}: {}: nothing is pinned; {} pins it\n", c_pins, name, how);
  const Pin& pin = found->second;
  std::string wrong;
  const auto differs = [&](const std::string& what) {
    wrong += fmt::format("{}:{}: {}: {}; {} pins what it is now\n", c_pins, pin.line, name, what, how);
  };
  const auto exactly = [&](const char* what, std::uint64_t is, std::uint64_t was) {
    if (is != was) differs(fmt::format("{} {}, {} are pinned", is, what, was));
  };
  const auto about = [&](const char* what, std::uint64_t is, std::uint64_t was) {
    const auto slack =
        std::max(c_lut_slack, to_integer<std::uint64_t>(std::floor(c_lut_share * static_cast<double>(was))));
    if (is > was + slack || is + slack < was)
      differs(fmt::format("{} {}, {} are pinned, and {} more or fewer may be", is, what, was, slack));
  };
  about("LUTs", cells.luts, pin.cells.luts);
  about("carries", cells.carries, pin.cells.carries);
  exactly("flip-flops", cells.flip_flops, pin.cells.flip_flops);
  exactly("RAMs", cells.rams, pin.cells.rams);
  if (!mhz) return wrong;
  if (*mhz > 0 && pin.mhz == 0)
    differs(fmt::format("{:.1f} MHz, and no clock is pinned", *mhz));
  else if (*mhz == 0 && pin.mhz > 0)
    differs(fmt::format("no clock, {:.1f} MHz are pinned", pin.mhz));
  else if (std::fabs(*mhz - pin.mhz) > c_clock_share * pin.mhz)
    differs(fmt::format("{:.1f} MHz, {:.1f} are pinned, and {:.0f} % {} is not within tolerance", *mhz,
                        pin.mhz, 100 * std::fabs(*mhz / pin.mhz - 1), *mhz < pin.mhz ? "slower" : "faster"));
  return wrong;
}

}  // namespace halfway::synth
