// SPDX-License-Identifier: Apache-2.0
// What the papers print, and what this project's own runs measure instead: a figure's claims (claims.toml),
// its pictures, and a verdict that follows from what was measured.
#pragma once

#include <fmt/format.h>

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
#include "sim/system/must.hpp"

namespace halfway::figures {

/// Tools and folders for drawing.
struct Context {
  SimulatorFolders folders;
  std::filesystem::path out;  ///< takes the pictures
  /// The golden model draws instead of the RTL, and nothing slow is measured.
  bool quick = false;
  unsigned threads = 1;
  std::function<void(const std::string& what)> on_progress = [](const std::string&) {};

  std::filesystem::path scenes() const { return folders.source / "sim" / "scenes"; }
};

/// When what was measured agrees with what was published.
struct Criterion {
  enum class Kind { same, within, at_most, at_least };
  Kind kind = Kind::same;
  double value = 0.0;      ///< published, or the limit
  double tolerance = 0.0;  ///< of `within`
  std::string unit{};

  bool holds(double measured) const;
  /// "± 0.005", "at most 2/255": as the page says it.
  std::string text() const;
};

struct Measured {
  std::string text;
  double value = std::numeric_limits<double>::quiet_NaN();  ///< what a criterion but `same` looks at
};

/// A number with its text, such as measured(0.5, "{:.2f} of {}", 3).
template <class... More>
Measured measured(double value, fmt::format_string<double, const More&...> text, const More&... more) {
  return {fmt::format(text, double(value), more...), value};
}

/// A number or a statement of the paper: an entry of claims.toml, which says more about each field.
struct Claim {
  std::string what;
  std::string published;
  Criterion criterion{};
  std::string why_not{};
  bool slow = false, timed = false;
};

struct Picture {
  std::string file;  ///< in Context::out
  std::string alt;   ///< what it shows, for those who do not see it
};

/// What was measured of a figure's claims, by Claim::what, and what was drawn.
using Measurements = std::map<std::string, Measured>;
struct Drawing {
  Measurements measured;
  std::vector<Picture> pictures;
};

/// Draws a figure; throws Failure.
using Draw = std::function<void(const Context&, Drawing&)>;

struct Figure {
  std::string id;       ///< spherical-05; its pictures' names begin with it
  std::string number;   ///< "figure 5", "table 1", "section 6"
  std::string caption;  ///< the facts of the published caption
  std::string shows;    ///< what ours shows, and how it was drawn
  std::vector<Claim> claims;
  Draw draw;

  std::string paper() const { return id.substr(0, id.find('-')); }
};

// By the figures' ids; a paper each, in a file of its name.
std::map<std::string, Draw> spherical_drawings();
std::map<std::string, Draw> quadratic_drawings();
std::map<std::string, Draw> processors_drawings();

/// All figures, in the order of claims.toml.
Result<std::vector<Figure>> all_figures(const std::filesystem::path& source);
/// Of the text of a claims.toml.
Result<std::vector<Figure>> read_figures(const std::string& toml, const std::string& file,
                                         std::map<std::string, Draw> drawings);

/// A claim compared with what was measured.
struct Row {
  Claim claim;
  Measured measured;

  bool agrees() const;
  const std::string& reason() const;  ///< why not; empty where it agrees
};

/// A figure with its rows.
struct Entry {
  Figure figure;
  std::vector<Picture> pictures;
  std::vector<Row> rows;
};

/// Draws and measures one. With Context::quick the rows of slow claims are missing.
Result<Entry> drawn(const Figure& figure, const Context& context);

/// What is wrong with the rows, a sentence each: a claim without a row, an empty cell, a difference without a
/// reason, a reason without a difference.
std::vector<std::string> faults(std::span<const Entry> entries);

/// figures.json: a list of figures, each with id, paper, number, caption, shows, pictures (file, alt) and
/// rows (what, published, measured, value or null, criterion, verdict "agrees" or "differs", reason, slow).
std::string to_json(std::span<const Entry> entries);
/// What a figures.json has, by figure.
Result<std::map<std::string, Measurements>> measurements_of(const std::string& json, const std::string& file);

/// What was drawn, for a page that has these measurements: rows of claims that were not measured now are
/// taken from it, and those of timed claims as long as the verdict is the same.
std::vector<Entry> completed(std::vector<Entry> drawn, const std::map<std::string, Measurements>& page);

/// The page: the table of published against measured, then the pictures.
Result<std::string> to_page(std::span<const Entry> entries, const std::filesystem::path& source);

}  // namespace halfway::figures
