// SPDX-License-Identifier: Apache-2.0
#include "sim/figures/figure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "sim/files/template.hpp"

namespace halfway::figures {
namespace {

using Json = nlohmann::ordered_json;

// Print 0.00005 as decimal, but 1e-09 with exponent.
std::string plain(double value) {
  std::string text =
      value == 0.0 || std::abs(value) >= 1e-6 ? fmt::format("{:.6f}", value) : fmt::format("{:.0e}", value);
  if (text.find('.') == std::string::npos) return text;
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

Json json_of(const Row& row) {
  const auto& [claim, measured] = row;
  return {{"what", claim.what},         {"published", claim.published},
          {"measured", measured.text},  {"value", measured.value},  // null if the value is not a number
          {"criterion", claim.limit()}, {"verdict", to_string(row.verdict())},
          {"reason", row.reason()},     {"slow", claim.slow}};
}

Json json_of(const Entry& entry) {
  Json pictures = Json::array(), rows = Json::array();
  for (const Picture& p : entry.pictures) pictures.push_back({{"file", p.file}, {"alt", p.alt}});
  for (const Row& row : entry.rows) rows.push_back(json_of(row));
  const Figure& f = entry.figure;
  return {{"id", f.id},       {"paper", f.paper()},   {"number", f.number}, {"caption", f.caption},
          {"shows", f.shows}, {"pictures", pictures}, {"rows", rows}};
}

}  // namespace

bool Criterion::holds(double measured) const {
  switch (kind) {
    case Kind::within:
      return std::abs(measured - value) <= tolerance;
    case Kind::at_most:
      return measured <= value;
    case Kind::at_least:
      return measured >= value;
    case Kind::same:
      break;
  }
  return false;
}

std::string Criterion::text() const {
  switch (kind) {
    case Kind::within:
      return tolerance == 0.0 ? std::string("exactly") : fmt::format("± {}{}", plain(tolerance), unit);
    case Kind::at_most:
      return fmt::format("at most {}{}", plain(value), unit);
    case Kind::at_least:
      return fmt::format("at least {}{}", plain(value), unit);
    case Kind::same:
      break;
  }
  return "the same";
}

std::string Claim::limit() const {
  return criterion.kind == Criterion::Kind::same && !ours.empty() ? "no limit" : criterion.text();
}

const char* to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::agrees:
      return "agrees";
    case Verdict::by_construction:
      return "by construction";
    case Verdict::ours:
      return "ours";
    case Verdict::differs:
      break;
  }
  return "differs";
}

bool Row::holds() const {
  if (claim.criterion.kind == Criterion::Kind::same)
    return !claim.ours.empty() || measured.text == claim.published;
  return claim.criterion.holds(measured.value);
}

Verdict Row::verdict() const {
  if (!holds()) return Verdict::differs;
  if (!claim.ours.empty()) return Verdict::ours;
  return claim.by_construction.empty() ? Verdict::agrees : Verdict::by_construction;
}

const std::string& Row::reason() const {
  if (!holds()) return claim.why_not;
  return claim.ours.empty() ? claim.by_construction : claim.ours;
}

Entry drawn(const Figure& figure, const Context& context) {
  const auto fail = [&](const std::string& what) { throw_tool_failed("{}: {}", figure.id, what); };
  context.on_progress(fmt::format("{}, {}", figure.paper(), figure.number));
  Drawing drawing;
  figure.draw(context, drawing);
  Entry entry{figure, drawing.pictures, {}};
  for (const Claim& claim : figure.claims) {
    if (context.quick && claim.slow) continue;
    const auto found = drawing.measured.extract(claim.what);
    if (found.empty()) fail(fmt::format("nothing was measured for '{}'", claim.what));
    entry.rows.push_back({claim, found.mapped()});
    const Row& row = entry.rows.back();
    if (row.holds() && row.measured.by_construction == claim.by_construction.empty())
      fail(fmt::format("'{}' {}", claim.what,
                       claim.by_construction.empty()
                           ? "holds by construction: the claim needs the reason by_construction"
                           : "was measured: remove by_construction from the claim"));
  }
  for (const auto& [what, measured] : drawing.measured)
    if (std::ranges::find(figure.claims, what, &Claim::what) == figure.claims.end())
      fail(fmt::format("'{}' was measured, which no claim names", what));
  return entry;
}

