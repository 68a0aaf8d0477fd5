// SPDX-License-Identifier: Apache-2.0
// `halfway figures`: draws and measures the papers' figures and numbers again.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <memory>
#include <thread>

#include "sim/cli/options.hpp"
#include "sim/figures/figure.hpp"
#include "sim/os/file.hpp"

namespace halfway::cli {
namespace {

struct FiguresCommand {
  std::vector<std::string> only;
  std::string out = "build/figures", page;
  bool quick = false;
  unsigned threads = 0;
};

std::vector<figures::Figure> chosen(std::vector<figures::Figure> all, const std::vector<std::string>& only) {
  std::vector<std::string> names;
  for (const figures::Figure& f : all) names.push_back(f.id);
  for (const std::string& name : only)
    if (std::ranges::none_of(names, [&](const std::string& id) { return id.starts_with(name); }))
      throw_bad_input("'{}' is not a figure; give the start of one of {}", name, fmt::join(names, ", "));
  if (!only.empty())
    std::erase_if(all, [&](const figures::Figure& f) {
      return std::ranges::none_of(only, [&](const std::string& name) { return f.id.starts_with(name); });
    });
  return all;
}

void write_texts(const Folders& folders, const std::filesystem::path& folder,
                 const std::vector<figures::Entry>& entries) {
  must(write_file(folder / "figures.json", figures::to_json(entries)));
  must(write_file(folder / "README.md", figures::to_page(entries, folders.source)));
}

void copy_into(const Folders& folders, const std::filesystem::path& folder, const std::filesystem::path& from,
               const std::vector<figures::Entry>& entries) {
  must(make_folders(folder));
  for (const figures::Entry& e : entries)
    for (const figures::Picture& p : e.pictures)
      must(write_file(folder / p.file, must(read_file(from / p.file))));
  write_texts(folders, folder, entries);
}

std::vector<figures::Entry> draw(const std::vector<figures::Figure>& some, figures::Context& context) {
  must(make_folders(context.out));
  std::vector<figures::Entry> entries;
  Progress progress("figures");
  context.on_progress = [&](const std::string& what) { progress.show(what); };
  for (const figures::Figure& figure : some) entries.push_back(figures::drawn(figure, context));
  return entries;
}

int run(const Folders& folders, const FiguresCommand& command) {
  const auto some = chosen(figures::all_figures(folders.source), command.only);
  figures::Context context{
      .folders = {folders.source, folders.cache()},
      .out = command.out,
      .quick = command.quick,
      .threads = command.threads != 0 ? command.threads : std::max(1U, std::thread::hardware_concurrency())};
  const std::vector<figures::Entry> entries = draw(some, context);
  std::map<figures::Verdict, int> count;
  int rows = 0;
  for (const figures::Entry& e : entries)
    for (const figures::Row& r : e.rows) {
      const std::string criterion = r.claim.limit();
      fmt::print("{:<20} {}: published {}, measured {}: {}\n", e.figure.id, r.claim.what, r.claim.published,
                 r.measured.text,
                 r.holds() ? fmt::format("{} ({})", figures::to_string(r.verdict()), criterion)
                           : fmt::format("differs ({}): {}", criterion, r.reason()));
      ++count[r.verdict()];
      ++rows;
    }
  write_texts(folders, context.out, entries);
  fmt::print("{}: {} figures, {} rows, {} agree, {} differ, {} hold by construction, {} are ours\n",
             context.out.string(), entries.size(), rows, count[figures::Verdict::agrees],
             count[figures::Verdict::differs], count[figures::Verdict::by_construction],
             count[figures::Verdict::ours]);
  const std::vector<std::string> wrong = figures::faults(entries);
  for (const std::string& line : wrong) say(line);
  if (!wrong.empty()) {
    say("sim/figures/claims.toml does not match the measurements");
    return static_cast<int>(ExitCode::differs);
  }
  if (!command.page.empty()) copy_into(folders, command.page, context.out, entries);
  return static_cast<int>(ExitCode::equal);
}

}  // namespace

void add_figures(CLI::App& app, const Folders& folders, int& exit_code) {
  CLI::App* sub =
      app.add_subcommand("figures", "draw the papers' figures and compare their numbers with measurements");
  auto command = std::make_shared<FiguresCommand>();
  sub->add_option("figure", command->only, "such as spherical-05, or spherical (default: all)");
  sub->add_option("--out", command->out, "folder for pictures, README.md and figures.json")
      ->capture_default_str();
  auto* page =
      sub->add_option("--page", command->page, "second folder, written if the claims match the measurements");
  sub->add_flag("--quick", command->quick, "draw by the golden model, and measure only what is not slow")
      ->excludes(page);
  sub->add_option("--threads", command->threads, "threads (0: all cores)")->capture_default_str();
  sub->callback([=, &folders, &exit_code] { exit_code = run(folders, *command); });
}

}  // namespace halfway::cli
