// SPDX-License-Identifier: Apache-2.0
#include "sim/study/study.hpp"

#include <fmt/format.h>

#include <deque>
#include <mutex>
#include <set>

#include "sim/files/load_scene.hpp"
#include "sim/os/file.hpp"
#include "sim/os/must.hpp"
#include "sim/os/subprocess.hpp"
#include "sim/os/threads.hpp"
#include "sim/study/hardware.hpp"
#include "sim/study/host_setup.hpp"

namespace halfway::study {
namespace {

// A whole frame of a large picture and its reference take gigabytes.
constexpr unsigned c_most_gathering = 2;

// A part of the study. Any process may measure it, in any order.
struct Piece {
  PieceKind kind;
  std::size_t point;       // index of the point; of a reference tile, the first point of the picture
  std::size_t points = 1;  // of a reference tile: number of consecutive points of the picture
  std::size_t tile = 0;    // index of the tile
};

// In the order of the points. The reference tiles of a picture precede its points.
std::vector<Piece> pieces_of(std::span<const DesignPoint> points) {
  std::vector<Piece> pieces;
  std::size_t picture_end = 0;
  for (std::size_t point = 0; point < points.size(); ++point) {
    if (!points[point].in_tiles()) {
      pieces.push_back({.kind = PieceKind::point, .point = point});
      continue;
    }
    const std::size_t tiles = points[point].tiles().size();
    if (point >= picture_end) {
      const std::string picture = points[point].picture();
      for (picture_end = point; picture_end < points.size() && points[picture_end].picture() == picture;)
        ++picture_end;
      for (std::size_t tile = 0; tile < tiles; ++tile)
        pieces.push_back({PieceKind::reference_tile, point, picture_end - point, tile});
    }
    if (is_drawn(points[point].method))
      for (std::size_t tile = 0; tile < tiles; ++tile)
        pieces.push_back({.kind = PieceKind::tile, .point = point, .tile = tile});
    pieces.push_back({.kind = PieceKind::gathering, .point = point});
  }
  return pieces;
}

struct Range {
  std::size_t begin, end;
};
Range part_of(std::size_t count, std::size_t part, std::size_t parts) {
  return {count * part / parts, count * (part + 1) / parts};
}
std::span<const Piece> part_of(std::span<const Piece> pieces, std::size_t part, std::size_t parts) {
  const Range range = part_of(pieces.size(), part, parts);
  return pieces.subspan(range.begin, range.end - range.begin);
}

// Do the work; its error begins with the name.
void naming(const std::string& name, const std::function<void()>& work) {
  if (const auto done = caught(work); !done)
    throw Failure{{done.error().code, name + ": " + done.error().message}};
}

bool is_point(const Piece& piece) {
  return piece.kind == PieceKind::point || piece.kind == PieceKind::gathering;
}

// Thread-safe cache of named values. Each value is made once and shared. The oldest values are dropped first.
template <class Value>
class Shelf {
 public:
  // `make` returns the value, or throws; then the next caller makes it.
  template <class Make>
  std::shared_ptr<const Value> of(const std::string& name, const Make& make) {
    std::shared_ptr<Thing> thing;
    {
      const std::scoped_lock lock(mutex_);
      const auto found =
          std::ranges::find(kept_, name, &std::pair<std::string, std::shared_ptr<Thing>>::first);
      thing = found == kept_.end() ? std::make_shared<Thing>() : found->second;
      if (found == kept_.end()) kept_.emplace_back(name, thing);
      if (kept_.size() > c_most_kept) kept_.pop_front();
    }
    std::call_once(thing->once, [&] { thing->made = std::make_shared<const Value>(make()); });
    return thing->made;
  }

 private:
  static constexpr std::size_t c_most_kept = 8;
  struct Thing {
    std::once_flag once;
    std::shared_ptr<const Value> made;
  };
  std::mutex mutex_;
  std::deque<std::pair<std::string, std::shared_ptr<Thing>>> kept_;
};

// Makes pieces and finds those that are stored.
class Bench {
 public:
  explicit Bench(const StudySettings& settings)
      : settings_(settings),
        provenance_(provenance_of(must(load_scene(settings.scene, scenes())), settings.folders)),
        kept_(points(), provenance_) {
    must(make_folders(points()));
    if (!settings.placed.empty())
      placements_.emplace(settings.scene, settings.placed, settings.folders, provenance_.rtl,
                          *settings.family);
  }

  const Provenance& provenance() const { return provenance_; }
  const Records& kept() const { return kept_; }
  const std::optional<Placements>& placements() const { return placements_; }
  std::size_t placement_count() const { return placements_ ? placements_->count() : 0; }

  // A point's record.
  std::optional<Record> find(const Piece& piece) const {
    return is_point(piece) ? kept_.find(point_of(piece)) : std::nullopt;
  }
  // A tile is also done when all its points are done.
  bool is_done(const Piece& piece) const {
    if (!is_point(piece) && kept_.has_tile(point_of(piece), piece.kind, piece.tile)) return true;
    return std::ranges::all_of(std::span(settings_.points).subspan(piece.point, piece.points),
                               [&](const DesignPoint& each) { return kept_.find(each).has_value(); });
  }
  bool can_gather(const Piece& piece) const { return is_done(piece) || kept_.has_tiles(point_of(piece)); }

