// SPDX-License-Identifier: Apache-2.0
#include "mutants/source_faults.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include "rows/rows.hpp"
#include "sim/ghdl/ghdl_library.hpp"
#include "sim/system/file.hpp"
#include "sim/system/must.hpp"
#include "sim/system/subprocess.hpp"

namespace halfway::mutants {
namespace {

/// The testbench of the entity: a file of tb, or written from tb/rows.toml.
Result<VhdlSource> testbench_of(const std::string& entity, const std::filesystem::path& source) {
  const std::string name = entity + "_tb.vhd";
  const auto files = files_below(source / "tb", ".vhd");
  if (!files) return files.error();
  for (const auto& file : *files)
    if (file.filename() == name)
      return read_vhdl_source(source, (std::filesystem::path("tb") / file).string());
  const auto written = caught([&] { return rows::testbenches(source); });
  if (!written) return written.error();
  if (const auto found = written->find(entity); found != written->end())
    return VhdlSource{"tb/rows/" + name, found->second};
  return bad_input(fmt::format("source_faults.toml: {}: there is no testbench of this name", entity));
}

}  // namespace

Result<std::vector<SourceFault>> read_source_faults(const std::filesystem::path& file) {
  std::vector<SourceFault> faults;
  try {
    const toml::table all = toml::parse_file(file.string());
    for (const char* kind : {"fault", "vector"})
      for (const toml::node& node : *all[kind].as_array()) {
        const toml::table& table = *node.as_table();
        const auto text = [&](const char* name) { return table[name].value_or(std::string()); };
        faults.push_back({text("file"), text("old"), text("new"), table["line"].value_or(0U),
                          table["word"].value_or(0U), kind == std::string_view("vector"), text("test"),
                          table["quick"].value_or(false)});
      }
  } catch (const toml::parse_error& error) {
    return bad_input(fmt::format("{}:{}: {}", file.string(), error.source().begin.line, error.description()));
  }
  return faults;
}

Result<std::string> with_fault(const SourceFault& fault, const std::string& text) {
  std::string changed = text;
  if (!fault.in_vectors) {
    const auto at = text.find(fault.old_text);
    if (at == std::string::npos || text.find(fault.old_text, at + 1) != std::string::npos)
      return bad_input(
          fmt::format("{}: \"{}\" does not occur exactly once; correct tb/mutants/source_faults.toml",
                      fault.file, fault.old_text));
    return changed.replace(at, fault.old_text.size(), fault.new_text);
  }
  if (fault.line == 0) return changed.substr(0, text.rfind('\n', text.size() / 2) + 1);
  // Invert the lowest bit of the word.
  std::size_t at = 0;
  for (unsigned line = 1; line < fault.line && at < text.size(); ++line) at = text.find('\n', at) + 1;
  for (unsigned word = 0; word < fault.word && at < text.size(); ++word)
    at = text.find_first_of(" \n", at + 1);
  if (at >= text.size())
    return bad_input(fmt::format("{}: has no word {} in line {}; correct tb/mutants/source_faults.toml",
                                 fault.file, fault.word, fault.line));
  static const std::string c_digits = "0123456789ABCDEF";
  changed[at - 1] = c_digits[c_digits.find(text[at - 1]) ^ 1U];
  return changed;
}

Result<TestEnd> run_testbench(const SourceFault& fault, const std::filesystem::path& source,
                              const std::filesystem::path& vectors, const std::filesystem::path& scratch) {
  auto folder = TemporaryFolder::make(scratch / "sources");
  if (!folder) return folder.error();
  // Copy the sources that the testbench may need, the faulty one with its fault.
  auto sources = read_rtl_sources(source);
  if (!sources) return sources.error();
  const auto testbench = testbench_of(fault.test, source);
  if (!testbench) return testbench.error();
  sources->push_back(*testbench);
  for (const std::string& name :
       {std::string("tb/tb_pkg.vhd"), std::string("tb/tb_processors_pkg.vhd"),
        std::string("tb/tb_shaders_pkg.vhd"), std::string("tb/stream/stream_source.vhd"),
        std::string("tb/stream/stream_sink.vhd"), std::string("tb/shaders/shader_checker.vhd"),
        std::string("tb/illumination/processor_checker.vhd")}) {
    const auto one = read_vhdl_source(source, name);
    if (!one) return one.error();
    sources->push_back(*one);
  }
  std::vector<std::string> import{"ghdl", "-i", "--std=08"};
  for (VhdlSource& one : *sources) {
    if (one.name == fault.file) {
      auto changed = with_fault(fault, one.content);
      if (!changed) return changed.error();
      one.content = *changed;
    }
    if (auto s = make_folders((folder->path() / one.name).parent_path()); !s) return s.error();
    if (auto s = write_file(folder->path() / one.name, one.content); !s) return s.error();
    import.push_back(one.name);
  }
  // Link to the vectors, but to a faulty copy of the faulty file.
  std::error_code error;
  const auto its_vectors = folder->path() / "vectors";
  std::filesystem::create_directory(its_vectors, error);
  for (const auto& entry : std::filesystem::directory_iterator(vectors / fault.test, error)) {
    const auto copy = its_vectors / entry.path().filename();
    if (fault.in_vectors && fault.test + "/" + entry.path().filename().string() == fault.file) {
      const auto text = read_file(entry.path());
      if (!text) return text.error();
      const auto changed = with_fault(fault, *text);
      if (!changed) return changed.error();
      if (auto s = write_file(copy, *changed); !s) return s.error();
    } else {
      std::filesystem::create_symlink(entry.path(), copy, error);
    }
  }
  if (error) return tool_failed(fmt::format("{}: {}", its_vectors.string(), error.message()));
  const std::string top = fault.test + "_tb";
  for (const auto& arguments : {import, std::vector<std::string>{"ghdl", "-m", "-O2", "--std=08", top}}) {
    const auto end =
        run_process({.arguments = arguments, .working_folder = folder->path(), .timeout = c_testbench_time},
                    c_install_ghdl);
    if (!end) return end.error();
    if (end->timed_out) return TestEnd::unfinished;
    if (!end->succeeded())
      return bad_input(
          fmt::format("{}: \"{}\": GHDL does not accept it: {}", fault.file, fault.new_text, end->output));
  }
  const auto end = run_process({.arguments = {"ghdl", "-r", "--std=08", top, "-gg_folder=vectors",
                                              "--ieee-asserts=disable", "--assert-level=error"},
                                .working_folder = folder->path(),
                                .timeout = c_testbench_time},
                               c_install_ghdl);
  if (!end) return end.error();
  if (end->timed_out) return TestEnd::unfinished;
  const bool passed = end->succeeded() && end->output.find(top + ": passed") != std::string::npos;
  return passed ? TestEnd::passes : TestEnd::fails;
}

}  // namespace halfway::mutants
