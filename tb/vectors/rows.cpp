// SPDX-License-Identifier: Apache-2.0
#include "vectors/rows.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstring>
#include <regex>
#include <vector>

#include "sim/os/file.hpp"
#include "sim/os/must.hpp"
#include "sim/os/toml_file.hpp"

namespace halfway::rows {
namespace {

using Texts = std::vector<std::string>;

/// An entity's declaration, without comments.
struct Interface {
  std::string context;  ///< its library and use clauses
  std::string generics;
  Texts generic_names, port_names;
  std::map<std::string, std::string> port_types;
};

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \n");
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \n") - first + 1);
}

/// The parts between separators that are in no parentheses.
Texts split(const std::string& text, const char* separators) {
  Texts parts{""};
  int depth = 0;
  for (const char letter : text) {
    depth += (letter == '(') - (letter == ')');
    if (depth == 0 && std::strchr(separators, letter))
      parts.emplace_back();
    else
      parts.back() += letter;
  }
  for (std::string& part : parts) part = trimmed(part);
  std::erase(parts, "");
  return parts;
}
Texts words(const std::string& text) {
  return split(text, " \n");
}

/// The content of the parentheses that follow a keyword; empty if the text does not have it.
std::string clause(const std::string& text, const char* keyword) {
  std::smatch found;
  if (!std::regex_search(text, found, std::regex(fmt::format("\\b{}\\s*\\(", keyword)))) return {};
  const std::string content = found.suffix();
  int depth = 1;
  std::size_t end = 0;
  while (depth > 0 && end < content.size()) {
    depth += (content[end] == '(') - (content[end] == ')');
    ++end;
  }
  return content.substr(0, end - 1);
}

/// Calls use(name, type) for each object of an interface list.
template <class Use>
void for_each_object(const std::string& list, const Use& use) {
  for (const std::string& declaration : split(list, ";")) {
    const auto colon = declaration.find(':');
    if (colon == std::string::npos) continue;
    for (const std::string& name : split(declaration.substr(0, colon), ","))
      use(name, trimmed(declaration.substr(colon + 1)));
  }
}

Interface read_interface(const std::filesystem::path& file, const std::string& entity) {
  const std::string text = std::regex_replace(must(read_file(file)), std::regex("--[^\n]*"), "");
  const auto start = text.find("entity " + entity + " is");
  if (start == std::string::npos)
    throw Failure{bad_input(fmt::format("{}: does not declare entity {}", file.string(), entity))};
  Interface all;
  all.context = trimmed(text.substr(0, start));
  const std::string declaration = text.substr(start, text.find("end entity", start) - start);
  all.generics = clause(declaration, "generic");
  for_each_object(all.generics, [&](const auto& name, const auto&) { all.generic_names.push_back(name); });
  for_each_object(clause(declaration, "port"), [&](const auto& name, const std::string& type) {
    all.port_names.push_back(name);
    all.port_types[name] = trimmed(std::regex_replace(type, std::regex("^(in|out|buffer)\\b|:=.*"), ""));
  });
  return all;
}

Texts associations(const Texts& names) {
  Texts all;
  for (const std::string& name : names) all.push_back(name + " => " + name);
  return all;
}

/// Writes the testbench of one entity.
class Writer {
 public:
  Writer(std::string entity, const toml::table& table, Interface interface)
      : entity_(std::move(entity)), table_(table), interface_(std::move(interface)) {}

