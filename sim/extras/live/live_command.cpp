// SPDX-License-Identifier: Apache-2.0
// `halfway live`: a page that draws scenes by the RTL in a browser.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <thread>

#include "sim/cli/options.hpp"
#include "sim/extras/live/live_page.hpp"

namespace halfway::cli {
namespace {

struct LiveCommand {
  std::vector<std::string> scenes;
  std::string out = "build/live/index.html";
  unsigned threads = 0;
  const synth::Family* family = &synth::c_default_family;
};

void run(const Folders& folders, const LiveCommand& command) {
  Progress progress("live");
  const live::LivePage made = live::write_live(
      {.page = command.out,
       .scenes = command.scenes.empty() ? builtin_scenes(folders) : command.scenes,
       .meshes = command.scenes.empty(),
       .folders = {folders.source, folders.cache()},
       .family = command.family,
       .threads = command.threads != 0 ? command.threads : std::max(1U, std::thread::hardware_concurrency()),
       .on_progress = [&](const std::string& what) { progress.show(what); }});
  progress.clear();
  fmt::print("{}: {} kinds of hardware, {:.1f} MB\n", command.out, made.hardware,
             static_cast<double>(made.bytes) / 1e6);
}

}  // namespace

void add_live(CLI::App& app, const Folders& folders, int&) {
  const auto command = std::make_shared<LiveCommand>();
  CLI::App* sub =
      app.add_subcommand("live", "write a page that draws the built-in scenes by the RTL in a browser");
  sub->add_option("scene", command->scenes, "built-in scenes (default: all, and the hardware of mesh files)");
  sub->add_option("--out", command->out, "file to write")->capture_default_str();
  sub->add_option("--threads", command->threads, "threads for building (0: all cores)")
      ->capture_default_str();
  add_device(*sub, command->family);
  sub->callback([&folders, command] { run(folders, *command); });
}

}  // namespace halfway::cli
