// SPDX-License-Identifier: Apache-2.0
// What the papers print, and what this project's own runs give in its place: a figure's claims, its pictures,
// and a verdict that follows from what was measured.
#pragma once

#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/result.hpp"
#include "sim/ghdl/ghdl_library.hpp"

namespace halfway::figures {

/// What is drawn by, and where to.
struct Context {
  SimulatorFolders folders;
  std::filesystem::path out;  ///< takes the pictures
  /// The golden model draws in place of the RTL, and nothing slow is measured.
  bool quick = false;
  unsigned threads = 1;
  std::function<void(const std::string& what)> on_progress = [](const std::string&) {};

  std::filesystem::path scenes() const { return folders.source / "sim" / "scenes"; }
};

/// When what was measured agrees with what was published.
struct Criterion {
  enum class Kind { same, within, at_most, at_least };
  Kind kind;
  double value = 0.0;      ///< published, or the limit
  double tolerance = 0.0;  ///< of `within`
  std::string unit{};

  bool holds(double measured) const;
  /// "± 0.005", "at most 2/255": as the page says it.
  std::string text() const;
};
/// The same text.
Criterion the_same();
Criterion within(double published, double tolerance, std::string unit = "");
Criterion at_most(double limit, std::string unit = "");
Criterion at_least(double limit, std::string unit = "");

struct Measured {
  std::string text;
  double value = std::numeric_limits<double>::quiet_NaN();  ///< what a criterion but `same` looks at
};

/// A number or a statement of the paper.
struct Claim {
  std::string what;
  std::string published;  ///< the number, or the statement in our words
  Criterion criterion;
  std::string why_not{};  ///< it is known to differ, and this is why; empty: it must agree
  bool slow = false;      ///< not measured where Context::quick is set
  bool timed = false;     ///< of this machine's processor: another value in each run
};

struct Picture {
  std::string file;  ///< in Context::out
  std::string alt;   ///< what it shows, for those who do not see it
};

/// What was measured of a figure's claims, by Claim::what, and what was drawn.
struct Drawing {
  std::map<std::string, Measured> measured;
  std::vector<Picture> pictures;
};

struct Figure {
  std::string id;       ///< spherical-05; its pictures' names begin with it
  std::string paper;    ///< spherical, quadratic or processors
  std::string number;   ///< "figure 5", "table 1", "section 6"
  std::string caption;  ///< the facts of the published caption
  std::string shows;    ///< what ours shows, by what it was drawn
  std::vector<Claim> claims;
  std::function<Status(const Context&, Drawing&)> draw;
};

// A family each, in a file of its name.
std::vector<Figure> spherical_figures();
std::vector<Figure> quadratic_figures();
std::vector<Figure> processors_figures();
/// All, in the papers' order.
std::vector<Figure> all_figures();

/// A claim held against what was measured.
struct Row {
  std::string what, published, measured;
  double value;  ///< Measured::value
  std::string criterion;
  bool agrees;
  std::string reason;  ///< why not; empty where it agrees
  bool slow;
};
Row judged(const Claim& claim, const Measured& measured);

/// A figure with its rows.
struct Entry {
  std::string id, paper, number, caption, shows;
  std::vector<Picture> pictures;
  std::vector<Row> rows;
};

/// Draws and judges one. With Context::quick the rows of slow claims are left out.
Result<Entry> drawn(const Figure& figure, const Context& context);

/// What is wrong with a row beside its claim, a sentence each: an empty cell, a difference that nobody knows
/// a reason of, a reason for a difference that is none.
std::vector<std::string> faults(const Claim& claim, const Row& row);

/// figures.json, and back: a list of figures, each with id, paper, number, caption, shows, pictures (file,
/// alt) and rows (what, published, measured, value or null, criterion, verdict "agrees" or "differs", reason,
/// slow).
std::string to_json(std::span<const Entry> entries);
Result<std::vector<Entry>> entries_of(std::string_view json, const std::string& file);

/// What was drawn, for a page that is there: of claims that are timed what stands in `page` stays as long as
/// its verdict does.
std::vector<Entry> with_times_of(std::span<const Entry> page, std::span<const Figure> figures,
                                 std::vector<Entry> drawn);

/// The page: the table of published against measured, then the pictures.
std::string to_page(std::span<const Entry> entries);

}  // namespace halfway::figures
