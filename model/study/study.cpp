// SPDX-License-Identifier: Apache-2.0
#include "study/study.hpp"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <optional>

#include "common/file.hpp"
#include "common/threads.hpp"
#include "scene/load_scene.hpp"
#include "study/measure.hpp"
#include "study/pictures.hpp"

namespace halfway::study {
namespace {

std::size_t first_of(const StudySettings& settings, std::size_t part) {
  return settings.points.size() * part / settings.parts;
}

// Where the records of the study lie, and what they must be of.
struct Shelf {
  Provenance provenance;
  Records kept;
};

Result<Shelf> open_shelf(const StudySettings& settings) {
  const auto scene = load_scene(settings.scene, settings.folders.source / "sim" / "scenes");
  if (!scene) return scene.error();
  auto provenance = provenance_of(*scene, settings.folders);
  if (!provenance) return provenance.error();
  const std::filesystem::path folder = settings.out / "points";
  if (Status made = make_folders(folder); !made) return made.error();
  return Shelf{*provenance, Records(folder, *provenance)};
}

}  // namespace

Result<std::vector<std::size_t>> open_parts(const StudySettings& settings) {
  const auto shelf = open_shelf(settings);
  if (!shelf) return shelf.error();
  std::vector<std::size_t> open;
  for (std::size_t part = 0; part < settings.parts; ++part)
    for (std::size_t at = first_of(settings, part); at < first_of(settings, part + 1); ++at)
      if (!shelf->kept.find(settings.points[at])) {
        open.push_back(part);
        break;
      }
  return open;
}

Result<Study> run_study(const StudySettings& settings) {
  const auto opened = open_shelf(settings);
  if (!opened) return opened.error();
  const Records& kept = opened->kept;
  PictureShelf shelf(settings.scene, settings.folders.source / "sim" / "scenes");

  const std::size_t begin = first_of(settings, settings.part), end = first_of(settings, settings.part + 1);
  std::vector<std::optional<Record>> records(end - begin);
  std::atomic<std::size_t> next = begin;
  std::mutex mutex;
  std::size_t done = 0, measured = 0;
  std::optional<Error> error;
  const auto measure_one = [&](const DesignPoint& point) -> Result<Record> {
    const auto pictures = shelf.of(point);
    if (!pictures) return pictures.error();
    auto figures = measure(point, **pictures, settings.folders);
    if (!figures) return figures.error();
    const Frame frame = std::move(figures->frame);
    Record record{point, std::move(*figures)};
    record.measured.frame = {};
    if (Status added = kept.add(record, frame); !added) return added.error();
    return record;
  };
  work_on_threads(settings.threads, [&] {
    for (std::size_t at; (at = next++) < end;) {
      const DesignPoint& point = settings.points[at];
      std::optional<Record> record = kept.find(point);
      const bool anew = !record;
      std::optional<Error> failed;
      if (anew) {
        auto made = measure_one(point);
        if (made)
          record = std::move(*made);
        else
          failed = Error{made.error().code, point.name() + ": " + made.error().message};
      }
      const std::scoped_lock lock(mutex);
      if (failed) {
        if (!error) error = std::move(failed);
        next = end;
        return;
      }
      records[at - begin] = std::move(record);
      measured += anew;
      settings.on_progress(++done);
    }
  });
  if (error) return *error;
  Study study{opened->provenance, {}, measured};
  for (std::optional<Record>& record : records) study.records.push_back(std::move(*record));
  return study;
}

std::vector<std::size_t> front_of(std::span<const Record> records,
                                  const std::function<std::vector<double>(const Record&)>& costs) {
  std::vector<std::vector<double>> all;
  for (const Record& record : records) all.push_back(costs(record));
  const auto beats = [](const std::vector<double>& a, const std::vector<double>& b) {
    return a != b && std::ranges::equal(a, b, std::less_equal<>());
  };
  std::vector<std::size_t> front;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (std::ranges::none_of(all, [&](const auto& other) { return beats(other, all[i]); }))
      front.push_back(i);
  return front;
}

}  // namespace halfway::study
