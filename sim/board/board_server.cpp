// SPDX-License-Identifier: Apache-2.0
#include "sim/board/board_server.hpp"

#include <fmt/format.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <optional>
#include <string>
#include <vector>

#include "sim/board/packet_twin.hpp"
#include "sim/board/spi_packet.hpp"
#include "sim/board/verilated_board.hpp"
#include "sim/pictures/image.hpp"
#include "sim/system/file.hpp"

namespace halfway::board {
namespace {

constexpr std::uint32_t c_longest_packet = 4096;
/// Until the last frame must be shown: two that are being shown or were begun before the swap, and the frame.
constexpr int c_pictures_at_end = 3;

/// A descriptor that is closed at the end.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  int operator*() const { return number_; }

 private:
  int number_;
};

Error failed(const std::filesystem::path& socket, const char* what) {
  return tool_failed(fmt::format("{}: {}: {}", socket.string(), what, std::strerror(errno)));
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
    const std::string name = equal ? fmt::format("picture-{}", different_) : "picture-different";
    if (!equal)
      status_ =
          Error{ExitCode::differs, fmt::format("picture {} of the monitor differs from the twin's; see {}",
                                               count_, (out_ / (name + ".png")).string())};
    if (dots == last_) return;
    last_ = dots;
    ++different_;
    if (const Status written = write_png(out_ / (name + ".png"), frame_of_dots(dots)); !written && status_)
      status_ = written;
  }
  const Status& status() const { return status_; }
  std::uint64_t count() const { return count_; }
  std::uint64_t different() const { return different_; }

 private:
  PacketTwin& twin_;
  std::filesystem::path out_;
  DotPicture last_;
  std::uint64_t count_ = 0, different_ = 0;
  Status status_ = Ok{};
};

}  // namespace

Result<ServerReport> serve_board(const std::filesystem::path& socket, const std::filesystem::path& out,
                                 const SimulatorFolders& folders) {
  if (Status made = make_folders(out); !made) return made.error();
  PacketTwin twin;
  Pictures pictures(twin, out);
  auto board = VerilatedBoard::open(folders, [&](const DotPicture& dots) { pictures.add(dots); });
  if (!board) return board.error();

  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (socket.string().size() >= sizeof address.sun_path)
    return bad_input(socket.string() + ": too long for the name of a socket; use a shorter path");
  std::strcpy(address.sun_path, socket.c_str());
  const Descriptor listener(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
  ::unlink(socket.c_str());
  if (*listener < 0 || ::bind(*listener, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 ||
      ::listen(*listener, 1) != 0)
    return failed(socket, "cannot listen");
  const Descriptor client(::accept4(*listener, nullptr, nullptr, SOCK_CLOEXEC));
  ::unlink(socket.c_str());
  if (*client < 0) return failed(socket, "no client");

  ServerReport report;
  SpiWire wire(0);
  SpiPins pins;
  const auto clock = [&]() -> Status {
    const Result<bool> data = board->clock(pins);
    if (!data) return data.error();
    pins = wire.clock(*data);
    return pictures.status();
  };
  std::uint32_t count = 0;
  for (std::vector<std::uint8_t> packet; read_all(*client, &count, sizeof count);) {
    if (count == 0 || count > c_longest_packet)
      return bad_input(fmt::format("{}: a packet of {} bytes", socket.string(), count));
    packet.resize(count);
    if (!read_all(*client, packet.data(), count)) break;
    wire.send(packet);
    while (wire.busy())
      if (Status status = clock(); !status) return status.error();
    twin.take(packet, wire.received()[0]);
    ++report.packets;
    if (packet[0] == c_draw) ++report.vectors;
    if (!write_all(*client, wire.received())) break;
  }
  // Show the last frame.
  for (const std::uint64_t end = pictures.count() + c_pictures_at_end; twin.pending() > 0;) {
    if (Status status = clock(); !status) return status.error();
    if (pictures.count() == end && twin.pending() > 0)
      return Error{ExitCode::differs,
                   fmt::format("the monitor has not shown the last {} frames", twin.pending())};
  }
  report.clocks = board->clocks();
  report.pictures = pictures.different();
  return report;
}

}  // namespace halfway::board
