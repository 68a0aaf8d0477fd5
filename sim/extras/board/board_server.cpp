// SPDX-License-Identifier: Apache-2.0
#include "sim/extras/board/board_server.hpp"

#include <fmt/format.h>

#include <deque>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "golden_run/golden_run.hpp"
#include "sim/extras/board/board_picture.hpp"
#include "sim/extras/board/board_sources.hpp"
#include "sim/extras/board/spi_packet.hpp"
#include "sim/extras/board/verilated_board.hpp"
#include "sim/files/image.hpp"
#include "sim/os/file.hpp"
#include "sim/os/socket_client.hpp"

namespace halfway::board {
namespace {

constexpr std::uint32_t c_longest_packet = 4096;
/// Until the last frame must be shown: two that are being shown or were begun before the swap, and the frame.
constexpr int c_pictures_at_end = 3;

/// The twin of the board for packets: draws them by the golden model, and gives the pictures that the monitor
/// may show.
class PacketTwin {
 public:
  /// A packet that the board has received completely, with the status byte that it returned. Packets that the
  /// board drops change nothing.
  void take(std::span<const std::uint8_t> packet, std::uint8_t status) {
    if (packet.size() < c_around_payload || crc16(packet) != 0) return;
    const std::span<const std::uint8_t> payload = packet.subspan(1, packet.size() - c_around_payload);
    if (packet[0] == c_draw && (status & c_room) != 0 && payload.size() == (golden_->init_bits() + 7) / 8) {
      std::vector<std::uint32_t> words((golden_->init_bits() + 31) / 32);
      for (std::size_t byte = 0; byte < payload.size(); ++byte)
        words[byte / 4] |= std::uint32_t{payload[payload.size() - 1 - byte]} << (8 * (byte % 4));
      back_.add(golden_->draw(words));
    } else if (packet[0] == c_end_frame && (status & c_ending) == 0 && payload.size() == 2) {
      ended_.push_back(back_.dots());
      back_ = BoardPicture(static_cast<std::uint16_t>(payload[0] << 8 | payload[1]));
    }
  }

  /// A picture of the monitor. Returns false if it is neither the one before nor the next frame.
  bool shows(const DotPicture& dots) {
    if (dots == shown_) return true;
    if (ended_.empty() || dots != ended_.front()) return false;
    shown_ = dots;
    ended_.pop_front();
    return true;
  }

  /// Number of ended frames that the monitor has not shown.
  std::size_t pending() const { return ended_.size(); }

 private:
  static constexpr std::size_t c_around_payload = 3;  ///< bytes of command and CRC

  std::unique_ptr<GoldenModel> golden_ = make_golden_model(board_key());
  BoardPicture back_{0};
  DotPicture shown_ = back_.dots();
  std::deque<DotPicture> ended_;  ///< frames that are not shown yet
};

/// Compares the monitor's pictures with the twin's, and writes those that differ from the one before.
class Pictures {
 public:
  Pictures(PacketTwin& twin, std::filesystem::path out) : twin_(twin), out_(std::move(out)) {}

  void add(const DotPicture& dots) {
    ++count_;
    const bool equal = twin_.shows(dots);
    const std::string name = equal ? fmt::format("picture-{}.png", different_) : "picture-different.png";
    if (dots != last_) must(write_png(out_ / name, frame_of_dots(dots)));
    if (!equal)
      throw Failure{
          {ExitCode::differs, fmt::format("picture {} of the monitor differs from the twin's; see {}", count_,
                                          (out_ / name).string())}};
    if (dots != last_) ++different_;
    last_ = dots;
  }
  std::uint64_t count() const { return count_; }
  std::uint64_t different() const { return different_; }

 private:
  PacketTwin& twin_;
  std::filesystem::path out_;
  DotPicture last_;
  std::uint64_t count_ = 0, different_ = 0;
};

}  // namespace

ServerReport serve_board(const std::filesystem::path& socket, const std::filesystem::path& out,
                         const SimulatorFolders& folders) {
  must(make_folders(out));
  PacketTwin twin;
  Pictures pictures(twin, out);
  VerilatedBoard board(folders, [&](const DotPicture& dots) { pictures.add(dots); });

  SocketClient client(socket);
  ServerReport report;
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
    ++report.packets;
    if (packet[0] == c_draw) ++report.vectors;
    if (!client.write(wire.received())) break;
  }
  // Show the last frame.
  for (const std::uint64_t end = pictures.count() + c_pictures_at_end; twin.pending() > 0;) {
    clock();
    if (pictures.count() == end && twin.pending() > 0)
      throw Failure{
          {ExitCode::differs, fmt::format("the monitor has not shown the last {} frames", twin.pending())}};
  }
  report.clocks = board.clocks();
  report.pictures = pictures.different();
  return report;
}

}  // namespace halfway::board
