// SPDX-License-Identifier: Apache-2.0
#include "mutants/source_faults.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "mutants/design.hpp"
#include "sim/engines/ghdl/ghdl_library.hpp"
#include "sim/os/file.hpp"
#include "sim/os/must.hpp"
#include "sim/os/subprocess.hpp"
#include "vectors/rows.hpp"

namespace halfway::mutants {
namespace {

/// The testbench of the entity: a file of tb, or written from tb/vectors/rows.toml.
VhdlSource testbench_of(const std::string& entity, const std::filesystem::path& source) {
  const std::string name = entity + "_tb.vhd";
  for (const auto& file : must(files_below(source / "tb", ".vhd")))
    if (file.filename() == name)
      return must(read_vhdl_source(source, (std::filesystem::path("tb") / file).string()));
  const auto written = rows::testbenches(source);
  if (const auto found = written.find(entity); found != written.end())
    return {"tb/vectors/" + name, found->second};
  throw Failure{bad_input(fmt::format("source_faults.toml: {}: there is no testbench of this name", entity))};
}

}  // namespace

std::vector<SourceFault> read_source_faults(const std::filesystem::path& file) {
  const toml::table all = read_toml(file);
  std::vector<SourceFault> faults;
  for (const std::string kind : {"fault", "vector"})
    std::ranges::move(read_list<SourceFault>(
                          all, kind.c_str(),
                          [&](const toml::table& table) {
                            return SourceFault{text_of(table, "file"),     text_of(table, "old"),
                                               text_of(table, "new"),      table["line"].value_or(0U),
                                               table["word"].value_or(0U), kind == "vector",
                                               text_of(table, "test"),     table["quick"].value_or(false)};
                          }),
                      std::back_inserter(faults));
  return faults;
}

std::string with_fault(const SourceFault& fault, const std::string& text) {
  const auto fail = [&](const std::string& why) {
    throw Failure{bad_input(fmt::format("{}: {}; correct tb/mutants/source_faults.toml", fault.file, why))};
  };
  std::string changed = text;
  if (!fault.in_vectors) {
    const auto at = text.find(fault.old_text);
    if (at == std::string::npos || text.find(fault.old_text, at + 1) != std::string::npos)
      fail(fmt::format("\"{}\" does not occur exactly once", fault.old_text));
    return changed.replace(at, fault.old_text.size(), fault.new_text);
  }
  if (fault.line == 0) return changed.substr(0, text.rfind('\n', text.size() / 2) + 1);
  // Invert the lowest bit of the word.
  std::size_t at = 0;
  for (unsigned line = 1; line < fault.line && at < text.size(); ++line) at = text.find('\n', at) + 1;
  const std::size_t end = std::min(text.find('\n', at), text.size());
  unsigned word = 0;
  for (; word < fault.word && at < end; ++word) at = std::min(text.find(' ', at + 1), end);
  if (word < fault.word) fail(fmt::format("has no word {} in line {}", fault.word, fault.line));
  static const std::string c_digits = "0123456789ABCDEF";
  changed[at - 1] = c_digits[c_digits.find(text[at - 1]) ^ 1U];
  return changed;
}

TestEnd run_testbench(const SourceFault& fault, const std::filesystem::path& source,
                      const std::filesystem::path& vectors, const std::filesystem::path& scratch) {
  const TemporaryFolder made = must(TemporaryFolder::make(scratch / "sources"));
  const std::filesystem::path& folder = made.path();
  // Copy the sources that the testbench may need, the faulty one with its fault.
  std::vector<VhdlSource> sources = must(read_rtl_sources(source));
  sources.push_back(testbench_of(fault.test, source));
  for (const char* name : {"tb/rtl/tb_pkg.vhd", "tb/rtl/tb_processors_pkg.vhd", "tb/rtl/tb_shaders_pkg.vhd",
                           "tb/rtl/stream/stream_source.vhd", "tb/rtl/stream/stream_sink.vhd",
                           "tb/rtl/shaders/shader_checker.vhd", "tb/rtl/stream/stream_checker.vhd"})
    sources.push_back(must(read_vhdl_source(source, name)));
  std::vector<std::string> import{"ghdl", "-i", "--std=08"};
  for (const VhdlSource& one : sources) {
    must(make_folders((folder / one.name).parent_path()));
    must(
        write_file(folder / one.name, one.name == fault.file ? with_fault(fault, one.content) : one.content));
    import.push_back(one.name);
  }
  // Link to the vectors, but to a faulty copy of the faulty file.
  must(make_folders(folder / "vectors"));
  if (fault.in_vectors) {
    const std::filesystem::path file = vectors / fault.file;
    must(write_file(folder / "vectors" / file.filename(), with_fault(fault, must(read_file(file)))));
  }
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(vectors / fault.test, error)) {
    const auto copy = folder / "vectors" / entry.path().filename();
    if (!std::filesystem::exists(copy)) std::filesystem::create_symlink(entry.path(), copy, error);
  }
  if (error) throw Failure{tool_failed(fmt::format("{}: {}", folder.string(), error.message()))};
  const auto run = [&](const std::vector<std::string>& arguments) {
    return must(run_process({.arguments = arguments, .working_folder = folder, .timeout = c_testbench_time},
                            c_install_ghdl));
  };
  const std::string top = fault.test + "_tb";
  for (const auto& arguments : {import, std::vector<std::string>{"ghdl", "-m", "-O2", "--std=08", top}}) {
    const ProcessEnd end = run(arguments);
    if (end.timed_out) return TestEnd::unfinished;
    if (!end.succeeded())
      throw Failure{bad_input(
          fmt::format("{}: \"{}\": GHDL does not accept it: {}", fault.file, fault.new_text, end.output))};
  }
  const ProcessEnd end = run({"ghdl", "-r", "--std=08", top, "-gg_folder=vectors", "--ieee-asserts=disable",
                              "--assert-level=error"});
  if (end.timed_out) return TestEnd::unfinished;
  const bool passed = end.succeeded() && end.output.find(top + ": passed") != std::string::npos;
  return passed ? TestEnd::passes : TestEnd::fails;
}

}  // namespace halfway::mutants
