// SPDX-License-Identifier: Apache-2.0
// Registers and commands of halfway_core, as data: rtl/core/core_registers.toml, and what is written from it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace halfway::tables {

struct CoreField {
  std::string name;
  int word, high, low;  ///< word: of a command
  std::string text;
  std::vector<std::pair<std::string, int>> values;  ///< numbers with names, ascending

  std::uint32_t mask() const { return (0xFFFF'FFFFU >> (31 - high + low)) << low; }
};

struct CoreRegister {
  std::string name;
  int offset;  ///< in bytes
  std::string access, text;
  std::vector<CoreField> fields;
};

struct CoreRegisters {
  std::uint32_t identity;
  std::vector<CoreRegister> registers;
  int command_words;
  std::vector<CoreField> command;
};

/// `file` is for messages. Throws Failure with file and line.
CoreRegisters core_registers(std::string_view toml, const std::string& file);

std::string core_registers_vhdl(const CoreRegisters& core);
std::string core_registers_header(const CoreRegisters& core);

/// The tables of docs/rtl/core.md.
std::string register_table(const CoreRegisters& core);
std::string command_table(const CoreRegisters& core);

}  // namespace halfway::tables
