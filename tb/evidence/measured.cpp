// SPDX-License-Identifier: Apache-2.0
#include "evidence/measured.hpp"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "sim/os/descriptor.hpp"
#include "sim/os/file.hpp"
#include "sim/os/machine.hpp"
#include "sim/os/must.hpp"
#include "sim/os/subprocess.hpp"

namespace halfway::page {
namespace {

using Json = nlohmann::ordered_json;

// The output of git for the files that a measurement reads.
std::string git(const std::filesystem::path& root, std::vector<std::string> arguments) {
  std::vector<std::string> all{"git", "-C", root.string()};
  all.insert(all.end(), arguments.begin(), arguments.end());
  for (const char* path :
       {"--", ".", ":(exclude)*.md", ":(exclude)docs/results", ":(exclude)tb/evidence/thresholds.toml"})
    all.emplace_back(path);
  const ProcessEnd end = must(run_process({.arguments = all}, "apt-get install git"));
  if (!end.succeeded())
    throw Failure{
        bad_input(fmt::format("evidence names a commit, so it needs a checkout of git: {}", end.output))};
  return end.output;
}

std::string line_of(const Row& row) {
  const Json json = {
      {"name", row.name}, {"section", row.section}, {"fields", row.fields}, {"details", row.details}};
  return "\n" + json.dump() + "\n";
}

void append(const std::filesystem::path& file, std::string_view text) {
  const Descriptor opened(::open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666));
  if (opened.get() < 0 ||
      ::write(opened.get(), text.data(), text.size()) != static_cast<ssize_t>(text.size()))
    throw Failure{tool_failed(fmt::format("{}: {}", file.string(), std::strerror(errno)))};
}

}  // namespace

std::string measured_commit(const std::filesystem::path& root) {
  const std::string changes = git(root, {"status", "--porcelain"});
  if (!changes.empty())
    throw Failure{bad_input(fmt::format(
        "evidence is of a commit, and these files have changes; commit or stash them:\n{}", changes))};
  std::string commit = git(root, {"log", "-1", "--format=%H"});
  while (commit.ends_with('\n')) commit.pop_back();
  if (commit.empty()) throw Failure{bad_input("evidence is of a commit, and this checkout has none")};
  return commit;
}

std::string versions(std::span<const std::string_view> tools) {
  std::string all;
  for (const std::string_view tool : tools) {
    const std::string install = fmt::format("apt-get install {}", tool);
    const ProcessEnd end =
        must(run_process({.arguments = {std::string(tool), tool == "yosys" ? "-V" : "--version"},
                          .timeout = std::chrono::seconds(30)},
                         install));
    if (!end.succeeded())
      throw Failure{tool_failed(fmt::format("{}: {}; install it with: {}", tool, end.how(), install))};
    all += fmt::format("{}{}", all.empty() ? "" : "; ", end.output.substr(0, end.output.find('\n')));
  }
  return all;
}

std::string origin_text(std::span<const std::string_view> tools) {
  const std::string found = versions(tools);
  return fmt::format("on {:%Y-%m-%d}. Tools: {}{}{}. Machine: {}.", fmt::gmtime(std::time(nullptr)), found,
                     found.empty() ? "" : "; ", operating_system(), machine());
}

std::filesystem::path Measured::journal() const {
  return page_.root / "build/evidence" / commit_ / (page_.name + ".jsonl");
}

Measured::Measured(Page page) : page_(std::move(page)), commit_(measured_commit(page_.root)) {
  if (std::set<std::string>(page_.rows.begin(), page_.rows.end()).size() != page_.rows.size())
    throw Failure{bad_input(fmt::format("{}: two rows have the same name", page_.name))};
  must(make_folders(journal().parent_path()));
  for (const Row& row : read_journal()) before_.push_back(row.name);
}

// A killed run may leave a part of a line: that row counts as not measured.
std::vector<Row> Measured::read_journal() const {
  std::vector<Row> rows;
  if (!std::filesystem::exists(journal())) return rows;
  std::istringstream lines(must(read_file(journal())));
  for (std::string line; std::getline(lines, line);) {
    const Json json = Json::parse(line, nullptr, false);
    if (json.is_discarded()) continue;
    Row row{json.at("name"), json.at("section"), json.at("fields"), json.at("details")};
    std::erase_if(rows, [&](const Row& old) { return old.name == row.name; });
    if (std::ranges::find(page_.rows, row.name) != page_.rows.end()) rows.push_back(std::move(row));
  }
  std::ranges::sort(rows, {}, [&](const Row& row) { return std::ranges::find(page_.rows, row.name); });
  return rows;
}

bool Measured::has(std::string_view name) const {
  return std::ranges::find(before_, name) != before_.end();
}

void Measured::put(const Row& row) const {
  append(journal(), line_of(row));
}

ExitCode Measured::finish() const {
  const std::vector<Row> rows = read_journal();
  if (rows.size() < page_.rows.size()) {
    fmt::print("{}: {} of {} rows are measured; the page is not written\n", page_.name, rows.size(),
               page_.rows.size());
    return ExitCode::equal;
  }
  const std::filesystem::path file = page_.root / page_.file;
  const std::string text = must(read_file(file));
  const std::string measured = with_sections(text, page_.sections(rows));
  if (is_of_commit(text, page_.name, commit_) && measured == text) {
    fmt::print("{}: {} is of this commit\n", page_.name, page_.file);
  } else {
    must(write_file(file, with_origin(measured, {page_.name, commit_, origin_text(page_.tools)})));
    fmt::print("{}: {} is written\n", page_.name, page_.file);
  }
  return judged(page_.root, page_.values(rows));
}

std::string Countdown::next() {
  ++done_;
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  const double rest = seconds / static_cast<double>(done_) * static_cast<double>(total_ - done_);
  constexpr double c_minute = 60;
  if (rest < c_minute) return fmt::format("[{}/{}]", done_, total_);
  return fmt::format("[{}/{}, about {:.0f} min left]", done_, total_, rest / c_minute);
}

}  // namespace halfway::page
