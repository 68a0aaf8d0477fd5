// SPDX-License-Identifier: Apache-2.0
#include "proof_files.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string_view>

#include "golden_table.hpp"
#include "sim/os/file.hpp"
#include "sim/os/must.hpp"
#include "sim/os/toml_file.hpp"
#include "words/generator/formats.hpp"

namespace halfway::proofs {
namespace {

constexpr const char* c_folder = "tb/rtl";
constexpr int c_fault_clocks = 10;  // unless the file says otherwise
constexpr int c_most_clocks = 1000;
constexpr std::array<std::string_view, 5> c_methods = {"induction", "bounded", "bounded_abc", "pdr", "gappa"};

// Keys that a [[proof]] has, or the file for all of its proofs that do not have them.
const std::vector<std::string_view> c_shared_keys = {
    "method",        "clocks",       "fault_clocks", "quick",        "generics", "formats",
    "fault_formats", "any_products", "contracts",    "golden_table", "faults"};
const std::vector<std::string_view> c_fault_keys = {"file", "old", "new", "occurs"};

std::vector<std::string_view> with_shared_keys(std::vector<std::string_view> keys) {
  keys.insert(keys.end(), c_shared_keys.begin(), c_shared_keys.end());
  return keys;
}

bool has_clocks(Method method) {
  return method == Method::induction || method == Method::bounded || method == Method::bounded_abc;
}

bool is_format(std::string_view name) {
  const auto preset = tables::preset_formats().front();
  return std::ranges::any_of(preset.formats, [&](const tables::Format& f) { return f.name == name; });
}

// Reads one file. Throws Failure with file and line.
class ProofFile {
 public:
  // `name` is relative to tb/rtl.
  ProofFile(const std::filesystem::path& source, const std::filesystem::path& name)
      : source_(source), name_(name), file_((c_folder / name).string()) {}

  std::vector<Proof> read() {
    root_ = parse_toml(must(read_file(source_ / c_folder / name_)), file_);
    check_keys(root_, with_shared_keys({"entity", "unit", "shared_faults", "proof"}));
    read_entity();
    read_unit();
    read_shared_faults();
    std::vector<Proof> proofs = read_proofs();
    for (const auto& [list, faults] : shared_faults_)
      if (!used_lists_.contains(list))
        fail(root_["shared_faults"].node(), "no proof refutes '{}'; name it in faults, or remove it", list);
    return proofs;
  }

 private:
  using Where = const toml::node*;

  std::string place(Where where) const {
    return where == nullptr || where->source().begin.line == 0
               ? file_
               : fmt::format("{}:{}", file_, where->source().begin.line);
  }

  template <class... Values>
  [[noreturn]] void fail(Where where, fmt::format_string<Values...> message, Values&&... values) const {
    throw Failure{bad_input(
        fmt::format("{}: {}", place(where), fmt::format(message, std::forward<Values>(values)...)))};
  }

  void check_keys(const toml::table& table, const std::vector<std::string_view>& known) {
    for (const auto& [key, value] : table)
      if (std::ranges::find(known, key.str()) == known.end())
        fail(&value, "unknown key '{}'; the keys here are {}", key.str(), fmt::join(known, ", "));
  }

  // ---- Values

  std::string text(Where node, std::string_view key) const {
    const auto value = node->value_exact<std::string>();
    if (!value || value->empty()) fail(node, "{} must be a text in quotes", key);
    return *value;
  }

  int number(Where node, std::string_view key, int least) const {
    const auto value = node->value_exact<std::int64_t>();
    if (!value || *value < least || *value > c_most_clocks)
      fail(node, "{} must be a whole number from {} to {}", key, least, c_most_clocks);
    return static_cast<int>(*value);
  }

  bool flag(Where node, std::string_view key) const {
    const auto value = node->value_exact<bool>();
    if (!value) fail(node, "{} must be true or false", key);
    return *value;
  }

  const toml::table& table(Where node, std::string_view key) const {
    if (!node->is_table()) fail(node, "{} must be a table", key);
    return *node->as_table();
  }

  const toml::array& list(Where node, std::string_view key) const {
    if (!node->is_array() || node->as_array()->empty())
      fail(node, "{} must be a list with one element or more", key);
    return *node->as_array();
  }

  // ---- The file

  void read_entity() {
    Where node = root_.get("entity");
    if (node == nullptr) fail(nullptr, "has no entity; name the one in rtl/{}", folder());
    entity_ = (name_.parent_path() / text(node, "entity")).string();
    if (!std::filesystem::exists(source_ / "rtl" / (entity_ + ".vhd")))
      fail(node, "rtl/{}.vhd does not exist; name an entity of rtl/{}", entity_, folder());
  }

