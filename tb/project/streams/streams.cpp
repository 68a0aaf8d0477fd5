// SPDX-License-Identifier: Apache-2.0
// `halfway_streams`: compares the hashes of init vectors and golden fragments with those in streams.txt.
//
//  halfway_streams SOURCE_DIR            compares; exit code 1 if a stream differs
//  halfway_streams --renew SOURCE_DIR    writes today's hashes, and prints each one that changed
//
// Each row of streams.txt is a case: the arguments of `halfway sim`, and the hashes of the two files that it
// writes, init.txt and golden.trace. Each case is drawn by one thread and by three.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "plan/plan.hpp"
#include "setup/setup.hpp"
#include "sim/cli/options.hpp"
#include "sim/driver/frame_driver.hpp"
#include "sim/files/init_file.hpp"
#include "sim/files/load_scene.hpp"
#include "sim/files/trace.hpp"
#include "sim/os/file.hpp"
#include "sim/os/threads.hpp"

namespace halfway {
namespace {

constexpr unsigned c_thread_counts[] = {1, 3};
constexpr const char* c_no_hash = "-";

/// The result of a case: the hashes of its two files, and the number of fragments in the second one.
struct Streams {
  std::string init = c_no_hash, golden = c_no_hash;
  std::uint64_t fragments = 0;
  friend bool operator==(const Streams&, const Streams&) = default;
  std::string text() const { return fmt::format("{} {} {}", init, golden, fragments); }
};

/// A row of streams.txt.
struct Case {
  std::string scene, options;
  Streams recorded;
  std::string text() const { return scene + " " + options; }
};

/// The content of streams.txt: its comment lines and its cases.
struct Record {
  std::string comments;
  std::vector<Case> cases;
};

Result<Record> read_record(const std::filesystem::path& path) {
  const auto text = read_file(path);
  if (!text) return text.error();
  Record record;
  std::istringstream lines(*text);
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (line.empty() || line.starts_with('#')) {
      record.comments += line + "\n";
      continue;
    }
    Case one;
    std::istringstream fields(line);
    fields >> one.recorded.init >> one.recorded.golden >> one.recorded.fragments >> one.scene >> std::ws;
    if (!fields)
      return bad_input(
          fmt::format("{}:{}: a broken row; it must read: <init hash> <golden hash> <fragments> <scene> "
                      "<options>, with - - 0 "
                      "for a new case",
                      path.string(), number));
    std::getline(fields, one.options);
    record.cases.push_back(std::move(one));
  }
  return record;
}

Status write_record(const std::filesystem::path& path, const Record& record) {
  std::string text = record.comments;
  for (const Case& one : record.cases) text += fmt::format("{} {}\n", one.recorded.text(), one.text());
  return write_file(path, text);
}

Result<cli::DrawSettings> parse(const std::string& options) {
  cli::DrawOptions draw;
  CLI::App app;
  draw.add_to(app);
  try {
    app.parse(options);
  } catch (const CLI::ParseError& error) {
    return bad_input(error.what());
  }
  return checked(draw);
}

Result<std::string> hash_of(const std::filesystem::path& path) {
  const auto text = read_file(path);
  if (!text) return text.error();
  return ContentHash().add(*text).hex();
}

/// Runs setup and golden model of one case. Writes init.txt and golden.trace to `folder`.
Result<Streams> draw(const Scene& scene, const cli::DrawSettings& settings, unsigned threads,
                     const std::filesystem::path& folder) {
  const auto plan = plan_scene(scene, settings.plan);
  if (!plan) return plan.error();
  FrameDriver driver(scene, settings.size, plan->key, {},
                     {.setup = settings.setup, .workers = on_threads(threads)});
  const std::filesystem::path init_path = folder / "init.txt", golden_path = folder / "golden.trace";
  auto init = InitFileWriter::open(init_path, plan->key.name(), driver.init_bits());
  if (!init) return init.error();
  auto golden = TraceWriter::open(golden_path, plan->key.name());
  if (!golden) return golden.error();

  const Status drawn = driver.draw([&](const Batch& batch) -> Status {
    init->write(batch.init_words);
    golden->write(batch.golden);
    return Ok{};
  });
  if (!drawn) return drawn.error();
  if (Status status = init->commit(); !status) return status.error();
  if (Status status = golden->commit(); !status) return status.error();
  auto init_hash = hash_of(init_path);
  if (!init_hash) return init_hash.error();
  auto golden_hash = hash_of(golden_path);
  if (!golden_hash) return golden_hash.error();
  return Streams{*init_hash, *golden_hash, driver.fragments()};
}

/// The case's streams. Fails if they depend on the number of threads.
Result<Streams> draw(const Case& one, const std::filesystem::path& source,
                     const std::filesystem::path& folder) {
  const auto settings = parse(one.options);
  if (!settings) return settings.error();
  // A scene name with a file ending is a file of this folder.
  const bool own = std::filesystem::path(one.scene).has_extension();
  const auto scene = load_scene(own ? (source / "tb/project/streams" / one.scene).string() : one.scene,
                                source / "sim/scenes");
  if (!scene) return scene.error();
  std::optional<Streams> first;
  for (const unsigned threads : c_thread_counts) {
    auto streams = draw(*scene, *settings, threads, folder);
    if (!streams) return streams.error();
    if (first && *first != *streams)
      return Error{ExitCode::differs, fmt::format("{} threads draw {}, {} thread draws {}", threads,
                                                  streams->text(), c_thread_counts[0], first->text())};
    first = *streams;
  }
  return *first;
}

/// Fails unless every built-in scene is recorded with every shader and preset.
Status check_cover(const Record& record, const std::filesystem::path& source) {
  std::set<std::string> recorded;
  for (const Case& one : record.cases) {
    const auto settings = parse(one.options);
    if (!settings) return settings.error();
    recorded.insert(fmt::format("{} --shader {} --preset {}", one.scene, to_string(settings->plan.shader),
                                to_string(settings->plan.preset)));
  }
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(source / "sim/scenes", error)) {
    if (entry.path().extension() != ".toml") continue;
    for (const Shader shader : c_shaders)
      for (const Preset preset : {Preset::exact, Preset::published}) {
        const std::string wanted = fmt::format("{} --shader {} --preset {}", entry.path().stem().string(),
                                               to_string(shader), to_string(preset));
        if (!recorded.contains(wanted))
          return Error{ExitCode::differs,
                       fmt::format("streams.txt: no row for {}; add: - - 0 {} --size 61x47", wanted, wanted)};
      }
  }
  if (error) return tool_failed(fmt::format("sim/scenes: cannot be read: {}", error.message()));
  return Ok{};
}

