// SPDX-License-Identifier: Apache-2.0
#include "sim/figures/figure.hpp"
#include "sim/os/file.hpp"
#include "sim/os/toml_file.hpp"

namespace halfway::figures {
namespace {

// Reads each value of a table once. Values left at the end have unknown names.
class Fields {
 public:
  Fields(toml::node& node, const std::string& file) : file_(file), at_(node.source().begin) {
    if (toml::table* const table = node.as_table())
      table_ = std::move(*table);
    else
      fail("not a table");
  }
  template <class Value>
  std::optional<Value> take(const char* key) {
    if (!table_.contains(key)) return std::nullopt;
    const auto value = table_.get(key)->value<Value>();
    if (!value) fail(fmt::format("'{}' has another type", key));
    table_.erase(key);
    return value;
  }
  std::string text(const char* key) {
    const auto value = take<std::string>(key);
    if (!value) fail(fmt::format("'{}' is missing", key));
    return *value;
  }
  std::optional<Fields> table(const char* key) {
    if (!table_.contains(key)) return std::nullopt;
    Fields fields(*table_.get(key), file_);
    table_.erase(key);
    return fields;
  }
  toml::array list(const char* key) {
    toml::array* const array = table_.contains(key) ? table_.get(key)->as_array() : nullptr;
    if (array == nullptr) fail(fmt::format("wants a list '{}'", key));
    toml::array list = std::move(*array);
    table_.erase(key);
    return list;
  }
  void close() const {
    if (!table_.empty()) fail(fmt::format("unknown key '{}'", std::string(table_.begin()->first.str())));
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw_bad_input("{}:{}: {}", file_, at_.line, what);
  }

 private:
  std::string file_;
  toml::source_position at_;
  toml::table table_;
};

Criterion criterion_of(Fields& fields) {
  using Kind = Criterion::Kind;
  Criterion criterion;
  for (const auto& [key, kind] :
       {std::pair{"value", Kind::within}, {"at_most", Kind::at_most}, {"at_least", Kind::at_least}})
    if (const auto value = fields.take<double>(key)) {
      if (criterion.kind != Kind::same) fields.fail("takes one of value, at_most and at_least");
      criterion.kind = kind;
      criterion.value = *value;
    }
  criterion.tolerance = fields.take<double>("tolerance").value_or(0.0);
  criterion.unit = fields.take<std::string>("unit").value_or("");
  return criterion;
}

// A number, or a text where the texts must be equal.
Measured fault_of(Fields& fields, const Criterion& criterion) {
  Measured fault;
  if (criterion.kind == Criterion::Kind::same)
    fault.text = fields.text("measured");
  else if (const auto value = fields.take<double>("measured"))
    fault.value = *value;
  else
    fields.fail("'measured' is missing");
  if (fields.text("as").empty()) fields.fail("'as' is empty");
  fields.close();
  return fault;
}

Claim claim_of(toml::node& node, const std::string& file) {
  Fields fields(node, file);
  Claim claim{.what = fields.text("what"), .published = fields.text("published")};
  claim.criterion = criterion_of(fields);
  claim.why_not = fields.take<std::string>("why_not").value_or("");
  claim.by_construction = fields.take<std::string>("by_construction").value_or("");
  claim.ours = fields.take<std::string>("ours").value_or("");
  if (auto fault = fields.table("fails_for")) claim.fails_for = fault_of(*fault, claim.criterion);
  claim.slow = fields.take<bool>("slow").value_or(false);
  fields.close();
  return claim;
}

}  // namespace

std::vector<Figure> read_figures(const std::string& text, const std::string& file,
                                 std::map<std::string, Draw> drawings) {
  toml::table root = parse_toml(text, file);
  std::vector<Figure> figures;
  Fields all(root, file);
  for (toml::node& node : all.list("figure")) {
    Fields fields(node, file);
    Figure figure{
        fields.text("id"), fields.text("number"), fields.text("caption"), fields.text("shows"), {}, {}};
    for (toml::node& claim : fields.list("claims")) figure.claims.push_back(claim_of(claim, file));
    fields.close();
    const auto draw = drawings.extract(figure.id);
    if (draw.empty()) fields.fail(fmt::format("nothing draws '{}'", figure.id));
    figure.draw = draw.mapped();
    figures.push_back(std::move(figure));
  }
  all.close();
  if (!drawings.empty()) all.fail(fmt::format("has no figure '{}'", drawings.begin()->first));
  return figures;
}

std::vector<Figure> all_figures(const std::filesystem::path& source) {
  const std::filesystem::path file = source / "sim/figures/claims.toml";
  auto drawings = spherical_drawings();
  drawings.merge(quadratic_drawings());
  drawings.merge(processors_drawings());
  return read_figures(must(read_file(file)), file.string(), std::move(drawings));
}

}  // namespace halfway::figures
