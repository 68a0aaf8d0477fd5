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
#include "sim/cli/options.hpp"
#include "sim/driver/frame_driver.hpp"
#include "sim/files/init_file.hpp"
#include "sim/files/load_scene.hpp"
#include "sim/files/trace.hpp"
#include "sim/os/command_line.hpp"
#include "sim/os/file.hpp"
#include "sim/os/must.hpp"
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

Record read_record(const std::filesystem::path& path) {
  Record record;
  std::istringstream lines(must(read_file(path)));
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
      throw Failure{bad_input(
          fmt::format("{}:{}: a broken row; it must read: <init hash> <golden hash> <fragments> <scene> "
                      "<options>, with - - 0 for a new case",
                      path.string(), number))};
    std::getline(fields, one.options);
    record.cases.push_back(std::move(one));
  }
  return record;
}

void write_record(const std::filesystem::path& path, const Record& record) {
  std::string text = record.comments;
  for (const Case& one : record.cases) text += fmt::format("{} {}\n", one.recorded.text(), one.text());
  must(write_file(path, text));
}

cli::DrawSettings parse(const std::string& options) {
  cli::DrawOptions draw;
  CLI::App app;
  draw.add_to(app);
  app.parse(options);
  return checked(draw);
}

std::string hash_of(const std::filesystem::path& path) {
  return ContentHash().add(must(read_file(path))).hex();
}

/// Runs setup and golden model of one case. Writes init.txt and golden.trace to `folder`.
Streams draw(const Scene& scene, const cli::DrawSettings& settings, unsigned threads,
             const std::filesystem::path& folder) {
  const HardwareKey key = must(plan_scene(scene, settings.plan)).key;
  FrameDriver driver(scene, settings.size, key, {},
                     {.setup = settings.setup, .workers = on_threads(threads)});
  const std::filesystem::path init_path = folder / "init.txt", golden_path = folder / "golden.trace";
  auto init = must(InitFileWriter::open(init_path, key.name(), driver.init_bits()));
  auto golden = must(TraceWriter::open(golden_path, key.name()));
  must(driver.draw([&](const Batch& batch) -> Status {
    init.write(batch.init_words);
    golden.write(batch.golden);
    return Ok{};
  }));
  must(init.commit());
  must(golden.commit());
  return {hash_of(init_path), hash_of(golden_path), driver.fragments()};
}

/// The case's streams. Fails if they depend on the number of threads.
Streams draw(const Case& one, const std::filesystem::path& source, const std::filesystem::path& folder) {
  const cli::DrawSettings settings = parse(one.options);
  // A scene name with a file ending is a file of this folder.
  const bool own = std::filesystem::path(one.scene).has_extension();
  const Scene scene = must(load_scene(own ? (source / "tb/project/streams" / one.scene).string() : one.scene,
                                      source / "sim/scenes"));
  std::optional<Streams> first;
  for (const unsigned threads : c_thread_counts) {
    const Streams streams = draw(scene, settings, threads, folder);
    if (first && *first != streams)
      throw Failure{Error{ExitCode::differs, fmt::format("{} threads draw {}, {} thread draws {}", threads,
                                                         streams.text(), c_thread_counts[0], first->text())}};
    first = streams;
  }
  return *first;
}

/// Fails unless every built-in scene is recorded with every shader and preset.
void check_cover(const Record& record, const std::filesystem::path& source) {
  std::set<std::string> recorded;
  for (const Case& one : record.cases) {
    const PlanRequest plan = parse(one.options).plan;
    recorded.insert(
        fmt::format("{} --shader {} --preset {}", one.scene, to_string(plan.shader), to_string(plan.preset)));
  }
  for (const std::string& scene : cli::builtin_scenes({source}))
    for (const Shader shader : c_shaders)
      for (const Preset preset : {Preset::exact, Preset::published}) {
        const std::string wanted =
            fmt::format("{} --shader {} --preset {}", scene, to_string(shader), to_string(preset));
        if (!recorded.contains(wanted))
          throw Failure{
              Error{ExitCode::differs,
                    fmt::format("streams.txt: no row for {0}; add: - - 0 {0} --size 61x47", wanted)}};
      }
}

ExitCode compare(const std::filesystem::path& source, bool renew) {
  const std::filesystem::path path = source / "tb/project/streams/streams.txt";
  Record record = read_record(path);
  check_cover(record, source);
  const TemporaryFolder folder = must(TemporaryFolder::make(std::filesystem::temp_directory_path()));

  std::size_t changed = 0;
  for (Case& one : record.cases) {
    const auto streams = caught([&] { return draw(one, source, folder.path()); });
    if (!streams)
      throw Failure{{streams.error().code, fmt::format("{}: {}", one.text(), streams.error().message)}};
    if (*streams == one.recorded) continue;
    ++changed;
    fmt::print("{}:{}{}\n  recorded {}\n  drawn    {}\n", one.text(),
               streams->init != one.recorded.init ? " init.txt differs" : "",
               streams->golden != one.recorded.golden ? " golden.trace differs" : "", one.recorded.text(),
               streams->text());
    one.recorded = *streams;
  }
  fmt::print("{} of {} cases differ from streams.txt\n", changed, record.cases.size());
  if (changed == 0) return ExitCode::equal;
  if (!renew) return ExitCode::differs;
  write_record(path, record);
  fmt::print("{}: renewed; its commit says why the streams changed\n", path.string());
  return ExitCode::equal;
}

}  // namespace
}  // namespace halfway

int main(int argc, char** argv) {
  using namespace halfway;
  CLI::App app("Compares init vectors and golden fragments with those that streams.txt records",
               "halfway_streams");
  bool renew = false;
  std::string source;
  app.add_flag("--renew", renew, "write today's hashes, and print what changed");
  app.add_option("source", source, "the checkout")->required();
  int exit_code = 0;
  app.callback([&] { exit_code = static_cast<int>(compare(source, renew)); });
  return cli::run_program(app, argc, argv, exit_code);
}
