// SPDX-License-Identifier: Apache-2.0
#include "sim/extras/board/board_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <span>
#include <utility>

#include "frame/assemble.hpp"
#include "golden_run/golden_run.hpp"
#include "scene/turntable.hpp"
#include "sim/driver/frame_driver.hpp"
#include "sim/extras/board/board_picture.hpp"
#include "sim/extras/board/board_sources.hpp"
#include "sim/extras/board/spi_packet.hpp"
#include "sim/files/image.hpp"
#include "sim/os/file.hpp"

namespace halfway::board {
namespace {

/// How long a host stops in the middle of a packet: longer than a picture of the monitor, 840000 clocks; in
/// GHDL, which is slow, for some lines.
constexpr std::uint32_t c_stop = 1'000'000, c_stop_in_ghdl = 10'000;
/// Pauses between packets of an unreliable host. In Verilator SpiWire makes others, between bits and bytes,
/// too.
constexpr std::size_t c_packets_per_pause = 4, c_longest_pause = 3000;

/// The vectors of a frame, one by one.
std::vector<std::vector<std::uint32_t>> vectors_of(const Scene& scene, const SetupOptions& options) {
  const FrameStream stream = must(
      whole_stream(scene, c_board_frame, board_key(), {.setup = options, .golden = GoldenDraws::nothing}));
  const auto size = static_cast<std::ptrdiff_t>(stream.vector_words());
  std::vector<std::vector<std::uint32_t>> vectors;
  for (auto at = stream.words.begin(); at != stream.words.end(); at += size)
    vectors.emplace_back(at, at + size);
  return vectors;
}

std::vector<Fragment> fragments_of(const std::vector<std::vector<std::uint32_t>>& vectors) {
  const std::unique_ptr<GoldenModel> golden = make_golden_model(board_key());
  std::vector<Fragment> fragments;
  for (const auto& vector : vectors) golden->draw(vector, fragments);
  return fragments;
}

/// Pixels whose colour differs from that of the golden frame with 24 bits of depth.
std::uint64_t depth_pixels(const BoardPicture& picture, std::span<const Fragment> fragments,
                           const glm::dvec3& background) {
  FrameAssembler assembler(c_board_frame, background);
  if (!assembler.add(fragments)) return 0;
  const std::vector<std::uint8_t>& rgb = assembler.frame().rgb;
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < picture.colours().size(); ++i)
    if (picture.colours()[i] != golden::board_colour(rgb[3 * i], rgb[3 * i + 1], rgb[3 * i + 2])) ++count;
  return count;
}

/// Appends the packets of a frame. An unreliable host spoils one and stops in another; both are removed from
/// `vectors`.
void append_frame(std::vector<HostAction>& script, std::vector<std::vector<std::uint32_t>>& vectors,
                  unsigned init_bits, Host host, std::uint32_t stop_clocks) {
  const std::size_t spoiled = vectors.size() / 3, stopped = 2 * vectors.size() / 3;
  const bool unreliable = host == Host::unreliable && spoiled < stopped;
  for (std::size_t i = 0; i < vectors.size(); ++i) {
    HostAction action = whole_packet(draw_packet(vectors[i], init_bits));
    if (unreliable && i % c_packets_per_pause == 0)
      script.push_back(
          {HostAction::Kind::pause, {}, 0, 1 + static_cast<std::uint32_t>(7919 * i % c_longest_pause)});
    if (unreliable && i == spoiled) action.bytes[action.bytes.size() / 2] ^= 0x10;
    if (unreliable && i == stopped) {
      action.bits = static_cast<std::uint32_t>(4 * action.bytes.size() + 3);
      action.clocks = stop_clocks;
    }
    script.push_back(std::move(action));
  }
  if (!unreliable) return;
  vectors.erase(vectors.begin() + static_cast<std::ptrdiff_t>(stopped));
  vectors.erase(vectors.begin() + static_cast<std::ptrdiff_t>(spoiled));
}

/// Compares the monitor's pictures with the expected ones, in order.
class PictureOrder {
 public:
  explicit PictureOrder(std::vector<DotPicture> expected)
      : expected_(std::move(expected)), shown_(expected_.size()) {}

  /// Returns false after the last expected picture, and after a difference.
  bool add(const DotPicture& dots) {
    if (!difference_.empty()) return false;
    ++count_;
    if (dots != expected_[at_] && at_ + 1 < expected_.size() && dots == expected_[at_ + 1]) ++at_;
    if (dots != expected_[at_]) {
      difference_ = describe(dots);
      different_ = dots;
      return false;
    }
    shown_[at_] = dots;
    return at_ + 1 < expected_.size();
  }
  bool complete() const { return difference_.empty() && at_ + 1 == expected_.size(); }
  std::uint64_t count() const { return count_; }
  std::string difference() const {
    if (!difference_.empty()) return difference_;
    const auto shown = std::ranges::count_if(shown_, [](const DotPicture& dots) { return !dots.empty(); });
    return fmt::format("the monitor has shown {} of {} frames", shown, expected_.size());
  }
  /// The picture that differs; empty if there is none.
  const DotPicture& different() const { return different_; }
  const std::vector<DotPicture>& expected() const { return expected_; }
  /// The monitor's pictures of the expected ones; empty for those that it has not shown.
  const std::vector<DotPicture>& shown() const { return shown_; }

