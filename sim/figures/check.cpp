// SPDX-License-Identifier: Apache-2.0
#include "sim/figures/check.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "sim/figures/plot.hpp"
#include "sim/pictures/image.hpp"
#include "sim/system/file.hpp"

namespace halfway::figures {
namespace {

const Row* row_of(const Entry& entry, const std::string& what) {
  const auto found = std::ranges::find(entry.rows, what, &Row::what);
  return found == entry.rows.end() ? nullptr : &*found;
}

Status compare_pictures(const std::filesystem::path& committed, const std::filesystem::path& drawn,
                        std::vector<std::string>& wrong, std::vector<std::string>& notes) {
  const std::string name = committed.filename().string();
  if (committed.extension() == ".png") {
    const auto a = read_png(committed), b = read_png(drawn);
    if (!a) return a.error();
    if (!b) return b.error();
    if (a->size.width != b->size.width || a->size.height != b->size.height || a->rgb != b->rgb)
      wrong.push_back(fmt::format("{} is not what is drawn", name));
    return Ok{};
  }
  const auto a = read_file(committed), b = read_file(drawn);
  if (!a) return a.error();
  if (!b) return b.error();
  if (*a == *b) return Ok{};
  if (drawn_by(*a) == drawn_by(*b))
    wrong.push_back(fmt::format("{} is not what is drawn", name));
  else
    notes.push_back(fmt::format("{}: {} there, {} here: not compared", name, drawn_by(*a), drawn_by(*b)));
  return Ok{};
}

}  // namespace

std::vector<std::string> faults(std::span<const Figure> figures, std::span<const Entry> entries) {
  std::vector<std::string> wrong;
  for (const Entry& entry : entries) {
    const auto figure = std::ranges::find(figures, entry.id, &Figure::id);
    if (figure == figures.end()) {
      wrong.push_back(fmt::format("{}: no figure has this name", entry.id));
      continue;
    }
    for (const Row& row : entry.rows) {
      const auto claim = std::ranges::find(figure->claims, row.what, &Claim::what);
      if (claim == figure->claims.end()) {
        wrong.push_back(fmt::format("{}: '{}' is no claim of it", entry.id, row.what));
        continue;
      }
      for (const std::string& fault : faults(*claim, row)) wrong.push_back(entry.id + ": " + fault);
    }
    for (const std::string* text : {&entry.number, &entry.caption, &entry.shows})
      if (text->empty())
        wrong.push_back(fmt::format("{}: it lacks its number, its caption or what it shows", entry.id));
  }
  return wrong;
}

Result<std::vector<std::string>> stale(std::span<const Figure> figures, const std::filesystem::path& folder,
                                       std::span<const Entry> drawn,
                                       const std::filesystem::path& drawn_folder,
                                       std::vector<std::string>& notes) {
  const std::filesystem::path json_file = folder / "figures.json", page_file = folder / "README.md";
  const auto json = read_file(json_file), page = read_file(page_file);
  if (!json) return json.error();
  if (!page) return page.error();
  const auto committed = entries_of(*json, json_file.string());
  if (!committed) return committed.error();
  std::vector<std::string> wrong = faults(figures, *committed);
  if (to_page(*committed) != *page) wrong.push_back("README.md is not the page of figures.json");
  if (to_json(*committed) != *json) wrong.push_back("figures.json is not as it is written");
  for (const Figure& figure : figures) {
    const auto entry = std::ranges::find(*committed, figure.id, &Entry::id);
    const auto here = std::ranges::find(drawn, figure.id, &Entry::id);
    if (entry == committed->end() || here == drawn.end()) {
      wrong.push_back(fmt::format("{}: it is missing", figure.id));
      continue;
    }
    if (entry->paper != here->paper || entry->number != here->number || entry->caption != here->caption ||
        entry->shows != here->shows)
      wrong.push_back(fmt::format("{}: its caption is another", figure.id));
    for (const Claim& claim : figure.claims) {
      const Row *there = row_of(*entry, claim.what), *now = row_of(*here, claim.what);
      if (there == nullptr)
        wrong.push_back(fmt::format("{}: '{}' has no row", figure.id, claim.what));
      else if (now != nullptr && now->measured != there->measured)
        wrong.push_back(fmt::format("{}: '{}' is {} there, measured {}", figure.id, claim.what,
                                    there->measured, now->measured));
    }
    const auto same = [](const Picture& a, const Picture& b) { return a.file == b.file && a.alt == b.alt; };
    if (!std::ranges::equal(entry->pictures, here->pictures, same)) {
      wrong.push_back(fmt::format("{}: its pictures are others", figure.id));
      continue;
    }
    for (const Picture& picture : entry->pictures)
      if (const Status compared =
              compare_pictures(folder / picture.file, drawn_folder / picture.file, wrong, notes);
          !compared)
        return compared.error();
  }
  return wrong;
}

}  // namespace halfway::figures
