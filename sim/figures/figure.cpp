// SPDX-License-Identifier: Apache-2.0
#include "sim/figures/figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

namespace halfway::figures {

namespace {

// 0.00005, but 1e-09.
std::string plain(double value) {
  std::string text =
      value == 0.0 || std::abs(value) >= 1e-6 ? fmt::format("{:.6f}", value) : fmt::format("{:.0e}", value);
  if (text.find('.') == std::string::npos) return text;
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
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

Criterion the_same() {
  return {Criterion::Kind::same};
}
Criterion within(double published, double tolerance, std::string unit) {
  return {Criterion::Kind::within, published, tolerance, std::move(unit)};
}
Criterion at_most(double limit, std::string unit) {
  return {Criterion::Kind::at_most, limit, 0.0, std::move(unit)};
}
Criterion at_least(double limit, std::string unit) {
  return {Criterion::Kind::at_least, limit, 0.0, std::move(unit)};
}

std::vector<Figure> all_figures() {
  std::vector<Figure> all;
  for (const auto& family : {spherical_figures(), quadratic_figures(), processors_figures()})
    all.insert(all.end(), family.begin(), family.end());
  return all;
}

Row judged(const Claim& claim, const Measured& measured) {
  Row row{claim.what, claim.published, measured.text, measured.value, claim.criterion.text(), false,
          {},         claim.slow};
  row.agrees = claim.criterion.kind == Criterion::Kind::same ? measured.text == claim.published
                                                             : claim.criterion.holds(measured.value);
  if (!row.agrees) row.reason = claim.why_not;
  return row;
}

Result<Entry> drawn(const Figure& figure, const Context& context) {
  context.on_progress(fmt::format("{}, {}", figure.paper, figure.number));
  Drawing drawing;
  if (const Status status = figure.draw(context, drawing); !status) return status.error();
  Entry entry{figure.id, figure.paper, figure.number, figure.caption, figure.shows, drawing.pictures, {}};
  for (const Claim& claim : figure.claims) {
    if (context.quick && claim.slow) continue;
    const auto found = drawing.measured.find(claim.what);
    if (found == drawing.measured.end())
      return tool_failed(fmt::format("{}: nothing was measured for '{}'", figure.id, claim.what));
    entry.rows.push_back(judged(claim, found->second));
    drawing.measured.erase(found);
  }
  for (const auto& [what, measured] : drawing.measured) {
    const bool known =
        std::ranges::any_of(figure.claims, [&, &what = what](const Claim& c) { return c.what == what; });
    if (!known)
      return tool_failed(fmt::format("{}: '{}' was measured, which no claim names", figure.id, what));
  }
  return entry;
}

std::vector<std::string> faults(const Claim& claim, const Row& row) {
  std::vector<std::string> found;
  for (const auto& [name, cell] :
       {std::pair{"what", &row.what}, std::pair{"published", &row.published},
        std::pair{"measured", &row.measured}, std::pair{"criterion", &row.criterion}})
    if (cell->empty()) found.push_back(fmt::format("'{}': its cell '{}' is empty", claim.what, name));
  const std::string sides =
      fmt::format("published {}, measured {} ({})", row.published, row.measured, row.criterion);
  if (!row.agrees && row.reason.empty())
    found.push_back(fmt::format("'{}' differs, and no reason is known: {}", claim.what, sides));
  // What is of this machine's processor may agree on one, and not on another.
  if (row.agrees && !claim.why_not.empty() && !claim.timed)
    found.push_back(fmt::format("'{}' agrees, though a reason why not is given: {}", claim.what, sides));
  const Row again = judged(claim, {row.measured, row.value});
  if (again.published != row.published || again.criterion != row.criterion || again.agrees != row.agrees ||
      again.reason != row.reason || again.slow != row.slow)
    found.push_back(fmt::format("'{}': its verdict does not follow from it", claim.what));
  return found;
}

std::vector<Entry> with_times_of(std::span<const Entry> page, std::span<const Figure> figures,
                                 std::vector<Entry> drawn) {
  for (Entry& entry : drawn) {
    const auto there = std::ranges::find(page, entry.id, &Entry::id);
    const auto figure = std::ranges::find(figures, entry.id, &Figure::id);
    if (there == page.end() || figure == figures.end()) continue;
    for (const Claim& claim : figure->claims) {
      const auto row = std::ranges::find(entry.rows, claim.what, &Row::what);
      const auto before = std::ranges::find(there->rows, claim.what, &Row::what);
      if (!claim.timed || row == entry.rows.end() || before == there->rows.end()) continue;
      Row kept = judged(claim, {before->measured, before->value});
      if (kept.agrees == row->agrees) *row = std::move(kept);
    }
  }
  return drawn;
}

std::string to_json(std::span<const Entry> entries) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const Entry& e : entries) {
    nlohmann::ordered_json pictures = nlohmann::ordered_json::array(), rows = nlohmann::ordered_json::array();
    for (const Picture& p : e.pictures) pictures.push_back({{"file", p.file}, {"alt", p.alt}});
    for (const Row& r : e.rows) {
      nlohmann::ordered_json row = {{"what", r.what}, {"published", r.published}, {"measured", r.measured}};
      row["value"] = std::isfinite(r.value) ? nlohmann::ordered_json(r.value) : nlohmann::ordered_json();
      row["criterion"] = r.criterion;
      row["verdict"] = r.agrees ? "agrees" : "differs";
      row["reason"] = r.reason;
      row["slow"] = r.slow;
      rows.push_back(std::move(row));
    }
    all.push_back({{"id", e.id},
                   {"paper", e.paper},
                   {"number", e.number},
                   {"caption", e.caption},
                   {"shows", e.shows},
                   {"pictures", std::move(pictures)},
                   {"rows", std::move(rows)}});
  }
  return all.dump(1) + '\n';
}

Result<std::vector<Entry>> entries_of(std::string_view json, const std::string& file) {
  try {
    std::vector<Entry> entries;
    for (const auto& e : nlohmann::json::parse(json)) {
      Entry entry{e.at("id"), e.at("paper"), e.at("number"), e.at("caption"), e.at("shows"), {}, {}};
      for (const auto& p : e.at("pictures")) entry.pictures.push_back({p.at("file"), p.at("alt")});
      for (const auto& r : e.at("rows"))
        entry.rows.push_back(
            {r.at("what"), r.at("published"), r.at("measured"),
             r.at("value").is_null() ? std::numeric_limits<double>::quiet_NaN() : r.at("value").get<double>(),
             r.at("criterion"), r.at("verdict") == "agrees", r.at("reason"), r.at("slow")});
      entries.push_back(std::move(entry));
    }
    return entries;
  } catch (const nlohmann::json::exception& bad) {
    return bad_input(fmt::format("{}: {}; run make figures", file, bad.what()));
  }
}

}  // namespace halfway::figures
