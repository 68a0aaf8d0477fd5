// SPDX-License-Identifier: Apache-2.0
#include "sim/extras/board/board_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "golden_run/golden_run.hpp"
#include "scene/turntable.hpp"
#include "sim/driver/frame_driver.hpp"
#include "sim/files/image.hpp"
#include "sim/os/file.hpp"
#include "sim/os/socket_client.hpp"

namespace halfway::board {
namespace {

/// How long a host stops in the middle of a packet: longer than a picture of the monitor, 840000 clocks; in
/// GHDL, which is slow, for some lines.
constexpr std::uint32_t c_stop = 1'000'000, c_stop_in_ghdl = 10'000;
/// Pauses between packets of an unreliable host. In Verilator SpiWire makes others, between bits and bytes,
/// too.
constexpr std::size_t c_packets_per_pause = 4, c_longest_pause = 3000;
/// Of a client.
constexpr std::uint32_t c_longest_packet = 4096;
/// Until the last frame must be shown: two that are being shown or were begun before the swap, and the frame.
constexpr int c_pictures_at_end = 3;

[[noreturn]] void differ(std::string what) {
  throw Failure{{ExitCode::differs, std::move(what)}};
}

/// The twin of the board: draws packets by the golden model, and compares the monitor's pictures with its
/// own. Both are black at first.
class BoardTwin {
 public:
  /// Writes pictures of the monitor that differ from the one before to out/NAME-0.png and so on.
  BoardTwin(std::filesystem::path out, std::string name) : out_(std::move(out)), name_(std::move(name)) {
    must(make_folders(out_));
  }

  /// A packet that the board has received completely, with the status byte that it returned. A packet that
  /// the board drops changes nothing.
  void take(std::span<const std::uint8_t> packet, unsigned status) {
    if (packet.size() < c_around_payload || crc16(packet) != 0) return;
    const std::span<const std::uint8_t> payload = packet.subspan(1, packet.size() - c_around_payload);
    if (packet[0] == c_draw && (status & c_room) != 0 && payload.size() == (golden_->init_bits() + 7) / 8) {
      std::vector<std::uint32_t> words((golden_->init_bits() + 31) / 32);
      for (std::size_t byte = 0; byte < payload.size(); ++byte)
        words[byte / 4] |= std::uint32_t{payload[payload.size() - 1 - byte]} << (8 * (byte % 4));
      const std::span<const Fragment> fragments = golden_->draw(words);
      back_.add(fragments);
      ++report.vectors;
      report.fragments += fragments.size();
    } else if (packet[0] == c_end_frame && (status & c_ending) == 0 && payload.size() == 2) {
      // The monitor does not tell equal frames in sequence from one frame.
      DotPicture ended = back_.dots();
      if (ended != (ended_.empty() ? shown_ : ended_.back())) ended_.push_back(std::move(ended));
      report.depth_pixels += back_.depth_pixels();
      back_ = BoardPicture(static_cast<std::uint16_t>(payload[0] << 8 | payload[1]));
    }
  }

  /// A picture of the monitor: the one before or the next frame.
  void compare(const DotPicture& dots) {
    const bool first = report.pictures++ == 0;
    if (dots != shown_) {
      if (ended_.empty() || dots != ended_.front()) refuse(dots);
      shown_ = dots;
      ended_.pop_front();
    } else if (!first) {
      return;
    }
    write(std::to_string(report.different_pictures++), dots);
  }

  /// Frames that have ended, and that the monitor has not shown yet.
  const std::deque<DotPicture>& pending() const { return ended_; }
  void write(const std::string& number, const DotPicture& dots) const {
    must(write_png(file(number), frame_of_dots(dots)));
  }

  BoardReport report;

 private:
  static constexpr std::size_t c_around_payload = 3;  ///< bytes of command and CRC

  std::filesystem::path file(const std::string& number) const { return out_ / (name_ + number + ".png"); }

  [[noreturn]] void refuse(const DotPicture& dots) const {
    write("different", dots);
    // Compare with the nearer one of the two that may be shown.
    const auto differing = [&](const DotPicture& expected) {
      std::uint64_t count = 0;
      for (std::size_t i = 0; i < dots.size(); ++i) count += dots[i] != expected[i] ? 1 : 0;
      return count;
    };
    const bool next = !ended_.empty() && differing(ended_.front()) < differing(shown_);
    const DotPicture& expected = next ? ended_.front() : shown_;
    const auto first = static_cast<std::size_t>(std::ranges::mismatch(dots, expected).in1 - dots.begin());
    const auto &got = dots[first], &wanted = expected[first];
    differ(fmt::format(
        "picture {} of the monitor: {} dots differ from the twin's; the first is {},{}: got {} {} {}, "
        "expected {} {} {}; see {}",
        report.pictures, differing(expected), first % c_monitor.width, first / c_monitor.width, got[0],
        got[1], got[2], wanted[0], wanted[1], wanted[2], file("different").string()));
  }