  std::string text() {
    check_keys();
    put("-- Made by halfway_row_testbenches from tb/vectors/rows.toml and the entity's ports.");
    put(interface_.context);
    for (const std::string& package : words(value("use") + " tb_pkg")) put("use work.{}.all;", package);
    put("entity {}_tb is\n  generic (g_folder : string := \"{}\");\nend entity;", entity_, entity_);
    put("architecture sim of {}_tb is\nbegin", entity_);
    if (has("for")) put("repeated : for {} generate\nbegin", value("for"));
    if (has("if")) put("needed : if {} generate\nbegin", value("if"));
    const Texts generics = split(value("generics"), ",");
    if (!has("forms")) put_form(0, {}, {});
    if (const toml::array* forms = table_["forms"].as_array())
      for (std::size_t i = 0; i < forms->size(); ++i)
        put_form(i, generics, split((*forms)[i].value_or(std::string()), ","));
    if (has("if")) put("end generate;");
    if (has("for")) put("end generate;");
    put("report_end(finished, \"{}_tb\");\nend architecture;", entity_);
    return text_;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw Failure{
        bad_input(fmt::format("tb/vectors/rows.toml:{}: {}: {}", table_.source().begin.line, entity_, what))};
  }
  void check_keys() const {
    const Texts known = words(
        "generics forms files file for if latency reset drive check late stream fault passes use declare "
        "connect");
    for (const auto& [key, node] : table_)
      if (std::ranges::find(known, key.str()) == known.end()) fail(fmt::format("unknown key {}", key.str()));
    if (has("stream") ? words(value("stream")).size() < 2 : value("drive").empty() || value("check").empty())
      fail("needs drive and check, or stream with two ports or more");
  }
  bool has(const char* key) const { return table_.contains(key); }
  bool resets() const { return table_["reset"].value_or(false); }
  std::string value(const char* key) const { return table_[key].value_or(std::string()); }
  template <class... Values>
  void put(fmt::format_string<Values...> format, Values&&... values) {
    text_ += fmt::format(format, std::forward<Values>(values)...) + "\n";
  }
  void put(const std::string& line) { text_ += line + "\n"; }

  /// A VHDL expression: the name of the form's file.
  std::string file_of(std::size_t form, const Texts& generics, const Texts& values) const {
    if (has("file")) return value("file");
    if (has("files")) {
      const Texts files = words(value("files"));
      if (form >= files.size()) fail(fmt::format("has only {} files", files.size()));
      return '"' + files[form] + '"';
    }
    Texts parts;
    for (std::size_t i = 0; i < generics.size(); ++i) {
      const bool is_true = values[i] == "true";
      if (generics[i] == "g_exact")
        parts.push_back("preset_name(g_exact)");
      else if (is_true || values[i] == "false")
        parts.push_back(is_true ? "\"1\"" : "\"0\"");
      else
        parts.push_back(fmt::format("to_string({})", generics[i]));
    }
    return fmt::format("{}", fmt::join(parts, " & \"_\" & "));
  }

  void put_form(std::size_t form, const Texts& generics, const Texts& values) {
    if (generics.size() != values.size())
      fail(fmt::format("a form does not have {} values", generics.size()));
    put("form_{} : block is", form);
    if (!generics.empty()) {
      Texts map;
      for (std::size_t i = 0; i < values.size(); ++i) map.push_back(generics[i] + " => " + values[i]);
      put("generic ({});\ngeneric map ({});", interface_.generics, fmt::join(map, ", "));
    }
    for (const std::string& port : interface_.port_names)
      put("signal {} : {}{};", port, interface_.port_types.at(port),
          port == "clk"                 ? " := '0'"
          : port == "reset" && resets() ? " := '1'"
                                        : "");
    if (has("declare")) put(value("declare"));
    put("begin\ndut : entity work.{}", entity_);
    if (!interface_.generic_names.empty() && !generics.empty())
      put("generic map ({})", fmt::join(associations(interface_.generic_names), ", "));
    put("port map ({});", fmt::join(associations(interface_.port_names), ", "));
    if (has("connect")) put(value("connect"));
    const std::string file = file_of(form, generics, values);
    if (has("stream"))
      put_stream(file);
    else
      put_run(file);
    put("end block;");
  }

  /// A port's handshake has the first word of its name.
  std::string handshake(const std::string& port) const {
    return fmt::format("{0}_valid, {0}_ready", port.substr(0, port.find('_')));
  }