  std::string folder() const { return name_.parent_path().string(); }

  // The unit next to the file, or the one that it names.
  void read_unit() {
    std::vector<std::string> units;
    if (Where node = root_.get("unit")) {
      unit_ = name_.parent_path() / text(node, "unit");
      if (!std::filesystem::exists(source_ / c_folder / unit_))
        fail(node, "{}/{} does not exist", c_folder, unit_);
      return;
    }
    for (const char* extension : {".psl", ".gappa"}) {
      auto unit = name_;
      unit.replace_extension(extension);
      if (std::filesystem::exists(source_ / c_folder / unit)) units.push_back(unit.string());
    }
    if (units.size() != 1)
      fail(nullptr, "{0} next to it; one must be there: {1}.psl or {1}.gappa",
           units.empty() ? "no unit" : "two units", name_.stem().string());
    unit_ = units.front();
  }

  void read_shared_faults() {
    Where node = root_.get("shared_faults");
    if (node == nullptr) return;
    for (const auto& [key, value] : table(node, "shared_faults"))
      for (const toml::node& fault : list(&value, key.str()))
        shared_faults_[std::string(key.str())].push_back(read_fault(&fault));
  }

  Fault read_fault(Where node) {
    const toml::table& table = this->table(node, "a fault");
    check_keys(table, c_fault_keys);
    for (const char* key : {"old", "new"})
      if (!table.contains(key))
        fail(node, "a fault has no '{}'; a fault is {{ old = \"text of the RTL\", new = \"another\" }}", key);
    Fault fault{.file = entity_ + ".vhd",
                .old_text = text(table.get("old"), "old"),
                .new_text = text(table.get("new"), "new"),
                .where = place(node)};
    if (table.contains("file")) fault.file = text(table.get("file"), "file");
    if (table.contains("occurs")) fault.occurrences = number(table.get("occurs"), "occurs", 2);
    if (fault.old_text == fault.new_text) fail(node, "old and new are equal; change one of them");
    return fault;
  }

  // ---- Proofs

  std::vector<Proof> read_proofs() {
    std::vector<Proof> proofs;
    Where node = root_.get("proof");
    if (node == nullptr) fail(nullptr, "has no proof; add a [[proof]]");
    for (const toml::node& proof : list(node, "proof")) proofs.push_back(read_proof(table(&proof, "proof")));
    return proofs;
  }

  Proof read_proof(const toml::table& table) {
    check_keys(table, with_shared_keys({"property"}));
    Proof proof;
    proof.entity = entity_;
    proof.unit = unit_;
    proof.property = text(required(table, "property"), "property");
    proof.method = read_method(required(table, "method"));
    proof.quick = flag(required(table, "quick"), "quick");
    proof.faults = read_faults(required(table, "faults"));
    if (Where node = find(table, "generics")) proof.generics = read_generics(node);
    if (Where node = find(table, "any_products")) proof.any_products = flag(node, "any_products");
    if (Where node = find(table, "contracts")) proof.contracts = read_contracts(node);
    if (Where node = find(table, "golden_table")) read_golden_table(node, proof);
    read_clocks(table, proof);
    read_formats(table, proof);
    return proof;
  }

  // A proof's own value, or the file's; null if there is neither.
  Where find(const toml::table& proof, std::string_view key) const {
    Where own = proof.get(key);
    return own != nullptr || key == "property" ? own : root_.get(key);
  }

  Where required(const toml::table& proof, std::string_view key) {
    Where node = find(proof, key);
    if (node == nullptr) fail(&proof, "a proof has no '{}'; add it", key);
    return node;
  }

  Method read_method(Where node) {
    const std::string name = text(node, "method");
    const auto at = std::ranges::find(c_methods, name);
    if (at == c_methods.end())
      fail(node, "method is '{}', but must be one of {}", name, fmt::join(c_methods, ", "));
    const auto method = static_cast<Method>(at - c_methods.begin());
    if ((method == Method::gappa) != unit_.ends_with(".gappa"))
      fail(node, "method '{}' does not fit {}; gappa is for units named .gappa", name, unit_);
    return method;
  }

  void read_clocks(const toml::table& table, Proof& proof) {
    if (has_clocks(proof.method)) {
      proof.clocks = number(required(table, "clocks"), "clocks", 1);
    } else if (Where node = find(table, "clocks")) {
      fail(node, "this method takes no clocks; remove them, or give fault_clocks");
    }
    if (Where node = find(table, "fault_clocks")) {
      proof.fault_clocks = number(node, "fault_clocks", std::max(1, proof.clocks));
      if (proof.method == Method::gappa) fail(node, "method gappa takes no fault_clocks; remove them");
    } else if (proof.method != Method::gappa) {
      proof.fault_clocks = std::max(c_fault_clocks, proof.clocks);
    }
  }