std::vector<std::string> faults(std::span<const Entry> entries) {
  std::vector<std::string> found;
  for (const auto& [figure, pictures, rows] : entries) {
    for (const std::string* text : {&figure.number, &figure.caption, &figure.shows})
      if (text->empty())
        found.push_back(fmt::format("{}: it lacks its number, its caption or what it shows", figure.id));
    for (const Row& row : rows) {
      const auto& [claim, measured] = row;
      const auto say = [&, &id = figure.id, &what = claim.what](const std::string& fault) {
        found.push_back(fmt::format("{}: '{}'{}", id, what, fault));
      };
      if (claim.what.empty() || claim.published.empty() || measured.text.empty()) say(": a cell is empty");
      const std::string sides =
          fmt::format("published {}, measured {} ({})", claim.published, measured.text, claim.limit());
      if (!row.holds() && claim.why_not.empty()) say(" differs, and no reason is known: " + sides);
      const std::array reasons{!claim.why_not.empty(), !claim.by_construction.empty(), !claim.ours.empty()};
      if (std::ranges::count(reasons, true) > 1)
        say(" has two of why_not, by_construction and ours");
      else if (row.holds() && !claim.why_not.empty())
        say(" agrees, though a reason why not is given: " + sides);
    }
  }
  return found;
}

std::string to_json(std::span<const Entry> entries) {
  Json all = Json::array();
  for (const Entry& entry : entries) all.push_back(json_of(entry));
  return all.dump(1) + '\n';
}

std::string to_page(std::span<const Entry> entries, const std::filesystem::path& source) {
  Json figures = Json::array(), papers = Json::array();
  std::map<std::string, std::int64_t> counts;
  for (const Entry& entry : entries) {
    Json figure = json_of(entry);
    const std::string heading = fmt::format("{}, {}", entry.figure.paper(), entry.figure.number);
    std::string anchor = heading;
    std::erase(anchor, ',');
    std::ranges::replace(anchor, ' ', '-');
    figure.update({{"heading", heading}, {"anchor", anchor}});
    for (Json& row : figure["rows"]) {
      const std::string verdict = row["verdict"];
      row["differs"] = verdict == to_string(Verdict::differs);
      row["explained"] = !row["reason"].get<std::string>().empty();
      ++counts[verdict];
    }
    figures.push_back(std::move(figure));
  }
  for (const auto& [name, title] :
       {std::pair{"spherical", "Hardware Implementation of Phong Shading using Spherical Interpolation"},
        {"quadratic", "Quadratic Shading and its Hardware Implementation"},
        {"processors", "Real Time Phong Shading (Claussen's shading processors)"}}) {
    Json paper = {{"name", name}, {"title", title}, {"figures", Json::array()}};
    for (const Json& figure : figures)
      if (figure["paper"] == name) paper["figures"].push_back(figure);
    papers.push_back(std::move(paper));
  }
  std::int64_t rows = 0;
  for (const auto& [verdict, number] : counts) rows += number;
  const auto count = [&](Verdict verdict) { return counts[to_string(verdict)]; };
  return must(filled_template(source / "sim/figures/figures.md.mustache",
                              {{"rows_in_all", rows},
                               {"agreeing", count(Verdict::agrees)},
                               {"differing", count(Verdict::differs)},
                               {"constructed", count(Verdict::by_construction)},
                               {"ours", count(Verdict::ours)},
                               {"papers", papers},
                               {"figures", figures}}));
}

}  // namespace halfway::figures
