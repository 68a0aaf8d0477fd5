// SPDX-License-Identifier: Apache-2.0
// Vectors that are none in packets that are right: random bits with their CRC, at the pins of the simulated
// board. The board must draw them in bounded time, report their fragments outside the frame, and draw the
// next frame as the twin does, without a reset in between.
#include <gtest/gtest.h>

#include <random>
#include <span>
#include <vector>

#include "golden_run/golden_run.hpp"
#include "setup/setup.hpp"
#include "sim/driver/frame_driver.hpp"
#include "sim/extras/board/board_picture.hpp"
#include "sim/extras/board/board_simulator.hpp"
#include "sim/files/load_scene.hpp"
#include "sim/os/must.hpp"
#include "words/formats.hpp"
#include "words/word.hpp"

namespace halfway::board {
namespace {

constexpr int c_bad_vectors = 24;
/// A random vector has up to 2^14 lines of up to 2^14 pixels, which take minutes here. The bits above this
/// count are set to 0.
constexpr std::uint32_t c_most_lines = 15;

std::vector<std::uint32_t> random_vector(std::mt19937& random, unsigned init_bits) {
  using At = words::Exact::init_header_at;
  std::vector<std::uint32_t> words((init_bits + 31) / 32);
  for (std::uint32_t& word : words) word = static_cast<std::uint32_t>(random());
  words::set_bits(words, At::upper_lines, 1 + random() % c_most_lines);
  words::set_bits(words, At::lower_lines, random() % (c_most_lines + 1));
  return words;
}

TEST(BoardInput, RandomVectorsEndAndTheNextFrameIsTheTwins) {
  const SimulatorFolders folders{HALFWAY_SOURCE_DIR, HALFWAY_CACHE_DIR};
  const Scene scene =
      must(load_scene(HALFWAY_SOURCE_DIR "/sim/report/timing.toml", folders.source / "sim/scenes"));
  const std::uint16_t background = rgb565(scene.background);
  const FrameStream stream = must(whole_stream(scene, c_board_frame, board_key()));
  const unsigned init_bits = stream.init_bits;

  std::mt19937 random(1);
  std::vector<HostAction> script = {whole_packet(end_packet(background))};
  for (int i = 0; i < c_bad_vectors; ++i)
    script.push_back(whole_packet(draw_packet(random_vector(random, init_bits), init_bits)));
  script.push_back(whole_packet(end_packet(background)));
  BoardPicture picture(background);
  picture.add(stream.golden);
  for (std::size_t at = 0; at < stream.words.size(); at += stream.vector_words())
    script.push_back(
        whole_packet(draw_packet(std::span(stream.words).subspan(at, stream.vector_words()), init_bits)));
  script.push_back(whole_packet(end_packet(background)));
  script.push_back({HostAction::Kind::wait});

  DotPicture last;
  const auto run = run_in_verilator(script, 0, folders, [&](const DotPicture& dots) {
    last = dots;
    return true;
  });
  EXPECT_TRUE(run.host_done);
  EXPECT_EQ(run.report.errors, 0U);
  EXPECT_GT(run.report.faults, 0U);
  EXPECT_EQ(run.report.frames, 3U);
  EXPECT_EQ(last, picture.dots());
}

}  // namespace
}  // namespace halfway::board