  std::filesystem::path out_;
  std::string name_;
  std::unique_ptr<GoldenModel> golden_ = make_golden_model(board_key());
  BoardPicture back_{0};
  DotPicture shown_ = back_.dots();
  std::deque<DotPicture> ended_;
};

/// Appends the packets of a frame. An unreliable host spoils one and stops in another. Returns their number.
std::uint64_t append_frame(std::vector<HostAction>& script, const Scene& scene,
                           const BoardCheckOptions& options) {
  const FrameStream stream = must(whole_stream(scene, c_board_frame, board_key(),
                                               {.setup = options.setup, .golden = GoldenDraws::nothing}));
  const std::size_t words = stream.vector_words(), vectors = stream.words.size() / words;
  const std::size_t spoiled = vectors / 3, stopped = 2 * vectors / 3;
  const bool unreliable = options.host == Host::unreliable && spoiled < stopped;
  for (std::size_t i = 0; i < vectors; ++i) {
    HostAction action =
        whole_packet(draw_packet(std::span(stream.words).subspan(i * words, words), stream.init_bits));
    if (unreliable && i % c_packets_per_pause == 0)
      script.push_back(
          {HostAction::Kind::pause, {}, 0, 1 + static_cast<std::uint32_t>(7919 * i % c_longest_pause)});
    if (unreliable && i == spoiled) action.bytes[action.bytes.size() / 2] ^= 0x10;
    if (unreliable && i == stopped) {
      action.bits = static_cast<std::uint32_t>(4 * action.bytes.size() + 3);
      action.clocks = options.ghdl ? c_stop_in_ghdl : c_stop;
    }
    script.push_back(std::move(action));
  }
  return unreliable ? 2 : 0;
}

}  // namespace

BoardReport check_board(const Scene& scene, const BoardCheckOptions& options,
                        const SimulatorFolders& folders) {
  // The first packet sets the background of the next frame.
  const HostAction end = whole_packet(end_packet(rgb565(scene.background)));
  std::vector<HostAction> script = {end};
  std::uint64_t bad_packets = 0;
  for (const double turn : {0.0, options.turn_degrees}) {
    Scene turned = scene;
    turned.camera = orbited(scene.camera, turn, 0.0, 1.0);
    bad_packets += append_frame(script, turned, options);
    script.push_back(end);
  }
  // The host sends a packet only if there is room for it.
  BoardTwin twin(options.out, "board-");
  for (const HostAction& action : script) twin.take(std::span(action.bytes).first(action.bits / 8), c_room);
  for (std::size_t i = 0; i < twin.pending().size(); ++i)
    must(write_png(options.out / fmt::format("twin-{}.png", i + 1), frame_of_dots(twin.pending()[i])));
  script.push_back({HostAction::Kind::wait});

  const auto on_picture = [&](const DotPicture& dots) {
    twin.compare(dots);
    return !twin.pending().empty();
  };
  const std::uint32_t pause_seed = options.host == Host::unreliable ? 7 : 0;
  const BoardRun run = options.ghdl ? run_in_ghdl(script, folders, on_picture)
                                    : run_in_verilator(script, pause_seed, folders, on_picture);
  if (!twin.pending().empty() || !run.host_done)
    differ(
        fmt::format("{}: the monitor has not shown the last {} frames", scene.name, twin.pending().size()));
  if (run.report.errors != bad_packets || run.report.faults != 0)
    differ(fmt::format("{}: the status bytes report {} bad packets and {} faults instead of {} and 0",
                       scene.name, run.report.errors, run.report.faults, bad_packets));
  twin.report.packets = run.report.packets;
  twin.report.dropped = run.report.errors;
  twin.report.clocks = run.clocks;
  return twin.report;
}

BoardReport serve_board(const std::filesystem::path& socket, const std::filesystem::path& out,
                        const SimulatorFolders& folders) {
  BoardTwin twin(out, "picture-");
  VerilatedBoard board(folders, [&](const DotPicture& dots) { twin.compare(dots); });
  SocketClient client(socket);
  SpiWire wire(0);
  SpiPins pins;
  const auto clock = [&] { pins = wire.clock(board.clock(pins)); };
  std::uint32_t count = 0;
  for (std::vector<std::uint8_t> packet; client.read(&count, sizeof count);) {
    if (count == 0 || count > c_longest_packet)
      throw_bad_input("{}: a packet of {} bytes", socket.string(), count);
    packet.resize(count);
    if (!client.read(packet.data(), count)) break;
    wire.send(packet);
    while (wire.busy()) clock();
    twin.take(packet, wire.received()[0]);
    ++twin.report.packets;
    if (!client.write(wire.received())) break;
  }
  // Show the last frame.
  for (const std::uint64_t end = twin.report.pictures + c_pictures_at_end; !twin.pending().empty();) {
    clock();
    if (twin.report.pictures == end && !twin.pending().empty())
      differ(fmt::format("the monitor has not shown the last {} frames", twin.pending().size()));
  }
  twin.report.clocks = board.clocks();
  return twin.report;
}

}  // namespace halfway::board
