// SPDX-License-Identifier: Apache-2.0
// `halfway view`: a scene from all sides, drawn by the RTL in Verilator or lanes as fast as possible.
#include <fmt/format.h>
#include <malloc.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <regex>
#include <string_view>

#include "sim/cli/options.hpp"
#include "sim/files/image.hpp"
#include "sim/files/image_library.hpp"
#include "sim/files/load_scene.hpp"
#include "sim/files/terminal_picture.hpp"
#include "sim/generator/generated_files.hpp"
#include "sim/generator/word_lengths/made_tables.hpp"
#include "sim/os/file.hpp"
#include "sim/os/interruption.hpp"
#include "sim/os/must.hpp"
#include "sim/os/printable.hpp"
#include "sim/os/seconds.hpp"
#include "sim/run/result_files.hpp"
#include "sim/run/video.hpp"
#include "sim/run/view.hpp"

namespace halfway::cli {
namespace {

using Clock = std::chrono::steady_clock;

constexpr unsigned c_usual_rate = 16;  // as in the papers
constexpr unsigned c_most_rate = 1000, c_most_columns = 4096;

// Buffers for a frame's fragments are allocated and freed for each frame. Keep freed memory: otherwise the
// system would have to map all its pages again.
void keep_freed_memory() {
  constexpr int c_most_kept = 256 << 20, c_largest_threshold = 32 << 20;
  ::mallopt(M_TRIM_THRESHOLD, c_most_kept);
  ::mallopt(M_MMAP_THRESHOLD, c_largest_threshold);
}

struct ViewCommand {
  DrawOptions draw;
  bool out_given = false;
  std::string scene;
  std::uint32_t frames = 36;
  std::string engine = "auto";
  bool no_compare = false;
  std::optional<std::string> format;
  std::optional<std::string> video;
  unsigned rate = c_usual_rate;
  bool terminal = false;
  std::optional<std::uint32_t> columns;
  std::optional<std::string> colours;
};

// Where the frames are written.
struct Outputs {
  bool images = false, ppm = false;
  std::filesystem::path folder;  ///< of images
  std::optional<std::filesystem::path> video;
  unsigned rate = c_usual_rate;
  bool terminal = false;
  std::optional<std::uint32_t> columns;  ///< std::nullopt: those of the terminal
  TerminalColours colours = TerminalColours::full;

  std::string name_of(std::uint32_t number) const {
    return fmt::format("frame_{:04}.{}", number, ppm ? "ppm" : "png");
  }
};

TerminalColours colours_of_terminal() {
  const char* said = std::getenv("COLORTERM");
  const std::string_view text = said == nullptr ? "" : said;
  return text == "truecolor" || text == "24bit" ? TerminalColours::full : TerminalColours::palette;
}

Outputs checked(const ViewCommand& c) {
  Outputs o;
  o.images = c.out_given || (!c.video && !c.terminal);
  if (c.format && !o.images)
    throw_bad_input("--format is of images, and none are asked for; give --out as well");
  o.ppm = c.format == "ppm";
  o.rate = c.rate;
  if (c.video) {
    o.video = *c.video;
    VideoWriter::check(*o.video);
  }
  o.terminal = c.terminal;
  o.columns = c.columns;
  if (o.terminal && !o.columns && isatty(STDOUT_FILENO) == 0)
    throw_bad_input(
        "--terminal: standard output is no terminal; with --columns the pictures are still written");
  if (!c.colours)
    o.colours = colours_of_terminal();
  else
    o.colours = *c.colours == "24bit" ? TerminalColours::full : TerminalColours::palette;
  return o;
}

// std::nullopt: the fastest available engine.
std::optional<EngineKind> checked_engine(const std::string& name) {
  if (name == "auto") return std::optional<EngineKind>();
  for (const EngineKind kind : {EngineKind::verilator, EngineKind::lanes})
    if (name == to_string(kind)) return std::optional(kind);
  throw_bad_input("--simulator: '{}' is none of auto, verilator and lanes", name);
}

// Removes the frames of an earlier turn, which may have had more frames, and unfinished files of a killed
// run.
void forget_frames(const std::filesystem::path& folder) {
  const std::regex ours("frame_[0-9]{4}\\.(png|ppm)(\\.part-.*)?");
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error))
    if (!error && std::regex_match(entry.path().filename().string(), ours))
      std::filesystem::remove(entry.path(), error);
  if (error) throw_tool_failed("{}: cannot remove old frames: {}", folder.string(), error.message());
}

