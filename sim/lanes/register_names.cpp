// SPDX-License-Identifier: Apache-2.0
#include "sim/lanes/register_names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <optional>
#include <sstream>
#include <vector>

#include "sim/system/file.hpp"

namespace halfway {
namespace {

using Words = std::vector<std::string>;

Words words_of(const std::string& line) {
  std::istringstream text(line);
  Words words;
  for (std::string word; text >> word;) words.push_back(word);
  return words;
}

bool in_name(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

/// n12_q
bool is_register(std::string_view name) {
  return name.starts_with('n') && name.ends_with("_q") && name.size() > 3 &&
         std::all_of(name.begin() + 1, name.end() - 2, [](char c) { return c >= '0' && c <= '9'; });
}

std::string range(unsigned low, unsigned width) {
  return width == 1 ? fmt::format("({})", low) : fmt::format("({} downto {})", low + width - 1, low);
}

/// GHDL prints the label of a copy by `generate`, parts(2)/part, as parts_n2_part.
std::string with_indices(const std::string& label) {
  std::string text;
  for (std::size_t at = 0; at < label.size();) {
    std::size_t end = at + 2;
    if (label.compare(at, 2, "_n") == 0)
      while (end < label.size() && std::isdigit(static_cast<unsigned char>(label[end])) != 0) ++end;
    if (end > at + 2 && end < label.size() && label[end] == '_') {
      text += '(' + label.substr(at + 2, end - at - 2) + ")/";
      at = end + 1;
    } else {
      text += label[at++];
    }
  }
  return text;
}

}  // namespace

/// Reads the netlist line by line.
class RegisterNames::Reader {
 public:
  Reader(RegisterNames& names, const std::filesystem::path& source) : names_(names), source_(source) {}

  void read(std::string_view netlist) {
    std::istringstream lines{std::string(netlist)};
    for (std::string line; std::getline(lines, line);) {
      const Words words = words_of(line);
      if (words.size() < 2) continue;
      if (words[0] == "--")
        position_ = words[1];
      else
        read_statement(words);
    }
  }

 private:
  void read_statement(const Words& words) {
    const bool assigns = words.size() >= 3 && words[1] == "<=";
    if (words[0] == "architecture" && words.size() >= 4) {
      entity_ = &names_.entities_[words[3]];
    } else if (entity_ != nullptr && words.size() >= 4 && words[1] == ":" && words[2] == "entity") {
      constexpr std::string_view c_library = "work.";
      entity_->instances[words[0]] = words[3].substr(c_library.size());
    } else if (entity_ != nullptr && assigns && words[2].ends_with(';')) {
      // Prefer a signal to a port.
      const std::string value = words[2].substr(0, words[2].size() - 1);
      const bool signal = words.size() >= 5 && words[4] == "(signal)";
      if (is_register(value) && (signal || !entity_->signals.contains(value)))
        entity_->signals[value] = words[0];
    } else if (entity_ != nullptr && assigns && words[3].starts_with('(')) {
      read_slice(words);
    }
    position_.clear();
  }

  /// x <= signal (7 downto 0);
  void read_slice(const Words& words) {
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
    const Words& lines = lines_of(position.substr(0, first));
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

  const Words& lines_of(const std::string& file) {
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
  std::map<std::string, Words> files_;
};

RegisterNames::RegisterNames(std::string_view netlist, const std::filesystem::path& source) {
  Reader(*this, source).read(netlist);
}

std::string RegisterNames::name(std::string_view signal, unsigned bits, unsigned low, unsigned width) const {
  // Follow the instances from the top.
  std::string path;
  auto entity = entities_.end();
  std::size_t dot = signal.find('.');
  if (dot != signal.npos) entity = entities_.find(std::string(signal.substr(0, dot)));
  if (dot != signal.npos) signal.remove_prefix(dot + 1);
  for (; (dot = signal.find('.')) != signal.npos; signal.remove_prefix(dot + 1)) {
    const std::string instance(signal.substr(0, dot));
    path += with_indices(instance) + '/';
    if (entity == entities_.end()) continue;
    const auto found = entity->second.instances.find(instance);
    entity = found == entity->second.instances.end() ? entities_.end() : entities_.find(found->second);
  }

  // Find the signal and the smallest field around the bits.
  std::string text(signal);
  if (entity != entities_.end()) {
    if (const auto found = entity->second.signals.find(text); found != entity->second.signals.end())
      text = found->second;
    if (const auto fields = entity->second.fields.find(text); fields != entity->second.fields.end()) {
      std::pair<unsigned, unsigned> best{0, bits};
      const std::string* best_name = nullptr;
      for (const auto& [place, name] : fields->second) {
        const bool around = place.first <= low && low + width <= place.first + place.second;
        if (around && place.second <= best.second) best = place, best_name = &name;
      }
      text = with_indices(text);
      if (best_name != nullptr) text += '.' + *best_name;
      return path + text + (width == best.second ? "" : range(low - best.first, width));
    }
  }
  return path + with_indices(text) + (width == bits ? "" : range(low, width));
}

std::string RegisterNames::text() const {
  std::string text;
  for (const auto& [name, entity] : entities_) {
    text += name + '\n';
    for (const auto* names : {&entity.instances, &entity.signals})
      for (const auto& [from, to] : *names) text += fmt::format("{} {}\n", from, to);
    for (const auto& [signal, fields] : entity.fields)
      for (const auto& [place, field] : fields)
        text += fmt::format("{}.{} {} {}\n", signal, field, place.first, place.second);
  }
  return text;
}

}  // namespace halfway