  // `formats` hold in the proof and with its faults, `fault_formats` with the faults alone.
  void read_formats(const toml::table& table, Proof& proof) {
    Where formats = find(table, "formats");
    Where fault_formats = find(table, "fault_formats");
    if (formats != nullptr && fault_formats != nullptr)
      fail(fault_formats, "formats hold with the faults, too; remove one of the two");
    if (formats != nullptr) proof.formats = proof.fault_formats = format_list(formats);
    if (fault_formats != nullptr) proof.fault_formats = format_list(fault_formats);
  }

  std::vector<Format> format_list(Where node) {
    std::vector<Format> formats;
    for (const auto& [key, value] : table(node, "formats")) {
      const std::string name(key.str());
      if (!is_format(name)) fail(&value, "formats_pkg has no format '{}'", name);
      const toml::array& bits = list(&value, name);
      if (bits.size() != 2) fail(&value, "{} must be two numbers: integer bits and fraction bits", name);
      formats.push_back({name, number(bits.get(0), name, 0), number(bits.get(1), name, 0)});
    }
    return formats;
  }

  std::vector<std::pair<std::string, std::string>> read_generics(Where node) {
    std::vector<std::pair<std::string, std::string>> generics;
    for (const auto& [key, value] : table(node, "generics")) {
      const std::string name(key.str());
      generics.emplace_back(name, value.is_boolean()  ? flag(&value, name) ? "true" : "false"
                                  : value.is_string() ? text(&value, name)
                                                      : std::to_string(number(&value, name, 0)));
    }
    return generics;
  }

  std::vector<std::string> read_contracts(Where node) {
    std::vector<std::string> contracts;
    for (const toml::node& item : list(node, "contracts")) {
      contracts.push_back(text(&item, "a contract"));
      if (!std::filesystem::exists(source_ / c_folder / contracts.back()))
        fail(&item, "{}/{} does not exist", c_folder, contracts.back());
    }
    return contracts;
  }

  void read_golden_table(Where node, Proof& proof) {
    const auto table = golden_table(text(node, "golden_table"), proof.generics);
    if (!table) fail(node, "golden_table: {}", table.error().message);
    proof.table = table->entries;
    proof.table_bits = table->entry_bits;
  }

  // Each element is a fault, or the name of a list in [shared_faults].
  std::vector<Fault> read_faults(Where node) {
    std::vector<Fault> faults;
    for (const toml::node& item : list(node, "faults")) {
      if (!item.is_string()) {
        faults.push_back(read_fault(&item));
        continue;
      }
      const std::string name = text(&item, "faults");
      const auto shared = shared_faults_.find(name);
      if (shared == shared_faults_.end()) fail(&item, "[shared_faults] has no list '{}'", name);
      used_lists_.insert(name);
      faults.insert(faults.end(), shared->second.begin(), shared->second.end());
    }
    return faults;
  }

  std::filesystem::path source_, name_;
  std::string file_;  // for messages
  toml::table root_;
  std::string entity_, unit_;
  std::map<std::string, std::vector<Fault>> shared_faults_;
  std::set<std::string> used_lists_;
};

// Every unit is proved, or is a contract of a proof.
void check_units(const std::vector<std::filesystem::path>& files, const std::vector<Proof>& proofs) {
  std::set<std::string> used;
  for (const Proof& proof : proofs) {
    used.insert(proof.unit);
    used.insert(proof.contracts.begin(), proof.contracts.end());
  }
  for (const auto& file : files)
    if ((file.extension() == ".psl" || file.extension() == ".gappa") && !used.contains(file.string()))
      throw Failure{
          bad_input(fmt::format("{0}/{1}: no proof uses it; describe it in {2}.toml next to it, or remove it",
                                c_folder, file.string(), file.stem().string()))};
}

}  // namespace

std::vector<Proof> read_proofs(const std::filesystem::path& source) {
  const auto files = must(files_below(source / c_folder));
  std::vector<Proof> proofs;
  for (const auto& file : files) {
    if (file.extension() != ".toml") continue;
    std::vector<Proof> read = ProofFile(source, file).read();
    for (std::size_t i = 0; i < read.size(); ++i) {
      const std::string name = std::filesystem::path(file).replace_extension();
      read[i].name = read.size() == 1 ? name : fmt::format("{} {}", name, i + 1);
    }
    std::ranges::move(read, std::back_inserter(proofs));
  }
  check_units(files, proofs);
  return proofs;
}

}  // namespace halfway::proofs