  // A point's record; only figures stay in memory.
  std::optional<Record> make(const Piece& piece) {
    if (is_point(piece)) return make_point(point_of(piece), piece.kind == PieceKind::gathering);
    make_tile(point_of(piece), piece.kind, piece.tile);
    return std::nullopt;
  }

 private:
  const DesignPoint& point_of(const Piece& piece) const { return settings_.points[piece.point]; }
  std::filesystem::path scenes() const { return settings_.folders.source / "sim" / "scenes"; }
  std::filesystem::path points() const { return settings_.out / "points"; }

  std::shared_ptr<const Subject> subject_of(const DesignPoint& point) {
    return subjects_.of(point.picture(), [&] { return study::subject_of(settings_.scene, scenes(), point); });
  }

  void make_tile(const DesignPoint& point, PieceKind kind, std::size_t number) {
    const auto subject = subject_of(point);
    const Tile tile = point.tiles()[number];
    if (kind == PieceKind::reference_tile)
      kept_.add_reference(point, number, render(*subject, point, tile));
    else
      kept_.add_drawing(point, number, draw(point, *subject, settings_.folders, tile));
  }

  Record make_point(const DesignPoint& point, bool of_tiles) {
    const auto pictures = pictures_.of(point.picture(), [&] {
      const auto subject = subject_of(point);
      return Pictures{subject, of_tiles ? kept_.reference(point) : render(*subject, point)};
    });
    std::optional<Drawing> drawing;
    if (is_drawn(point.method))
      drawing = of_tiles ? kept_.drawing(point) : draw(point, *pictures->subject, settings_.folders);
    Record record{point, measure(*pictures, std::move(drawing))};
    kept_.add_frame(point, record.measured.frame);
    record.measured.frame = {};
    kept_.add(record);
    if (of_tiles) kept_.remove_drawing(point);
    return record;
  }

