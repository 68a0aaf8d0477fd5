// SPDX-License-Identifier: Apache-2.0
// `halfway init`: writes a scene's init vectors to a file, as vectors or as packets, and prints setup's
// counts.
#include <fmt/format.h>

#include "golden_run/packets.hpp"
#include "plan/plan.hpp"
#include "sim/cli/options.hpp"
#include "sim/driver/frame_driver.hpp"
#include "sim/files/init_file.hpp"
#include "sim/files/load_scene.hpp"
#include "sim/os/must.hpp"
#include "sim/os/threads.hpp"

namespace halfway::cli {
namespace {

struct InitCommand {
  DrawOptions draw;
  std::string scene;
  std::string file;
  bool packets = false;
};

// Draws the frame and gives the vectors of each batch to write().
template <class Write>
void draw_vectors(FrameDriver& driver, const std::string& name, Write&& write) {
  Progress progress(name);
  must(driver.draw([&](const Batch& batch) {
    progress.show(batch.done);
    write(batch.init_words);
    return Status(Ok{});
  }));
}

void write_vectors(const std::string& path, FrameDriver& driver, const HardwareKey& key,
                   const std::string& name) {
  auto file = must(InitFileWriter::open(path, key.name(), driver.init_bits()));
  draw_vectors(driver, name, [&](std::span<const std::uint32_t> words) { file.write(words); });
  must(file.commit());
}

// One 32-bit word per line, in hexadecimal, without a header: for $readmemh.
void write_packets(const std::string& path, FrameDriver& driver, const HardwareKey& key,
                   const std::string& name) {
  auto file = must(LineWriter::open(path));
  PacketWriter writer(key);
  const auto write = [&](std::span<const std::uint32_t> packets) {
    std::string lines;
    for (const std::uint32_t word : packets) fmt::format_to(std::back_inserter(lines), "{:08x}\n", word);
    file.append(lines);
  };
  std::vector<std::uint32_t> packets;
  draw_vectors(driver, name, [&](std::span<const std::uint32_t> words) {
    packets.clear();
    writer.append(packets, words);
    write(packets);
  });
  packets.clear();
  PacketWriter::append_end(packets);
  write(packets);
  must(file.commit());
}

int run(const Folders& folders, const InitCommand& command) {
  const auto draw = checked(command.draw);
  const auto scene = must(load_scene(command.scene, folders.scenes()));
  for (const std::string& note : scene.notes) say(note);
  const auto plan = must(plan_scene(scene, draw.plan));
  const HardwareKey& key = plan.key;
  FrameDriver driver(scene, draw.size, key, {}, {.setup = draw.setup, .workers = on_threads(draw.threads)});
  (command.packets ? write_packets : write_vectors)(command.file, driver, key, scene.name);
  for (const std::string& note : driver.notes()) say(fmt::format("{}: {}", scene.name, note));
  const SetupCounts& n = driver.counts();
  fmt::print("{}: {} init vectors and {} line records, {}, for {}\n", command.file, n.vectors, n.records,
             command.packets ? "in packets of 32-bit words" : fmt::format("of {} bits", driver.init_bits()),
             key.name());
  fmt::print(
      "  {} triangles: {} back-facing, {} outside, {} degenerate on the screen; {} drawn, {} of them {}: "
      "{} pieces in all, in {} init vectors and {} line records; {} points {}\n",
      scene.triangles.size(), n.projection.back_facing, n.projection.outside + n.projection.behind_near,
      n.projection.degenerate, n.triangles, n.subdivided,
      key.shader == Shader::quadratic ? "split in four" : "cut into strips", n.leaves, n.vectors, n.records,
      n.shaded, key.shader == Shader::quadratic ? "shaded" : "where vectors were computed");
  return 0;
}

}  // namespace

void add_init(CLI::App& app, const Folders& folders, int& exit_code) {
  CLI::App* sub = app.add_subcommand("init", "write a scene's init vectors");
  auto command = std::make_shared<InitCommand>();
  command->file = "init.txt";
  sub->add_option("scene", command->scene, "as for sim")->required();
  command->draw.add_to(*sub);
  sub->add_option("--file", command->file, "file to write")->capture_default_str();
  sub->add_flag("--packets", command->packets,
                "write packets of 32-bit words, for words_to_fragments: one word per line");
  sub->callback([=, &folders, &exit_code] { exit_code = run(folders, *command); });
}

}  // namespace halfway::cli
