// SPDX-License-Identifier: Apache-2.0
#include "sim/figures/check.hpp"

#include <nlohmann/json.hpp>

#include "sim/figures/plot.hpp"
#include "sim/pictures/image.hpp"
#include "sim/system/file.hpp"

namespace halfway::figures {
namespace {

using Json = nlohmann::ordered_json;

// Names of the object at a JSON pointer: "spherical-05: 'a for n = 5': ".
std::string place_of(const Json& entries, const std::string& path) {
  std::string place;
  for (Json::json_pointer at(path); !at.empty(); at.pop_back()) {
    if (!entries.contains(at) || !entries.at(at).is_object()) continue;
    const Json& object = entries.at(at);
    if (object.contains("what")) place = fmt::format("'{}': {}", object["what"].get<std::string>(), place);
    if (object.contains("id")) place = fmt::format("{}: {}", object["id"].get<std::string>(), place);
  }
  return place;
}

std::string text_of(const Json& entries, const std::string& path) {
  const Json::json_pointer at(path);
  if (!entries.contains(at)) return "nothing";
  return entries.at(at).is_string() ? entries.at(at).get<std::string>() : entries.at(at).dump();
}

void compare_pictures(const std::filesystem::path& committed, const std::filesystem::path& drawn,
                      std::vector<std::string>& wrong, std::vector<std::string>& notes) {
  const std::string name = committed.filename().string();
  bool same = false;
  if (committed.extension() == ".png") {
    const Frame a = must(read_png(committed)), b = must(read_png(drawn));
    same = a.size.width == b.size.width && a.size.height == b.size.height && a.rgb == b.rgb;
  } else {
    const std::string a = must(read_file(committed)), b = must(read_file(drawn));
    same = a == b;
    if (drawn_by(a) != drawn_by(b)) {
      notes.push_back(fmt::format("{}: {} there, {} here: not compared", name, drawn_by(a), drawn_by(b)));
      return;
    }
  }
  if (!same) wrong.push_back(fmt::format("{} is not up to date", name));
}

}  // namespace

Result<std::vector<std::string>> stale(std::span<const Entry> drawn, const std::filesystem::path& folder,
                                       const std::filesystem::path& drawn_folder,
                                       const std::filesystem::path& source,
                                       std::vector<std::string>& notes) try {
  const std::filesystem::path json_file = folder / "figures.json";
  const std::string json = must(read_file(json_file)), page = must(read_file(folder / "README.md"));
  const auto entries =
      completed({drawn.begin(), drawn.end()}, must(measurements_of(json, json_file.string())));
  std::vector<std::string> wrong = faults(entries);
  if (must(to_page(entries, source)) != page) wrong.push_back("README.md is not the page of figures.json");
  if (to_json(entries) != json) {
    wrong.push_back("figures.json differs from the text that make figures writes");
    const Json there = Json::parse(json), now = Json::parse(to_json(entries));
    for (const auto& difference : Json::diff(there, now)) {
      const std::string path = difference["path"];
      wrong.push_back(fmt::format("{}{} is {} there, measured {}", place_of(there, path),
                                  path.substr(path.rfind('/') + 1), text_of(there, path),
                                  text_of(now, path)));
    }
  }
  for (const Entry& entry : entries)
    for (const Picture& picture : entry.pictures)
      compare_pictures(folder / picture.file, drawn_folder / picture.file, wrong, notes);
  return wrong;
} catch (const Failure& failure) {
  return failure.error;
}

}  // namespace halfway::figures