Result<bool> compare(const std::filesystem::path& source, bool renew) {
  const std::filesystem::path path = source / "tb/project/streams/streams.txt";
  auto record = read_record(path);
  if (!record) return record.error();
  if (Status status = check_cover(*record, source); !status) return status.error();
  const auto folder = TemporaryFolder::make(std::filesystem::temp_directory_path());
  if (!folder) return folder.error();

  std::size_t changed = 0;
  for (Case& one : record->cases) {
    const auto streams = draw(one, source, folder->path());
    if (!streams)
      return Error{streams.error().code, fmt::format("{}: {}", one.text(), streams.error().message)};
    if (*streams == one.recorded) continue;
    ++changed;
    fmt::print("{}:{}{}\n  recorded {}\n  drawn    {}\n", one.text(),
               streams->init != one.recorded.init ? " init.txt differs" : "",
               streams->golden != one.recorded.golden ? " golden.trace differs" : "", one.recorded.text(),
               streams->text());
    one.recorded = *streams;
  }
  fmt::print("{} of {} cases differ from streams.txt\n", changed, record->cases.size());
  if (!renew || changed == 0) return changed == 0;
  if (Status status = write_record(path, *record); !status) return status.error();
  fmt::print("{}: renewed; its commit says why the streams changed\n", path.string());
  return true;
}

}  // namespace
}  // namespace halfway

int main(int argc, char** argv) {
  CLI::App app("Compares init vectors and golden fragments with those that streams.txt records");
  bool renew = false;
  std::string source;
  app.add_flag("--renew", renew, "write today's hashes, and print what changed");
  app.add_option("source", source, "the checkout")->required();
  CLI11_PARSE(app, argc, argv);
  const auto equal = halfway::compare(source, renew);
  if (!equal) {
    fmt::print(stderr, "{}\n", equal.error().message);
    return static_cast<int>(equal.error().code);
  }
  return *equal ? 0 : 1;
}
