// SPDX-License-Identifier: Apache-2.0
// Rows of evidence. Each row holds what a program measured, and the hash of everything that the measurement
// depends on. A row whose hash is not today's is stale. The rows of a page are in a text file next to the
// program that measures them, and its tables are written from them.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/result.hpp"
#include "page/page.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace halfway::evidence {

/// Columns of the page and their values, in order.
using Fields = std::vector<std::pair<std::string, std::string>>;

struct Row {
  std::string name;       ///< unique in its file
  std::string section{};  ///< heading on the page
  std::string hash{};
  std::string details{};  ///< of the measurement, in no column of the page
  Fields fields{};
  std::size_t line = 0;  ///< line number in the file
};

/// The rows of a file, in order; none if there is no file. A row starts with `[name]`; a line `key = value`
/// follows for the section, the hash, the details unless empty, and each field. `\n` is a line feed in a
/// value.
Result<std::vector<Row>> read_rows(const std::filesystem::path& file);
std::string text_of(std::span<const Row> rows);

/// One table per section, in the order of the sections' first rows. If the only field is page::c_table, the
/// values of the section are its text.
std::vector<page::Section> sections_of(std::span<const Row> rows);

/// What a row must be today: its fields are those that a description gives, not a measurement.
using Today = Row;

/// Rows of one file and their page, both relative to the project's root.
struct Place {
  std::filesystem::path root;
  std::string rows;
  std::string page;
  std::function<std::vector<page::Section>(std::span<const Row>)> sections = sections_of;
};

class Evidence {
 public:
  /// `today` is in the order of the page.
  static Result<Evidence> open(Place place, std::vector<Today> today);

  const std::vector<Today>& today() const { return today_; }
  /// Today's hash of the row.
  const std::string& hash_of(std::string_view name) const;
  /// The row has no measurement, or one of something else.
  bool is_stale(std::string_view name) const;
  /// One line for each stale row, for each row that today has not, and for a page that is not written from
  /// the rows. Each names the row and the command that mends it.
  std::vector<std::string> faults() const;

  /// Store a measured row, and the page. Other processes may do the same at the same time.
  Status put(Row row) const;
  /// Remove the row: its measurement failed.
  Status remove(std::string_view name) const;
  /// Remove rows that today has not, take the described fields of the others from today, and write the page.
  Status finish() const;

 private:
  Evidence(Place place, std::vector<Today> today, std::vector<Row> rows)
      : place_(std::move(place)), today_(std::move(today)), rows_(std::move(rows)) {}
  template <class Change>
  Status change(const Change& change) const;
  Place place_;
  std::vector<Today> today_;
  std::vector<Row> rows_;
};

/// How a program treats its rows.
enum class Mode {
  none,   ///< measure, and store nothing
  all,    ///< measure everything that is selected, and store it
  stale,  ///< measure and store only stale rows
  check   ///< measure nothing: fail if a row is stale
};

/// The modes that an option may name.
const std::map<std::string, Mode>& modes();

/// Add the option --evidence all|stale|check.
CLI::Option* add_option(CLI::App& app, Mode& mode);

/// Print `faults` on stderr, or the number of rows.
ExitCode report(const Evidence& evidence);

}  // namespace halfway::evidence
