// SPDX-License-Identifier: Apache-2.0
// `halfway figures`: the papers' figures and numbers, drawn and measured anew.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <thread>

#include "sim/cli/options.hpp"
#include "sim/figures/check.hpp"
#include "sim/figures/figure.hpp"
#include "sim/figures/plot.hpp"
#include "sim/system/file.hpp"

namespace halfway::cli {
namespace {

struct FiguresCommand {
  std::vector<std::string> only;
  std::string out = "build/figures", page;
  bool check = false;
  unsigned threads = 0;
};

Result<std::vector<figures::Figure>> chosen(const std::vector<std::string>& only) {
  std::vector<figures::Figure> all = figures::all_figures();
  if (only.empty()) return all;
  std::vector<figures::Figure> some;
  for (const std::string& name : only) {
    const std::size_t before = some.size();
    for (const figures::Figure& f : all)
      if (f.id.starts_with(name)) some.push_back(f);
    if (some.size() > before) continue;
    std::string names;
    for (const figures::Figure& f : all) names += (names.empty() ? "" : ", ") + f.id;
    return bad_input(fmt::format("'{}' is no figure; take the beginning of one of {}", name, names));
  }
  return some;
}

int report_all(const std::vector<std::string>& wrong, const char* what_to_do) {
  for (const std::string& line : wrong) say(line);
  if (wrong.empty()) return static_cast<int>(ExitCode::equal);
  say(what_to_do);
  return static_cast<int>(ExitCode::differs);
}

constexpr const char* c_data = "figures.json";

Status write_texts(const std::filesystem::path& folder, const std::vector<figures::Entry>& entries) {
  if (Status written = write_file(folder / c_data, figures::to_json(entries)); !written) return written;
  return write_file(folder / "README.md", figures::to_page(entries));
}

Status copy_into(const std::filesystem::path& folder, const std::filesystem::path& from,
                 const std::vector<figures::Figure>& figures, const std::vector<figures::Entry>& entries) {
  if (Status made = make_folders(folder); !made) return made;
  for (const figures::Entry& e : entries)
    for (const figures::Picture& p : e.pictures) {
      const auto content = read_file(from / p.file);
      if (!content) return content.error();
      if (Status written = write_file(folder / p.file, *content); !written) return written;
    }
  std::vector<figures::Entry> page;
  if (const auto before = read_file(folder / c_data)) {
    auto read = figures::entries_of(*before, (folder / c_data).string());
    if (read) page = std::move(*read);
  }
  return write_texts(folder, figures::with_times_of(page, figures, entries));
}

int run(const Folders& folders, const FiguresCommand& command) {
  if (command.check && !command.only.empty())
    return report(bad_input("--check: looks at all figures; leave their names out"));
  const auto some = chosen(command.only);
  if (!some) return report(some.error());
  figures::Context context{
      .folders = {folders.source, folders.cache()},
      .out = command.out,
      .quick = command.check,
      .threads = command.threads != 0 ? command.threads : std::max(1U, std::thread::hardware_concurrency())};
  if (Status made = make_folders(context.out); !made) return report(made.error());
  std::vector<figures::Entry> entries;
  {
    Progress progress("figures");
    context.on_progress = [&](const std::string& what) { progress.show(what); };
    for (const figures::Figure& figure : *some) {
      auto entry = figures::drawn(figure, context);
      if (!entry) {
        progress.clear();
        return report(entry.error());
      }
      entries.push_back(std::move(*entry));
    }
  }
  if (command.check) {
    std::vector<std::string> notes;
    const auto wrong = figures::stale(*some, folders.source / "sim" / "figures", entries, context.out, notes);
    if (!wrong) return report(wrong.error());
    for (const std::string& note : notes) say(note);
    return report_all(*wrong, "sim/figures: run make figures");
  }
  const std::vector<std::string> wrong = figures::faults(*some, entries);
  std::size_t rows = 0, agreeing = 0;
  for (const figures::Entry& e : entries)
    for (const figures::Row& r : e.rows) {
      fmt::print("{:<20} {}: published {}, measured {}: {}\n", e.id, r.what, r.published, r.measured,
                 r.agrees ? fmt::format("agrees ({})", r.criterion)
                          : fmt::format("differs ({}): {}", r.criterion, r.reason));
      ++rows;
      agreeing += r.agrees ? 1 : 0;
    }
  if (Status written = write_texts(context.out, entries); !written) return report(written.error());
  fmt::print("{}: {} figures, {} rows, {} agree, {} differ\n", context.out.string(), entries.size(), rows,
             agreeing, rows - agreeing);
  if (!wrong.empty()) return report_all(wrong, "the claims in sim/figures do not say what was measured");
  if (!command.page.empty())
    if (Status copied = copy_into(command.page, context.out, *some, entries); !copied)
      return report(copied.error());
  return static_cast<int>(ExitCode::equal);
}

}  // namespace

void add_figures(CLI::App& app, const Folders& folders, int& exit_code) {
  CLI::App* sub =
      app.add_subcommand("figures", "draw what the papers print, and hold their numbers against ours");
  auto command = std::make_shared<FiguresCommand>();
  sub->add_option("figure", command->only, "such as spherical-05, or spherical (default: all)");
  sub->add_option("--out", command->out, "folder for pictures, README.md and figures.json")
      ->capture_default_str();
  auto* page = sub->add_option(
      "--page", command->page,
      "folder that takes them too, once all is well; times there stay until a verdict changes");
  sub->add_flag(
         "--check", command->check,
         "draw by the golden model, measure what is quick, and fail where sim/figures has anything else")
      ->excludes(page);
  sub->add_option("--threads", command->threads, "threads (0: all cores)")->capture_default_str();
  sub->callback([=, &folders, &exit_code] { exit_code = run(folders, *command); });
}

}  // namespace halfway::cli