  const StudySettings& settings_;
  Provenance provenance_;
  Records kept_;
  std::optional<Placements> placements_;
  Shelf<Subject> subjects_;
  Shelf<Pictures> pictures_;
};

// Make this part's placements.
void place(const StudySettings& settings, const Bench& bench, Study& study) {
  const Range mine = part_of(bench.placement_count(), settings.part, settings.parts);
  const std::size_t count = mine.end - mine.begin;
  std::size_t done = 0;
  std::mutex mutex;
  must_for_each(settings.threads, count, [&](std::size_t at) {
    const std::size_t number = mine.begin + at;
    const bool is_new = !bench.placements()->is_done(number);
    if (is_new) naming(bench.placements()->name(number), [&] { bench.placements()->make(number); });
    const std::scoped_lock lock(mutex);
    study.placements += is_new;
    settings.on_progress(fmt::format("{} of {} placements", ++done, count));
  });
}

// Records with the same work of the host: one measurement is valid for all of them.
using Group = std::vector<Record*>;
std::map<std::string, Group> by_host_work(std::vector<Record>& records) {
  std::map<std::string, Group> groups;
  for (Record& record : records) groups[record.point.host_work()].push_back(&record);
  return groups;
}

// Give all records of the group the value, or else the value that one of them has, and store them. False if
// there is no value.
template <class Value>
bool share(const Records& kept, const Group& group, std::optional<Value> Measurement::* member,
           std::optional<Value> value = {}) {
  for (const Record* record : group)
    if (!value) value = record->measured.*member;
  for (Record* record : group) {
    if (!value || record->measured.*member) continue;
    record->measured.*member = value;
    kept.add(*record);
  }
  return value.has_value();
}

// Count the host instructions for the records that lack them.
void count_instructions(const StudySettings& settings, const Records& kept, std::vector<Record>& records) {
  if (settings.set_up.empty() || find_program("valgrind").empty()) return;
  const auto groups = by_host_work(records);
  std::vector<const Group*> open;
  for (const auto& [work, group] : groups) {
    if (in_hardware(group.front()->point.method) && !share(kept, group, &Measurement::host_instructions))
      open.push_back(&group);
  }
  // Batches, because starting Valgrind takes seconds.
  constexpr std::size_t c_batch = 16;
  const std::size_t batches = (open.size() + c_batch - 1) / c_batch;
  std::size_t done = 0;
  std::mutex mutex;
  must_for_each(settings.threads, batches, [&](std::size_t number) {
    const std::size_t first = number * c_batch;
    const std::span batch(open.data() + first, std::min(c_batch, open.size() - first));
    std::vector<std::string> names;
    for (const Group* group : batch) names.push_back(group->front()->point.name());
    const auto counted = host_instructions(settings.set_up, names, settings.out / "points");
    for (std::size_t i = 0; counted && i < batch.size(); ++i)
      share(kept, *batch[i], &Measurement::host_instructions, std::optional((*counted)[i]));
    const std::scoped_lock lock(mutex);
    done += batch.size();
    settings.on_progress(fmt::format("the host's instructions of {} of {} set-ups", done, open.size()));
  });
}

// Measure the host's time for the records that lack it, one after the other, so that they do not disturb each
// other.
void time_hosts(const StudySettings& settings, const Records& kept, std::vector<Record>& records) {
  const auto groups = by_host_work(records);
  std::size_t done = 0;
  for (const auto& [work, group] : groups) {
    settings.on_progress(fmt::format("the host's time of {} of {} set-ups", ++done, groups.size()));
    if (share(kept, group, &Measurement::host_time)) continue;
    const HostTime time = host_time(group.front()->point, settings.scene, settings.folders);
    share(kept, group, &Measurement::host_time, std::optional(time));
  }
}

// The reason why Mesa does not draw the scene here; empty if it does.
std::string no_mesa(const Scene& scene, const SimulatorFolders& folders) {
  if (const std::string lacks = mesa_lacks(folders.source); !lacks.empty())
    return fmt::format("phong-mesa: halfway_mesa is not built; install {} and run make study", lacks);
  const Status draws = mesa_draws(scene);
  return draws ? "" : fmt::format("phong-mesa: {}", draws.error().message);
}

}  // namespace

Drawable drawable(const std::vector<DesignPoint>& points, const std::string& scene,
                  const SimulatorFolders& folders) {
  Drawable found;
  std::optional<std::string> picture;
  std::set<std::string> hardware;
  Result<Scene> drawn = Scene{};
  for (const DesignPoint& point : points) {
    if (picture != point.picture()) {
      picture = point.picture();
      drawn = caught([&] { return drawn_scene(scene, folders.source / "sim" / "scenes", point); });
    }
    std::string reason;
    if (!drawn)
      reason = drawn.error().message;
    else if (point.method == Method::phong_mesa)
      reason = no_mesa(*drawn, folders);
    else if (in_hardware(point.method)) {
      if (const auto made = caught([&] { return hardware_of(point, *drawn); }); !made)
        reason = fmt::format("{}: {}", to_string(point.method), made.error().message);
      else if (hardware.insert(made->key.name()).second)
        found.hardware.push_back(point);
    }
    if (reason.empty()) {
      found.points.push_back(point);
      continue;
    }
    ++found.left_out;
    if (std::ranges::find(found.reasons, reason) == found.reasons.end()) found.reasons.push_back(reason);
  }
  return found;
}

std::size_t most_parts(const StudySettings& settings) {
  return std::max(pieces_of(settings.points).size(), settings.placed.size() * synth::c_seeds);
}

std::vector<std::size_t> open_parts(const StudySettings& settings) {
  const Bench bench(settings);
  const std::vector<Piece> all = pieces_of(settings.points);
  std::vector<std::size_t> open;
  for (std::size_t part = 0; part < settings.parts; ++part) {
    const Range placements = part_of(bench.placement_count(), part, settings.parts);
    bool done = std::ranges::all_of(part_of(all, part, settings.parts),
                                    [&](const Piece& piece) { return bench.is_done(piece); });
    for (std::size_t number = placements.begin; done && number < placements.end; ++number)
      done = bench.placements()->is_done(number);
    if (!done) open.push_back(part);
  }
  return open;
}

Study run_study(const StudySettings& settings) {
  Bench bench(settings);
  const std::vector<Piece> all = pieces_of(settings.points);
  const std::span<const Piece> mine = part_of(all, settings.part, settings.parts);
  Study study{.provenance = bench.provenance()};
  std::vector<std::optional<Record>> records(mine.size());
  std::mutex mutex;
  std::size_t done = 0;
  const auto each = [&](std::size_t at) {
    const Piece& piece = mine[at];
    std::optional<Record> record = bench.find(piece);
    const bool is_new = is_point(piece) ? !record : !bench.is_done(piece);
    if (is_new) naming(settings.points[piece.point].name(), [&] { record = bench.make(piece); });
    const std::scoped_lock lock(mutex);
    (is_point(piece) ? study.measured : study.drawn_tiles) += is_new;
    records[at] = std::move(record);
    settings.on_progress(fmt::format("{} of {} {}", ++done, mine.size(),
                                     all.size() == settings.points.size() ? "points" : "points and tiles"));
  };
  // Assemble points from tiles after all tiles of this part are drawn. If tiles of another part are missing,
  // that part or a later run assembles the point.
  std::vector<std::size_t> drawn, gathered;
  for (std::size_t at = 0; at < mine.size(); ++at)
    (mine[at].kind == PieceKind::gathering ? gathered : drawn).push_back(at);
  must_for_each(settings.threads, drawn.size(), [&](std::size_t i) { each(drawn[i]); });
  if (settings.parts > 1)
    std::erase_if(gathered, [&](std::size_t at) { return !bench.can_gather(mine[at]); });
  must_for_each(std::min(settings.threads, c_most_gathering), gathered.size(),
                [&](std::size_t i) { each(gathered[i]); });
  place(settings, bench, study);
  for (std::optional<Record>& record : records)
    if (record) study.records.push_back(std::move(*record));
  count_instructions(settings, bench.kept(), study.records);
  if (settings.host_times) time_hosts(settings, bench.kept(), study.records);
  return study;
}

}  // namespace halfway::study
