// SPDX-License-Identifier: Apache-2.0
#include "sim/ghdl/ghdl_library.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <string_view>

#include "sim/ghdl/rtl_hash.hpp"
#include "sim/system/file.hpp"
#include "sim/system/subprocess.hpp"

namespace halfway {
namespace {

const std::vector<std::string> c_analysis_flags = {
    "--std=08", "-Wlibrary", "-Wdefault-binding", "-Wbinding", "-Wport", "-Wunused",
    "-Whide",   "-Wshared",  "-Wstatic",          "-Wuseless", "-Werror"};

constexpr std::chrono::minutes c_analysis_timeout{60};

Result<std::string> run_ghdl(Command command, const std::string& doing) {
  command.timeout = c_analysis_timeout;
  const auto end = run_process(command, c_install_ghdl);
  if (!end) return end.error();
  if (end->succeeded()) return end->output;
  return tool_failed(fmt::format(
      "{}: ghdl failed ({}):\n{}\n  while running: {}{}", doing, end->how(), end->output, to_string(command),
      room_note({command.working_folder, std::filesystem::temp_directory_path()})));
}

/// GHDL 2.0.0 omits the VHDL's `when others` in a Verilog `case`, and the Verilog does not show it. GHDL's
/// VHDL netlist does: accept only "X...X when others" after a full list of choices.
Status check_choices(const std::string& entity, std::string_view vhdl) {
  constexpr std::string_view c_mark = " when others;";
  for (std::size_t at = vhdl.find(c_mark); at != std::string_view::npos; at = vhdl.find(c_mark, at + 1)) {
    const std::size_t begin = vhdl.rfind('\n', at) + 1;
    const std::string_view value = vhdl.substr(begin, at - begin);
    if (value.find_first_not_of(" \"'X") == std::string_view::npos) continue;
    if (value.find(" downto 0 => 'X')") != std::string_view::npos) continue;
    const std::size_t where = vhdl.rfind("  -- ", at);
    const std::string_view place = vhdl.substr(where + 5, vhdl.find('\n', where) - where - 5);
    return tool_failed(
        fmt::format("{}: synthesis of {}: GHDL's Verilog omits `when others`; "
                    "write every choice out and 'X' under others, or if and elsif",
                    place, entity));
  }
  return Ok{};
}

/// The path build/cache/ghdl/<hash>, and the hash.
std::pair<std::filesystem::path, std::string> place_of(const char* kind, const GhdlTool& tool,
                                                       const std::vector<VhdlSource>& sources,
                                                       const std::string& top,
                                                       const std::filesystem::path& cache) {
  ContentHash hash;
  hash.add(kind).add(tool.version).add(top);
  for (const std::string& flag : c_analysis_flags) hash.add(flag);
  for (const VhdlSource& source : sources) hash.add(source.name).add(bare_vhdl(source.content));
  return {std::filesystem::absolute(cache) / "ghdl" / hash.hex(), hash.hex()};
}

/// Write the sources into the command's folder, append their names to the command and run it.
Result<std::string> run_on(Command command, const std::vector<VhdlSource>& sources,
                           bool vendor_cells = false) {
  command.arguments.insert(command.arguments.end(), c_analysis_flags.begin(), c_analysis_flags.end());
  if (vendor_cells) command.arguments.emplace_back("-Wno-default-binding");
  for (const VhdlSource& source : sources) {
    if (auto written = write_file(command.working_folder / source.name, source.content); !written)
      return written.error();
    command.arguments.push_back(source.name);
  }
  return run_ghdl(std::move(command), "analysis of the VHDL");
}

}  // namespace

Result<GhdlTool> GhdlTool::find(const std::string& program) {
  Command command{.arguments = {program, "--version"}, .timeout = std::chrono::minutes(5)};
  const auto end = run_process(command, c_install_ghdl);
  if (!end) return end.error();
  if (!end->succeeded()) {
    return tool_failed(fmt::format("{}: does not run ({}): {}; install it with: {}", program, end->how(),
                                   end->output, c_install_ghdl));
  }
  GhdlTool tool{GhdlBackEnd::mcode, end->output, program};
  if (end->output.find("llvm") != std::string::npos) tool.back_end = GhdlBackEnd::llvm;
  if (end->output.find("GCC") != std::string::npos) tool.back_end = GhdlBackEnd::gcc;
  return tool;
}

Result<VhdlSource> read_vhdl_source(const std::filesystem::path& source_folder, const std::string& name) {
  auto content = read_file(source_folder / name);
  if (!content) return tool_failed(content.error().message);
  return VhdlSource{name, std::move(*content)};
}

Result<std::vector<VhdlSource>> read_rtl_sources(const std::filesystem::path& source_folder,
                                                 const std::string& rtl_folder) {
  auto reader = LineReader::open(source_folder / rtl_folder / "files.f");
  if (!reader) return tool_failed(reader.error().message);
  std::vector<VhdlSource> sources;
  std::string_view line;
  while (true) {
    const auto next = reader->next(line);
    if (next == LineReader::Next::failed) return tool_failed(reader->error().message);
    if (next == LineReader::Next::end_of_file) return sources;
    if (line.empty() || line.front() == '#') continue;
    if (line.find("..") != std::string_view::npos || line.front() == '/') {
      return tool_failed(reader->at("not a path inside " + rtl_folder).message);
    }
    auto source = read_vhdl_source(source_folder, rtl_folder + "/" + std::string(line));
    if (!source) return source.error();
    sources.push_back(std::move(*source));
  }
}

Result<GhdlLibrary> GhdlLibrary::open(const GhdlTool& tool, const std::vector<VhdlSource>& sources,
                                      const std::string& top, const std::filesystem::path& cache) {
  // If folders are given as absolute names, GHDL's library file contains them. Run all commands inside the
  // folder instead.
  const auto [folder, hash] = place_of("ghdl library 3", tool, sources, top, cache);
  GhdlLibrary library(tool, folder, hash);
  if (std::filesystem::exists(folder)) return library;

  auto fresh = TemporaryFolder::make(folder.parent_path());
  if (!fresh) return fresh.error();
  const auto first_testbench = std::find_if(sources.begin(), sources.end(), [](const VhdlSource& source) {
    return !source.name.starts_with("rtl/");
  });
  auto first = sources.begin();
  if (first_testbench != sources.begin() && first_testbench != sources.end()) {
    const auto rtl = open(tool, {sources.begin(), first_testbench}, "", cache);
    if (!rtl) return rtl.error();
    std::error_code error;
    constexpr auto c_whole =
        std::filesystem::copy_options::recursive | std::filesystem::copy_options::overwrite_existing;
    std::filesystem::copy(rtl->folder(), fresh->path(), c_whole, error);
    if (error)
      return tool_failed(fmt::format("{}: cannot be copied: {}", rtl->folder().string(), error.message()));
    first = first_testbench;
  }
  Command analyse{.arguments = {tool.program, "-a"}, .working_folder = fresh->path()};
  if (tool.back_end != GhdlBackEnd::mcode) analyse.arguments.emplace_back("-O2");
  if (auto done = run_on(std::move(analyse), {first, sources.end()}); !done) return done.error();
  if (!top.empty() && tool.back_end != GhdlBackEnd::mcode) {
    Command elaborate{.arguments = {tool.program, "-e", "--std=08", top}, .working_folder = fresh->path()};
    if (auto done = run_ghdl(elaborate, "elaboration of " + top); !done) return done.error();
  }
  if (auto moved = fresh->move_to(folder); !moved) return moved.error();
  return library;
}

Result<GhdlLibrary> GhdlLibrary::for_synthesis(const GhdlTool& tool, const std::vector<VhdlSource>& sources,
                                               const std::filesystem::path& cache, bool vendor_cells) {
  const auto [folder, hash] = place_of("ghdl sources 2", tool, sources, "", cache);
  GhdlLibrary library(tool, folder, hash);
  for (const VhdlSource& source : sources) library.to_read_.push_back(source.name);
  if (std::filesystem::exists(folder)) return library;

  auto fresh = TemporaryFolder::make(folder.parent_path());
  if (!fresh) return fresh.error();
  // --synth does not print its own warnings.
  if (auto done =
          run_on({.arguments = {tool.program, "-s"}, .working_folder = fresh->path()}, sources, vendor_cells);
      !done)
    return done.error();
  if (auto moved = fresh->move_to(folder); !moved) return moved.error();
  return library;
}

Result<std::string> GhdlLibrary::synthesize(
    const std::string& entity, const std::vector<std::pair<std::string, std::string>>& generics) const {
  const auto files = netlists(entity, generics);
  if (!files) return files.error();
  return read_file(files->string() + ".v");
}

Result<std::string> GhdlLibrary::synthesize_vhdl(
    const std::string& entity, const std::vector<std::pair<std::string, std::string>>& generics) const {
  const auto files = netlists(entity, generics);
  if (!files) return files.error();
  return read_file(files->string() + ".vhd");
}

Result<std::filesystem::path> GhdlLibrary::netlists(
    const std::string& entity, const std::vector<std::pair<std::string, std::string>>& generics) const {
  ContentHash hash;
  hash.add("netlist 2").add(entity);
  for (const auto& [name, value] : generics) hash.add(name).add(value);
  const std::filesystem::path kept = folder_ / "netlists" / fmt::format("{}-{}", entity, hash.hex());
  const std::string verilog_file = kept.string() + ".v";
  if (std::filesystem::exists(verilog_file)) return kept;
  const auto netlist = [&](const std::string& language) -> Result<std::string> {
    // Standard output is written to a file, so that warnings on standard error do not get into the netlist.
    auto scratch = TemporaryFolder::make(folder_.parent_path());
    if (!scratch) return scratch.error();
    Command command{.arguments = {tool_.program, "--synth", "--std=08", "--no-formal", "--out=" + language},
                    .working_folder = folder_,
                    .standard_output = scratch->path() / "netlist"};
    for (const auto& [name, value] : generics)
      command.arguments.push_back(fmt::format("-g{}={}", name, value));
    command.arguments.insert(command.arguments.end(), to_read_.begin(), to_read_.end());
    if (!to_read_.empty()) command.arguments.emplace_back("-e");
    command.arguments.push_back(entity);
    if (auto done = run_ghdl(command, "synthesis of " + entity); !done) return done.error();
    return read_file(command.standard_output);
  };
  const auto vhdl = netlist("vhdl");
  if (!vhdl) return vhdl.error();
  if (auto sound = check_choices(entity, *vhdl); !sound) return sound.error();
  auto verilog = netlist("verilog");
  if (!verilog) return verilog.error();
  if (Status made = make_folders(kept.parent_path()); !made) return made.error();
  // The Verilog is written last: if it exists, both exist.
  for (const auto& [file, text] : {std::pair(kept.string() + ".vhd", *vhdl), {verilog_file, *verilog}})
    if (Status written = write_file(file, text); !written) return written.error();
  return kept;
}

std::vector<std::string> GhdlLibrary::run_arguments(const std::string& top) const {
  if (tool_.back_end == GhdlBackEnd::mcode) return {tool_.program, "-r", "--std=08", top};
  return {(folder_ / top).string()};
}

}  // namespace halfway
