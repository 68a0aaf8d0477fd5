// SPDX-License-Identifier: Apache-2.0
#include "sim/engines/ghdl/ghdl_library.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string_view>

#include "sim/os/file.hpp"
#include "sim/os/shared_library.hpp"

namespace halfway {
namespace {

const std::vector<std::string> c_analysis_flags = {
    "--std=08", "-Wlibrary", "-Wdefault-binding", "-Wbinding", "-Wport", "-Wunused",
    "-Whide",   "-Wshared",  "-Wstatic",          "-Wuseless", "-Werror"};

/// GHDL 2 omits the VHDL's `when others` in a Verilog `case`, and the Verilog does not show it. GHDL's VHDL
/// netlist does: accept only "X...X when others" after a full list of choices. Later versions print
/// `default`.
void check_choices(const std::string& entity, std::string_view vhdl, std::string_view verilog) {
  if (verilog.find("default:") != std::string_view::npos) return;
  constexpr std::string_view c_mark = " when others;";
  for (std::size_t at = vhdl.find(c_mark); at != std::string_view::npos; at = vhdl.find(c_mark, at + 1)) {
    const std::size_t begin = vhdl.rfind('\n', at) + 1;
    const std::string_view value = vhdl.substr(begin, at - begin);
    if (value.find_first_not_of(" \"'X") == std::string_view::npos) continue;
    if (value.find(" downto 0 => 'X')") != std::string_view::npos) continue;
    const std::size_t where = vhdl.rfind("  -- ", at);
    const std::string_view place = vhdl.substr(where + 5, vhdl.find('\n', where) - where - 5);
    throw_tool_failed(
        "{}: synthesis of {}: GHDL's Verilog omits `when others`; "
        "write every choice out and 'X' under others, or if and elsif",
        place, entity);
  }
}

/// The path build/cache/ghdl/<hash>, and the hash.
std::pair<std::filesystem::path, std::string> place_of(const std::string& kind, const GhdlTool& tool,
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
void run_on(Command command, const std::vector<VhdlSource>& sources, bool vendor_cells = false) {
  command.arguments.insert(command.arguments.end(), c_analysis_flags.begin(), c_analysis_flags.end());
  if (vendor_cells) command.arguments.emplace_back("-Wno-default-binding");
  for (const VhdlSource& source : sources) {
    must(write_file(command.working_folder / source.name, source.content));
    command.arguments.push_back(source.name);
  }
  must(run_tool(std::move(command), c_install_ghdl, "analysis of the VHDL"));
}

// GHDL 2 loses bits when it moves memory (steady_memory.cpp).
std::vector<std::pair<std::string, std::string>> synthesis_environment(
    [[maybe_unused]] const GhdlTool& tool) {
#ifdef HALFWAY_STEADY_MEMORY
  if (tool.version.starts_with("GHDL 2.")) return {{"LD_PRELOAD", HALFWAY_STEADY_MEMORY}};
#endif
  return {};
}

}  // namespace

std::string bare_vhdl(std::string_view text) {
  std::string bare;
  // Skips text up to and with `end`, and returns it.
  const auto take = [&text](std::string_view end, std::size_t from) {
    const std::size_t found = text.find(end, from);
    const std::string_view taken =
        text.substr(0, found == std::string_view::npos ? text.size() : found + end.size());
    text.remove_prefix(taken.size());
    return taken;
  };
  const auto separate = [&bare] {
    if (!bare.empty() && bare.back() != ' ') bare += ' ';
  };
  while (!text.empty()) {
    const char c = text.front();
    if (c == '"' || c == '\\') {  // a string, an extended identifier
      bare += take(text.substr(0, 1), 1);
    } else if (c == '\'' && text.size() > 2 && text[2] == '\'') {
      bare += take("'", 1);
    } else if (text.starts_with("--") || text.starts_with("/*")) {
      take(c == '-' ? "\n" : "*/", 2);
      separate();
    } else {
      if (std::isspace(static_cast<unsigned char>(c)) != 0)
        separate();
      else
        bare += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
      text.remove_prefix(1);
    }
  }
  return bare;
}

Result<std::string> rtl_hash(const std::filesystem::path& source_folder) {
  const auto sources = read_rtl_sources(source_folder);
  if (!sources) return sources.error();
  ContentHash hash;
  for (const VhdlSource& source : *sources) hash.add(source.name).add(bare_vhdl(source.content));
  return hash.hex();
}

Result<GhdlTool> GhdlTool::find() {
  Command command{.arguments = {"ghdl", "--version"}, .timeout = std::chrono::minutes(5)};
  const auto end = run_process(command, c_install_ghdl);
  if (!end) return end.error();
  if (!end->succeeded())
    return tool_failed(fmt::format("ghdl: does not run ({}): {}; install it with: {}", end->how(),
                                   end->output, c_install_ghdl));
  const auto says = [&](const char* back_end) { return end->output.find(back_end) != std::string::npos; };
  return GhdlTool{says("llvm") || says("GCC"), end->output};
}

Result<VhdlSource> read_vhdl_source(const std::filesystem::path& source_folder, const std::string& name) {
  auto content = read_file(source_folder / name);
  if (!content) return tool_failed(content.error().message);
  return VhdlSource{name, std::move(*content)};
}

Result<std::vector<VhdlSource>> read_rtl_sources(const std::filesystem::path& source_folder,
                                                 const std::string& rtl_folder) try {
  auto reader = must(LineReader::open(source_folder / rtl_folder / "files.f"));
  std::vector<VhdlSource> sources;
  for (std::string_view line; must(reader.next(line));) {
    if (line.empty() || line.front() == '#') continue;
    if (line.find("..") != std::string_view::npos || line.front() == '/')
      return tool_failed(reader.at("not a path inside " + rtl_folder).message);
    sources.push_back(must(read_vhdl_source(source_folder, rtl_folder + "/" + std::string(line))));
  }
  return sources;
} catch (const Failure& failure) {
  return tool_failed(failure.error.message);
}

Result<GhdlLibrary> GhdlLibrary::open(const GhdlTool& tool, const std::vector<VhdlSource>& sources,
                                      const std::string& top, const std::filesystem::path& cache) try {
  const std::string level = optimization("-O2");
  // If folders are given as absolute names, GHDL's library file contains them. Run all commands inside the
  // folder instead.
  const auto [folder, hash] = place_of("ghdl library 3 " + level, tool, sources, top, cache);
  make_once(folder, [&](const std::filesystem::path& fresh) {
    const auto first_testbench = std::find_if(sources.begin(), sources.end(), [](const VhdlSource& source) {
      return !source.name.starts_with("rtl/");
    });
    auto first = sources.begin();
    if (first_testbench != sources.begin() && first_testbench != sources.end()) {
      const auto rtl = must(open(tool, {sources.begin(), first_testbench}, "", cache));
      std::error_code error;
      constexpr auto c_whole =
          std::filesystem::copy_options::recursive | std::filesystem::copy_options::overwrite_existing;
      std::filesystem::copy(rtl.folder(), fresh, c_whole, error);
      if (error) throw_tool_failed("{}: cannot be copied: {}", rtl.folder().string(), error.message());
      first = first_testbench;
    }
    Command analyse{.arguments = {tool.program, "-a"}, .working_folder = fresh};
    if (tool.makes_program) analyse.arguments.push_back(level);
    run_on(std::move(analyse), {first, sources.end()});
    if (!top.empty() && tool.makes_program)
      must(run_tool({.arguments = {tool.program, "-e", "--std=08", top}, .working_folder = fresh},
                    c_install_ghdl, "elaboration of " + top));
  });
  return GhdlLibrary(tool, folder, hash);
} catch (const Failure& failure) {
  return failure.error;
}

Result<GhdlLibrary> GhdlLibrary::for_synthesis(const GhdlTool& tool, const std::vector<VhdlSource>& sources,
                                               const std::filesystem::path& cache, bool vendor_cells) try {
  const auto [folder, hash] = place_of("ghdl sources 2", tool, sources, "", cache);
  GhdlLibrary library(tool, folder, hash);
  for (const VhdlSource& source : sources) library.to_read_.push_back(source.name);
  // --synth does not print its own warnings.
  make_once(folder, [&](const std::filesystem::path& fresh) {
    run_on({.arguments = {tool.program, "-s"}, .working_folder = fresh}, sources, vendor_cells);
  });
  return library;
} catch (const Failure& failure) {
  return failure.error;
}

Result<std::string> GhdlLibrary::synthesize(const std::string& entity, const Generics& generics) const {
  return caught([&] { return netlist(entity, generics, ".v"); });
}

Result<std::string> GhdlLibrary::synthesize_vhdl(const std::string& entity, const Generics& generics) const {
  return caught([&] { return netlist(entity, generics, ".vhd"); });
}

std::string GhdlLibrary::netlist(const std::string& entity, const Generics& generics,
                                 const std::string& ending) const {
  ContentHash hash;
  hash.add("netlist 3").add(entity);
  for (const auto& [name, value] : generics) hash.add(name).add(value);
  const std::string kept = (folder_ / "netlists" / fmt::format("{}-{}", entity, hash.hex())).string();
  // The Verilog is written last: if it exists, both exist.
  if (std::filesystem::exists(kept + ".v")) return must(read_file(kept + ending));
  const auto synthesized = [&](const std::string& language) {
    // Standard output is written to a file, so that warnings on standard error do not get into the netlist.
    const TemporaryFolder scratch = must(TemporaryFolder::make(folder_.parent_path()));
    Command command{.arguments = {tool_.program, "--synth", "--std=08", "--no-formal", "--out=" + language},
                    .working_folder = folder_,
                    .standard_output = scratch.path() / "netlist",
                    .environment = synthesis_environment(tool_)};
    for (const auto& [name, value] : generics)
      command.arguments.push_back(fmt::format("-g{}={}", name, value));
    command.arguments.insert(command.arguments.end(), to_read_.begin(), to_read_.end());
    if (!to_read_.empty()) command.arguments.emplace_back("-e");
    command.arguments.push_back(entity);
    must(run_tool(command, c_install_ghdl, "synthesis of " + entity));
    return must(read_file(command.standard_output));
  };
  const std::string vhdl = synthesized("vhdl");
  const std::string verilog = synthesized("verilog");
  check_choices(entity, vhdl, verilog);
  must(make_folders(folder_ / "netlists"));
  must(write_file(kept + ".vhd", vhdl));
  must(write_file(kept + ".v", verilog));
  return ending == ".v" ? verilog : vhdl;
}

std::vector<std::string> GhdlLibrary::run_arguments(const std::string& top) const {
  if (!tool_.makes_program) return {tool_.program, "-r", "--std=08", top};
  return {(folder_ / top).string()};
}

Result<std::string> run_testbench(const std::string& top, const std::vector<VhdlSource>& sources,
                                  const std::vector<std::string>& options,
                                  const std::filesystem::path& cache) try {
  const GhdlLibrary library = must(GhdlLibrary::open(must(GhdlTool::find()), sources, top, cache));
  Command command{.arguments = library.run_arguments(top), .working_folder = library.folder()};
  command.arguments.insert(command.arguments.end(), options.begin(), options.end());
  command.arguments.insert(command.arguments.end(), {"--ieee-asserts=disable", "--assert-level=error"});
  const ProcessEnd end = must(run_process(command, c_install_ghdl));
  if (!end.succeeded())
    return Error{ExitCode::differs, fmt::format("{} in GHDL ({}): {}", top, end.how(), end.output)};
  return end.output;
} catch (const Failure& failure) {
  return failure.error;
}

}  // namespace halfway
