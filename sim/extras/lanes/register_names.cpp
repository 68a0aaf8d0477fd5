// SPDX-License-Identifier: Apache-2.0
#include "sim/extras/lanes/register_names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <optional>
#include <sstream>
#include <vector>

#include "sim/os/file.hpp"

namespace halfway {
namespace {

using TextWords = std::vector<std::string>;

TextWords words_of(const std::string& line) {
  std::istringstream text(line);
  TextWords words;
  for (std::string word; text >> word;) words.push_back(word);
  return words;
}

bool in_name(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

/// The name in the Verilog, n12_q, of what may be a register; otherwise empty. In the VHDL netlist, GHDL 5
/// prints n12.
std::string register_of(std::string name) {
  if (!name.ends_with("_q")) name += "_q";
  const bool counted =
      name.starts_with('n') && name.size() > 3 &&
      std::all_of(name.begin() + 1, name.end() - 2, [](char c) { return c >= '0' && c <= '9'; });
  return counted ? name : std::string();
}

std::string range(unsigned low, unsigned width) {
  return width == 1 ? fmt::format("({})", low) : fmt::format("({} downto {})", low + width - 1, low);
}

}  // namespace

/// A name of the RTL with its blocks: GHDL prints colour in parts(0)/block as parts_n1_block_colour. It
/// counts copies from 1.
std::string RegisterNames::path_of(const Entity* entity, std::string name) {
  if (entity == nullptr) return name;
  std::string path;
  while (!entity->own.contains(name)) {
    // Find the longest label that the name starts with.
    std::string label;
    for (std::size_t end = 0; (end = name.find('_', end)) != name.npos; ++end)
      if (entity->copies.contains(name.substr(0, end)) || entity->blocks.contains(name.substr(0, end)))
        label = name.substr(0, end);
    if (label.empty()) break;
    name.erase(0, label.size() + 1);
    path += label;
    const auto copy = entity->copies.find(label);
    if (const std::size_t end = name.find('_'); copy != entity->copies.end() && end != name.npos) {
      path += fmt::format("({})", copy->second + std::strtoul(name.c_str() + 1, nullptr, 10) - 1);
      name.erase(0, end + 1);
    }
    path += '/';
  }
  return path + name;
}

/// Reads the netlist line by line.
class RegisterNames::Reader {
 public:
  Reader(RegisterNames& names, const std::filesystem::path& source) : names_(names), source_(source) {}

  void read(std::string_view netlist) {
    std::istringstream lines{std::string(netlist)};
    for (std::string line; std::getline(lines, line);) {
      const TextWords words = words_of(line);
      if (words.size() < 2) continue;
      if (words[0] == "--")
        read_position(words[1]);
      else
        read_statement(words);
    }
  }

 private:
  void read_position(const std::string& position) {
    position_ = position;
    const std::string file = position.substr(0, position.find(':'));
    if (entity_ != nullptr && file != file_) read_declarations(lines_of(file));
    file_ = file;
  }

  /// Labels and signals of a file, each at the start of a line.
  void read_declarations(const TextWords& lines) {
    for (const std::string& line : lines) {
      const TextWords words = words_of(line);
      if (words.size() > 6 && words[1] == ":" && words[2] == "for" && words[6] == "to")
        entity_->copies[words[0]] = static_cast<unsigned>(std::strtoul(words[5].c_str(), nullptr, 10));
      else if (words.size() > 2 && words[1] == ":" && (words[2] == "if" || words[2] == "case"))
        entity_->blocks.insert(words[0]);
      else if (words.size() > 2 && words[1] == ":" && words[2] == "entity")
        entity_->own.insert(words[0]);
      else if (words.size() > 1 && words[0] == "signal")
        for (std::size_t i = 1; i < words.size() && words[i] != ":"; ++i)
          entity_->own.insert(words[i].substr(0, words[i].find(',')));
    }
  }

  void read_statement(const TextWords& words) {
    const bool assigns = words.size() >= 3 && words[1] == "<=";
    if (words[0] == "architecture" && words.size() >= 4) {
      entity_ = &names_.entities_[words[3]];
      file_.clear();
    } else if (entity_ != nullptr && words.size() >= 4 && words[1] == ":" && words[2] == "entity") {
      constexpr std::string_view c_library = "work.";
      entity_->instances[words[0]] = words[3].substr(c_library.size());
    } else if (entity_ != nullptr && assigns && words[2].ends_with(';')) {
      // Prefer a signal to a port.
      const std::string value = register_of(words[2].substr(0, words[2].size() - 1));
      const bool signal = words.size() >= 5 && words[4] == "(signal)";
      if (!value.empty() && (signal || !entity_->signals.contains(value))) entity_->signals[value] = words[0];
    } else if (entity_ != nullptr && assigns && words[3].starts_with('(')) {
      read_slice(words);
    }
    position_.clear();
  }