// Half blocks on standard output. On a terminal each picture overwrites the previous one.
class Screen {
 public:
  explicit Screen(const Outputs& outputs) : o_(outputs), terminal_(isatty(STDOUT_FILENO) != 0) {}
  ~Screen() { leave(); }
  Screen(const Screen&) = delete;
  Screen& operator=(const Screen&) = delete;

  void show(const Frame& frame, const std::string& caption) {
    std::uint32_t columns = o_.columns.value_or(80), lines = c_most_columns;
    struct winsize window{};
    if (terminal_ && ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &window) == 0 && window.ws_col != 0 &&
        window.ws_row > 1) {
      if (!o_.columns) columns = window.ws_col;
      lines = window.ws_row - 1U;  // the last one shows the caption
    }
    std::string text;
    if (terminal_) text += entered_ ? "\033[H" : "\033[?25l\033[2J\033[H";
    entered_ = true;
    text += terminal_picture(frame, fitting_size(frame.size, columns, lines), o_.colours);
    if (terminal_)
      text += fmt::format("\033[K{}\033[J", caption.substr(0, columns));
    else
      text += caption + "\n";
    if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
      throw_tool_failed("standard output: {}", std::strerror(errno));
  }
  /// Restores the terminal below the last picture.
  void leave() {
    constexpr std::string_view c_restore = "\033[0m\033[?25h\n";
    if (terminal_ && entered_ && ::write(STDOUT_FILENO, c_restore.data(), c_restore.size()) < 0) return;
    entered_ = false;
  }

 private:
  const Outputs& o_;
  bool terminal_;
  bool entered_ = false;
};

void print_difference(const ViewSummary& s) {
  const ViewDifference& d = *s.difference;
  say(fmt::format("{}: frame {}: {} differs from the golden model", s.scene, d.frame, d.run.simulator));
  if (!d.run.fault.empty()) say("  " + d.run.fault);
  fmt::print(stderr, "{}", d.run.description);
  const glm::dvec3 eye = d.camera.eye_world;
  say(fmt::format("  halfway sim and halfway why show more, of the scene with eye = [{}, {}, {}] in [camera]",
                  eye.x, eye.y, eye.z));
}

// Locks the folder while frames are written to it. Without images no folder is locked.
std::optional<Descriptor> prepare_folder(Outputs& o, const ViewCommand& c, const DrawSettings& draw,
                                         const std::string& scene) {
  if (!o.images) return std::nullopt;
  o.folder = c.out_given ? draw.out : ResultFiles::of(draw.out, scene, draw.plan).folder / "view";
  must(TemporaryFolder::make(o.folder));
  auto lock = must(lock_folder(o.folder, [&] {
    say(fmt::format("waiting for {} (another halfway view draws into it)", o.folder.string()));
  }));
  forget_frames(o.folder);
  return lock;
}

// Prints the summary and names the files. Returns true if all frames were compared and are equal.
bool print_results(const ViewSummary& summary, const Outputs& o, std::optional<VideoWriter>& video) {
  for (const std::string& note : summary.notes) say(note);
  fmt::print("{}", printable(to_lines(summary)));
  const auto nothing = summary.nothing_compared();
  if (nothing) say(fmt::format("{}: {}", summary.scene, *nothing));
  if (summary.difference) {
    print_difference(summary);
    video.reset();
  }
  if (o.images)
    fmt::print("{} to {}\n", printable((o.folder / o.name_of(0)).string()),
               o.name_of(std::max(summary.frames, 1U) - 1));
  if (video) {
    video->commit();
    fmt::print("{}: {} frames a second\n", printable(o.video->string()), o.rate);
  }
  return !summary.difference.has_value() && !nothing;
}

