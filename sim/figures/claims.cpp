// SPDX-License-Identifier: Apache-2.0
#include <set>

#include "sim/figures/figure.hpp"
#include "sim/os/file.hpp"
#include "sim/os/toml_file.hpp"

namespace halfway::figures {
namespace {

// Reads the values of a table. Those that are not read have unknown names.
class Fields {
 public:
  Fields(const toml::node& node, std::string file) : file_(std::move(file)), node_(node) {
    if (node.as_table() == nullptr) fail("not a table");
  }
  const toml::node* take(const char* key) {
    taken_.insert(key);
    return node_.as_table()->get(key);
  }
  template <class Value>
  std::optional<Value> value(const char* key) {
    const toml::node* const node = take(key);
    if (node == nullptr) return std::nullopt;
    const auto value = node->value<Value>();
    if (!value) fail(fmt::format("'{}' has another type", key));
    return value;
  }
  std::string text(const char* key) {
    const auto text = value<std::string>(key);
    if (!text) fail(fmt::format("'{}' is missing", key));
    return *text;
  }
  const toml::array& list(const char* key) {
    const toml::node* const node = take(key);
    if (node == nullptr || node->as_array() == nullptr) fail(fmt::format("wants a list '{}'", key));
    return *node->as_array();
  }
  void close() const {
    for (const auto& [key, node] : *node_.as_table())
      if (!taken_.contains(key.str())) fail(fmt::format("unknown key '{}'", key.str()));
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw_bad_input("{}:{}: {}", file_, node_.source().begin.line, what);
  }

 private:
  std::string file_;
  const toml::node& node_;
  std::set<std::string_view> taken_;
};

Criterion criterion_of(Fields& fields) {
  using Kind = Criterion::Kind;
  Criterion criterion;
  for (const auto& [key, kind] :
       {std::pair{"value", Kind::within}, {"at_most", Kind::at_most}, {"at_least", Kind::at_least}})
    if (const auto value = fields.value<double>(key)) {
      if (criterion.kind != Kind::same) fields.fail("takes one of value, at_most and at_least");
      criterion.kind = kind;
      criterion.value = *value;
    }
  criterion.tolerance = fields.value<double>("tolerance").value_or(0.0);
  criterion.unit = fields.value<std::string>("unit").value_or("");
  return criterion;
}

// A number, or a text where the texts must be equal.
Measured fault_of(Fields fields, const Criterion& criterion) {
  Measured fault;
  if (criterion.kind == Criterion::Kind::same)
    fault.text = fields.text("measured");
  else if (const auto value = fields.value<double>("measured"))
    fault.value = *value;
  else
    fields.fail("'measured' is missing");
  if (fields.text("as").empty()) fields.fail("'as' is empty");
  fields.close();
  return fault;
}

Claim claim_of(const toml::node& node, const std::string& file) {
  Fields fields(node, file);
  Claim claim{.what = fields.text("what"), .published = fields.text("published")};
  claim.criterion = criterion_of(fields);
  for (const auto& [key, reason] : {std::pair{"why_not", &Claim::why_not},
                                    {"by_construction", &Claim::by_construction},
                                    {"ours", &Claim::ours}})
    claim.*reason = fields.value<std::string>(key).value_or("");
  if (const toml::node* fault = fields.take("fails_for"))
    claim.fails_for = fault_of({*fault, file}, claim.criterion);
  claim.slow = fields.value<bool>("slow").value_or(false);
  fields.close();
  return claim;
}

}  // namespace

std::vector<Figure> read_figures(const std::string& text, const std::string& file,
                                 std::map<std::string, Draw> drawings) {
  const toml::table root = parse_toml(text, file);
  std::vector<Figure> figures;
  Fields all(root, file);
  for (const toml::node& node : all.list("figure")) {
    Fields fields(node, file);
    Figure figure{
        fields.text("id"), fields.text("number"), fields.text("caption"), fields.text("shows"), {}, {}};
    for (const toml::node& claim : fields.list("claims")) figure.claims.push_back(claim_of(claim, file));
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
