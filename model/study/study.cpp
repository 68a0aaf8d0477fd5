// SPDX-License-Identifier: Apache-2.0
#include "study/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <mutex>
#include <optional>
#include <span>

#include "common/file.hpp"
#include "common/subprocess.hpp"
#include "common/threads.hpp"
#include "scene/load_scene.hpp"
#include "study/hardware.hpp"
#include "study/host_setup.hpp"
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

// Those of the records that lack them.
Status count_instructions(const StudySettings& settings, const Records& kept, std::vector<Record>& records) {
  std::vector<Record*> open;
  for (Record& record : records)
    if (in_hardware(record.point.method) && !record.measured.host_instructions) open.push_back(&record);
  if (settings.set_up.empty() || find_program("valgrind").empty()) return Ok{};
  // Valgrind takes seconds to begin with.
  constexpr std::size_t c_batch = 16;
  const std::size_t batches = (open.size() + c_batch - 1) / c_batch;
  std::size_t done = 0;
  std::mutex mutex;
  return for_each_on_threads(settings.threads, batches, [&](std::size_t number) -> Status {
    const std::size_t first = number * c_batch;
    const std::span batch(open.data() + first, std::min(c_batch, open.size() - first));
    std::vector<std::string> names;
    for (const Record* record : batch) names.push_back(record->point.name());
    const auto counted = host_instructions(settings.set_up, names, settings.out / "points");
    if (!counted) return counted.error();
    for (std::size_t i = 0; *counted && i < batch.size(); ++i) {
      batch[i]->measured.host_instructions = (**counted)[i];
      if (Status added = kept.add(*batch[i]); !added) return added;
    }
    const std::scoped_lock lock(mutex);
    done += batch.size();
    settings.on_progress(fmt::format("the host's instructions of {} of {} points", done, open.size()));
    return Ok{};
  });
}

}  // namespace

Drawable drawable(std::vector<DesignPoint> points, const std::string& scene,
                  const SimulatorFolders& folders) {
  Drawable found;
  std::optional<std::string> picture;
  Result<Scene> drawn = Scene{};
  for (DesignPoint& point : points) {
    if (picture != point.picture()) {
      picture = point.picture();
      drawn = drawn_scene(scene, folders.source / "sim" / "scenes", point);
    }
    std::string reason;
    if (!drawn)
      reason = drawn.error().message;
    else if (const auto key = hardware_of(point, *drawn); in_hardware(point.method) && !key)
      reason = fmt::format("{}: {}", to_string(point.method), key.error().message);
    if (reason.empty()) {
      found.points.push_back(std::move(point));
      continue;
    }
    ++found.left_out;
    if (std::ranges::find(found.reasons, reason) == found.reasons.end()) found.reasons.push_back(reason);
  }
  return found;
}

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
  std::mutex mutex;
  std::size_t done = 0, measured = 0;
  const auto measure_one = [&](const DesignPoint& point) -> Result<Record> {
    const auto pictures = shelf.of(point);
    if (!pictures) return pictures.error();
    auto figures = measure(point, **pictures, settings.folders);
    if (!figures) return figures.error();
    Record record{point, std::move(*figures)};
    if (Status added = kept.add_frame(point, record.measured.frame); !added) return added.error();
    record.measured.frame = {};
    if (Status added = kept.add(record); !added) return added.error();
    return record;
  };
  Status all = for_each_on_threads(settings.threads, records.size(), [&](std::size_t at) -> Status {
    const DesignPoint& point = settings.points[begin + at];
    std::optional<Record>& record = records[at];
    record = kept.find(point);
    const bool anew = !record;
    if (anew) {
      auto made = measure_one(point);
      if (!made) return Error{made.error().code, point.name() + ": " + made.error().message};
      record = std::move(*made);
    }
    const std::scoped_lock lock(mutex);
    measured += anew;
    settings.on_progress(fmt::format("{} of {} points", ++done, records.size()));
    return Ok{};
  });
  if (!all) return all.error();
  Study study{opened->provenance, {}, measured};
  for (std::optional<Record>& record : records) study.records.push_back(std::move(*record));
  if (Status counted = count_instructions(settings, kept, study.records); !counted) return counted.error();
  return study;
}

}  // namespace halfway::study
