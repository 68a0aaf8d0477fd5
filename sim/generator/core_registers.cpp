// SPDX-License-Identifier: Apache-2.0
#include "sim/generator/core_registers.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <iterator>

#include "sim/os/must.hpp"
#include "sim/os/toml_file.hpp"

namespace halfway::tables {
namespace {

constexpr std::string_view c_core_notice =
    "Made by `make tables` from rtl/core/core_registers.toml; edit that.";
constexpr int c_last_offset = 0xFC, c_bytes = 4, c_last_bit = 31;
constexpr std::array c_accesses = {"ro", "rw", "w1c"};

// ---- Reads core_registers.toml

class CoreFile {
 public:
  explicit CoreFile(const std::string& file) : file_(file) {}

  CoreRegisters read(const toml::table& root) const {
    CoreRegisters core;
    check_keys(root, {"identity", "register", "command"});
    core.identity = static_cast<std::uint32_t>(number(root, "identity", 0xFFFF'FFFF));
    for (const toml::node& node : list(root, "register")) {
      const toml::table& table = table_of(node);
      CoreRegister added = register_of(table);
      for (const CoreRegister& other : core.registers) {
        if (other.name == added.name) fail(table, "the name '{}' is used twice", added.name);
        if (other.offset == added.offset)
          fail(table, "offset {:02X} of '{}' is that of '{}'", added.offset, added.name, other.name);
      }
      core.registers.push_back(std::move(added));
    }
    if (!root.contains("command")) fail(root, "command is missing");
    const toml::table& command = table_of(*root.get("command"));
    check_keys(command, {"words", "fields"});
    core.command_words = static_cast<int>(number(command, "words", 16));
    core.command = fields_of(command, core.command_words);
    return core;
  }

 private:
  template <class... Values>
  [[noreturn]] void fail(const toml::node& node, fmt::format_string<Values...> message,
                         Values&&... values) const {
    throw Failure{bad_input(fmt::format("{}:{}: {}", file_, std::max(node.source().begin.line, 1U),
                                        fmt::format(message, std::forward<Values>(values)...)))};
  }

  void check_keys(const toml::table& table, const std::vector<std::string_view>& known) const {
    for (const auto& [key, value] : table)
      if (std::ranges::find(known, key.str()) == known.end())
        fail(value, "unknown key '{}'; the keys here are {}", key.str(), fmt::join(known, ", "));
  }

  const toml::table& table_of(const toml::node& node) const {
    if (!node.is_table()) fail(node, "must be a table");
    return *node.as_table();
  }

  const toml::array& list(const toml::table& table, std::string_view key) const {
    const toml::array* array = table[key].as_array();
    if (array == nullptr) fail(table, "{} is missing, or is not a list", key);
    return *array;
  }

  std::int64_t number(const toml::table& table, std::string_view key, std::int64_t largest) const {
    const auto value = table[key].value_exact<std::int64_t>();
    if (!value || *value < 0 || *value > largest)
      fail(table, "{} must be a whole number from 0 to {}", key, largest);
    return *value;
  }

  std::string text(const toml::table& table, std::string_view key) const {
    const auto value = table[key].value_exact<std::string>();
    if (!value || value->empty()) fail(table, "{} must be a text in quotes", key);
    return *value;
  }

  // A name of VHDL and C.
  std::string checked_name(const toml::node& node, std::string_view name) const {
    const auto lower = [](char c) { return c >= 'a' && c <= 'z'; };
    const auto part = [&](char c) { return lower(c) || (c >= '0' && c <= '9') || c == '_'; };
    if (name.empty() || !lower(name.front()) || name.back() == '_' || name.find("__") != name.npos ||
        !std::ranges::all_of(name, part))
      fail(node, "'{}' is no name of lower-case letters, digits and single '_'", name);
    return std::string(name);
  }

  CoreRegister register_of(const toml::table& table) const {
    check_keys(table, {"name", "offset", "access", "text", "fields"});
    CoreRegister read{checked_name(table, text(table, "name")),
                      static_cast<int>(number(table, "offset", c_last_offset)),
                      text(table, "access"),
                      text(table, "text"),
                      {}};
    if (read.offset % c_bytes != 0) fail(table, "offset {:02X} is no multiple of {}", read.offset, c_bytes);
    if (std::ranges::find(c_accesses, read.access) == c_accesses.end())
      fail(table, "unknown access '{}'; take {}", read.access, fmt::join(c_accesses, ", "));
    if (table.contains("fields")) read.fields = fields_of(table, 0);
    return read;
  }

  // Fields of a register, or of a command with this number of words.
  std::vector<CoreField> fields_of(const toml::table& parent, int words) const {
    std::vector<CoreField> fields;
    for (const toml::node& node : list(parent, "fields")) {
      const toml::table& table = table_of(node);
      CoreField added = field_of(table, words);
      for (const CoreField& other : fields) {
        if (other.name == added.name) fail(table, "the name '{}' is used twice", added.name);
        if (other.word == added.word && other.low <= added.high && added.low <= other.high)
          fail(table, "'{}' overlaps '{}'", added.name, other.name);
      }
      fields.push_back(std::move(added));
    }
    return fields;
  }

  CoreField field_of(const toml::table& table, int words) const {
    std::vector<std::string_view> keys = {"name", "high", "low", "text", "values"};
    if (words > 0) keys.emplace_back("word");
    check_keys(table, keys);
    CoreField field{checked_name(table, text(table, "name")),
                    words > 0 ? static_cast<int>(number(table, "word", words - 1)) : 0,
                    static_cast<int>(number(table, "high", c_last_bit)),
                    static_cast<int>(number(table, "low", c_last_bit)),
                    text(table, "text"),
                    {}};
    if (field.high < field.low)
      fail(table, "'{}' has high {} below low {}", field.name, field.high, field.low);
    if (!table.contains("values")) return field;
    const toml::table& values = table_of(*table.get("values"));
    for (const auto& [key, value] : values)
      field.values.emplace_back(checked_name(value, key.str()),
                                static_cast<int>(number(values, key.str(), field.mask() >> field.low)));
    std::ranges::sort(field.values, {}, [](const auto& value) { return value.second; });
    return field;
  }

  const std::string& file_;
};

// ---- Writes

std::array<int, 3> version_numbers() {
  std::array<int, 3> numbers{};
  std::sscanf(HALFWAY_VERSION, "%d.%d.%d", &numbers[0], &numbers[1], &numbers[2]);
  return numbers;
}

std::string upper(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::toupper(c); });
  return text;
}

std::string bits_of(const CoreField& field) {
  return field.high == field.low ? fmt::format("{}", field.high)
                                 : fmt::format("{}:{}", field.high, field.low);
}

// The field's text with its named numbers.
std::string meaning_of(const CoreField& field) {
  std::string text = field.text;
  const char* separator = ": ";
  for (const auto& [name, number] : field.values) {
    text += fmt::format("{}{} {}", separator, number, name);
    separator = ", ";
  }
  return text;
}

// Visit fields with the name of their register, then those of a command.
template <class Visit>
void for_each_field(const CoreRegisters& core, const Visit& visit) {
  for (const CoreRegister& r : core.registers)
    for (const CoreField& field : r.fields) visit(r.name + "_" + field.name, field);
  for (const CoreField& field : core.command) visit("command_" + field.name, field);
}

}  // namespace

CoreRegisters core_registers(std::string_view toml, const std::string& file) {
  return CoreFile(file).read(parse_toml(toml, file));
}

std::string core_registers_vhdl(const CoreRegisters& core) {
  const auto [major, minor, patch] = version_numbers();
  std::string out = fmt::format(
      "-- SPDX-License-Identifier: Apache-2.0\n-- {}\n"
      "-- Registers of halfway_core: byte offsets, lowest bit and number of bits of fields. The same for the "
      "words of a\n-- command.\n\n"
      "library ieee;\nuse ieee.std_logic_1164.all;\n\n"
      "package core_registers_pkg is\n\n"
      "  -- A field of a command: its word, lowest bit and number of bits.\n"
      "  type command_field_t is record\n    word, low, bits : natural;\n  end record;\n\n"
      "  constant c_identity : std_logic_vector(31 downto 0) := x\"{:08X}\";\n\n",
      c_core_notice, core.identity);
  const auto constant = [&](const std::string& name, int number) {
    out += fmt::format("  constant c_{} : natural := {};\n", name, number);
  };
  constant("version_major", major);
  constant("version_minor", minor);
  constant("version_patch", patch);
  out += '\n';
  for (const CoreRegister& r : core.registers) constant("address_" + r.name, r.offset);
  out += fmt::format(
      "\n  -- Access of each word.\n  type access_t is (unmapped, {});\n"
      "  type accesses_t is array (0 to {}) of access_t;\n"
      "  constant c_accesses : accesses_t := (\n",
      fmt::join(c_accesses, ", "), c_last_offset / c_bytes);
  for (const CoreRegister& r : core.registers)
    out += fmt::format("    {} => {},\n", r.offset / c_bytes, r.access);
  out += "    others => unmapped);\n\n";
  constant("command_words", core.command_words);
  out += '\n';
  for (const CoreField& field : core.command)
    out += fmt::format("  constant c_command_{} : command_field_t := ({}, {}, {});\n", field.name, field.word,
                       field.low, field.high - field.low + 1);
  for_each_field(core, [&](const std::string& name, const CoreField& field) {
    if (!name.starts_with("command_")) {
      constant(name + "_low", field.low);
      constant(name + "_bits", field.high - field.low + 1);
    }
    for (const auto& [value, number] : field.values) constant(name + "_" + value, number);
  });
  return out + "\nend package;\n";
}

std::string core_registers_header(const CoreRegisters& core) {
  const auto [major, minor, patch] = version_numbers();
  std::string out = fmt::format(
      "// SPDX-License-Identifier: Apache-2.0\n// {}\n"
      "// Registers of halfway_core: byte offsets, shifts and masks of fields. The same for the words of a "
      "command.\n"
      "#ifndef HALFWAY_CORE_REGISTERS_H\n#define HALFWAY_CORE_REGISTERS_H\n\n",
      c_core_notice);
  const auto define = [&](const std::string& name, const std::string& value) {
    out += fmt::format("#define HALFWAY_CORE_{} {}\n", upper(name), value);
  };
  define("identity_value", fmt::format("0x{:08X}u", core.identity));
  define("version_value", fmt::format("0x{:02X}{:02X}{:04X}u", major, minor, patch));
  out += '\n';
  for (const CoreRegister& r : core.registers) define(r.name, fmt::format("0x{:02X}u", r.offset));
  define("command_words", fmt::format("{}u", core.command_words));
  out += '\n';
  for (const CoreField& field : core.command)
    define("command_" + field.name + "_word", fmt::format("{}u", field.word));
  for_each_field(core, [&](const std::string& name, const CoreField& field) {
    out += '\n';
    define(name + "_shift", fmt::format("{}u", field.low));
    define(name + "_mask", fmt::format("0x{:08X}u", field.mask()));
    for (const auto& [value, number] : field.values) define(name + "_" + value, fmt::format("{}u", number));
  });
  return out + "\n#endif\n";
}

std::string register_table(const CoreRegisters& core) {
  std::string out =
      "| offset | register | access | field | bits | meaning |\n| --- | --- | --- | --- | --- | --- |\n";
  for (const CoreRegister& r : core.registers) {
    out += fmt::format("| {:02X} | `{}` | {} | | {} | {} |\n", r.offset, r.name, r.access,
                       r.fields.empty() ? "31:0" : "", r.text);
    for (const CoreField& field : r.fields)
      out += fmt::format("| | | | `{}` | {} | {} |\n", field.name, bits_of(field), meaning_of(field));
  }
  return out;
}

std::string command_table(const CoreRegisters& core) {
  std::string out = "| word | field | bits | meaning |\n| --- | --- | --- | --- |\n";
  for (const CoreField& field : core.command)
    out +=
        fmt::format("| {} | `{}` | {} | {} |\n", field.word, field.name, bits_of(field), meaning_of(field));
  return out;
}

}  // namespace halfway::tables