bool draw_turn(const ViewCommand& command, const Folders& folders, const DrawSettings& draw,
               std::optional<EngineKind> engine, Outputs& o) {
  const auto scene = must(load_scene(command.scene, folders.scenes()));
  for (const std::string& note : scene.notes) say(note);
  const auto lock = prepare_folder(o, command, draw, scene.name);
  // Load the library now: it takes as long as many small frames, and it may be missing.
  if (o.images && !o.ppm) must(image_library());

  Screen screen(o);
  Progress progress("view");
  std::optional<VideoWriter> video;
  Clock::time_point start;
  std::optional<Interruption> interruption;
  ViewSettings settings{draw};
  settings.frames = command.frames;
  settings.compare = !command.no_compare;
  settings.folders = {folders.source, folders.cache()};
  settings.engine = engine;
  settings.on_build = [&](const std::string& key, EngineKind of) {
    progress.show(fmt::format("building {} for {}", key, title(of)));
  };
  settings.on_ready = [&] {
    progress.clear();
    // Called before a signal ends the process.
    interruption.emplace([&] {
      if (video) video->abandon();
      if (o.terminal) screen.leave();
    });
    start = Clock::now();
    if (!o.video) return;
    const auto writing = interruption->writing();
    video.emplace(*o.video, draw.size, o.rate);
  };
  if (o.images)
    settings.on_drawn = [&](std::uint32_t number, const Frame& frame) {
      const auto writing = interruption->writing();
      const auto path = o.folder / o.name_of(number);
      must(o.ppm ? write_ppm(path, frame) : write_png(path, frame, Compression::quick));
    };
  settings.on_next = [&](std::uint32_t number, const Frame& frame) {
    const auto writing = interruption->writing();
    const std::string so_far = fmt::format("frame {} of {}, {:.1f} frames a second", number + 1,
                                           command.frames, (number + 1) / seconds_since(start));
    if (video) video->add(frame);
    if (o.terminal)
      screen.show(frame, so_far);
    else
      progress.show(so_far);
  };

  auto drawn = caught([&] { return view(scene, settings); });
  // Not acquired after a signal: the interrupted work must not be reported as an error.
  std::shared_lock<std::shared_timed_mutex> writing;
  if (interruption) writing = interruption->writing();
  progress.clear();
  const ViewSummary summary = must(std::move(drawn));
  if (o.terminal) screen.leave();
  return print_results(summary, o, video);
}

int run(const Folders& folders, const ViewCommand& command) {
  const DrawSettings draw = checked(command.draw);
  const std::optional<EngineKind> engine = checked_engine(command.engine);
  Outputs outputs = checked(command);
  keep_freed_memory();
  bool right = draw_turn(command, folders, draw, engine, outputs);
  // As in sim_command.cpp: frames may be equal although a generated file was changed.
  for (const std::string& message : tables::stale_files(folders.source, tables::compiled_sizes(), false)) {
    fmt::print(stderr, "{}\n", message);
    right = false;
  }
  return static_cast<int>(right ? ExitCode::equal : ExitCode::differs);
}

}  // namespace

void add_view(CLI::App& app, const Folders& folders, int& exit_code) {
  CLI::App* sub = app.add_subcommand(
      "view",
      "draw a scene from all sides by the RTL in Verilator or lanes: images, a video, or the terminal");
  auto command = std::make_shared<ViewCommand>();
  sub->add_option("scene", command->scene, "as for sim")->required();
  command->draw.add_to(*sub);
  CLI::Option* out = sub->get_option("--out");
  out->description(
      "folder for frame_0000.png and so on; older frames in it are removed (default:\n"
      "build/out/<scene>/<shader>/view; none with --video or --terminal)");
  out->default_str("");
  sub->get_option("--threads")->description("threads, each of which draws whole frames (0: all cores)");
  sub->add_option(
         "--frames", command->frames,
         fmt::format("frames of one turn of the camera around its target, 1 to {}", c_most_view_frames))
      ->check(CLI::Range(1U, c_most_view_frames))
      ->capture_default_str();
  sub->add_option("--format", command->format, "format of images: png or ppm (default: png)")
      ->check(CLI::IsMember({"png", "ppm"}));
  CLI::Option* video =
      sub->add_option("--video", command->video, "file for a video, by ffmpeg, such as turn.mp4");
  sub->add_option("--rate", command->rate,
                  fmt::format("frames per second of the video, 1 to {} (default: {}, as in the papers)",
                              c_most_rate, c_usual_rate))
      ->check(CLI::Range(1U, c_most_rate))
      ->needs(video);
  CLI::Option* terminal =
      sub->add_flag("--terminal", command->terminal, "draw in the terminal, by half blocks");
  sub->add_option("--columns", command->columns,
                  "with --terminal: width of the pictures; they are then also written without a terminal\n"
                  "(default: the terminal's)")
      ->check(CLI::Range(1U, c_most_columns))
      ->needs(terminal);
  sub->add_option("--colours", command->colours, "with --terminal: 24bit or 256 (default: by COLORTERM)")
      ->check(CLI::IsMember({"24bit", "256"}))
      ->needs(terminal);
  sub->add_option("--simulator", command->engine,
                  "verilator; lanes: many copies of the RTL in one vector, faster, but longer to build; or\n"
                  "auto: lanes from 2^26 pixels of all frames on")
      ->capture_default_str();
  sub->add_flag("--no-compare", command->no_compare,
                "do not compare with the golden model: faster, but the frames are not checked");
  sub->callback([=, &folders, &exit_code] {
    command->out_given = out->count() != 0;
    exit_code = run(folders, *command);
  });
}

}  // namespace halfway::cli