  /// x <= signal (7 downto 0);
  void read_slice(const TextWords& words) {
    const auto number = [](const std::string& word) {
      return static_cast<unsigned>(std::strtoul(word.c_str(), nullptr, 10));
    };
    const unsigned high = number(words[3].substr(1)),
                   low = words.size() == 6 && words[4] == "downto" ? number(words[5]) : high;
    if (const auto field = field_at(position_, words[2]))
      entity_->fields[words[2]].try_emplace({low, high - low + 1}, *field);
  }

  /// The field of `signal` that is read at file:line:column.
  std::optional<std::string> field_at(const std::string& position, const std::string& signal) {
    const std::size_t second = position.rfind(':'), first = position.rfind(':', second - 1);
    if (second == position.npos || first == position.npos) return std::nullopt;
    const std::size_t line = std::strtoul(position.c_str() + first + 1, nullptr, 10),
                      column = std::strtoul(position.c_str() + second + 1, nullptr, 10);
    const TextWords& lines = lines_of(position.substr(0, first));
    if (line == 0 || line > lines.size() || column < 3 || column > lines[line - 1].size())
      return std::nullopt;
    const std::string& text = lines[line - 1];

    // The names before and after the dot. A signal of a block has the block's name before its own.
    const std::size_t begin = column - 1;
    if (text[begin - 1] != '.') return std::nullopt;
    std::size_t owner = begin - 1, end = begin;
    while (owner > 0 && in_name(text[owner - 1])) --owner;
    while (end < text.size() && in_name(text[end])) ++end;
    const std::string name = text.substr(owner, begin - 1 - owner);
    const bool field_of_field = owner > 0 && (text[owner - 1] == '.' || text[owner - 1] == ')');
    if (name.empty() || field_of_field || (signal != name && !signal.ends_with("_" + name)))
      return std::nullopt;
    return text.substr(begin, end - begin);
  }

  const TextWords& lines_of(const std::string& file) {
    const auto [found, fresh] = files_.try_emplace(file);
    if (const auto text = fresh ? read_file(source_ / file) : Result<std::string>(std::string())) {
      std::istringstream lines(*text);
      for (std::string line; std::getline(lines, line);) found->second.push_back(line);
    }
    return found->second;
  }

  RegisterNames& names_;
  const std::filesystem::path& source_;
  Entity* entity_ = nullptr;
  std::string position_;  ///< in the line above
  std::string file_;      ///< of the last position
  std::map<std::string, TextWords> files_;
};

RegisterNames::RegisterNames(std::string_view netlist, const std::filesystem::path& source) {
  Reader(*this, source).read(netlist);
}

RegisterNames::Place RegisterNames::place_of(std::string_view signal) const {
  // Follow the instances from the top.
  const auto find = [&](const std::string& entity) {
    const auto found = entities_.find(entity);
    return found == entities_.end() ? nullptr : &found->second;
  };
  const auto take = [&] {
    const std::size_t dot = signal.find('.');
    const std::string part(signal.substr(0, dot));
    signal.remove_prefix(dot == signal.npos ? signal.size() : dot + 1);
    return part;
  };
  const Entity* entity = find(take());
  std::string path;
  while (signal.find('.') != signal.npos) {
    const std::string instance = take();
    path += path_of(entity, instance) + '/';
    if (entity == nullptr) continue;
    const auto found = entity->instances.find(instance);
    entity = found == entity->instances.end() ? nullptr : find(found->second);
  }
  // Prefer the name of the signal that has a register's value.
  std::string text(signal);
  if (entity != nullptr)
    if (const auto found = entity->signals.find(text); found != entity->signals.end()) text = found->second;
  return {entity, path, text};
}

std::string RegisterNames::path(std::string_view signal) const {
  const Place place = place_of(signal);
  return place.instance + path_of(place.entity, place.signal);
}

std::string RegisterNames::name(std::string_view signal, unsigned bits, unsigned low, unsigned width) const {
  const auto [entity, path, text] = place_of(signal);
  if (entity == nullptr) return path + text + (width == bits ? "" : range(low, width));

  // Find the smallest field around the bits.
  std::pair<unsigned, unsigned> best{0, bits};
  std::string field;
  if (const auto fields = entity->fields.find(text); fields != entity->fields.end()) {
    for (const auto& [place, name] : fields->second) {
      const bool around = place.first <= low && low + width <= place.first + place.second;
      if (around && place.second <= best.second) best = place, field = '.' + name;
    }
  }
  return path + path_of(entity, text) + field + (width == best.second ? "" : range(low - best.first, width));
}

std::string RegisterNames::text() const {
  std::string text;
  for (const auto& [name, entity] : entities_) {
    text += name + '\n';
    for (const auto& [label, first] : entity.copies) text += fmt::format("{} {}\n", label, first);
    for (const auto* names : {&entity.blocks, &entity.own})
      for (const std::string& own : *names) text += own + '\n';
    for (const auto* names : {&entity.instances, &entity.signals})
      for (const auto& [from, to] : *names) text += fmt::format("{} {}\n", from, to);
    for (const auto& [signal, fields] : entity.fields)
      for (const auto& [place, field] : fields)
        text += fmt::format("{}.{} {} {}\n", signal, field, place.first, place.second);
  }
  return text;
}

}  // namespace halfway
