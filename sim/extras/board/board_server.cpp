// SPDX-License-Identifier: Apache-2.0
#include "sim/extras/board/board_server.hpp"

#include <fmt/format.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <optional>
#include <string>
#include <vector>

#include "sim/extras/board/packet_twin.hpp"
#include "sim/extras/board/spi_packet.hpp"
#include "sim/extras/board/verilated_board.hpp"
#include "sim/files/image.hpp"
#include "sim/os/descriptor.hpp"
#include "sim/os/file.hpp"

namespace halfway::board {
namespace {

constexpr std::uint32_t c_longest_packet = 4096;
/// Until the last frame must be shown: two that are being shown or were begun before the swap, and the frame.
constexpr int c_pictures_at_end = 3;

[[noreturn]] void fail(const std::filesystem::path& socket, const char* what) {
  throw Failure{tool_failed(fmt::format("{}: {}: {}", socket.string(), what, std::strerror(errno)))};
}

/// Returns false at the end of the connection.
bool read_all(int descriptor, void* bytes, std::size_t count) {
  return count == 0 || ::recv(descriptor, bytes, count, MSG_WAITALL) == static_cast<ssize_t>(count);
}

bool write_all(int descriptor, const std::vector<std::uint8_t>& bytes) {
  std::size_t sent = 0;
  while (sent < bytes.size()) {
    const ssize_t count = ::send(descriptor, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
    if (count <= 0) return false;
    sent += static_cast<std::size_t>(count);
  }
  return true;
}

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

Result<ServerReport> serve_board(const std::filesystem::path& socket, const std::filesystem::path& out,
                                 const SimulatorFolders& folders) try {
  must(make_folders(out));
  PacketTwin twin;
  Pictures pictures(twin, out);
  VerilatedBoard board(folders, [&](const DotPicture& dots) { pictures.add(dots); });

  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (socket.string().size() >= sizeof address.sun_path)
    return bad_input(socket.string() + ": too long for the name of a socket; use a shorter path");
  std::strcpy(address.sun_path, socket.c_str());
  const Descriptor listener(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
  ::unlink(socket.c_str());
  if (listener.get() < 0 ||
      ::bind(listener.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 ||
      ::listen(listener.get(), 1) != 0)
    fail(socket, "cannot listen");
  const Descriptor client(::accept4(listener.get(), nullptr, nullptr, SOCK_CLOEXEC));
  ::unlink(socket.c_str());
  if (client.get() < 0) fail(socket, "no client");

  ServerReport report;
  SpiWire wire(0);
  SpiPins pins;
  const auto clock = [&] { pins = wire.clock(board.clock(pins)); };
  std::uint32_t count = 0;
  for (std::vector<std::uint8_t> packet; read_all(client.get(), &count, sizeof count);) {
    if (count == 0 || count > c_longest_packet)
      return bad_input(fmt::format("{}: a packet of {} bytes", socket.string(), count));
    packet.resize(count);
    if (!read_all(client.get(), packet.data(), count)) break;
    wire.send(packet);
    while (wire.busy()) clock();
    twin.take(packet, wire.received()[0]);
    ++report.packets;
    if (packet[0] == c_draw) ++report.vectors;
    if (!write_all(client.get(), wire.received())) break;
  }
  // Show the last frame.
  for (const std::uint64_t end = pictures.count() + c_pictures_at_end; twin.pending() > 0;) {
    clock();
    if (pictures.count() == end && twin.pending() > 0)
      return Error{ExitCode::differs,
                   fmt::format("the monitor has not shown the last {} frames", twin.pending())};
  }
  report.clocks = board.clocks();
  report.pictures = pictures.different();
  return report;
} catch (const Failure& failure) {
  return failure.error;
}

}  // namespace halfway::board