  /// The first port of `stream` takes words, the others are the words of a row that leaves.
  void put_stream(const std::string& file) {
    Texts outputs = words(value("stream")), widths, numbered;
    const std::string input = outputs.front(), output = outputs.at(1);
    outputs.erase(outputs.begin());
    for (const std::string& port : outputs) {
      widths.push_back(interface_.port_types.at(port) == "std_logic" ? "1" : port + "'length");
      numbered.push_back(fmt::format("{} => {}", numbered.size(), widths.back()));
    }
    put("outputs : block is\nsignal row : std_logic_vector({} - 1 downto 0);\nbegin",
        fmt::join(widths, " + "));
    std::ranges::reverse(outputs);
    put("row <= {};", fmt::join(outputs, " & "));
    // An entity without busy or fault is busy while it has a word, and has no fault.
    const auto port_or = [&](const std::string& port, const std::string& other) {
      return interface_.port_types.contains(port) ? port : other;
    };
    put("check : entity work.stream_checker");
    put("generic map (g_file => g_folder & \"/\" & {}, g_fault => {}, g_passes => {}, g_widths => ({}))",
        file, has("fault") ? value("fault") : "'0'", table_["passes"].value_or(false),
        fmt::join(numbered, ", "));
    put("port map (clk, reset, {}, {}, {}, row, {}, {});", handshake(input), input, handshake(output),
        port_or("busy", output.substr(0, output.find('_')) + "_valid"), port_or("fault", "'0'"));
    put("end block;");
  }

  void put_run(const std::string& file) {
    put("run : process is\nvariable vectors : vectors_t;\nbegin\ntake_turn;");
    put("vectors.open_file(g_folder & \"/\" & {} & \".txt\"{});", file,
        has("latency") ? ", " + value("latency") : "");
    put_rows();
    put("end_turn(finished);\nend process;");
  }

  void put_rows() {
    const bool clocked = interface_.port_types.contains("clk");
    Texts driven = words(value("drive"));
    const bool checked = driven.at(0) == "checked";
    if (resets()) put("tick(clk);");
    put("while vectors.{} loop", checked ? "next_clock" : "next_vector");
    if (checked) driven.erase(driven.begin());
    for (const std::string& column : driven) {
      const auto equals = column.find('=');
      if (equals == std::string::npos)
        put("vectors.drive({});", column);
      else
        put("{} <= {}(vectors.read_number);", column.substr(0, equals), column.substr(equals + 1));
    }
    put("settle;");
    if (has("late")) put("vectors.look_back({});", value("late"));
    for (const std::string& column : words(value("check"))) put_check(column);
    put("vectors.expect_end;");
    if (clocked) put("tick(clk);");
    put("end loop;");
  }

  void put_check(const std::string& column) {
    const auto expression = column.find(')') == std::string::npos || column[0] != '(' ? 0 : column.rfind(')');
    const auto slash = column.find('/', expression), question = column.find('?', expression);
    const std::string port = column.substr(0, std::min(slash, question));
    if (slash != std::string::npos)
      return put("vectors.check_words(\"{}\", {}, {});", port, column.substr(slash + 1), port);
    if (question == std::string::npos) return put("vectors.check(\"{}\", {});", port, port);
    const std::string condition = column.substr(question + 1);
    if (condition == "known") return put("vectors.check_known(\"{}\", {});", port, port);
    put("vectors.check_if({}, \"{}\", {});", condition[0] == '!' ? "not " + condition.substr(1) : condition,
        port, port);
  }

  std::string entity_;
  const toml::table& table_;
  Interface interface_;
  std::string text_;
};

}  // namespace

std::map<std::string, std::string> testbenches(const std::filesystem::path& source) {
  std::map<std::string, std::string> all;
  const toml::table folders = read_toml(source / "tb/vectors/rows.toml");
  for (const auto& [folder, entities] : folders)
    for (const auto& [name, table] : *entities.as_table()) {
      const std::string entity(name.str());
      const auto file = source / "rtl" / std::string(folder.str()) / (entity + ".vhd");
      all[entity] = Writer(entity, *table.as_table(), read_interface(file, entity)).text();
    }
  return all;
}

}  // namespace halfway::rows
