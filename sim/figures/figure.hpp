// SPDX-License-Identifier: Apache-2.0
// Published values of the papers and measured values of this project: a figure's claims (claims.toml), its
// pictures, and a verdict computed from the measurements.
#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sim/engines/ghdl/ghdl_library.hpp"
#include "sim/os/must.hpp"

namespace halfway::figures {

/// Tools and folders for drawing.
struct Context {
  SimulatorFolders folders;
  std::filesystem::path out;  ///< folder for the pictures
  /// Draw with the golden model instead of the RTL, and skip slow measurements.
  bool quick = false;
  unsigned threads = 1;
  std::function<void(const std::string& what)> on_progress = [](const std::string&) {};

  std::filesystem::path scenes() const { return folders.source / "sim" / "scenes"; }
};

/// Condition for a measured value to agree with the published one.
struct Criterion {
  enum class Kind { same, within, at_most, at_least };
  Kind kind = Kind::same;
  double value = 0.0;      ///< the published value, or the limit
  double tolerance = 0.0;  ///< of `within`
  std::string unit{};

  bool holds(double measured) const;
  /// Text for the page: "± 0.005", "at most 2/255".
  std::string text() const;
};

struct Measured {
  std::string text;
  double value = std::numeric_limits<double>::quiet_NaN();  ///< used by all criteria except `same`
  /// Computed from the paper's own numbers, or from values chosen to give the published one.
  bool by_construction = false;
};

/// A number with its text, for example measured(0.5, "{:.2f} of {}", 3).
template <class... More>
Measured measured(double value, fmt::format_string<double, const More&...> text, const More&... more) {
  return {fmt::format(text, double(value), more...), value};
}

/// The same for a number that holds by construction.
template <class... More>
Measured constructed(double value, fmt::format_string<double, const More&...> text, const More&... more) {
  return {fmt::format(text, double(value), more...), value, true};
}

/// A number or a statement of the paper, or a value of ours next to them. claims.toml describes each field.
struct Claim {
  std::string what;
  std::string published;
  Criterion criterion{};
  std::string why_not{};
  std::string by_construction{};
  std::string ours{};
  std::optional<Measured> fails_for{};  ///< what a plausible fault would measure
  bool slow = false;

  /// Text of the criterion; "no limit" for a value of ours without one.
  std::string limit() const;
};

struct Picture {
  std::string file;  ///< relative to Context::out
  std::string alt;   ///< alternative text of the picture
};

/// Measured values of a figure's claims, by Claim::what.
using Measurements = std::map<std::string, Measured>;
struct Drawing {
  Measurements measured;
  std::vector<Picture> pictures;
};

/// Draw a figure; throws Failure.
using Draw = std::function<void(const Context&, Drawing&)>;

struct Figure {
  std::string id;       ///< for example spherical-05; prefix of its pictures' names
  std::string number;   ///< "figure 5", "table 1", "section 6"
  std::string caption;  ///< the facts of the published caption
  std::string shows;    ///< content of our figure and how it was drawn
  std::vector<Claim> claims;
  Draw draw;

  std::string paper() const { return id.substr(0, id.find('-')); }
};

// By the figures' ids. Each paper's drawings are in a file with its name.
std::map<std::string, Draw> spherical_drawings();
std::map<std::string, Draw> quadratic_drawings();
std::map<std::string, Draw> processors_drawings();
/// Figure 17 of the spherical paper: timing of its line interpolator, ROM and multiplier, from their delays.
void draw_figure_17(const Context& context, Drawing& out);

// The functions below throw Failure.

/// Read all figures, in the order of claims.toml.
std::vector<Figure> all_figures(const std::filesystem::path& source);
/// Read the figures from the text of a claims.toml.
std::vector<Figure> read_figures(const std::string& toml, const std::string& file,
                                 std::map<std::string, Draw> drawings);

/// In the order of their names in figure.cpp.
enum class Verdict { agrees, by_construction, ours, differs };
const char* to_string(Verdict verdict);  ///< "agrees", "by construction", "ours", "differs"

/// A claim and its measured value.
struct Row {
  Claim claim;
  Measured measured;

  bool holds() const;  ///< the measured value fulfils the criterion
  /// A row that holds by construction, or that the paper does not state, does not count as agreeing.
  Verdict verdict() const;
  const std::string& reason() const;  ///< reason for the verdict; empty if the row agrees
};

/// A figure with its rows.
struct Entry {
  Figure figure;
  std::vector<Picture> pictures;
  std::vector<Row> rows;
};

/// Draw and measure a figure. With Context::quick, rows of slow claims are omitted. Fails if a claim is not
/// measured, if the drawing measures what no claim names, and if drawing and claim do not agree on what holds
/// by construction.
Entry drawn(const Figure& figure, const Context& context);

/// Faults of the rows, one sentence each: an empty cell, a difference without a reason, a reason without a
/// difference, reasons for two verdicts.
std::vector<std::string> faults(std::span<const Entry> entries);

/// figures.json: a list of figures. Each has id, paper, number, caption, shows, pictures (file, alt) and rows
/// (what, published, measured, value or null, criterion, verdict, reason, slow).
std::string to_json(std::span<const Entry> entries);

/// The page: the table of published and measured values, then the pictures.
std::string to_page(std::span<const Entry> entries, const std::filesystem::path& source);

}  // namespace halfway::figures