 private:
  std::string describe(const DotPicture& dots) const {
    // Compare with the nearer one of the two that may be shown.
    const auto differing = [&](const DotPicture& expected) {
      std::uint64_t count = 0;
      for (std::size_t i = 0; i < dots.size(); ++i) count += dots[i] != expected[i] ? 1 : 0;
      return count;
    };
    std::size_t nearest = at_;
    if (at_ + 1 < expected_.size() && differing(expected_[at_ + 1]) < differing(expected_[at_])) ++nearest;
    const DotPicture& expected = expected_[nearest];
    const auto first = static_cast<std::size_t>(std::ranges::mismatch(dots, expected).in1 - dots.begin());
    const auto &got = dots[first], &wanted = expected[first];
    return fmt::format(
        "picture {} of the monitor: {} dots differ from frame {}; the first is {},{}: got {} {} {}, expected "
        "{} {} {}",
        count_, differing(expected), nearest, first % c_monitor.width, first / c_monitor.width, got[0],
        got[1], got[2], wanted[0], wanted[1], wanted[2]);
  }

  std::vector<DotPicture> expected_, shown_;
  std::size_t at_ = 0;
  std::uint64_t count_ = 0;
  std::string difference_;
  DotPicture different_;
};

/// Writes the last two pictures, the monitor's and the twin's.
void write_pictures(const std::filesystem::path& out, const PictureOrder& order) {
  must(make_folders(out));
  const auto write = [&](const std::string& name, const DotPicture& dots) {
    if (!dots.empty()) must(write_png(out / (name + ".png"), frame_of_dots(dots)));
  };
  const std::size_t first = order.expected().size() - 2;
  for (std::size_t i : {std::size_t{0}, std::size_t{1}}) {
    write(fmt::format("twin-{}", i + 1), order.expected()[first + i]);
    write(fmt::format("board-{}", i + 1), order.shown()[first + i]);
  }
  write("board-different", order.different());
}

}  // namespace

BoardCheck check_board(const Scene& scene, const BoardCheckOptions& options,
                       const SimulatorFolders& folders) {
  const std::uint16_t background = rgb565(scene.background);
  const unsigned init_bits = make_golden_model(board_key())->init_bits();
  BoardCheck check;
  // After reset all buffers are black. The first packet sets the background of the next frame.
  std::vector<HostAction> script = {whole_packet(end_packet(background))};
  std::vector<DotPicture> expected = {BoardPicture(0).dots()};
  std::uint64_t bad_packets = 0;
  for (const double turn : {0.0, options.turn_degrees}) {
    Scene turned = scene;
    turned.camera = orbited(scene.camera, turn, 0.0, 1.0);
    auto vectors = vectors_of(turned, options.setup);
    const std::size_t sent = vectors.size();
    append_frame(script, vectors, init_bits, options.host, options.ghdl ? c_stop_in_ghdl : c_stop);
    bad_packets += sent - vectors.size();
    script.push_back(whole_packet(end_packet(background)));
    const std::vector<Fragment> fragments = fragments_of(vectors);
    BoardPicture picture(background);
    picture.add(fragments);
    expected.push_back(picture.dots());
    check.vectors += vectors.size();
    check.fragments += fragments.size();
    check.depth_pixels += depth_pixels(picture, fragments, scene.background);
  }
  script.push_back({HostAction::Kind::wait});

  PictureOrder order(expected);
  const auto on_picture = [&](const DotPicture& dots) { return order.add(dots); };
  const std::uint32_t pause_seed = options.host == Host::unreliable ? 7 : 0;
  check.run = options.ghdl ? run_in_ghdl(script, folders, on_picture)
                           : run_in_verilator(script, pause_seed, folders, on_picture);
  check.pictures = order.count();
  write_pictures(options.out, order);
  if (!order.complete() || !check.run.host_done)
    throw Failure{{ExitCode::differs, fmt::format("{}: {}", scene.name, order.difference())}};
  const HostReport& report = check.run.report;
  if (report.errors != bad_packets || report.faults != 0)
    throw Failure{{ExitCode::differs,
                   fmt::format("{}: the status bytes report {} bad packets and {} faults instead of {} and 0",
                               scene.name, report.errors, report.faults, bad_packets)}};
  return check;
}

}  // namespace halfway::board
